//! A sensor must not lie on an emitting surface and look into it: the distance between them is zero, and no reading exists.
//! A head that sees all round looks into it whichever way it faces.
//!
//! The centre of the aperture counts as lying on a rectangle, polygon, disc or sphere within a share of 1e-9 of its size. Meshes are
//! not looked at.

use super::SAME;
use super::coincident_emitters::nearest_point;
use crate::geometry::shape::{Shape, Side};
use crate::scene::diagnostic::Problems;
use crate::scene::reader::Places;
use crate::scene::{Pose, Scene};
use crate::source::Emitter;

/// Notes the first such pose of each instrument and source.
pub(super) fn check(scene: &Scene, places: &Places, problems: &mut Problems) {
    for (instrument, place) in scene.instruments.iter().zip(&places.instruments) {
        let poses = &instrument.poses;
        let (low, high) = instrument.bounds();
        let all_round = !instrument.sensor.acceptance.has_horizon();
        for source in &scene.sources {
            let Emitter::Area { elements } = &source.emitter else { continue };
            let touches = |&(element, side): &(usize, Side)| {
                let shape = &scene.elements[element].shape;
                let (centre, radius_m) = shape.bounding_sphere();
                let near = (centre.clamp(low, high) - centre).length() <= radius_m * (1.0 + SAME);
                if near { poses.iter().position(|pose| lies_on(pose, shape, side, all_round)) } else { None }
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

fn lies_on(pose: &Pose, shape: &Shape, side: Side, all_round: bool) -> bool {
    let (distance, size, normal) = match shape {
        Shape::Rectangle(r) => ((pose.at - nearest_point(r, pose.at)).length(), r.half_u.length().hypot(r.half_v.length()), r.normal()),
        Shape::Polygon(p) => ((pose.at - p.nearest_point(pose.at)).length(), p.bounding_sphere().1, p.normal()),
        Shape::Disc(d) => ((pose.at - d.nearest_point(pose.at)).length(), d.radius_m, d.normal),
        Shape::Sphere(s) => {
            let offset = pose.at - s.centre;
            ((offset.length() - s.radius_m).abs(), s.radius_m, offset.normalize_or_zero())
        }
        Shape::Mesh(_) => return false,
    };
    distance <= SAME * size && (all_round || pose.normal.dot(normal) * side.sign() < 0.0)
}
