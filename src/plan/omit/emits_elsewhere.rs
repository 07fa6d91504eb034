//! The source emits from one side only, and the instrument is on the other, in each of its poses.

use super::Rule;
use crate::plan::sight;
use crate::plan::{Bound, Plan, Transport};
use crate::scene::Scene;

pub(super) const RULE: Rule =
    Rule { name: "emits_elsewhere", sentence: "the source shows the instrument only sides that do not emit", apply };

fn apply(scene: &Scene, plan: &mut Plan) {
    plan.omit(RULE.name, |term| {
        let instrument = &scene.instruments[term.id.instrument()];
        let reach = instrument.sensor.aperture.radius_m();
        let dark = term.id.transport == Transport::Direct
            && instrument.poses.iter().all(|pose| !sight::may_emit_towards(scene, &scene.sources[term.id.source()], pose.at, reach));
        dark.then_some((RULE.sentence.into(), Bound::Zero))
    });
}
