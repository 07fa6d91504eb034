//! The search, generic over the arithmetic on eight lanes, and the portable arithmetic.
//!
//! Boxes: `t = (plane - origin) / direction` per axis; entry is the largest near value, exit the smallest far one. Each far value carries
//! at most three roundings, so it is widened by `1 + 2 gamma(3)`, and once more by one unit in the last place because the factor is
//! multiplied into the reciprocal. Where `0 * inf` makes a NaN the order of the operands lets the other slabs decide.
//!
//! Triangles: vertices relative to the origin are sheared so that the ray runs along z; `u = c_x b_y - c_y b_x` and its rotations are
//! twice the areas towards the three edges. An edge shared by two triangles gives exactly opposite numbers, because the products are
//! rounded one by one (a fused product would break this), so that with inclusive comparisons no ray slips through.

use super::node::{LEAF, Node, Packet, ROOT};
use super::{Bvh, Hit, Ray, build::DEPTH_LIMIT};

/// Every visited node leaves at most seven others waiting.
const LONG_STACK: usize = 7 * DEPTH_LIMIT + 8;
/// Enough for the trees that occur; a short stack is cheaper to clear.
const SHORT_STACK: usize = 96;
/// `gamma(n) = n e / (1 - n e)` bounds the relative error of n roundings, `e = 2^-24`.
const GAMMA_3: f32 = 3.0 * (f32::EPSILON / 2.0) / (1.0 - 3.0 * (f32::EPSILON / 2.0));
/// Widening of far planes.
const FAR_PADDING: f32 = 1.0 + 2.0 * GAMMA_3 + f32::EPSILON;

/// What the search needs of a ray, computed once.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(super) struct Prepared {
    pub(super) origin: [f32; 3],
    /// One over the direction.
    pub(super) near_scale: [f32; 3],
    /// One over the direction, widened.
    pub(super) far_scale: [f32; 3],
    /// Row of [`Node::bounds`] that the ray meets first, per axis.
    pub(super) near: [usize; 3],
    /// Row that it meets last.
    pub(super) far: [usize; 3],
    /// The axes x, y, z of the sheared frame; z is the direction's largest component.
    pub(super) axis: [usize; 3],
    /// Shear along x and y, and scale along z.
    pub(super) shear: [f32; 3],
    pub(super) t_min: f32,
    pub(super) t_max: f32,
    pub(super) skip: [u32; 2],
}

impl Prepared {
    /// None for a ray that cannot hit: no length, no finite direction or origin.
    #[inline(always)]
    pub(super) fn new(ray: &Ray) -> Option<Prepared> {
        let direction = ray.direction;
        let magnitude = direction.map(f32::abs);
        let kz = if magnitude[0] > magnitude[1] {
            if magnitude[0] > magnitude[2] { 0 } else { 2 }
        } else if magnitude[1] > magnitude[2] {
            1
        } else {
            2
        };
        let finite = direction.iter().chain(&ray.origin).all(|x| x.is_finite());
        if !finite || direction[kz] == 0.0 {
            return None;
        }
        let (mut kx, mut ky) = ((kz + 1) % 3, (kz + 2) % 3);
        // Keeps the winding of triangles.
        if direction[kz] < 0.0 {
            std::mem::swap(&mut kx, &mut ky);
        }
        let near_scale = direction.map(|x| 1.0 / x);
        let mut near = [0; 3];
        let mut far = [0; 3];
        for i in 0..3 {
            let backwards = direction[i].is_sign_negative();
            near[i] = if backwards { i + 3 } else { i };
            far[i] = if backwards { i } else { i + 3 };
        }
        Some(Prepared {
            origin: ray.origin,
            near_scale,
            far_scale: near_scale.map(|x| x * FAR_PADDING),
            near,
            far,
            axis: [kx, ky, kz],
            shear: [direction[kx] / direction[kz], direction[ky] / direction[kz], 1.0 / direction[kz]],
            // Positive zero: entry distances are compared by their bits.
            t_min: if ray.t_min > 0.0 { ray.t_min } else { 0.0 },
            t_max: ray.t_max,
            skip: ray.skip,
        })
    }
}

