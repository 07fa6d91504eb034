//! What runs are held to.
//!
//! ```text
//! formulas of the plan        where the plan in question samples a reading that the ordinary plan has a formula for
//! a sky behind a black wall   E = L (π − G)       G: projected solid angle of the wall's part above the horizon
//! else                        a run of F · N samples with a seed of its own, and the uncertainty that it states
//! ```
//!
//! Sources: the polygon's G as in [`crate::estimate::closed_form::polygon`]. F is 128, and less where the time would not reach.

use crate::estimate::closed_form::polygon::polygon_two_sided;
use crate::estimate::{EstimateError, Stop, Watch};
use crate::measurement::{Measurement, measure};
use crate::plan::Plan;
use crate::scene::Scene;
use crate::sensor::{Acceptance, Aperture};
use crate::source::Emitter;

/// Relative rounding of the closed forms that are evaluated here.
const ROUNDING: f64 = 1e-12;

/// Where a truth is from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TruthOrigin {
    /// A formula that the readings do not use.
    ClosedForm,
    /// A long run of the same plan.
    LongRun {
        /// Samples a sampled contribution and pose.
        samples: u64,
    },
}

impl TruthOrigin {
    /// In words.
    #[must_use]
    pub fn words(self) -> String {
        match self {
            TruthOrigin::ClosedForm => "closed form".to_owned(),
            TruthOrigin::LongRun { samples } => format!("{samples} samples"),
        }
    }
}

/// What a reading is held to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Truth {
    /// The value, in the unit of the reading.
    pub value: f64,
    /// Its standard uncertainty.
    pub standard_uncertainty: f64,
    /// Where it is from.
    pub origin: TruthOrigin,
}

/// Truths of closed form, a reading each in their order; `None` where there is none.
pub(super) fn closed_forms(scene: &Scene, planned: &Plan) -> Vec<Option<Truth>> {
    let formulas = by_plan(scene, planned);
    let skies = sky_behind_a_black_wall(scene);
    formulas.into_iter().zip(skies).map(|(formula, sky)| formula.or(sky)).collect()
}

/// Readings of the ordinary plan that need no sample.
fn by_plan(scene: &Scene, planned: &Plan) -> Vec<Option<Truth>> {
    let stop = Stop { target: None, budget_seconds: None, samples: Some(1) };
    let readings = measure(scene, planned, &stop, 0, &Watch { now: &|| 0.0, progress: &|_| {} }).map_or(Vec::new(), |m| m.readings);
    let truth = |r: &crate::measurement::Reading| Truth {
        value: r.value,
        standard_uncertainty: r.standard_uncertainty(),
        origin: TruthOrigin::ClosedForm,
    };
    let all: usize = scene.instruments.iter().map(|i| i.poses.len() * i.sensor.channels.len()).sum();
    let mut found: Vec<Option<Truth>> = readings.iter().map(|r| (r.samples == 0).then(|| truth(r))).collect();
    found.resize(all, None);
    found
}

/// A uniform sky, and one flat black thing with corners that hides a part of it.
fn sky_behind_a_black_wall(scene: &Scene) -> Vec<Option<Truth>> {
    let wall = match (&scene.elements[..], &scene.sources[..]) {
        ([wall], [sky]) if matches!(sky.emitter, Emitter::Environment) => {
            let black = [wall.front, wall.back].iter().all(|&s| scene.surfaces[s].is_black());
            wall.shape.corners().filter(|_| black).map(|corners| (corners, sky))
        }
        _ => None,
    };
    let mut truths = Vec::new();
    for instrument in &scene.instruments {
        let sensor = &instrument.sensor;
        let ideal = sensor.aperture == Aperture::Point && sensor.acceptance == Acceptance::Cosine;
        for pose in &instrument.poses {
            for channel in &sensor.channels {
                let scale = channel.indication_per_irradiance(&sensor.aperture, &sensor.acceptance);
                truths.push(match (&wall, scale) {
                    (Some((corners, sky)), Some(scale)) if ideal => {
                        let seen: Vec<_> = corners.iter().map(|&corner| corner - pose.at).collect();
                        let open_sr = std::f64::consts::PI - polygon_two_sided(&seen, pose.normal);
                        let value = scale * sky.density.integral(&[&channel.responsivity]) * open_sr;
                        Some(Truth { value, standard_uncertainty: ROUNDING * value.abs(), origin: TruthOrigin::ClosedForm })
                    }
                    _ => None,
                });
            }
        }
    }
    truths
}

/// What a long run finds.
pub(super) fn long_run(
    scene: &Scene,
    plan: &Plan,
    samples: u64,
    seed: u64,
    now: &(dyn Fn() -> f64 + Sync),
) -> Result<Vec<Truth>, EstimateError> {
    let stop = Stop { target: None, budget_seconds: None, samples: Some(samples) };
    let Measurement { readings, .. } = measure(scene, plan, &stop, seed, &Watch { now, progress: &|_| {} })?;
    let truth = |r: &crate::measurement::Reading| Truth {
        value: r.value,
        standard_uncertainty: r.standard_uncertainty(),
        origin: TruthOrigin::LongRun { samples },
    };
    Ok(readings.iter().map(truth).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::PlanOptions;
    use crate::scene::scene_from_text;

    /// Howell B-3: a wall of width 2w and height h at the distance d.
    fn howell_b3(w: f64, h: f64, d: f64) -> f64 {
        ((w / d).atan() - d / d.hypot(h) * (w / d.hypot(h)).atan()) / std::f64::consts::PI
    }

    #[test]
    fn a_wall_before_a_sky_hides_what_the_catalogue_says() {
        let scene = scene_from_text(
            r#"Scene(
                surfaces: { "soot": Black },
                objects: [(name: "wall", shape: Quad(corner: (-10, 0, 0), u: (20, 0, 0), v: (0, 0, 4)), surface: "soot")],
                sources: [(name: "sky", shape: Environment, strength: Lux(10000), spectrum: "D65")],
                instruments: [(name: "m", at: (0, 3, 0), facing: (0, 0, 1),
                    sensor: Sensor(aperture: Point, acceptance: Cosine,
                                   channels: [(name: "E", responsivity: "V", reads: Illuminance)]))])"#,
        )
        .expect("a scene");
        let plan = Plan::new(&scene, &PlanOptions::default()).expect("a plan");
        let truths = closed_forms(&scene, &plan);
        let truth = truths[0].expect("a closed form");
        let expected = 1e4 * (1.0 - howell_b3(10.0, 4.0, 3.0));
        assert!((truth.value - expected).abs() < 1e-11 * expected, "{} and {expected}", truth.value);
    }

    #[test]
    fn a_wall_that_reflects_has_no_closed_form_here() {
        let scene = scene_from_text(
            r#"Scene(
                surfaces: { "white": Lambertian(0.5) },
                objects: [(name: "wall", shape: Quad(corner: (-10, 0, 0), u: (20, 0, 0), v: (0, 0, 4)), surface: "white")],
                sources: [(name: "sky", shape: Environment, strength: Lux(10000), spectrum: "D65")],
                instruments: [(name: "m", at: (0, 3, 0), facing: (0, 0, 1),
                    sensor: Sensor(aperture: Point, acceptance: Cosine,
                                   channels: [(name: "E", responsivity: "V", reads: Illuminance)]))])"#,
        )
        .expect("a scene");
        let plan = Plan::new(&scene, &PlanOptions::default()).expect("a plan");
        assert_eq!(closed_forms(&scene, &plan), [None]);
    }
}
