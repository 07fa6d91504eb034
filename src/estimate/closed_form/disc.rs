//! Uniform disc: any position, any tilt of disc and receiver, cut by the horizon or by a cone of acceptance.
//!
//! ```text
//! h = distance of the disc's plane, l = lateral distance of its axis,  S² = (h² + (l−R)²)(h² + (l+R)²),  Z = h² + l² + R²
//! parallel element        G = 2π R² h² / (S (S + h² + l² − R²))
//! wholly above the horizon G = 2π R² / (S (Z + S)) · (h n·c + q n·m),   q = 2R²h²/(S + h² + l² − R²)
//! cut                     strips of constant azimuth (`fan.rs`)
//! ```
//!
//! | parameter | meaning | unit |
//! |---|---|---|
//! | `centre` | centre relative to the receiver | m |
//! | `facing` | normal of the emitting side, any length | 1 |
//! | `radius_m` | radius R | m |
//! | `normal` | receiver's normal n, any length | 1 |
//!
//! Source: Howell, A Catalog of Radiation Heat Transfer Configuration Factors (element to disk, parallel and perpendicular), combined to the flux vector and freed of the
//! differences `1 − (…)/√(…)`; m is the unit normal of the disc away from the receiver. In the plane of the disc the result is the limit
//! from its emitting side: π(1 + n·m)/2 inside, 0 on the rim and outside.

use super::cone;
use super::fan::{Acceptance, StripLine, StripPoint, integrate_azimuth};
use super::frame::{Frame, dot, power_of_two_scale, unit};
use super::sign_change::sign_changes_in_unit_interval;
use crate::math::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};

/// Projected solid angle, sr, of a one-sided disc; 0 for a receiver behind it.
pub fn disc(centre: DVec3, facing: DVec3, radius_m: f64, normal: DVec3) -> f64 {
    if receiver_in_front(centre, facing) { disc_two_sided(centre, facing, radius_m, normal) } else { 0.0 }
}

/// Projected solid angle, sr, of a disc that emits to both sides. In its plane: the limit from the side from which the receiver faces it.
pub fn disc_two_sided(centre: DVec3, facing: DVec3, radius_m: f64, normal: DVec3) -> f64 {
    disc_in_acceptance(centre, facing, radius_m, normal, Acceptance::HEMISPHERE)
}

/// Projected solid angle, sr, of a disc (two-sided) within a cone of half angle `half_angle_rad` about the receiver's normal.
pub fn disc_in_cone(centre: DVec3, facing: DVec3, radius_m: f64, normal: DVec3, half_angle_rad: f64) -> f64 {
    Acceptance::new(half_angle_rad).map_or(0.0, |acceptance| disc_in_acceptance(centre, facing, radius_m, normal, acceptance))
}

/// Whether a disc of emitting side `facing` about `centre` (m, relative to the receiver) turns that side to the receiver; true in its plane.
pub fn receiver_in_front(centre: DVec3, facing: DVec3) -> bool {
    match (unit(centre), unit(facing)) {
        (Some(c), Some(m)) => dot(c, m) <= 0.0,
        (None, Some(_)) => centre == DVec3::ZERO,
        _ => false,
    }
}

/// Projected solid angle, sr, of a disc at height `height_m` over an element parallel to it, its axis `lateral_m` away.
pub fn parallel_disc(height_m: f64, lateral_m: f64, radius_m: f64) -> f64 {
    disc_two_sided(DVec3::new(lateral_m.abs(), 0.0, height_m.abs()), DVec3::Z, radius_m, DVec3::Z)
}

pub(super) fn disc_in_acceptance(centre: DVec3, facing: DVec3, radius_m: f64, normal: DVec3, acceptance: Acceptance) -> f64 {
    Disc::new(centre, facing, radius_m, normal).map_or(0.0, |disc| disc.seen(acceptance).max(0.0))
}

/// A disc in receiver coordinates, scaled; the first axis points towards its centre.
struct Disc {
    centre: DVec3,
    /// Unit normal, away from the receiver.
    m: DVec3,
    radius: f64,
    /// Distance of the plane.
    height: f64,
    /// Distance of the axis.
    lateral: f64,
}

