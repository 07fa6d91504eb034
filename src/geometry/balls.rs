//! Spheres against blocks of rays, in double precision.
//!
//! ```text
//! b = (o − c)·d/|d|²,   l = (o − c) − b d,   t = −b ∓ √((R² − l²)/|d|²)
//! ```
//!
//! `l` is the nearest approach to the centre: the discriminant is a difference of two squares of that size and not of the
//! squared distance to the origin (Haines et al., *Ray Tracing Gems*, 2019, chapter 7), so small far spheres are met.
//! A ray that leaves a sphere lies on it: one root is zero by construction and is left out, the other is −2b.

use super::rays::{COINCIDENT, Hits, LANES, NONE, Rays};
use super::shape::Sphere;
use crate::math::DVec3;

/// A sphere, prepared.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ball {
    element: u32,
    pub(super) centre: DVec3,
    radius_m: f64,
}

impl Ball {
    pub(super) fn new(element: u32, s: &Sphere) -> Ball {
        Ball { element, centre: s.centre, radius_m: s.radius_m }
    }

    /// The first place beyond the origin where a lane meets the sphere, as a multiple of the direction; infinite where none.
    #[inline(always)]
    fn meet(&self, rays: &Rays, lane: usize, leaves: bool) -> f64 {
        let (ox, oy, oz) = (rays.origin.x[lane] - self.centre.x, rays.origin.y[lane] - self.centre.y, rays.origin.z[lane] - self.centre.z);
        let (dx, dy, dz) = (rays.direction.x[lane], rays.direction.y[lane], rays.direction.z[lane]);
        let d2 = dx * dx + dy * dy + dz * dz;
        let b = (ox * dx + oy * dy + oz * dz) / d2;
        let (lx, ly, lz) = (ox - b * dx, oy - b * dy, oz - b * dz);
        let rest = (self.radius_m * self.radius_m - (lx * lx + ly * ly + lz * lz)) / d2;
        let root = rest.max(0.0).sqrt();
        let (near, far) = if leaves { (-1.0, -2.0 * b) } else { (-b - root, -b + root) };
        let first = if near > 0.0 { near } else { far };
        if (rest >= 0.0 || leaves) && first > 0.0 { first } else { f64::INFINITY }
    }
}

/// Shortens `hits` to the nearest sphere.
#[inline(always)]
pub(super) fn nearest(balls: &[Ball], rays: &Rays, hits: &mut Hits) {
    for ball in balls {
        for lane in 0..LANES {
            let t = ball.meet(rays, lane, rays.leaving[lane] == ball.element);
            let nearer = t < hits.t[lane] * (1.0 - COINCIDENT);
            hits.t[lane] = if nearer { t } else { hits.t[lane] };
            hits.element[lane] = if nearer { ball.element } else { hits.element[lane] };
            hits.part[lane] = if nearer { NONE } else { hits.part[lane] };
        }
    }
}

/// Marks the lanes whose way is cut by a sphere. The sphere that a ray arrives at is met at the ray's end, which is left out.
#[inline(always)]
pub(super) fn cut(balls: &[Ball], rays: &Rays, blocked: &mut [bool; LANES]) {
    for ball in balls {
        for lane in 0..LANES {
            let t = ball.meet(rays, lane, rays.leaving[lane] == ball.element);
            blocked[lane] |= (t < rays.t_end[lane] * (1.0 - COINCIDENT)) & (rays.arriving[lane] != ball.element);
        }
    }
}