/// Distance and edge functions of the triangles of a packet.
pub(super) struct Crossing {
    pub(super) t: [f32; 8],
    pub(super) edge: [[f32; 8]; 3],
}

impl Crossing {
    const ZERO: Crossing = Crossing { t: [0.0; 8], edge: [[0.0; 8]; 3] };
}

/// Arithmetic on eight lanes.
pub(super) trait Kernel: Copy {
    /// Bits of the boxes that the ray enters before `t_best`; their entry distances go to `entry`.
    fn boxes(self, node: &Node, ray: &Prepared, t_best: f32, entry: &mut [f32; 8]) -> u32;
    /// Bits of the triangles that the ray crosses between its `t_min` and `t_best`; if there are any, `crossing` is filled.
    fn triangles(self, packet: &Packet, ray: &Prepared, t_best: f32, crossing: &mut Crossing) -> u32;
    /// Says that a child will be needed soon.
    fn prefetch(self, bvh: &Bvh, child: u32);
}

/// The nearest hit.
#[inline(always)]
pub(super) fn closest<K: Kernel>(kernel: K, bvh: &Bvh, ray: &Prepared) -> Option<Hit> {
    let mut best: Option<Hit> = None;
    let mut crossing = Crossing::ZERO;
    let visit = |packet: &Packet, t_best: &mut f32| {
        let mut lanes = kernel.triangles(packet, ray, *t_best, &mut crossing);
        while lanes != 0 {
            let lane = (lanes.trailing_zeros() & 7) as usize;
            lanes &= lanes - 1;
            let t = crossing.t[lane];
            if t < *t_best {
                *t_best = t;
                let edge = [crossing.edge[0][lane], crossing.edge[1][lane], crossing.edge[2][lane]];
                let sum = edge[0] + edge[1] + edge[2];
                best = Some(Hit { t, triangle: packet.triangle[lane], barycentric: edge.map(|e| e / sum) });
            }
        }
        false
    };
    search::<K, true>(kernel, bvh, ray, visit);
    best
}

/// Whether there is a hit.
#[inline(always)]
pub(super) fn blocked<K: Kernel>(kernel: K, bvh: &Bvh, ray: &Prepared) -> bool {
    let mut crossing = Crossing::ZERO;
    let visit = |packet: &Packet, _: &mut f32| kernel.triangles(packet, ray, ray.t_max, &mut crossing) != 0;
    search::<K, false>(kernel, bvh, ray, visit)
}

#[inline(always)]
fn search<K: Kernel, const ORDERED: bool>(kernel: K, bvh: &Bvh, ray: &Prepared, visit: impl FnMut(&Packet, &mut f32) -> bool) -> bool {
    if 7 * bvh.depth < SHORT_STACK {
        walk::<K, ORDERED, SHORT_STACK>(kernel, bvh, ray, visit)
    } else {
        walk::<K, ORDERED, LONG_STACK>(kernel, bvh, ray, visit)
    }
}

/// A waiting child: its entry distance above its code, so that the order of the numbers is the order of the distances.
#[inline(always)]
fn waiting(entry: f32, child: u32) -> u64 {
    u64::from(entry.to_bits()) << 32 | u64::from(child)
}

