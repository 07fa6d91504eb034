//! `etendue coverage [SCENE…]`: how often the 95 % interval of each sampled reading covers the truth.

use std::path::PathBuf;
use std::time::Instant;

use clap::ValueEnum;
use etendue::estimate::run::with_threads;
use etendue::plan::PlanOptions;
use etendue::report::coverage::{StudiedScene, csv, json, to_markdown, to_text, wrong};
use etendue::scene::Scene;
use etendue::study::StudyWatch;
use etendue::study::coverage::{CoverageError, CoverageOptions, coverage};

use crate::file_set::check_places;
use crate::measure::{seconds, share, whole};
use crate::{Failure, disk, explain, output, print};

/// Folders of scenes that are studied when none is named.
const SHELVES: [&str; 2] = ["scenes", "scenes/lecture"];

/// Read scenes with many seeds, the stopping rule on, and count how often the 95 % interval of each sampled reading covers the truth: a
/// closed form where there is one, else a long run. Exit code 1 if an interval covers too little.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Scene files [default: those in the nearest folder `scenes`].
    scenes: Vec<String>,
    /// Runs of each scene.
    #[arg(long, value_name = "N", value_parser = whole(2, 1_000_000), allow_hyphen_values = true, default_value_t = 1000)]
    seeds: u64,
    /// Seed of the long run; those of the runs follow it.
    #[arg(long, value_name = "N", value_parser = whole(0, u64::MAX), allow_hyphen_values = true, default_value_t = 0)]
    seed: u64,
    /// The stopping rule's target; may be given several times for a table with all of them.
    #[arg(long, value_name = "SHARE", value_parser = share, allow_hyphen_values = true, default_value = "5%")]
    target: Vec<f64>,
    /// Start no further runs of a scene after this time, e.g. 20s or 2min.
    #[arg(long, value_name = "TIME", value_parser = seconds, allow_hyphen_values = true, default_value = "30s")]
    budget_per_scene: f64,
    /// Poses of an instrument that are read; of a larger grid, so many that are evenly spread over it.
    #[arg(long, value_name = "N", value_parser = whole(1, 1_000_000), allow_hyphen_values = true, default_value_t = 16)]
    poses: u64,
    /// Threads; as many as there are cores by default. Readings do not depend on it.
    #[arg(long, value_name = "N", value_parser = whole(1, 1024), allow_hyphen_values = true)]
    threads: Option<u64>,
    /// How to write the table.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Write the table into this file and not to stdout.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Write the table for documentation into this file, too.
    #[arg(long, value_name = "FILE")]
    markdown: Option<PathBuf>,
    #[command(flatten)]
    plan: explain::Options,
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

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    // What cannot be written is told before minutes are spent.
    let (out, markdown) = (arguments.out.iter(), arguments.markdown.iter());
    check_places(out.map(|path| ("--out", path)).chain(markdown.map(|path| ("--markdown", path))))?;
    let scenes = read(arguments)?;
    let studied = studied(arguments, &scenes)?;
    let written = match arguments.format {
        Format::Text => to_text(&studied),
        Format::Json => json::to_json(&studied),
        Format::Csv => csv::to_csv(&studied),
    };
    match &arguments.out {
        None => print(&written)?,
        Some(file) => output::save_and_say(file, written.as_bytes())?,
    }
    if let Some(file) = &arguments.markdown {
        output::save_and_say(file, to_markdown(&studied, &command()).as_bytes())?;
    }
    match wrong(&studied) {
        0 => Ok(()),
        1 => Err(Failure::Run("error: the intervals of 1 reading do not hold".to_owned())),
        n => Err(Failure::Run(format!("error: the intervals of {n} readings do not hold"))),
    }
}

/// The command line as it was given.
fn command() -> String {
    std::iter::once("etendue".to_owned()).chain(std::env::args().skip(1)).collect::<Vec<_>>().join(" ")
}

/// Every scene, or everything that is wrong with all of them.
fn read(arguments: &Arguments) -> Result<Vec<(String, Scene)>, Failure> {
    let names = if arguments.scenes.is_empty() { shelf()? } else { arguments.scenes.clone() };
    let mut scenes = Vec::with_capacity(names.len());
    let mut problems = String::new();
    for name in names {
        match disk::scene(&name, None) {
            Ok(scene) => scenes.push((name, scene)),
            Err(Failure::Input(message)) => problems.push_str(&format!("{}\n", message.trim_end())),
            Err(failure) => return Err(failure),
        }
    }
    if !problems.is_empty() {
        return Err(Failure::Input(problems));
    }
    // A rule that there is not is told once, not for each scene.
    scenes.first().map(|(_, scene)| arguments.plan.plan(scene)).transpose()?;
    Ok(scenes)
}

/// The scene files of the nearest folder `scenes`, here or above.
fn shelf() -> Result<Vec<String>, Failure> {
    let none = || {
        Failure::Input(
            "error: there is no folder `scenes` here or above\n  = help: name the scenes, such as `etendue coverage room.ron`".to_owned(),
        )
    };
    let here = std::env::current_dir().map_err(|_| none())?;
    let steps = here.ancestors().position(|folder| folder.join("scenes").is_dir()).ok_or_else(none)?;
    let mut names = Vec::new();
    for shelf in SHELVES {
        let folder = format!("{}{shelf}", "../".repeat(steps));
        let Ok(entries) = std::fs::read_dir(&folder) else { continue };
        let files = entries.flatten().filter_map(|entry| entry.file_name().into_string().ok());
        let mut files: Vec<String> = files.filter(|file| file.ends_with(".ron")).map(|file| format!("{folder}/{file}")).collect();
        files.sort();
        names.extend(files);
    }
    if names.is_empty() { Err(none()) } else { Ok(names) }
}

fn studied(arguments: &Arguments, scenes: &[(String, Scene)]) -> Result<Vec<StudiedScene>, Failure> {
    let bar = output::progress_bar();
    let start = Instant::now();
    let now = || start.elapsed().as_secs_f64();
    let how: PlanOptions = arguments.plan.options();
    let threads = arguments.threads.and_then(|n| usize::try_from(n).ok());
    let parts = (scenes.len() * arguments.target.len()) as f64;
    let mut studied = Vec::new();
    for (file, scene) in scenes {
        for &target in &arguments.target {
            let done = studied.len() as f64;
            let progress = |share: f64| bar.set_position((1000.0 * (done + share) / parts) as u64);
            let watch = StudyWatch { now: &now, cpu: &now, progress: &progress };
            let options = CoverageOptions {
                seeds: arguments.seeds,
                seed: arguments.seed,
                target,
                budget_seconds: arguments.budget_per_scene,
                most_poses: usize::try_from(arguments.poses).unwrap_or(usize::MAX),
            };
            let found = with_threads(threads, || coverage(scene, &how, &options, &watch)).map_err(|e| match e {
                CoverageError::Plan(e) => Failure::Input(format!("error: {file}: {e}")),
                CoverageError::Estimate(e) => Failure::Run(format!("error: {file}: {e}")),
            })?;
            studied.push(StudiedScene { file: file.clone(), target, found });
        }
    }
    bar.finish_and_clear();
    Ok(studied)
}
