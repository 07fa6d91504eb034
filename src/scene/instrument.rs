//! An instrument: a sensor with one or more poses in a scene.

use std::sync::Arc;

use crate::math::DVec3;
use crate::sensor::Sensor;

/// Place and orientation of a sensor in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Centre of the aperture, m.
    pub at: DVec3,
    /// Unit normal of the aperture: the direction the sensor faces.
    pub normal: DVec3,
    /// Unit vector along the width of the aperture, from which φ is counted; perpendicular to `normal`.
    pub x_axis: DVec3,
}

impl Pose {
    /// Completes the right-handed frame (x, y, normal).
    #[must_use]
    pub fn y_axis(&self) -> DVec3 {
        self.normal.cross(self.x_axis)
    }
}

impl Instrument {
    /// Corners of the smallest box, with edges along the axes, that holds the centre of every aperture, m.
    #[must_use]
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        self.poses.iter().fold(start, |(low, high), pose| (low.min(pose.at), high.max(pose.at)))
    }
}

/// How the poses of an instrument are arranged, for reports.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// One pose.
    Single,
    /// Poses one after the other.
    List,
    /// A grid; the pose of (column, row) has the index `row · columns + column`.
    Grid {
        /// Points along the first axis.
        columns: usize,
        /// Points along the second axis.
        rows: usize,
    },
}

/// A sensor in a scene.
#[derive(Clone, Debug)]
pub struct Instrument {
    /// The name in the scene file, unique among the instruments.
    pub name: String,
    /// The sensor; several instruments may share one.
    pub sensor: Arc<Sensor>,
    /// How the poses are arranged.
    pub layout: Layout,
    /// At least one.
    pub poses: Vec<Pose>,
}
