//! Irradiance from a plane patch by product Gauss quadrature, a route of its own: no formula of the program is used.
//!
//! ```text
//! E = L ∫∫ cos θ cos θ' / r² dA        patch  p(s, t) = corner + s u + s^k t v,  s, t ∈ (0, 1)
//! ```
//!
//! k = 0 is a parallelogram, k = 1 a triangle with the corners `corner`, `corner + u`, `corner + u + v`. The integrand is analytic
//! as long as the patch stays away from the receiver, so that 64 × 64 nodes give all digits of a patch no larger than its distance.

use crate::math::DVec3;

/// Nodes along each axis.
const NODES: usize = 64;

/// Which plane figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Figure {
    /// Four corners.
    Parallelogram,
    /// Three corners.
    Triangle,
}

/// Nodes in (0, 1) and weights with the sum 1: Gauss–Legendre, by Newton's method on P_n.
#[must_use]
pub fn gauss(n: usize) -> Vec<(f64, f64)> {
    let legendre = |x: f64| {
        let (mut previous, mut current) = (1.0, x);
        for k in 2..=n {
            let k = k as f64;
            (previous, current) = (current, ((2.0 * k - 1.0) * x * current - (k - 1.0) * previous) / k);
        }
        (current, n as f64 * (x * current - previous) / (x * x - 1.0))
    };
    (0..n)
        .map(|i| {
            let mut x = (std::f64::consts::PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
            for _ in 0..8 {
                let (p, slope) = legendre(x);
                x -= p / slope;
            }
            let (_, slope) = legendre(x);
            (0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope))
        })
        .collect()
}

/// Irradiance at the origin on a plane with the normal z from a patch of unit radiance that emits on both sides and lies above.
#[must_use]
pub fn irradiance(figure: Figure, corner: DVec3, u: DVec3, v: DVec3) -> f64 {
    let nodes = gauss(NODES);
    let area = u.cross(v);
    let mut sum = 0.0;
    for &(s, weight_s) in &nodes {
        let width = if figure == Figure::Triangle { s } else { 1.0 };
        for &(t, weight_t) in &nodes {
            let p = corner + s * u + width * t * v;
            let squared = p.length_squared();
            sum += weight_s * weight_t * width * p.z * p.dot(area).abs() / (squared * squared);
        }
    }
    sum
}

/// Irradiance at the origin on a plane with the normal z from the part x ≥ `from` of a parallel disc of unit radiance, centred at the
/// height `z` above it.
#[must_use]
pub fn cut_disc(radius: f64, z: f64, from: f64) -> f64 {
    // x = R sin φ takes the root of the chord's length away.
    let first = (from / radius).clamp(-1.0, 1.0).asin();
    let range = std::f64::consts::FRAC_PI_2 - first;
    let across = |phi: f64| {
        let (half, c) = (radius * phi.cos(), (radius * phi.sin()).powi(2) + z * z);
        // ∫ z² dy / (c + y²)² over the chord.
        z * z * (half / (c * (c + half * half)) + (half / c.sqrt()).atan() / (c * c.sqrt())) * radius * phi.cos()
    };
    gauss(NODES).iter().map(|&(s, weight)| weight * range * across(first + range * s)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn a_whole_disc_is_that_of_the_closed_form() {
        for (radius, z) in [(1.0, 1.0), (0.1, 2.0), (1e-6, 1.0)] {
            let closed: f64 = PI * radius * radius / (radius * radius + z * z);
            assert!((cut_disc(radius, z, -radius) / closed - 1.0).abs() < 1e-13);
            assert!((cut_disc(radius, z, 0.0) / closed - 0.5).abs() < 1e-13);
        }
    }

    #[test]
    fn a_square_is_two_triangles_and_that_of_the_closed_form() {
        // A square of side 2 at height 1, centred on the normal: four times the corner factor with X = Y = 1.
        let closed = 4.0 * (2.0 / 2f64.sqrt() * (1.0 / 2f64.sqrt()).atan()) / 2.0;
        let (corner, u, v) = (DVec3::new(-1.0, -1.0, 1.0), 2.0 * DVec3::X, 2.0 * DVec3::Y);
        let square = irradiance(Figure::Parallelogram, corner, u, v);
        let halves = irradiance(Figure::Triangle, corner, u, v) + irradiance(Figure::Triangle, corner, v, u);
        assert!((square / closed - 1.0).abs() < 1e-13 && (halves / closed - 1.0).abs() < 1e-13, "{square} {halves} {closed}");
    }
}
