//! Light that is reflected more than once, or hidden.

use std::f64::consts::PI;

use etendue::estimate::EstimateError;
use etendue::estimate::Stop;
use etendue::measurement::{expose, measure};

use crate::{QUIET, agree, camera, measured, planned, samples, scene, taken};

/// A lamp of 1 W/sr in a white sphere, seen from beside it.
fn sphere(reflectance: f64) -> etendue::scene::Scene {
    let things = format!(
        "surfaces: {{ \"wall\": Lambertian({reflectance}) }}, objects: [(name: \"sphere\", shape: Sphere(0.5), at: (0, 0.1, 0), seen_from: Inside, surface: \"wall\")],
        sources: [(name: \"lamp\", shape: Point, at: (0, -0.2, 0.1), strength: WattsPerSteradian(1), spectrum: Line(550))],"
    );
    scene(
        &things,
        &camera("Thin(focal_length_mm: 0.1, f_number: 4, focus_m: 0.6)", [12, 10]),
        "\"all\": (x: 0, y: 0, width: 12, height: 10)",
    )
}

#[test]
fn the_wall_of_an_integrating_sphere_has_the_luminance_of_its_balance() {
    let scene = sphere(0.8);
    // Reflected light is even: E = Φ ρ/(1 − ρ) / 4πR². The direct part is I cos/r², from the lamp off the centre, at each pixel another one.
    let measured = measured(&scene, 256, 1);
    let l_v = measured.readings.iter().find(|r| r.channel == "L_v").unwrap();
    let even = 4.0 * PI * 0.8 / 0.2 / (PI * 4.0 * 0.25) * 0.8 / PI;
    // The mean of the direct part over the field, by the rays of the pixels' middles.
    let mut direct = 0.0;
    for row in 0..10 {
        for column in 0..12 {
            let d = direction_of(column, row);
            let (b, c) = (-d[1] * 0.1, 0.01 - 0.25);
            let t = -b + (b * b - c).sqrt();
            let at = [t * d[0], t * d[1], t * d[2]];
            let normal = [-at[0] / 0.5, -(at[1] - 0.1) / 0.5, -at[2] / 0.5];
            let to = [-at[0], -0.2 - at[1], 0.1 - at[2]];
            let r2 = to.iter().map(|x| x * x).sum::<f64>();
            let cos = normal.iter().zip(&to).map(|(n, t)| n * t).sum::<f64>() / r2.sqrt();
            direct += cos / r2 * 0.8 / PI / 120.0;
        }
    }
    let expected = (even + direct) * 683.002 * 0.994_950_1;
    let u = l_v.standard_uncertainty();
    assert!((l_v.value - expected).abs() <= 5.0 * u + 2e-3 * direct * 683.0, "{} ± {u} instead of {expected}", l_v.value);
    assert!(u < 5e-3 * expected);
}

/// Unit direction of the middle of a pixel of that camera.
fn direction_of(column: usize, row: usize) -> [f64; 3] {
    let v = 1e-4 / (1.0 - 1e-4 / 0.6);
    let (x, z) = ((column as f64 + 0.5 - 6.0) * 5e-6 / v, (5.0 - row as f64 - 0.5) * 5e-6 / v);
    let length = (x * x + 1.0 + z * z).sqrt();
    [x / length, 1.0 / length, z / length]
}

#[test]
fn planned_and_naive_pictures_agree_where_things_hide_each_other() {
    let things = "surfaces: { \"white\": Lambertian(0.8), \"red\": Lambertian(Band(from_nm: 600, to_nm: 700, value: 0.7)) },
        objects: [
            (name: \"floor\", shape: Rectangle(3, 3), at: (0, 1.5, -0.5), facing: (0, 0, 1), surface: \"white\"),
            (name: \"wall\", shape: Rectangle(3, 2), at: (0, 3, 0.5), facing: (0, -1, 0), surface: \"red\"),
            (name: \"ball\", shape: Sphere(0.3), at: (0.3, 2, -0.2), surface: \"white\"),
        ],
        sources: [
            (name: \"panel\", shape: Rectangle(0.5, 0.5), at: (-0.5, 1.5, 1.5), facing: (0.2, 0.2, -1), strength: Luminance(2000), spectrum: \"A\"),
            (name: \"lamp\", shape: Point, at: (0.9, 1, 1), strength: Candela(50), spectrum: \"D65\"),
            (name: \"sky\", shape: Environment, strength: Luminance(30), spectrum: \"D65\"),
        ],";
    let model = camera("Thin(focal_length_mm: 0.1, f_number: 4, focus_m: 2)", [30, 24]);
    let regions: Vec<String> = (0..6).map(|k| format!("\"{k}\": (x: {}, y: {}, width: 10, height: 12)", k % 3 * 10, k / 3 * 12)).collect();
    let scene = scene(things, &model, &regions.join(", "));
    let read = |naive: bool, seed: u64| measure(&scene, &planned(&scene, naive), &samples(64), seed, &QUIET).unwrap().readings;
    let (with, without) = (read(false, 1), read(true, 2));
    assert_eq!(with.len(), 12);
    for (a, b) in with.iter().zip(&without) {
        let joint = a.standard_uncertainty().hypot(b.standard_uncertainty());
        assert!(agree(a.value, joint, b.value), "{} {}: {} and {} ± {joint}", a.instrument, a.channel, a.value, b.value);
        assert!(a.value > 0.0 && joint < 0.03 * a.value, "{} {} ± {joint}", a.instrument, a.value);
    }
}

#[test]
fn regions_are_read_alike_with_and_without_the_rest_of_the_picture() {
    let scene = sphere(0.5);
    let (frame, alone) = (taken(&scene, 16, 9), measured(&scene, 16, 9));
    assert_eq!(frame.readings.len(), 2);
    for (a, b) in frame.readings.iter().zip(&alone.readings) {
        assert_eq!((a.value, a.standard_uncertainty(), a.samples), (b.value, b.standard_uncertainty(), b.samples));
        assert!(a.expanded.expanded_uncertainty > 0.0);
    }
}

#[test]
fn a_target_is_met_by_nearly_all_pixels_and_its_intervals_hold_the_truth() {
    let scene = sphere(0.5);
    let plan = planned(&scene, false);
    let stop = Stop { target: Some(0.02), budget_seconds: None, samples: None };
    let frame = expose(&scene, &plan, 0, &stop, 3, &QUIET).unwrap();
    assert!(frame.target_met && frame.groups == 16);
    let long = expose(&scene, &plan, 0, &samples(1 << 14), 4, &QUIET).unwrap();
    let (mut met, mut held) = (0, 0);
    for i in 0..120 {
        let (e, u) = (frame.planes[0].expected_e[i], frame.planes[0].standard_uncertainty_e[i]);
        let (truth, rest) = (long.planes[0].expected_e[i], long.planes[0].standard_uncertainty_e[i]);
        met += u32::from(2.1314 * u <= 0.02 * e);
        held += u32::from((e - truth).abs() <= 2.1314 * u.hypot(rest));
    }
    // 95 % of 120 with four standard deviations of the binomial distribution.
    assert!(met >= 104 && held >= 104, "{met} met the target, {held} hold the truth");
}

#[test]
fn a_picture_of_nothing_says_so_and_a_lossless_space_is_refused() {
    let dark = scene("", &camera("Pinhole(distance_mm: 1, diameter_mm: 0.1)", [4, 4]), "\"r\": (x: 0, y: 0, width: 2, height: 2)");
    let frame = taken(&dark, 8, 1);
    assert!(frame.planes[0].expected_e.iter().all(|&e| e == 0.0) && frame.notes[0].contains("zero electrons"));
    assert!(frame.readings.iter().all(|r| r.value == 0.0 && r.notes[0].starts_with("reads zero")));
    let things = "surfaces: { \"mirror-white\": Lambertian(1) }, objects: [(name: \"sphere\", shape: Sphere(0.5), at: (0, 0, 0), seen_from: Inside, surface: \"mirror-white\")],
        sources: [(name: \"lamp\", shape: Point, at: (0, 0.2, 0), strength: WattsPerSteradian(1), spectrum: Line(550))],";
    let text = format!(
        "Scene({things} cameras: [(name: \"cam\", camera: {}, at: (0, 0, 0), facing: (0, 1, 0))])",
        camera("Pinhole(distance_mm: 1, diameter_mm: 0.1)", [4, 4])
    );
    // Either the reader or the run has to refuse it.
    if let Ok(scene) = etendue::scene::scene_from_text(&text) {
        let found = expose(&scene, &planned(&scene, false), 0, &samples(8), 1, &QUIET);
        assert_eq!(found, Err(EstimateError::Endless { instrument: "cam".into() }));
    }
}
