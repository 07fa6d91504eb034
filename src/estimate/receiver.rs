//! Where light is received: a sensor in one of its poses.

use std::f64::consts::PI;

use crate::geometry::rays::NONE;
use crate::geometry::shape::Shape;
use crate::math::DVec3;
use crate::math::sample::sample_disc;
use crate::scene::{Pose, Scene};
use crate::sensor::{Acceptance, Aperture, Sensor};

/// A sensor in a pose, prepared for sampling.
#[derive(Clone, Copy, Debug)]
pub(super) struct Receiver<'a> {
    pub(super) pose: Pose,
    y_axis: DVec3,
    pub(super) acceptance: &'a Acceptance,
    pub(super) aperture: Aperture,
    /// Sine of the angle beyond which nothing is accepted.
    pub(super) sine_limit: f64,
    /// The element on which the aperture lies, if any: rays do not meet it where they start.
    pub(super) resting_on: u32,
    /// The triangle of that element.
    pub(super) resting_part: u32,
}

impl<'a> Receiver<'a> {
    pub(super) fn new(scene: &Scene, sensor: &'a Sensor, pose: Pose) -> Receiver<'a> {
        let (resting_on, resting_part) = resting_place(scene, &pose);
        let limit = sensor.acceptance.limit_rad();
        Receiver {
            pose,
            y_axis: pose.y_axis(),
            acceptance: &sensor.acceptance,
            aperture: sensor.aperture,
            sine_limit: if limit >= 0.5 * PI { 1.0 } else { limit.sin() },
            resting_on,
            resting_part,
        }
    }

    /// A point of the aperture, uniformly over its area: readings are means over the aperture, so the weight is one.
    #[inline(always)]
    pub(super) fn point(&self, u: [f64; 2]) -> DVec3 {
        match self.aperture {
            Aperture::Point => self.pose.at,
            Aperture::Disc { radius_m } => {
                let [a, b] = sample_disc(u);
                self.pose.at + radius_m * (self.pose.x_axis * a + self.y_axis * b)
            }
            Aperture::Rectangle { half_width_m, half_height_m } => {
                self.pose.at + self.pose.x_axis * (half_width_m * (2.0 * u[0] - 1.0)) + self.y_axis * (half_height_m * (2.0 * u[1] - 1.0))
            }
        }
    }

    /// The relative response R for light that comes from `to` (any length); zero below the horizon.
    #[inline(always)]
    pub(super) fn response(&self, to: DVec3) -> f64 {
        let cos = self.pose.normal.dot(to);
        if cos <= 0.0 {
            return 0.0;
        }
        match self.acceptance {
            Acceptance::Cosine => 1.0,
            other => {
                let (x, y) = (self.pose.x_axis.dot(to), self.y_axis.dot(to));
                // Lengths cancel in the angles.
                other.at(cos, x.hypot(y), y.atan2(x))
            }
        }
    }
}

/// The element that holds the centre of the aperture, to 1e-9 of its size.
fn resting_place(scene: &Scene, pose: &Pose) -> (u32, u32) {
    for (e, element) in scene.elements.iter().enumerate() {
        let (_, size) = element.shape.bounding_sphere();
        let slack = 1e-9 * size;
        let near = match &element.shape {
            Shape::Rectangle(r) => {
                let to = pose.at - r.centre;
                let inside = |half: DVec3| to.dot(half.normalize()).abs() <= half.length() + slack;
                r.normal().dot(to).abs() <= slack && inside(r.half_u) && inside(r.half_v)
            }
            Shape::Polygon(p) => (pose.at - p.nearest_point(pose.at)).length() <= slack,
            Shape::Disc(d) => {
                let to = pose.at - d.centre;
                d.normal.dot(to).abs() <= slack && to.length() <= d.radius_m + slack
            }
            Shape::Sphere(s) => ((pose.at - s.centre).length() - s.radius_m).abs() <= slack,
            Shape::Mesh(m) => {
                // The last triangle behind the aperture, if it is close enough to be the one it lies on.
                if let Some(hit) = m.closest(pose.at + slack * pose.normal, -pose.normal, 2.0 * slack, None) {
                    return (e as u32, hit.triangle);
                }
                false
            }
        };
        if near {
            return (e as u32, NONE);
        }
    }
    (NONE, NONE)
}
