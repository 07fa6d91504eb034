//! Is the mesh closed, is it convex?
//!
//! Closed: every edge belongs to exactly two triangles, which run along it in opposite directions. Vertices at the same place count as
//! one. Convex: closed, and no vertex is above the plane of any triangle.

use super::{Mesh, unit_normal};

/// A vertex may be above a plane by this share of half the mesh's extent: 16 roundings of a vertex.
const CONVEX_TOLERANCE: f64 = 16.0 / (1 << 24) as f64;

impl Mesh {
    /// Whether the surface has no border: it separates an inside from an outside, with normals that agree on which is which.
    ///
    /// A mesh with more than two triangles at an edge does not count as closed, nor one that was closed by a triangle without area.
    pub fn is_closed(&self) -> bool {
        let canonical = self.canonical_vertices();
        // An edge is a number: lower vertex, higher vertex, direction.
        let mut edges = Vec::with_capacity(3 * self.triangles.len());
        for corners in &self.triangles {
            for (i, j) in [(0, 1), (1, 2), (2, 0)] {
                let (from, to) = (canonical[corners[i] as usize], canonical[corners[j] as usize]);
                edges.push((from.min(to), from.max(to), from > to));
            }
        }
        edges.sort_unstable();
        let (pairs, rest) = edges.as_chunks::<2>();
        let matched = pairs.iter().all(|[a, b]| (a.0, a.1) == (b.0, b.1) && a.2 != b.2);
        let separate = pairs.windows(2).all(|two| (two[0][0].0, two[0][0].1) != (two[1][0].0, two[1][0].1));
        rest.is_empty() && matched && separate
    }

    /// Whether the mesh is closed, convex and has its normals outside: then no point of it can see another one from outside.
    ///
    /// Dents below 1e-6 of the extent are not seen.
    pub fn is_convex_closed(&self) -> bool {
        let inside = |triangle: u32| {
            self.local_triangle(triangle).is_some_and(|corners| {
                let normal = unit_normal(corners);
                !self.bvh.any_vertex_beyond(normal.to_array(), normal.dot(corners[0]) + CONVEX_TOLERANCE)
            })
        };
        (0..self.triangles.len() as u32).all(inside) && self.is_closed()
    }

    /// For each vertex the first one at the same place.
    fn canonical_vertices(&self) -> Vec<u32> {
        // Adding positive zero turns -0 into 0.
        let key = |index: u32| self.vertices[index as usize].map(|x| (x + 0.0).to_bits());
        let mut order: Vec<u32> = (0..self.vertices.len() as u32).collect();
        order.sort_unstable_by_key(|&index| (key(index), index));
        let mut canonical = vec![0; order.len()];
        for group in order.chunk_by(|&a, &b| key(a) == key(b)) {
            for &index in group {
                canonical[index as usize] = group[0];
            }
        }
        canonical
    }
}
