//! `etendue converge FILE`: true error and claimed uncertainty against run time; of a calibration against exposures and noise, too.

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::ValueEnum;
use etendue::estimate::run::with_threads;
use etendue::plan::{Plan, PlanOptions};
use etendue::report::convergence::{
    ConvergenceReport, reference_from_csv, reference_from_json, reference_from_values, to_csv, to_json, to_text,
};
use etendue::scene::{FileProblem, Files, Scene};
use etendue::study::StudyWatch;
use etendue::study::converge::{ConvergeError, ConvergeOptions, Reference, converge, places};

use crate::file_set::check_places;
use crate::measure::{seconds, whole};
use crate::processor_time::ProcessorClock;
use crate::{Failure, disk, explain, output, print};

/// Longest file that is read as a reference, bytes.
const LONGEST: u64 = 1 << 30;

/// True error and claimed uncertainty against run time, for the plan and, on request, for the naive one: how fast the error falls, and
/// whether the uncertainty that is claimed is the true one. Of a calibration: the error of the fitted curve against the number of exposures,
/// against noise and against run time.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The scene file, or a calibration file.
    scene: String,
    /// What the readings are held to: values in the order of the readings, each as 6.2225 or 6.2225±0.0005, or a file that `etendue
    /// measure --format json` or `csv` wrote [default: the closed form where there is one, else a long run].
    #[arg(long, value_name = "VALUE[,VALUE…]|FILE", allow_hyphen_values = true)]
    reference: Option<String>,
    /// Study the naive plan, too: nothing left out, every term by rays.
    #[arg(long, conflicts_with = "naive")]
    compare_naive: bool,
    /// Runs of each rung of the ladder.
    #[arg(long, value_name = "N", value_parser = whole(2, 10_000), allow_hyphen_values = true, default_value_t = 8)]
    seeds: u64,
    /// Seed of the long run; those of the ladder follow it.
    #[arg(long, value_name = "N", value_parser = whole(0, u64::MAX), allow_hyphen_values = true, default_value_t = 0)]
    seed: u64,
    /// Stop after this time, e.g. 20s or 2min.
    #[arg(long, value_name = "TIME", value_parser = seconds, allow_hyphen_values = true, default_value = "20s")]
    budget: f64,
    /// The highest rung: at most so many samples for each sampled contribution.
    #[arg(long, value_name = "N", value_parser = whole(256, 1 << 32), allow_hyphen_values = true, default_value_t = 1 << 32)]
    up_to: u64,
    /// Threads; with one, processor time is the time one waits.
    #[arg(long, value_name = "N", value_parser = whole(1, 1024), allow_hyphen_values = true, default_value_t = 1)]
    threads: u64,
    /// How to write the table.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Write the table into this file and not to stdout.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    #[cfg(feature = "plot")]
    #[command(flatten)]
    picture: picture::Options,
    #[command(flatten)]
    plan: explain::Options,
    /// The folder that no file may lie outside of; by default the one that holds `scenes/` and `sensors/`, else the scene's own.
    #[arg(long, value_name = "DIR")]
    root: Option<String>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    /// A table for a person.
    Text,
    /// Everything, for programs.
    Json,
    /// A row a rung, for spreadsheets.
    Csv,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    if campaign::is_one(&arguments.scene) {
        return campaign::run(arguments);
    }
    let scene = disk::scene(&arguments.scene, arguments.root.as_deref())?;
    let plan = arguments.plan.plan(&scene)?;
    let naive = arguments.compare_naive.then(|| naive(&scene)).transpose()?;
    let mut plans = vec![(if plan.naive { "naive" } else { "planned" }, &plan)];
    plans.extend(naive.as_ref().map(|plan| ("naive", plan)));
    let reference = arguments.reference.as_deref().map(|given| reference(given, &scene)).transpose()?;
    // What cannot be written is told before the time is spent.
    check_places(arguments.out.iter().map(|path| ("--out", path)))?;
    #[cfg(feature = "plot")]
    arguments.picture.check()?;

    let options = options(arguments);
    let bar = output::progress_bar();
    let start = Instant::now();
    let clock = ProcessorClock::new(arguments.threads);
    let now = || start.elapsed().as_secs_f64();
    let cpu = || clock.seconds();
    let progress = |share: f64| bar.set_position((1000.0 * share) as u64);
    let watch = StudyWatch { now: &now, cpu: &cpu, progress: &progress };
    let study = with_threads(usize::try_from(arguments.threads).ok(), || converge(&scene, &plans, reference, &options, &watch));
    bar.finish_and_clear();
    let study = study.map_err(|e| match e {
        ConvergeError::Estimate(e) => Failure::Run(format!("error: {e}")),
        _ => Failure::Input(format!("error: {e}")),
    })?;
    let report = ConvergenceReport {
        study,
        scene_file: arguments.scene.clone(),
        threads: arguments.threads,
        cpu_clock: clock.in_words().to_owned(),
    };
    let written = match arguments.format {
        Format::Text => to_text(&report),
        Format::Json => to_json(&report),
        Format::Csv => to_csv(&report),
    };
    match &arguments.out {
        None => print(&written)?,
        Some(file) => output::save_at(file, written.as_bytes())?,
    }
    #[cfg(feature = "plot")]
    arguments.picture.draw(&report.study)?;
    Ok(())
}

