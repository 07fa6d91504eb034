//! `etendue merge FILE…`: put the shares of a run together and read them as one.

use std::path::PathBuf;

use etendue::estimate::EstimateError;
use etendue::estimate::journal::{Recording, Shares};
use etendue::measurement::{CheckpointHeader, Provenance};

use crate::measure::{Run, failed, whole};
use crate::{Failure, checkpoint, output, repeat};

/// Put the shares of a run together: the readings have the bits of the whole run.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The files of all shares, in any order, as `etendue measure --shard` wrote them; they stay as they are. The finished
    /// checkpoint of a whole run will do as well.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Where the scene lies now; by default where it was when the shares were measured.
    #[arg(long, value_name = "FILE")]
    scene: Option<String>,
    /// Threads; as many as there are cores by default. Readings do not depend on it.
    #[arg(long, value_name = "N", value_parser = whole(1, 1024), allow_hyphen_values = true)]
    threads: Option<u64>,
    #[command(flatten)]
    output: output::Options,
}

/// A file with a share.
struct Part {
    path: PathBuf,
    recording: Recording,
    header: CheckpointHeader,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut parts = Vec::new();
    let mut problems = Vec::new();
    for path in &arguments.files {
        match checkpoint::read(path) {
            Ok((recording, header)) => parts.push(Part { path: path.clone(), recording, header }),
            Err(Failure::Input(problem) | Failure::Run(problem)) => problems.push(problem),
        }
    }
    if problems.is_empty() {
        problems = inconsistent(&parts);
    }
    if !problems.is_empty() {
        return Err(Failure::Input(problems.join("\n")));
    }
    parts.sort_by_key(|part| part.header.share.number);
    let Some(first) = parts.first() else { return Ok(()) };
    let recorded = first.header.provenance.clone();
    let expected = parts.iter().filter_map(|part| part.recording.completion()).map(|end| end.pieces).max().unwrap_or(0);
    let scene_file = arguments.scene.clone().unwrap_or_else(|| recorded.scene_file.clone());
    let (scene, plan) = repeat::planned(&recorded, &scene_file, arguments.scene.is_some())?;
    let mut provenance = Provenance::of(&scene, &plan, &recorded.stop, recorded.seed);
    let differences = provenance.differences(&recorded);
    if !differences.is_empty() {
        return Err(Failure::Input(format!(
            "error: these shares cannot be put together here: they are not of the scene `{scene_file}` as it is now, or not of this \
             program\n{}  = help: merge with the files and the version that they were measured with",
            differences.iter().map(|d| format!("  {}\n", d.told("here", "in the shares"))).collect::<String>()
        )));
    }
    provenance.scene_file.clone_from(&scene_file);
    provenance.root.clone_from(&recorded.root);
    let output = arguments.output.prepare(&scene_file)?;
    let run = Run { scene: &scene, plan: &plan, provenance, threads: arguments.threads, ideal: true };
    let shares = Shares::new(parts.into_iter().map(|part| part.recording).collect());
    let not_this_run = |why: String| {
        Failure::Input(format!(
            "error: the shares are not of one run although their headers say so: {why}\n  = help: another build of the same version wrote \
             them; measure them again"
        ))
    };
    let measurement = run.measure(&shares).map_err(|e| match e {
        EstimateError::Incomplete { .. } | EstimateError::Foreign { .. } => not_this_run(e.to_string()),
        e => failed(&e),
    })?;
    if shares.left_over() > 0 || measurement.pieces != expected {
        return Err(not_this_run(format!("{} pieces of work are left over", shares.left_over())));
    }
    output.write(&measurement)
}

/// What keeps files from being the shares of one run: all of it.
fn inconsistent(parts: &[Part]) -> Vec<String> {
    let mut problems = Vec::new();
    let name = |part: &Part| format!("`{}`", part.path.display());
    let Some(first) = parts.first() else { return problems };
    for part in &parts[1..] {
        let differences = first.header.provenance.differences(&part.header.provenance);
        if !differences.is_empty() {
            let [a, b] = [first, part].map(|part| format!("in {}", name(part)));
            let lines: String = differences.iter().map(|d| format!("\n  {}", d.told(&a, &b))).collect();
            problems.push(format!("error: {} and {} are of different runs{lines}", name(first), name(part)));
        } else if part.header.share.of != first.header.share.of {
            let [a, b] = [first, part].map(|p| format!("{}/{}", p.header.share.number, p.header.share.of));
            problems.push(format!("error: {} is share {a} and {} is share {b}: they overlap", name(first), name(part)));
        }
    }
    if !problems.is_empty() {
        return problems;
    }
    for part in parts.iter().filter(|part| part.recording.completion().is_none()) {
        let share = part.header.share;
        problems.push(format!(
            "error: {} is not finished: {} pieces of work of share {}/{} are recorded\n  = help: repeat the command that began it; it goes on \
             from there",
            name(part),
            part.recording.pieces(),
            share.number,
            share.of
        ));
    }
    let of = first.header.share.of;
    let holders = |number: u32| parts.iter().filter(|p| p.header.share.number == number).map(name).collect::<Vec<_>>();
    let mut numbers: Vec<u32> = parts.iter().map(|p| p.header.share.number).collect();
    numbers.sort_unstable();
    numbers.dedup();
    for &number in &numbers {
        let doubled = holders(number);
        if doubled.len() > 1 {
            problems.push(format!("error: share {number}/{of} is there {} times: {}", doubled.len(), doubled.join(", ")));
        }
    }
    let missing: Vec<String> = (1..=of).filter(|n| !numbers.contains(n)).take(8).map(|n| format!("{n}/{of}")).collect();
    if !missing.is_empty() {
        let more = of as usize - numbers.len() - missing.len();
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        problems.push(format!("error: shares are missing: {}{more}", missing.join(", ")));
    }
    problems
}
