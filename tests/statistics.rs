//! Intervals that hold: sampled readings are unbiased, and the 95 % interval covers the truth at its rate, with the stopping rule on.
//!
//! Each scene has a truth in closed form that the sampled method does not use: the method is forced by `naive` or by an occluder.

#![allow(clippy::print_stdout)]

use etendue::estimate::closed_form::polygon::polygon_two_sided;
use etendue::estimate::{Stop, Watch};
use etendue::math::DVec3;
use etendue::measurement::{Measurement, measure};
use etendue::plan::{Plan, PlanOptions};
use etendue::scene::{Scene, scene_from_text};

const SEEDS: u64 = 1000;

fn scene(text: &str) -> Scene {
    scene_from_text(text).unwrap_or_else(|problems| panic!("{problems}"))
}

fn read(scene: &Scene, plan: &Plan, stop: &Stop, seed: u64) -> Measurement {
    measure(scene, plan, stop, seed, &Watch { now: &|| 0.0, progress: &|_| {} }).expect("a finite reading")
}

const METER: &str =
    r#"Sensor(title: "meter", aperture: Point, acceptance: Cosine, channels: [(name: "E", responsivity: 1.0, reads: Irradiance)])"#;

/// A wall hides part of a uniform sky: π − G of the wall.
fn hidden_sky() -> (Scene, f64) {
    let wall = [DVec3::new(-1.0, 1.0, 0.2), DVec3::new(2.0, 1.0, 0.2), DVec3::new(2.0, 1.0, 1.7), DVec3::new(-1.0, 1.0, 1.7)];
    let truth = std::f64::consts::PI - polygon_two_sided(&wall, DVec3::Z);
    let text = format!(
        r#"Scene(
            surfaces: {{ "black": Black }},
            objects: [(name: "wall", shape: Quad(corner: (-1, 1, 0.2), u: (3, 0, 0), v: (0, 0, 1.5)), surface: "black")],
            sources: [(name: "sky", shape: Environment, strength: Radiance(1), spectrum: Flat(from_nm: 400, to_nm: 700))],
            instruments: [(name: "m", sensor: {METER}, at: (0, 0, 0), facing: (0, 0, 1))],
        )"#
    );
    (scene(&text), truth)
}

/// A blade hides part of a panel from a point: the form factor of what is left.
fn half_hidden_panel() -> (Scene, f64) {
    // The blade at half height covers x > 0.05 there, so the panel is seen for x < 0.1.
    let seen = [DVec3::new(-0.5, -0.3, 1.0), DVec3::new(0.1, -0.3, 1.0), DVec3::new(0.1, 0.3, 1.0), DVec3::new(-0.5, 0.3, 1.0)];
    let truth = 10.0 * polygon_two_sided(&seen, DVec3::Z);
    let text = format!(
        r#"Scene(
            surfaces: {{ "black": Black }},
            objects: [(name: "blade", shape: Quad(corner: (0.05, -2, 0.5), u: (3, 0, 0), v: (0, 4, 0)), surface: "black")],
            sources: [(name: "panel", shape: Rectangle(1, 0.6), at: (0, 0, 1), facing: (0, 0, -1), strength: Radiance(10),
                       spectrum: Flat(from_nm: 400, to_nm: 700))],
            instruments: [(name: "m", sensor: {METER}, at: (0, 0, 0), facing: (0, 0, 1))],
        )"#
    );
    (scene(&text), truth)
}

/// A closed sphere with a point source off its centre, by paths: E₀ + ρ Φ / (A (1 − ρ)).
fn sphere_by_paths() -> (Scene, f64) {
    let (rho, intensity, radius) = (0.6, 10.0, 0.5);
    let direct = intensity * 0.8_f64.powi(-2);
    let truth = direct + rho / (1.0 - rho) * intensity / (radius * radius);
    let text = format!(
        r#"Scene(
            surfaces: {{ "white": Lambertian({rho}) }},
            objects: [(name: "wall", shape: Sphere({radius}), seen_from: Inside, surface: "white")],
            sources: [(name: "lamp", shape: Point, at: (0, 0, 0.3), strength: WattsPerSteradian({intensity}),
                       spectrum: Flat(from_nm: 400, to_nm: 700))],
            instruments: [(name: "m", sensor: {METER}, at: (0, 0, -{radius}), facing: (0, 0, 1))],
        )"#
    );
    (scene(&text), truth)
}

