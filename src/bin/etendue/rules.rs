//! `etendue rules [SCENE…]`: what each rule of the plan saves.

use std::path::PathBuf;
use std::time::Instant;

use clap::ValueEnum;
use etendue::estimate::run::with_threads;
use etendue::report::savings::{SavingsReport, to_csv, to_json, to_markdown, to_text};
use etendue::scene::Scene;
use etendue::study::StudyWatch;
use etendue::study::converge::ConvergeOptions;
use etendue::study::savings::{SavingsOptions, savings};

use crate::file_set::check_places;
use crate::measure::{seconds, share, whole};
use crate::processor_time::ProcessorClock;
use crate::{Failure, disk, output, print};

/// What each rule of the plan saves: the cost of a reading with all rules, without each of them, and with none.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Scene files [default: every scene of the folder `scenes` here or above, and of its folder `lecture`].
    scenes: Vec<String>,
    /// The true error whose cost is sought, relative.
    #[arg(long, value_name = "SHARE", value_parser = share, allow_hyphen_values = true, default_value = "0.1%")]
    error: f64,
    /// Stop a scene after this time.
    #[arg(long, value_name = "TIME", value_parser = seconds, allow_hyphen_values = true, default_value = "20s")]
    budget_per_scene: f64,
    /// Runs of each rung of the ladders.
    #[arg(long, value_name = "N", value_parser = whole(2, 10_000), allow_hyphen_values = true, default_value_t = 8)]
    seeds: u64,
    /// Threads; with one, processor time is the time one waits.
    #[arg(long, value_name = "N", value_parser = whole(1, 1024), allow_hyphen_values = true, default_value_t = 1)]
    threads: u64,
    /// How to write the tables.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Write the tables into this file and not to stdout.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Write the page for documentation into this file, too.
    #[arg(long, value_name = "FILE")]
    markdown: Option<PathBuf>,
    /// The folder that no file may lie outside of; by default the one that holds `scenes/` and `sensors/`, else the scene's own.
    #[arg(long, value_name = "DIR")]
    root: Option<String>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    /// Tables for a person.
    Text,
    /// Everything, for programs.
    Json,
    /// A row a plan of each scene, for spreadsheets.
    Csv,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let files = if arguments.scenes.is_empty() { shelf()? } else { arguments.scenes.clone() };
    let mut scenes = read(&files, arguments.root.as_deref())?;
    if arguments.scenes.is_empty() {
        // What rules save is counted on readings of instruments; pictures have rules of their own.
        scenes.retain(|(_, scene)| !scene.instruments.is_empty());
    }
    // A place that cannot be used is told before minutes are spent.
    let (out, markdown) = (arguments.out.iter(), arguments.markdown.iter());
    check_places(out.map(|path| ("--out", path)).chain(markdown.map(|path| ("--markdown", path))))?;

    let ladder = ConvergeOptions { seeds: arguments.seeds, budget_seconds: arguments.budget_per_scene, ..ConvergeOptions::default() };
    let options = SavingsOptions { error: arguments.error, ladder };
    let bar = output::progress_bar();
    let start = Instant::now();
    let clock = ProcessorClock::new(arguments.threads);
    let now = || start.elapsed().as_secs_f64();
    let cpu = || clock.seconds();
    let (mut studied, mut failed) = (Vec::new(), Vec::new());
    // One pool of threads for all: the time of a thread that ends is no longer counted.
    with_threads(usize::try_from(arguments.threads).ok(), || {
        for (i, (name, scene)) in scenes.iter().enumerate() {
            let progress = |done: f64| bar.set_position((1000.0 * (i as f64 + done) / scenes.len() as f64) as u64);
            let watch = StudyWatch { now: &now, cpu: &cpu, progress: &progress };
            match savings(name, scene, &options, &watch) {
                Ok(found) => studied.push(found),
                Err(why) => failed.push((name.clone(), why.to_string())),
            }
        }
    });
    bar.finish_and_clear();
    let report = SavingsReport { options, scenes: studied, failed, threads: arguments.threads, cpu_clock: clock.in_words().to_owned() };
    let written = match arguments.format {
        Format::Text => to_text(&report),
        Format::Json => to_json(&report),
        Format::Csv => to_csv(&report),
    };
    match &arguments.out {
        None => print(&written)?,
        Some(file) => output::save_at(file, written.as_bytes())?,
    }
    if let Some(file) = &arguments.markdown {
        output::save_and_say(file, to_markdown(&report).as_bytes())?;
    }
    match report.failed.as_slice() {
        [] => Ok(()),
        failed => {
            let each =
                failed.iter().map(|(scene, why)| format!("error: {scene}: {why}\n  = help: the budget of a scene is --budget-per-scene\n"));
            Err(Failure::Run(each.collect()))
        }
    }
}

fn shelf() -> Result<Vec<String>, Failure> {
    let files: Vec<String> =
        ["scenes", "scenes/lecture"].iter().filter_map(|folder| disk::names_on_shelf(folder, "ron")).flatten().collect();
    if files.is_empty() {
        return Err(Failure::Input(
            "error: no folder `scenes` with scenes here or above\n  = help: name scene files, or go to the folder that holds `scenes` and `sensors`"
                .to_owned(),
        ));
    }
    Ok(files)
}

/// All of them, or everything that is wrong with any of them.
fn read(files: &[String], root: Option<&str>) -> Result<Vec<(String, Scene)>, Failure> {
    let mut problems = String::new();
    let mut scenes = Vec::with_capacity(files.len());
    for file in files {
        match disk::scene(file, root) {
            Ok(scene) => scenes.push((file.clone(), scene)),
            Err(Failure::Input(message)) => problems += &format!("{}\n", message.trim_end()),
            Err(other) => return Err(other),
        }
    }
    if problems.is_empty() { Ok(scenes) } else { Err(Failure::Input(problems)) }
}
