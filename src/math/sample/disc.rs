//! The unit disc, uniformly, by the concentric map of Shirley and Chiu (1997): squares about the centre become circles, so the
//! strata of the numbers stay compact.

use std::f64::consts::FRAC_PI_4;

use crate::math::angle::sin_cos_eighth;

/// A point of the unit disc. Free of branches, so that loops over lanes become vector code.
#[inline(always)]
#[must_use]
pub fn sample_disc(u: [f64; 2]) -> [f64; 2] {
    let (a, b) = (2.0 * u[0] - 1.0, 2.0 * u[1] - 1.0);
    let wide = a.abs() > b.abs();
    let (long, short) = if wide { (a, b) } else { (b, a) };
    // long = 0 only at the exact centre, which the half-step offset of the numbers excludes; the guard serves other callers.
    let ratio = if long == 0.0 { 0.0 } else { short / long };
    let (sin, cos) = sin_cos_eighth(FRAC_PI_4 * ratio);
    if wide { [long * cos, long * sin] } else { [long * sin, long * cos] }
}

/// Density with respect to area: 1/π.
#[must_use]
pub fn disc_pdf() -> f64 {
    std::f64::consts::FRAC_1_PI
}

/// The numbers that [`sample_disc`] maps to a point.
#[must_use]
pub fn invert_disc(p: [f64; 2]) -> [f64; 2] {
    let r = p[0].hypot(p[1]);
    let wide = p[0].abs() > p[1].abs();
    let (along, across) = if wide { (p[0], p[1]) } else { (p[1], p[0]) };
    let long = r.copysign(along);
    let short = if along == 0.0 { 0.0 } else { long * (across / along).atan() / FRAC_PI_4 };
    let (a, b) = if wide { (long, short) } else { (short, long) };
    [0.5 * (a + 1.0), 0.5 * (b + 1.0)]
}