/// Covered readings, mean deviation in its own standard errors, and how often a reading missed the target itself.
fn campaign(scene: &Scene, truth: f64, stop: &Stop) -> (u64, f64, u64) {
    let plan = Plan::new(scene, &PlanOptions { naive: true, ..PlanOptions::default() }).expect("a plan");
    let (mut covered, mut missed) = (0, 0);
    let mut deviations = Vec::new();
    for seed in 0..SEEDS {
        let reading = read(scene, &plan, stop, seed).readings.remove(0);
        assert!(reading.samples > 0 && reading.standard_uncertainty() > 0.0 && reading.target_met);
        let deviation = reading.value - truth;
        covered += u64::from(deviation.abs() <= reading.expanded.expanded_uncertainty);
        missed += stop.target.map_or(0, |t| u64::from(deviation.abs() > t * truth));
        deviations.push(deviation);
    }
    let n = deviations.len() as f64;
    let mean = deviations.iter().sum::<f64>() / n;
    let spread = (deviations.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / (n - 1.0)).sqrt();
    (covered, mean / (spread / n.sqrt()), missed)
}

/// 0.95 less three binomial standard deviations of 1000 trials: 0.95 − 3 · 0.0069.
const FEWEST_COVERED: u64 = 929;

fn holds(name: &str, (scene, truth): (Scene, f64), target: f64) {
    let stop = Stop { target: Some(target), budget_seconds: None, samples: None };
    let (covered, bias, missed) = campaign(&scene, truth, &stop);
    println!("{name}: covered {covered} of {SEEDS}, mean deviation {bias:.2} standard errors, outside the target {missed}");
    assert!(covered >= FEWEST_COVERED, "{name}: covered {covered} of {SEEDS}");
    assert!(bias.abs() < 4.0, "{name}: biased by {bias:.2} standard errors");
    assert!(missed <= SEEDS / 50, "{name}: {missed} readings outside the target");
}

#[test]
fn intervals_cover_a_partly_hidden_sky() {
    holds("hidden sky", hidden_sky(), 0.01);
}

#[test]
fn intervals_cover_a_penumbra() {
    holds("half hidden panel", half_hidden_panel(), 0.01);
}

#[test]
fn intervals_cover_reflected_light() {
    holds("sphere by paths", sphere_by_paths(), 0.02);
}

#[test]
fn the_spread_falls_faster_than_independent_numbers_allow() {
    let (scene, truth) = half_hidden_panel();
    let plan = Plan::new(&scene, &PlanOptions { naive: true, ..PlanOptions::default() }).expect("a plan");
    let rms = |samples| {
        let stop = Stop { target: None, budget_seconds: None, samples: Some(samples) };
        let square: f64 = (0..40).map(|seed| (read(&scene, &plan, &stop, seed).readings[0].value / truth - 1.0).powi(2)).sum();
        (square / 40.0).sqrt()
    };
    let (coarse, fine) = (rms(1 << 10), rms(1 << 16));
    // A slope of −1/2 would give a factor of 8.
    assert!(fine < coarse / 11.0, "1024 samples: {coarse:.2e}, 65536: {fine:.2e}");
}

#[test]
fn what_nothing_hides_has_no_spread_even_where_shadows_are_tested() {
    // A post far aside that the plan cannot rule out by its bounding sphere alone, but that hides nothing.
    let text = format!(
        r#"Scene(
            surfaces: {{ "black": Black }},
            objects: [(name: "post", shape: Quad(corner: (0.6, -3, 0.3), u: (0, 6, 0), v: (0.001, 0, 0.3)), surface: "black")],
            sources: [(name: "panel", shape: Rectangle(1, 0.6), at: (0, 0, 1), facing: (0, 0, -1), strength: Radiance(10),
                       spectrum: Flat(from_nm: 400, to_nm: 700))],
            instruments: [(name: "m", sensor: {METER}, at: (0, 0, 0), facing: (0, 0, 1))],
        )"#
    );
    let scene = scene(&text);
    let options = PlanOptions { without: vec!["nothing_blocks".into()], ..PlanOptions::default() };
    let reading = read(&scene, &Plan::new(&scene, &options).expect("a plan"), &Stop::default(), 0).readings.remove(0);
    let exact = read(
        &scene,
        &Plan::new(&scene, &PlanOptions { without: options.without.clone(), naive: false }).expect("a plan"),
        &Stop::default(),
        1,
    );
    assert_eq!(reading.value, exact.readings[0].value, "the formula is left alone whatever the seed");
    let default = read(&scene, &Plan::new(&scene, &PlanOptions::default()).expect("a plan"), &Stop::default(), 0).readings.remove(0);
    let allowed = reading.expanded.expanded_uncertainty.hypot(default.expanded.expanded_uncertainty);
    assert!((reading.value - default.value).abs() <= allowed, "tested {}, by the default plan {}", reading.value, default.value);
    // Not an uncertainty of zero: a shadow smaller than the gaps between the samples may have been missed.
    assert!(reading.standard_uncertainty() > 0.0);
}
