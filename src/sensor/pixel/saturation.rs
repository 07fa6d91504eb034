//! Where a pixel ends: hard limit, clipped noise, variance peak; and where it begins: the absolute threshold.
//!
//! ```text
//! μ_e.hard = min(W − μ_I t, (2^b − 1 − y₀)/K − μ_d)            the well or the ADC, whichever is first
//! μ_p.min  = (½ + √(σ² + ¼)) / η,   σ² = σ_y.dark²/K²          SNR = 1 solved exactly
//! SNR_max  = √μ_e.sat,   DR = μ_e.sat / (η μ_p.min)
//!
//! X ~ N(m, s²) clipped above at c,  z = (c − m)/s:
//! ⟨X⟩ = m − s (φ(z) − z Φ(−z)),   Var X = s² (Φ(z) − z φ(z) + z² Φ(−z) − (φ(z) − z Φ(−z))²)
//! ```
//!
//! The saturation of EMVA 1288 is where the temporal variance is largest. It lies about 3 s below the hard limit, because the upper half
//! of the noise is clipped first: [`LinearModel::saturation_e`] finds it for N(μ, μ + σ_d²).
//!
//! Source: EMVA Standard 1288, release 4.0, 2.4 to 2.6; the clipped normal by integration by parts.

use super::LinearModel;
use crate::metrology::distribution::{normal_cumulative, normal_density};

/// Where the search for the variance peak stops, relative to the hard limit.
const PEAK_ACCURACY: f64 = 1e-12;
/// The peak lies within so many standard deviations below the hard limit.
const PEAK_REACH: f64 = 40.0;

/// Mean and variance of a normal variable of the given `mean` and `variance`, of which what is above `limit` is put at `limit`.
#[must_use]
pub fn clipped_normal(mean: f64, variance: f64, limit: f64) -> (f64, f64) {
    if variance <= 0.0 {
        return (mean.min(limit), 0.0);
    }
    let deviation = variance.sqrt();
    let z = (limit - mean) / deviation;
    let (density, above) = (normal_density(z), normal_cumulative(-z));
    // Mean excess over the limit in standard deviations, above zero.
    let excess = density - z * above;
    let relative = normal_cumulative(z) - z * density + z * z * above - excess * excess;
    (mean - deviation * excess, variance * relative.max(0.0))
}

impl LinearModel {
    /// Photo-electrons at which a noiseless signal stops rising: the well is full or the ADC at its end, e⁻; 0 where the dark signal alone
    /// does it.
    #[must_use]
    pub fn hard_limit_e(&self) -> f64 {
        self.well_limit_e().min(self.adc_limit_e()).max(0.0)
    }

    /// Photo-electrons that fill the well, e⁻.
    #[must_use]
    pub fn well_limit_e(&self) -> f64 {
        self.pixel.full_well_e - self.thermal_e
    }

    /// Photo-electrons that reach the largest digital number, e⁻.
    #[must_use]
    pub fn adc_limit_e(&self) -> f64 {
        (self.pixel.largest_dn() - self.pixel.black_dn) / self.pixel.gain_dn_per_e - self.mean_dark_e()
    }

    /// Temporal variance, e⁻², of `electrons_e` photo-electrons with all noise clipped at the hard limit, without quantisation.
    #[must_use]
    pub fn clipped_variance_e2(&self, electrons_e: f64) -> f64 {
        clipped_normal(electrons_e, electrons_e + self.dark_variance_e2(), self.hard_limit_e()).1
    }

