//! A source emits at no wavelength to which the channel responds.
//!
//! The supports of densities and responsivities are never too small, so an empty intersection proves a zero.

use super::Rule;
use crate::plan::{Bound, Plan};
use crate::scene::Scene;

pub(super) const RULE: Rule =
    Rule { name: "no_common_wavelength", sentence: "the source emits at no wavelength to which the channel responds", apply };

fn apply(scene: &Scene, plan: &mut Plan) {
    // Sources with the spectrum of their predecessor are common in large scenes: the answer is kept.
    let mut last: Option<(usize, usize, usize, bool)> = None;
    plan.omit(RULE.name, |term| {
        let (i, c, s) = (term.id.instrument(), term.id.channel(), term.id.source());
        let disjoint = match last {
            Some((li, lc, ls, answer)) if (li, lc) == (i, c) && (ls == s || scene.sources[ls].density == scene.sources[s].density) => {
                answer
            }
            _ => scene.sources[s].density.joint_support(&[&scene.instruments[i].sensor.channels[c].responsivity]).is_empty(),
        };
        last = Some((i, c, s, disjoint));
        disjoint.then_some((RULE.sentence.into(), Bound::Zero))
    });
}
