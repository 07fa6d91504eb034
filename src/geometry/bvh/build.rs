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
/// No branch has more inner nodes than this: the medians of 2^31 triangles need 10 levels below [`FREE_DEPTH`] and a heap's node.
pub(super) const DEPTH_LIMIT: usize = 31;
/// Coordinates above this magnitude would overflow the areas of boxes.
const COORDINATE_LIMIT: f32 = 1e15;

/// Largest enlargement of a triangle's box for the clustering, as a share of its extent.
const JITTER: f32 = 1.0 / 128.0;

/// Marks a heap: many triangles with their centres at one place.
const HEAP: u32 = 1 << 31;
/// More triangles than this at one place are a heap.
const HEAP_TRIANGLES: usize = 64;

/// What [`build`] makes.
pub(super) struct Tree {
    pub(super) nodes: Vec<Node>,
    pub(super) packets: Vec<Packet>,
    pub(super) triangle_count: usize,
    pub(super) depth: usize,
}

/// The box of a triangle with its index, or of a heap with [`HEAP`] and the heap's index.
#[derive(Clone, Copy)]
struct Bounds {
    min: [f32; 3],
    max: [f32; 3],
    triangle: u32,
}

impl Bounds {
    fn around(inside: &[Bounds], triangle: u32) -> Bounds {
        let mut all = Bounds { min: [f32::INFINITY; 3], max: [f32::NEG_INFINITY; 3], triangle };
        for bounds in inside {
            for axis in 0..3 {
                all.min[axis] = all.min[axis].min(bounds.min[axis]);
                all.max[axis] = all.max[axis].max(bounds.max[axis]);
            }
        }
        all
    }
}

