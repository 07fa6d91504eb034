//! Points on a mesh, equally dense in area.
//!
//! Density `p = 1 / A` per square metre: a triangle is chosen with probability `A_i / A`, and in it the barycentrics
//! `b0 = 1 - sqrt(u1)`, `b1 = (1 - u2) sqrt(u1)`, `b2 = u2 sqrt(u1)` are uniform (Turk 1990, "Generating random points in triangles").

use super::{Mesh, unit_normal};
use crate::math::DVec3;

impl Mesh {
    /// Area of all triangles in square metres, one side.
    pub fn area_m2(&self) -> f64 {
        self.local_area() * self.size_m * self.size_m
    }

    /// Area of each triangle in square metres.
    pub fn triangle_areas_m2(&self) -> impl ExactSizeIterator<Item = f64> {
        (0..self.triangles.len()).map(|i| 0.5 * super::double_area(&self.vertices, &self.triangles[i]) * self.size_m * self.size_m)
    }

    /// A point with density 1 / area from three numbers in 0..1: the triangle, the point in metres, the unit normal.
    pub fn sample_by_area(&self, u: [f64; 3]) -> (u32, DVec3, DVec3) {
        let wanted = u[0] * self.local_area();
        let triangle = self.cumulative_area.partition_point(|&sum| sum <= wanted).min(self.triangles.len() - 1);
        let corners = self.triangles[triangle].map(|index| super::local(&self.vertices, index));
        let root = u[1].sqrt();
        let point = corners[0] * (1.0 - root) + corners[1] * ((1.0 - u[2]) * root) + corners[2] * (u[2] * root);
        (triangle as u32, self.world(point), unit_normal(corners))
    }

    /// Density of [`Mesh::sample_by_area`] per square metre, the same everywhere on the mesh.
    pub fn area_pdf_m2(&self) -> f64 {
        1.0 / self.area_m2()
    }

    /// Numbers that [`Mesh::sample_by_area`] turns into this point of this triangle. The first is the middle of those that choose the
    /// triangle. `None` if there is no such triangle.
    pub fn invert_area_sample(&self, triangle: u32, point: DVec3) -> Option<[f64; 3]> {
        let [a, b, c] = self.local_triangle(triangle)?;
        let p = (point - self.centre) / self.size_m;
        let normal = (b - a).cross(c - a);
        let weight = |q: DVec3, r: DVec3| ((q - p).cross(r - p).dot(normal) / normal.length_squared()).clamp(0.0, 1.0);
        let (b1, b2) = (weight(c, a), weight(a, b));
        let root = b1 + b2;
        let index = triangle as usize;
        let before = if index == 0 { 0.0 } else { self.cumulative_area[index - 1] };
        let u0 = 0.5 * (before + self.cumulative_area[index]) / self.local_area();
        Some([u0, (root * root).min(1.0), if root > 0.0 { b2 / root } else { 0.0 }])
    }

    fn local_area(&self) -> f64 {
        self.cumulative_area.last().copied().unwrap_or(0.0)
    }
}

/// Running sums, compensated after Neumaier 1974.
pub(super) fn cumulative(areas: impl Iterator<Item = f64>) -> Vec<f64> {
    let (mut sum, mut lost) = (0.0_f64, 0.0_f64);
    areas
        .map(|area| {
            let next = sum + area;
            lost += if sum >= area { (sum - next) + area } else { (area - next) + sum };
            sum = next;
            sum + lost
        })
        .collect()
}
