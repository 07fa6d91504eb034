//! `etendue repeat FILE`: measure again what a file of readings says, and tell whether the bits agree.

use std::path::{Path, PathBuf};

use etendue::estimate::journal::{Journal, Rounds, Unrecorded};
use etendue::measurement::{Provenance, in_words};
use etendue::plan::{Plan, PlanError, PlanOptions};
use etendue::report::json::{RecordedReading, from_json, to_json};
use etendue::scene::Scene;

use crate::measure::{Run, failed, whole};
use crate::{Failure, complain, disk, print};

/// Longest file of readings that is read, bytes.
const LONGEST: u64 = 1 << 30;
/// Readings that are told one by one when they differ.
const MOST_TOLD: usize = 10;

/// Measure again what a file of readings says, with its scene, seed and options, and tell whether value, u and U of every reading
/// have the same bits: exit code 0 if so, 1 if not. A run that a budget of time ended is repeated with as many samples as it took.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// A file that `etendue measure --format json` wrote.
    file: PathBuf,
    /// Where the scene lies now; by default where it was when it was measured.
    #[arg(long, value_name = "FILE")]
    scene: Option<String>,
    /// Threads; as many as there are cores by default. Readings do not depend on it.
    #[arg(long, value_name = "N", value_parser = whole(1, 1024), allow_hyphen_values = true)]
    threads: Option<u64>,
}

/// The scene of a measurement and its plan, as they are now.
pub(crate) fn planned(recorded: &Provenance, scene_file: &str, moved: bool) -> Result<(Scene, Plan), Failure> {
    let scene = match moved {
        true => disk::scene(scene_file, None),
        false => disk::scene(scene_file, recorded.root.as_deref()),
    };
    let scene = scene.map_err(|e| match e {
        Failure::Input(message) if !moved && !Path::new(scene_file).exists() => Failure::Input(format!(
            "{}\n  = help: the scene is looked for from the current folder as it was named then; run from the folder of then, or say \
             where it lies with --scene FILE",
            message.trim_end()
        )),
        e => e,
    })?;
    let options = PlanOptions { naive: recorded.naive, without: recorded.without.clone() };
    let plan = Plan::new(&scene, &options).map_err(|e| match e {
        PlanError::UnknownRule { .. } => Failure::Input(format!("error: {e}")),
        PlanError::NotAPartition { .. } => Failure::Run(format!("error: {e}")),
    })?;
    Ok((scene, plan))
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let name = arguments.file.display();
    let unusable = |why: &str| Failure::Input(format!("error: cannot repeat `{name}`: {why}"));
    let help = "a file is repeated that `etendue measure --format json` of this version wrote";
    let about = std::fs::metadata(&arguments.file).map_err(|e| unusable(&e.to_string()))?;
    if !about.is_file() {
        return Err(unusable("it is not a file"));
    }
    if about.len() > LONGEST {
        return Err(unusable("it is longer than any file of readings"));
    }
    let text = std::fs::read_to_string(&arguments.file).map_err(|e| unusable(&format!("{e}\n  = help: {help}")))?;
    let recorded = from_json(&text).map_err(|why| unusable(&format!("{why}\n  = help: {help}")))?;
    let then = &recorded.provenance;
    if then.scene_file.is_empty() && arguments.scene.is_none() {
        return Err(unusable("it does not name its scene\n  = help: say where the scene lies with --scene FILE"));
    }
    let scene_file = arguments.scene.clone().unwrap_or_else(|| then.scene_file.clone());
    let (scene, plan) = planned(then, &scene_file, arguments.scene.is_some())?;
    let mut provenance = Provenance::of(&scene, &plan, &then.stop, then.seed);
    let differences = provenance.differences(then);
    for difference in &differences {
        complain(&format!("warning: {}", difference.told("now", "in the file")));
    }
    provenance.scene_file.clone_from(&scene_file);
    let journal: &dyn Journal = match then.rounds.is_empty() {
        true => &Unrecorded,
        false => &Rounds(then.rounds.clone()),
    };
    let run = Run { scene: &scene, plan: &plan, provenance, threads: arguments.threads, ideal: false };
    let measurement = run.measure(journal).map_err(|e| failed(&e))?;
    // Read back as the file was: what cannot be written is the same on both sides.
    let now = from_json(&to_json(&measurement)).map_err(|e| Failure::Run(format!("error: {e}")))?.readings;
    let different: Vec<String> = told(&recorded.readings, &now);
    let of_what = format!("`{scene_file}`, seed {}, {}", then.seed, in_words(&then.stop));
    if different.is_empty() {
        return print(&format!("{of_what}: value, u and U of all {} readings agree, bit for bit\n", now.len()));
    }
    let mut text = format!("{of_what}: {} of {} readings differ\n", different.len(), now.len().max(recorded.readings.len()));
    different.iter().take(MOST_TOLD).for_each(|line| text.push_str(&format!("  {line}\n")));
    if different.len() > MOST_TOLD {
        text.push_str(&format!("  and {} more\n", different.len() - MOST_TOLD));
    }
    print(&text)?;
    Err(Failure::Run(match differences.is_empty() {
        true => "error: the same scene, version, seed and options, and other bits: the file was edited, or this machine computes otherwise"
            .to_owned(),
        false => "error: the readings are not those of the file".to_owned(),
    }))
}

/// The readings that differ, a line each.
fn told(then: &[RecordedReading], now: &[RecordedReading]) -> Vec<String> {
    let mut lines = Vec::new();
    for i in 0..then.len().max(now.len()) {
        match (then.get(i), now.get(i)) {
            (Some(a), Some(b)) if a.has_the_bits_of(b) => {}
            (Some(a), Some(b)) if a.place() == b.place() && a.unit == b.unit => lines.push(changed(a, b)),
            (Some(a), Some(b)) => lines.push(format!("{} ({}) then, {} ({}) now", a.place(), a.unit, b.place(), b.unit)),
            (Some(a), None) => lines.push(format!("{}: not there now", a.place())),
            (None, Some(b)) => lines.push(format!("{}: not there then", b.place())),
            (None, None) => {}
        }
    }
    lines
}

fn changed(then: &RecordedReading, now: &RecordedReading) -> String {
    let number = |x: Option<f64>| x.map_or("not finite".to_owned(), |x| format!("{x:?}"));
    let parts: Vec<String> = [
        ("value", then.value, now.value),
        ("u", then.standard_uncertainty, now.standard_uncertainty),
        ("U", then.expanded_uncertainty, now.expanded_uncertainty),
    ]
    .into_iter()
    .filter(|(_, a, b)| a.map(f64::to_bits) != b.map(f64::to_bits))
    .map(|(what, a, b)| format!("{what} {} then, {} now", number(a), number(b)))
    .collect();
    let in_u = match (then.value, now.value, then.standard_uncertainty) {
        (Some(a), Some(b), Some(u)) if u > 0.0 && a != b => format!(" (by {:.2} u)", (b - a).abs() / u),
        _ => String::new(),
    };
    format!("{}: {} {}{in_u}", then.place(), parts.join("; "), then.unit)
}
