//! A calibration as JSON.
//!
//! Schema 1: `{"schema", "title", "sensor", "simulated", "seed", "prior", "reference", "wavelengths_nm", "channels": […], "colours": […], "suggestions": […], "remarks"}`. What
//! is not known or not finite is `null`.

use serde::Serialize;

use crate::calibration::consistency::Outlier;
use crate::calibration::parametric_fit::{self, Parametric};
use crate::study::calibrate::propagate::Propagated;
use crate::study::calibrate::{Calibrated, CalibratedChannel};

#[derive(Serialize)]
struct Document<'a> {
    schema: u32,
    version: &'static str,
    title: &'a str,
    sensor: &'a str,
    simulated: bool,
    seed: u64,
    samples: u64,
    prior: &'a str,
    length_nm: Option<f64>,
    relative_scale_uncertainty: f64,
    reference: Option<Reference<'a>>,
    wavelengths_nm: &'a [f64],
    exposures: &'a [String],
    channels: Vec<Channel<'a>>,
    /// Mean ΔE*ab of a chart, a lamp each; none but of three channels.
    colours: Vec<Use<'a>>,
    suggestions: Vec<Suggested<'a>>,
    remarks: &'a [String],
}

#[derive(Serialize)]
struct Reference<'a> {
    name: &'a str,
    reading_unit: &'a str,
    readings: &'a [f64],
    reading_standard_uncertainty: &'a [f64],
    beam_over_nominal: &'a [f64],
    beam_relative_uncertainty: &'a [f64],
}

#[derive(Serialize)]
struct Channel<'a> {
    name: &'a str,
    reads: &'a str,
    reading_unit: &'a str,
    curve_unit: &'a str,
    responsivity: &'a [f64],
    standard_uncertainty: &'a [f64],
    /// What `standard_uncertainty` is multiplied by for a band that holds all determined nodes at once with 95 %.
    simultaneous_factor_95: Option<f64>,
    undetermined_share: &'a [f64],
    truth: Option<&'a [f64]>,
    not_determined_nm: &'a [(f64, f64)],
    chi_squared: f64,
    readings_count: usize,
    effective_parameters: f64,
    model: Option<Modelled<'a>>,
    readings: &'a [f64],
    reading_standard_uncertainty: &'a [f64],
    residuals_in_u: &'a [f64],
    /// Against the curve of all other readings; `null` where no other reading tells.
    studentised_residuals: &'a [Option<f64>],
    studentised_limit: f64,
    weights: &'a [f64],
    outliers: Vec<Contradicting<'a>>,
    contradictions: Vec<Pair<'a>>,
    outside_of_curve: Option<f64>,
    uses: Vec<Use<'a>>,
}

#[derive(Serialize)]
struct Modelled<'a> {
    parameters: Vec<Parameter<'a>>,
    degrees_of_freedom: usize,
    uncertainties_widened_by: f64,
}

#[derive(Serialize)]
struct Parameter<'a> {
    name: &'a str,
    unit: &'a str,
    value: f64,
    standard_uncertainty: f64,
    determined: bool,
}

fn modelled<'a>(fit: &'a Parametric, curve_unit: &'a str) -> Modelled<'a> {
    let of = |p: &'a parametric_fit::Parameter| Parameter {
        name: &p.name,
        unit: if p.unit.is_empty() { curve_unit } else { p.unit },
        value: p.value,
        standard_uncertainty: p.standard_uncertainty,
        determined: p.determined,
    };
    Modelled {
        parameters: fit.parameters.iter().map(of).collect(),
        degrees_of_freedom: fit.degrees_of_freedom,
        uncertainties_widened_by: fit.widening,
    }
}

#[derive(Serialize)]
struct Contradicting<'a> {
    exposure: &'a str,
    reading: f64,
    expected: f64,
    studentised: f64,
    in_u: f64,
}

#[derive(Serialize)]
struct Pair<'a> {
    exposures: &'a [String; 2],
    readings: [f64; 2],
    in_u: f64,
}

