//! Uniform planar polygon, clipped at the receiver's horizon.
//!
//! ```text
//! G = ½ |Σ θᵢ γᵢ·n|,   θᵢ = atan2(|a×b|, a·b),   γᵢ = (a×b)/|a×b|       over the edges a→b of the clipped polygon
//! ```
//!
//! | parameter | meaning | unit |
//! |---|---|---|
//! | `vertices` | corners relative to the receiver, in order; planar, simple, convex or not (to be checked by the caller) | m |
//! | `normal` | receiver's normal, any length | 1 |
//!
//! Lambert, Photometria (1760), theorem 16; in this form Arvo, Analytic Methods for Simulated Light Transport (1995). The front of a polygon is
//! the side from which its vertices run counterclockwise.
//!
//! The sum cancels for polygons that are small or seen edge-on. Its rounding error is estimated from its terms, and where it exceeds
//! 1e-12 of the sum the strips of `fan.rs` take over. In the plane of the polygon the result is the limit from the side that the
//! receiver faces: π(1 + |n·m|)/2 strictly inside, 0 on the boundary and outside.

use super::fan::{Acceptance, StripLine, StripPoint, integrate_azimuth};
use super::frame::{Frame, power_of_two_scale, triple};
use crate::math::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};

/// Largest estimated relative rounding error with which the sum over edges is accepted.
pub(super) const MAX_ROUNDING: f64 = 1e-12;

/// Projected solid angle, sr, of a one-sided polygon; 0 for a receiver behind it.
pub fn polygon(vertices: &[DVec3], normal: DVec3) -> f64 {
    if receiver_in_front(vertices) { polygon_two_sided(vertices, normal) } else { 0.0 }
}

/// Projected solid angle, sr, of a polygon that emits to both sides.
pub fn polygon_two_sided(vertices: &[DVec3], normal: DVec3) -> f64 {
    LocalPolygon::new(vertices, normal).map_or(0.0, |polygon| polygon.above_horizon().clamp(0.0, PI))
}

/// Whether the receiver is in front of a polygon, or in its plane.
pub fn receiver_in_front(vertices: &[DVec3]) -> bool {
    scaled(vertices).is_some_and(|v| volume(&v) <= 0.0)
}

/// Vertices scaled by a power of two; `None` if there is no extent or a coordinate is not finite.
fn scaled(vertices: &[DVec3]) -> Option<Vec<DVec3>> {
    if vertices.len() < 3 || !vertices.iter().all(|v| v.is_finite()) {
        return None;
    }
    let size = vertices.iter().fold(0.0_f64, |size, v| size.max(v.abs().max_element()));
    let scale = power_of_two_scale(size)?;
    Some(vertices.iter().map(|&v| v * scale).collect())
}

/// First vertex times twice the vector area: the distance of the plane times twice the area, positive behind the polygon.
fn volume(vertices: &[DVec3]) -> f64 {
    let first = vertices[0];
    vertices.windows(2).skip(1).map(|pair| triple(first, pair[0], pair[1])).sum()
}

/// A polygon in receiver coordinates, scaled; the first axis points towards the first vertex.
pub(super) struct LocalPolygon {
    pub(super) vertices: Vec<DVec3>,
    /// Vertices less the first one: sizes small against the distance keep their precision.
    pub(super) relative: Vec<DVec3>,
    /// Unit normal away from the receiver.
    pub(super) m: DVec3,
    /// Distance of the plane.
    pub(super) height: f64,
    /// +1 if the vertices run counterclockwise about `m`, else −1.
    pub(super) winding: f64,
}

