//! Uniform planar polygon within a cone of acceptance about the receiver's normal.
//!
//! ```text
//! G = ½ Σ θᵢ γᵢ·n  +  ½ sin²β Σ Δφⱼ
//! ```
//!
//! The contour of the common part: edges i, cut to what lies in the cone, and arcs j of the cone's circle, of azimuth Δφ, that lie in the polygon.
//!
//! | parameter | meaning | unit, range |
//! |---|---|---|
//! | `vertices` | corners relative to the receiver, in order; planar, simple, convex or not | m |
//! | `normal` | receiver's normal and axis of the cone, any length | 1 |
//! | `half_angle_rad` | half angle β of the cone; from a right angle on there is only the horizon | rad |
//!
//! Where the sum cancels, strips of constant azimuth take over as in `polygon.rs`. Edges: Lambert, Photometria (1760); arcs: area of a
//! sector of the circle of radius sin β in the orthographic projection.

use super::cone;
use super::fan::Acceptance;
use super::polygon::{EdgeSum, LocalPolygon, MAX_ROUNDING};
use crate::math::DVec3;
use std::f64::consts::PI;

/// Projected solid angle, sr, of a polygon (two-sided) within a cone of half angle `half_angle_rad` about the receiver's normal.
///
/// Contour of straight edges and arcs of the cone, each arc of azimuth Δφ with `½ sin²β Δφ`.
pub fn polygon_in_cone(vertices: &[DVec3], normal: DVec3, half_angle_rad: f64) -> f64 {
    let (Some(polygon), Some(acceptance)) = (LocalPolygon::new(vertices, normal), Acceptance::new(half_angle_rad)) else {
        return 0.0;
    };
    if acceptance.cos == 0.0 {
        return polygon.above_horizon().clamp(0.0, PI);
    }
    if polygon.height == 0.0 {
        let inside = polygon.contains_direction(DVec3::ZERO);
        return if inside { cone::half_space_about_axis(polygon.m, acceptance) } else { 0.0 };
    }
    polygon.accepted(acceptance).clamp(0.0, PI * acceptance.sin * acceptance.sin)
}

impl LocalPolygon {
    fn accepted(&self, acceptance: Acceptance) -> f64 {
        let Acceptance { cos, sin } = acceptance;
        let inside = |p: DVec3| p.z > 0.0 && acceptance.depth(p.x.hypot(p.y), p.z) > 0.0;
        let mut sum = EdgeSum::default();
        let mut azimuths = Vec::new();
        for (a, b) in self.edges() {
            azimuths.push(a.y.atan2(a.x));
            let mut stops = vec![0.0];
            stops.extend(edge_crossings(a, b - a, acceptance));
            stops.push(1.0);
            for pair in stops.windows(2) {
                let point = |t: f64| if t == 1.0 { b } else { a + (b - a) * t };
                if pair[0] > 0.0 {
                    let p = point(pair[0]);
                    azimuths.push(p.y.atan2(p.x));
                }
                if inside(point(0.5 * (pair[0] + pair[1]))) {
                    sum.add(point(pair[0]), point(pair[1]));
                }
            }
        }
        azimuths.sort_by(f64::total_cmp);
        let mut arc = 0.0;
        for i in 0..azimuths.len() {
            let start = azimuths[i];
            let end = if i + 1 < azimuths.len() { azimuths[i + 1] } else { azimuths[0] + 2.0 * PI };
            let (y, x) = (0.5 * (start + end)).sin_cos();
            if end > start && self.contains_direction(DVec3::new(sin * x, sin * y, cos)) {
                arc += end - start;
            }
        }
        let value = self.winding * sum.value + 0.5 * sin * sin * arc;
        let rounding = sum.rounding + if arc > 0.0 { 8.0 * f64::EPSILON * sin * sin } else { 0.0 };
        if sum.value == 0.0 && arc == 0.0 {
            0.0
        } else if rounding <= MAX_ROUNDING * value {
            value
        } else {
            self.strips(&self.cone_crossings(acceptance), acceptance)
        }
    }

    /// Azimuths, relative to the first vertex, where the boundary passes through the edge of the cone.
    fn cone_crossings(&self, acceptance: Acceptance) -> Vec<f64> {
        let n = self.vertices.len();
        let first = self.vertices[0];
        let mut azimuths = Vec::new();
        for i in 0..n {
            let (da, db) = (self.relative[i], self.relative[(i + 1) % n]);
            for t in edge_crossings(self.vertices[i], db - da, acceptance) {
                let d = da + (db - da) * t;
                azimuths.push((first.y + d.y).atan2(first.x + d.x));
            }
        }
        azimuths
    }
}

/// Parameters t in (0, 1) at which a + t·d passes through the edge of the cone, in ascending order; d not shortened by rounding.
fn edge_crossings(a: DVec3, d: DVec3, acceptance: Acceptance) -> Vec<f64> {
    let Acceptance { cos, sin } = acceptance;
    let form = |p: DVec3, q: DVec3| cos * cos * (p.x * q.x + p.y * q.y) - sin * sin * p.z * q.z;
    // The discriminant is the margin by which the plane of the edge cuts the cone.
    let w = a.cross(d);
    let flat = w.x.hypot(w.y);
    let discriminant = cos * cos * (sin * flat - cos * w.z.abs()) * (sin * flat + cos * w.z.abs());
    if discriminant <= 0.0 {
        return Vec::new();
    }
    let rho = a.x.hypot(a.y);
    let (first, half, last) = (form(d, d), form(a, d), (cos * rho - sin * a.z) * (cos * rho + sin * a.z));
    let sum = -(half + discriminant.sqrt().copysign(half));
    let mut roots: Vec<f64> = [sum / first, last / sum].into_iter().filter(|t| *t > 0.0 && *t < 1.0).collect();
    roots.sort_by(f64::total_cmp);
    roots
}
