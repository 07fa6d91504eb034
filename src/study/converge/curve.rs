//! Errors of a set of readings against samples and time.

use std::collections::BTreeSet;

use super::ladder::{Climbed, Runs};
use super::power_law::{PowerLaw, TimeTo, fit, time_to, upper_part};
use super::reference::{Place, Reference};
use super::{REFERENCE_SHARE, RUNG_FACTOR, TARGETS};

/// A rung of the ladder.
#[derive(Clone, Debug, PartialEq)]
pub struct Rung {
    /// Samples a sampled contribution and pose.
    pub samples: u64,
    /// Samples of a run over all contributions, poses and instruments.
    pub samples_in_all: f64,
    /// Runs, each with its own seed.
    pub seeds: u64,
    /// Mean processor time of a run, s.
    pub cpu_seconds: f64,
    /// Mean wall time of a run, s.
    pub wall_seconds: f64,
    /// Mean number of rays of a run.
    pub rays: f64,
    /// True error: RMS over seeds and readings, relative to the reference.
    pub error: f64,
    /// Claimed standard uncertainty u_c: RMS over seeds and readings, relative to the reference.
    pub claimed: f64,
    /// Whether the reference is too uncertain to tell the error.
    pub reference_limits: bool,
}

impl Rung {
    /// Claimed over true.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        self.claimed / self.error
    }
}

/// How a set of readings converges.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorCurve {
    /// "all readings", or instrument and channel.
    pub name: String,
    /// Readings in the set that are sampled and have a relative error.
    pub readings: usize,
    /// Standard uncertainty of the reference, RMS over the readings, relative.
    pub reference_uncertainty: f64,
    /// From few samples to many.
    pub rungs: Vec<Rung>,
    /// Error against processor time.
    pub error_by_time: Option<PowerLaw>,
    /// Error against samples.
    pub error_by_samples: Option<PowerLaw>,
    /// Claimed uncertainty against processor time.
    pub claimed_by_time: Option<PowerLaw>,
    /// Claimed over true, geometric mean over the rungs of the slopes of the error.
    pub ratio: Option<f64>,
    /// Processor time to each of [`TARGETS`].
    pub times: [TimeTo; 3],
}

/// The curves of a ladder: all sampled readings, then each channel of each instrument if there is more than one.
pub(super) fn curves(places: &[Place], ladder: &Climbed, reference: &Reference) -> Vec<ErrorCurve> {
    let usable = |i: &usize| ladder.sampled[*i] && reference.values[*i].value != 0.0;
    let all: Vec<usize> = (0..places.len()).filter(usable).collect();
    if all.is_empty() {
        return Vec::new();
    }
    let mut sets: Vec<(String, Vec<usize>)> = Vec::new();
    // Readings of an instrument follow each other: the search from behind is short.
    for &i in &all {
        let name = format!("{}, {}", places[i].instrument, places[i].channel);
        match sets.iter_mut().rev().find(|(known, _)| *known == name) {
            Some((_, set)) => set.push(i),
            None => sets.push((name, vec![i])),
        }
    }
    if sets.len() > 1 {
        sets.insert(0, ("all readings".to_owned(), all));
    }
    sets.into_iter().map(|(name, set)| curve(name, &set, places, ladder, reference)).collect()
}

