//! A camera in a scene: its pose, and the rectangles of its image that are read.

use std::sync::Arc;

use super::Pose;
use crate::sensor::camera::Camera;

/// A rectangle of pixels that is read as a whole.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Region {
    /// The name in the scene file, unique in the camera.
    pub name: String,
    /// First column, from 0 at the left.
    pub x: usize,
    /// First row, from 0 at the top.
    pub y: usize,
    /// Columns, at least one.
    pub width: usize,
    /// Rows, at least one.
    pub height: usize,
}

/// A camera in a scene.
#[derive(Clone, Debug)]
pub struct PlacedCamera {
    /// The name in the scene file, unique among instruments and cameras.
    pub name: String,
    /// The camera; several may share one.
    pub camera: Arc<Camera>,
    /// The middle of the pupil and the direction in which the camera looks. The image's right is against `x_axis`, its up along `y_axis`.
    pub pose: Pose,
    /// What is read of the image.
    pub regions: Vec<Region>,
}
