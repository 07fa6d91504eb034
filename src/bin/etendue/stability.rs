//! `etendue stability`: sweeps over what is stiff or extreme, held against closed forms and laws.

use std::io::IsTerminal;
#[cfg(feature = "plot")]
use std::path::Path;
use std::path::PathBuf;
use std::time::Instant;

use clap::ValueEnum;
use etendue::naming::nearest;
use etendue::report::stability as report;
use etendue::study::stability::{SWEEPS, Sweep, SweepResult, run as sweep_run};
use indicatif::{ProgressBar, ProgressStyle};

#[cfg(feature = "plot")]
use crate::disk;
use crate::file_set::check_places;
use crate::{Failure, output, print};

/// Drive scenes to where they are stiff or extreme, and hold their readings against closed forms and laws.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Only this sweep; may be given several times [default: all].
    #[arg(long, value_name = "NAME")]
    sweep: Vec<String>,
    /// The names of the sweeps, and what they are about.
    #[arg(long, conflicts_with_all = ["sweep", "format", "out", "plots", "markdown"])]
    list: bool,
    /// How to write the rows.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Write the rows into this file and not to stdout.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Draw deviation, time and, of fits, errors over their uncertainties against the parameter, an SVG picture each, into this folder.
    #[cfg(feature = "plot")]
    #[arg(long, value_name = "DIR")]
    plots: Option<PathBuf>,
    /// Write the table for documentation into this file, too.
    #[arg(long, value_name = "FILE")]
    markdown: Option<PathBuf>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    /// Tables for a person, and where it starts to fail.
    Text,
    /// Everything, for programs.
    Json,
    /// A row a point.
    Csv,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    if arguments.list {
        let line = |sweep: &Sweep| format!("{:24} {} ({}): {}\n", sweep.name, sweep.parameter, sweep.unit, sweep.law);
        return print(&SWEEPS.iter().map(line).collect::<String>());
    }
    let sweeps = chosen(&arguments.sweep)?;
    // A place that cannot be used is told before minutes are spent.
    let (out, markdown) = (arguments.out.iter(), arguments.markdown.iter());
    check_places(out.map(|path| ("--out", path)).chain(markdown.map(|path| ("--markdown", path))))?;
    #[cfg(feature = "plot")]
    if let Some(folder) = &arguments.plots {
        let help = "--plots takes a folder that can be written";
        std::fs::create_dir_all(folder).map_err(|e| disk::unwritable(folder, &e, help))?;
        check_places([("--plots", &folder.join("deviation.svg"))])?;
    }
    let results = measured(&sweeps);
    let written = match arguments.format {
        Format::Text => report::to_text(&results),
        Format::Json => report::json::to_json(&results),
        Format::Csv => report::csv::to_csv(&results),
    };
    match &arguments.out {
        Some(file) => output::save_and_say(file, written.as_bytes())?,
        None => print(&written)?,
    }
    if let Some(file) = &arguments.markdown {
        output::save_and_say(file, report::to_markdown(&results).as_bytes())?;
    }
    #[cfg(feature = "plot")]
    if let Some(folder) = &arguments.plots {
        draw(folder, &results)?;
    }
    match results.iter().flat_map(SweepResult::wrong).count() {
        0 => Ok(()),
        wrong => Err(Failure::Run(format!("error: {wrong} rows are off by more than they admit"))),
    }
}

/// The sweeps of these names in the order of the table; all without names.
fn chosen(names: &[String]) -> Result<Vec<Sweep>, Failure> {
    let known = SWEEPS.map(|sweep| sweep.name);
    let mut problems = String::new();
    for name in names.iter().filter(|name| !known.contains(&name.as_str())) {
        let guess = nearest(name, known).map_or(String::new(), |near| format!("did you mean `{near}`? "));
        problems.push_str(&format!("error: there is no sweep `{name}`\n  = help: {guess}allowed: {}\n", known.join(", ")));
    }
    if !problems.is_empty() {
        return Err(Failure::Input(problems));
    }
    Ok(SWEEPS.into_iter().filter(|sweep| names.is_empty() || names.iter().any(|name| name == sweep.name)).collect())
}

fn measured(sweeps: &[Sweep]) -> Vec<SweepResult> {
    let bar = if std::io::stderr().is_terminal() { ProgressBar::new(1000) } else { ProgressBar::hidden() };
    if let Ok(style) = ProgressStyle::with_template("  {msg:24} {bar:40} {percent:>3} %  {elapsed}") {
        bar.set_style(style);
    }
    let start = Instant::now();
    let now = || start.elapsed().as_secs_f64();
    let mut results = Vec::with_capacity(sweeps.len());
    for (i, sweep) in sweeps.iter().enumerate() {
        bar.set_message(sweep.name);
        let progress = |share: f64| bar.set_position((1000.0 * (i as f64 + share) / sweeps.len() as f64) as u64);
        results.push(sweep_run(sweep, |_| true, &now, &progress));
    }
    bar.finish_and_clear();
    results
}

#[cfg(feature = "plot")]
fn draw(folder: &Path, results: &[SweepResult]) -> Result<(), Failure> {
    use etendue::report::plot::{self, Size, Style, Theme};
    for result in results {
        let charts = [
            ("deviation", report::chart::deviations(result)),
            ("time", report::chart::times(result)),
            ("bands", report::chart::in_bands(result)),
        ];
        for (what, chart) in charts {
            let Some(chart) = chart else { continue };
            let style = Style { theme: Theme::Light, size: Size::Paper };
            let picture = plot::svg(&chart, &style).map_err(|e| Failure::Run(format!("error: {}: {e}", result.sweep.name)))?;
            output::save_and_say(&folder.join(format!("{}-{what}.svg", result.sweep.name)), picture.as_bytes())?;
        }
    }
    Ok(())
}
