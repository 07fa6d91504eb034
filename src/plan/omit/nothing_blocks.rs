//! Nothing can stand between source and instrument: the direct term needs no shadow rays.
//!
//! For each element and each emitting piece one of these proves it: the element lies below every horizon of the instrument; behind
//! the emitting side of the piece; to one side of both, or both to one side of it; or it is a sphere with both inside.

use super::Rule;
use crate::plan::sight::Shafts;
use crate::plan::{Narrowing, Plan, Transport, Visibility};
use crate::scene::Scene;
use crate::sensor::Acceptance;
use crate::source::Emitter;

pub(in crate::plan) const RULE: Rule = Rule { name: "nothing_blocks", sentence: "nothing can stand between source and aperture", apply };

fn apply(scene: &Scene, plan: &mut Plan) {
    let shafts: Vec<Shafts> = scene.instruments.iter().map(|i| Shafts::new(scene, i)).collect();
    let mut counts = vec![0usize; scene.instruments.len()];
    let mut last: Option<(usize, usize, bool)> = None;
    for term in plan.kept.iter_mut().filter(|t| t.id.transport == Transport::Direct) {
        let (i, s) = (term.id.instrument(), term.id.source());
        let clear = match last {
            Some((li, ls, answer)) if (li, ls) == (i, s) => answer,
            // A spot looks for a source by rays, whatever is in their way.
            _ if matches!(
                (&scene.instruments[i].sensor.acceptance, &scene.sources[s].emitter),
                (Acceptance::Spot(_), Emitter::Area { .. })
            ) =>
            {
                false
            }
            _ => shafts[i].clear(scene, &scene.sources[s]),
        };
        last = Some((i, s, clear));
        if clear {
            term.visibility = Visibility::Clear;
            counts[i] += 1;
        }
    }
    for (instrument, &count) in counts.iter().enumerate().filter(|(_, c)| **c > 0) {
        plan.narrowed.push(Narrowing {
            rule: RULE.name,
            instrument,
            what: format!("no shadow rays for {count} direct term{}: {}", if count == 1 { "" } else { "s" }, RULE.sentence),
        });
    }
}
