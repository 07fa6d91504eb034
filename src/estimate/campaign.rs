//! A run: every term of a plan, for every pose of every instrument, batch by batch.
//!
//! ```text
//! estimates = run(scene, plan, stop, seed; journal)        the journal knows pieces of work beforehand, and takes down the others
//! ```
//!
//! Poses are taken in batches, each with its share of the time; `batch.rs` says how many samples each takes.

use super::batch::Batch;
use super::journal::{Journal, Unrecorded};
use super::task::Task;
use super::{Counters, EstimateError, Estimates, Stop, Watch};
use crate::geometry::world::World;
use crate::plan::Plan;
use crate::scene::Scene;

/// Poses that are estimated together; bounds the memory for sums.
const BATCH: usize = 2048;
/// Estimates every term of a plan, for every pose of every instrument.
///
/// # Errors
/// When light is never absorbed.
pub fn estimate(scene: &Scene, plan: &Plan, stop: &Stop, seed: u64, watch: &Watch<'_>) -> Result<Estimates, EstimateError> {
    estimate_with(scene, plan, stop, seed, watch, &Unrecorded)
}

/// The same with a journal, which knows pieces of work beforehand and takes down the others.
///
/// # Errors
/// When light is never absorbed, when the journal is one of another run, or when pieces are missing that it does not want sampled.
pub fn estimate_with(
    scene: &Scene,
    plan: &Plan,
    stop: &Stop,
    seed: u64,
    watch: &Watch<'_>,
    journal: &dyn Journal,
) -> Result<Estimates, EstimateError> {
    match run(scene, plan, stop, seed, watch, journal)? {
        (_, Tally { missing, pieces }) if missing > 0 => Err(EstimateError::Incomplete { missing, pieces }),
        (estimates, _) => Ok(estimates),
    }
}

/// Samples those pieces of a run that a journal wants, and estimates nothing: a share of a run. Only a number of samples says
/// beforehand what the pieces are, so the run takes that many for each job and pose.
///
/// # Errors
/// When light is never absorbed, or when the journal is one of another run.
pub fn contribute(
    scene: &Scene,
    plan: &Plan,
    samples: u64,
    seed: u64,
    watch: &Watch<'_>,
    journal: &dyn Journal,
) -> Result<Tally, EstimateError> {
    let stop = Stop { target: None, budget_seconds: None, samples: Some(samples) };
    run(scene, plan, &stop, seed, watch, journal).map(|(_, tally)| tally)
}

/// Pieces of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// All of them.
    pub pieces: u64,
    /// Those that the journal neither knew nor wanted.
    pub missing: u64,
}

fn run(
    scene: &Scene,
    plan: &Plan,
    stop: &Stop,
    seed: u64,
    watch: &Watch<'_>,
    journal: &dyn Journal,
) -> Result<(Estimates, Tally), EstimateError> {
    let world = if plan.needs_rays { World::new(scene.elements.iter().map(|e| &e.shape)) } else { World::default() };
    let mut counters = Counters { bvh_nodes: world.bvh_nodes() as u64, ..Counters::default() };
    let all: usize = scene.instruments.iter().map(|i| i.poses.len()).sum();
    let start = (watch.now)();
    let mut done = 0;
    let mut tally = Tally::default();
    let mut rounds = Vec::new();
    let mut poses = Vec::with_capacity(scene.instruments.len());
    for (i, instrument) in scene.instruments.iter().enumerate() {
        let task = Task::new(scene, plan, &world, i);
        counters.spectral_nodes = counters.spectral_nodes.max(task.spectral_nodes());
        let mut results = Vec::with_capacity(instrument.poses.len());
        for first in (0..instrument.poses.len()).step_by(BATCH) {
            let indices: Vec<usize> = (first..instrument.poses.len().min(first + BATCH)).collect();
            let deadline = stop.budget_seconds.map(|b| start + b * (done + indices.len()) as f64 / all as f64);
            // A batch that is not listed was ended by no clock.
            let last_round = journal.rounds().map(|listed| listed.get(rounds.len()).copied().unwrap_or(u32::MAX));
            let batch = Batch { task: &task, stop, seed, watch, journal, deadline, last_round, done, poses: all };
            let batch = batch.run(&indices, &mut tally)?;
            done += indices.len();
            counters.add(&batch.counters);
            results.extend(batch.estimates);
            rounds.push(batch.rounds);
            (watch.progress)(done as f64 / all as f64);
        }
        poses.push(results);
    }
    Ok((Estimates { poses, counters, rounds, pieces: tally.pieces }, tally))
}
