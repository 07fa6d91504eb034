//! Noise of one reading of a photodiode, by cause, referred to the input.
//!
//! ```text
//! shot      √(2 q I B)
//! Johnson   √(4 k T B / R)
//! flicker   white density · √(f_c ln(B/f_0))        density white²(f) f_c/f from f_0 to B
//! steps     LSB/√12
//! ripple    what an integration leaves of flickering light, root mean square over its phase
//! ```

use super::{Photodiode, Range, Readout, ZERO_CELSIUS_K};
use crate::math::random::Stream;
use crate::metrology::distribution::normal_quantile;
use crate::quantity::constants::{BOLTZMANN_J_K, ELEMENTARY_CHARGE_C};

/// Why readings scatter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Noise {
    /// Photons come one by one.
    Shot,
    /// So do the charges of the dark current.
    DarkShot,
    /// Thermal noise of the feedback resistor.
    Johnson,
    /// Thermal noise of the shunt resistance.
    ShuntJohnson,
    /// 1/f noise.
    Flicker,
    /// Steps of the converter.
    Converter,
    /// Modulated light that the integration does not average out.
    Ripple,
}

impl Noise {
    /// In words, for a budget.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Noise::Shot => "shot noise of the light",
            Noise::DarkShot => "shot noise of the dark current",
            Noise::Johnson => "Johnson noise of the feedback",
            Noise::ShuntJohnson => "Johnson noise of the shunt",
            Noise::Flicker => "1/f noise",
            Noise::Converter => "steps of the converter",
            Noise::Ripple => "modulation of the light over the integration time",
        }
    }
}

/// Standard deviation of the current that a resistance makes in a bandwidth, A: `√(4 k T B / R)`.
fn johnson_a(temperature_k: f64, bandwidth_hz: f64, ohm: f64) -> f64 {
    (4.0 * BOLTZMANN_J_K * temperature_k * bandwidth_hz / ohm).sqrt()
}

/// Standard deviation of a current of single charges in a bandwidth, A: `√(2 q I B)`.
fn shot_a(current_a: f64, bandwidth_hz: f64) -> f64 {
    (2.0 * ELEMENTARY_CHARGE_C * current_a.max(0.0) * bandwidth_hz).sqrt()
}

impl Photodiode {
    pub(super) fn noise_a(&self, range: Range, photocurrent_a: f64) -> Vec<(Noise, f64)> {
        let (hertz, kelvin) = (self.bandwidth.hertz(), self.temperature_c + ZERO_CELSIUS_K);
        let mut noise = vec![
            (Noise::Shot, shot_a(photocurrent_a, hertz)),
            (Noise::DarkShot, shot_a(self.dark_a(), hertz)),
            (Noise::Johnson, johnson_a(kelvin, hertz, range.feedback_ohm)),
        ];
        noise.extend(self.shunt_ohm.map(|ohm| (Noise::ShuntJohnson, johnson_a(kelvin, hertz, ohm))));
        let white_a = noise.iter().map(|(_, a)| *a).fold(0.0, f64::hypot);
        if let Some(flicker) = self.flicker.filter(|flicker| flicker.lowest_hz < hertz) {
            let share = flicker.corner_hz / hertz * (hertz / flicker.lowest_hz).ln();
            noise.push((Noise::Flicker, white_a * share.sqrt()));
        }
        noise.extend(self.converter_step_a(range).map(|step| (Noise::Converter, step / 12f64.sqrt())));
        if let (Some(modulation), super::Bandwidth::Integration(seconds)) = (self.modulation, self.bandwidth) {
            noise.push((Noise::Ripple, photocurrent_a * modulation.ripple(seconds)));
        }
        noise.retain(|(_, a)| *a > 0.0);
        noise
    }
}

/// Noise of one reading before the converter, A: normal, but for the ripple, which has the phase that the seed gives.
pub(super) fn drawn_a(diode: &Photodiode, readout: &Readout, photocurrent_a: f64, seed: u64, path: &[u64]) -> f64 {
    let stream = Stream::new(seed, path);
    let normal_a = readout
        .noise_a
        .iter()
        .filter(|(cause, _)| !matches!(cause, Noise::Converter | Noise::Ripple))
        .map(|(_, a)| *a)
        .fold(0.0, f64::hypot);
    // The number lies inside (0, 1), where the quantile exists.
    let normal = normal_a * normal_quantile(stream.child(0).number()).unwrap_or(f64::NAN);
    let ripple = match (diode.modulation, diode.bandwidth) {
        (Some(modulation), super::Bandwidth::Integration(seconds)) => {
            photocurrent_a * (modulation.mean_over(stream.child(1).number(), seconds) - 1.0)
        }
        _ => 0.0,
    };
    normal + ripple
}
