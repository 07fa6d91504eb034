//! Direct light by looking into the directions that are accepted: of an environment that something may hide, or of a source that fills the
//! field of a luminance meter.
//!
//! ```text
//! E = ∫ L R cosθ V dω = L ⟨ W V ⟩        W = R π sin²α, directions with density cosθ/(π sin²α)
//!   = L ∫ w V dω = L ⟨ W V ⟩                W = 4π w, all directions alike, at a head without a horizon
//! E = L ⟨ β W₀ + W (V − β) ⟩             W₀ = ∫ R cosθ dω, β the share that a pilot run found clear
//! ```

use multiversion::multiversion;

use super::job::Piece;
use super::lanes::each_sixteen;
use super::receiver::Receiver;
use super::{Counters, REPLICATES};
use crate::geometry::rays::{LANES, NONE, Rays};
use crate::geometry::world::World;
use crate::math::random::Stream;

/// Whether the front and the back of each element shine: V is then whether a ray meets such a side first.
pub(super) type Lit = Vec<[bool; 2]>;

/// Directions of the pilot run.
const PILOT: u32 = 64;

pub(super) fn pilot(world: &World, lit: Option<&Lit>, receiver: &Receiver<'_>, stream: Stream) -> (f64, Counters) {
    let (mut all, mut clear) = (0.0, 0.0);
    each_direction(world, lit, receiver, &[stream], (0, PILOT), |_, w, visible| {
        all += w;
        clear += if visible { w } else { 0.0 };
    });
    let share = if all > 0.0 { clear / all } else { 1.0 };
    (share, Counters { rays: u64::from(PILOT), samples: u64::from(PILOT), ..Counters::default() })
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+avx2+fma", "x86_64+avx2+fma"))]
pub(super) fn sample(
    world: &World,
    lit: Option<&Lit>,
    receiver: &Receiver<'_>,
    stream: Stream,
    (first, count): (u32, u32),
    beta: f64,
) -> Piece {
    let streams: [Stream; REPLICATES] = std::array::from_fn(|r| stream.child(r as u64));
    let samples = u64::from(count) * REPLICATES as u64;
    let mut piece = Piece {
        sums: vec![0.0; REPLICATES],
        connections: 0,
        clear: 0,
        potential: vec![0.0],
        counters: Counters { samples, rays: samples, ..Counters::default() },
    };
    let known = receiver.acceptance.projected_solid_angle_sr();
    each_direction(world, lit, receiver, &streams, (first, count), |replicate, w, visible| {
        piece.sums[replicate] += beta * known + w * (f64::from(visible) - beta);
        if w > 0.0 {
            piece.connections += 1;
            piece.clear += u64::from(visible);
            piece.potential[0] += w;
        }
    });
    piece
}

#[inline(always)]
fn each_direction(
    world: &World,
    lit: Option<&Lit>,
    receiver: &Receiver<'_>,
    streams: &[Stream],
    range: (u32, u32),
    mut take: impl FnMut(usize, f64, bool),
) {
    let mut rays = Rays::none();
    rays.leaving = [receiver.resting_on; LANES];
    rays.leaving_part = [receiver.resting_part; LANES];
    let mut w = [0.0; LANES];
    each_sixteen(streams, range, |points| {
        let u = &points.u;
        rays.active = [false; LANES];
        for lane in 0..points.lanes {
            let (at, direction, counts) = receiver.look([u[0][lane], u[1][lane], u[2][lane], u[3][lane]]);
            w[lane] = counts;
            rays.active[lane] = true;
            rays.origin.set(lane, at);
            rays.direction.set(lane, direction);
        }
        let visible = match lit {
            None => world.blocked(&rays).map(|blocked| !blocked),
            Some(lit) => {
                let hits = world.closest(&rays);
                let shines = |lane: usize| {
                    let (origin, direction, element) = (rays.origin.get(lane), rays.direction.get(lane), hits.element[lane]);
                    rays.active[lane] && element != NONE && {
                        let hit = world.surface_point(origin, direction, hits.t[lane], element, hits.part[lane]);
                        lit[element as usize][usize::from(hit.normal.dot(direction) >= 0.0)]
                    }
                };
                std::array::from_fn(shines)
            }
        };
        for lane in 0..points.lanes {
            take(points.replicate[lane], w[lane], visible[lane]);
        }
    });
}