fn curve(name: String, set: &[usize], places: &[Place], ladder: &Climbed, reference: &Reference) -> ErrorCurve {
    let relative = |i: usize| reference.values[i].standard_uncertainty.unwrap_or(0.0) / reference.values[i].value;
    let reference_uncertainty = rms(set.iter().map(|&i| relative(i)));
    let rungs: Vec<Rung> = ladder.rungs.iter().map(|runs| rung(runs, set, reference, reference_uncertainty)).collect();
    // The RMS of n independent normal errors scatters by 1/√(2n); channels of one pose share their samples.
    let poses: BTreeSet<(&str, usize)> = set.iter().map(|&i| (places[i].instrument.as_str(), places[i].index)).collect();
    let scatter = (0.5 / (ladder.seeds as f64 * poses.len() as f64)).sqrt();
    let told: Vec<&Rung> = rungs.iter().filter(|r| !r.reference_limits && r.error > 0.0).collect();
    let claiming: Vec<&Rung> = rungs.iter().filter(|r| r.claimed > 0.0).collect();
    let upper = |rungs: Vec<&'_ Rung>| -> Vec<Rung> {
        let seconds: Vec<f64> = rungs.iter().map(|r| r.cpu_seconds).collect();
        rungs[upper_part(&seconds, RUNG_FACTOR as f64)..].iter().map(|r| (*r).clone()).collect()
    };
    let (told, claiming) = (upper(told), upper(claiming));
    let by =
        |rungs: &[Rung], x: fn(&Rung) -> f64, y: fn(&Rung) -> f64| fit(&rungs.iter().map(|r| (x(r), y(r))).collect::<Vec<_>>(), scatter);
    let error_by_samples = by(&told, |r| r.samples as f64, |r| r.error);
    let logarithms: Vec<f64> = told.iter().map(|r| r.ratio().ln()).filter(|l| l.is_finite()).collect();
    let mut curve = ErrorCurve {
        name,
        readings: set.len(),
        reference_uncertainty,
        error_by_time: by(&told, |r| r.cpu_seconds, |r| r.error),
        claimed_by_time: by(&claiming, |r| r.cpu_seconds, |r| r.claimed),
        ratio: (!logarithms.is_empty()).then(|| (logarithms.iter().sum::<f64>() / logarithms.len() as f64).exp()),
        times: [TimeTo::Unknown; 3],
        error_by_samples,
        rungs,
    };
    curve.times = TARGETS.map(|target| curve.cost_to(target, |rung| rung.cpu_seconds));
    curve
}

impl ErrorCurve {
    /// The rungs whose error is known, as (samples, processor seconds, error).
    #[must_use]
    pub fn known(&self) -> Vec<(f64, f64, f64)> {
        let told = self.rungs.iter().filter(|r| !r.reference_limits && r.error > 0.0);
        told.map(|r| (r.samples as f64, r.cpu_seconds, r.error)).collect()
    }

    /// The rungs that tell whether an error is reached: those whose error is known, and those where the reference hides it although
    /// error and reference together stay within.
    pub fn telling(&self, error: f64) -> impl Iterator<Item = (&Rung, f64)> {
        self.rungs.iter().filter_map(move |rung| {
            let at_most = rung.error.hypot(self.reference_uncertainty);
            match (rung.reference_limits || rung.error == 0.0, at_most <= error) {
                (false, _) => Some((rung, rung.error)),
                (true, true) => Some((rung, at_most.max(f64::MIN_POSITIVE))),
                (true, false) => None,
            }
        })
    }

    /// What it costs to reach an error: `cost` of a rung, taken like the time of [`time_to`].
    #[must_use]
    pub fn cost_to(&self, error: f64, cost: impl Fn(&Rung) -> f64) -> TimeTo {
        let rungs: Vec<(f64, f64, f64)> = self.telling(error).map(|(r, e)| (r.samples as f64, cost(r), e)).collect();
        time_to(error, &rungs, self.error_by_samples.as_ref())
    }
}

fn rung(runs: &Runs, set: &[usize], reference: &Reference, reference_uncertainty: f64) -> Rung {
    let held_to = |i: usize| reference.values[i].value;
    let error = rms(runs.values.iter().flat_map(|values| set.iter().map(|&i| (values[i] - held_to(i)) / held_to(i))));
    let seeds = runs.values.len() as f64;
    let claimed = rms(set.iter().map(|&i| (runs.squared_uncertainties[i] / seeds).sqrt() / held_to(i)));
    Rung {
        samples: runs.samples,
        samples_in_all: runs.samples_in_all,
        seeds: runs.values.len() as u64,
        cpu_seconds: runs.cpu_seconds,
        wall_seconds: runs.wall_seconds,
        rays: runs.rays,
        error,
        claimed,
        reference_limits: reference_uncertainty > REFERENCE_SHARE * error,
    }
}

/// Root of the mean square; zero of nothing.
fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let (mut sum, mut count) = (0.0, 0u64);
    for value in values {
        sum += value * value;
        count += 1;
    }
    if count == 0 { 0.0 } else { (sum / count as f64).sqrt() }
}
