//! A surface of triangles in the world.
//!
//! Vertices are kept as `p = centre + size v` with the centre of the bounding box, a size that is a power of two, and `v` within the
//! unit cube -1..=1, all in `f64`. So neither the unit nor the place of a mesh costs digits. Every answer (points, normals, areas,
//! samples) is computed from them in `f64`; only the search tree has them in `f32`, rounded by at most 2^-24 of half the mesh's largest
//! extent, to find which triangle a ray meets.
//!
//! | quantity | formula |
//! |---|---|
//! | normal | `(p1 - p0) x (p2 - p0)`, normalised: counter-clockwise vertices seen from outside |
//! | area | `|(p1 - p0) x (p2 - p0)| / 2` |
//! | point of a hit | `b0 p0 + b1 p1 + b2 p2`, barycentrics in `f64` |
//! | error of a point | `gamma(7) (|b0 p0| + |b1 p1| + |b2 p2|)`, Pharr, Jakob, Humphreys, "Physically Based Rendering", 3.9 |

mod area;
mod error;
mod query;
mod surface;
#[cfg(test)]
mod tests;
mod topology;

pub use error::MeshError;
pub use query::MeshHit;

use super::bvh::Bvh;
use crate::math::DVec3;

/// Extents outside of this range, in metres, would leave the range of `f64` when squared.
const EXTENT_RANGE_M: std::ops::RangeInclusive<f64> = 1e-140..=1e140;

/// Triangles with everything that is needed to meet them with rays and to draw points on them.
#[derive(Clone, Debug)]
pub struct Mesh {
    centre: DVec3,
    size_m: f64,
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    degenerate: usize,
    /// Sum of the areas of triangles 0..=i, in units of `size_m` squared.
    cumulative_area: Vec<f64>,
    local_min: DVec3,
    local_max: DVec3,
    bvh: Bvh,
}

impl Mesh {
    /// Builds the mesh and its search tree from world coordinates in metres and triples of indices into them.
    ///
    /// Triangles that have no area after rounding are dropped and counted ([`Mesh::degenerate_count`]); those after them move up.
    ///
    /// # Errors
    /// [`MeshError`]: a coordinate that is not finite, an index out of range, no triangle, no triangle with an area, an extent beyond
    /// 1e-140..1e140 m.
    pub fn new(points: &[DVec3], mut triangles: Vec<[u32; 3]>) -> Result<Mesh, MeshError> {
        check(points, &triangles)?;
        let count = triangles.len();
        let corners = || triangles.iter().flatten().map(|&index| points[index as usize]);
        let min = corners().fold(DVec3::INFINITY, DVec3::min);
        let max = corners().fold(DVec3::NEG_INFINITY, DVec3::max);
        // Halves first: the difference of two finite numbers may overflow.
        let half_extent = (max * 0.5 - min * 0.5).max_element();
        if half_extent == 0.0 {
            return Err(MeshError::AllDegenerate { triangles: count });
        }
        if !EXTENT_RANGE_M.contains(&(half_extent * 2.0)) {
            return Err(MeshError::ExtentOutOfRange { extent_m: half_extent * 2.0 });
        }
        let centre = min * 0.5 + max * 0.5;
        let size_m = power_of_two_above(half_extent);
        let vertices: Vec<[f64; 3]> = points.iter().map(|&p| ((p - centre) / size_m).to_array()).collect();
        triangles.retain(|corners| double_area(&vertices, corners) > 0.0);
        if triangles.is_empty() {
            return Err(MeshError::AllDegenerate { triangles: count });
        }
        triangles.shrink_to_fit();
        let corners = || triangles.iter().flatten().map(|&index| local(&vertices, index));
        let (local_min, local_max) = (corners().fold(DVec3::INFINITY, DVec3::min), corners().fold(DVec3::NEG_INFINITY, DVec3::max));
        let searched: Vec<[f32; 3]> = vertices.iter().map(|v| v.map(|x| x as f32)).collect();
        let bvh = Bvh::build(&searched, &triangles);
        let cumulative_area = area::cumulative(triangles.iter().map(|corners| 0.5 * double_area(&vertices, corners)));
        Ok(Mesh { centre, size_m, degenerate: count - triangles.len(), vertices, triangles, cumulative_area, local_min, local_max, bvh })
    }

    /// World coordinates of a triangle's vertices in metres; `None` if there is no such triangle.
    pub fn triangle(&self, triangle: u32) -> Option<[DVec3; 3]> {
        Some(self.local_triangle(triangle)?.map(|v| self.world(v)))
    }

    /// Unit normal of a triangle: its vertices turn counter-clockwise seen from the tip. `None` if there is no such triangle.
    pub fn normal(&self, triangle: u32) -> Option<DVec3> {
        self.local_triangle(triangle).map(unit_normal)
    }

    /// Corners of the smallest box with edges along the axes, in metres.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        (self.world(self.local_min), self.world(self.local_max))
    }

    /// Number of triangles, without those that had no area.
    pub fn triangle_count(&self) -> usize {
        self.triangles.len()
    }

    /// Number of triangles that were dropped because they had no area.
    pub fn degenerate_count(&self) -> usize {
        self.degenerate
    }

    /// Number of vertices that were given.
    pub fn vertex_count(&self) -> usize {
        self.vertices.len()
    }

    /// Number of inner nodes of the search tree.
    pub fn node_count(&self) -> usize {
        self.bvh.node_count()
    }

    /// Memory of vertices, triangles, areas and search tree in bytes.
    pub fn memory_bytes(&self) -> usize {
        size_of_val(self.vertices.as_slice())
            + size_of_val(self.triangles.as_slice())
            + size_of_val(self.cumulative_area.as_slice())
            + self.bvh.memory_bytes()
    }

    fn world(&self, v: DVec3) -> DVec3 {
        self.centre + v * self.size_m
    }

    fn local_triangle(&self, triangle: u32) -> Option<[DVec3; 3]> {
        let corners = self.triangles.get(triangle as usize)?;
        Some(corners.map(|index| local(&self.vertices, index)))
    }
}

fn check(points: &[DVec3], triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    if triangles.is_empty() {
        return Err(MeshError::NoTriangles);
    }
    if triangles.len() > i32::MAX as usize {
        return Err(MeshError::TooManyTriangles { triangles: triangles.len() });
    }
    if let Some(vertex) = points.iter().position(|p| !p.is_finite()) {
        return Err(MeshError::VertexNotFinite { vertex });
    }
    for (triangle, corners) in triangles.iter().enumerate() {
        if let Some(&index) = corners.iter().find(|&&index| index as usize >= points.len()) {
            return Err(MeshError::IndexOutOfRange { triangle, index, vertices: points.len() });
        }
    }
    Ok(())
}

fn local(vertices: &[[f64; 3]], index: u32) -> DVec3 {
    DVec3::from_array(vertices[index as usize])
}

fn double_area(vertices: &[[f64; 3]], corners: &[u32; 3]) -> f64 {
    area_vector(corners.map(|index| local(vertices, index))).length()
}

/// Twice the area along the normal.
fn area_vector([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a)
}

fn unit_normal(corners: [DVec3; 3]) -> DVec3 {
    // Not zero: triangles without area were dropped.
    area_vector(corners).normalize()
}

/// The smallest power of two that is not below a normal positive number; dividing by it is exact.
fn power_of_two_above(x: f64) -> f64 {
    let exponent_only = f64::from_bits(x.to_bits() & (0x7ff << 52));
    if exponent_only == x { x } else { exponent_only * 2.0 }
}
