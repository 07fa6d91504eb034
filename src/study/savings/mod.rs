//! What leaving out is worth: the cost of a reading with all rules of the plan, without each of them, and with none.
//!
//! ```text
//! cost         planning time + processor time until the true error stays below ε       (also rays and samples until then)
//! true error   √ mean over seeds and sampled readings of ((y − y_ref) / y_ref)²         (as `study::converge` has it)
//! saving       cost without the rule / cost with all rules
//! ```
//!
//! | a rule in a scene | what is measured |
//! |---|---|
//! | does not act | nothing: the plan is the same without it |
//! | acts, but another rule does the same when it is gone | nothing: the plan computes the same terms in the same way |
//! | acts alone | the plan without it |
//!
//! All plans of a scene are measured in one study, one after the other, and held to one reference. A plan of formulas alone has no
//! error; its time is that of a run. Where the lowest rung of 256 samples is good enough, its time stands for both.

mod summary;

pub use summary::{RuleSummary, Spread, Summary, rule_sentences, summary};

use super::StudyWatch;
use super::converge::{ConvergeError, ConvergeOptions, FIRST_SAMPLES, PlanConvergence, TimeTo, converge};
use crate::estimate::{Counters, EstimateError, Stop, Watch};
use crate::measurement::measure;
use crate::plan::{Plan, PlanError, PlanOptions, rule_names};
use crate::scene::Scene;

/// Plans are made anew until so many seconds or [`PLANNINGS`] are over.
const PLANNING_SECONDS: f64 = 5e-3;
/// Most plans that are made to time one.
const PLANNINGS: u32 = 64;

/// How to study.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SavingsOptions {
    /// True error whose cost is sought, relative.
    pub error: f64,
    /// As for [`converge`]; the budget is that of a scene.
    pub ladder: ConvergeOptions,
}

impl Default for SavingsOptions {
    fn default() -> SavingsOptions {
        SavingsOptions { error: 1e-3, ladder: ConvergeOptions::default() }
    }
}

/// What a reading costs.
#[derive(Clone, Debug, PartialEq)]
pub struct Cost {
    /// Processor time of planning, s.
    pub planning_seconds: f64,
    /// Processor time of measuring until the error is reached, s.
    pub measuring: TimeTo,
    /// Rays until then; `None` if not known.
    pub rays: Option<f64>,
    /// Samples over all contributions and poses until then; `None` if not known.
    pub samples: Option<f64>,
    /// Nodes of the bounding volume hierarchies that are searched.
    pub bvh_nodes: u64,
    /// Wavelengths that paths carry.
    pub spectral_nodes: u64,
}

impl Cost {
    /// Planning and measuring, s.
    #[must_use]
    pub fn seconds(&self) -> Option<f64> {
        self.measuring.seconds().map(|s| s + self.planning_seconds)
    }
}

/// A ratio of processor times.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factor {
    /// Time of the other plan over that of the plan with all rules.
    pub ratio: f64,
    /// One of them lies beyond the highest rung.
    pub extrapolated: bool,
    /// One of them is that of the lowest rung, which is better than asked for.
    pub lowest: bool,
}

/// What becomes of a plan when a rule is switched off.
#[derive(Clone, Debug, PartialEq)]
pub enum Without {
    /// The rule does not act.
    Idle,
    /// The rule acts, but others do the same without it.
    SameWork,
    /// The plan is another one.
    Costs(Cost),
}

/// A rule in a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct RuleInScene {
    /// Its name.
    pub rule: &'static str,
    /// Terms that it left out or made cheaper.
    pub terms: usize,
    /// Processor time of planning without it, s.
    pub planning_seconds: f64,
    /// What it saves.
    pub without: Without,
}

/// What the rules save in a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneSavings {
    /// What the scene is called: its file.
    pub name: String,
    /// Its title.
    pub title: String,
    /// Number of readings.
    pub readings: usize,
    /// With all rules.
    pub planned: Cost,
    /// Every rule, in the order of [`rule_names`].
    pub rules: Vec<RuleInScene>,
    /// With none.
    pub naive: Cost,
    /// What a reader should know.
    pub remarks: Vec<String>,
}

impl SceneSavings {
    /// How many times the processor time of the plan with all rules.
    #[must_use]
    pub fn time_factor(&self, other: &Cost) -> Option<Factor> {
        let ratio = other.seconds()? / self.planned.seconds().filter(|s| *s > 0.0)?;
        let either = |is: fn(&TimeTo) -> bool| is(&self.planned.measuring) || is(&other.measuring);
        Some(Factor {
            ratio,
            extrapolated: either(|t| matches!(t, TimeTo::Extrapolated(_))),
            lowest: either(|t| matches!(t, TimeTo::AtMost(_))),
        })
    }

    /// The share of the other plan's rays that all rules together do not trace; negative if they trace more. `None` if none are known.
    #[must_use]
    pub fn rays_saved(&self, other: &Cost) -> Option<f64> {
        Some(1.0 - self.planned.rays? / other.rays.filter(|rays| *rays > 0.0)?)
    }
}

/// Why there is nothing to tell of a scene.
#[derive(Clone, Debug, PartialEq)]
pub enum SavingsError {
    /// There is no plan.
    Plan(PlanError),
    /// The plans cannot be studied.
    Converge(ConvergeError),
}

