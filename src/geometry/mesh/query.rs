//! Rays against a mesh, in world coordinates and double precision.
//!
//! Which triangle is met is searched in `f32`; the point is then computed in `f64`. A ray that starts outside is first moved in `f64` to
//! the mesh's box, so that the search begins next to the mesh.
//!
//! A ray that leaves a triangle starts at `p + n (|n| . e)` with `e = gamma(8) max |v|` the bound of the error of a point in `f32`, on the
//! side to which it goes, rounded away (Pharr, Jakob, Humphreys, "Physically Based Rendering", 3.9.5). The triangle itself is skipped.
//! In units of the mesh's half extent the shift is below 2e-6. A ray that arrives at a triangle ends likewise before it.

use super::{Mesh, area_vector, unit_normal};
use crate::geometry::bvh::{Hit, NO_TRIANGLE, Ray};
use crate::math::DVec3;

/// Bound of the relative error of eight roundings in single precision: seven of a point, one of the vertices in the search tree.
const GAMMA_8_F32: f64 = gamma(8.0, 1.0 / (1_u64 << 24) as f64);
/// The same in double precision.
const GAMMA_7_F64: f64 = gamma(7.0, 1.0 / (1_u64 << 53) as f64);
/// The box at which rays from outside start is larger than the mesh by this, in units of half its extent.
const BOX_MARGIN: f64 = 1.0 / (1 << 16) as f64;
/// The share of the way to a point in space where nothing is searched, so that a surface through that point does not block.
const END_MARGIN: f64 = 1.0 / (1 << 20) as f64;

const fn gamma(n: f64, unit_roundoff: f64) -> f64 {
    n * unit_roundoff / (1.0 - n * unit_roundoff)
}

/// Where a ray meets a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshHit {
    /// Distance from the ray's origin in metres.
    pub t: f64,
    /// Index of the triangle.
    pub triangle: u32,
    /// The point, in the triangle, in metres.
    pub point: DVec3,
    /// Unit normal of the triangle by its winding, whichever side was met.
    pub normal: DVec3,
    /// Bound of the rounding of `point` relative to the triangle, in metres per axis.
    pub error_m: DVec3,
}

impl Mesh {
    /// The first triangle on a ray, at a distance above 0 and below `t_max` metres.
    ///
    /// `direction` is a unit vector; `t_max` may be infinite. `leaving` is the triangle from which the ray starts, with `origin` on it.
    /// Nothing is met by a ray that is not finite.
    pub fn closest(&self, origin: DVec3, direction: DVec3, t_max: f64, leaving: Option<u32>) -> Option<MeshHit> {
        let from = (origin - self.centre) / self.size_m;
        let (start, nudge) = self.left(from, direction, leaving);
        let (t_start, ray) = self.ray(start, nudge, direction, t_max / self.size_m, [leaving.unwrap_or(NO_TRIANGLE), NO_TRIANGLE])?;
        let hit = self.bvh.closest(&ray)?;
        Some(self.refine(from, from + direction * t_start, direction, &hit))
    }

    /// Whether a triangle is on the way: at a distance above 0 and below `t_max` metres.
    ///
    /// `leaving` and `arriving` are the triangles on which the way starts and ends, if any; they do not block, nor does what touches them
    /// there. Without `arriving` the last 1e-6 of the way is not searched.
    pub fn blocked(&self, origin: DVec3, direction: DVec3, t_max: f64, leaving: Option<u32>, arriving: Option<u32>) -> bool {
        let from = (origin - self.centre) / self.size_m;
        let (start, nudge) = self.left(from, direction, leaving);
        let skip = [leaving.unwrap_or(NO_TRIANGLE), arriving.unwrap_or(NO_TRIANGLE)];
        let length = t_max / self.size_m;
        let ray = match arriving {
            // Searched from the end, which is at the mesh, whereas the start may be far away.
            Some(_) => {
                let (end, nudge) = self.left(from + direction * length, -direction, arriving);
                let back = start - end;
                let length = back.length();
                if length == 0.0 {
                    return false;
                }
                self.ray(end, nudge, back / length, length, skip)
            }
            None => self.ray(start, nudge, direction, length * (1.0 - END_MARGIN), skip),
        };
        ray.is_some_and(|(_, ray)| self.bvh.blocked(&ray))
    }

