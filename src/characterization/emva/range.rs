//! Whether a pixel has a range that a photon transfer can be measured in, and how long its exposures have to be.
//!
//! ```text
//! t = 1.04 μ_e.hard / (μ̇_e + μ_I)       μ_e.hard: what fits between the dark signal and the end of the well or of the ADC
//! ```

use super::{EmvaError, PAST_SATURATION};
use crate::sensor::Pixel;

/// Fewest electrons between dark and saturation: shot noise is to be about normal there.
const LEAST_RANGE_E: f64 = 100.0;
/// The readout may fill this share of the range with its noise.
const MOST_READ_NOISE: f64 = 0.1;
/// The dark current may bring this share of the electrons that saturate.
const MOST_DARK: f64 = 0.5;

/// The longest exposure of a series, s, just past saturation: of a pixel at a temperature in °C, in a light that brings `electrons_per_s`.
///
/// # Errors
/// A range of fewer electrons than shot noise needs, read noise that fills it, or a dark current that does so before the light.
pub fn longest_exposure_s(pixel: &Pixel, temperature_c: f64, electrons_per_s: f64) -> Result<f64, EmvaError> {
    let wrong = |words: String| Err(EmvaError::Series(words));
    let still = pixel.linear(0.0, temperature_c);
    let range_e = still.hard_limit_e();
    if range_e < LEAST_RANGE_E {
        let what = if still.adc_limit_e() < still.well_limit_e() {
            format!("the ADC ends {range_e:.3} e⁻ above the dark signal, at `gain_dn_per_e: {}`", pixel.gain_dn_per_e)
        } else {
            format!("the well holds {range_e:.3} e⁻, by `full_well_e`")
        };
        return wrong(format!("{what}: photon transfer needs a range of {LEAST_RANGE_E} e⁻ and more"));
    }
    if pixel.read_noise_e > MOST_READ_NOISE * range_e {
        return wrong(format!(
            "the read noise of {:.4} e⁻ fills the range of the pixel of {range_e:.4} e⁻: photon transfer needs `read_noise_e` up to a tenth of it",
            pixel.read_noise_e
        ));
    }
    let dark_e_s = pixel.dark_current_at(temperature_c);
    let share = dark_e_s / (dark_e_s + electrons_per_s);
    if share.is_nan() || share > MOST_DARK {
        return wrong(format!(
            "at {temperature_c} °C the dark current brings {dark_e_s:.3e} e⁻/s and the light {electrons_per_s:.3e}: the pixel fills with dark \
             signal. Give a lower temperature or more light"
        ));
    }
    Ok(PAST_SATURATION * range_e / (electrons_per_s + dark_e_s))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_longest_exposure_is_just_past_saturation() {
        let pixel = Pixel { dark_current_e_s: 100.0, read_noise_e: 8.0, ..Pixel::ideal(0.25, 14000.0, 64.0, 12) };
        let longest_s = longest_exposure_s(&pixel, 20.0, 1e6).unwrap_or(f64::NAN);
        assert!((longest_s * (1e6 + 100.0) / 14000.0 - PAST_SATURATION).abs() < 1e-12);
    }

    #[test]
    fn a_pixel_without_a_range_is_told_why() {
        let pixel = Pixel { dark_current_e_s: 100.0, ..Pixel::ideal(0.25, 14000.0, 64.0, 12) };
        let warm = Pixel { doubling_k: 8.0, ..pixel };
        for (pixel, temperature_c, said) in [
            (Pixel { gain_dn_per_e: 1e9, ..pixel }, 20.0, "the ADC ends"),
            (Pixel { full_well_e: 20.0, ..pixel }, 20.0, "the well holds 20.000 e⁻"),
            (Pixel { read_noise_e: 5000.0, ..pixel }, 20.0, "read noise"),
            (warm, 500.0, "at 500 °C the dark current"),
            (Pixel { dark_current_e_s: 1e300, ..pixel }, 1e4, "Give a lower temperature"),
        ] {
            let words = longest_exposure_s(&pixel, temperature_c, 1e6).map_or_else(|e| e.to_string(), |s| format!("{s} s"));
            assert!(words.contains(said), "{words}");
        }
    }
}
