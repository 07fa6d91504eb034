//! A source without extent is seen from a point in one direction: one connection replaces the samples.

use super::Rule;
use crate::plan::{Method, Narrowing, Plan, Transport};
use crate::scene::Scene;
use crate::sensor::Aperture;
use crate::source::Emitter;

pub(in crate::plan) const RULE: Rule =
    Rule { name: "delta_source", sentence: "a source without extent needs one connection from a point", apply };

fn apply(scene: &Scene, plan: &mut Plan) {
    let mut counts = vec![0usize; scene.instruments.len()];
    for term in &mut plan.kept {
        let instrument = &scene.instruments[term.id.instrument()];
        let delta = matches!(scene.sources[term.id.source()].emitter, Emitter::Point { .. } | Emitter::Directional { .. });
        if term.id.transport == Transport::Direct && delta && instrument.sensor.aperture == Aperture::Point {
            term.method = Method::Connection;
            counts[term.id.instrument()] += 1;
        }
    }
    for (instrument, &count) in counts.iter().enumerate().filter(|(_, c)| **c > 0) {
        plan.narrowed.push(Narrowing {
            rule: RULE.name,
            instrument,
            what: format!("no samples for {count} direct term{}: {}", if count == 1 { "" } else { "s" }, RULE.sentence),
        });
    }
}
