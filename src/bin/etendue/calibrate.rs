//! `etendue calibrate FILE`: responsivity curves from readings.

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::ValueEnum;
use etendue::calibration::evidence::ClassicRule;
use etendue::calibration::{Chooser, FitOptions, Outliers};
use etendue::estimate::{Stop, Watch};
use etendue::report::calibration::{
    covariance_root_to_csv, curve_to_csv, directional_to_csv, file_part, readings_to_csv, to_json, to_sensor_file, to_text,
};
use etendue::scene::Calibration;
use etendue::sensor::Acceptance;
use etendue::study::calibrate::suggest::Wanted;
use etendue::study::calibrate::{CalibrateError, CalibrateOptions, Calibrated, calibrate};

use crate::file_set::FileSet;
use crate::measure::whole;
use crate::{Failure, complain, disk, output, print};

/// Responsivity curves from readings, with their uncertainty, and what the readings do not see. Readings are simulated through the ray
/// engine, or read from a file.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The calibration file.
    file: String,
    /// Readings of a laboratory instead of simulated ones: CSV with the columns `exposure`, `CHANNEL (UNIT)` and `u(CHANNEL) (UNIT)`.
    #[arg(long, value_name = "CSV")]
    data: Option<String>,
    /// How the smoothness is chosen.
    #[arg(long, value_enum, default_value_t = Choose::Evidence)]
    choose: Choose,
    /// Weigh readings down that contradict the rest, instead of naming them only.
    #[arg(long)]
    robust: bool,
    /// Name the best N of the file's candidates for further exposures.
    #[arg(long, value_name = "N", value_parser = whole(1, 1000), allow_hyphen_values = true)]
    suggest: Option<u64>,
    /// What the suggested exposures are to make more certain: `curve`, or a quantity of the report such as `f1` or "s_v for D65".
    #[arg(long, value_name = "WHAT", default_value = "curve", requires = "suggest")]
    reduce: String,
    /// Seed of the noise and of the rays: the same seed gives the same bits.
    #[arg(long, value_name = "N", value_parser = whole(0, u64::MAX), allow_hyphen_values = true, default_value_t = 0)]
    seed: u64,
    /// How to write the report.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Write curves, covariances, readings, the fitted sensor, plots and the report into this folder.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// The folder that no file may lie outside of; by default the one that holds `scenes/` and `sensors/`, else the file's own.
    #[arg(long, value_name = "DIR")]
    root: Option<String>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Choose {
    /// Every smoothness, length and scale by its evidence.
    Evidence,
    /// Second differences: residuals as large as the noise.
    Discrepancy,
    /// Second differences: generalised cross-validation.
    Gcv,
    /// Second differences: corner of the L-curve.
    LCurve,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    /// A page for a person.
    Text,
    /// Everything, for programs.
    Json,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let calibration = disk::calibration(&arguments.file, arguments.root.as_deref())?;
    let data = arguments.data.as_deref().map(|path| disk::readings(path, &calibration)).transpose()?;
    if arguments.suggest.is_some() && calibration.candidates.is_empty() {
        return Err(Failure::Input(format!(
            "error: --suggest: `{}` lists no candidates\n  = help: add `candidates: [Leds(spectra: […])]`",
            arguments.file
        )));
    }
    if let Some(folder) = &arguments.out {
        std::fs::create_dir_all(folder).map_err(|e| disk::unwritable(folder, &e, "--out takes a folder that can be written"))?;
    }
    let options = CalibrateOptions {
        fit: FitOptions {
            chooser: arguments.choose.chooser(),
            outliers: if arguments.robust { Outliers::DownWeight } else { Outliers::Report },
            ..FitOptions::default()
        },
        seed: arguments.seed,
        suggest: arguments.suggest.map_or(0, |n| usize::try_from(n).unwrap_or(usize::MAX)),
        wanted: if arguments.reduce == "curve" { Wanted::Curve } else { Wanted::Quantity(arguments.reduce.clone()) },
        stop: Stop { target: Some(1e-3), ..Stop::default() },
        data,
    };
    let bar = output::progress_bar();
    let start = Instant::now();
    let watch = Watch { now: &|| start.elapsed().as_secs_f64(), progress: &|share| bar.set_position((1000.0 * share) as u64) };
    let calibrated = calibrate(&calibration, &options, &watch);
    bar.finish_and_clear();
    let calibrated = calibrated.map_err(|e| match e {
        CalibrateError::Fit(_) | CalibrateError::Campaign(_) | CalibrateError::Wanted { .. } => {
            Failure::Input(format!("error: {}: {e}", arguments.file))
        }
        CalibrateError::Spectrum(_) => Failure::Run(format!("error: {e}")),
    })?;
    let (written, extension) = match arguments.format {
        Format::Text => (to_text(&calibrated), "txt"),
        Format::Json => (to_json(&calibrated), "json"),
    };
    match &arguments.out {
        None => print(&written),
        Some(folder) => save(folder, &arguments.file, &calibration, &calibrated, (&written, extension)),
    }
}

