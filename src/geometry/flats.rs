//! Plane shapes against blocks of rays, in double precision.
//!
//! ```text
//! t = n·(c − o) / n·d,   (a, b) = ((o + t d − c)·u/|u|², (o + t d − c)·v/|v|²)
//! rectangle: |a| ≤ 1 and |b| ≤ 1      disc: h² ≤ a² + b² ≤ 1, h the share of a hole      polygon: an odd number of edges above (a, b)
//! ```
//!
//! A ray that leaves a flat cannot meet it again: it is told apart by its index, so no distance has to be called small.

use super::polygon::{Polygon, is_inside};
use super::rays::{COINCIDENT, Hits, LANES, NONE, Rays};
use super::shape::{Disc, Rectangle};
use crate::math::DVec3;
use crate::math::frame::tangents;

/// A rectangle or a disc, prepared.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flat {
    pub(super) element: u32,
    pub(super) centre: DVec3,
    pub(super) normal: DVec3,
    /// u/|u|² and v/|v|²: they turn a point of the plane into parameters.
    pub(super) u: DVec3,
    pub(super) v: DVec3,
    /// a² + b² on the rim of a hole; zero without one.
    hole: f64,
}

impl Flat {
    pub(super) fn rectangle(element: u32, r: &Rectangle) -> Flat {
        let inverse = |half: DVec3| half.normalize() / half.length();
        Flat { element, centre: r.centre, normal: r.normal(), u: inverse(r.half_u), v: inverse(r.half_v), hole: 0.0 }
    }

    pub(super) fn disc(element: u32, d: &Disc) -> Flat {
        let (x, y) = tangents(d.normal);
        Flat {
            element,
            centre: d.centre,
            normal: d.normal,
            u: x / d.radius_m,
            v: y / d.radius_m,
            hole: (d.hole_radius_m / d.radius_m).powi(2),
        }
    }
}

/// Distance and in-plane parameters of the plane of a flat in one lane. A ray in the plane gives NaN or infinity, which every
/// comparison below refuses.
#[inline(always)]
fn meet(flat: &Flat, rays: &Rays, lane: usize) -> (f64, f64, f64) {
    let (ox, oy, oz) = (rays.origin.x[lane] - flat.centre.x, rays.origin.y[lane] - flat.centre.y, rays.origin.z[lane] - flat.centre.z);
    let (dx, dy, dz) = (rays.direction.x[lane], rays.direction.y[lane], rays.direction.z[lane]);
    let (n, u, v) = (&flat.normal, &flat.u, &flat.v);
    let t = -(n.x * ox + n.y * oy + n.z * oz) / (n.x * dx + n.y * dy + n.z * dz);
    let (px, py, pz) = (ox + t * dx, oy + t * dy, oz + t * dz);
    (t, u.x * px + u.y * py + u.z * pz, v.x * px + v.y * py + v.z * pz)
}

/// Shortens `hits` to the nearest rectangle (`ROUND` = false) or disc (`ROUND` = true).
#[inline(always)]
pub(super) fn nearest<const ROUND: bool>(flats: &[Flat], rays: &Rays, hits: &mut Hits) {
    for flat in flats {
        for lane in 0..LANES {
            let (t, a, b) = meet(flat, rays, lane);
            let round = a * a + b * b;
            let within = if ROUND { (round <= 1.0) & (round >= flat.hole) } else { (a.abs() <= 1.0) & (b.abs() <= 1.0) };
            let nearer = (t > 0.0) & (t < hits.t[lane] * (1.0 - COINCIDENT)) & within & (rays.leaving[lane] != flat.element);
            hits.t[lane] = if nearer { t } else { hits.t[lane] };
            hits.element[lane] = if nearer { flat.element } else { hits.element[lane] };
            hits.part[lane] = if nearer { NONE } else { hits.part[lane] };
        }
    }
}

/// Marks the lanes whose way is cut by a rectangle or disc.
#[inline(always)]
pub(super) fn cut<const ROUND: bool>(flats: &[Flat], rays: &Rays, blocked: &mut [bool; LANES]) {
    for flat in flats {
        for lane in 0..LANES {
            let (t, a, b) = meet(flat, rays, lane);
            let round = a * a + b * b;
            let within = if ROUND { (round <= 1.0) & (round >= flat.hole) } else { (a.abs() <= 1.0) & (b.abs() <= 1.0) };
            blocked[lane] |= (t > 0.0)
                & (t < rays.t_end[lane] * (1.0 - COINCIDENT))
                & within
                & (rays.leaving[lane] != flat.element)
                & (rays.arriving[lane] != flat.element);
        }
    }
}

/// A polygon, prepared. Its parameters are counted from its first corner.
#[derive(Clone, Debug)]
pub(super) struct Outline {
    pub(super) flat: Flat,
    corners: Vec<[f64; 2]>,
}

impl Outline {
    pub(super) fn new(element: u32, p: &Polygon) -> Outline {
        let (x, y) = tangents(p.normal());
        let first = p.corners()[0];
        let size = p.corners().iter().map(|&c| (c - first).length()).fold(0.0, f64::max);
        let flat = Flat { element, centre: first, normal: p.normal(), u: x / size, v: y / size, hole: 0.0 };
        let corners = p.corners().iter().map(|&c| [flat.u.dot(c - first), flat.v.dot(c - first)]).collect();
        Outline { flat, corners }
    }
}

/// Shortens `hits` to the nearest polygon.
#[inline(always)]
pub(super) fn nearest_outline(outlines: &[Outline], rays: &Rays, hits: &mut Hits) {
    for Outline { flat, corners } in outlines {
        for lane in 0..LANES {
            let (t, a, b) = meet(flat, rays, lane);
            let nearer = (t > 0.0) & (t < hits.t[lane] * (1.0 - COINCIDENT)) & (rays.leaving[lane] != flat.element);
            if nearer && is_inside(corners, [a, b]) {
                hits.t[lane] = t;
                hits.element[lane] = flat.element;
                hits.part[lane] = NONE;
            }
        }
    }
}

/// Marks the lanes whose way is cut by a polygon.
#[inline(always)]
pub(super) fn cut_outline(outlines: &[Outline], rays: &Rays, blocked: &mut [bool; LANES]) {
    for Outline { flat, corners } in outlines {
        for lane in 0..LANES {
            let (t, a, b) = meet(flat, rays, lane);
            let before = (t > 0.0)
                & (t < rays.t_end[lane] * (1.0 - COINCIDENT))
                & (rays.leaving[lane] != flat.element)
                & (rays.arriving[lane] != flat.element);
            blocked[lane] |= before && is_inside(corners, [a, b]);
        }
    }
}
