//! Etendue of two surfaces that see each other fully, facing sides towards each other.
//!
//! ```text
//! coaxial discs   2π² R₁²R₂² / (P + D),  P = R₁² + R₂² + H²,  D² = (H² + (R₁−R₂)²)(H² + (R₁+R₂)²)
//! polygons        ½ ∮∮ ln(r/r₀) ds₁·ds₂        inner integral closed, outer one adaptive
//! ```
//!
//! | parameter | meaning | unit |
//! |---|---|---|
//! | `radius1_m`, `radius2_m`, `distance_m` | discs | m |
//! | `first`, `second` | corners of planar polygons, in order, common origin | m |
//! | `rel_tol` | relative tolerance asked for | 1 |
//!
//! The etendue is π A₁ F₁₂; r₀ is any constant length and keeps the logarithms small. Discs: Howell, A Catalog of Radiation Heat
//! Transfer Configuration Factors (coaxial parallel disks of unequal radius), freed of `X − √(X² − 4…)`. Polygons: Sparrow, J. Heat Transfer 85 (1963) 81. Where the contour sum
//! cancels (surfaces that are small against their distance) the closed form of one polygon is averaged over the other.

use super::aperture::{Aperture, Bounded, aperture_average};
use super::frame::power_of_two_scale;
use super::polygon::polygon_two_sided;
use super::quadrature::integrate_to;
use crate::math::DVec3;
use std::f64::consts::PI;

/// Etendue, m² sr, of two coaxial parallel discs; 0 if one has no radius, the smaller area times π at distance 0.
pub fn coaxial_discs(radius1_m: f64, radius2_m: f64, distance_m: f64) -> f64 {
    let size = radius1_m.abs().max(radius2_m.abs()).max(distance_m.abs());
    let Some(scale) = power_of_two_scale(size) else {
        return 0.0;
    };
    let (r1, r2, h) = (radius1_m * scale, radius2_m * scale, distance_m * scale);
    if !(r1 > 0.0 && r2 > 0.0 && h.is_finite()) {
        return 0.0;
    }
    let p = r1 * r1 + r2 * r2 + h * h;
    let d = h.hypot(r1 - r2) * h.hypot(r1 + r2);
    2.0 * PI * PI * (r1 * r1 / (p + d)) * (r2 / scale) * (r2 / scale)
}

/// Etendue, m² sr, of two polygons that see each other without obstruction and lie each on one side of the other's plane. `None` if `rel_tol` cannot be met or
/// the input is degenerate.
///
/// Common edges and narrow gaps are allowed; a strip along such an edge may have a tolerance of 1e-7 instead, and its error says so. The winding of the polygons does not matter.
pub fn polygons(first: &[DVec3], second: &[DVec3], rel_tol: f64) -> Option<Bounded> {
    if first.len() < 3 || second.len() < 3 || !first.iter().chain(second).all(|v| v.is_finite()) {
        return None;
    }
    // A common origin near the surfaces, then a common scale.
    let origin = first[0];
    let size = first.iter().chain(second).fold(0.0_f64, |size, &v| size.max((v - origin).abs().max_element()));
    let scale = power_of_two_scale(size)?;
    let [a, b] = [first, second].map(|vertices| vertices.iter().map(|&v| (v - origin) * scale).collect::<Vec<_>>());
    let contour = double_contour(&a, &b);
    let enough = if nearest(&a, &b).min(nearest(&b, &a)) < NEARLY_TOUCHING { rel_tol.max(TOLERANCE_OF_STRIPS) } else { rel_tol };
    let result = if contour.error <= 0.5 * enough * contour.value { contour } else { area_average(&a, &b, rel_tol)? };
    let back = |v: f64| v / scale / scale;
    Some(Bounded { value: back(result.value), error: back(result.error) })
}

/// Distance, as a share of the size of both surfaces together, below which an average over the area does not converge.
const NEARLY_TOUCHING: f64 = 0.01;
/// The contour integral of a strip along an edge cancels to its width: what is left is good enough there.
const TOLERANCE_OF_STRIPS: f64 = 1e-7;

