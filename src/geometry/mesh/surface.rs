//! A point of a mesh, from the triangle and a point near it.

use super::{Mesh, unit_normal};
use crate::math::DVec3;

impl Mesh {
    /// The point of a triangle's plane that is nearest to `near` (m), and the unit normal by the winding.
    ///
    /// World coordinates far from the origin are coarse; the foot of the perpendicular is found relative to the mesh's own centre.
    /// `near` itself and a zero normal if there is no such triangle.
    #[must_use]
    pub fn surface_point(&self, triangle: u32, near: DVec3) -> (DVec3, DVec3) {
        let Some(corners) = self.local_triangle(triangle) else {
            return (near, DVec3::ZERO);
        };
        let normal = unit_normal(corners);
        let local = (near - self.centre) / self.size_m;
        (self.world(local - normal * normal.dot(local - corners[0])), normal)
    }
}
