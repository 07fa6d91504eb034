//! What sampling could overlook: several skies, spots beside a lamp, channels that see almost nothing, walls that absorb almost nothing.

use std::f64::consts::PI;

use etendue::estimate::{Stop, Watch};
use etendue::measurement::{Reading, measure};
use etendue::plan::{Plan, PlanOptions};
use etendue::scene::scene_from_text;

fn read(text: &str, samples: u64) -> Vec<Reading> {
    let scene = scene_from_text(text).unwrap_or_else(|problems| panic!("{problems}"));
    let plan = Plan::new(&scene, &PlanOptions::default()).expect("a plan");
    let stop = Stop { target: None, budget_seconds: None, samples: Some(samples) };
    measure(&scene, &plan, &stop, 7, &Watch { now: &|| 0.0, progress: &|_| {} }).expect("a finite reading").readings
}

const METER: &str =
    r#"Sensor(title: "i", aperture: Point, acceptance: Cosine, channels: [(name: "E", responsivity: 1.0, reads: Irradiance)])"#;

#[test]
fn every_sky_is_reflected() {
    for second in ["Flat(from_nm: 400, to_nm: 700)", "Line(550)"] {
        let text = format!(
            r#"Scene(
                surfaces: {{ "grey": Lambertian(0.8) }},
                objects: [(name: "floor", shape: Disc(1000), surface: "grey")],
                sources: [
                    (name: "one", shape: Environment, strength: Radiance(1), spectrum: Flat(from_nm: 400, to_nm: 700)),
                    (name: "two", shape: Environment, strength: Radiance(1), spectrum: {second}),
                ],
                instruments: [(name: "m", sensor: {METER}, at: (0, 0, 0.001), facing: (0, 0, -1))],
            )"#
        );
        // The floor has the radiance ρ · 2, and fills the view but for 1e-12 of it.
        let reading = &read(&text, 4096)[0];
        let deviation = (reading.value - 1.6 * PI).abs();
        assert!(
            deviation <= reading.expanded.expanded_uncertainty.max(1e-9),
            "{} ± {}",
            reading.value,
            reading.expanded.expanded_uncertainty
        );
        assert!(reading.expanded.expanded_uncertainty < 0.02);
    }
}

#[test]
fn a_spot_right_beside_a_lamp_is_within_the_uncertainty() {
    // A lamp of 1 W/sr at a distance d ≪ h from a surface: half its flux makes a Lambertian spot of the intensity 2 ρ I cosθ.
    let text = format!(
        r#"Scene(
            surfaces: {{ "white": Lambertian(0.8) }},
            objects: [(name: "ceiling", shape: Disc(5), at: (0, 0, 1), facing: (0, 0, -1), surface: "white")],
            sources: [(name: "lamp", shape: Point, at: (0, 0, 0.9999), strength: WattsPerSteradian(1), spectrum: Line(550))],
            instruments: [(name: "m", sensor: {METER}, at: (0, 0, 0), facing: (0, 0, 1))],
        )"#
    );
    let truth = 1.0 / 0.9999_f64.powi(2) + 1.6;
    let reading = &read(&text, 65536)[0];
    assert!((reading.value - truth).abs() <= reading.expanded.expanded_uncertainty);
    assert!(reading.budget.rows.iter().any(|row| row.source.contains("bright spot")), "{:?}", reading.budget.rows);
}

#[test]
fn a_channel_that_finds_nothing_states_a_bound() {
    // A large red wall, and a small white disc that alone reflects blue light to the meter.
    let text = r#"Scene(
        surfaces: { "red": Lambertian(Band(from_nm: 600, to_nm: 700, value: 0.5)), "white": Lambertian(0.5) },
        objects: [
            (name: "wall", shape: Disc(10), at: (0, 0, 5), facing: (0, 0, -1), surface: "red"),
            (name: "chip", shape: Disc(0.001), at: (0.3, 0.2, 4), facing: (0, 0, -1), surface: "white"),
        ],
        sources: [(name: "lamp", shape: Point, at: (1, 0, -1), strength: WattsPerSteradian(100), spectrum: Flat(from_nm: 400, to_nm: 700))],
        instruments: [(name: "m", at: (0, 0, 0), facing: (0, 0, 1), sensor: Sensor(title: "i", aperture: Point, acceptance: Cosine,
            channels: [(name: "blue", responsivity: Band(from_nm: 400, to_nm: 500), reads: Irradiance),
                       (name: "red", responsivity: Band(from_nm: 600, to_nm: 700), reads: Irradiance)]))],
    )"#;
    let readings = read(text, 4096);
    let (blue, red) = (&readings[0], &readings[1]);
    assert!(red.value > 0.0 && red.standard_uncertainty() > 0.0);
    assert_eq!(blue.value, 0.0);
    assert!(blue.standard_uncertainty() > 0.0 && !blue.notes.is_empty());
}

#[test]
fn walls_that_absorb_almost_nothing_have_a_reading() {
    // E = E₀ + ρ/(1 − ρ) I/R² at the wall of a sphere, by paths of some 20 000 reflections.
    let rho = 0.99995;
    let text = format!(
        r#"Scene(
            surfaces: {{ "white": Lambertian({rho}) }},
            objects: [(name: "wall", shape: Sphere(1), seen_from: Inside, surface: "white")],
            sources: [(name: "lamp", shape: Point, at: (0, 0, 0), strength: WattsPerSteradian(1), spectrum: Line(550))],
            instruments: [(name: "m", sensor: Sensor(title: "i", aperture: Point, acceptance: Cone(half_angle_deg: 60),
                channels: [(name: "E", responsivity: 1.0, reads: Irradiance)]), at: (0, 0, -1), facing: (0, 0, 1))],
        )"#
    );
    // The wall is uniformly bright, so the cone takes sin² 60° of the reflected irradiance, and all of the direct one.
    let truth = 1.0 + 0.75 * rho / (1.0 - rho);
    let reading = &read(&text, 1024)[0];
    assert!(reading.samples > 0);
    assert!(
        (reading.value - truth).abs() <= 4.0 * reading.standard_uncertainty(),
        "{} ± {}",
        reading.value,
        reading.standard_uncertainty()
    );
    assert!(reading.standard_uncertainty() < 0.1 * truth);
}
