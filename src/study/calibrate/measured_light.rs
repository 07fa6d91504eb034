//! The light of the exposures, as a reference detector measured it.

use super::{CalibrateError, CalibrateOptions};
use crate::calibration::{FittedCurve, Readings, propagation};
use crate::characterization::campaign::ChannelReadings;
use crate::characterization::substitution::{self, MeasuredBeam};
use crate::estimate::Watch;
use crate::scene::Calibration;
use crate::spectrum::{Density, SpectrumError};

/// The light as the reference measured it; takes the reference's readings, the last ones, from those of a laboratory.
pub(super) fn beam(
    calibration: &Calibration,
    options: &CalibrateOptions,
    readings: &mut Vec<ChannelReadings>,
    watch: &Watch<'_>,
) -> Result<Option<MeasuredBeam>, CalibrateError> {
    let Some(reference) = &calibration.reference else { return Ok(None) };
    let light = substitution::light(calibration, reference, &options.stop, options.seed, watch)?;
    let channels = calibration.bench.instruments[0].sensor.channels.len();
    let given = (readings.len() > channels).then(|| readings.remove(channels));
    let read = given.unwrap_or_else(|| substitution::simulated(calibration, reference, &light, options.seed));
    Ok(Some(substitution::measured(reference, &light, read)?))
}

/// The spectra at these powers over nominal power.
pub(super) fn at_power(spectra: &[(String, Density)], powers: &[f64]) -> Result<Vec<(String, Density)>, SpectrumError> {
    spectra.iter().zip(powers).map(|((label, light), power)| Ok((label.clone(), light.scaled(*power)?))).collect()
}

/// Causes that move all readings together move the curve by `gain · (share ∘ readings)`.
pub(super) fn add_shared(curve: &mut FittedCurve, readings: &Readings, shared: &[Vec<f64>]) {
    for shares in shared {
        let moved: Vec<f64> = readings.values.iter().zip(shares).map(|(y, r)| y * r).collect();
        propagation::add_shared(curve, &moved);
    }
}

/// Readings per unit of what the geometry factor multiplies; how well the power of the beam is known is a part of their uncertainty.
pub(in crate::study) fn per_factor(readings: &ChannelReadings, factor: f64, beam: Option<&MeasuredBeam>) -> Readings {
    let power = |i: usize| beam.and_then(|beam| beam.relative_uncertainties.get(i)).copied().unwrap_or(0.0);
    let all = readings.values.iter().zip(&readings.standard_uncertainties).enumerate();
    Readings {
        channel: readings.channel.clone(),
        values: readings.values.iter().map(|y| y / factor).collect(),
        standard_uncertainties: all.map(|(i, (y, u))| u.hypot(y * power(i)) / factor).collect(),
    }
}
