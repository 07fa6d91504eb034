//! Readings beyond the range in which the readout of the sensor is straight.
//!
//! A fit takes readings for linear in the light. If the sensor states its electronics, each reading is held against them: those that reach the limit of the
//! amplifier or the converter, and those that bend away from a straight line by more than their uncertainty, are told. Simulated readings are linear
//! all the same. A sensor without a readout states no range, and nothing is looked for.

use crate::characterization::campaign::ChannelReadings;
use crate::sensor::photodiode::Deviation;
use crate::sensor::{Channel, Sensor};

/// A reading this close below the limit, relatively, has reached it.
const AT_LIMIT: f64 = 1e-3;

/// What a reader should know of these readings; nothing if all lie in the straight range, or none is stated.
#[must_use]
pub fn beyond_range(sensor: &Sensor, channel: &Channel, readings: &ChannelReadings, labels: &[String]) -> Vec<String> {
    let Some((diode, a_per_unit)) = sensor.readout.as_ref().zip(sensor.photocurrent_per_unit_a(channel)) else { return Vec::new() };
    let (mut saturated, mut bent, mut most) = (Vec::new(), Vec::new(), 0.0f64);
    for (i, (y, u)) in readings.values.iter().zip(&readings.standard_uncertainties).enumerate() {
        let label = labels.get(i).map_or("", |label| label.as_str());
        let current_a = y * a_per_unit;
        if diode.readout(current_a * (1.0 + AT_LIMIT)).saturation.is_some() {
            saturated.push(label);
            continue;
        }
        let parts = diode.readout(current_a).deviations_a;
        let off: f64 = parts.iter().filter(|(cause, _)| *cause == Deviation::Nonlinearity).map(|(_, a)| a / a_per_unit).sum();
        if off.abs() > *u {
            bent.push(label);
            most = most.max((off / y).abs());
        }
    }
    let mut told = Vec::new();
    let few = |of: &[&str]| {
        let names: Vec<String> = of.iter().take(3).map(|label| format!("\"{label}\"")).collect();
        format!("{}{}", names.join(", "), if of.len() > 3 { format!(" and {} more", of.len() - 3) } else { String::new() })
    };
    if !saturated.is_empty() {
        told.push(format!(
            "{}: the readout of the sensor saturates at {}: the curve is too low there; use an `attenuator` or leave them out",
            readings.channel,
            few(&saturated)
        ));
    }
    if !bent.is_empty() {
        told.push(format!(
            "{}: the readout departs from a straight line by up to {:.2} %, more than the uncertainty of the reading, at {}; correct the readings, or use an \
             `attenuator`",
            readings.channel,
            100.0 * most,
            few(&bent)
        ));
    }
    told
}
