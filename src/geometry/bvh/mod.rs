//! The bounding volume hierarchy of triangle meshes: which triangle does a ray meet first?
//!
//! Equation of the question: the smallest `t` in `(t_min, t_max)` for which `origin + t direction` lies in a triangle.
//!
//! | step | method | source |
//! |---|---|---|
//! | binary tree | parallel locally ordered clustering and reinsertion (crate `obvhs`) | Benthin et al. 2022, Meister and Bittner 2018 |
//! | eight-wide tree | the inner child with the largest area is opened until there are eight | Wald, Benthin, Boulos 2008 |
//! | boxes | slabs, the far side widened by the rounding of the arithmetic | Ize 2013, "Robust BVH Ray Traversal" |
//! | triangles | shear to the ray's frame, inclusive edge functions | Woop, Benthin, Wald 2013, "Watertight Ray/Triangle Intersection" |
//!
//! The search is watertight: a ray cannot pass between two triangles that share an edge or a vertex. It has no length of its own:
//! there is no epsilon. Two versions of the arithmetic, portable and AVX2, return the same bits.

mod avx2;
mod build;
mod node;
#[cfg(test)]
pub(crate) mod tests;
mod traverse;

use node::{Node, Packet};
use traverse::{Portable, Prepared};

/// Stands in [`Ray::skip`] for "no triangle".
pub const NO_TRIANGLE: u32 = u32::MAX;

/// Half a line: `origin + t direction` for `t` in `(t_min, t_max)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where `t = 0`.
    pub origin: [f32; 3],
    /// Any length but zero; `t` counts in this length.
    pub direction: [f32; 3],
    /// Hits must have a larger `t`. Values below 0 mean 0.
    pub t_min: f32,
    /// Hits must have a smaller `t`; infinity for no limit.
    pub t_max: f32,
    /// Triangles that do not count, such as the one that the ray leaves and the one where it ends; [`NO_TRIANGLE`] for none.
    pub skip: [u32; 2],
}

/// What a ray meets first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance in lengths of the ray's direction.
    pub t: f32,
    /// Index into the triangles that the tree was built from.
    pub triangle: u32,
    /// Weights of the triangle's three vertices; each in 0..=1, the sum is 1 within rounding.
    pub barycentric: [f32; 3],
}

/// An eight-wide tree of boxes over triangles, with copies of the triangles in its leaves.
#[derive(Clone, Debug)]
pub struct Bvh {
    nodes: Vec<Node>,
    packets: Vec<Packet>,
    triangle_count: usize,
    depth: usize,
    avx2: Option<avx2::Avx2>,
}

impl Bvh {
    /// Builds the tree, on one thread and always alike.
    ///
    /// A triangle with an index out of range, with a vertex that is not finite, or with a coordinate above 1e15 in magnitude
    /// (whose areas would overflow) is never hit; `mesh::Mesh` rejects or rescales such input.
    pub fn build(vertices: &[[f32; 3]], triangles: &[[u32; 3]]) -> Bvh {
        let tree = build::build(vertices, triangles);
        Bvh { nodes: tree.nodes, packets: tree.packets, triangle_count: tree.triangle_count, depth: tree.depth, avx2: avx2::Avx2::detect() }
    }

    /// The same tree, searched with portable arithmetic whatever the processor offers. The answers do not differ.
    pub fn portable(mut self) -> Bvh {
        self.avx2 = None;
        self
    }

    /// The nearest hit, or none. Of hits at exactly equal distance always the same one is returned.
    pub fn closest(&self, ray: &Ray) -> Option<Hit> {
        let prepared = Prepared::new(ray)?;
        match self.avx2 {
            Some(kernel) => kernel.closest(self, &prepared),
            None => traverse::closest(Portable, self, &prepared),
        }
    }

    /// Whether there is any hit.
    pub fn blocked(&self, ray: &Ray) -> bool {
        let Some(prepared) = Prepared::new(ray) else {
            return false;
        };
        match self.avx2 {
            Some(kernel) => kernel.blocked(self, &prepared),
            None => traverse::blocked(Portable, self, &prepared),
        }
    }

    /// Whether a vertex lies beyond a plane: `normal . v > offset` for any vertex `v` of a triangle, in double precision.
    pub fn any_vertex_beyond(&self, normal: [f64; 3], offset: f64) -> bool {
        let mut stack = vec![node::ROOT];
        while let Some(child) = stack.pop() {
            if let Some(packet) = self.packet(child) {
                if packet.any_vertex_beyond(normal, offset) {
                    return true;
                }
            } else {
                let node = &self.nodes[child as usize];
                stack.extend((0..8).filter(|&lane| node.support(lane, normal) > offset).map(|lane| node.child[lane]));
            }
        }
        false
    }

    /// Inner nodes, each with up to eight children.
    pub fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// Leaves, each with up to eight triangles.
    pub fn leaf_count(&self) -> usize {
        self.packets.len()
    }

    /// Triangles in the leaves.
    pub fn triangle_count(&self) -> usize {
        self.triangle_count
    }

    /// Inner nodes on the longest way from the root to a leaf; at most 31.
    pub fn depth(&self) -> usize {
        self.depth
    }

    /// Memory of nodes and leaves in bytes.
    pub fn memory_bytes(&self) -> usize {
        size_of_val(self.nodes.as_slice()) + size_of_val(self.packets.as_slice())
    }

    fn packet(&self, child: u32) -> Option<&Packet> {
        if child & node::LEAF == 0 { None } else { self.packets.get((child & !node::LEAF) as usize) }
    }
}
