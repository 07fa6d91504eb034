//! Error against run time as JSON.
//!
//! Schema 1: `{"schema", "scene", "scene_file", "seed", "seeds", "budget_seconds", "threads", "cpu_clock", "reference": {…},
//! "plans": [{"name", "exact", "curves": [{"name", "readings", "rungs": […], slopes, "time_to": […]}]}], "gains": […], "remarks"}`.
//! Errors and uncertainties are relative. Numbers that are not finite are `null`.

use serde::Serialize;

use super::ConvergenceReport;
use crate::study::converge::{ErrorCurve, PlanConvergence, PowerLaw, Reference, ReferenceOrigin, TARGETS, TimeTo};

#[derive(Serialize)]
struct Document<'a> {
    schema: u32,
    scene: &'a str,
    scene_file: &'a str,
    seed: u64,
    seeds: u64,
    budget_seconds: f64,
    threads: u64,
    cpu_clock: &'a str,
    reference: Held<'a>,
    plans: Vec<Planned<'a>>,
    gains: Vec<Saved<'a>>,
    remarks: &'a [String],
}

#[derive(Serialize)]
struct Held<'a> {
    origin: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    name: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    seed: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    samples: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    cpu_seconds: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    wall_seconds: Option<f64>,
    values: Vec<f64>,
    standard_uncertainties: Vec<Option<f64>>,
}

#[derive(Serialize)]
struct Planned<'a> {
    name: &'a str,
    exact_readings: usize,
    exact: Option<Exact>,
    curves: Vec<Curve<'a>>,
}

#[derive(Serialize)]
struct Saved<'a> {
    other: &'a str,
    error: f64,
    factor: f64,
    measured: bool,
}

#[derive(Serialize)]
struct Exact {
    cpu_seconds: f64,
    wall_seconds: f64,
    runs: u64,
    claimed: f64,
    deviation: Option<f64>,
    deviation_in_u: Option<f64>,
}

#[derive(Serialize)]
struct Curve<'a> {
    name: &'a str,
    readings: usize,
    reference_uncertainty: f64,
    rungs: Vec<Rung>,
    slope_of_error_by_time: Option<Slope>,
    slope_of_error_by_samples: Option<Slope>,
    slope_of_claimed_by_time: Option<Slope>,
    claimed_over_true: Option<f64>,
    time_to: Vec<Time>,
}

#[derive(Serialize)]
struct Rung {
    samples: u64,
    samples_in_all: f64,
    seeds: u64,
    cpu_seconds: f64,
    wall_seconds: f64,
    rays: f64,
    error: f64,
    claimed: f64,
    reference_limits: bool,
}

#[derive(Serialize)]
struct Slope {
    exponent: f64,
    standard_uncertainty: f64,
    rungs: usize,
}

#[derive(Serialize)]
struct Time {
    error: f64,
    cpu_seconds: Option<f64>,
    how: &'static str,
}

fn slope(law: Option<&PowerLaw>) -> Option<Slope> {
    law.map(|l| Slope { exponent: l.exponent, standard_uncertainty: l.standard_uncertainty, rungs: l.points })
}

fn curve(c: &ErrorCurve) -> Curve<'_> {
    let rungs = c.rungs.iter().map(|r| Rung {
        samples: r.samples,
        samples_in_all: r.samples_in_all,
        seeds: r.seeds,
        cpu_seconds: r.cpu_seconds,
        wall_seconds: r.wall_seconds,
        rays: r.rays,
        error: r.error,
        claimed: r.claimed,
        reference_limits: r.reference_limits,
    });
    let how = |time: &TimeTo| match time {
        TimeTo::AtMost(_) => "at most",
        TimeTo::Interpolated(_) => "interpolated",
        TimeTo::Extrapolated(_) => "extrapolated",
        TimeTo::Unknown => "unknown",
    };
    Curve {
        name: &c.name,
        readings: c.readings,
        reference_uncertainty: c.reference_uncertainty,
        rungs: rungs.collect(),
        slope_of_error_by_time: slope(c.error_by_time.as_ref()),
        slope_of_error_by_samples: slope(c.error_by_samples.as_ref()),
        slope_of_claimed_by_time: slope(c.claimed_by_time.as_ref()),
        claimed_over_true: c.ratio,
        time_to: TARGETS.iter().zip(&c.times).map(|(&error, t)| Time { error, cpu_seconds: t.seconds(), how: how(t) }).collect(),
    }
}

fn planned(p: &PlanConvergence) -> Planned<'_> {
    let exact = p.exact.as_ref().map(|e| Exact {
        cpu_seconds: e.cpu_seconds,
        wall_seconds: e.wall_seconds,
        runs: e.runs,
        claimed: e.claimed,
        deviation: e.deviation.map(|d| d.0),
        deviation_in_u: e.deviation.map(|d| d.1).filter(|d| d.is_finite()),
    });
    Planned { name: &p.name, exact_readings: p.exact_readings, exact, curves: p.curves.iter().map(curve).collect() }
}

fn held(r: &Reference) -> Held<'_> {
    let mut held = Held {
        origin: "closed form",
        name: None,
        seed: None,
        samples: None,
        cpu_seconds: None,
        wall_seconds: None,
        values: r.values.iter().map(|v| v.value).collect(),
        standard_uncertainties: r.values.iter().map(|v| v.standard_uncertainty).collect(),
    };
    match &r.origin {
        ReferenceOrigin::ClosedForm => {}
        ReferenceOrigin::Given(name) => {
            held.origin = "given";
            held.name = Some(name);
        }
        ReferenceOrigin::LongRun { seed, samples, cpu_seconds, wall_seconds } => {
            held.origin = "long run";
            held.seed = Some(*seed);
            held.samples = Some(*samples);
            held.cpu_seconds = Some(*cpu_seconds);
            held.wall_seconds = Some(*wall_seconds);
        }
    }
    held
}

/// The report as JSON text, ending in a line break.
#[must_use]
pub fn to_json(report: &ConvergenceReport) -> String {
    let study = &report.study;
    let document = Document {
        schema: 1,
        scene: &study.scene,
        scene_file: &report.scene_file,
        seed: study.options.seed,
        seeds: study.options.seeds,
        budget_seconds: study.options.budget_seconds,
        threads: report.threads,
        cpu_clock: &report.cpu_clock,
        reference: held(&study.reference),
        plans: study.plans.iter().map(planned).collect(),
        gains: study.gains.iter().map(|g| Saved { other: &g.other, error: g.error, factor: g.factor, measured: g.measured }).collect(),
        remarks: &study.remarks,
    };
    // Strings and numbers only: there is nothing that could not be written.
    let mut text = serde_json::to_string_pretty(&document).unwrap_or_default();
    text.push('\n');
    text
}
