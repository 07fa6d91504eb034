//! The whole source lies below the horizon of the instrument, in each of its poses.
//!
//! ```text
//! n · (x − p) ≤ 0 for every point x of the source   ⇒   cos θ ≤ 0 wherever light arrives from   ⇒   direct light = 0
//! ```
//!
//! `p` is the centre of the aperture and `n` its normal. The inequality holds for the whole aperture, which is plane: n · (y − p) = 0
//! for each of its points y. For parallel light that travels along s it reads −n · s ≤ 0.
//! Heads that see all round have no horizon.

use super::Rule;
use crate::plan::sight;
use crate::plan::{Bound, Plan, Transport};
use crate::scene::Scene;

pub(super) const RULE: Rule = Rule { name: "behind_horizon", sentence: "the whole source lies below the instrument's horizon", apply };

fn apply(scene: &Scene, plan: &mut Plan) {
    plan.omit(RULE.name, |term| {
        let instrument = &scene.instruments[term.id.instrument()];
        let hidden = term.id.transport == Transport::Direct
            && instrument.sensor.acceptance.has_horizon()
            && instrument.poses.iter().all(|pose| sight::highest_over_horizon(scene, pose, &scene.sources[term.id.source()]) <= 0.0);
        hidden.then_some((RULE.sentence.into(), Bound::Zero))
    });
}