impl LocalPolygon {
    pub(super) fn new(vertices: &[DVec3], normal: DVec3) -> Option<LocalPolygon> {
        let mut world = scaled(vertices)?;
        // Everything is taken relative to the nearest vertex: rounding is largest where it matters least.
        let length = |i: &usize| world[*i].length_squared();
        let nearest = (0..world.len()).min_by(|i, j| length(i).total_cmp(&length(j)))?;
        world.rotate_left(nearest);
        let first = world[0];
        let area: DVec3 = world[1..].windows(2).map(|pair| (pair[0] - first).cross(pair[1] - first)).sum();
        let twice_area = area.length();
        if twice_area.is_nan() || twice_area <= 0.0 {
            return None;
        }
        let volume = volume(&world);
        let frame = Frame::new(normal)?.turned_towards(first);
        let m = frame.to_local(area / twice_area);
        let away = if volume == 0.0 { m.z < 0.0 } else { volume < 0.0 };
        Some(LocalPolygon {
            vertices: world.iter().map(|&v| frame.to_local(v)).collect(),
            relative: world.iter().map(|&v| frame.to_local(v - first)).collect(),
            m: if away { -m } else { m },
            height: volume.abs() / twice_area,
            winding: if away { -1.0 } else { 1.0 },
        })
    }

    pub(super) fn edges(&self) -> impl Iterator<Item = (DVec3, DVec3)> + '_ {
        let n = self.vertices.len();
        (0..n).map(move |i| (self.vertices[i], self.vertices[(i + 1) % n]))
    }

    /// Projected solid angle above the horizon.
    pub(super) fn above_horizon(&self) -> f64 {
        if self.height == 0.0 {
            return if self.contains_direction(DVec3::ZERO) { FRAC_PI_2 * (1.0 + self.m.z).max(0.0) } else { 0.0 };
        }
        let clipped = self.clipped_at_horizon();
        if clipped.iter().all(|v| v.z <= 0.0) {
            return 0.0;
        }
        let mut sum = EdgeSum::default();
        for i in 0..clipped.len() {
            sum.add(clipped[i], clipped[(i + 1) % clipped.len()]);
        }
        let value = self.winding * sum.value;
        if sum.rounding <= MAX_ROUNDING * value { value } else { self.strips(&[], Acceptance::HEMISPHERE) }
    }

    /// Vertices at and above the horizon, and the points where edges pass through it (Sutherland–Hodgman).
    fn clipped_at_horizon(&self) -> Vec<DVec3> {
        let mut clipped = Vec::with_capacity(self.vertices.len() + 2);
        for (a, b) in self.edges() {
            if a.z >= 0.0 {
                clipped.push(a);
            }
            if (a.z > 0.0 && b.z < 0.0) || (a.z < 0.0 && b.z > 0.0) {
                clipped.push(between(a, b, a.z, b.z).with_z(0.0));
            }
        }
        clipped
    }

    /// Whether a direction meets the inside of the polygon (even–odd rule); the zero vector asks for the receiver itself, if in the plane.
    pub(super) fn contains_direction(&self, direction: DVec3) -> bool {
        let facing = self.m.dot(direction);
        let point = if direction == DVec3::ZERO {
            DVec3::ZERO
        } else if facing > 0.0 {
            direction * (self.height / facing)
        } else {
            return false;
        };
        // Drop the coordinate along which the plane is seen best.
        let m = self.m.abs();
        let flat = |v: DVec3| {
            if m.z >= m.x && m.z >= m.y {
                (v.x, v.y)
            } else if m.x >= m.y {
                (v.y, v.z)
            } else {
                (v.z, v.x)
            }
        };
        let (px, py) = flat(point);
        let mut inside = false;
        for (a, b) in self.edges() {
            let ((ax, ay), (bx, by)) = (flat(a), flat(b));
            let side = (bx - ax) * (py - ay) - (by - ay) * (px - ax);
            let on_edge = side == 0.0 && (px - ax) * (px - bx) + (py - ay) * (py - by) <= 0.0;
            if on_edge {
                return false;
            }
            if (ay > py) != (by > py) && (side > 0.0) == (by > ay) {
                inside = !inside;
            }
        }
        inside
    }

    /// Strips of constant azimuth; `crossings` are azimuths, relative to the first vertex, where the boundary passes through the edge of the cone.
    pub(super) fn strips(&self, crossings: &[f64], acceptance: Acceptance) -> f64 {
        let first = self.vertices[0];
        let mut breaks = vec![-FRAC_PI_2, FRAC_PI_2];
        breaks.extend_from_slice(crossings);
        let n = self.vertices.len();
        for i in 0..n {
            let (a, b) = (self.vertices[i], self.vertices[(i + 1) % n]);
            let (da, db) = (self.relative[i], self.relative[(i + 1) % n]);
            let at = |d: DVec3| (first.x * d.y).atan2(first.x * (first.x + d.x));
            breaks.push(if first.x > 0.0 { at(da) } else { a.y.atan2(a.x) });
            if (a.z > 0.0) != (b.z > 0.0) {
                let p = between(da, db, a.z, b.z);
                breaks.push(if first.x > 0.0 { at(p) } else { p.y.atan2(p.x) });
            }
        }
        let strip = |phi: f64| {
            let (sin, cos) = phi.sin_cos();
            let along = self.m.x * cos + self.m.y * sin;
            let k = along.hypot(self.m.z);
            let across = StripPoint { rho: along / k, z: self.m.z / k };
            // Foot of the perpendicular, in the plane of the polygon, from the first vertex to the line.
            let offset = -first.x * sin / k * (self.m.y * cos - self.m.x * sin);
            let base = StripPoint { rho: first.x * cos + offset * across.rho, z: first.z + offset * across.z };
            let line = StripLine { base, across, distance: self.height / k };
            let plane_distance = |d: DVec3| -first.x * sin + (d.y * cos - d.x * sin);
            let mut ends: Vec<f64> = Vec::with_capacity(4);
            for i in 0..n {
                let (a, b) = (self.relative[i], self.relative[(i + 1) % n]);
                let (ya, yb) = (plane_distance(a), plane_distance(b));
                if (ya > 0.0) == (yb > 0.0) {
                    continue;
                }
                let p = between(a, b, ya, yb);
                ends.push((p.x * cos + p.y * sin) * across.z - p.z * across.rho);
            }
            ends.sort_by(f64::total_cmp);
            let sum: f64 = ends.chunks_exact(2).map(|pair| line.chord(pair[0], pair[1], acceptance)).sum();
            if sum.is_finite() { sum.min(1.0) } else { 0.0 }
        };
        integrate_azimuth(breaks, &strip).value
    }
}

