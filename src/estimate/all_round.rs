//! Direct light of a source that nothing hides, at a small head that weighs light from all round.
//!
//! ```text
//! E = ∫ w dω over the source per unit of its radiance,   w(ω)/r² per unit of intensity,   w(−s) per unit of parallel irradiance
//! ```

use super::closed_form::aperture::Bounded;
use super::closed_form::head::Oriented;
use super::closed_form::point;
use crate::geometry::rays::COINCIDENT;
use crate::geometry::shape::{Shape, Side, Sphere};
use crate::math::DVec3;
use crate::scene::{Pose, Scene};
use crate::sensor::Head;
use crate::source::{Emitter, Source};

/// Weighted radiance per unit of the source's density, at a head at `at`.
pub(super) fn at_point(scene: &Scene, head: Head, pose: &Pose, at: DVec3, source: &Source) -> Bounded {
    let exact = |value: f64| Bounded { value, error: 0.0 };
    let weight = |to: DVec3| head.weight(DVec3::new(pose.x_axis.dot(to), pose.y_axis().dot(to), pose.normal.dot(to)));
    match &source.emitter {
        Emitter::Point { at: lamp } => {
            let to = *lamp - at;
            // The factor along the direction itself is 1/r².
            exact(weight(to) * point::irradiance_factor(to, to))
        }
        Emitter::Directional { travels } => exact(weight(-*travels)),
        Emitter::Environment => exact(head.total_sr()),
        Emitter::Area { elements } => {
            let axis = if head.axis_is_up() { pose.y_axis() } else { pose.normal };
            let head = Oriented { weights: head.weights(), normal: pose.normal, axis };
            let mut sum = exact(0.0);
            for &(e, side) in elements {
                let found = of_shape(&head, &scene.elements[e].shape, side, at);
                sum.value += found.value;
                sum.error += found.error;
            }
            sum
        }
    }
}

fn of_shape(head: &Oriented, shape: &Shape, side: Side, at: DVec3) -> Bounded {
    let dark = Bounded { value: 0.0, error: 0.0 };
    let flat = |corners: &[DVec3]| {
        let relative = corners.iter().map(|&c| c - at);
        let facing: Vec<DVec3> = if side == Side::Back { relative.rev().collect() } else { relative.collect() };
        head.polygon(&facing)
    };
    if shape.plane().is_some_and(|(point, front)| edge_on(point, front, shape.bounding_sphere().1, at)) {
        return dark;
    }
    match shape {
        Shape::Rectangle(r) => flat(&r.corners()),
        Shape::Polygon(p) => flat(p.corners()),
        Shape::Disc(d) => {
            let within = |radius_m: f64| head.disc(d.centre - at, side.sign() * d.normal, radius_m);
            let (plate, hole) = (within(d.radius_m), within(d.hole_radius_m));
            Bounded { value: (plate.value - hole.value).max(0.0), error: plate.error + hole.error }
        }
        Shape::Sphere(s) => match (side, s.holds(at)) {
            (Side::Front, false) => head.sphere(s.centre - at, s.radius_m),
            (Side::Back, true) => from_within(head, s, at),
            _ => dark,
        },
        Shape::Mesh(m) => {
            let triangles = (0..m.triangle_count() as u32).filter_map(|t| Some((m.triangle(t)?, m.normal(t)?)));
            let mut sum = dark;
            for (corners, front) in triangles {
                let size = (corners[1] - corners[0]).length().max((corners[2] - corners[0]).length());
                if !edge_on(corners[0], front, size, at) {
                    let found = flat(&corners);
                    sum.value += found.value;
                    sum.error += found.error;
                }
            }
            sum
        }
    }
}

/// Whether a point is in the plane of a face, to the rounding of its coordinates.
fn edge_on(point: DVec3, front: DVec3, size_m: f64, at: DVec3) -> bool {
    let slack = COINCIDENT * size_m + 4.0 * f64::EPSILON * (at.abs().max_element() + point.abs().max_element());
    front.dot(at - point).abs() <= slack
}

/// Within a luminous sphere: everything, or, on the wall itself, the half space on the inner side.
fn from_within(head: &Oriented, s: &Sphere, at: DVec3) -> Bounded {
    let to = s.centre - at;
    let rounding = 4.0 * f64::EPSILON * (s.centre.abs().max_element() + at.abs().max_element());
    if to.length() < s.radius_m * (1.0 - COINCIDENT) - rounding { head.everything() } else { head.half_space(to) }
}