fn options(arguments: &Arguments) -> ConvergeOptions {
    ConvergeOptions { seeds: arguments.seeds, seed: arguments.seed, budget_seconds: arguments.budget, most_samples: arguments.up_to }
}

fn naive(scene: &Scene) -> Result<Plan, Failure> {
    Plan::new(scene, &PlanOptions { naive: true, without: Vec::new() }).map_err(|e| Failure::Run(format!("error: {e}")))
}

/// A file if it is named like one, else values.
fn reference(given: &str, scene: &Scene) -> Result<Reference, Failure> {
    let places = places(scene);
    let unusable = |why: &str, help: &str| Failure::Input(format!("error: cannot use the reference `{given}`: {why}\n  = help: {help}"));
    let extension = Path::new(given).extension().map(|e| e.to_string_lossy().to_lowercase());
    let of_file = matches!(extension.as_deref(), Some("json" | "csv"));
    if !of_file {
        let looks_like_values = given.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)) && !Path::new(given).is_file();
        let help = if looks_like_values {
            "give a number for each reading, such as 6.2225,871.9 or 6.2225±0.0005,871.9±0.08, in their order"
        } else {
            "give numbers, or a file .json or .csv that `etendue measure` wrote"
        };
        return reference_from_values(given, &places).map_err(|why| unusable(&why, help));
    }
    let help =
        "a reference is a file that `etendue measure --format json` or `--format csv` wrote of this scene, or a number for each reading";
    let bytes = disk::Anywhere.read(given, LONGEST).map_err(|problem| match problem {
        FileProblem::Missing => unusable("there is no such file", help),
        FileProblem::TooLong { bytes } => unusable(&format!("{bytes} bytes are more than any file of readings"), help),
        FileProblem::Unreadable(why) => unusable(&why, help),
    })?;
    let text = String::from_utf8(bytes).map_err(|_| unusable("it is no text", help))?;
    let read = match extension.as_deref() {
        Some("json") => reference_from_json(&text, given, scene.hash, &places),
        _ => reference_from_csv(&text, given, &places),
    };
    read.map_err(|why| unusable(&why, help))
}

mod campaign {
    //! Calibrations: the error of the curve.

    use std::time::Instant;

    use etendue::estimate::run::with_threads;
    use etendue::report::convergence::{CampaignReport, campaign_to_csv, campaign_to_json, campaign_to_text};
    use etendue::study::StudyWatch;
    use etendue::study::converge::ConvergeError;
    use etendue::study::converge::campaign::converge_campaign;

    use super::{Arguments, Format, LONGEST, options};
    use crate::file_set::check_places;
    use crate::processor_time::ProcessorClock;
    use crate::{Failure, disk, output, print};

    /// Whether a file holds a calibration. One that cannot be read is left to the reader of scenes, which says what is the matter.
    pub(super) fn is_one(path: &str) -> bool {
        let text = disk::text(path, LONGEST).unwrap_or_default();
        let code = text.lines().map(|line| line.split("//").next().unwrap_or_default().trim());
        code.into_iter().find(|line| !line.is_empty() && !line.starts_with("#!")).is_some_and(|line| line.starts_with("Calibration"))
    }

    pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
        let plan = arguments.plan.options();
        let of_scenes = [
            ("--reference", arguments.reference.is_some()),
            ("--compare-naive", arguments.compare_naive),
            ("--naive", plan.naive),
            ("--without", !plan.without.is_empty()),
        ];
        if let Some((option, _)) = of_scenes.iter().find(|(_, given)| *given) {
            return Err(Failure::Input(format!(
                "error: {option} is for scenes, and `{}` is a calibration\n  = help: leave it out; the curve is held to the true one of its sensor",
                arguments.scene
            )));
        }
        let calibration = disk::calibration(&arguments.scene, arguments.root.as_deref())?;
        check_places(arguments.out.iter().map(|path| ("--out", path)))?;
        #[cfg(feature = "plot")]
        arguments.picture.check_campaign()?;
        let bar = output::progress_bar();
        let start = Instant::now();
        let clock = ProcessorClock::new(arguments.threads);
        let (now, cpu) = (|| start.elapsed().as_secs_f64(), || clock.seconds());
        let progress = |share: f64| bar.set_position((1000.0 * share) as u64);
        let watch = StudyWatch { now: &now, cpu: &cpu, progress: &progress };
        let threads = usize::try_from(arguments.threads).ok();
        let study = with_threads(threads, || converge_campaign(&calibration, &options(arguments), &watch));
        bar.finish_and_clear();
        let study = study.map_err(|e| match e {
            ConvergeError::Estimate(e) => Failure::Run(format!("error: {e}")),
            _ => Failure::Input(format!("error: {}: {e}", arguments.scene)),
        })?;
        let file = arguments.scene.clone();
        let report = CampaignReport { study, file, threads: arguments.threads, cpu_clock: clock.in_words().to_owned() };
        let written = match arguments.format {
            Format::Text => campaign_to_text(&report),
            Format::Json => campaign_to_json(&report),
            Format::Csv => campaign_to_csv(&report),
        };
        match &arguments.out {
            None => print(&written)?,
            Some(file) => output::save_at(file, written.as_bytes())?,
        }
        #[cfg(feature = "plot")]
        arguments.picture.draw_campaign(&report.study)?;
        Ok(())
    }
}

#[cfg(feature = "plot")]
mod picture {
    //! The picture of a study.

    use std::path::{Path, PathBuf};

    use etendue::report::plot::campaign::{self, Against};
    use etendue::report::plot::{self, Chart, PlotError, Size, Style, Theme};
    use etendue::study::converge::Convergence;
    use etendue::study::converge::campaign::CampaignConvergence;

    use crate::file_set::check_places;
    use crate::{Failure, complain, output};

    #[derive(clap::Args)]
    pub(crate) struct Options {
        /// Draw error and claimed uncertainty against processor time into this file, `.svg` or `.png`; of a calibration three pictures, whose
        /// names end in -exposures, -noise and -time.
        #[arg(long, value_name = "FILE")]
        plot: Option<PathBuf>,
        /// Light lines on near black.
        #[arg(long, requires = "plot")]
        dark: bool,
    }

    /// Where the picture of a campaign goes that shows the error against this.
    fn of_campaign(path: &Path, against: Against) -> PathBuf {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let extension = path.extension().unwrap_or_default().to_string_lossy();
        path.with_file_name(format!("{stem}-{}.{extension}", against.name()))
    }

    impl Options {
        fn is_png(&self) -> bool {
            self.plot.as_deref().and_then(Path::extension).is_some_and(|e| e.eq_ignore_ascii_case("png"))
        }

        fn check_name(&self) -> Result<(), Failure> {
            let Some(path) = &self.plot else { return Ok(()) };
            if !self.is_png() && !path.extension().is_some_and(|e| e.eq_ignore_ascii_case("svg")) {
                return Err(Failure::Input(format!(
                    "error: --plot {}: the name of a picture ends in .svg or .png\n  = help: for example --plot {}",
                    path.display(),
                    path.with_extension("svg").display()
                )));
            }
            Ok(())
        }

        pub(crate) fn check(&self) -> Result<(), Failure> {
            self.check_name()?;
            check_places(self.plot.iter().map(|path| ("--plot", path)))
        }

        pub(crate) fn check_campaign(&self) -> Result<(), Failure> {
            self.check_name()?;
            let places: Vec<PathBuf> = self.plot.iter().flat_map(|path| Against::ALL.map(|against| of_campaign(path, against))).collect();
            check_places(places.iter().map(|path| ("--plot", path)))
        }

        pub(crate) fn draw(&self, study: &Convergence) -> Result<(), Failure> {
            match &self.plot {
                Some(path) => self.save(plot::convergence::chart(study), path),
                None => Ok(()),
            }
        }

        /// Three pictures: the name is that of the file, and what the error stands against.
        pub(crate) fn draw_campaign(&self, study: &CampaignConvergence) -> Result<(), Failure> {
            let Some(path) = &self.plot else { return Ok(()) };
            Against::ALL.into_iter().try_for_each(|against| self.save(campaign::chart(study, against), &of_campaign(path, against)))
        }

        fn save(&self, chart: Result<Chart, PlotError>, path: &Path) -> Result<(), Failure> {
            let failed = |e: PlotError| Failure::Run(format!("error: {e}"));
            let chart = match chart {
                Err(e @ PlotError::Nothing { .. }) => {
                    complain(&format!("no picture was drawn: {e}"));
                    return Ok(());
                }
                chart => chart.map_err(failed)?,
            };
            let theme = if self.dark { Theme::Dark } else { Theme::Light };
            let svg = plot::svg(&chart, &Style { theme, size: Size::Paper }).map_err(failed)?;
            let drawn = if self.is_png() { plot::png(&svg, 2.0).map_err(failed)? } else { svg.into_bytes() };
            output::save_and_say(path, &drawn)
        }
    }
}
