//! The source emits from one side only, and the instrument is on the other, in each of its poses.
//!
//! ```text
//! m · (p − q) + a ≤ 0   for each flat piece of the source, with a point q and the normal m of its lit side
//! ±(|p − c| − R) + a ≤ 0   for each sphere, + lit outside, − lit inside
//!     ⇒   no point of the aperture is on a lit side   ⇒   direct light = 0
//! ```
//!
//! `p` and `a` are centre and radius of the aperture. A mesh is never left out by this rule.

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
