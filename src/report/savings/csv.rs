//! What each rule saves, as CSV: a row a plan of each scene.
//!
//! | columns | |
//! |---|---|
//! | `scene`, `plan` | file; `planned`, the rule that is switched off, `naive`, or `planned again` |
//! | `acts` | `yes`, `no`, or `same work` where other rules do the same; empty but for rules |
//! | `terms` | that the rule left out or made cheaper |
//! | `planning_seconds`, `measuring_seconds`, `how` | processor time; how the latter was found |
//! | `time_factor`, `compared_at_error`, `rays_saved` | to the plan with all rules, at which error; 1 is all rays |
//! | `rays`, `samples`, `bvh_nodes`, `spectral_nodes` | until the error is reached |
//!
//! An empty cell is not known, or, where the plan is the one with all rules, not measured again.

use super::SavingsReport;
use super::json::how;
use crate::study::savings::{Cost, SceneSavings, Without};

const COLUMNS: [&str; 14] = [
    "scene",
    "plan",
    "acts",
    "terms",
    "planning_seconds",
    "measuring_seconds",
    "how",
    "time_factor",
    "compared_at_error",
    "rays_saved",
    "rays",
    "samples",
    "bvh_nodes",
    "spectral_nodes",
];

/// The report as CSV text.
#[must_use]
pub fn to_csv(report: &SavingsReport) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    // A vector takes whatever is written to it.
    let _ = writer.write_record(COLUMNS);
    for scene in &report.scenes {
        let _ = writer.write_record(measured(scene, "planned", ["", ""].map(str::to_owned), &scene.planned));
        for rule in &scene.rules {
            let terms = rule.terms.to_string();
            let _ = match &rule.without {
                Without::Costs(cost) => writer.write_record(measured(scene, rule.rule, ["yes".to_owned(), terms], cost)),
                Without::SameWork => writer.write_record(unmeasured(scene, rule.rule, "same work", &terms, rule.planning_seconds)),
                Without::Idle => writer.write_record(unmeasured(scene, rule.rule, "no", &terms, rule.planning_seconds)),
            };
        }
        let _ = writer.write_record(measured(scene, "naive", ["", ""].map(str::to_owned), &scene.naive));
        let _ = writer.write_record(measured(scene, "planned again", ["", ""].map(str::to_owned), &scene.again));
    }
    writer.into_inner().ok().and_then(|bytes| String::from_utf8(bytes).ok()).unwrap_or_default()
}

fn measured(scene: &SceneSavings, plan: &str, [acts, terms]: [String; 2], cost: &Cost) -> Vec<String> {
    let number = |x: Option<f64>| x.map_or(String::new(), |x| x.to_string());
    vec![
        scene.name.clone(),
        plan.to_owned(),
        acts,
        terms,
        cost.planning_seconds.to_string(),
        number(cost.measuring.seconds()),
        how(&cost.measuring).to_owned(),
        number(cost.factor.map(|f| f.ratio)),
        number(cost.factor.map(|f| f.error)),
        number(cost.rays_saved),
        number(cost.rays),
        number(cost.samples),
        cost.bvh_nodes.to_string(),
        cost.spectral_nodes.to_string(),
    ]
}

fn unmeasured(scene: &SceneSavings, rule: &str, acts: &str, terms: &str, planning_seconds: f64) -> Vec<String> {
    let mut row = vec![String::new(); COLUMNS.len()];
    row[0].clone_from(&scene.name);
    for (cell, written) in row[1..].iter_mut().zip([rule, acts, terms, &planning_seconds.to_string()]) {
        written.clone_into(cell);
    }
    row
}
