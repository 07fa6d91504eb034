//! What each rule saves, as JSON.
//!
//! Schema 1: `{"schema", "error", "seeds", "seed", "budget_seconds", "threads", "cpu_clock", "scenes": [{"scene", "title", "readings",
//! "planned": {cost}, "naive": {cost}, "again": {cost}, "rules": [{"rule", "terms", "acts", "planning_seconds", "without": {cost} or null}], "remarks"}],
//! "rules": [{"rule", "acts_in", "alone_in", "time_factor", "rays_saved"}], "not_studied": [{"scene", "why"}]}`. A cost is
//! `{"planning_seconds", "measuring_seconds", "how", "time_factor", "compared_at_error", "rays_saved", "rays", "samples", "bvh_nodes", "spectral_nodes"}`.

use serde::Serialize;

use super::SavingsReport;
use crate::study::converge::TimeTo;
use crate::study::savings::{Cost, RuleInScene, SceneSavings, Spread, Without, summary};

#[derive(Serialize)]
struct Document<'a> {
    schema: u32,
    error: f64,
    seeds: u64,
    seed: u64,
    budget_seconds: f64,
    threads: u64,
    cpu_clock: &'a str,
    scenes: Vec<Studied<'a>>,
    rules: Vec<Summed>,
    not_studied: Vec<NotStudied<'a>>,
}

#[derive(Serialize)]
struct Studied<'a> {
    scene: &'a str,
    title: &'a str,
    readings: usize,
    planned: Costs,
    naive: Costs,
    again: Costs,
    rules: Vec<Rule>,
    remarks: &'a [String],
}

#[derive(Serialize)]
struct Rule {
    rule: &'static str,
    terms: usize,
    acts: &'static str,
    planning_seconds: f64,
    without: Option<Costs>,
}

#[derive(Serialize)]
struct Costs {
    planning_seconds: f64,
    measuring_seconds: Option<f64>,
    how: &'static str,
    time_factor: Option<f64>,
    compared_at_error: Option<f64>,
    rays_saved: Option<f64>,
    rays: Option<f64>,
    samples: Option<f64>,
    bvh_nodes: u64,
    spectral_nodes: u64,
}

#[derive(Serialize)]
struct Summed {
    rule: &'static str,
    sentence: &'static str,
    acts_in: usize,
    alone_in: usize,
    time_factor: Option<Range>,
    rays_saved: Option<Range>,
    adds_to_planning_seconds: f64,
}

#[derive(Serialize)]
struct Range {
    least: f64,
    median: f64,
    largest: f64,
    scene: String,
}

#[derive(Serialize)]
struct NotStudied<'a> {
    scene: &'a str,
    why: &'a str,
}

/// How a time was found, in a word or two.
pub(super) fn how(time: &TimeTo) -> &'static str {
    match time {
        TimeTo::AtMost(_) => "at most",
        TimeTo::Interpolated(_) => "measured",
        TimeTo::Extrapolated(_) => "extrapolated",
        TimeTo::Unknown => "unknown",
    }
}

fn costs(cost: &Cost) -> Costs {
    Costs {
        planning_seconds: cost.planning_seconds,
        measuring_seconds: cost.measuring.seconds(),
        how: how(&cost.measuring),
        time_factor: cost.factor.map(|f| f.ratio),
        compared_at_error: cost.factor.map(|f| f.error),
        rays_saved: cost.rays_saved,
        rays: cost.rays,
        samples: cost.samples,
        bvh_nodes: cost.bvh_nodes,
        spectral_nodes: cost.spectral_nodes,
    }
}

fn rule(rule: &RuleInScene) -> Rule {
    let (acts, without) = match &rule.without {
        Without::Idle => ("no", None),
        Without::SameWork => ("same work", None),
        Without::Costs(cost) => ("yes", Some(costs(cost))),
    };
    Rule { rule: rule.rule, terms: rule.terms, acts, planning_seconds: rule.planning_seconds, without }
}

fn studied(scene: &SceneSavings) -> Studied<'_> {
    Studied {
        scene: &scene.name,
        title: &scene.title,
        readings: scene.readings,
        planned: costs(&scene.planned),
        naive: costs(&scene.naive),
        again: costs(&scene.again),
        rules: scene.rules.iter().map(rule).collect(),
        remarks: &scene.remarks,
    }
}

/// The report as JSON text, ending in a line break.
#[must_use]
pub fn to_json(report: &SavingsReport) -> String {
    let range = |s: Spread| Range { least: s.least, median: s.median, largest: s.largest, scene: s.scene };
    let rules = summary(&report.scenes).rules.into_iter().map(|r| Summed {
        rule: r.rule,
        sentence: r.sentence,
        acts_in: r.acts,
        alone_in: r.alone,
        time_factor: r.times.map(range),
        rays_saved: r.rays.map(range),
        adds_to_planning_seconds: r.planning_seconds,
    });
    let document = Document {
        schema: 1,
        error: report.options.error,
        seeds: report.options.ladder.seeds,
        seed: report.options.ladder.seed,
        budget_seconds: report.options.ladder.budget_seconds,
        threads: report.threads,
        cpu_clock: &report.cpu_clock,
        scenes: report.scenes.iter().map(studied).collect(),
        rules: rules.collect(),
        not_studied: report.failed.iter().map(|(scene, why)| NotStudied { scene, why }).collect(),
    };
    // Strings and numbers only: there is nothing that could not be written.
    let mut text = serde_json::to_string_pretty(&document).unwrap_or_default();
    text.push('\n');
    text
}
