//! The exact distribution of the digital numbers of one pixel: shot noise, full well, read noise, rounding, ends of the ADC.
//!
//! ```text
//! n ~ Poisson(λ),  λ = g μ_e + μ_I t
//! x = min(n, W) + μ_d0 + o + σ_d0 ξ,   ξ ~ N(0, 1)
//! y = clamp(⌊y₀ + K x + ½⌋, 0, 2^b − 1)
//! P(y = j) = Σ_n P(n) [Φ((j + ½ − a_n)/Kσ_d0) − Φ((j − ½ − a_n)/Kσ_d0)],   a_n = y₀ + K (min(n, W) + μ_d0 + o)
//! ```
//!
//! | symbol | |
//! |---|---|
//! | λ | mean electrons in the well |
//! | g, o | fixed pattern of the pixel: relative responsivity and dark offset in e⁻ |
//! | W, b | full well in e⁻, bits |
//!
//! This is what [`Pixel::expose`](crate::sensor::Pixel::expose) draws from, so the mean and the variance here are those of frames, near
//! saturation and for noise below one digital number as well, where the linear model is not.

use super::LinearModel;
use crate::metrology::distribution::normal_cumulative;

/// Terms below this part of the largest are left out: their sum is below the rounding of the rest.
const NEGLIGIBLE: f64 = 1e-18;
/// Standard deviations of read noise that are followed.
const REACH: f64 = 9.0;

/// Probabilities of successive digital numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Codes {
    /// The first digital number.
    pub first_dn: u16,
    /// Its probability and those of its successors; all others have none.
    pub probabilities: Vec<f64>,
}

impl Codes {
    /// Mean, DN.
    #[must_use]
    pub fn mean_dn(&self) -> f64 {
        f64::from(self.first_dn) + self.moment(|i| i)
    }

    /// Variance, DN².
    #[must_use]
    pub fn variance_dn2(&self) -> f64 {
        let mean = self.moment(|i| i);
        self.moment(|i| (i - mean).powi(2))
    }

    fn moment(&self, of: impl Fn(f64) -> f64) -> f64 {
        self.probabilities.iter().enumerate().map(|(i, p)| p * of(i as f64)).sum()
    }
}

impl LinearModel {
    /// The distribution of the digital numbers of a pixel without fixed pattern that `electrons_e` photo-electrons are expected in.
    #[must_use]
    pub fn codes(&self, electrons_e: f64) -> Codes {
        self.codes_of(electrons_e, 1.0, 0.0)
    }

    /// The same with the fixed pattern of the pixel: `responsivity` relative, 0 or more, and `offset_e` in e⁻.
    #[must_use]
    pub fn codes_of(&self, electrons_e: f64, responsivity: f64, offset_e: f64) -> Codes {
        let pixel = &self.pixel;
        let largest = pixel.largest_dn();
        let place = |charge_e: f64| pixel.black_dn + pixel.gain_dn_per_e * (charge_e + pixel.mean_dark_e + offset_e);
        let charges = charges(electrons_e * responsivity + self.thermal_e, pixel.full_well_e);
        let spread = pixel.gain_dn_per_e * pixel.read_noise_e;
        let ends = |at: f64| ((at - REACH * spread).round().clamp(0.0, largest), (at + REACH * spread).round().clamp(0.0, largest));
        let (first, last) = charges.iter().fold((largest, 0.0), |(first, last): (f64, f64), (charge, _)| {
            let (low, high) = ends(place(*charge));
            (first.min(low), last.max(high))
        });
        let mut probabilities = vec![0.0; (last - first) as usize + 1];
        for (charge, probability) in charges {
            let at = place(charge);
            let (low, high) = ends(at);
            // What is below the upper edge of a digital number; everything below its lower edge has been given out already.
            let mut below = 0.0;
            let mut code = low;
            while code <= high {
                let up_to = if code >= high {
                    1.0
                } else if spread > 0.0 {
                    normal_cumulative((code + 0.5 - at) / spread)
                } else {
                    f64::from(u8::from(at < code + 0.5))
                };
                probabilities[(code - first) as usize] += probability * (up_to - below);
                below = up_to;
                code += 1.0;
            }
        }
        Codes { first_dn: first as u16, probabilities }
    }
}

