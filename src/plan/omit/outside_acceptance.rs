//! The whole source lies outside the directions that the sensor accepts, in each pose of the instrument.
//!
//! ```text
//! ∠(n, c − p) − asin((R + a)/|c − p|) > θ_max   ⇒   R(ω) = 0 towards every point of the source   ⇒   direct light = 0
//! ```
//!
//! `p`, `a`, `n` are centre, radius and normal of the aperture, `c` and `R` those of the source's bounding sphere (R = 0 for a point
//! source; the angle of −s alone for parallel light along s), θ_max the angle where the acceptance ends. Within |c − p| ≤ R + a nothing
//! is left out.

use super::Rule;
use crate::plan::sight;
use crate::plan::{Bound, Plan, Transport};
use crate::scene::Scene;

pub(super) const RULE: Rule = Rule { name: "outside_acceptance", sentence: "the whole source lies outside the sensor's acceptance", apply };

fn apply(scene: &Scene, plan: &mut Plan) {
    plan.omit(RULE.name, |term| {
        let instrument = &scene.instruments[term.id.instrument()];
        let limit = instrument.sensor.acceptance.limit_rad();
        let reach = instrument.sensor.aperture.radius_m();
        if term.id.transport == Transport::Reflected || limit >= std::f64::consts::FRAC_PI_2 {
            return None;
        }
        let source = &scene.sources[term.id.source()];
        let nearest =
            instrument.poses.iter().map(|pose| sight::smallest_angle_rad(scene, pose, reach, source)).fold(f64::INFINITY, f64::min);
        (nearest > limit).then(|| {
            let reason = format!("at least {:.4}° off axis, acceptance ends at {:.4}°", nearest.to_degrees(), limit.to_degrees());
            (reason.into(), Bound::Zero)
        })
    });
}
