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

#[test]
fn light_that_one_method_sums_up_is_not_carried_by_another() {
    // Two lamps in a coloured sphere: one on a line, where its reflections have a sum, one with a continuum, where they are sampled.
    let scene = |sources: &str| {
        format!(
            r#"Scene(
                surfaces: {{ "paint": Lambertian("ColorChecker white") }},
                objects: [(name: "wall", shape: Sphere(0.25), seen_from: Inside, surface: "paint")],
                sources: [{sources}],
                instruments: [(name: "m", sensor: {METER}, at: (0.25, 0, 0), facing: (-1, 0, 0))],
            )"#
        )
    };
    let lamp = r#"(name: "a", shape: Point, at: (0, 0, 0), strength: Watts(1), spectrum: "A"),"#;
    let laser = r#"(name: "l", shape: Point, at: (0, 0, 0), strength: Watts(1), spectrum: Line(633)),"#;
    let value = |sources: String| read(&scene(&sources), 65536).remove(0);
    let (both, first, second) = (value(format!("{lamp}{laser}")), value(lamp.to_owned()), value(laser.to_owned()));
    let u = both.standard_uncertainty().hypot(first.standard_uncertainty());
    assert!((both.value - first.value - second.value).abs() <= 4.0 * u, "{} against {} + {}", both.value, first.value, second.value);
    assert_eq!(second.samples, 0);
}

#[test]
fn a_weak_lamp_beside_a_strong_one_is_read() {
    // A megawatt at 1500 nm, where the eye sees nothing, and one watt at 555 nm.
    let meter = r#"Sensor(title: "i", aperture: Point, acceptance: Cosine, channels: [(name: "E_v", responsivity: "V", reads: Illuminance),
        (name: "E_e", responsivity: 1.0, reads: Irradiance)])"#;
    let scene = |strong: &str| {
        format!(
            r#"Scene(
                surfaces: {{ "grey": Lambertian(0.5) }},
                objects: [(name: "floor", shape: Rectangle(10, 10), surface: "grey")],
                sources: [{strong} (name: "weak", shape: Point, at: (0, 1, 2), strength: Watts(1), spectrum: Line(555))],
                instruments: [(name: "m", sensor: {meter}, at: (0, 0, 1), facing: (0, 0, -1))],
            )"#
        )
    };
    let strong = r#"(name: "strong", shape: Point, at: (0, 0, 2), strength: Watts(1e6), spectrum: Line(1500)),"#;
    let (beside, alone) = (read(&scene(strong), 65536).remove(0), read(&scene(""), 65536).remove(0));
    assert!(alone.value > 3.0);
    let u = beside.standard_uncertainty().hypot(alone.standard_uncertainty());
    assert!((beside.value - alone.value).abs() <= 4.0 * u && u < 0.05 * alone.value, "{} against {}", beside.value, alone.value);
}

#[test]
fn a_meter_on_a_luminous_wall_sees_all_but_that_wall() {
    let inside = |shape: &str, poses: &str| {
        format!(
            r#"Scene(
                sources: [(name: "lamp", shape: {shape}, seen_from: Inside, strength: Radiance(1), spectrum: Line(550))],
                instruments: [(name: "m", sensor: {METER}, list: [{poses}])],
            )"#
        )
    };
    // On the floor of a luminous box: facing up the whole hemisphere is bright, along the floor its upper half.
    let text = inside("Box(size: (1, 1, 1))", "(at: (0.5, 0.5, 0), facing: (0, 0, 1)), (at: (0.5, 0.5, 0), facing: (1, 0, 0))");
    let readings = read(&text, 16);
    for (reading, truth) in readings.iter().zip([PI, 0.5 * PI]) {
        assert!((reading.value / truth - 1.0).abs() < 1e-9, "{}", reading.value);
    }
    // On the wall of a luminous sphere: facing the centre the whole hemisphere is bright, along the wall its inner half.
    let text = inside(
        "Sphere(1)",
        "(at: (1, 0, 0), facing: (-1, 0, 0)), (at: (0, 0.6, 0.8), facing: (0, -0.6, -0.8)), (at: (1, 0, 0), facing: (0, 0, 1))",
    );
    for (reading, truth) in read(&text, 16).iter().zip([PI, PI, 0.5 * PI]) {
        assert!((reading.value / truth - 1.0).abs() < 1e-9, "{}", reading.value);
    }
}