/// The point between `a` and `b` where a linear function with the values `at_a` and `at_b` vanishes; from the nearer end, so that
/// a long edge does not spoil the precision of its other end.
fn between(a: DVec3, b: DVec3, at_a: f64, at_b: f64) -> DVec3 {
    if at_a.abs() <= at_b.abs() { a + (b - a) * (at_a / (at_a - at_b)) } else { b + (a - b) * (at_b / (at_b - at_a)) }
}

/// `½ Σ θ γ_z` over edges, and an estimate of its rounding error.
#[derive(Default)]
pub(super) struct EdgeSum {
    pub(super) value: f64,
    pub(super) rounding: f64,
}

impl EdgeSum {
    pub(super) fn add(&mut self, a: DVec3, b: DVec3) {
        let edge = b - a;
        // a × (b − a) = a × b with the smaller error.
        let cross = a.cross(edge);
        let sine = cross.length();
        if sine <= 0.0 {
            return;
        }
        let angle = sine.atan2(a.dot(b));
        self.value += 0.5 * angle * (cross.z / sine);
        // Of the angle, and of the inclination of the edge's plane (which does not matter where that is level).
        let (la, lb, length) = (a.length(), b.length(), edge.length());
        let inclination = cross.x.hypot(cross.y) / sine;
        let rounding = length / la.min(lb) + angle * (1.0 + la * length / sine * inclination);
        self.rounding += f64::EPSILON * rounding;
    }
}