    /// The point from which a ray starts, and the shift away from the triangle that is already in it.
    fn left(&self, from: DVec3, direction: DVec3, leaving: Option<u32>) -> (DVec3, DVec3) {
        let Some(corners) = leaving.and_then(|triangle| self.local_triangle(triangle)) else {
            return (from, DVec3::ZERO);
        };
        let normal = unit_normal(corners);
        let error = corners.iter().fold(DVec3::ZERO, |largest, v| largest.max(v.abs())) * GAMMA_8_F32;
        let shift = normal * normal.abs().dot(error) * if normal.dot(direction) < 0.0 { -1.0 } else { 1.0 };
        // World coordinates far from the origin are coarse: back into the plane first.
        let in_plane = from - normal * normal.dot(from - corners[0]);
        (in_plane + shift, shift)
    }

    /// The ray in single precision, and how far along the way it starts; `None` if it passes the mesh's box.
    fn ray(&self, from: DVec3, nudge: DVec3, direction: DVec3, t_max: f64, skip: [u32; 2]) -> Option<(f64, Ray)> {
        let inverse = direction.recip();
        let to_low = (self.local_min - DVec3::splat(BOX_MARGIN) - from) * inverse;
        let to_high = (self.local_max + DVec3::splat(BOX_MARGIN) - from) * inverse;
        // 0 * inf gives NaN, which these minima and maxima pass over: such an axis does not limit.
        let (near, far) = (to_low.to_array(), to_high.to_array());
        let enter = near.iter().zip(&far).fold(0.0, |t: f64, (a, b)| t.max(a.min(*b)));
        let leave = near.iter().zip(&far).fold(t_max, |t: f64, (a, b)| t.min(a.max(*b)));
        // Not "enter > leave": a NaN ends here too.
        if !(enter <= leave && direction.is_finite() && from.is_finite()) {
            return None;
        }
        let start = (from + direction * enter).as_vec3().to_array();
        let away = if enter == 0.0 { nudge.to_array() } else { [0.0; 3] };
        let origin = std::array::from_fn(|i| match away[i] {
            shift if shift > 0.0 => start[i].next_up(),
            shift if shift < 0.0 => start[i].next_down(),
            _ => start[i],
        });
        let ray = Ray { origin, direction: direction.as_vec3().to_array(), t_min: 0.0, t_max: (t_max - enter) as f32, skip };
        Some((enter, ray))
    }

    /// The hit in double precision; `near` is a point of the ray close to the mesh.
    fn refine(&self, from: DVec3, near: DVec3, direction: DVec3, hit: &Hit) -> MeshHit {
        let corners = self.triangles[hit.triangle as usize].map(|index| super::local(&self.vertices, index));
        let weights = weights(near, direction, corners, hit.barycentric.map(f64::from));
        let parts = [corners[0] * weights[0], corners[1] * weights[1], corners[2] * weights[2]];
        let point = parts[0] + parts[1] + parts[2];
        let spread = parts[0].abs() + parts[1].abs() + parts[2].abs();
        let world = self.world(point);
        // Rounding of the product with a power of two is none, of the sum with the centre half a unit in the last place.
        let error_m = spread * (self.size_m * GAMMA_7_F64) + world.abs() * (f64::EPSILON / 2.0);
        MeshHit {
            t: (point - from).dot(direction).max(0.0) * self.size_m,
            triangle: hit.triangle,
            point: world,
            normal: area_vector(corners).normalize(),
            error_m,
        }
    }
}

/// Barycentrics of the point where a line passes a triangle, in 0..=1 and with sum 1.
///
/// The signed volumes `d . (c x b)` and its rotations are in the ratio of the barycentrics (Plücker coordinates). The single-precision
/// search may have found a triangle that the exact line just misses; then the weights are clipped, and of these and the weights of
/// the search the ones nearer to the line are taken.
fn weights(near: DVec3, direction: DVec3, corners: [DVec3; 3], searched: [f64; 3]) -> [f64; 3] {
    let [a, b, c] = corners.map(|corner| corner - near);
    let volume = [direction.dot(c.cross(b)), direction.dot(a.cross(c)), direction.dot(b.cross(a))];
    let sum = volume[0] + volume[1] + volume[2];
    let exact = volume.map(|v| v / sum);
    if exact.iter().all(|w| *w >= 0.0) {
        return exact;
    }
    let [exact, searched] = [exact, searched].map(|weights| {
        let clipped = weights.map(|w| w.clamp(0.0, 1.0));
        let sum = clipped[0] + clipped[1] + clipped[2];
        clipped.map(|w| w / sum)
    });
    let distance = |w: [f64; 3]| (a * w[0] + b * w[1] + c * w[2]).cross(direction).length();
    if distance(exact) <= distance(searched) { exact } else { searched }
}
