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
            Some(Acceptance {
                cos: half_angle_rad.cos(),
                sin: half_angle_rad.sin(),
            })
        } else {
            None
        }
    }

    /// Distance (signed, positive inside) of a point of a half plane from the edge of the cone.
    pub(super) fn depth(self, rho: f64, z: f64) -> f64 {
        z * self.sin - rho * self.cos
    }
}

/// A point of the half plane: distance from the axis and height, relative to the base of its line.
#[derive(Clone, Copy)]
pub(super) struct StripPoint {
    pub(super) rho: f64,
    pub(super) z: f64,
}

/// The line in which a half plane cuts the plane of the source: a base point, and the distance from the receiver.
#[derive(Clone, Copy)]
pub(super) struct StripLine {
    pub(super) base: StripPoint,
    pub(super) distance: f64,
}

impl StripLine {
    /// `sin²θ₂ − sin²θ₁` of the part of the chord between `a` and `b` that is in the half plane, above the horizon and accepted.
    pub(super) fn chord(self, mut a: StripPoint, mut b: StripPoint, acceptance: Acceptance) -> f64 {
        let base = self.base;
        let mut keep = |depth: &dyn Fn(f64, f64) -> f64| -> bool {
            let da = depth(base.rho + a.rho, base.z + a.z);
            let db = depth(base.rho + b.rho, base.z + b.z);
            if !(da > 0.0 || db > 0.0) {
                return false;
            }
            let between = |p: StripPoint, q: StripPoint, t: f64| StripPoint {
                rho: p.rho + (q.rho - p.rho) * t,
                z: p.z + (q.z - p.z) * t,
            };
            if da < 0.0 {
                a = between(b, a, db / (db - da));
            } else if db < 0.0 {
                b = between(a, b, da / (da - db));
            }
            true
        };
        if !(keep(&|rho, _| rho) && keep(&|_, z| z) && keep(&|rho, z| acceptance.depth(rho, z))) {
            return 0.0;
        }
        let length = (b.rho - a.rho).hypot(b.z - a.z);
        let (rho1, z1) = ((base.rho + a.rho).max(0.0), (base.z + a.z).max(0.0));
        let (rho2, z2) = ((base.rho + b.rho).max(0.0), (base.z + b.z).max(0.0));
        let r1_squared = rho1 * rho1 + z1 * z1;
        let r2_squared = rho2 * rho2 + z2 * z2;
        let scale = r1_squared * r2_squared;
        if scale > 0.0 {
            length * self.distance * (rho1 * z2 + rho2 * z1) / scale
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
    Integral {
        value: 0.5 * sum.value,
        error: 0.5 * sum.error,
    }
}
