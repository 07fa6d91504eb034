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

    /// [`Mesh::sample_by_area`] with two numbers: the first one chooses the triangle, and its place within the stretch of numbers that
    /// choose this triangle, uniform again, serves as the next.
    #[must_use]
    pub fn sample_by_area_with_two(&self, u: [f64; 2]) -> (u32, DVec3, DVec3) {
        let (_, rest) = self.choose_by_area(u[0]);
        self.sample_by_area([u[0], rest, u[1]])
    }

    /// The triangle that a number in 0..1 chooses by area, and the number's place within the stretch of those that choose it.
    #[must_use]
    pub fn choose_by_area(&self, u: f64) -> (u32, f64) {
        let sums = &self.cumulative_area;
        let last = sums.len() - 1;
        let wanted = u * sums[last];
        let triangle = sums.partition_point(|&sum| sum <= wanted).min(last);
        let before = if triangle == 0 { 0.0 } else { sums[triangle - 1] };
        let rest = ((wanted - before) / (sums[triangle] - before)).clamp(0.0, 1.0);
        (triangle as u32, if rest.is_finite() { rest } else { 0.5 })
    }
}
