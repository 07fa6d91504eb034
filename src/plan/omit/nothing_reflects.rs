//! Every surface of the scene absorbs all light, so nothing is reflected.

use super::Rule;
use crate::plan::{Bound, Plan, Transport};
use crate::scene::Scene;

pub(super) const RULE: Rule = Rule { name: "nothing_reflects", sentence: "no surface of the scene reflects", apply };

fn apply(scene: &Scene, plan: &mut Plan) {
    let black: Vec<bool> = scene.surfaces.iter().map(crate::surface::Surface::is_black).collect();
    if scene.elements.iter().all(|e| black[e.front] && black[e.back]) {
        plan.omit(RULE.name, |term| (term.id.transport == Transport::Reflected).then_some((RULE.sentence.into(), Bound::Zero)));
    }
}
