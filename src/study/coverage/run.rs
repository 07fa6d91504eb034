//! The runs of a scene: a first few that say what a run takes, the truth, then the others until all are done or the time is over.

use super::subset::subset;
use super::truth::{closed_forms, long_run};
use super::{CoverageOptions, CoverageRow, Run, Tally, Truth};
use crate::estimate::run::in_order;
use crate::estimate::{EstimateError, Stop, Watch};
use crate::measurement::{Measurement, measure};
use crate::plan::{Plan, PlanError, PlanOptions};
use crate::scene::{Layout, Scene};
use crate::study::StudyWatch;
use crate::study::converge::places;

/// Runs between two looks at the clock, and in the first round.
const CHUNK: u64 = 16;
/// Samples of the long run over those of a run, at most and at least.
const LONG_FACTORS: (u64, u64) = (128, 8);
/// Share of the time that the long run may take.
const LONG_SHARE: f64 = 0.4;

/// What came of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneCoverage {
    /// Title of the scene.
    pub title: String,
    /// Readings that formulas give; nothing is sampled there.
    pub exact: usize,
    /// The sampled readings.
    pub rows: Vec<CoverageRow>,
    /// Runs that were made, and how many were asked for.
    pub seeds: (u64, u64),
    /// Wall time of a run on all threads, s.
    pub seconds_per_run: f64,
    /// What a reader should know.
    pub remarks: Vec<String>,
}

/// Why there is no study.
#[derive(Clone, Debug, PartialEq)]
pub enum CoverageError {
    /// The scene cannot be planned: a rule that there is not.
    Plan(PlanError),
    /// The scene cannot be measured.
    Estimate(EstimateError),
}

impl std::fmt::Display for CoverageError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            CoverageError::Plan(e) => e.fmt(f),
            CoverageError::Estimate(e) => e.fmt(f),
        }
    }
}

impl std::error::Error for CoverageError {}

impl From<PlanError> for CoverageError {
    fn from(e: PlanError) -> CoverageError {
        CoverageError::Plan(e)
    }
}

impl From<EstimateError> for CoverageError {
    fn from(e: EstimateError) -> CoverageError {
        CoverageError::Estimate(e)
    }
}

/// Studies a scene.
///
/// # Errors
/// When a rule that is switched off does not exist, or the scene has no finite reading.
///
/// ```
/// use etendue::study::{StudyWatch, coverage};
/// use etendue::{plan, scene};
///
/// let scene = scene::scene_from_text(r#"Scene(
///     sources: [(name: "panel", shape: Disc(0.5), at: (0, 0, 1), facing: (0, 0, -1), strength: Radiance(1), spectrum: Line(555))],
///     instruments: [(name: "meter", at: (0, 0, 0), facing: (0, 0, 1),
///         sensor: Sensor(aperture: Point, acceptance: Cosine, channels: [(name: "E", responsivity: 1, reads: Irradiance)]))],
/// )"#)?;
/// let watch = StudyWatch { now: &|| 0.0, cpu: &|| 0.0, progress: &|_| {} };
/// let options = coverage::CoverageOptions { seeds: 40, ..Default::default() };
/// // The plan has a formula; the naive plan samples, and is held to it.
/// assert!(coverage::coverage(&scene, &plan::PlanOptions::default(), &options, &watch)?.rows.is_empty());
/// let naive = plan::PlanOptions { naive: true, ..Default::default() };
/// let found = coverage::coverage(&scene, &naive, &options, &watch)?;
/// assert_eq!((found.rows[0].runs, found.rows[0].verdict), (40, coverage::Verdict::Holds));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn coverage(
    scene: &Scene,
    how: &PlanOptions,
    options: &CoverageOptions,
    watch: &StudyWatch<'_>,
) -> Result<SceneCoverage, CoverageError> {
    let start = (watch.now)();
    let deadline = start + options.budget_seconds;
    let (scene, before) = subset(scene, options.most_poses);
    let plan = Plan::new(&scene, how)?;
    let mut remarks = Vec::new();
    for (instrument, before) in scene.instruments.iter().zip(before).filter(|(i, before)| i.poses.len() < *before) {
        remarks.push(format!("{}: {} poses of {before}, evenly spread over their order", instrument.name, instrument.poses.len()));
    }
    let one = runs(&scene, &plan, options, (0, 1), watch)?;
    let sampled: Vec<bool> = one[0].iter().map(|run| run.samples > 0).collect();
    let exact = sampled.iter().filter(|sampled| !**sampled).count();
    let mut found = SceneCoverage {
        title: scene.title.clone(),
        exact,
        rows: Vec::new(),
        seeds: (1, options.seeds),
        seconds_per_run: (watch.now)() - start,
        remarks,
    };
    if exact == sampled.len() {
        return Ok(found);
    }
    let first = (watch.now)();
    let mut done = runs(&scene, &plan, options, (0, CHUNK.min(options.seeds)), watch)?;
    let seconds = ((watch.now)() - first) / done.len() as f64;
    let truths = truths(&scene, &plan, options, (&done, &sampled, seconds), watch)?;
    let again = (watch.now)();
    let before = done.len();
    let mut last = 0.0;
    // A round takes as long as the last one.
    while (done.len() as u64) < options.seeds && (watch.now)() + last <= deadline {
        let round = (watch.now)();
        let from = done.len() as u64;
        done.extend(runs(&scene, &plan, options, (from, CHUNK.min(options.seeds - from)), watch)?);
        last = (watch.now)() - round;
        (watch.progress)(done.len() as f64 / options.seeds as f64);
    }
    found.seeds.0 = done.len() as u64;
    found.seconds_per_run = if done.len() > before { ((watch.now)() - again) / (done.len() - before) as f64 } else { seconds };
    found.rows = rows(&scene, options, &done, &sampled, &truths);
    Ok(found)
}

