//! Numbers and rows that the tables share.

use super::SavingsReport;
use crate::metrology::rounding::format_significant;
use crate::study::converge::TimeTo;
use crate::study::savings::{Cost, Factor, RuleSummary, SceneSavings, Spread, Summary, Without};

/// What the marks of the cells mean.
pub(super) const LEGEND: [(&str, &str); 6] = [
    ("–", "the rule does not act: the plan is the same without it"),
    ("=", "the rule acts, but others do the same when it is gone"),
    ("~", "extrapolated beyond the highest rung by the fitted slope"),
    ("≤", "the lowest rung, 256 samples for each sampled contribution and pose, is good enough; its time and rays stand"),
    ("*", "compared at the smallest error that both plans reached, for the one asked for is beyond the budget"),
    ("?", "not known: the error does not clearly fall within the budget"),
];

pub(super) const RULE_HEAD: [&str; 11] = [
    "rule",
    "acts in",
    "alone in",
    "time: least",
    "median",
    "largest",
    "in",
    "rays saved: least",
    "median",
    "largest",
    "adds to planning at most",
];

pub(super) const PLAN_HEAD: [&str; 10] =
    ["scene", "plan", "terms", "planning", "in all", "factor", "rays", "samples", "BVH nodes", "spectral nodes"];

/// The row of each rule, then that of all together.
pub(super) fn rule_rows(summary: &Summary, scenes: usize, asked: f64) -> Vec<Vec<String>> {
    let row = |name: &str, acts: usize, alone: usize, times: Option<&Spread>, largest: String, rays: Option<&Spread>, planning: String| {
        let number =
            |spread: Option<&Spread>, of: fn(&Spread) -> f64, how: fn(f64) -> String| spread.map_or("–".to_owned(), |s| how(of(s)));
        vec![
            name.to_owned(),
            acts.to_string(),
            alone.to_string(),
            number(times, |s| s.least, ratio),
            number(times, |s| s.median, ratio),
            largest,
            times.map_or("–".to_owned(), |s| short(&s.scene)),
            number(rays, |s| s.least, percent),
            number(rays, |s| s.median, percent),
            number(rays, |s| s.largest, percent),
            planning,
        ]
    };
    let of = |r: &RuleSummary| {
        let largest = r.largest.map_or("–".to_owned(), |f| factor(&f, asked));
        row(r.rule, r.acts, r.alone, r.times.as_ref(), largest, r.rays.as_ref(), time(r.planning_seconds))
    };
    let mut rows: Vec<Vec<String>> = summary.rules.iter().map(of).collect();
    let largest = summary.naive_times.as_ref().map_or("–".to_owned(), |s| ratio(s.largest));
    rows.push(row("all together", scenes, scenes, summary.naive_times.as_ref(), largest, summary.naive_rays.as_ref(), "–".to_owned()));
    rows
}

/// The row of each plan of a scene.
pub(super) fn plan_rows(scene: &SceneSavings, asked: f64) -> Vec<Vec<String>> {
    let row = |plan: String, terms: String, cost: &Cost| {
        let mark = mark(&cost.measuring);
        vec![
            short(&scene.name),
            plan,
            terms,
            time(cost.planning_seconds),
            cost.seconds().map_or("?".to_owned(), |s| format!("{mark}{}", time(s))),
            cost.factor.map_or("?".to_owned(), |f| factor(&f, asked)),
            cost.rays.map_or("?".to_owned(), |n| counted(mark, n)),
            cost.samples.map_or("?".to_owned(), |n| counted(mark, n)),
            cost.bvh_nodes.to_string(),
            cost.spectral_nodes.to_string(),
        ]
    };
    let mut rows = vec![row("all rules".to_owned(), String::new(), &scene.planned)];
    rows.extend(scene.rules.iter().filter_map(|rule| match &rule.without {
        Without::Costs(cost) => Some(row(format!("without {}", rule.rule), rule.terms.to_string(), cost)),
        _ => None,
    }));
    rows.push(row("naive".to_owned(), String::new(), &scene.naive));
    rows.push(row("all rules again".to_owned(), String::new(), &scene.again));
    rows
}

