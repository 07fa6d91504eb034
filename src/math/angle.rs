//! Sine and cosine where the usual ones lose digits or time.

use std::f64::consts::FRAC_PI_4;

/// Sine and cosine of an angle in degrees, exact at multiples of 90°.
///
/// ```
/// use etendue::math::angle::sin_cos_deg;
/// assert_eq!(sin_cos_deg(90.0), (1.0, 0.0));
/// assert_eq!(sin_cos_deg(-180.0), (0.0, -1.0));
/// ```
#[must_use]
pub fn sin_cos_deg(angle_deg: f64) -> (f64, f64) {
    // Reduced in degrees, where a quarter turn is an exact number.
    let quarters = (angle_deg / 90.0).round();
    let rest = (angle_deg - 90.0 * quarters).to_radians();
    let (sin, cos) = rest.sin_cos();
    let (s, c) = match quarters.rem_euclid(4.0) as u8 {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    };
    (s + 0.0, c + 0.0)
}

/// `1 − cos α` without cancellation: `2 sin²(α/2)`.
#[must_use]
pub fn one_minus_cos(angle_rad: f64) -> f64 {
    let s = (0.5 * angle_rad).sin();
    2.0 * s * s
}

/// `1 − √(1 − s²)` for the sine `s` of an angle up to 90°, without cancellation.
#[must_use]
pub fn one_minus_cos_of_sine(sine: f64) -> f64 {
    let s2 = sine * sine;
    s2 / (1.0 + (1.0 - s2).max(0.0).sqrt())
}

/// Sine and cosine for |x| ≤ π/4 by their Taylor series, to the last bit or two.
///
/// Free of branches and calls, so that loops over lanes become vector code; the first neglected terms are below 5e-17.
#[inline(always)]
#[must_use]
pub fn sin_cos_eighth(x: f64) -> (f64, f64) {
    debug_assert!(x.abs() <= FRAC_PI_4 * 1.000_001);
    let y = x * x;
    let sin = x
        * (1.0
            + y * (-1.0 / 6.0
                + y * (1.0 / 120.0
                    + y * (-1.0 / 5040.0
                        + y * (1.0 / 362_880.0 + y * (-1.0 / 39_916_800.0 + y * (1.0 / 6_227_020_800.0 - y / 1_307_674_368_000.0)))))));
    let cos = 1.0
        + y * (-0.5
            + y * (1.0 / 24.0
                + y * (-1.0 / 720.0
                    + y * (1.0 / 40_320.0
                        + y * (-1.0 / 3_628_800.0
                            + y * (1.0 / 479_001_600.0 + y * (-1.0 / 87_178_291_200.0 + y / 20_922_789_888_000.0)))))));
    (sin, cos)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_series_agrees_with_the_library(x in -FRAC_PI_4..FRAC_PI_4) {
            let (s, c) = sin_cos_eighth(x);
            prop_assert!((s - x.sin()).abs() <= 3e-16 && (c - x.cos()).abs() <= 3e-16);
        }

        #[test]
        fn degrees_agree_with_radians(x in -720.0..720.0_f64) {
            let (s, c) = sin_cos_deg(x);
            prop_assert!((s - x.to_radians().sin()).abs() < 1e-14 && (c - x.to_radians().cos()).abs() < 1e-14);
        }

        #[test]
        fn small_angles_keep_their_square(exponent in -150.0..0.0_f64) {
            let a = 10f64.powf(exponent);
            let exact = 0.5 * a * a * (1.0 - a * a / 12.0 * (1.0 - a * a / 30.0));
            prop_assert!((one_minus_cos(a) / exact - 1.0).abs() < 1e-4 * a.powi(6) + 1e-14);
            prop_assert!((one_minus_cos_of_sine(a.sin()) / one_minus_cos(a) - 1.0).abs() < 1e-13);
        }
    }
}
