//! What colour stands for a wavelength: no screen shows spectral colours, so this is a choice, made smooth to the eye.
//!
//! ```text
//! c  = M (x̄, ȳ, z̄)(λ) / |M (x̄, ȳ, z̄)(λ)|      linear sRGB of the CIE 1931 observer; components may be negative
//! c′ = s ln(1 + exp(c / s)),  c″ = c′ / |c′|      negative components fade out instead of being cut off
//! C  = e(λ)³ ∫ c″(λ′) g(λ − λ′) dλ′               a filter, and a fade to dark at both ends
//! ```
//!
//! | symbol | value | what |
//! |---|---|---|
//! | s | 0.05 | how softly a component fades out |
//! | g | Gaussian, σ = 8 nm | a mean of colours that sRGB has is one that sRGB has |
//! | e | 0.18 → 1 from 365 to 435 nm, 1 → 0.18 from 630 to 780 nm | factor of OKLab's lightness and chroma, hence the third power |
//!
//! From 380 nm to 780 nm the colour changes by less than 0.02 a nm in OKLab (Ottosson 2020), and this speed by less than 0.0012 a nm.

use std::sync::OnceLock;

use super::chart::Stop;
use crate::observer::Matching;
use crate::observer::colour::{Tristimulus, linear_srgb_of};

/// Softness of the limit to components that are not negative.
const SOFTNESS: f64 = 0.05;
/// Standard deviation of the filter, nm.
const SIGMA_NM: f64 = 8.0;
/// Wavelengths between which the colour brightens, and darkens again, nm.
const RISE_NM: (f64, f64) = (365.0, 435.0);
const FALL_NM: (f64, f64) = (630.0, 780.0);
/// What is left at both ends of lightness and chroma.
const FLOOR: f64 = 0.18;
/// Wavelengths at which the colours are kept, nm; beyond, the colour of the end.
const FROM_NM: f64 = 360.0;
const TO_NM: f64 = 830.0;
/// Distance of the stops of a gradient, nm.
const STOP_STEP_NM: f64 = 4.0;

/// The colour of a wavelength, sRGB. Any number has one: beyond 360–830 nm that of the nearer end, black where it is not a number.
///
/// ```
/// use etendue::report::plot::wavelength_colour::colour;
///
/// let [red, green, blue] = colour(530.0);
/// assert!(green > 200 && red < 60 && blue < 60);
/// ```
pub fn colour(nm: f64) -> [u8; 3] {
    linear(nm).map(|component| (255.0 * encoded(component)).round() as u8)
}

/// Stops of a gradient from `from_nm` to `to_nm`, every 4 nm and at both ends; empty unless the range is one.
pub fn stops(from_nm: f64, to_nm: f64) -> Vec<Stop> {
    let stop = |nm: f64| Stop { x: nm, colour: colour(nm), opacity: 1.0 };
    if !(from_nm.is_finite() && to_nm.is_finite() && from_nm < to_nm) {
        return Vec::new();
    }
    // Beyond the colours that are kept nothing changes.
    let (low, high) = (from_nm.max(FROM_NM), to_nm.min(TO_NM));
    let inner = ((high - low) / STOP_STEP_NM).ceil().max(0.0) as usize;
    let inner = (0..=inner).map(|i| low + STOP_STEP_NM * i as f64).filter(|nm| *nm > from_nm && *nm < to_nm);
    std::iter::once(from_nm).chain(inner).chain([to_nm]).map(stop).collect()
}

/// Linear sRGB of a wavelength, 0 to 1.
pub(super) fn linear(nm: f64) -> [f64; 3] {
    static COLOURS: OnceLock<Vec<[f64; 3]>> = OnceLock::new();
    let colours = COLOURS.get_or_init(filtered);
    let place = nm.clamp(FROM_NM, TO_NM) - FROM_NM;
    let Some(last) = colours.len().checked_sub(2).filter(|_| !place.is_nan()) else { return [0.0; 3] };
    let index = (place as usize).min(last);
    let t = place - index as f64;
    let scale = fade(nm.clamp(FROM_NM, TO_NM)).powi(3);
    std::array::from_fn(|i| scale * (colours[index][i] * (1.0 - t) + colours[index + 1][i] * t))
}

/// Linear sRGB, 0 to 1, of any light by its components, which may be negative: they fade out. The length of the result is 1.
pub(super) fn softened(rgb: [f64; 3], softness: f64) -> [f64; 3] {
    let unit = |c: [f64; 3]| {
        let length = c.iter().map(|x| x * x).sum::<f64>().sqrt();
        c.map(|x| x / length)
    };
    // ln(1 + exp(t)) without overflow.
    unit(unit(rgb).map(|x| x.max(0.0) + softness * (-(x / softness).abs()).exp().ln_1p()))
}

