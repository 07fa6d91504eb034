//! What leaving out is worth: the cost of a reading with all rules of the plan, without each of them, and with none.
//!
//! ```text
//! cost         planning time + processor time until the true error stays below ε       (also rays and samples until then)
//! true error   √ mean over seeds and sampled readings of ((y − y_ref) / y_ref)²         (as `study::converge` has it)
//! saving       cost without the rule / cost with all rules, at ε or at the smallest error that both have reached
//! ```
//!
//! | a rule in a scene | what is measured |
//! |---|---|
//! | does not act | nothing: the plan is the same without it |
//! | acts, but another rule does the same when it is gone | nothing: the plan computes the same terms in the same way |
//! | acts alone | the plan without it |
//!
//! All plans of a scene are measured in one study, one after the other, and held to one reference. A plan of formulas alone has no
//! error; its time is that of a run. Where the lowest rung of 256 samples is good enough, its time stands for both. The plan with all rules is
//! measured twice, first and last: the factor between the two is one but for chance.

mod cost;
mod summary;

pub use summary::{RuleSummary, Spread, Summary, rule_sentences, summary};

use super::StudyWatch;
use super::converge::{ConvergeError, ConvergeOptions, FIRST_SAMPLES, TimeTo, converge};
use crate::estimate::{EstimateError, Stop, Watch};
use crate::measurement::measure;
use crate::plan::{Plan, PlanError, PlanOptions, reading_rule_names};
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
    /// Against the plan with all rules; `None` if there is no error that both reach.
    pub factor: Option<Factor>,
    /// The share of this plan's rays that all rules together do not trace, at the error of the factor; negative if they trace more. `None`
    /// if this plan traces none.
    pub rays_saved: Option<f64>,
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
    /// Time of the other plan over that of the plan with all rules, planning included.
    pub ratio: f64,
    /// The error that both reach: the one asked for, or the smallest that both reached where it is larger.
    pub error: f64,
    /// The other lies beyond its highest rung; the plan with all rules is exact.
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
    /// Every rule, in the order of [`reading_rule_names`].
    pub rules: Vec<RuleInScene>,
    /// With none.
    pub naive: Cost,
    /// With all rules once more: how far its factor is from one is how little a factor tells.
    pub again: Cost,
    /// What a reader should know.
    pub remarks: Vec<String>,
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
    for rule in reading_rule_names() {
        without.push((rule, planned(scene, &PlanOptions { naive: false, without: vec![rule.to_owned()] }, watch)?));
    }
    let again = planned(scene, &PlanOptions::default(), watch)?.seconds;
    let differs = |timed: &Timed| !timed.plan.same_work(&full.plan);
    let mut plans: Vec<(&str, &Plan)> = vec![("planned", &full.plan)];
    plans.extend(without.iter().filter(|(_, timed)| differs(timed)).map(|(rule, timed)| (*rule, &timed.plan)));
    plans.push(("naive", &naive.plan));
    plans.push(("planned again", &full.plan));
    let found = converge(scene, &plans, None, &options.ladder, watch)?;
    let Some(first) = found.plans.first() else { return Err(ConvergeError::Reference("there is no plan".to_owned()).into()) };
    let mut studied = plans.iter().zip(&found.plans);
    let mut next = |planning_seconds: f64| -> Result<Cost, SavingsError> {
        let Some((&(_, plan), convergence)) = studied.next() else {
            return Err(ConvergeError::Reference("there is no plan".to_owned()).into());
        };
        // Hierarchies and wavelengths do not depend on the samples.
        let stop = Stop { target: None, budget_seconds: None, samples: Some(FIRST_SAMPLES) };
        let measured = measure(scene, plan, &stop, options.ladder.seed, &Watch { now: watch.now, progress: &|_| {} })?;
        Ok(cost::cost((first, full.seconds), (convergence, planning_seconds), &measured.counters, options.error))
    };
    let all_rules = next(full.seconds)?;
    let mut rules = Vec::with_capacity(without.len());
    for (rule, timed) in &without {
        let terms = full.plan.terms_by(rule);
        let without = match (differs(timed), terms) {
            (true, _) => Without::Costs(next(timed.seconds)?),
            (false, 0) => Without::Idle,
            (false, _) => Without::SameWork,
        };
        rules.push(RuleInScene { rule, terms, planning_seconds: timed.seconds, without });
    }
    Ok(SceneSavings {
        name: name.to_owned(),
        title: scene.title.clone(),
        readings: super::converge::places(scene).len(),
        planned: all_rules,
        rules,
        naive: next(naive.seconds)?,
        again: next(again)?,
        remarks: found.remarks,
    })
}