/// Visits leaves from near to far (`ORDERED`) until `visit` returns true. `visit` may lower the limit beyond which nothing matters.
#[inline(always)]
fn walk<K: Kernel, const ORDERED: bool, const STACK: usize>(
    kernel: K,
    bvh: &Bvh,
    ray: &Prepared,
    mut visit: impl FnMut(&Packet, &mut f32) -> bool,
) -> bool {
    let mut stack = [0_u64; STACK];
    let mut height = 0;
    let mut limit = ray.t_max;
    let mut current = ROOT;
    let mut entry = [0.0_f32; 8];
    loop {
        if current & LEAF == 0 {
            let node = &bvh.nodes[current as usize];
            let mut lanes = kernel.boxes(node, ray, limit, &mut entry);
            if lanes != 0 {
                let next = |lanes: &mut u32| {
                    let lane = (lanes.trailing_zeros() & 7) as usize;
                    *lanes &= *lanes - 1;
                    kernel.prefetch(bvh, node.child[lane]);
                    waiting(entry[lane], node.child[lane])
                };
                let first = next(&mut lanes);
                if lanes == 0 {
                    current = first as u32;
                    continue;
                }
                let second = next(&mut lanes);
                if ORDERED {
                    let (mut near, far) = if first < second { (first, second) } else { (second, first) };
                    let base = height;
                    stack[height] = far;
                    height += 1;
                    while lanes != 0 {
                        let mut item = next(&mut lanes);
                        if item < near {
                            std::mem::swap(&mut item, &mut near);
                        }
                        // Insertion, far below near.
                        let mut place = height;
                        while place > base && stack[place - 1] < item {
                            stack[place] = stack[place - 1];
                            place -= 1;
                        }
                        stack[place] = item;
                        height += 1;
                    }
                    current = near as u32;
                } else {
                    stack[height] = second;
                    height += 1;
                    while lanes != 0 {
                        stack[height] = next(&mut lanes);
                        height += 1;
                    }
                    current = first as u32;
                }
                continue;
            }
        } else if visit(&bvh.packets[(current & !LEAF) as usize], &mut limit) {
            return true;
        }
        loop {
            if height == 0 {
                return false;
            }
            height -= 1;
            let top = stack[height];
            if f32::from_bits((top >> 32) as u32) <= limit {
                current = top as u32;
                break;
            }
        }
    }
}

/// The arithmetic written with loops over arrays, for every processor.
#[derive(Clone, Copy, Debug)]
pub(super) struct Portable;

// As the processor's instructions: the second operand if the comparison is false, also because of a NaN.
#[inline(always)]
fn max(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

#[inline(always)]
fn min(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

impl Kernel for Portable {
    #[inline(always)]
    fn boxes(self, node: &Node, ray: &Prepared, t_best: f32, entry: &mut [f32; 8]) -> u32 {
        let mut near = [ray.t_min; 8];
        let mut far = [t_best; 8];
        for i in (0..3).rev() {
            let (enter, leave) = (&node.bounds[ray.near[i]], &node.bounds[ray.far[i]]);
            for lane in 0..8 {
                near[lane] = max((enter[lane] - ray.origin[i]) * ray.near_scale[i], near[lane]);
                far[lane] = min((leave[lane] - ray.origin[i]) * ray.far_scale[i], far[lane]);
            }
        }
        *entry = near;
        (0..8).fold(0, |bits, lane| bits | u32::from(near[lane] <= far[lane]) << lane)
    }

    #[inline(always)]
    fn triangles(self, packet: &Packet, ray: &Prepared, t_best: f32, crossing: &mut Crossing) -> u32 {
        let [kx, ky, kz] = ray.axis;
        let [sx, sy, sz] = ray.shear;
        let mut sheared = [[[0.0_f32; 8]; 3]; 3];
        for (corner, rows) in sheared.iter_mut().zip(&packet.vertex) {
            for lane in 0..8 {
                let z = rows[kz][lane] - ray.origin[kz];
                corner[0][lane] = (rows[kx][lane] - ray.origin[kx]) - sx * z;
                corner[1][lane] = (rows[ky][lane] - ray.origin[ky]) - sy * z;
                corner[2][lane] = z;
            }
        }
        let [a, b, c] = &sheared;
        let mut lanes = 0;
        for lane in 0..8 {
            let u = c[0][lane] * b[1][lane] - c[1][lane] * b[0][lane];
            let v = a[0][lane] * c[1][lane] - a[1][lane] * c[0][lane];
            let w = b[0][lane] * a[1][lane] - b[1][lane] * a[0][lane];
            let inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
            let determinant = (u + v) + w;
            let t = sz * ((u * a[2][lane] + v * b[2][lane]) + w * c[2][lane]) / determinant;
            let counts = packet.triangle[lane] != ray.skip[0] && packet.triangle[lane] != ray.skip[1];
            lanes |= u32::from(inside && t > ray.t_min && t < t_best && counts) << lane;
            crossing.t[lane] = t;
            crossing.edge[0][lane] = u;
            crossing.edge[1][lane] = v;
            crossing.edge[2][lane] = w;
        }
        lanes
    }

    #[inline(always)]
    fn prefetch(self, _: &Bvh, _: u32) {}
}