#[test]
fn a_meter_on_an_edge_of_a_turned_box_sees_half_the_sky() {
    for turn_deg in [0.0_f64, 17.0, 71.0] {
        let (sin, cos) = turn_deg.to_radians().sin_cos();
        // The vertical edge at (1, 2) of a box of 1 m × 2 m × 3 m, facing along its y axis.
        let (x, y) = (cos - 2.0 * sin, sin + 2.0 * cos);
        let text = format!(
            r#"Scene(
                surfaces: {{ "black": Black }},
                objects: [(name: "box", shape: Box(size: (1, 2, 3)), turned_deg: (0, 0, {turn_deg}), seen_from: Outside, surface: "black")],
                sources: [(name: "sky", shape: Environment, strength: Radiance(1), spectrum: Line(550))],
                instruments: [(name: "m", sensor: {METER}, at: ({x}, {y}, 1), facing: ({}, {cos}, 0))],
            )"#,
            -sin
        );
        let reading = &read(&text, 4096)[0];
        assert!((reading.value - PI).abs() <= reading.expanded.expanded_uncertainty, "{turn_deg}°: {}", reading.value);
    }
}

#[test]
fn two_rows_of_a_table_and_many_are_the_same_paint() {
    // A ramp from 0.3 to 0.99 in a sphere: E₀ ∫ dλ / (1 − ρ), however many rows the ramp is written in.
    let truth = {
        let (a, b): (f64, f64) = (0.3, 0.99);
        ((1.0 - a) / (1.0 - b)).ln() / (b - a) / (4.0 * PI * 0.0625)
    };
    for rows in [1, 60] {
        let ramp: String =
            (0..=rows).map(|i| f64::from(i) / f64::from(rows)).map(|t| format!("{},{}\n", 400.0 + 300.0 * t, 0.3 + 0.69 * t)).collect();
        let text = format!(
            r#"Scene(
                surfaces: {{ "ramp": Lambertian("ramp.csv") }},
                objects: [(name: "wall", shape: Sphere(0.25), seen_from: Inside, surface: "ramp")],
                sources: [(name: "lamp", shape: Point, at: (0, 0, 0), strength: Watts(1), spectrum: Flat(from_nm: 400, to_nm: 700))],
                instruments: [(name: "m", sensor: {METER}, at: (0.25, 0, 0), facing: (-1, 0, 0))],
            )"#
        );
        let files = etendue::scene::MemoryFiles::new().with("scene.ron", text).with("ramp.csv", ramp);
        let scene = etendue::scene::read_scene("scene.ron", &files, None).unwrap_or_else(|problems| panic!("{problems}"));
        let plan = Plan::new(&scene, &PlanOptions::default()).expect("a plan");
        let stop = Stop { target: None, budget_seconds: None, samples: Some(65536) };
        let reading =
            measure(&scene, &plan, &stop, 3, &Watch { now: &|| 0.0, progress: &|_| {} }).expect("a finite reading").readings.remove(0);
        let deviation = (reading.value - truth).abs();
        assert!(deviation <= 3.0 * reading.standard_uncertainty(), "{rows} rows: {} ± {}", reading.value, reading.standard_uncertainty());
        assert!(reading.standard_uncertainty() < 0.01 * truth);
    }
}

#[test]
fn a_spot_that_no_sample_looked_through_has_a_bound() {
    // A lamp behind the plane of focus: only the middle of the pupil, a share of 1e-4, sees it through the field.
    let sensor = r#"Sensor(title: "spot", aperture: Disc(radius_mm: 5), acceptance: Spot(field_deg: 0.003, focus_m: 1, edge: 0),
        channels: [(name: "L", responsivity: 1.0, reads: Radiance)])"#;
    let text = format!(
        r#"Scene(
            sources: [(name: "lamp", shape: Point, at: (0, 0, 2), strength: WattsPerSteradian(1), spectrum: Line(550))],
            instruments: [(name: "m", sensor: {sensor}, at: (0, 0, 0), facing: (0, 0, 1))],
        )"#
    );
    // I/r² over a disc of the pupil twice as wide as the field, over the étendue of the field: 4 I/(r² π f² tan² β) · …
    let field: f64 = 0.0015f64.to_radians().tan();
    let truth = 0.25 * (2.0 * field / 0.005).powi(2) / (PI * field * field);
    for samples in [256, 1 << 20] {
        let reading = &read(&text, samples)[0];
        assert!(reading.expanded.expanded_uncertainty > 0.0, "{samples}: {} ± 0", reading.value);
        assert!(
            (reading.value - truth).abs() <= 1.5 * reading.expanded.expanded_uncertainty,
            "{samples}: {} ± {} instead of {truth}",
            reading.value,
            reading.expanded.expanded_uncertainty
        );
    }
}
