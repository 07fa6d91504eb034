//! Directions within a cone about z, uniformly in solid angle.
//!
//! A point at radius r of the unit disc is sent to `1 − cosθ = r² (1 − cosα)`: equal areas go to equal solid angles (Lambert's
//! azimuthal projection), and small cones lose no digits.

use std::f64::consts::TAU;

use super::disc::{invert_disc, sample_disc};
use crate::math::DVec3;

/// A direction within the cone of the half-angle α with `one_minus_cos` = 1 − cos α, 0 < 1 − cos α ≤ 2.
#[inline(always)]
#[must_use]
pub fn sample_cone(u: [f64; 2], one_minus_cos: f64) -> DVec3 {
    let [x, y] = sample_disc(u);
    let h = (x * x + y * y) * one_minus_cos;
    // sinθ = √(h (2 − h)) points along (x, y), whose length is √(h / (1 − cosα)).
    let s = ((2.0 - h).max(0.0) * one_minus_cos).sqrt();
    DVec3::new(s * x, s * y, 1.0 - h)
}

/// Density with respect to solid angle, sr⁻¹: 1/(2π (1 − cosα)), inside the cone.
#[must_use]
pub fn cone_pdf(one_minus_cos: f64) -> f64 {
    1.0 / (TAU * one_minus_cos)
}

/// The numbers that [`sample_cone`] maps to a direction of unit length.
#[must_use]
pub fn invert_cone(direction: DVec3, one_minus_cos: f64) -> [f64; 2] {
    let across = direction.x.hypot(direction.y);
    let h = if direction.z > 0.0 { across * across / (1.0 + direction.z) } else { 1.0 - direction.z };
    let r = (h / one_minus_cos).sqrt();
    if across == 0.0 { [0.5, 0.5] } else { invert_disc([r * direction.x / across, r * direction.y / across]) }
}