    /// Photo-electrons at which the clipped temporal variance is largest, e⁻: the saturation capacity μ_e.sat of EMVA 1288.
    ///
    /// By golden section; one peak lies between the hard limit and 40 standard deviations below it.
    #[must_use]
    pub fn saturation_e(&self) -> f64 {
        let hard = self.hard_limit_e();
        let (mut low, mut high) = ((hard - PEAK_REACH * (hard + self.dark_variance_e2()).sqrt()).max(0.0), hard);
        let ratio = 0.5 * (5f64.sqrt() - 1.0);
        let inner = |low: f64, high: f64| (high - ratio * (high - low), low + ratio * (high - low));
        let (mut a, mut b) = inner(low, high);
        let (mut at_a, mut at_b) = (self.clipped_variance_e2(a), self.clipped_variance_e2(b));
        while high - low > PEAK_ACCURACY * hard {
            // Rounding ends the search where the peak is flat.
            if a >= b {
                break;
            }
            if at_a < at_b {
                (low, a, at_a) = (a, b, at_b);
                b = inner(low, high).1;
                at_b = self.clipped_variance_e2(b);
            } else {
                (high, b, at_b) = (b, a, at_a);
                a = inner(low, high).0;
                at_a = self.clipped_variance_e2(a);
            }
        }
        0.5 * (low + high)
    }

    /// Photo-electrons of SNR = 1, e⁻: the absolute sensitivity threshold μ_e.min, exact. The standard's short form `σ + ½` is lower.
    #[must_use]
    pub fn threshold_e(&self) -> f64 {
        0.5 + (self.variance_e2(0.0) + 0.25).sqrt()
    }

    /// Photons of SNR = 1, μ_p.min, at a quantum efficiency above 0, up to 1.
    #[must_use]
    pub fn threshold_photons(&self, quantum_efficiency: f64) -> f64 {
        self.threshold_e() / quantum_efficiency
    }

    /// Largest signal-to-noise ratio √μ_e.sat of a saturation in e⁻; by its definition without dark noise.
    #[must_use]
    pub fn largest_snr(saturation_e: f64) -> f64 {
        saturation_e.sqrt()
    }

    /// Dynamic range of a saturation in e⁻: saturation over exact threshold.
    #[must_use]
    pub fn dynamic_range(&self, saturation_e: f64) -> f64 {
        saturation_e / self.threshold_e()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sensor::Pixel;

    #[test]
    fn a_limit_far_above_or_below_leaves_the_normal_or_the_limit() {
        assert_eq!(clipped_normal(10.0, 4.0, 1000.0), (10.0, 4.0));
        let (mean, variance) = clipped_normal(1000.0, 4.0, 10.0);
        assert!((mean - 10.0).abs() < 1e-12 && variance < 1e-9, "{mean} {variance}");
        assert_eq!(clipped_normal(12.0, 0.0, 10.0), (10.0, 0.0));
    }

    #[test]
    fn clipped_at_its_mean_a_normal_variable_is_half_a_normal_one() {
        let (mean, variance) = clipped_normal(0.0, 1.0, 0.0);
        let tau = 2.0 * std::f64::consts::PI;
        assert!((mean + 1.0 / tau.sqrt()).abs() < 1e-15 && (variance - (0.5 - 1.0 / tau)).abs() < 1e-15);
    }

    #[test]
    fn the_adc_ends_what_the_well_does_not() {
        let deep = Pixel::ideal(1.0, 1e6, 100.0, 12).linear(0.0, 20.0);
        assert_eq!(deep.hard_limit_e(), 3995.0);
        assert_eq!(Pixel::ideal(1.0, 2000.0, 100.0, 12).linear(0.0, 20.0).hard_limit_e(), 2000.0);
        let drowned = Pixel { dark_current_e_s: 1e6, ..Pixel::ideal(1.0, 2000.0, 100.0, 12) }.linear(1.0, 20.0);
        assert_eq!(drowned.hard_limit_e(), 0.0);
    }

    #[test]
    fn at_the_threshold_the_signal_is_its_noise() {
        for (gain, noise) in [(0.02, 0.0), (0.25, 8.0), (3.0, 150.0)] {
            let model = Pixel { read_noise_e: noise, ..Pixel::ideal(gain, 1e5, 0.0, 12) }.linear(0.01, 20.0);
            assert!((model.snr(model.threshold_e()) - 1.0).abs() < 1e-14);
        }
    }
}
