//! `etendue measure SCENE`: read every instrument.

use std::ffi::OsString;
use std::io::{Error, ErrorKind, IsTerminal};
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::ValueEnum;
use etendue::estimate::run::with_threads;
use etendue::estimate::{Stop, Watch};
use etendue::measurement::{Measurement, measure};
use etendue::report::{csv, json, text};
use indicatif::{ProgressBar, ProgressStyle};

use crate::{Failure, disk, explain, print};

/// Read every instrument of a scene.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The scene file.
    scene: String,
    /// Stop when the expanded uncertainty (95 %) is at most this share of each reading, e.g. 0.1% or 0.001 [default: 1%].
    #[arg(long, value_name = "SHARE", value_parser = share, allow_hyphen_values = true, conflicts_with = "samples")]
    target: Option<f64>,
    /// Start no further round of samples after this time, e.g. 2s, 500ms or 1min.
    #[arg(long, value_name = "TIME", value_parser = seconds, allow_hyphen_values = true, conflicts_with = "samples")]
    budget: Option<f64>,
    /// Take this many samples for each sampled contribution, rounded up to 16 times a power of two.
    #[arg(long, value_name = "N", value_parser = whole(1, 1 << 32), allow_hyphen_values = true)]
    samples: Option<u64>,
    /// Seed of the random numbers: the same seed gives the same bits.
    #[arg(long, value_name = "N", value_parser = whole(0, u64::MAX), allow_hyphen_values = true, default_value_t = 0)]
    seed: u64,
    /// Threads; as many as there are cores by default. Readings do not depend on it.
    #[arg(long, value_name = "N", value_parser = whole(1, 1024), allow_hyphen_values = true)]
    threads: Option<u64>,
    /// How to write the readings.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Write the readings into this folder as `<scene>.txt`, `.json` or `.csv` and not to stdout.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
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
    /// A row a reading.
    Csv,
}

impl Format {
    fn extension(self) -> &'static str {
        match self {
            Format::Text => "txt",
            Format::Json => "json",
            Format::Csv => "csv",
        }
    }

    fn write(self, measurement: &Measurement) -> String {
        match self {
            Format::Text => text::to_text(measurement),
            Format::Json => json::to_json(measurement),
            Format::Csv => csv::to_csv(measurement),
        }
    }
}

fn share(given: &str) -> Result<f64, String> {
    let (number, scale) = match given.trim().strip_suffix('%') {
        Some(percent) => (percent, 0.01),
        None => (given.trim(), 1.0),
    };
    match number.trim().parse::<f64>() {
        // Whoever writes 5 means 5 %.
        Ok(x) if scale == 1.0 && x >= 1.0 && x.is_finite() => {
            Err(format!("{} means {} %; write {}%", number.trim(), 100.0 * x, number.trim()))
        }
        Ok(x) if x > 0.0 && x.is_finite() => Ok(x * scale),
        _ => Err("a positive share such as 0.1% or 0.001".to_owned()),
    }
}

fn whole(lowest: u64, highest: u64) -> impl Fn(&str) -> Result<u64, String> + Clone {
    move |given| match given.trim().parse() {
        Ok(n) if (lowest..=highest).contains(&n) => Ok(n),
        _ => Err(format!("a whole number, {lowest} to {highest}")),
    }
}

fn seconds(given: &str) -> Result<f64, String> {
    let given = given.trim();
    let units = [("ms", 1e-3), ("min", 60.0), ("s", 1.0), ("h", 3600.0)];
    let found = units.iter().find_map(|(unit, scale)| Some((given.strip_suffix(unit)?, *scale)));
    match found.and_then(|(number, scale)| Some((number.trim().parse::<f64>().ok()?, scale))) {
        Some((x, scale)) if x > 0.0 && x.is_finite() => Ok(x * scale),
        _ => Err("a positive time with its unit, such as 2s, 500ms or 1min".to_owned()),
    }
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let scene = disk::scene(&arguments.scene, arguments.root.as_deref())?;
    let plan = arguments.plan.plan(&scene)?;
    let stop = Stop {
        // A budget of time alone is used up.
        target: match (arguments.target, arguments.budget, arguments.samples) {
            (None, None, None) => Stop::default().target,
            (target, _, _) => target,
        },
        budget_seconds: arguments.budget,
        samples: arguments.samples,
    };
    let target = arguments.out.as_deref().map(|folder| prepared(folder, &arguments.scene, arguments.format.extension())).transpose()?;
    let bar = progress_bar();
    let start = Instant::now();
    let watch = Watch { now: &|| start.elapsed().as_secs_f64(), progress: &|share| bar.set_position((1000.0 * share) as u64) };
    let threads = arguments.threads.and_then(|n| usize::try_from(n).ok());
    let measured = with_threads(threads, || measure(&scene, &plan, &stop, arguments.seed, &watch));
    bar.finish_and_clear();
    let measurement = measured.map_err(|e| Failure::Run(format!("error: {e}")))?;
    let written = arguments.format.write(&measurement);
    match &target {
        None => print(&written),
        Some(target) => save(target, &written),
    }
}

/// The file that the readings go to, its folder made: a place that cannot be used is told before the time of a measurement is spent.
fn prepared(folder: &Path, scene: &str, extension: &str) -> Result<PathBuf, Failure> {
    let target = folder.join(with_appended(Path::new(scene).file_stem().unwrap_or_default(), extension));
    std::fs::create_dir_all(folder).map_err(|e| unwritable(folder, &e))?;
    match target.is_dir() {
        true => Err(unwritable(&target, &Error::from(ErrorKind::IsADirectory))),
        false => Ok(target),
    }
}

fn save(target: &Path, written: &str) -> Result<(), Failure> {
    disk::save(target, written.as_bytes()).map_err(|e| unwritable(target, &e))?;
    print(&format!("{}\n", target.display()))
}

/// The name with an extension more; a dot that the name has itself stays.
fn with_appended(name: impl Into<OsString>, extension: &str) -> OsString {
    let mut name = name.into();
    name.push(".");
    name.push(extension);
    name
}

fn unwritable(path: &Path, e: &Error) -> Failure {
    disk::unwritable(path, e, "--out takes a folder that can be written")
}

/// A bar on a terminal, nothing elsewhere.
fn progress_bar() -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(1000);
    if let Ok(style) = ProgressStyle::with_template("  measuring {bar:40} {percent:>3} %  {elapsed}") {
        bar.set_style(style);
    }
    bar
}
