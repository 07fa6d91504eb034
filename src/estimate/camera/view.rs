//! From a place on a pixel and a place on the pupil to a ray in the scene.

use crate::estimate::paths::{FirstRay, Start};
use crate::geometry::rays::NONE;
use crate::math::DVec3;
use crate::math::sample::sample_disc;
use crate::scene::PlacedCamera;
use crate::sensor::camera::Camera;

/// A camera with the directions of its image.
#[derive(Clone, Copy)]
pub(super) struct View<'a> {
    pub(super) camera: &'a Camera,
    pub(super) at: DVec3,
    /// Along the optical axis, into the scene.
    pub(super) ahead: DVec3,
    pub(super) right: DVec3,
    pub(super) up: DVec3,
    pupil_radius_m: f64,
}

impl<'a> View<'a> {
    pub(super) fn of(placed: &'a PlacedCamera) -> View<'a> {
        let pose = &placed.pose;
        View {
            camera: &placed.camera,
            at: pose.at,
            ahead: pose.normal,
            right: -pose.x_axis,
            up: pose.y_axis(),
            pupil_radius_m: placed.camera.lens.pupil_radius_m(),
        }
    }

    /// A point of the pupil, uniformly over its area, m from its middle.
    #[inline(always)]
    pub(super) fn pupil(&self, u: [f64; 2]) -> [f64; 2] {
        sample_disc(u).map(|x| x * self.pupil_radius_m)
    }

    /// That point in the world.
    #[inline(always)]
    pub(super) fn pupil_point(&self, pupil_m: [f64; 2]) -> DVec3 {
        self.at + self.right * pupil_m[0] + self.up * pupil_m[1]
    }

    /// The ray of a pixel by four numbers: the first two for the pupil, the others for the pixel.
    #[inline(always)]
    pub(super) fn ray(&self, column: usize, row: usize, u: [f64; 4]) -> FirstRay {
        let pupil = self.pupil([u[0], u[1]]);
        let image = self.camera.image_point_m(column, row, [u[2], u[3]]);
        let slope = self.camera.lens.slope(image, pupil);
        FirstRay {
            origin: self.pupil_point(pupil),
            direction: self.ahead + self.right * slope[0] + self.up * slope[1],
            weight: self.camera.weight_sr(image, pupil),
        }
    }
}

/// A pixel as the start of paths.
pub(super) struct PixelStart<'a> {
    pub(super) view: &'a View<'a>,
    pub(super) column: usize,
    pub(super) row: usize,
}

impl Start for PixelStart<'_> {
    #[inline(always)]
    fn normal(&self) -> DVec3 {
        self.view.ahead
    }

    #[inline(always)]
    fn leaves(&self) -> [u32; 2] {
        [NONE, NONE]
    }

    #[inline(always)]
    fn ray(&self, u: [f64; 4]) -> FirstRay {
        self.view.ray(self.column, self.row, u)
    }
}
