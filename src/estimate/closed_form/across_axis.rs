//! Uniform sources weighted with the sine of the angle from an axis: what a small cylinder sees, times π.
//!
//! ```text
//! C = ∫ sin ε dω = ∮ F(ε) dφ,   F = ∫₀^ε sin²ε′ dε′ = (ε − sin ε cos ε)/2       over the outline, (ε, φ) about the axis
//! edge of a polygon       dφ = p·g/sin²ε dψ,  cos ε = √(1 − (p·g)²) cos ψ       along its great circle of normal g
//! rim of a disc           dφ = p·(q × q′)/(|q|² sin²ε) dt
//! half space              C = π²/2 whatever the axis;  everything  C = π²
//! ```
//!
//! | parameter | meaning | unit, range |
//! |---|---|---|
//! | `vertices`, `centre` | relative to the receiver | m |
//! | `axis` | axis p of the cylinder, any length; its sign does not matter | 1 |
//! | `half_angle_sin`, `half_angle_cos` | spherical cap, half angle up to a right angle | 1 |
//!
//! p is turned so that it pierces the plane of the source in front of the receiver: then the source may hold the pole p, where F = 0, but
//! never the pole −p. The integrand is smooth along each edge. Where the sum around a small source cancels to more than 1e-12, ∫ sin ε dω
//! is taken over its area instead.

use super::aperture::{Aperture, Bounded, aperture_average};
use super::frame::{Frame, power_of_two_scale, unit};
use super::polygon::{LocalPolygon, MAX_ROUNDING};
use super::quadrature::integrate_between;
use crate::math::DVec3;
use std::cell::Cell;
use std::f64::consts::{PI, TAU};

/// Relative tolerance of the quadrature along an outline.
const OUTLINE: f64 = 1e-13;
/// Relative tolerance of the quadrature over an area.
const AREA: f64 = 1e-12;

/// C of a half space whose edge passes through the receiver.
pub const HALF_SPACE: f64 = 0.5 * PI * PI;
/// C of everything.
pub const EVERYTHING: f64 = PI * PI;

/// A sum around an outline with what its quadrature and its rounding may have spoilt.
#[derive(Default)]
struct Outline {
    value: f64,
    error: f64,
    rounding: f64,
}

impl Outline {
    fn or_by_area(self, area: impl FnOnce() -> Option<Bounded>) -> Bounded {
        if self.rounding > MAX_ROUNDING * self.value
            && let Some(found) = area()
        {
            return found;
        }
        Bounded { value: self.value.clamp(0.0, EVERYTHING), error: self.error + self.rounding }
    }
}

/// C of a plane polygon; both sides emit.
pub fn polygon(vertices: &[DVec3], axis: DVec3) -> Bounded {
    let Some(local) = LocalPolygon::new(vertices, axis).filter(|p| p.height > 0.0) else {
        return Bounded { value: 0.0, error: 0.0 };
    };
    let pole = local.winding * 1.0_f64.copysign(local.m.z);
    let n = local.vertices.len();
    let mut outline = Outline::default();
    for i in 0..n {
        edge(&mut outline, local.vertices[i], local.relative[(i + 1) % n] - local.relative[i], pole, local.m.z < 0.0);
    }
    outline.or_by_area(|| {
        let (mut value, mut error) = (0.0, 0.0);
        for i in 1..n - 1 {
            let (u, v) = (local.relative[i], local.relative[i + 1]);
            let area = 0.5 * local.winding * u.cross(v).dot(local.m);
            if area != 0.0 {
                let first = local.vertices[0];
                let mean = aperture_average(Aperture::Triangle([first, first + u, first + v]), &from_plane(local.height), AREA)?;
                value += area * mean.value;
                error += area.abs() * mean.error;
            }
        }
        Some(Bounded { value, error })
    })
}

/// sin ε cos θ_s/r² at a point of a plane at this distance.
fn from_plane(height: f64) -> impl Fn(DVec3) -> f64 {
    move |q| {
        let r2 = q.length_squared();
        q.x.hypot(q.y) * height / (r2 * r2)
    }
}

/// Adds an edge from `a`, in coordinates whose third axis is the cylinder's; the pole is that axis or, `flipped`, its opposite.
fn edge(outline: &mut Outline, a: DVec3, edge: DVec3, sign: f64, flipped: bool) {
    let cross = a.cross(edge);
    let sine = cross.length();
    if sine <= 0.0 {
        return;
    }
    let g = cross / sine;
    let along = g.z.abs();
    if along == 0.0 {
        // A meridian: no azimuth passes.
        return;
    }
    let angle = sine.atan2(a.dot(a + edge));
    let level = g.x.hypot(g.y);
    let side = if flipped { -1.0 } else { 1.0 };
    // From the point of the great circle that is nearest to the pole.
    let start = (side * (g.y * a.x - g.x * a.y)).atan2(side * a.z);
    let mut stops = vec![start];
    stops.extend([-1.0, 0.0, 1.0].map(|k| k * PI).into_iter().filter(|stop| *stop > start && *stop < start + angle));
    stops.push(start + angle);
    let integrand = |psi: f64| {
        let (sin, cos) = psi.sin_cos();
        per_sine_squared((level * sin).hypot(along), level * cos)
    };
    let found = integrate_between(&stops, &integrand, OUTLINE);
    outline.value += sign * g.z * found.value;
    outline.error += along * found.error;
    let uncertain_normal = 1.0 + a.length() * edge.length() / sine;
    outline.rounding += 2.0 * f64::EPSILON * (along + uncertain_normal * level) * found.value;
}

