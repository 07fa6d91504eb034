//! Substitution: a reference detector in the place of the sensor measures the light of each exposure.
//!
//! ```text
//! yᵣᵢ = gᵣ pᵢ ∫ sᵣ Eᵣᵢ dλ + noise        pᵢ = yᵣᵢ / (gᵣ ∫ sᵣ Eᵣᵢ dλ)        Eᵢ → pᵢ Eᵢ
//! u²(pᵢ)/pᵢ² = u²(yᵣᵢ)/yᵣᵢ² + u²(stability)            of each exposure alone
//! u²(scale)  = u²(sᵣ)/sᵣ² + u²(alignment) + u²(rays)      common to all of them
//! ```
//!
//! | symbol | meaning | from |
//! |---|---|---|
//! | sᵣ, gᵣ | responsivity of the reference, A/W, and the area of its aperture | its sensor file |
//! | Eᵣᵢ, Eᵢ | irradiance of the reference and of the sensor under the nominal beam | the ray engine |
//! | pᵢ | power of the beam over nominal power | the readings yᵣᵢ |
//!
//! Whatever the power of the beam is, it cancels; what must be known is the shape of each spectrum, the reference, and that both detectors stand
//! in the same light. Where the uncertainty of sᵣ changes with wavelength, its one cause moves all exposures together, each by its share.
//!
//! Source: CIE 202 (2011), spectral responsivity measurement of detectors, the method of substitution.

use super::campaign::{self, CampaignError, ChannelReadings, Light, geometry_factor, normal, sought};
use crate::estimate::{Stop, Watch};
use crate::scene::{Calibration, Substitution};
use crate::sensor::ResponsivityUncertainty;
use crate::spectrum::Factor;

/// What the reference's readings are called in tables.
pub const REFERENCE: &str = "reference";
/// Keeps the random numbers of the reference apart from those of channels.
const REFERENCE_STREAM: u64 = u64::MAX - 2;
/// A reading below this many of its standard uncertainties gives no scale: ratios by it are no longer normal.
const LEAST: f64 = 10.0;

/// The light of the exposures, as the reference measured it.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredBeam {
    /// Title of the reference.
    pub reference: String,
    /// Its readings.
    pub readings: ChannelReadings,
    /// Power over nominal power, an exposure each.
    pub powers: Vec<f64>,
    /// Relative standard uncertainties of these, independent of each other.
    pub relative_uncertainties: Vec<f64>,
    /// Relative standard uncertainty that they have in common.
    pub scale_uncertainty: f64,
    /// Further causes that all exposures share: the relative error of each that one standard uncertainty makes.
    pub shared: Vec<Vec<f64>>,
}

/// The nominal light at the reference.
///
/// # Errors
/// [`CampaignError`].
pub fn light(
    calibration: &Calibration,
    reference: &Substitution,
    stop: &Stop,
    seed: u64,
    watch: &Watch<'_>,
) -> Result<Light, CampaignError> {
    let mut substituted = calibration.clone();
    substituted.bench.instruments[0].sensor = reference.sensor.clone();
    substituted.candidates.clear();
    campaign::light(&substituted, stop, seed, watch)
}

/// What the reference reads in the beam as it is, with noise, misplaced and wrong by as much as it is uncertain.
#[must_use]
pub fn simulated(calibration: &Calibration, reference: &Substitution, light: &Light, seed: u64) -> ChannelReadings {
    let channel = &reference.sensor.channels[0];
    let (curve, g) = (sought(channel), geometry_factor(&reference.sensor, channel));
    let drawn = |path: &[u64]| normal(seed, &[&[REFERENCE_STREAM], path].concat());
    let misplaced = 1.0 + reference.alignment * drawn(&[0]);
    let count = light.spectra.len();
    let (mut values, mut standard_uncertainties) = (Vec::with_capacity(count), Vec::with_capacity(count));
    for (i, (_, spectrum)) in light.spectra.iter().enumerate() {
        let read = g * spectrum.integral(&[&curve]);
        let wrong: f64 = channel
            .responsivity_uncertainty
            .iter()
            .enumerate()
            .map(|(k, u)| {
                let by = match u {
                    ResponsivityUncertainty::Relative(share) => share * read,
                    ResponsivityUncertainty::Curve(u) => g * channel.scale * spectrum.integral(&[u]),
                };
                by * drawn(&[1, k as u64])
            })
            .sum();
        let unsteady = 1.0 + reference.stability * drawn(&[2, i as u64]);
        let truth = reference.beam.power(i, count) * unsteady * misplaced * (read + wrong);
        let u = reference.noise.standard_uncertainty(truth, calibration.repeats);
        values.push(truth + u * drawn(&[3, i as u64]));
        standard_uncertainties.push(u);
    }
    ChannelReadings { channel: REFERENCE.to_owned(), measurand: channel.reads.clone(), values, standard_uncertainties }
}

/// The power of the beam in each exposure, from these readings of the reference.
///
/// # Errors
/// [`CampaignError::Reference`]: readings that are too uncertain.
pub fn measured(reference: &Substitution, light: &Light, readings: ChannelReadings) -> Result<MeasuredBeam, CampaignError> {
    let channel = &reference.sensor.channels[0];
    let (curve, g) = (sought(channel), geometry_factor(&reference.sensor, channel));
    let (mut powers, mut relative_uncertainties) = (Vec::new(), Vec::new());
    for ((label, spectrum), (&y, &u)) in light.spectra.iter().zip(readings.values.iter().zip(&readings.standard_uncertainties)) {
        let nominal = g * spectrum.integral(&[&curve]);
        if !(nominal > 0.0 && y.is_finite() && y > LEAST * u) {
            return Err(CampaignError::Reference { exposure: label.clone(), value: y, standard_uncertainty: u });
        }
        powers.push(y / nominal);
        relative_uncertainties.push((u / y).hypot(reference.stability));
    }
    let mut scale_uncertainty = reference.alignment.hypot(light.relative_uncertainty);
    let mut shared = Vec::new();
    for u in &channel.responsivity_uncertainty {
        match u {
            ResponsivityUncertainty::Relative(share) => scale_uncertainty = scale_uncertainty.hypot(*share),
            ResponsivityUncertainty::Curve(u) => shared.push(shares(light, u, channel.scale, &curve)),
        }
    }
    Ok(MeasuredBeam { reference: reference.sensor.title.clone(), readings, powers, relative_uncertainties, scale_uncertainty, shared })
}

/// By how much of itself each reading moves with this cause.
fn shares(light: &Light, u: &Factor, scale: f64, curve: &Factor) -> Vec<f64> {
    light.spectra.iter().map(|(_, spectrum)| scale * spectrum.integral(&[u]) / spectrum.integral(&[curve])).collect()
}