impl Disc {
    fn new(centre: DVec3, facing: DVec3, radius_m: f64, normal: DVec3) -> Option<Disc> {
        if radius_m.is_nan() || radius_m <= 0.0 || !centre.is_finite() {
            return None;
        }
        let scale = power_of_two_scale(centre.abs().max_element().max(radius_m))?;
        let c = centre * scale;
        let facing = unit(facing)?;
        let frame = Frame::new(normal)?.turned_towards(c);
        let signed_height = dot(facing, c);
        let m = frame.to_local(facing);
        // In the plane itself the receiver faces the side that it can see.
        let away = if signed_height == 0.0 { m.z < 0.0 } else { signed_height < 0.0 };
        Some(Disc {
            centre: frame.to_local(c),
            m: if away { -m } else { m },
            radius: radius_m * scale,
            height: signed_height.abs(),
            lateral: c.cross(facing).length(),
        })
    }

    fn seen(&self, acceptance: Acceptance) -> f64 {
        let Disc { centre: c, m, radius, height, .. } = *self;
        if height == 0.0 {
            let inside = self.lateral < radius;
            return match (inside, acceptance.cos == 0.0) {
                (false, _) => 0.0,
                (true, true) => FRAC_PI_2 * (1.0 + m.z).max(0.0),
                (true, false) => cone::half_space_about_axis(m, acceptance),
            };
        }
        // Height of the highest and the lowest point of the rim above and below the centre.
        let rise = radius * m.x.hypot(m.y);
        if c.z + rise <= 0.0 {
            return 0.0;
        }
        if acceptance.cos == 0.0 {
            return if c.z - rise >= 0.0 { self.flux_vector_component() } else { self.strips(&self.horizon_breaks(), acceptance) };
        }
        let crossings = self.cone_crossings(acceptance);
        if crossings.is_empty() {
            // The rim is wholly inside or wholly outside; any point of it tells.
            let rim = c + radius * self.steepest();
            if rim.z > 0.0 && acceptance.depth(rim.x.hypot(rim.y), rim.z) >= 0.0 {
                // A rim that is cut by the horizon leaves the cone just above it, if closer than the roots can tell.
                return if c.z - rise >= 0.0 { self.flux_vector_component() } else { self.strips(&self.horizon_breaks(), acceptance) };
            }
            return if self.axis_pierces() { PI * acceptance.sin * acceptance.sin } else { 0.0 };
        }
        self.strips(&[self.horizon_breaks(), crossings].concat(), acceptance)
    }

    /// n · ∫ ω dΩ: the projected solid angle if no part is below the horizon.
    fn flux_vector_component(&self) -> f64 {
        let Disc { centre: c, m, radius, height, lateral } = *self;
        let near = lateral - radius;
        let far = lateral + radius;
        let s = height.hypot(near) * height.hypot(far);
        let z = height * height + lateral * lateral + radius * radius;
        let p = height * height + near * far;
        let q = if p >= 0.0 { height * height * 2.0 * radius * radius / (s + p) } else { 0.5 * (s - p) };
        2.0 * PI * radius * radius * (height * c.z + q * m.z) / (s * (z + s))
    }

    /// Direction in the plane of the disc that rises most steeply from the horizon.
    fn steepest(&self) -> DVec3 {
        let flat = self.m.x.hypot(self.m.y);
        if flat > 0.0 { DVec3::new(-self.m.x * self.m.z / flat, -self.m.y * self.m.z / flat, flat) } else { DVec3::X }
    }

    /// Azimuth, relative to the centre's, of the point of the rim at `offset` from the centre.
    fn azimuth(&self, offset: DVec3) -> f64 {
        let c = self.centre;
        (c.x * offset.y - c.y * offset.x).atan2(c.x * (c.x + offset.x) + c.y * (c.y + offset.y))
    }

