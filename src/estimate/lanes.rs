//! The points of many replicates, sixteen at a time.

use crate::geometry::rays::LANES;
use crate::math::random::{Stream, four_in_lanes};

/// Sixteen points.
pub(super) struct Points {
    /// How many of the lanes hold one.
    pub(super) lanes: usize,
    /// The replicate of each.
    pub(super) replicate: [usize; LANES],
    /// Their numbers: `u[dimension][lane]`.
    pub(super) u: [[f64; LANES]; 4],
}

/// Calls `take` for the points `first .. first + count` of every stream, a stream a replicate.
#[inline(always)]
pub(super) fn each_sixteen(streams: &[Stream], (first, count): (u32, u32), mut take: impl FnMut(&Points)) {
    let items = count as usize * streams.len();
    let mut points = Points { lanes: 0, replicate: [0; LANES], u: [[0.0; LANES]; 4] };
    for start in (0..items).step_by(LANES) {
        points.lanes = LANES.min(items - start);
        // Lanes beyond the last point repeat it, and are not looked at.
        let item: [usize; LANES] = std::array::from_fn(|lane| start + lane.min(points.lanes - 1));
        points.replicate = item.map(|i| i % streams.len());
        let indices = item.map(|i| first + (i / streams.len()) as u32);
        four_in_lanes(&points.replicate.map(|r| streams[r]), &indices, &[0; LANES], &mut points.u);
        take(&points);
    }
}