impl Choose {
    fn chooser(self) -> Chooser {
        match self {
            Choose::Evidence => Chooser::Evidence,
            Choose::Discrepancy => Chooser::Classic(ClassicRule::Discrepancy),
            Choose::Gcv => Chooser::Classic(ClassicRule::CrossValidation),
            Choose::LCurve => Chooser::Classic(ClassicRule::LCurve),
        }
    }
}

/// Everything into a folder; what cannot be made is told before anything is written.
fn save(folder: &Path, file: &str, calibration: &Calibration, calibrated: &Calibrated, report: (&str, &str)) -> Result<(), Failure> {
    let stem = Path::new(file).file_stem().map_or_else(|| "calibration".to_owned(), |s| s.to_string_lossy().into_owned());
    let mut files: Vec<(String, Vec<u8>)> = vec![(format!("{stem}.{}", report.1), report.0.as_bytes().to_vec())];
    let mut curve_files = Vec::new();
    for channel in &calibrated.channels {
        let part = file_part(&channel.readings.channel);
        let curve = curve_to_csv(calibrated, channel).map_err(|e| Failure::Run(format!("error: {e}")))?;
        let name = format!("{stem}-{part}.csv");
        files.push((name.clone(), curve.into_bytes()));
        files.push((format!("{stem}-{part}-covariance-root.csv"), covariance_root_to_csv(calibrated, channel).into_bytes()));
        curve_files.push(name);
    }
    files.push((format!("{stem}-readings.csv"), readings_to_csv(calibrated).into_bytes()));
    let sensor = &calibration.bench.instruments[0].sensor;
    let directional = format!("{stem}-directional.csv");
    if let Acceptance::Directional(response) = &sensor.acceptance {
        files.push((directional.clone(), directional_to_csv(response).into_bytes()));
    }
    files.push((format!("{stem}-sensor.ron"), to_sensor_file(calibrated, sensor, &curve_files, &directional).into_bytes()));
    #[cfg(feature = "plot")]
    files.extend(picture::all(&stem, calibrated)?);
    let set = FileSet::new(folder, files.iter().map(|(name, _)| name.clone()), "--out takes a folder that can be written")?;
    files.iter().try_for_each(|(name, bytes)| set.add(name, bytes))?;
    set.finish()?;
    for (name, _) in &files {
        complain(&format!("wrote {}", folder.join(name).display()));
    }
    print(&format!("{}\n", folder.join(&files[0].0).display()))
}

#[cfg(feature = "plot")]
mod picture {
    //! The pictures of a calibration.

    use etendue::report::plot::{self, PlotError, Size, Style, Theme};
    use etendue::study::calibrate::Calibrated;

    use crate::Failure;

    pub(crate) fn all(stem: &str, calibrated: &Calibrated) -> Result<Vec<(String, Vec<u8>)>, Failure> {
        let failed = |e: PlotError| Failure::Run(format!("error: {e}"));
        let style = Style { theme: Theme::Light, size: Size::Paper };
        let mut files = Vec::new();
        for (name, chart) in plot::calibration::charts(calibrated).map_err(failed)? {
            let svg = plot::svg(&chart, &style).map_err(failed)?;
            files.push((format!("{stem}-{name}.svg"), svg.into_bytes()));
        }
        Ok(files)
    }
}
