//! What a weighted channel indicates per unit of `∫ s(λ) E(λ) dλ`: the constant of its system, or what the meter was adjusted to.
//!
//! | written | scale |
//! |---|---|
//! | `Illuminance` | K, the constant of the system |
//! | `Illuminance(adjusted_with: "A")` | `K ∫S V dλ / ∫S s dλ`: true for that spectrum |
//! | `Illuminance(efficacy_lm_w: 683)` | as given |

use super::decode::{Fields, Value};
use super::document::{Body, Kind};
use super::reading::Reading;
use super::spectrum_reader::read_spectrum;
use crate::spectrum::Factor;

/// What a channel stands for: `k ∫ E curve dλ`.
pub(super) struct System {
    /// The weighting function.
    pub(super) curve: Factor,
    /// The constant of the system, per W.
    pub(super) per_watt: f64,
}

/// Scale of a luminous channel, photopic or scotopic, lm/W.
pub(super) fn read_luminous_scale(reads: &Value, system: &System, responsivity: Option<&Factor>, reading: &mut Reading) -> Option<f64> {
    if matches!(&reads.node.kind, Kind::Struct { body: Body::None, .. }) {
        return Some(system.per_watt);
    }
    let quantity = reads.name();
    let fields = reads.fields(&format!("`{quantity}`"), &["adjusted_with", "efficacy_lm_w"], &mut reading.problems)?;
    match (fields.get("adjusted_with"), fields.get("efficacy_lm_w")) {
        (Some(spectrum), None) => {
            let otherwise = "adjust with a spectrum such as \"A\", or give `efficacy_lm_w`";
            read_adjusted_scale(&spectrum, system, responsivity, otherwise, reading)
        }
        (None, Some(efficacy)) => efficacy.number_in("the efficacy", "above 0 lm/W", |x| x > 0.0, &mut reading.problems),
        (Some(_), Some(_)) => {
            reads.problem_at(
                &fields.key_span("efficacy_lm_w"),
                &mut reading.problems,
                "both `adjusted_with` and `efficacy_lm_w` are given",
                "keep one of them: each says what the meter indicates",
            );
            None
        }
        (None, None) => {
            reads.problem(
                &mut reading.problems,
                format!("`{quantity}()` says nothing about the adjustment"),
                format!("write `{quantity}`, `{quantity}(adjusted_with: \"A\")` or `{quantity}(efficacy_lm_w: 683)`"),
            );
            None
        }
    }
}

/// Scale of a channel that may say `adjusted_with`, else the constant of its system.
pub(super) fn read_optional_adjustment(
    fields: &Fields,
    system: &System,
    responsivity: Option<&Factor>,
    reading: &mut Reading,
) -> Option<f64> {
    match fields.get("adjusted_with") {
        Some(spectrum) => {
            let otherwise = "adjust with a spectrum such as \"D65\", or leave `adjusted_with` out";
            read_adjusted_scale(&spectrum, system, responsivity, otherwise, reading)
        }
        None => Some(system.per_watt),
    }
}

fn read_adjusted_scale(
    spectrum: &Value,
    system: &System,
    responsivity: Option<&Factor>,
    otherwise: &str,
    reading: &mut Reading,
) -> Option<f64> {
    let density = read_spectrum(spectrum, reading)?;
    let (truth, seen) = (density.integral(&[&system.curve]), density.integral(&[responsivity?]));
    if seen > 0.0 && truth > 0.0 {
        return Some(system.per_watt * (truth / seen));
    }
    let blind = if seen > 0.0 { "the eye" } else { "this responsivity" };
    spectrum.problem(&mut reading.problems, format!("a meter cannot be adjusted with a spectrum that {blind} does not see"), otherwise);
    None
}
