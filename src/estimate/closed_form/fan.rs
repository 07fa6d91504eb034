//! Azimuthal strips: the projected solid angle of a plane source as an integral whose contributions are all positive.
//!
//! ```text
//! G = ½ ∫ Σ (sin²θ₂ − sin²θ₁) dφ = ½ ∫ Σ sin(θ₂ − θ₁) sin(θ₂ + θ₁) dφ
//! ```
//!
//! A half plane of azimuth φ through the receiver's normal cuts the plane of the source in a line and the source in chords of that
//! line. With the ends of a chord at (ρ₁, z₁) and (ρ₂, z₂), a length |Δ| and the line at the distance q from the receiver,
//!
//! ```text
//! sin(θ₂ − θ₁) sin(θ₂ + θ₁) = |Δ| q (ρ₁z₂ + ρ₂z₁) / (r₁² r₂²)
//! ```
//!
//! The horizon (z ≥ 0) and an acceptance cone about the normal (ρ cos β ≤ z sin β) are straight lines in the half plane, so the chord is
//! clipped exactly. The rest is a quadrature over φ between the azimuths where the chords change their law.

use super::quadrature::{Integral, integrate_between};
use std::f64::consts::PI;

/// Relative tolerance of the quadrature over azimuth.
const REL_TOL: f64 = 1e-13;

/// Acceptance cone about the receiver's normal, half angle at most a right angle.
#[derive(Clone, Copy)]
pub(super) struct Acceptance {
    pub(super) cos: f64,
    pub(super) sin: f64,
}

impl Acceptance {
    /// The whole hemisphere.
    pub(super) const HEMISPHERE: Acceptance = Acceptance { cos: 0.0, sin: 1.0 };

    /// Cone of half angle `half_angle_rad`; from a right angle on it is the hemisphere. `None` where nothing is accepted (zero, negative, NaN).
    pub(super) fn new(half_angle_rad: f64) -> Option<Acceptance> {
        if half_angle_rad >= std::f64::consts::FRAC_PI_2 {
            Some(Acceptance::HEMISPHERE)
        } else if half_angle_rad > 0.0 {
            Some(Acceptance { cos: half_angle_rad.cos(), sin: half_angle_rad.sin() })
        } else {
            None
        }
    }

    /// Distance (signed, positive inside) of a point of a half plane from the edge of the cone.
    pub(super) fn depth(self, rho: f64, z: f64) -> f64 {
        z * self.sin - rho * self.cos
    }
}

/// A point of the half plane: distance from the axis and height above the receiver.
#[derive(Clone, Copy)]
pub(super) struct StripPoint {
    pub(super) rho: f64,
    pub(super) z: f64,
}

/// The line in which a half plane cuts the plane of the source, through a base point close to the source.
#[derive(Clone, Copy)]
pub(super) struct StripLine {
    pub(super) base: StripPoint,
    /// Unit normal of the line, away from the receiver.
    pub(super) across: StripPoint,
    /// Distance of the line from the receiver.
    pub(super) distance: f64,
}

/// An end of a chord: its position on the line relative to the base, which stays precise for sources that are small against their distance.
#[derive(Clone, Copy)]
struct ChordEnd {
    position: f64,
    point: StripPoint,
}

impl StripLine {
    fn at(self, position: f64) -> ChordEnd {
        let point = StripPoint { rho: self.base.rho + position * self.across.z, z: self.base.z - position * self.across.rho };
        ChordEnd { position, point }
    }

    /// Where `by_rho ρ + by_z z` vanishes, between an end inside (value `inside`) and one outside (value `outside`).
    fn limit(self, ends: [ChordEnd; 2], [inside, outside]: [f64; 2], by_rho: f64, by_z: f64) -> ChordEnd {
        let base_position = self.base.rho * self.across.z - self.base.z * self.across.rho;
        let from_foot =
            -self.distance * (by_rho * self.across.rho + by_z * self.across.z) / (by_rho * self.across.z - by_z * self.across.rho);
        if from_foot.abs() < 0.5 * base_position.abs().max(self.distance) {
            // Near the receiver: from the foot of the perpendicular, whose distance is known precisely.
            let point = StripPoint {
                rho: self.distance * self.across.rho + from_foot * self.across.z,
                z: self.distance * self.across.z - from_foot * self.across.rho,
            };
            return ChordEnd { position: from_foot - base_position, point };
        }
        let t = inside / (inside - outside);
        let between = |p: f64, q: f64| p + (q - p) * t;
        ChordEnd {
            position: between(ends[0].position, ends[1].position),
            point: StripPoint { rho: between(ends[0].point.rho, ends[1].point.rho), z: between(ends[0].point.z, ends[1].point.z) },
        }
    }

    /// `sin²θ₂ − sin²θ₁` of the part of the chord between two positions that is in the half plane, above the horizon and accepted.
    pub(super) fn chord(self, start: f64, end: f64, acceptance: Acceptance) -> f64 {
        let (mut a, mut b) = (self.at(start), self.at(end));
        for (by_rho, by_z) in [(1.0, 0.0), (0.0, 1.0), (-acceptance.cos, acceptance.sin)] {
            let [da, db] = [a, b].map(|end| by_rho * end.point.rho + by_z * end.point.z);
            if !(da > 0.0 || db > 0.0) {
                return 0.0;
            }
            if da < 0.0 {
                a = self.limit([b, a], [db, da], by_rho, by_z);
            } else if db < 0.0 {
                b = self.limit([a, b], [da, db], by_rho, by_z);
            }
        }
        let length = (b.position - a.position).abs();
        let (rho1, z1) = (a.point.rho.max(0.0), a.point.z.max(0.0));
        let (rho2, z2) = (b.point.rho.max(0.0), b.point.z.max(0.0));
        let r1_squared = rho1 * rho1 + z1 * z1;
        let r2_squared = rho2 * rho2 + z2 * z2;
        let scale = r1_squared * r2_squared;
        if scale > 0.0 {
            // A difference of two squared sines; rounding next to the receiver must not exceed it.
            (length * self.distance * (rho1 * z2 + rho2 * z1) / scale).min(1.0)
        } else {
            0.0
        }
    }
}

/// `½ ∫ strip(φ) dφ` over all azimuths, split at `breaks` (rad, any order, from −π to π).
pub(super) fn integrate_azimuth(mut breaks: Vec<f64>, strip: &dyn Fn(f64) -> f64) -> Integral {
    breaks.retain(|phi| phi.abs() < PI);
    breaks.extend([-PI, PI]);
    breaks.sort_by(f64::total_cmp);
    breaks.dedup();
    let sum = integrate_between(&breaks, strip, REL_TOL);
    Integral { value: 0.5 * sum.value, error: 0.5 * sum.error }
}
