//! Directions with a density proportional to the cosine, over a hemisphere or within a cone about its axis (z).
//!
//! Malley's method: a uniform point of the disc of radius sin α, lifted to the sphere, has the density cosθ/(π sin²α).

use std::f64::consts::PI;

use super::disc::{invert_disc, sample_disc};
use crate::math::DVec3;

/// A direction above the horizon with density cosθ/π.
#[inline(always)]
#[must_use]
pub fn sample_cosine_hemisphere(u: [f64; 2]) -> DVec3 {
    sample_cosine_cone(u, 1.0)
}

/// A direction within the cone whose half-angle has the sine given, with density cosθ/(π sin²α).
#[inline(always)]
#[must_use]
pub fn sample_cosine_cone(u: [f64; 2], sine: f64) -> DVec3 {
    let [x, y] = sample_disc(u);
    let (x, y) = (sine * x, sine * y);
    DVec3::new(x, y, (1.0 - x * x - y * y).max(0.0).sqrt())
}

/// Density with respect to solid angle, sr⁻¹; zero outside the cone.
#[must_use]
pub fn cosine_cone_pdf(direction: DVec3, sine: f64) -> f64 {
    let inside = direction.z > 0.0 && direction.x.hypot(direction.y) <= sine * direction.length();
    if inside { direction.z / direction.length() / (PI * sine * sine) } else { 0.0 }
}

/// The numbers that [`sample_cosine_cone`] maps to a direction.
#[must_use]
pub fn invert_cosine_cone(direction: DVec3, sine: f64) -> [f64; 2] {
    invert_disc([direction.x / sine, direction.y / sine])
}