/// The factors of a scene: the same plan again, naive, then every rule.
pub(super) fn factor_row(scene: &SceneSavings, asked: f64) -> Vec<String> {
    let of = |cost: &Cost| cost.factor.map_or("?".to_owned(), |f| factor(&f, asked));
    let mark = mark(&scene.planned.measuring);
    let all = scene.planned.seconds().map_or("?".to_owned(), |s| format!("{mark}{}", time(s)));
    let mut row = vec![short(&scene.name), scene.readings.to_string(), all, of(&scene.again), of(&scene.naive)];
    row.extend(scene.rules.iter().map(|rule| match &rule.without {
        Without::Idle => "–".to_owned(),
        Without::SameWork => "=".to_owned(),
        Without::Costs(cost) => of(cost),
    }));
    row
}

/// What was asked for and how, in sentences.
pub(super) fn method(report: &SavingsReport) -> String {
    let threads = if report.threads == 1 { "1 thread".to_owned() } else { format!("{} threads", report.threads) };
    format!(
        "Cost: planning, and processor time until the true error stays below {}: relative, RMS over {} seeds (fewer where the budget is short) \
         and all sampled readings, as `etendue converge` has it. Not the expanded uncertainty. Factors: time of the other plan over that with all \
         rules, all plans of a scene in one run, held to one reference; budget {} a scene, {threads}. {}.",
        percent(report.options.error),
        report.options.ladder.seeds,
        time(report.options.ladder.budget_seconds),
        report.cpu_clock
    )
}

/// How little a factor tells.
pub(super) fn chance(summary: &Summary) -> String {
    summary.again_times.as_ref().map_or(String::new(), |s| {
        format!(
            "The plan with all rules, measured twice in each scene, takes {} to {} its own time (median {}): factors within this range tell nothing.",
            ratio(s.least),
            ratio(s.largest),
            ratio(s.median)
        )
    })
}

/// A scene by its file, without folder `scenes` and extension.
pub(super) fn short(name: &str) -> String {
    let inside = name.rsplit_once("scenes/").map_or(name, |(_, inside)| inside);
    inside.strip_suffix(".ron").unwrap_or(inside).to_owned()
}

fn mark(time: &TimeTo) -> &'static str {
    match time {
        TimeTo::AtMost(_) => "≤ ",
        TimeTo::Extrapolated(_) => "~ ",
        TimeTo::Interpolated(_) | TimeTo::Unknown => "",
    }
}

pub(super) fn factor(factor: &Factor, asked: f64) -> String {
    let mark = match (factor.extrapolated, factor.lowest) {
        (true, _) => "~ ",
        (false, true) => "≤ ",
        (false, false) => "",
    };
    let coarser = if factor.error > asked { " *" } else { "" };
    format!("{mark}{}{coarser}", ratio(factor.ratio))
}

fn ratio(x: f64) -> String {
    format!("{} ×", format_significant(x, if (100.0..1000.0).contains(&x) { 3 } else { 2 }))
}

/// A share; what is not all is never rounded to all.
pub(super) fn percent(share: f64) -> String {
    if share < 1.0 && share > 0.9999 { "> 99.99 %".to_owned() } else { format!("{} %", trimmed(100.0 * share)) }
}

fn trimmed(x: f64) -> String {
    let written = format_significant(x, 3);
    if written.contains('.') && !written.contains('e') { written.trim_end_matches('0').trim_end_matches('.').to_owned() } else { written }
}

fn counted(mark: &str, n: f64) -> String {
    if n == 0.0 { "0".to_owned() } else { format!("{mark}{}", format_significant(n, 2)) }
}

pub(super) fn time(seconds: f64) -> String {
    let (scale, unit) = match seconds {
        s if s >= 1.0 || s == 0.0 => (1.0, "s"),
        s if s >= 1e-3 => (1e3, "ms"),
        _ => (1e6, "µs"),
    };
    format!("{} {unit}", format_significant(seconds * scale, 3))
}
