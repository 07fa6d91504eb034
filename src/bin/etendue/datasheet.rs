//! `etendue datasheet SENSOR`: every quality index, computed and measured.

use std::path::PathBuf;
use std::time::Instant;

use clap::ValueEnum;
use etendue::characterization::sheet::{DataSheet, Options, Subject, data_sheet};
use etendue::estimate::Watch;
use etendue::estimate::run::with_threads;
use etendue::report::datasheet::{to_json, to_text};
use etendue::scene::sensor_from_file;

use crate::measure::whole;
use crate::{Failure, disk, output, print};

/// The data sheet of a sensor: every quality index computed from its curves and measured on a virtual bench.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The sensor file.
    sensor: String,
    /// How to write it.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Write sheet (.txt, .json) and pictures (.svg, .png) into this folder.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Seed of the readings that are sampled: the same seed gives the same bits.
    #[arg(long, value_name = "N", value_parser = whole(0, u64::MAX), allow_hyphen_values = true, default_value_t = 0)]
    seed: u64,
    /// Threads; as many as there are cores by default. Figures do not depend on it.
    #[arg(long, value_name = "N", value_parser = whole(1, 1024), allow_hyphen_values = true)]
    threads: Option<u64>,
    /// Step of the monochromator, 0.1 to 20 nm.
    #[arg(long, value_name = "NM", default_value = "1", allow_hyphen_values = true)]
    step: f64,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    /// A page for a person.
    Text,
    /// Everything, for programs.
    Json,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let sensor = sensor_from_file(&arguments.sensor, &disk::Anywhere, None).map_err(|problems| Failure::Input(problems.to_string()))?;
    if let Some(folder) = &arguments.out {
        let help = "--out takes a folder that can be written";
        std::fs::create_dir_all(folder).map_err(|e| disk::unwritable(folder, &e, help))?;
    }
    let sheet = arguments.sheet(Subject::Meter(sensor))?;
    let written = match arguments.format {
        Format::Text => to_text(&sheet),
        Format::Json => to_json(&sheet),
    };
    match &arguments.out {
        Some(_) => arguments.save(&sheet),
        None => print(&written),
    }
}

impl Arguments {
    fn sheet(&self, subject: Subject) -> Result<DataSheet, Failure> {
        let bar = output::progress_bar();
        let start = Instant::now();
        let watch = Watch { now: &|| start.elapsed().as_secs_f64(), progress: &|share| bar.set_position((1000.0 * share) as u64) };
        let options = Options { seed: self.seed, step_nm: self.step };
        let threads = self.threads.and_then(|n| usize::try_from(n).ok());
        let sheet = with_threads(threads, || data_sheet(&subject, &options, &watch));
        bar.finish_and_clear();
        sheet.map_err(|e| Failure::Input(format!("error: {}: {e}", self.sensor)))
    }

    fn save(&self, sheet: &DataSheet) -> Result<(), Failure> {
        let mut files: Vec<(String, Vec<u8>)> =
            vec![("sheet.txt".to_owned(), to_text(sheet).into_bytes()), ("sheet.json".to_owned(), to_json(sheet).into_bytes())];
        files.extend(pictures(sheet)?);
        let Some(folder) = &self.out else { return Ok(()) };
        for (name, bytes) in &files {
            let target = folder.join(name);
            disk::save(&target, bytes).map_err(|e| disk::unwritable(&target, &e, "--out takes a folder that can be written"))?;
        }
        let names: Vec<&str> = files.iter().map(|(name, _)| name.as_str()).collect();
        crate::complain(&format!("wrote {} in {}", names.join(", "), folder.display()));
        Ok(())
    }
}

#[cfg(feature = "plot")]
fn pictures(sheet: &DataSheet) -> Result<Vec<(String, Vec<u8>)>, Failure> {
    use etendue::report::plot::{self, Size, Style, Theme};
    let failed = |e: plot::PlotError| Failure::Run(format!("error: {e}"));
    let mut files = Vec::new();
    for (stem, chart) in etendue::report::datasheet::chart::charts(sheet) {
        let svg = plot::svg(&chart, &Style { theme: Theme::Light, size: Size::Paper }).map_err(failed)?;
        files.push((format!("{stem}.png"), plot::png(&svg, 2.0).map_err(failed)?));
        files.push((format!("{stem}.svg"), svg.into_bytes()));
    }
    Ok(files)
}

#[cfg(not(feature = "plot"))]
fn pictures(_: &DataSheet) -> Result<Vec<(String, Vec<u8>)>, Failure> {
    Ok(Vec::new())
}
