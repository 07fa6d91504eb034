//! True error and claimed uncertainty against run time.
//!
//! ```text
//! rung k       N_k = 16 · 16 · 4^k samples, each with seeds of its own
//! true error   √ mean over seeds and readings of ((y − y_ref) / y_ref)²
//! claimed      √ mean over seeds and readings of (u_c / y_ref)²
//! slope        d ln error / d ln t, by least squares over the upper part of the ladder
//! ```
//!
//! | file | what |
//! |---|---|
//! | `ladder.rs` | measures, rung by rung, until its share of the time is over |
//! | `reference.rs` | what the readings are held to |
//! | `curve.rs` | errors of a set of readings against samples and time |
//! | `gain.rs` | what one plan saves against another |
//! | `power_law.rs` | slopes, and the time to an error |
//! | [`campaign`] | the same for calibrations: error of the curve against exposures, noise and run time |
//!
//! | who | share of the budget |
//! |---|---|
//! | reference given, or a closed form | all for the ladders, evenly |
//! | a long run as reference, one plan | a third for its ladder, the rest for the reference |
//! | the same with a second plan | a quarter for each ladder, the rest for the reference |
//!
//! Seeds of the rungs follow each other from `seed + 1`; the long run has `seed` itself, so that nothing is held to its own numbers.
//! Readings are the same bits for any number of threads, but how many rungs there are and how long the reference is depends on the
//! speed of the machine unless `most_samples` ends the ladder.

pub mod campaign;
mod curve;
mod gain;
mod ladder;
mod power_law;
mod reference;

pub use curve::{ErrorCurve, Rung};
pub use gain::Gain;
pub use ladder::ExactRun;
pub use power_law::{PowerLaw, TimeTo, fit, time_to};
pub use reference::{Place, Reference, ReferenceOrigin, ReferenceValue, places};

use super::StudyWatch;
use crate::estimate::EstimateError;
use crate::plan::Plan;
use crate::scene::Scene;
use ladder::{Climbed, climb};

/// Samples of the lowest rung: 16 replicates of 16 points.
pub const FIRST_SAMPLES: u64 = 256;
/// From one rung to the next.
pub const RUNG_FACTOR: u64 = 4;
/// Errors whose time is sought, relative.
pub const TARGETS: [f64; 3] = [1e-2, 1e-3, 1e-4];
/// A reference is good enough while its uncertainty is below this share of the error that is held to it.
pub const REFERENCE_SHARE: f64 = 1.0 / 3.0;
/// Fewest seeds that have a spread.
const LEAST_SEEDS: u64 = 2;
/// Samples of the long run over those of the highest rung, at least and at most.
const REFERENCE_FACTORS: (u64, u64) = (4, 256);

/// How to study.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConvergeOptions {
    /// Runs of each rung, 2 or more; fewer are made where the budget would not reach for three rungs of so many.
    pub seeds: u64,
    /// Seed of the long run; those of the rungs follow it.
    pub seed: u64,
    /// Wall time of the whole study, s.
    pub budget_seconds: f64,
    /// The ladder ends below this number of samples at the latest.
    pub most_samples: u64,
}

impl Default for ConvergeOptions {
    fn default() -> ConvergeOptions {
        ConvergeOptions { seeds: 8, seed: 0, budget_seconds: 20.0, most_samples: 1 << 32 }
    }
}

/// How a plan converges.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanConvergence {
    /// "planned" or "naive".
    pub name: String,
    /// If no reading needs a sample: there are no curves then.
    pub exact: Option<ExactRun>,
    /// All sampled readings together; then, if there is more than one, each channel of each instrument.
    pub curves: Vec<ErrorCurve>,
    /// Readings that formulas give, which are in no curve.
    pub exact_readings: usize,
}

/// What came of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct Convergence {
    /// Title of the scene.
    pub scene: String,
    /// How it was made.
    pub options: ConvergeOptions,
    /// What the readings are held to.
    pub reference: Reference,
    /// A plan each.
    pub plans: Vec<PlanConvergence>,
    /// What the first of them saves against the others.
    pub gains: Vec<Gain>,
    /// What a reader should know.
    pub remarks: Vec<String>,
}

/// Why there is no study.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ConvergeError {
    /// The scene cannot be measured.
    Estimate(EstimateError),
    /// The reference does not fit the scene, or cannot be divided by.
    Reference(String),
    /// The budget does not reach for two runs of the lowest rung and a reference.
    Budget(String),
    /// The campaign cannot be simulated or fitted.
    Campaign(String),
}

