//! Boxes against blocks of rays: six rectangles that enclose a cuboid are met as one, in the time of two.
//!
//! ```text
//! t_i± = (±1 − o_i)/d_i     enter at max_i min(t_i−, t_i+), leave at min_i max(t_i−, t_i+), met if enter ≤ leave
//! ```
//!
//! in coordinates along the edges in which the cuboid is |x_i| ≤ 1 (Kay and Kajiya 1986). A ray that starts on a face is told by the
//! face's index: outwards it cannot meet the box again, inwards it meets the face where it leaves.

use super::flats::Flat;
use super::rays::{COINCIDENT, Hits, LANES, NONE, Rays};
use crate::math::DVec3;

/// Two lengths of a box are the same to this share: more than the rounding of coordinates that were turned, less than any that
/// were meant to differ.
const SAME: f64 = 1e-12;

/// A cuboid, prepared.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block {
    centre: DVec3,
    /// Unit vectors along the edges over half the edges' lengths.
    axes: [DVec3; 3],
    /// The elements of the faces at −1 and at +1 of each axis.
    faces: [[u32; 2]; 3],
}

impl Block {
    /// The cuboid that six rectangles enclose, if they do.
    pub(super) fn of(flats: &[Flat; 6]) -> Option<Block> {
        let centre = flats.iter().map(|f| f.centre / 6.0).sum::<DVec3>();
        let size = flats.iter().map(|f| (f.centre - centre).length()).fold(0.0, f64::max);
        let mut axes: Vec<DVec3> = Vec::new();
        let mut faces: Vec<[u32; 2]> = Vec::new();
        for flat in flats {
            let half = flat.centre - centre;
            if half.cross(flat.normal).length() > SAME * size {
                return None;
            }
            let scaled = half / half.length_squared();
            match axes.iter().position(|a: &DVec3| a.cross(scaled).length() <= SAME * a.length() * scaled.length()) {
                // The opposite face, at the same distance.
                Some(i) if faces[i][0] == NONE && (axes[i] + scaled).length() <= SAME * axes[i].length() => faces[i][0] = flat.element,
                Some(_) => return None,
                None => {
                    axes.push(scaled);
                    faces.push([NONE, flat.element]);
                }
            }
        }
        let (Ok(axes), Ok(faces)) = (<[DVec3; 3]>::try_from(axes), <[[u32; 2]; 3]>::try_from(faces)) else { return None };
        // Each face reaches exactly to its four neighbours.
        let spans = |flat: &Flat| {
            let edges = [flat.u, flat.v].map(|w| w / w.length_squared());
            let others: Vec<&DVec3> = axes.iter().filter(|a| a.dot(flat.normal).abs() <= SAME * a.length()).collect();
            others.len() == 2 && others.iter().all(|a| edges.iter().filter(|e| ((a.dot(**e)).abs() - 1.0).abs() <= SAME).count() == 1)
        };
        flats.iter().all(spans).then_some(Block { centre, axes, faces })
    }

    /// Distance and face of the first place where a lane meets the box; infinite where it does not.
    #[inline(always)]
    fn meet(&self, rays: &Rays, lane: usize) -> (f64, u32) {
        let o = [rays.origin.x[lane] - self.centre.x, rays.origin.y[lane] - self.centre.y, rays.origin.z[lane] - self.centre.z];
        let d = [rays.direction.x[lane], rays.direction.y[lane], rays.direction.z[lane]];
        let leaving = rays.leaving[lane];
        let (mut enter, mut leave) = (f64::NEG_INFINITY, f64::INFINITY);
        let (mut enter_face, mut leave_face) = (NONE, NONE);
        let (mut starts_here, mut outwards) = (false, false);
        for (axis, faces) in self.axes.iter().zip(&self.faces) {
            let position = axis.x * o[0] + axis.y * o[1] + axis.z * o[2];
            let speed = axis.x * d[0] + axis.y * d[1] + axis.z * d[2];
            let inverse = 1.0 / speed;
            // By the sign of the inverse: a speed of zero has one too, and the two ends stay in order.
            let forward = inverse > 0.0;
            let (a, b) = ((-1.0 - position) * inverse, (1.0 - position) * inverse);
            let (near, far) = if forward { (a, b) } else { (b, a) };
            let (near_face, far_face) = if forward { (faces[0], faces[1]) } else { (faces[1], faces[0]) };
            // A ray along a face gives NaN for it, which leaves both ends as they are.
            let later = near > enter;
            enter = if later { near } else { enter };
            enter_face = if later { near_face } else { enter_face };
            let sooner = far < leave;
            leave = if sooner { far } else { leave };
            leave_face = if sooner { far_face } else { leave_face };
            starts_here |= (leaving == faces[0]) | (leaving == faces[1]);
            outwards |= leaving == far_face;
        }
        let from_outside = (enter > 0.0) & !starts_here;
        let t = if from_outside { enter } else { leave };
        let face = if from_outside { enter_face } else { leave_face };
        let met = (enter <= leave) & (t > 0.0) & !outwards & (leaving != face);
        (if met { t } else { f64::INFINITY }, face)
    }
}

/// Shortens `hits` to the nearest box.
#[inline(always)]
pub(super) fn nearest(blocks: &[Block], rays: &Rays, hits: &mut Hits) {
    for block in blocks {
        for lane in 0..LANES {
            let (t, face) = block.meet(rays, lane);
            let nearer = t < hits.t[lane] * (1.0 - COINCIDENT);
            hits.t[lane] = if nearer { t } else { hits.t[lane] };
            hits.element[lane] = if nearer { face } else { hits.element[lane] };
            hits.part[lane] = if nearer { NONE } else { hits.part[lane] };
        }
    }
}

/// Marks the lanes whose way is cut by a box. A face that a ray arrives at does not cut its way where it is met first; met through
/// the box, the other face does.
#[inline(always)]
pub(super) fn cut(blocks: &[Block], rays: &Rays, blocked: &mut [bool; LANES]) {
    for block in blocks {
        for lane in 0..LANES {
            let (t, face) = block.meet(rays, lane);
            blocked[lane] |= (t < rays.t_end[lane] * (1.0 - COINCIDENT)) & (rays.arriving[lane] != face);
        }
    }
}