/// Smallest distance of the corners of one polygon from the edges of another.
fn nearest(corners: &[DVec3], outline: &[DVec3]) -> f64 {
    let to_edge = |p: DVec3, i: usize| {
        let (from, to) = (outline[i], outline[(i + 1) % outline.len()]);
        let side = to - from;
        let along = (side.dot(p - from) / side.length_squared()).clamp(0.0, 1.0);
        (p - from - side * along).length()
    };
    corners.iter().flat_map(|&p| (0..outline.len()).map(move |i| to_edge(p, i))).fold(f64::INFINITY, f64::min)
}

/// `½ |∮∮ ln(r/r₀) ds₁·ds₂|`.
fn double_contour(a: &[DVec3], b: &[DVec3]) -> Bounded {
    let centre = |v: &[DVec3]| v.iter().sum::<DVec3>() / v.len() as f64;
    let apart = (centre(a) - centre(b)).length();
    let unit_length = if apart > 0.0 { apart } else { 1.0 };
    let edges = |v: &[DVec3]| (0..v.len()).map(|i| (v[i], v[(i + 1) % v.len()])).collect::<Vec<_>>();
    let (mut value, mut error) = (0.0, 0.0);
    for &(p0, p1) in &edges(a) {
        for &(q0, q1) in &edges(b) {
            let (dp, dq) = (p1 - p0, q1 - q0);
            let (lp, lq) = (dp.length(), dq.length());
            let cosine = dp.dot(dq);
            if lp == 0.0 || lq == 0.0 || cosine == 0.0 {
                continue;
            }
            let along = dq / lq;
            // Positions on the first edge that are nearest to the ends of the second: there the inner integral varies fastest.
            let mut breaks = vec![0.0, 1.0];
            breaks.extend([q0, q1].map(|q| (q - p0).dot(dp) / (lp * lp)).into_iter().filter(|t| *t > 0.0 && *t < 1.0));
            breaks.sort_by(f64::total_cmp);
            breaks.dedup();
            let noise = std::cell::Cell::new(0.0_f64);
            let inner = |t: f64| {
                let v = p0 + dp * t - q0;
                let u = v.dot(along);
                let across = v.cross(along).length();
                let ends = [lq - u, u].map(|x| (x, log_integral(x, across, unit_length)));
                let terms: f64 = ends.iter().map(|(x, value)| x.abs() + value.abs()).sum();
                noise.set(noise.get().max(f64::EPSILON * terms / lq));
                (ends[0].1 + ends[1].1) / lq
            };
            let integral = integrate_to(&breaks, &inner, 1e-14, 2.0 * f64::EPSILON);
            value += cosine * integral.value;
            error += cosine.abs() * (integral.error + noise.get());
        }
    }
    Bounded { value: 0.5 * value.abs(), error: 0.5 * error }
}

/// `∫₀ˣ ln(√(t² + q²)/r₀) dt`.
fn log_integral(x: f64, q: f64, r0: f64) -> f64 {
    if x == 0.0 {
        return 0.0;
    }
    x * ((x.hypot(q) / r0).ln() - 1.0) + q * (x / q.max(f64::MIN_POSITIVE)).atan()
}

/// Closed form of the second polygon averaged over the first, triangle by triangle; the signs of a fan allow for re-entrant corners.
fn area_average(a: &[DVec3], b: &[DVec3], rel_tol: f64) -> Option<Bounded> {
    let area: DVec3 = a.windows(2).skip(1).map(|pair| (pair[0] - a[0]).cross(pair[1] - a[0])).sum();
    let mut normal = area.try_normalize()?;
    if b.iter().map(|&q| normal.dot(q - a[0])).sum::<f64>() < 0.0 {
        normal = -normal;
    }
    let integrand = |x: DVec3| polygon_two_sided(&b.iter().map(|&q| q - x).collect::<Vec<_>>(), normal);
    let (mut value, mut error) = (0.0, 0.0);
    for pair in a.windows(2).skip(1) {
        let cross = (pair[0] - a[0]).cross(pair[1] - a[0]);
        let triangle_area = 0.5 * cross.length().copysign(cross.dot(area));
        if triangle_area == 0.0 {
            continue;
        }
        let mean = aperture_average(Aperture::Triangle([a[0], pair[0], pair[1]]), &integrand, 0.3 * rel_tol)?;
        value += triangle_area * mean.value;
        error += triangle_area.abs() * mean.error;
    }
    (error <= rel_tol * value.abs()).then_some(Bounded { value: value.abs(), error })
}
