//! A verification as JSON.
//!
//! ```text
//! {"schema", "passed", "seconds", "groups": [{"name", "title", "cases", "agree", "fail", "wait", "behaviours", "largest_of_limit", …}], "parts": […],
//!  "cases": [{"id", "title", "quantity", "unit", "verdict", "reference", "tolerance", "reading", "standard_uncertainty", "expanded_uncertainty",
//!             "samples", "deviation", "relative_deviation", "deviation_in_u", "deviation_in_limits", "reason", "seconds"}]}
//! ```
//!
//! Numbers keep all their digits; what there is none of is null.

use serde::Serialize;

use crate::study::verify::{Check, Summary, Verification};

#[derive(Serialize)]
struct SummaryWords {
    name: String,
    title: String,
    cases: usize,
    agree: usize,
    fail: usize,
    wait: usize,
    behaviours: usize,
    largest_of_limit: Option<f64>,
    largest_of_limit_case: Option<String>,
    largest_in_u: Option<f64>,
    largest_in_u_case: Option<String>,
    seconds: f64,
}

impl From<Summary> for SummaryWords {
    fn from(of: Summary) -> Self {
        let (largest_of_limit, largest_of_limit_case) = of.largest.clone().unzip();
        let (largest_in_u, largest_in_u_case) = of.largest_in_u.clone().unzip();
        SummaryWords {
            cases: of.cases(),
            name: of.name,
            title: of.title,
            agree: of.agree,
            fail: of.fail,
            wait: of.wait,
            behaviours: of.behaviours,
            largest_of_limit,
            largest_of_limit_case,
            largest_in_u,
            largest_in_u_case,
            seconds: of.seconds,
        }
    }
}

#[derive(Serialize)]
struct CaseWords<'a> {
    id: &'a str,
    group: &'a str,
    part: &'a str,
    title: &'a str,
    quantity: &'a str,
    unit: &'a str,
    verdict: &'static str,
    reference: Option<f64>,
    tolerance: Option<f64>,
    reading: Option<f64>,
    standard_uncertainty: Option<f64>,
    expanded_uncertainty: Option<f64>,
    samples: Option<u64>,
    deviation: Option<f64>,
    relative_deviation: Option<f64>,
    deviation_in_u: Option<f64>,
    deviation_in_limits: Option<f64>,
    reason: Option<&'a str>,
    seconds: f64,
}

fn case(check: &Check) -> CaseWords<'_> {
    let found = check.found();
    CaseWords {
        id: &check.id,
        group: &check.group,
        part: &check.part,
        title: &check.title,
        quantity: &check.quantity,
        unit: &check.unit,
        verdict: check.word(),
        reference: check.reference,
        tolerance: check.reference.map(|_| check.tolerance),
        reading: found.map(|found| found.value),
        standard_uncertainty: found.and_then(|found| found.standard_uncertainty),
        expanded_uncertainty: found.and_then(|found| found.expanded_uncertainty),
        samples: found.map(|found| found.samples),
        deviation: check.deviation(),
        relative_deviation: check.relative_deviation(),
        deviation_in_u: check.deviation_in_u(),
        deviation_in_limits: check.deviation_in_limits(),
        reason: check.reason(),
        seconds: check.seconds,
    }
}

#[derive(Serialize)]
struct Document<'a> {
    schema: u32,
    passed: bool,
    seconds: f64,
    groups: Vec<SummaryWords>,
    parts: Vec<SummaryWords>,
    cases: Vec<CaseWords<'a>>,
}

/// The verification as JSON text.
#[must_use]
pub fn to_json(of: &Verification) -> String {
    let document = Document {
        schema: 1,
        passed: of.passed(),
        seconds: of.seconds,
        groups: of.groups().into_iter().map(SummaryWords::from).collect(),
        parts: of.parts().into_iter().map(SummaryWords::from).collect(),
        cases: of.checks.iter().map(case).collect(),
    };
    // Strings and numbers only: there is nothing that could not be written; a number that is none becomes null.
    let mut text = serde_json::to_string_pretty(&document).unwrap_or_default();
    text.push('\n');
    text
}