impl Boundable for Bounds {
    /// The box, larger by an arbitrary share of its extent.
    ///
    /// The clustering joins mutual nearest neighbours; among equal boxes (coincident triangles, a ribbon of equal cells) it would find one
    /// pair a round and take quadratic time. Unequal boxes have many pairs.
    fn aabb(&self) -> Aabb {
        let hash = self.triangle.wrapping_mul(0x9e37_79b9);
        let share = (hash ^ (hash >> 15)).wrapping_mul(0x85eb_ca6b) >> 8;
        let share = share as f32 * (JITTER / (1 << 24) as f32);
        let max: [f32; 3] = std::array::from_fn(|i| self.max[i] + share * (self.max[i] - self.min[i]));
        Aabb::new(self.min.into(), max.into())
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
    let (mut bounds, heaps) = gather_heaps(bounds);
    if bounds.len() <= LEAF_TRIANGLES {
        let mut inside = bounds.drain(..).flat_map(|bounds| members(bounds, &heaps)).collect::<Vec<_>>();
        builder.fill_balanced(0, 1, &mut inside);
    } else {
        let params =
            BvhBuildParams { max_prims_per_leaf: LEAF_TRIANGLES as u32, collapse_traversal_cost: 8.0, ..BvhBuildParams::medium_build() };
        let binary = build_bvh2(&bounds, params, &mut Duration::default());
        builder.fill_from_binary(&binary, &bounds, &heaps);
    }
    builder.tree.nodes.shrink_to_fit();
    builder.tree.packets.shrink_to_fit();
    builder.tree
}

/// Replaces triangles whose boxes have their centres at one place, to 2^-21 of the extent, by one box if they are many. Boxes that contain
/// one another keep the clustering from finding more than one pair a round.
fn gather_heaps(bounds: Vec<Bounds>) -> (Vec<Bounds>, Vec<Vec<Bounds>>) {
    let all = Bounds::around(&bounds, 0);
    let cells = (1 << 21) as f32;
    let cell = |bounds: &Bounds| {
        (0..3).fold(0_u64, |key, axis| {
            let extent = all.max[axis] - all.min[axis];
            let place = (0.5 * bounds.min[axis] + 0.5 * bounds.max[axis] - all.min[axis]) / extent;
            // Without extent 0 / 0 is NaN, and that becomes cell 0.
            key << 21 | (place * cells).clamp(0.0, cells - 1.0) as u64
        })
    };
    let mut keys: Vec<u64> = bounds.iter().map(cell).collect();
    keys.sort_unstable();
    let crowded: Vec<u64> = keys.chunk_by(|a, b| a == b).filter(|run| run.len() > HEAP_TRIANGLES).map(|run| run[0]).collect();
    if crowded.is_empty() {
        return (bounds, Vec::new());
    }
    let mut heaps = vec![Vec::new(); crowded.len()];
    let mut single = Vec::new();
    for bounds in bounds {
        match crowded.binary_search(&cell(&bounds)) {
            Ok(heap) => heaps[heap].push(bounds),
            Err(_) => single.push(bounds),
        }
    }
    single.extend(heaps.iter().zip(HEAP..).map(|(heap, code)| Bounds::around(heap, code)));
    (single, heaps)
}

/// The triangles that a box stands for.
fn members(bounds: Bounds, heaps: &[Vec<Bounds>]) -> Vec<Bounds> {
    if bounds.triangle & HEAP == 0 { vec![bounds] } else { heaps[(bounds.triangle & !HEAP) as usize].clone() }
}

fn bounds_of(vertices: &[[f32; 3]], corners: [u32; 3], index: usize) -> Option<Bounds> {
    let mut bounds =
        Bounds { min: [f32::INFINITY; 3], max: [f32::NEG_INFINITY; 3], triangle: u32::try_from(index).ok().filter(|&index| index < HEAP)? };
    for corner in corners {
        let vertex = vertices.get(corner as usize)?;
        for (axis, &coordinate) in vertex.iter().enumerate() {
            if coordinate.is_nan() || coordinate.abs() > COORDINATE_LIMIT {
                return None;
            }
            bounds.min[axis] = bounds.min[axis].min(coordinate);
            bounds.max[axis] = bounds.max[axis].max(coordinate);
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
    fn fill_from_binary(&mut self, binary: &Bvh2, bounds: &[Bounds], heaps: &[Vec<Bounds>]) {
        // (inner node of the binary tree, node to fill, its level)
        let mut work = vec![(0_usize, 0_usize, 1_usize)];
        while let Some((from, to, depth)) = work.pop() {
            self.tree.depth = self.tree.depth.max(depth);
            if depth > FREE_DEPTH {
                let mut inside = Vec::new();
                primitives_below(binary, from, |index| inside.extend(members(bounds[index as usize], heaps)));
                self.fill_balanced(to, depth, &mut inside);
                continue;
            }
            let children = open(binary, from);
            for (lane, &child) in children.iter().enumerate() {
                let node = &binary.nodes[child];
                let code = if node.is_leaf() {
                    let first = node.first_index as usize;
                    let last = first + node.prim_count as usize;
                    let inside = binary.primitive_indices[first..last].iter().map(|&index| bounds[index as usize]);
                    if inside.clone().all(|bounds| bounds.triangle & HEAP == 0) {
                        self.push_packet(inside.map(|bounds| bounds.triangle))
                    } else {
                        let mut inside = inside.flat_map(|bounds| members(bounds, heaps)).collect::<Vec<_>>();
                        let next = self.tree.nodes.len();
                        let code = self.push_node();
                        self.fill_balanced(next, depth + 1, &mut inside);
                        code
                    }
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
            let Some(widest) =
                (0..parts.len()).rev().max_by_key(|&part| parts[part].len()).filter(|&part| parts[part].len() > LEAF_TRIANGLES)
            else {
                break;
            };
            let (low, high) = halve(parts.swap_remove(widest));
            parts.push(low);
            parts.push(high);
        }
        for (lane, part) in parts.into_iter().filter(|part| !part.is_empty()).enumerate() {
            let Bounds { min, max, .. } = Bounds::around(part, 0);
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
    inside.select_nth_unstable_by(middle, |a, b| centre(a, axis).total_cmp(&centre(b, axis)).then(a.triangle.cmp(&b.triangle)));
    inside.split_at_mut(middle)
}
