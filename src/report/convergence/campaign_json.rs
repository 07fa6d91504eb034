//! Error of a calibrated curve as JSON.
//!
//! Schema 1: `{"schema", "campaign", "file", "seed", "seeds", "budget_seconds", "threads", "cpu_clock", "ladders": [{"kind", "parameter", "rule",
//! "rungs": […], slopes, "claimed_over_true"}], "remarks"}`. Errors and uncertainties are over the peak of the curve.

use serde::Serialize;

use super::CampaignReport;
use crate::study::converge::PowerLaw;
use crate::study::converge::campaign::CampaignLadder;

#[derive(Serialize)]
struct Document<'a> {
    schema: u32,
    campaign: &'a str,
    file: &'a str,
    seed: u64,
    seeds: u64,
    budget_seconds: f64,
    threads: u64,
    cpu_clock: &'a str,
    ladders: Vec<Ladder>,
    remarks: &'a [String],
}

#[derive(Serialize)]
struct Ladder {
    kind: &'static str,
    parameter: &'static str,
    rule: &'static str,
    rungs: Vec<Rung>,
    slope_of_error: Option<Slope>,
    slope_of_claimed: Option<Slope>,
    slope_of_error_by_time: Option<Slope>,
    claimed_over_true: Option<f64>,
}

#[derive(Serialize)]
struct Rung {
    parameter: f64,
    exposures: usize,
    noise_factor: f64,
    samples: u64,
    seeds: u64,
    cpu_seconds: f64,
    wall_seconds: f64,
    error: f64,
    claimed: f64,
    share_within_95_percent_bands: f64,
    fits_that_say_they_do_not_hold: u64,
}

#[derive(Serialize)]
struct Slope {
    exponent: f64,
    standard_uncertainty: f64,
    rungs: usize,
}

fn slope(law: Option<&PowerLaw>) -> Option<Slope> {
    law.map(|l| Slope { exponent: l.exponent, standard_uncertainty: l.standard_uncertainty, rungs: l.points })
}

fn ladder(l: &CampaignLadder) -> Ladder {
    let rungs = l.rungs.iter().map(|r| Rung {
        parameter: r.parameter,
        exposures: r.exposures,
        noise_factor: r.noise_factor,
        samples: r.samples,
        seeds: r.seeds,
        cpu_seconds: r.cpu_seconds,
        wall_seconds: r.wall_seconds,
        error: r.error,
        claimed: r.claimed,
        share_within_95_percent_bands: r.within_95,
        fits_that_say_they_do_not_hold: r.told,
    });
    Ladder {
        kind: l.kind.name(),
        parameter: l.kind.parameter(),
        rule: l.kind.rule(),
        rungs: rungs.collect(),
        slope_of_error: slope(l.error_by_parameter.as_ref()),
        slope_of_claimed: slope(l.claimed_by_parameter.as_ref()),
        slope_of_error_by_time: slope(l.error_by_time.as_ref()),
        claimed_over_true: l.ratio,
    }
}

/// The report as JSON text, ending in a line break.
#[must_use]
pub fn campaign_to_json(report: &CampaignReport) -> String {
    let study = &report.study;
    let document = Document {
        schema: 1,
        campaign: &study.title,
        file: &report.file,
        seed: study.options.seed,
        seeds: study.options.seeds,
        budget_seconds: study.options.budget_seconds,
        threads: report.threads,
        cpu_clock: &report.cpu_clock,
        ladders: study.ladders.iter().map(ladder).collect(),
        remarks: &study.remarks,
    };
    // Strings and numbers only: there is nothing that could not be written.
    let mut text = serde_json::to_string_pretty(&document).unwrap_or_default();
    text.push('\n');
    text
}
