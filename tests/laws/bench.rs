//! Scenes from text, readings from scenes, and how readings are compared.

use etendue::estimate::{Stop, Watch};
use etendue::math::DVec3;
use etendue::measurement::{Measurement, measure};
use etendue::plan::{Plan, PlanOptions};
use etendue::scene::scene_from_text;

/// Relative tolerance of what comes from formulas.
pub(crate) const EXACT: f64 = 1e-9;

/// Standard uncertainties by which sampled readings may differ.
pub(crate) const MOST_U: f64 = 4.0;

/// A point meter of irradiance.
pub(crate) const METER: &str =
    r#"Sensor(aperture: Point, acceptance: Cosine, channels: [(name: "E", responsivity: 1, reads: Irradiance)])"#;

/// A vector as scene files have it, every digit kept.
pub(crate) fn at(v: DVec3) -> String {
    format!("({:e}, {:e}, {:e})", v.x, v.y, v.z)
}

/// Measures a scene.
pub(crate) fn measured(text: &str, stop: &Stop, seed: u64) -> Measurement {
    measured_by(text, &PlanOptions::default(), stop, seed)
}

/// Measures a scene by a plan of some kind.
pub(crate) fn measured_by(text: &str, options: &PlanOptions, stop: &Stop, seed: u64) -> Measurement {
    let scene = scene_from_text(text).unwrap_or_else(|problems| panic!("{problems}\n{text}"));
    let plan = Plan::new(&scene, options).unwrap();
    measure(&scene, &plan, stop, seed, &Watch { now: &|| 0.0, progress: &|_| {} }).unwrap_or_else(|error| panic!("{error}"))
}

/// Values of a scene that needs no samples.
pub(crate) fn exact(text: &str) -> Vec<f64> {
    let found = measured(text, &Stop::default(), 1);
    assert_eq!((found.counters.rays, found.counters.samples), (0, 0), "samples were taken:\n{text}");
    found.readings.iter().map(|r| r.value).collect()
}

/// A number of samples for each job.
pub(crate) fn samples(n: u64) -> Stop {
    Stop { target: None, budget_seconds: None, samples: Some(n) }
}

/// Until the expanded uncertainty is this share of the value.
pub(crate) fn target(share: f64) -> Stop {
    Stop { target: Some(share), budget_seconds: None, samples: None }
}

/// Value and standard uncertainty.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Uncertain {
    pub(crate) value: f64,
    pub(crate) u: f64,
}

impl Uncertain {
    pub(crate) fn sum(parts: &[Uncertain]) -> Uncertain {
        Uncertain { value: parts.iter().map(|p| p.value).sum(), u: parts.iter().map(|p| p.u * p.u).sum::<f64>().sqrt() }
    }

    pub(crate) fn times(self, factor: f64) -> Uncertain {
        Uncertain { value: factor * self.value, u: factor * self.u }
    }

    pub(crate) fn exactly(value: f64) -> Uncertain {
        Uncertain { value, u: 0.0 }
    }
}

/// Readings of a scene with their uncertainties. Where a target was set, it must have been met.
pub(crate) fn uncertain(text: &str, stop: &Stop, seed: u64) -> Vec<Uncertain> {
    let found = measured(text, stop, seed);
    assert!(found.readings.iter().all(|r| r.target_met && r.standard_uncertainty().is_finite()), "{:?}", found.readings);
    found.readings.iter().map(|r| Uncertain { value: r.value, u: r.standard_uncertainty() }).collect()
}

/// Asserts that two results agree within their joint uncertainty, and that this uncertainty says something.
#[track_caller]
pub(crate) fn assert_agree(law: &str, a: Uncertain, b: Uncertain) {
    let joint = a.u.hypot(b.u);
    let deviation = (a.value - b.value).abs();
    assert!(joint < 0.05 * b.value.abs(), "{law}: an uncertainty of {joint:e} at {:e} says nothing", b.value);
    eprintln!("{law}: {:.2} u apart, u = {:.1e} of the value", deviation / joint, joint / b.value);
    assert!(deviation <= MOST_U * joint, "{law}: {a:?} and {b:?} are {:.2} u apart", deviation / joint);
}

/// |a/b − 1|, zero if both are zero.
pub(crate) fn apart(a: f64, b: f64) -> f64 {
    if a == b { 0.0 } else { (a / b - 1.0).abs() }
}

/// A room of 2 m × 3 m × 2.5 m with grey walls, a plate in it that shades, a panel and a lamp; `s` is the length of one metre, m.
/// A meter on the floor and one in the air.
pub(crate) fn room(s: f64, rho: f64, panel_w_m2_sr: f64, lamp_w_sr: f64) -> String {
    let p = |x: f64, y: f64, z: f64| at(DVec3::new(x * s, y * s, z * s));
    format!(
        r#"Scene(
            surfaces: {{ "paint": Lambertian({rho}) }},
            objects: [
                (name: "walls", shape: Box(size: {}), at: {}, surface: "paint", seen_from: Inside),
                (name: "plate", shape: Disc({:e}), at: {}, facing: (0.1, 0.2, 1), surface: "paint"),
            ],
            sources: [
                (name: "panel", shape: Rectangle({:e}, {:e}), at: {}, facing: (0, 0, -1), strength: Radiance({panel_w_m2_sr:e}), spectrum: Line(555)),
                (name: "lamp", shape: Point, at: {}, strength: WattsPerSteradian({lamp_w_sr:e}), spectrum: Line(555)),
            ],
            instruments: [
                (name: "floor", sensor: {METER}, at: {}, facing: (0, 0, 1)),
                (name: "air", sensor: {METER}, at: {}, facing: (1, -0.5, 0.3)),
            ],
        )"#,
        p(2.0, 3.0, 2.5),
        p(-1.0, -1.5, 0.0),
        0.3 * s,
        p(0.25, 0.125, 1.5),
        0.5 * s,
        0.75 * s,
        p(0.0, 0.25, 2.25),
        p(-0.5, -0.75, 1.75),
        p(0.5, 0.375, 0.0),
        p(-0.25, 0.5, 1.0),
    )
}
