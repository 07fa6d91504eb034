//! Measures rung by rung, until its share of the time is over.

use super::reference::Reference;
use super::{ConvergeError, ConvergeOptions, FIRST_SAMPLES, LEAST_SEEDS, REFERENCE_FACTORS, RUNG_FACTOR};
use crate::estimate::{EstimateError, Stop, Watch};
use crate::measurement::{Measurement, measure};
use crate::plan::Plan;
use crate::scene::Scene;
use crate::study::StudyWatch;

/// Runs of a plan that is exact, to time it.
const EXACT_RUNS: u64 = 32;
/// Most of the budget that they may take.
const EXACT_SHARE: f64 = 0.05;

/// A plan whose readings are all from formulas.
#[derive(Clone, Debug, PartialEq)]
pub struct ExactRun {
    /// The readings.
    pub values: Vec<f64>,
    /// Their u_c.
    pub standard_uncertainties: Vec<f64>,
    /// Mean processor time of a run, s.
    pub cpu_seconds: f64,
    /// Mean wall time of a run, s.
    pub wall_seconds: f64,
    /// Runs that were timed.
    pub runs: u64,
    /// Largest claimed uncertainty, relative.
    pub claimed: f64,
    /// Largest deviation from a reference that was given: relative, and over the joint standard uncertainty (infinite if that is zero).
    pub deviation: Option<(f64, f64)>,
}

impl ExactRun {
    /// Compares with a reference that was given. Readings whose reference is zero have no relative deviation.
    pub(super) fn hold_to(&mut self, reference: &Reference) {
        let mut worst = (0.0f64, 0.0f64);
        for ((value, u), held_to) in self.values.iter().zip(&self.standard_uncertainties).zip(&reference.values) {
            let deviation = (value - held_to.value).abs();
            let joint = u.hypot(held_to.standard_uncertainty.unwrap_or(0.0));
            if held_to.value != 0.0 {
                worst.0 = worst.0.max(deviation / held_to.value.abs());
            }
            if deviation > 0.0 {
                worst.1 = worst.1.max(deviation / joint);
            }
        }
        self.deviation = Some(worst);
    }
}

/// All runs of a rung.
pub(super) struct Runs {
    /// Samples a sampled contribution and pose.
    pub(super) samples: u64,
    /// `values[seed][reading]`.
    pub(super) values: Vec<Vec<f64>>,
    /// Sum over the seeds of u_c², a reading each.
    pub(super) squared_uncertainties: Vec<f64>,
    /// Means of a run.
    pub(super) cpu_seconds: f64,
    pub(super) wall_seconds: f64,
    pub(super) rays: f64,
    pub(super) samples_in_all: f64,
}

/// A ladder that was climbed.
pub(super) struct Climbed {
    pub(super) name: String,
    pub(super) seeds: u64,
    pub(super) exact: Option<ExactRun>,
    /// Whether a reading takes samples.
    pub(super) sampled: Vec<bool>,
    pub(super) rungs: Vec<Runs>,
}

/// Measures with a number of samples; the share of the budget that is used up is told meanwhile.
pub(super) fn run(
    scene: &Scene,
    plan: &Plan,
    (samples, seed): (u64, u64),
    (start, budget_seconds): (f64, f64),
    watch: &StudyWatch<'_>,
) -> Result<Measurement, EstimateError> {
    let stop = Stop { target: None, budget_seconds: None, samples: Some(samples) };
    let progress = |_: f64| (watch.progress)((((watch.now)() - start) / budget_seconds).clamp(0.0, 1.0));
    measure(scene, plan, &stop, seed, &Watch { now: watch.now, progress: &progress })
}