    /// Azimuths at which chords begin or end: tangents to the rim, and the rim's passage through the horizon.
    fn horizon_breaks(&self) -> Vec<f64> {
        let Disc { centre: c, m, radius, .. } = *self;
        let mut breaks = vec![0.0, -FRAC_PI_2, FRAC_PI_2];
        if c.x == 0.0 && c.y == 0.0 {
            return breaks;
        }
        // |c_xy|² t² + R² (m_y − m_x t)² = R² (1 + t²) for the tangent of the azimuth of a tangent plane.
        let (a, b, d) =
            (c.x * c.x - radius * radius * (1.0 - m.x * m.x), -radius * radius * m.x * m.y, -radius * radius * (m.x * m.x + m.z * m.z));
        let discriminant = b * b - a * d;
        if discriminant >= 0.0 {
            let sum = -(b + discriminant.sqrt().copysign(b));
            for (y, x) in [(sum, a), (d, sum)] {
                breaks.extend([y.atan2(x), (-y).atan2(-x)]);
            }
        }
        let rise = radius * m.x.hypot(m.y);
        if c.z.abs() < rise {
            let steepest = self.steepest();
            let level = m.cross(steepest);
            let cos = -c.z / rise;
            let sin = ((rise - c.z.abs()) * (rise + c.z.abs())).sqrt() / rise;
            for side in [sin, -sin] {
                breaks.push(self.azimuth(radius * (cos * steepest + side * level)));
            }
        }
        breaks
    }

    /// Azimuths at which the rim passes through the edge of the cone.
    fn cone_crossings(&self, acceptance: Acceptance) -> Vec<f64> {
        let steepest = self.steepest();
        let level = self.m.cross(steepest);
        let Acceptance { cos, sin } = acceptance;
        let mut azimuths = Vec::new();
        // Two halves of the rim, each rational in t = tan(ψ/2) from −1 to 1: p(1 + t²) = (c + Ru) + 2Rv t + (c − Ru) t².
        for u in [steepest, -steepest] {
            let p = [self.centre + self.radius * u, 2.0 * self.radius * level, self.centre - self.radius * u];
            let form = |a: DVec3, b: DVec3| cos * cos * (a.x * b.x + a.y * b.y) - sin * sin * (a.z * b.z);
            let quartic = [
                form(p[0], p[0]),
                2.0 * form(p[0], p[1]),
                2.0 * form(p[0], p[2]) + form(p[1], p[1]),
                2.0 * form(p[1], p[2]),
                form(p[2], p[2]),
            ];
            for t in sign_changes_in_unit_interval(&quartic) {
                let w = 1.0 + t * t;
                let offset = self.radius * ((1.0 - t * t) / w * u + 2.0 * t / w * level);
                if self.centre.z + offset.z >= 0.0 {
                    azimuths.push(self.azimuth(offset));
                }
            }
        }
        azimuths
    }

    /// Whether the receiver's normal itself meets the disc.
    fn axis_pierces(&self) -> bool {
        self.m.z > 0.0 && (DVec3::Z * (self.height / self.m.z) - self.centre).length() < self.radius
    }

    fn strips(&self, breaks: &[f64], acceptance: Acceptance) -> f64 {
        let Disc { centre: c, m, radius, height, .. } = *self;
        let strip = |phi: f64| {
            let (sin, cos) = phi.sin_cos();
            // Components of the disc's normal in the half plane and across it.
            let along = m.x * cos + m.y * sin;
            let across = m.y * cos - m.x * sin;
            let k = along.hypot(m.z);
            if k == 0.0 {
                return 0.0;
            }
            let offset = -(c.x * sin - c.y * cos) / k;
            let margin = (radius - offset.abs()) * (radius + offset.abs());
            if margin <= 0.0 {
                return 0.0;
            }
            // The middle of the chord is the foot of the perpendicular from the centre to the line.
            let line = StripLine {
                base: StripPoint { rho: c.x * cos + c.y * sin + offset * across * along / k, z: c.z + offset * across * m.z / k },
                across: StripPoint { rho: along / k, z: m.z / k },
                distance: height / k,
            };
            let half = margin.sqrt();
            line.chord(-half, half, acceptance)
        };
        integrate_azimuth(breaks.to_vec(), &strip).value
    }
}