/// Charges in the well in e⁻ with their probabilities: Poisson up to the full well, the rest at it.
fn charges(mean: f64, full_well_e: f64) -> Vec<(f64, f64)> {
    if mean.is_nan() || mean <= 0.0 {
        return vec![(0.0, 1.0)];
    }
    // Past this, nothing of the distribution is below the full well.
    if mean - 10.0 * mean.sqrt() - 50.0 > full_well_e || !mean.is_finite() {
        return vec![(full_well_e, 1.0)];
    }
    let mode = mean.floor();
    let (mut below, mut above) = (Vec::new(), vec![(mode, 1.0)]);
    let (mut n, mut p) = (mode, 1.0);
    while n > 0.0 && p > NEGLIGIBLE {
        p *= n / mean;
        n -= 1.0;
        below.push((n, p));
    }
    (n, p) = (mode, 1.0);
    while p > NEGLIGIBLE {
        n += 1.0;
        p *= mean / n;
        above.push((n, p));
    }
    let whole: f64 = below.iter().chain(&above).map(|(_, p)| p).sum();
    let (mut list, mut full) = (Vec::new(), 0.0);
    for (n, p) in below.into_iter().rev().chain(above) {
        if n < full_well_e {
            list.push((n, p / whole));
        } else {
            full += p / whole;
        }
    }
    if full > 0.0 {
        list.push((full_well_e, full));
    }
    list
}

#[cfg(test)]
mod tests {
    use crate::sensor::Pixel;
    use crate::sensor::pixel::QUANTISATION_DN2;
    use crate::sensor::pixel::saturation::clipped_normal;
    use proptest::prelude::*;

    fn noisy(gain: f64, read_noise_e: f64) -> Pixel {
        Pixel { read_noise_e, mean_dark_e: 3.0, ..Pixel::ideal(gain, 2e4, 100.0, 14) }
    }

    proptest! {
        #[test]
        fn away_from_the_ends_the_linear_model_holds(gain in 0.1..0.7f64, noise in 6.0..30.0f64, electrons in 0.0..15_000.0f64) {
            // Noise of 0.6 DN and more: rounding adds 1/12 to 1e-3.
            let model = noisy(gain, noise).linear(0.0, 20.0);
            let codes = model.codes(electrons);
            prop_assert!((codes.probabilities.iter().sum::<f64>() - 1.0).abs() < 1e-12);
            let (mean, variance) = (model.expected_dn(electrons), model.variance_dn2(electrons));
            prop_assert!((codes.mean_dn() - mean).abs() < 1e-3, "{} {mean}", codes.mean_dn());
            prop_assert!((codes.variance_dn2() / variance - 1.0).abs() < 5e-3, "{} {variance}", codes.variance_dn2());
        }
    }

    #[test]
    fn no_noise_is_one_digital_number() {
        let model = Pixel::ideal(0.5, 100.0, 10.0, 8).linear(0.0, 20.0);
        let codes = model.codes(0.0);
        assert_eq!((codes.first_dn, codes.probabilities), (10, vec![1.0]));
        let codes = model.codes(1e30);
        assert_eq!((codes.first_dn, codes.probabilities), (60, vec![1.0]));
        let codes = Pixel::ideal(5.0, 100.0, 10.0, 8).linear(0.0, 20.0).codes(1e4);
        assert_eq!((codes.mean_dn(), codes.variance_dn2()), (255.0, 0.0));
    }

    /// A normal distribution leaves out the skewness 1/√μ of Poisson's: the two come together as the well gets deeper.
    #[test]
    fn near_a_deep_full_well_the_clipped_normal_holds() {
        for well in [1e4, 1e6, 1e8] {
            let gain = 6e4 / well;
            let model = Pixel::ideal(gain, well, 0.0, 16).linear(0.0, 20.0);
            for deviations in [-3.0, -1.0, 0.0, 1.0] {
                let electrons = well + deviations * f64::sqrt(well);
                let codes = model.codes(electrons);
                let (mean, variance) = clipped_normal(electrons, electrons, well);
                let skewness = 1.0 / well.sqrt();
                assert!(
                    (codes.mean_dn() / gain - mean).abs() < 3.0 * skewness * variance.sqrt() + 0.5 / gain,
                    "{} {mean}",
                    codes.mean_dn()
                );
                let found = (codes.variance_dn2() - rounding(gain)) / gain.powi(2);
                assert!((found / variance - 1.0).abs() < 3.0 * skewness + rounding(gain) / (gain.powi(2) * variance), "{found} {variance}");
            }
        }
    }

    /// Variance that rounding adds: none where every electron has its own digital number.
    fn rounding(gain: f64) -> f64 {
        if gain >= 1.0 { 0.0 } else { QUANTISATION_DN2 }
    }
}
