//! What each rule saves over many scenes.

use super::{Factor, SceneSavings, Without};
use crate::plan::{choose, omit};

/// Least, median and largest of some numbers, and where the largest is from.
#[derive(Clone, Debug, PartialEq)]
pub struct Spread {
    /// The smallest.
    pub least: f64,
    /// The median; the mean of the middle two of an even number.
    pub median: f64,
    /// The largest.
    pub largest: f64,
    /// Name of the scene with the largest.
    pub scene: String,
}

/// A rule over all scenes.
#[derive(Clone, Debug, PartialEq)]
pub struct RuleSummary {
    /// Its name.
    pub rule: &'static str,
    /// What it observes.
    pub sentence: &'static str,
    /// Scenes in which it acts.
    pub acts: usize,
    /// Scenes in which no other rule would do the same.
    pub alone: usize,
    /// Factors of processor time in these.
    pub times: Option<Spread>,
    /// How the largest of them was found.
    pub largest: Option<Factor>,
    /// Shares of the rays in these, 1 for all.
    pub rays: Option<Spread>,
    /// Processor time that it adds to planning in the scene where that is most, s; zero if planning is faster with it everywhere.
    pub planning_seconds: f64,
}

/// All rules over all scenes.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// In the order of [`crate::plan::reading_rule_names`].
    pub rules: Vec<RuleSummary>,
    /// Factors of processor time of the naive plan.
    pub naive_times: Option<Spread>,
    /// Shares of its rays that are saved.
    pub naive_rays: Option<Spread>,
    /// Factors of the plan with all rules to itself.
    pub again_times: Option<Spread>,
}

/// Every rule with what it observes, in the order of [`crate::plan::reading_rule_names`].
#[must_use]
pub fn rule_sentences() -> Vec<(&'static str, &'static str)> {
    omit::RULES.iter().map(|r| (r.name, r.sentence)).chain(choose::CHOICES.iter().map(|c| (c.name, c.sentence))).collect()
}

/// Sums up.
#[must_use]
pub fn summary(scenes: &[SceneSavings]) -> Summary {
    let of = |(rule, sentence): (&'static str, &'static str)| {
        let cells: Vec<_> = scenes.iter().flat_map(|s| s.rules.iter().filter(|r| r.rule == rule).map(move |r| (s, r))).collect();
        let costs: Vec<_> =
            cells.iter().filter_map(|(s, r)| if let Without::Costs(c) = &r.without { Some((*s, c)) } else { None }).collect();
        let factors: Vec<(f64, &str)> = costs.iter().filter_map(|(s, c)| c.factor.map(|f| (f.ratio, s.name.as_str()))).collect();
        let largest = costs.iter().filter_map(|(_, c)| c.factor).max_by(|a, b| a.ratio.total_cmp(&b.ratio));
        let rays: Vec<(f64, &str)> = costs.iter().filter_map(|(s, c)| c.rays_saved.map(|r| (r, s.name.as_str()))).collect();
        RuleSummary {
            rule,
            sentence,
            acts: cells.iter().filter(|(_, r)| r.terms > 0).count(),
            alone: costs.len(),
            times: spread(factors),
            largest,
            rays: spread(rays),
            planning_seconds: cells.iter().map(|(s, r)| s.planned.planning_seconds - r.planning_seconds).fold(0.0, f64::max),
        }
    };
    let over_all = |of: fn(&SceneSavings) -> Option<f64>| spread(scenes.iter().filter_map(|s| Some((of(s)?, s.name.as_str()))).collect());
    Summary {
        rules: rule_sentences().into_iter().map(of).collect(),
        naive_times: over_all(|s| s.naive.factor.map(|f| f.ratio)),
        naive_rays: over_all(|s| s.naive.rays_saved),
        again_times: over_all(|s| s.again.factor.map(|f| f.ratio)),
    }
}

fn spread(mut values: Vec<(f64, &str)>) -> Option<Spread> {
    values.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (&(least, _), &(largest, scene)) = (values.first()?, values.last()?);
    let middle = values.len() / 2;
    let median = if values.len() % 2 == 1 { values[middle].0 } else { 0.5 * (values[middle - 1].0 + values[middle].0) };
    Some(Spread { least, median, largest, scene: scene.to_owned() })
}