#[derive(Serialize)]
struct Use<'a> {
    name: &'a str,
    value: Option<f64>,
    standard_uncertainty: Option<f64>,
    monte_carlo_standard_uncertainty: Option<f64>,
    monte_carlo_mean: Option<f64>,
    truth: Option<f64>,
}

#[derive(Serialize)]
struct Suggested<'a> {
    exposure: &'a str,
    expected_error_before: f64,
    expected_error_after: f64,
}

fn used(q: &Propagated) -> Use<'_> {
    let finite = |x: f64| Some(x).filter(|x| x.is_finite());
    Use {
        name: &q.name,
        value: finite(q.value),
        standard_uncertainty: finite(q.standard_uncertainty),
        monte_carlo_standard_uncertainty: finite(q.monte_carlo),
        monte_carlo_mean: finite(q.monte_carlo_mean),
        truth: q.truth.and_then(finite),
    }
}

fn contradicting(o: &Outlier) -> Contradicting<'_> {
    Contradicting { exposure: &o.label, reading: o.reading, expected: o.expected, studentised: o.studentised, in_u: o.in_u }
}

fn channel(c: &CalibratedChannel) -> Channel<'_> {
    Channel {
        name: &c.readings.channel,
        reads: c.readings.measurand.name(),
        reading_unit: c.readings.measurand.unit(),
        curve_unit: &c.unit,
        responsivity: &c.curve.values,
        standard_uncertainty: &c.standard_uncertainties,
        simultaneous_factor_95: c.simultaneous,
        undetermined_share: &c.curve.undetermined,
        truth: c.truth.as_deref(),
        not_determined_nm: &c.unseen_nm,
        chi_squared: c.curve.chi_squared,
        readings_count: c.readings.values.len(),
        effective_parameters: c.curve.effective_parameters,
        model: c.curve.parametric.as_ref().map(|fit| modelled(fit, &c.unit)),
        readings: &c.readings.values,
        reading_standard_uncertainty: &c.readings.standard_uncertainties,
        residuals_in_u: &c.curve.residuals,
        studentised_residuals: &c.curve.consistency.studentised,
        studentised_limit: c.curve.consistency.limit,
        weights: &c.curve.weights,
        outliers: c.curve.consistency.outliers.iter().map(contradicting).collect(),
        contradictions: (c.curve.consistency.contradictions.iter())
            .map(|p| Pair { exposures: &p.labels, readings: p.readings, in_u: p.in_u })
            .collect(),
        outside_of_curve: c.outside.as_ref().map(|o| o.0),
        uses: c.uses.iter().map(used).collect(),
    }
}

/// Everything as JSON text, ending in a line break.
#[must_use]
pub fn to_json(calibrated: &Calibrated) -> String {
    let document = Document {
        schema: 1,
        version: env!("CARGO_PKG_VERSION"),
        title: &calibrated.title,
        sensor: &calibrated.sensor,
        simulated: calibrated.simulated,
        seed: calibrated.seed,
        samples: calibrated.samples,
        prior: &calibrated.prior.0,
        length_nm: Some(calibrated.prior.1).filter(|length| length.is_finite()),
        relative_scale_uncertainty: calibrated.scale_uncertainty,
        reference: calibrated.beam.as_ref().map(|beam| Reference {
            name: &beam.reference,
            reading_unit: beam.readings.measurand.unit(),
            readings: &beam.readings.values,
            reading_standard_uncertainty: &beam.readings.standard_uncertainties,
            beam_over_nominal: &beam.powers,
            beam_relative_uncertainty: &beam.relative_uncertainties,
        }),
        wavelengths_nm: &calibrated.nodes_nm,
        exposures: &calibrated.labels,
        channels: calibrated.channels.iter().map(channel).collect(),
        colours: calibrated.colours.iter().map(used).collect(),
        suggestions: calibrated
            .suggestions
            .iter()
            .map(|s| Suggested { exposure: &s.label, expected_error_before: s.before, expected_error_after: s.after })
            .collect(),
        remarks: &calibrated.remarks,
    };
    let mut text = serde_json::to_string_pretty(&document).unwrap_or_default();
    text.push('\n');
    text
}
