//! Where readings go: stdout, or a file that is never half written; and the bar that shows how far a run is.

use std::ffi::OsString;
use std::io::{Error, ErrorKind, IsTerminal};
use std::path::{Path, PathBuf};

use clap::ValueEnum;
use etendue::measurement::Measurement;
use etendue::report::{csv, json, text};
use indicatif::{ProgressBar, ProgressStyle};

use crate::disk::unwritable;
use crate::{Failure, complain, disk, print};

/// What readings look like, and where they go.
#[derive(clap::Args)]
pub(crate) struct Options {
    /// How to write the readings.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Write the readings into this folder as `<scene>.txt`, `.json` or `.csv` and not to stdout.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    /// A table for a person.
    Text,
    /// Everything, for programs; `etendue repeat` reads it.
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

/// A place that readings can go to.
pub(crate) struct Output {
    format: Format,
    file: Option<PathBuf>,
}

impl Options {
    /// The folder made: a place that cannot be used is told before the time of a measurement is spent.
    pub(crate) fn prepare(&self, scene: &str) -> Result<Output, Failure> {
        let file = self.out.as_deref().map(|folder| prepared(folder, scene, self.format.extension())).transpose()?;
        Ok(Output { format: self.format, file })
    }
}

impl Output {
    pub(crate) fn write(&self, measurement: &Measurement) -> Result<(), Failure> {
        let written = self.format.write(measurement);
        match &self.file {
            None => print(&written),
            Some(file) => save(file, &written),
        }
    }
}

fn prepared(folder: &Path, scene: &str, extension: &str) -> Result<PathBuf, Failure> {
    let target = folder.join(with_appended(Path::new(scene).file_stem().unwrap_or_default(), extension));
    std::fs::create_dir_all(folder).map_err(|e| unwritable(folder, &e, "--out takes a folder that can be written"))?;
    match target.is_dir() {
        true => Err(unwritable(&target, &Error::from(ErrorKind::IsADirectory), "--out takes a folder that can be written")),
        false => Ok(target),
    }
}

/// Puts a file where `--out` or `--plot` says.
pub(crate) fn save_at(target: &Path, written: &[u8]) -> Result<(), Failure> {
    disk::save(target, written).map_err(|e| unwritable(target, &e, "--out takes a place that can be written"))
}

/// Puts a file there, and says so on stderr.
pub(crate) fn save_and_say(target: &Path, written: &[u8]) -> Result<(), Failure> {
    save_at(target, written)?;
    complain(&format!("wrote {}", target.display()));
    Ok(())
}

fn save(target: &Path, written: &str) -> Result<(), Failure> {
    save_at(target, written.as_bytes())?;
    print(&format!("{}\n", target.display()))
}

/// The name with an extension more; a dot that the name has itself stays.
pub(crate) fn with_appended(name: impl Into<OsString>, extension: &str) -> OsString {
    let mut name = name.into();
    name.push(".");
    name.push(extension);
    name
}

/// A bar on a terminal, nothing elsewhere.
pub(crate) fn progress_bar() -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(1000);
    if let Ok(style) = ProgressStyle::with_template("  measuring {bar:40} {percent:>3} %  {elapsed}") {
        bar.set_style(style);
    }
    bar
}
