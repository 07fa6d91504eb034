//! Reflections that are provably below a stated share of the sources' radiance are left out, and the proof enters the budget.
//!
//! ```text
//! reflected radiance ≤ ρ L_max      E_reflected ≤ ρ L_max ∫R cosθ dω      (maximum principle for Lambertian surfaces)
//! ```
//!
//! If the largest reflectance is ρ < 1 and no emitter is brighter than L_max, a surface receives at most π max(L_max, L_r) and
//! so shows at most L_r ≤ ρ max(L_max, L_r), hence L_r ≤ ρ L_max. Holds for emitters that have a radiance (area sources and the
//! environment); with point sources or parallel light the rule does not apply.

use super::Rule;
use crate::plan::{Bound, Plan, Transport};
use crate::scene::Scene;
use crate::source::Emitter;

/// The largest reflectance with which reflections are left out.
const NEGLIGIBLE_SHARE: f64 = 1e-6;

pub(super) const RULE: Rule = Rule {
    name: "weak_reflections",
    sentence: "no surface reflects more than 1e-6, so reflections are bounded by that share of the source's radiance",
    apply,
};

fn apply(scene: &Scene, plan: &mut Plan) {
    let every_emitter_has_radiance = scene.sources.iter().all(|s| matches!(s.emitter, Emitter::Area { .. } | Emitter::Environment));
    let covered = scene.elements.iter().flat_map(|e| [e.front, e.back]);
    let largest = covered.map(|s| scene.surfaces[s].reflectance.max_over(0.0, f64::INFINITY)).fold(0.0, f64::max);
    if !every_emitter_has_radiance || largest > NEGLIGIBLE_SHARE || largest <= 0.0 {
        return;
    }
    let brightness = |i: usize, c: usize, s: usize| {
        let channel = &scene.instruments[i].sensor.channels[c];
        let sensor = &scene.instruments[i].sensor;
        let scale = channel.indication_per_irradiance(&sensor.aperture, &sensor.acceptance).unwrap_or(channel.scale);
        scale * scene.sources[s].density.integral(&[&channel.responsivity])
    };
    plan.omit(RULE.name, |term| {
        if term.id.transport == Transport::Direct {
            return None;
        }
        let (i, c, s) = (term.id.instrument(), term.id.channel(), term.id.source());
        let accepted = scene.instruments[i].sensor.acceptance.projected_solid_angle_sr();
        let bound = largest * brightness(i, c, s) * accepted;
        Some((format!("no surface reflects more than {largest:.1e}, so at most {bound:.1e} in all").into(), Bound::AtMost(bound)))
    });
}