impl std::fmt::Display for ConvergeError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            ConvergeError::Estimate(e) => e.fmt(f),
            ConvergeError::Reference(what) | ConvergeError::Budget(what) | ConvergeError::Campaign(what) => f.write_str(what),
        }
    }
}

impl std::error::Error for ConvergeError {}

impl From<EstimateError> for ConvergeError {
    fn from(e: EstimateError) -> ConvergeError {
        ConvergeError::Estimate(e)
    }
}

/// Studies a scene: the first plan is the one in question, and gives the reference if none is given; others are held to the same.
///
/// # Errors
/// When the scene has no finite reading, the reference does not fit, or the budget is too short for anything.
///
/// ```
/// use etendue::study::{StudyWatch, converge};
/// use etendue::{plan, scene};
///
/// let scene = scene::scene_from_text(r#"Scene(
///     sources: [(name: "lamp", shape: Point, at: (0, 0, 2), strength: Candela(100), spectrum: "A")],
///     instruments: [(
///         name: "meter", at: (0, 0, 0), facing: (0, 0, 1),
///         sensor: Sensor(title: "ideal", aperture: Point, acceptance: Cosine,
///                        channels: [(name: "E_v", responsivity: "V", reads: Illuminance)]),
///     )],
/// )"#)?;
/// let plan = plan::Plan::new(&scene, &plan::PlanOptions::default())?;
/// let watch = StudyWatch { now: &|| 0.0, cpu: &|| 0.0, progress: &|_| {} };
/// let found = converge::converge(&scene, &[("planned", &plan)], None, &converge::ConvergeOptions::default(), &watch)?;
/// assert!(found.plans[0].exact.is_some() && found.plans[0].curves.is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn converge(
    scene: &Scene,
    plans: &[(&str, &Plan)],
    reference: Option<Reference>,
    options: &ConvergeOptions,
    watch: &StudyWatch<'_>,
) -> Result<Convergence, ConvergeError> {
    let start = (watch.now)();
    let places = places(scene);
    if let Some(given) = &reference {
        given.fits(&places)?;
    }
    let share = match (reference.is_some(), plans.len()) {
        (true, n) => 1.0 / n.max(1) as f64,
        (false, 1) => 1.0 / 3.0,
        (false, n) => 0.5 / n as f64,
    };
    let mut climbed: Vec<Climbed> = Vec::with_capacity(plans.len());
    for (name, plan) in plans {
        // A first plan that is exact is a reference that costs nothing.
        let free = reference.is_some() || climbed.first().is_some_and(|first| first.exact.is_some());
        let share = if free && reference.is_none() { 1.0 / (plans.len() - 1).max(1) as f64 } else { share };
        let deadline = (watch.now)() + share * options.budget_seconds;
        climbed.push(climb(scene, (name, plan), options, (start, deadline.min(start + options.budget_seconds)), free, watch)?);
    }
    let reference = match (reference, plans.first(), climbed.first()) {
        (Some(given), ..) => given,
        (None, Some((_, plan)), Some(first)) => reference::own(scene, plan, first, options, start, watch)?,
        _ => return Err(ConvergeError::Reference("there is no plan".to_owned())),
    };
    (watch.progress)(1.0);
    let mut remarks = Vec::new();
    let zeros = reference.values.iter().filter(|r| r.value == 0.0).count();
    if zeros == places.len() {
        return Err(ConvergeError::Reference("every value of the reference is zero: there is no relative error".to_owned()));
    }
    if zeros > 0 {
        remarks.push(format!("{zeros} of {} readings have a reference of zero, hence no relative error, and are left out", places.len()));
    }
    let mut found = Vec::with_capacity(climbed.len());
    for mut ladder in climbed {
        if ladder.seeds < options.seeds && ladder.exact.is_none() {
            remarks.push(format!("{}: {} seeds, not {}: the budget is too short for more", ladder.name, ladder.seeds, options.seeds));
        }
        if let Some(exact) = &mut ladder.exact
            && matches!(reference.origin, ReferenceOrigin::Given(_))
        {
            exact.hold_to(&reference);
        }
        let curves = curve::curves(&places, &ladder, &reference);
        let limited = curves.first().is_some_and(|all| all.rungs.iter().any(|r| r.reference_limits));
        if limited {
            remarks.push(format!(
                "{}: where the reference limits (*), its own uncertainty is more than a third of the error; these rungs are in no slope \
                 of the error",
                ladder.name
            ));
        }
        let exact_readings = ladder.sampled.iter().filter(|sampled| !**sampled).count();
        found.push(PlanConvergence { name: ladder.name, exact: ladder.exact, curves, exact_readings });
    }
    Ok(Convergence { scene: scene.title.clone(), options: *options, reference, gains: gain::gains(&found), plans: found, remarks })
}