/// Climbs until the deadline; `start` is when the study began.
pub(super) fn climb(
    scene: &Scene,
    (name, plan): (&str, &Plan),
    options: &ConvergeOptions,
    (start, deadline): (f64, f64),
    reference_is_known: bool,
    watch: &StudyWatch<'_>,
) -> Result<Climbed, ConvergeError> {
    let budget = (start, options.budget_seconds);
    let began = (watch.now)();
    // Untimed but for its order of magnitude: memory and caches are cold.
    let first = run(scene, plan, (FIRST_SAMPLES, options.seed), budget, watch)?;
    let seconds = (watch.now)() - began;
    let sampled: Vec<bool> = first.readings.iter().map(|r| r.samples > 0).collect();
    if !sampled.contains(&true) {
        let exact = Some(exact(scene, plan, &first, options, start, watch)?);
        return Ok(Climbed { name: name.to_owned(), seeds: 0, exact, sampled, rungs: Vec::new() });
    }
    let share = deadline - began;
    let least = LEAST_SEEDS + if reference_is_known { 0 } else { REFERENCE_FACTORS.0 };
    let left = start + options.budget_seconds - (watch.now)();
    if least as f64 * seconds > left {
        return Err(ConvergeError::Budget(format!(
            "the budget of {} s is too short: a run of the {name} plan with {FIRST_SAMPLES} samples takes {seconds:.2} s, and a study \
             needs {least} times that; give at least {:.0} s",
            options.budget_seconds,
            (options.budget_seconds - left + 1.5 * least as f64 * seconds).ceil()
        )));
    }
    // Three rungs cost 1 + 4 + 16 runs a seed.
    let three = (1 + RUNG_FACTOR + RUNG_FACTOR * RUNG_FACTOR) as f64 * seconds;
    let affordable = if three > 0.0 { (share / three) as u64 } else { options.seeds };
    let seeds = affordable.clamp(LEAST_SEEDS, options.seeds.max(LEAST_SEEDS));
    let mut rungs: Vec<Runs> = Vec::new();
    let mut samples = FIRST_SAMPLES;
    let mut seed = options.seed;
    loop {
        let begun = (watch.now)();
        let cpu = (watch.cpu)();
        let mut runs = Runs {
            samples,
            values: Vec::with_capacity(seeds as usize),
            squared_uncertainties: vec![0.0; sampled.len()],
            cpu_seconds: 0.0,
            wall_seconds: 0.0,
            rays: 0.0,
            samples_in_all: 0.0,
        };
        for _ in 0..seeds {
            seed = seed.wrapping_add(1);
            let measured = run(scene, plan, (samples, seed), budget, watch)?;
            for (sum, reading) in runs.squared_uncertainties.iter_mut().zip(&measured.readings) {
                *sum += reading.standard_uncertainty().powi(2);
            }
            runs.rays += measured.counters.rays as f64 / seeds as f64;
            runs.samples_in_all += measured.counters.samples as f64 / seeds as f64;
            runs.values.push(measured.readings.iter().map(|r| r.value).collect());
        }
        let took = (watch.now)() - begun;
        runs.wall_seconds = took / seeds as f64;
        runs.cpu_seconds = ((watch.cpu)() - cpu) / seeds as f64;
        rungs.push(runs);
        let next = samples.saturating_mul(RUNG_FACTOR);
        if next > options.most_samples || (watch.now)() + RUNG_FACTOR as f64 * took > deadline {
            break;
        }
        samples = next;
    }
    Ok(Climbed { name: name.to_owned(), seeds, exact: None, sampled, rungs })
}

fn exact(
    scene: &Scene,
    plan: &Plan,
    first: &Measurement,
    options: &ConvergeOptions,
    start: f64,
    watch: &StudyWatch<'_>,
) -> Result<ExactRun, EstimateError> {
    let (wall, cpu) = ((watch.now)(), (watch.cpu)());
    let mut runs = 0;
    while runs < EXACT_RUNS && (runs == 0 || (watch.now)() - wall < EXACT_SHARE * options.budget_seconds) {
        run(scene, plan, (FIRST_SAMPLES, options.seed), (start, options.budget_seconds), watch)?;
        runs += 1;
    }
    let relative = first.readings.iter().filter(|r| r.value != 0.0).map(|r| r.standard_uncertainty() / r.value.abs());
    Ok(ExactRun {
        values: first.readings.iter().map(|r| r.value).collect(),
        standard_uncertainties: first.readings.iter().map(crate::measurement::Reading::standard_uncertainty).collect(),
        cpu_seconds: ((watch.cpu)() - cpu) / runs as f64,
        wall_seconds: ((watch.now)() - wall) / runs as f64,
        runs,
        claimed: relative.fold(0.0, f64::max),
        deviation: None,
    })
}
