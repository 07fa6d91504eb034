//! From triangles to the eight-wide tree.
//!
//! Cost of a tree under the surface area heuristic: the sum over nodes of (area of the box / area of the root's box) times the cost of
//! a visit. `obvhs` makes a binary tree that is good in this sense; here its inner nodes are merged, eight children to a node.

use super::node::{LEAF, Node, Packet};
use obvhs::{Boundable, BvhBuildParams, aabb::Aabb, bvh2::Bvh2, bvh2::builder::build_bvh2};
use std::time::Duration;

/// Triangles in a leaf at most: the lanes of a packet.
const LEAF_TRIANGLES: usize = 8;
/// Below this level the binary tree is taken as it is; a longer branch (coincident triangles make one as long as their number) is
/// divided anew by medians.
const FREE_DEPTH: usize = 20;
/// No branch has more inner nodes than this: the medians of 2^31 triangles need 10 levels below [`FREE_DEPTH`].
pub(super) const DEPTH_LIMIT: usize = 31;
/// Coordinates above this magnitude would overflow the areas of boxes.
const COORDINATE_LIMIT: f32 = 1e15;

/// What [`build`] makes.
pub(super) struct Tree {
    pub(super) nodes: Vec<Node>,
    pub(super) packets: Vec<Packet>,
    pub(super) triangle_count: usize,
    pub(super) depth: usize,
}

/// The box of a triangle, with the triangle's index.
#[derive(Clone, Copy)]
struct Bounds {
    min: [f32; 3],
    max: [f32; 3],
    triangle: u32,
}

impl Boundable for Bounds {
    fn aabb(&self) -> Aabb {
        Aabb::new(self.min.into(), self.max.into())
    }
}

/// Builds the tree; see [`super::Bvh::build`].
pub(super) fn build(vertices: &[[f32; 3]], triangles: &[[u32; 3]]) -> Tree {
    let bounds: Vec<Bounds> = triangles.iter().enumerate().filter_map(|(index, &corners)| bounds_of(vertices, corners, index)).collect();
    let mut builder = Builder {
        vertices,
        triangles,
        tree: Tree { nodes: vec![Node::EMPTY], packets: Vec::new(), triangle_count: bounds.len(), depth: 1 },
    };
    if bounds.len() <= LEAF_TRIANGLES {
        builder.fill_balanced(0, 1, &mut bounds.clone());
    } else {
        let params = BvhBuildParams { max_prims_per_leaf: LEAF_TRIANGLES as u32, ..BvhBuildParams::medium_build() };
        let binary = build_bvh2(&bounds, params, &mut Duration::default());
        builder.fill_from_binary(&binary, &bounds);
    }
    builder.tree.nodes.shrink_to_fit();
    builder.tree.packets.shrink_to_fit();
    builder.tree
}

fn bounds_of(vertices: &[[f32; 3]], corners: [u32; 3], index: usize) -> Option<Bounds> {
    let mut bounds = Bounds { min: [f32::INFINITY; 3], max: [f32::NEG_INFINITY; 3], triangle: u32::try_from(index).ok()? };
    for corner in corners {
        let vertex = vertices.get(corner as usize)?;
        for axis in 0..3 {
            if vertex[axis].is_nan() || vertex[axis].abs() > COORDINATE_LIMIT {
                return None;
            }
            bounds.min[axis] = bounds.min[axis].min(vertex[axis]);
            bounds.max[axis] = bounds.max[axis].max(vertex[axis]);
        }
    }
    Some(bounds)
}

struct Builder<'a> {
    vertices: &'a [[f32; 3]],
    triangles: &'a [[u32; 3]],
    tree: Tree,
}