/// The transfer function of sRGB (IEC 61966-2-1).
pub(super) fn encoded(linear: f64) -> f64 {
    let linear = linear.clamp(0.0, 1.0);
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// Every nm from 360 to 830.
fn filtered() -> Vec<[f64; 3]> {
    let functions = Matching::Cie1931.functions();
    let count = (TO_NM - FROM_NM) as i64;
    let raw: Vec<[f64; 3]> = (0..=count)
        .map(|i| {
            let [x, y, z] = functions.each_ref().map(|function| function.at(FROM_NM + i as f64));
            softened(linear_srgb_of(&Tristimulus { x, y, z }), SOFTNESS)
        })
        .collect();
    let reach = (4.0 * SIGMA_NM) as i64;
    let weight = |k: i64| (-0.5 * (k as f64 / SIGMA_NM).powi(2)).exp();
    let whole: f64 = (-reach..=reach).map(weight).sum();
    let mean = |i: i64| {
        let mut sum = [0.0; 3];
        for k in -reach..=reach {
            let colour = raw[(i + k).clamp(0, count) as usize];
            sum = std::array::from_fn(|c| sum[c] + weight(k) / whole * colour[c]);
        }
        sum
    };
    (0..=count).map(mean).collect()
}

/// Fade to dark at both ends, with continuous second derivative.
fn fade(nm: f64) -> f64 {
    let step = |(from, to): (f64, f64)| {
        let t = ((nm - from) / (to - from)).clamp(0.0, 1.0);
        t * t * t * (t * (6.0 * t - 15.0) + 10.0)
    };
    FLOOR + (1.0 - FLOOR) * step(RISE_NM) * (1.0 - step(FALL_NM))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ottosson 2020.
    fn oklab([r, g, b]: [f64; 3]) -> [f64; 3] {
        let l = (0.412_221_470_8 * r + 0.536_332_536_3 * g + 0.051_445_992_9 * b).cbrt();
        let m = (0.211_903_498_2 * r + 0.680_699_545_1 * g + 0.107_396_956_6 * b).cbrt();
        let s = (0.088_302_461_9 * r + 0.281_718_837_6 * g + 0.629_978_700_5 * b).cbrt();
        [
            0.210_454_255_3 * l + 0.793_617_785_0 * m - 0.004_072_046_8 * s,
            1.977_998_495_1 * l - 2.428_592_205_0 * m + 0.450_593_709_9 * s,
            0.025_904_037_1 * l + 0.782_771_766_2 * m - 0.808_675_766_0 * s,
        ]
    }

    fn length(v: [f64; 3]) -> f64 {
        v.iter().map(|x| x * x).sum::<f64>().sqrt()
    }

    #[test]
    fn colours_change_smoothly_to_the_eye() {
        let lab: Vec<[f64; 3]> = (380..=780).map(|nm| oklab(linear(f64::from(nm)))).collect();
        let steps: Vec<[f64; 3]> = lab.windows(2).map(|pair| std::array::from_fn(|i| pair[1][i] - pair[0][i])).collect();
        let bends = steps.windows(2).map(|pair| length(std::array::from_fn(|i| pair[1][i] - pair[0][i])));
        let fastest = steps.iter().copied().map(length).fold(0.0, f64::max);
        let sharpest = bends.fold(0.0, f64::max);
        assert!(fastest < 0.02 && sharpest < 0.0012, "{fastest} a nm, {sharpest} a nm²");
    }

    #[test]
    fn every_colour_is_one_that_srgb_has_without_cutting() {
        for tenth in 3500..=8500 {
            let colour = linear(0.1 * f64::from(tenth));
            assert!(colour.iter().all(|component| (0.0..=1.0).contains(component)), "{tenth}: {colour:?}");
        }
    }

    #[test]
    fn hues_are_those_of_the_rainbow_and_the_ends_are_dark() {
        let strongest = |nm| {
            let colour = colour(nm);
            (0..3).max_by_key(|i| colour[*i])
        };
        assert_eq!([450.0, 530.0, 650.0].map(strongest), [Some(2), Some(1), Some(0)]);
        let [red, green, blue] = colour(580.0);
        assert!(red > 200 && green > 150 && blue < 60, "yellow: {red} {green} {blue}");
        for end in [380.0, 780.0] {
            assert!(oklab(linear(end))[0] < 0.2);
        }
    }

    #[test]
    fn any_number_has_a_colour() {
        assert_eq!(colour(f64::NAN), [0; 3]);
        assert_eq!(colour(f64::NEG_INFINITY), colour(360.0));
        assert_eq!(colour(1e300), colour(830.0));
        assert!(stops(780.0, 380.0).is_empty() && stops(f64::NAN, 1.0).is_empty());
        assert_eq!(stops(1e3, 1e300).len(), 2);
        let stops = stops(380.0, 780.0);
        assert!(stops.windows(2).all(|pair| pair[0].x < pair[1].x) && stops.len() < 110);
    }
}