/// The readings of `count` runs from run `first` on.
fn runs(
    scene: &Scene,
    plan: &Plan,
    options: &CoverageOptions,
    (first, count): (u64, u64),
    watch: &StudyWatch<'_>,
) -> Result<Vec<Vec<Run>>, EstimateError> {
    let stop = Stop { target: Some(options.target), budget_seconds: None, samples: None };
    let seeds: Vec<u64> = (first..first + count).map(|run| options.seed.wrapping_add(1 + run)).collect();
    let measured = in_order(&seeds, |&seed| measure(scene, plan, &stop, seed, &Watch { now: watch.now, progress: &|_| {} }));
    measured.into_iter().map(|m| m.map(|m| of(&m))).collect()
}

fn of(measurement: &Measurement) -> Vec<Run> {
    let run = |r: &crate::measurement::Reading| Run {
        value: r.value,
        standard_uncertainty: r.standard_uncertainty(),
        expanded_uncertainty: r.expanded.expanded_uncertainty,
        samples: r.samples,
        target_met: r.target_met,
    };
    measurement.readings.iter().map(run).collect()
}

/// What each reading is held to: closed forms, and a long run where one of the sampled readings has none.
fn truths(
    scene: &Scene,
    plan: &Plan,
    options: &CoverageOptions,
    (done, sampled, seconds): (&[Vec<Run>], &[bool], f64),
    watch: &StudyWatch<'_>,
) -> Result<Vec<Truth>, CoverageError> {
    let closed = closed_forms(scene, &Plan::new(scene, &PlanOptions::default())?);
    if closed.iter().zip(sampled).all(|(closed, sampled)| closed.is_some() || !sampled) {
        let none = Truth { value: f64::NAN, standard_uncertainty: f64::NAN, origin: super::TruthOrigin::ClosedForm };
        return Ok(closed.into_iter().map(|truth| truth.unwrap_or(none)).collect());
    }
    let mean = |i: usize| done.iter().map(|run| run[i].samples as f64).sum::<f64>() / done.len() as f64;
    let means: Vec<f64> = (0..sampled.len()).map(mean).collect();
    let most = means.iter().copied().fold(0.0, f64::max);
    let all: f64 = means.iter().sum();
    let (mut factor, least) = LONG_FACTORS;
    // Every reading takes as many samples as the one that needs most.
    let cost = |factor: u64| factor as f64 * seconds * most * sampled.iter().filter(|s| **s).count() as f64 / all;
    while factor > least && cost(factor) > LONG_SHARE * options.budget_seconds {
        factor /= 2;
    }
    let samples = ((most * factor as f64) as u64).next_power_of_two();
    let long = long_run(scene, plan, samples, options.seed, watch.now)?;
    Ok(closed.into_iter().zip(long).map(|(closed, long)| closed.unwrap_or(long)).collect())
}

/// A row for each channel of each instrument that samples, the poses of a list or grid pooled.
fn rows(scene: &Scene, options: &CoverageOptions, done: &[Vec<Run>], sampled: &[bool], truths: &[Truth]) -> Vec<CoverageRow> {
    let places = places(scene);
    let mut rows = Vec::new();
    for instrument in &scene.instruments {
        for channel in &instrument.sensor.channels {
            let indices: Vec<usize> = (0..places.len())
                .filter(|&i| sampled[i] && places[i].instrument == instrument.name && places[i].channel == channel.name)
                .collect();
            // Poses of a short list are told apart.
            let groups: Vec<Vec<usize>> = match instrument.layout {
                Layout::List if indices.len() < options.most_poses => indices.into_iter().map(|i| vec![i]).collect(),
                _ => vec![indices],
            };
            for group in groups {
                let tallies: Vec<Tally> = group
                    .iter()
                    .map(|&i| {
                        let mut tally = Tally::new(truths[i], options.target);
                        done.iter().for_each(|run| tally.add(&run[i]));
                        tally
                    })
                    .collect();
                let name = match group[..] {
                    [only] => places[only].in_words(),
                    _ => format!("{}, {} ({} poses)", instrument.name, channel.name, group.len()),
                };
                rows.extend(CoverageRow::of(name, channel.reads.unit().to_owned(), &tallies));
            }
        }
    }
    rows
}
