//! Point sources: irradiance of an element, flux through a disc and through a rectangle.
//!
//! ```text
//! E = I · max(0, n·d) / (|n| |d|³)
//! Ω(disc, on axis)  = 2π R² / (s (s + h)),  s = √(h² + R²)
//! Ω(disc, off axis) = ∫ (cos θ₁ − cos θ₂) dφ about the perpendicular from the point to the plane of the disc
//! tan(Ω/2)          = a·(b×c) / (abc + (a·b)c + (b·c)a + (c·a)b)        for a triangle
//! ```
//!
//! | parameter | meaning | unit |
//! |---|---|---|
//! | `source` | from the receiver to the source | m |
//! | `normal` | normal of the receiving element, any length | 1 |
//! | `radius_m`, `height_m`, `lateral_m` | disc; the point's distance from its plane and from its axis | m |
//! | `corner`, `edge_u`, `edge_v` | parallelogram seen from the point | m |
//!
//! Inverse-square law: any text on photometry. Triangle: van Oosterom and Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125.

use super::frame::{dot, power_of_two_scale, triple, unit};
use super::quadrature::integrate_between;
use crate::math::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};

/// Cosine of the angle of incidence of light from `source` (m, relative to the receiver) on an element of normal `normal`; exactly 0 at and below
/// the horizon, for a zero vector, and for what is not finite.
pub fn incidence_cosine(source: DVec3, normal: DVec3) -> f64 {
    match (unit(source), power_of_two_scale(normal.abs().max_element())) {
        (Some(direction), Some(scale)) if normal.is_finite() => {
            let n = normal * scale;
            (dot(n, direction) / n.length()).clamp(0.0, 1.0)
        }
        _ => 0.0,
    }
}

/// Irradiance per intensity, cos θ / r² in 1/m² (sr taken as 1), of an element by a point source at `source` (m, relative to the receiver).
///
/// Distances from 1e-200 to 1e200 m are safe: the quotient saturates at `f64::MAX` and falls to 0 where a double ends. 0 below the
/// horizon and for a source at the receiver itself, where the law has no value.
pub fn irradiance_factor(source: DVec3, normal: DVec3) -> f64 {
    let cosine = incidence_cosine(source, normal);
    let Some(scale) = power_of_two_scale(source.abs().max_element()) else {
        return 0.0;
    };
    if cosine == 0.0 {
        return 0.0;
    }
    // 1/r² = scale²/(scale r)²; multiplied one factor at a time, an overflow happens only if the result itself is too large.
    (cosine / (source * scale).length_squared() * scale * scale).min(f64::MAX)
}

/// Solid angle, sr, of a disc of radius `radius_m` seen from a point `height_m` from its plane and `lateral_m` from its axis; the flux of
/// an isotropic source through the disc is I times this. In the plane of the disc: 2π inside (the limit), π on the rim, 0 outside.
pub fn disc_solid_angle(radius_m: f64, height_m: f64, lateral_m: f64) -> f64 {
    let size = radius_m.abs().max(height_m.abs()).max(lateral_m.abs());
    let Some(scale) = power_of_two_scale(size) else {
        return 0.0;
    };
    let (radius, height, lateral) = (radius_m * scale, height_m.abs() * scale, lateral_m.abs() * scale);
    if radius.is_nan() || radius <= 0.0 || height.is_nan() || lateral.is_nan() {
        return 0.0;
    }
    if height == 0.0 {
        return if lateral < radius {
            2.0 * PI
        } else if lateral == radius {
            PI
        } else {
            0.0
        };
    }
    if lateral == 0.0 {
        let s = height.hypot(radius);
        return 2.0 * PI * (radius / s) * (radius / (s + height));
    }
    if lateral < radius {
        // The foot of the perpendicular is on the disc: one chord end per azimuth, 1 − cos θ = ρ²/(r(r + h)).
        let strip = |phi: f64| {
            let half_chord = radius_on_chord(radius, lateral * phi.sin());
            // For cos φ < 0 the sum would cancel; the product of the two chord ends is R² − l².
            let along = lateral * phi.cos();
            let rho = if along < 0.0 { (radius - lateral) * (radius + lateral) / (half_chord - along) } else { half_chord + along };
            let r = rho.hypot(height);
            2.0 * (rho / r) * (rho / (r + height))
        };
        return integrate_between(&[0.0, FRAC_PI_2, PI], &strip, 1e-13).value.clamp(0.0, 2.0 * PI);
    }
    // Outside: sin φ = (R/l) sin u removes the square roots at the tangents; cos θ₁ − cos θ₂ = h(ρ₂² − ρ₁²)/(r₁r₂(r₁ + r₂)).
    let strip = |u: f64| {
        let half_chord = radius * u.cos();
        let along = radius_on_chord(lateral, radius * u.sin());
        let near = if along > half_chord { (lateral - radius) * (lateral + radius) / (along + half_chord) } else { 0.0 };
        let (r1, r2) = (near.hypot(height), (along + half_chord).hypot(height));
        8.0 * (half_chord / r1) * (half_chord / r2) * (height / (r1 + r2))
    };
    integrate_between(&[0.0, FRAC_PI_2], &strip, 1e-13).value.clamp(0.0, 2.0 * PI)
}

/// √(r² − d²) without cancellation.
fn radius_on_chord(r: f64, d: f64) -> f64 {
    ((r - d.abs()).max(0.0) * (r + d.abs())).sqrt()
}

/// Solid angle, sr, of the parallelogram with one corner at `corner` (m, relative to the point) and edges `edge_u` and `edge_v` (m).
/// In its plane: 2π strictly inside (the limit), 0 elsewhere.
pub fn parallelogram_solid_angle(corner: DVec3, edge_u: DVec3, edge_v: DVec3) -> f64 {
    let size = corner.abs().max(edge_u.abs()).max(edge_v.abs()).max_element();
    let Some(scale) = power_of_two_scale(size) else {
        return 0.0;
    };
    let (a, u, v) = (corner * scale, edge_u * scale, edge_v * scale);
    if !(a.is_finite() && u.is_finite() && v.is_finite()) {
        return 0.0;
    }
    // All triangles spanned by the corner and two edges have this same volume.
    let volume = triple(a, u, v).abs();
    if volume == 0.0 {
        let w = u.cross(v);
        let area_squared = w.length_squared();
        let (s, t) = (-a.cross(v).dot(w) / area_squared, a.cross(u).dot(w) / area_squared);
        let inside = area_squared > 0.0 && s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0;
        return if inside { 2.0 * PI } else { 0.0 };
    }
    let triangle = |p: DVec3, q: DVec3, r: DVec3| {
        let (lp, lq, lr) = (p.length(), q.length(), r.length());
        2.0 * volume.atan2(lp * lq * lr + p.dot(q) * lr + q.dot(r) * lp + r.dot(p) * lq)
    };
    triangle(a, a + u, a + u + v) + triangle(a, a + u + v, a + v)
}
