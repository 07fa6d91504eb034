//! Every surface that reflects lies below the instrument's horizon or outside its acceptance, in each of its poses: whatever
//! reflects, the instrument cannot see it. Where nothing reflects at all the same proof has nothing to look at.

use super::Rule;
use crate::plan::sight;
use crate::plan::{Bound, Plan, Transport};
use crate::scene::Scene;

pub(super) const RULE: Rule = Rule {
    name: "no_reflector_in_view",
    sentence: "every reflecting surface lies below the instrument's horizon or outside its acceptance",
    apply,
};

fn apply(scene: &Scene, plan: &mut Plan) {
    let black: Vec<bool> = scene.surfaces.iter().map(crate::surface::Surface::is_black).collect();
    let reflecting: Vec<_> = scene.elements.iter().filter(|e| !(black[e.front] && black[e.back])).collect();
    let blind: Vec<bool> = scene
        .instruments
        .iter()
        .map(|instrument| {
            let limit = instrument.sensor.acceptance.limit_rad();
            let reach = instrument.sensor.aperture.radius_m();
            let horizon = instrument.sensor.acceptance.has_horizon();
            instrument.poses.iter().all(|pose| {
                reflecting.iter().all(|e| {
                    (horizon && e.shape.extent_along(pose.at, pose.normal).1 <= 0.0)
                        || sight::smallest_angle_of_shape_rad(pose, reach, &e.shape) > limit
                })
            })
        })
        .collect();
    let reason = if reflecting.is_empty() { "no surface of the scene reflects" } else { RULE.sentence };
    plan.omit(RULE.name, |term| {
        let unseen = term.id.transport == Transport::Reflected && blind[term.id.instrument()];
        unseen.then_some((reason.into(), Bound::Zero))
    });
}