/// F(ε)/sin²ε, from sine and cosine of ε.
fn per_sine_squared(sin: f64, cos: f64) -> f64 {
    let angle = sin.atan2(cos);
    let x = 2.0 * angle;
    // (x − sin x)/4 without cancellation.
    let quarter = if x < 0.7 {
        let (mut term, mut sum, mut k) = (x * x * x / 6.0, 0.0, 4.0);
        while term.abs() > 1e-18 * sum {
            sum += term;
            term *= -x * x / (k * (k + 1.0));
            k += 2.0;
        }
        0.25 * sum
    } else {
        0.5 * (angle - sin * cos)
    };
    if sin > 0.0 { quarter / (sin * sin) } else { 0.0 }
}

/// C of a disc; both sides emit.
pub fn disc(centre: DVec3, facing: DVec3, radius_m: f64, axis: DVec3) -> Bounded {
    let dark = Bounded { value: 0.0, error: 0.0 };
    let (Some(frame), Some(m)) = (Frame::new(axis), unit(facing)) else { return dark };
    let Some(scale) = power_of_two_scale(centre.abs().max_element().max(radius_m)).filter(|_| radius_m > 0.0) else { return dark };
    let (c, m, radius) = (frame.to_local(centre * scale), frame.to_local(m), radius_m * scale);
    let height = c.dot(m);
    if height == 0.0 {
        return dark;
    }
    let rim = Rim::new(c, if height < 0.0 { -m } else { m }, radius);
    rim.outline().or_by_area(|| {
        let whole = Aperture::Disc { centre: c, radius_u: radius * rim.u, radius_v: radius * rim.v };
        let mean = aperture_average(whole, &from_plane(height.abs()), AREA)?;
        let area = PI * radius * radius;
        Some(Bounded { value: area * mean.value, error: area * mean.error })
    })
}

/// C of a spherical cap about `direction`, its half angle by sine and cosine.
pub fn cap(direction: DVec3, half_angle_sin: f64, half_angle_cos: f64, axis: DVec3) -> Bounded {
    let (Some(frame), Some(c)) = (Frame::new(axis), unit(direction)) else {
        return Bounded { value: 0.0, error: 0.0 };
    };
    if half_angle_cos <= 0.0 {
        return Bounded { value: HALF_SPACE, error: 0.0 };
    }
    // The outline is that of a disc across the cap's axis.
    let c = frame.to_local(c);
    let rim = Rim::new(c * half_angle_cos, c, half_angle_sin);
    rim.outline().or_by_area(|| {
        let flat = Aperture::Disc { centre: DVec3::ZERO, radius_u: half_angle_sin * rim.u, radius_v: half_angle_sin * rim.v };
        let integrand = |q: DVec3| {
            let upright = (1.0 - q.length_squared()).max(0.0).sqrt();
            let to = q + upright * c;
            to.x.hypot(to.y) / upright
        };
        let mean = aperture_average(flat, &integrand, AREA)?;
        let area = PI * half_angle_sin * half_angle_sin;
        Some(Bounded { value: area * mean.value, error: area * mean.error })
    })
}

/// The rim of a disc, its normal away from the receiver, in coordinates whose third axis is the cylinder's.
struct Rim {
    centre: DVec3,
    normal: DVec3,
    radius: f64,
    u: DVec3,
    v: DVec3,
}

impl Rim {
    fn new(centre: DVec3, normal: DVec3, radius: f64) -> Rim {
        let (u, v) = crate::math::frame::tangents(normal);
        Rim { centre, normal, radius, u, v }
    }

    fn outline(&self) -> Outline {
        let side = if self.normal.z < 0.0 { -1.0 } else { 1.0 };
        let terms = Cell::new(0.0_f64);
        let integrand = |t: f64| {
            let (sin, cos) = t.sin_cos();
            let q = self.centre + self.radius * (cos * self.u + sin * self.v);
            let turn = (self.centre.cross(cos * self.v - sin * self.u)).z + self.radius * self.normal.z;
            let r = q.length();
            let per_sine_squared = per_sine_squared(q.x.hypot(q.y) / r, side * q.z / r);
            let size = self.radius / r * per_sine_squared;
            terms.set(terms.get().max(size * (self.centre.length() + self.radius) / r));
            side * size * turn / r
        };
        // Where the rim is nearest to the receiver, and where to either pole, the integrand varies fastest.
        let pierced = DVec3::Z * (self.centre.dot(self.normal) / self.normal.z);
        let towards_pole = if pierced.is_finite() { pierced - self.centre } else { DVec3::Z };
        let angle = |d: DVec3| d.dot(self.v).atan2(d.dot(self.u));
        let nearest = [angle(-self.centre), angle(towards_pole)];
        let mut stops: Vec<f64> = nearest.into_iter().flat_map(|t| [t, t + PI]).map(|t| (t - nearest[0]).rem_euclid(TAU)).collect();
        stops.extend([0.0, TAU]);
        stops.sort_by(f64::total_cmp);
        stops.dedup();
        let stops: Vec<f64> = stops.into_iter().map(|t| t + nearest[0]).collect();
        let found = integrate_between(&stops, &integrand, OUTLINE);
        Outline { value: found.value, error: found.error, rounding: 4.0 * f64::EPSILON * TAU * terms.get() }
    }
}