impl std::fmt::Display for SavingsError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            SavingsError::Plan(e) => e.fmt(f),
            SavingsError::Converge(e) => e.fmt(f),
        }
    }
}

impl std::error::Error for SavingsError {}

impl From<PlanError> for SavingsError {
    fn from(e: PlanError) -> SavingsError {
        SavingsError::Plan(e)
    }
}

impl From<ConvergeError> for SavingsError {
    fn from(e: ConvergeError) -> SavingsError {
        SavingsError::Converge(e)
    }
}

impl From<EstimateError> for SavingsError {
    fn from(e: EstimateError) -> SavingsError {
        SavingsError::Converge(e.into())
    }
}

/// A plan, and how long it takes to make.
struct Timed {
    plan: Plan,
    seconds: f64,
}

fn planned(scene: &Scene, options: &PlanOptions, watch: &StudyWatch<'_>) -> Result<Timed, PlanError> {
    // The first is not timed: memory is cold.
    let mut plan = Plan::new(scene, options)?;
    let start = (watch.cpu)();
    let mut made = 0;
    while made < PLANNINGS && (made == 0 || (watch.cpu)() - start < PLANNING_SECONDS) {
        plan = Plan::new(scene, options)?;
        made += 1;
    }
    Ok(Timed { plan, seconds: ((watch.cpu)() - start) / f64::from(made) })
}

/// Studies what the rules save in a scene that is called `name`.
///
/// # Errors
/// When the scene cannot be measured, all its readings are zero, or the budget is too short for two runs of the lowest rung.
pub fn savings(name: &str, scene: &Scene, options: &SavingsOptions, watch: &StudyWatch<'_>) -> Result<SceneSavings, SavingsError> {
    let full = planned(scene, &PlanOptions::default(), watch)?;
    let naive = planned(scene, &PlanOptions { naive: true, without: Vec::new() }, watch)?;
    let mut without: Vec<(&'static str, Timed)> = Vec::new();
    for rule in rule_names() {
        without.push((rule, planned(scene, &PlanOptions { naive: false, without: vec![rule.to_owned()] }, watch)?));
    }
    let differs = |timed: &Timed| !timed.plan.same_work(&full.plan);
    let mut plans: Vec<(&str, &Plan)> = vec![("planned", &full.plan)];
    plans.extend(without.iter().filter(|(_, timed)| differs(timed)).map(|(rule, timed)| (*rule, &timed.plan)));
    plans.push(("naive", &naive.plan));
    let found = converge(scene, &plans, None, &options.ladder, watch)?;
    let mut costs = Vec::with_capacity(plans.len());
    for ((_, plan), convergence) in plans.iter().zip(&found.plans) {
        // Hierarchies and wavelengths do not depend on the samples.
        let stop = Stop { target: None, budget_seconds: None, samples: Some(FIRST_SAMPLES) };
        let measured = measure(scene, plan, &stop, options.ladder.seed, &Watch { now: watch.now, progress: &|_| {} })?;
        costs.push(cost(convergence, &measured.counters, options.error));
    }
    let mut costs = costs.into_iter();
    let mut next = |planning_seconds: f64| {
        let nothing = Cost { planning_seconds, measuring: TimeTo::Unknown, rays: None, samples: None, bvh_nodes: 0, spectral_nodes: 0 };
        costs.next().map_or(nothing, |cost| Cost { planning_seconds, ..cost })
    };
    let first = next(full.seconds);
    let rules = without.iter().map(|(rule, timed)| {
        let terms = full.plan.terms_by(rule);
        let without = match (differs(timed), terms) {
            (true, _) => Without::Costs(next(timed.seconds)),
            (false, 0) => Without::Idle,
            (false, _) => Without::SameWork,
        };
        RuleInScene { rule, terms, planning_seconds: timed.seconds, without }
    });
    let rules = rules.collect();
    Ok(SceneSavings {
        name: name.to_owned(),
        title: scene.title.clone(),
        readings: super::converge::places(scene).len(),
        planned: first,
        rules,
        naive: next(naive.seconds),
        remarks: found.remarks,
    })
}

/// What it costs a plan to reach an error, but for planning.
fn cost(found: &PlanConvergence, counters: &Counters, error: f64) -> Cost {
    let of_curve = |cost: fn(&super::converge::Rung) -> f64| {
        let curve = found.curves.first()?;
        // What is never counted up is known, too.
        if curve.rungs.iter().all(|rung| cost(rung) == 0.0) { Some(0.0) } else { curve.cost_to(error, cost).seconds() }
    };
    let measuring = match (&found.exact, found.curves.first()) {
        (Some(exact), _) => TimeTo::Interpolated(exact.cpu_seconds),
        (None, Some(curve)) => curve.cost_to(error, |rung| rung.cpu_seconds),
        (None, None) => TimeTo::Unknown,
    };
    let none = found.exact.is_some().then_some(0.0);
    Cost {
        planning_seconds: 0.0,
        measuring,
        rays: none.or_else(|| of_curve(|rung| rung.rays)),
        samples: none.or_else(|| of_curve(|rung| rung.samples_in_all)),
        bvh_nodes: counters.bvh_nodes,
        spectral_nodes: counters.spectral_nodes,
    }
}