impl Builder<'_> {
    /// Merges the binary tree's inner nodes into nodes of eight.
    fn fill_from_binary(&mut self, binary: &Bvh2, bounds: &[Bounds]) {
        // (inner node of the binary tree, node to fill, its level)
        let mut work = vec![(0_usize, 0_usize, 1_usize)];
        while let Some((from, to, depth)) = work.pop() {
            self.tree.depth = self.tree.depth.max(depth);
            if depth > FREE_DEPTH {
                let mut inside = Vec::new();
                primitives_below(binary, from, |index| inside.push(bounds[index as usize]));
                self.fill_balanced(to, depth, &mut inside);
                continue;
            }
            let children = open(binary, from);
            for (lane, &child) in children.iter().enumerate() {
                let node = &binary.nodes[child];
                let code = if node.is_leaf() {
                    let first = node.first_index as usize;
                    let last = first + node.prim_count as usize;
                    let inside = binary.primitive_indices[first..last].iter().map(|&index| bounds[index as usize].triangle);
                    self.push_packet(inside)
                } else {
                    work.push((child, self.tree.nodes.len(), depth + 1));
                    self.push_node()
                };
                let aabb = node.aabb();
                self.tree.nodes[to].set(lane, aabb.min.into(), aabb.max.into(), code);
            }
        }
    }

    /// Divides triangles by medians into up to eight children of a node, and so on below.
    fn fill_balanced(&mut self, to: usize, depth: usize, inside: &mut [Bounds]) {
        self.tree.depth = self.tree.depth.max(depth);
        let mut parts = vec![inside];
        while parts.len() < 8 {
            let Some(widest) = (0..parts.len()).rev().max_by_key(|&part| parts[part].len()).filter(|&part| parts[part].len() > LEAF_TRIANGLES) else {
                break;
            };
            let (low, high) = halve(parts.swap_remove(widest));
            parts.push(low);
            parts.push(high);
        }
        for (lane, part) in parts.into_iter().filter(|part| !part.is_empty()).enumerate() {
            let mut min = [f32::INFINITY; 3];
            let mut max = [f32::NEG_INFINITY; 3];
            for bounds in part.iter() {
                for axis in 0..3 {
                    min[axis] = min[axis].min(bounds.min[axis]);
                    max[axis] = max[axis].max(bounds.max[axis]);
                }
            }
            let code = if part.len() <= LEAF_TRIANGLES {
                self.push_packet(part.iter().map(|bounds| bounds.triangle))
            } else {
                let next = self.tree.nodes.len();
                let code = self.push_node();
                self.fill_balanced(next, depth + 1, part);
                code
            };
            self.tree.nodes[to].set(lane, min, max, code);
        }
    }

    fn push_node(&mut self) -> u32 {
        self.tree.nodes.push(Node::EMPTY);
        (self.tree.nodes.len() - 1) as u32
    }

    fn push_packet(&mut self, inside: impl Iterator<Item = u32>) -> u32 {
        let mut packet = Packet::EMPTY;
        for (lane, triangle) in inside.take(LEAF_TRIANGLES).enumerate() {
            let corners = self.triangles[triangle as usize].map(|corner| self.vertices[corner as usize]);
            packet.set(lane, corners, triangle);
        }
        self.tree.packets.push(packet);
        LEAF | (self.tree.packets.len() - 1) as u32
    }
}

/// Up to eight descendants of an inner node: the inner one with the largest area is replaced by its two children while there is room.
fn open(binary: &Bvh2, from: usize) -> Vec<usize> {
    let pair = |node: usize| [binary.nodes[node].first_index as usize, binary.nodes[node].first_index as usize + 1];
    if binary.nodes[from].is_leaf() {
        return vec![from];
    }
    let mut children = Vec::with_capacity(8);
    children.extend(pair(from));
    while children.len() < 8 {
        let area = |&slot: &usize| binary.nodes[children[slot]].aabb().half_area();
        let inner = (0..children.len()).filter(|&slot| !binary.nodes[children[slot]].is_leaf());
        let Some(widest) = inner.max_by(|a, b| area(a).total_cmp(&area(b))) else {
            break;
        };
        let [low, high] = pair(children[widest]);
        children[widest] = low;
        children.push(high);
    }
    children
}

fn primitives_below(binary: &Bvh2, from: usize, mut visit: impl FnMut(u32)) {
    let mut stack = vec![from];
    while let Some(index) = stack.pop() {
        let node = &binary.nodes[index];
        let first = node.first_index as usize;
        if node.is_leaf() {
            binary.primitive_indices[first..first + node.prim_count as usize].iter().for_each(|&primitive| visit(primitive));
        } else {
            stack.extend([first, first + 1]);
        }
    }
}

/// Halves triangles at the median of their boxes' centres along the longest axis; equal centres are told apart by index.
fn halve(inside: &mut [Bounds]) -> (&mut [Bounds], &mut [Bounds]) {
    let centre = |bounds: &Bounds, axis: usize| bounds.min[axis] + bounds.max[axis];
    let extent = |axis: usize| {
        let (low, high) = inside.iter().fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), bounds| {
            (low.min(centre(bounds, axis)), high.max(centre(bounds, axis)))
        });
        high - low
    };
    let axis = (0..3).max_by(|&a, &b| extent(a).total_cmp(&extent(b))).unwrap_or(0);
    // A multiple of the leaf's size in the lower half keeps the leaves full.
    let middle = (inside.len() / 2).next_multiple_of(LEAF_TRIANGLES).min(inside.len() - 1);
    inside.select_nth_unstable_by(middle, |a, b| {
        centre(a, axis).total_cmp(&centre(b, axis)).then(a.triangle.cmp(&b.triangle))
    });
    inside.split_at_mut(middle)
}
