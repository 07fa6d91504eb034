//! A sensor must not lie on an emitting surface and look into it: the distance between them is zero, and no reading exists.
//! A head that sees all round looks into it whichever way it faces.
//!
//! The centre of the aperture counts as lying on a rectangle, polygon, disc or sphere within a share of 1e-9 of its size; of an aperture
//! that faces a flat emitter squarely, so do its corners and the middles of its sides. Meshes are not looked at.

use super::SAME;
use super::coincident_emitters::nearest_point;
use crate::geometry::shape::{Shape, Side};
use crate::math::DVec3;
use crate::scene::diagnostic::Problems;
use crate::scene::reader::Places;
use crate::scene::{Pose, Scene};
use crate::sensor::Aperture;
use crate::source::Emitter;

/// Notes the first such pose of each instrument and source.
pub(super) fn check(scene: &Scene, places: &Places, problems: &mut Problems) {
    for (instrument, place) in scene.instruments.iter().zip(&places.instruments) {
        let (poses, aperture) = (&instrument.poses, instrument.sensor.aperture);
        let (low, high) = instrument.bounds();
        let all_round = !instrument.sensor.acceptance.has_horizon();
        for source in &scene.sources {
            let Emitter::Area { elements } = &source.emitter else { continue };
            let touches = |&(element, side): &(usize, Side)| {
                let shape = &scene.elements[element].shape;
                let (centre, radius_m) = shape.bounding_sphere();
                let reach_m = radius_m * (1.0 + SAME) + aperture.radius_m();
                let near = (centre.clamp(low, high) - centre).length() <= reach_m;
                if near {
                    poses.iter().position(|pose| lies_on(pose, pose.at, shape, side, all_round) || overlaps(pose, aperture, shape, side))
                } else {
                    None
                }
            };
            if let Some(index) = elements.iter().find_map(touches) {
                let which =
                    if poses.len() > 1 { format!("pose {index} of \"{}\"", instrument.name) } else { format!("\"{}\"", instrument.name) };
                let message = format!("{which} lies on the emitting surface of \"{}\" and looks into it", source.name);
                place.problem_at(
                    &place.title_span(),
                    problems,
                    message,
                    "move the instrument away from the source, at least by a small part of the source's size",
                );
            }
        }
    }
}

/// Share of an aperture that is looked at: one that only touches the outline of an emitter lies beside it.
const WITHIN: f64 = 1.0 - 1e-6;

/// Whether an aperture in the plane of a flat emitter has a part of its rim on it.
fn overlaps(pose: &Pose, aperture: Aperture, shape: &Shape, side: Side) -> bool {
    let squarely = shape.plane().is_some_and(|(_, normal)| pose.normal.dot(normal) * side.sign() < -1.0 + SAME);
    let (u, v, corner) = match aperture {
        Aperture::Point => return false,
        Aperture::Disc { radius_m } => (radius_m, radius_m, std::f64::consts::FRAC_1_SQRT_2),
        Aperture::Rectangle { half_width_m, half_height_m } => (half_width_m, half_height_m, 1.0),
    };
    let (u, v) = (WITHIN * u * pose.x_axis, WITHIN * v * pose.y_axis());
    let rim = [(1.0, 0.0), (corner, corner), (0.0, 1.0), (-corner, corner)].map(|(a, b)| a * u + b * v);
    squarely && rim.iter().any(|&r| lies_on(pose, pose.at + r, shape, side, false) || lies_on(pose, pose.at - r, shape, side, false))
}

fn lies_on(pose: &Pose, at: DVec3, shape: &Shape, side: Side, all_round: bool) -> bool {
    let (distance, size, normal) = match shape {
        Shape::Rectangle(r) => ((at - nearest_point(r, at)).length(), r.half_u.length().hypot(r.half_v.length()), r.normal()),
        Shape::Polygon(p) => ((at - p.nearest_point(at)).length(), p.bounding_sphere().1, p.normal()),
        Shape::Disc(d) => {
            let offset = at - d.centre;
            let height = offset.dot(d.normal);
            let beyond = ((offset - d.normal * height).length() - d.radius_m).max(0.0);
            (height.hypot(beyond), d.radius_m, d.normal)
        }
        Shape::Sphere(s) => {
            let offset = at - s.centre;
            ((offset.length() - s.radius_m).abs(), s.radius_m, offset.normalize_or_zero())
        }
        Shape::Mesh(_) => return false,
    };
    distance <= SAME * size && (all_round || pose.normal.dot(normal) * side.sign() < 0.0)
}
