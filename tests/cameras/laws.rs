//! Lens and pixels alone: a uniform sky, edges, point sources, and an instrument at the place of a pixel.

use std::f64::consts::PI;

use etendue::estimate::run::with_threads;
use etendue::measurement::Frame;
use etendue::scene::scene_from_text;

use crate::{agree, camera, electrons_per_irradiance, measured, scene, taken};

const SKY: &str = "sources: [(name: \"sky\", shape: Environment, strength: Radiance(2), spectrum: Line(550))],";

#[test]
fn a_small_pupil_falls_off_as_the_fourth_power_of_the_cosine() {
    // A sensor as wide as its distance from the hole: 45° at 200 µm.
    let frame = taken(&scene(SKY, &camera("Pinhole(distance_mm: 0.2, diameter_mm: 0.0001)", [81, 1]), ""), 64, 1);
    let plane = &frame.planes[0];
    for column in 0..81usize {
        // Mean of cos⁴ over the pixel, which is as wide as it is high.
        let n = 8;
        let node = |k: usize| (k as f64 + 0.5) / n as f64 - 0.5;
        let tangent2 = |i: usize, j: usize| ((column as f64 - 40.0 + node(i)) * 5e-6 / 2e-4).powi(2) + (node(j) * 5e-6 / 2e-4).powi(2);
        let cos4: f64 = (0..n * n).map(|k| (1.0 + tangent2(k / n, k % n)).powi(-2)).sum::<f64>() / (n * n) as f64;
        let expected = electrons_per_irradiance() * 2.0 * PI * (0.5e-7f64 / 2e-4).powi(2) * cos4;
        assert!((plane.expected_e[column] - expected).abs() <= 6.0 * plane.standard_uncertainty_e[column] + 2e-5 * expected, "{column}");
        assert!((frame.luminance_cd_m2[column] / (2.0 * 683.002 * 0.994_950_1) - 1.0).abs() < 1e-6, "{}", frame.luminance_cd_m2[column]);
    }
}

#[test]
fn a_lens_before_a_uniform_sky_follows_its_f_number_and_its_focus() {
    for (focus, v) in [("inf", 0.05), ("0.55", 0.055)] {
        for n in [1.0, 2.8, 16.0] {
            let lens = format!("Thin(focal_length_mm: 50, f_number: {n}, focus_m: {focus})");
            let frame = taken(&scene(SKY, &camera(&lens, [1, 1]), ""), 4096, 2);
            let radius = 0.025f64 / n;
            let expected = electrons_per_irradiance() * 2.0 * PI * radius * radius / (v * v + radius * radius);
            let (value, u) = (frame.planes[0].expected_e[0], frame.planes[0].standard_uncertainty_e[0]);
            // The pixel has an extent of 1e-4 of the distance.
            assert!((value - expected).abs() <= 6.0 * u + 1e-8 * expected, "{lens}: {value} ± {u} instead of {expected}");
            assert!(u < 2e-3 * expected);
        }
    }
}

#[test]
fn a_pixel_reads_what_an_instrument_in_its_place_reads() {
    // The hole is a luminous disc to an instrument that sits where the pixel is: column 700 of 801, row 100 of 601, so 300 px right, 200 px up.
    let frame = taken(
        &scene(SKY, &camera("Pinhole(distance_mm: 4, diameter_mm: 1)", [801, 601]), "\"pixel\": (x: 700, y: 100, width: 1, height: 1)"),
        256,
        3,
    );
    let instrument = scene_from_text(
        "Scene(sources: [(name: \"hole\", shape: Disc(0.0005), at: (0, 0, 0), facing: (0, -1, 0), strength: Radiance(2), spectrum: Line(550))],
            instruments: [(name: \"pixel\", at: (-0.0015, -0.004, -0.001), facing: (0, 1, 0), sensor: Sensor(
                aperture: Rectangle(width_mm: 0.005, height_mm: 0.005), acceptance: Cosine, channels: [(name: \"E\", responsivity: 1, reads: Irradiance)]))])",
    );
    let instrument = instrument.unwrap_or_else(|problems| panic!("{problems}"));
    let read = measured(&instrument, 1024, 4).readings[0].clone();
    let scale = electrons_per_irradiance();
    let (value, u) = (frame.planes[0].expected_e[100 * 801 + 700], frame.planes[0].standard_uncertainty_e[100 * 801 + 700]);
    let joint = u.hypot(scale * read.standard_uncertainty());
    assert!(agree(value, joint, scale * read.value), "{value} ± {joint} against {}", scale * read.value);
    assert!(joint < 1e-3 * value);
    assert_eq!(frame.readings[0].value, value);
}

#[test]
fn an_edge_out_of_focus_is_blurred_by_the_disc_of_confusion() {
    // A luminous half-plane right of the axis, at twice the distance that is sharp.
    let things = "sources: [(name: \"panel\", shape: Rectangle(8, 8), at: (4, 2, 0), facing: (0, -1, 0), strength: Radiance(2), spectrum: Line(550))],";
    let frame = taken(&scene(things, &camera("Thin(focal_length_mm: 50, f_number: 16, focus_m: 1)", [81, 1]), ""), 1024, 5);
    let (v, radius) = (0.05 / (1.0 - 0.05), 0.05 / 32.0);
    let full = electrons_per_irradiance() * 2.0 * PI * radius * radius / (v * v + radius * radius);
    for column in 0..81 {
        let a = (column as f64 - 40.0) * 5e-6;
        // The ray from p meets the panel at 2 a/v − p.
        let s: f64 = (-2.0 * a / v / radius).clamp(-1.0, 1.0);
        let share = (s.acos() - s * (1.0 - s * s).sqrt()) / PI;
        let (value, u) = (frame.planes[0].expected_e[column], frame.planes[0].standard_uncertainty_e[column]);
        assert!((value - share * full).abs() <= 6.0 * u + 1.5e-3 * full, "{column}: {value} ± {u} instead of {}", share * full);
    }
    // The edge is as wide as the disc of blur, v R/D: 16.4 pixels.
    let lit = |low: f64, high: f64| frame.planes[0].expected_e.iter().filter(|e| **e > low * full && **e < high * full).count();
    assert!((15..=18).contains(&lit(0.001, 0.999)), "{}", lit(0.001, 0.999));
}

#[test]
fn the_image_of_a_point_source_holds_all_its_light_through_the_pupil() {
    for (lens, sharp) in [
        ("Thin(focal_length_mm: 50, f_number: 4, focus_m: 2)", true),
        ("Thin(focal_length_mm: 50, f_number: 4, focus_m: 1)", false),
        ("Pinhole(distance_mm: 4, diameter_mm: 0.1)", false),
    ] {
        let things =
            "sources: [(name: \"star\", shape: Point, at: (0.00011, 2, 0.00007), strength: WattsPerSteradian(1e-3), spectrum: Line(550))],";
        let frame = taken(&scene(things, &camera(lens, [101, 101]), ""), 16, 6);
        // Per ring of the pupil dA cosθ/r² before the lens; behind it counts cos⁴θ′, as for the radiance of a disc around the point.
        let (radius, behind): (f64, fn(f64) -> f64) = match (sharp, lens.starts_with("Pin")) {
            (_, true) => (5e-5, |rho| rho / 2.0),
            (true, _) => (0.05 / 8.0, |rho| rho * (1.0 / 0.05 - 1.0 / 2.0)),
            (false, _) => (0.05 / 8.0, |rho| rho * ((1.0 / 0.05 - 1.0) + (1.0 - 1.0 / 2.0))),
        };
        let cos = |tangent: f64| 1.0 / 1f64.hypot(tangent);
        let ring = |k: u32| {
            let rho = (f64::from(k) + 0.5) / 4000.0 * radius;
            let (before, after) = (cos(rho / 2.0), cos(behind(rho)));
            2.0 * PI * rho * radius / 4000.0 * before.powi(3) / 4.0 * (after / before).powi(4)
        };
        let received: f64 = (0..4000).map(ring).sum();
        let expected = electrons_per_irradiance() / 25e-12 * 1e-3 * received;
        let plane = &frame.planes[0];
        let (sum, u2) = plane.expected_e.iter().zip(&plane.standard_uncertainty_e).fold((0.0, 0.0), |(s, q), (e, u)| (s + e, q + u * u));
        let lit = plane.expected_e.iter().filter(|e| **e > 0.0).count();
        assert!((sum - expected).abs() <= 6.0 * u2.sqrt() + 1e-4 * expected, "{lens}: {sum} instead of {expected}");
        if sharp {
            assert_eq!(lit, 1, "{lens}");
        } else {
            assert!(lit > 100, "{lens}: {lit}");
        }
    }
}

#[test]
fn the_sun_seen_itself_lands_where_the_lens_puts_it() {
    let things = "sources: [(name: \"sun\", shape: Directional, facing: (-0.01, -1, -0.02), strength: WattsPerSquareMetre(1e-3), spectrum: Line(550))],";
    let frame = taken(&scene(things, &camera("Thin(focal_length_mm: 10, f_number: 4, focus_m: inf)", [101, 101]), ""), 8, 1);
    let plane = &frame.planes[0];
    let lit: Vec<usize> = plane.expected_e.iter().enumerate().filter(|(_, e)| **e > 0.0).map(|(i, _)| i).collect();
    // 100 µm to the right and 200 µm up: 20 columns and 40 rows from the middle.
    assert_eq!(lit, [(50 - 40) * 101 + 50 + 20]);
    // E₀ cosθ cos⁴θ′/cos⁴θ over the pupil: ∫ v⁴/d⁴ dA is v² times the projected solid angle of the pupil from the pixel.
    let (v2, a2, r2) = (1e-4f64, (100e-6f64).powi(2) + (200e-6f64).powi(2), (0.01f64 / 8.0).powi(2));
    let root = ((a2 + v2 + r2).powi(2) - 4.0 * a2 * r2).sqrt();
    let area = v2 * PI / 2.0 * (1.0 - (a2 + v2 - r2) / root);
    let cos = 1.0 / (1.0f64 + 1e-4 + 4e-4).sqrt();
    let expected = electrons_per_irradiance() / 25e-12 * 1e-3 * area * cos.powi(-3);
    let (found, u) = (plane.expected_e[lit[0]], plane.standard_uncertainty_e[lit[0]]);
    assert!(u < 1e-4 * expected && (found - expected).abs() <= 6.0 * u + 1e-9 * expected, "{found} ± {u} instead of {expected}");
}

#[test]
fn micro_lenses_and_fill_factor_scale_the_signal() {
    let plain = camera("Pinhole(distance_mm: 1, diameter_mm: 0.01)", [3, 3]);
    let half = plain.replace("pitch_um: 5,", "pitch_um: 5, fill_factor: 0.5,");
    let (one, two) = (taken(&scene(SKY, &plain, ""), 16, 1), taken(&scene(SKY, &half, ""), 16, 1));
    for (a, b) in one.planes[0].expected_e.iter().zip(&two.planes[0].expected_e) {
        assert!((b / a - 0.5).abs() < 1e-14);
    }
}

#[test]
fn lights_add_up_and_bits_depend_on_the_seed_alone() {
    let panel = |x: f64| {
        format!(
            "(name: \"panel {x}\", shape: Rectangle(0.3, 0.3), at: ({x}, 0.5, 0), facing: ({}, 1, 0), strength: Radiance(10), spectrum: \"A\")",
            -x
        )
    };
    let things = |panels: &str| {
        format!(
            "surfaces: {{ \"grey\": Lambertian(0.5) }}, objects: [(name: \"wall\", shape: Rectangle(2, 2), at: (0, 2, 0), facing: (0, -1, 0), surface: \"grey\")], sources: [{panels}],"
        )
    };
    let model = camera("Thin(focal_length_mm: 0.2, f_number: 2, focus_m: 2)", [40, 30]);
    let take = |panels: &str, seed: u64| taken(&scene(&things(panels), &model, ""), 8, seed);
    let (left, right) = (take(&panel(-1.0), 1), take(&panel(1.0), 2));
    let both = take(&format!("{},{}", panel(-1.0), panel(1.0)), 3);
    for i in 0..40 * 30 {
        let [l, r, b] = [&left, &right, &both].map(|f| (f.planes[0].expected_e[i], f.planes[0].standard_uncertainty_e[i]));
        let joint = l.1.hypot(r.1).hypot(b.1);
        // Three degrees of freedom a picture, 1200 pixels.
        assert!((l.0 + r.0 - b.0).abs() <= 30.0 * joint + 1e-9 * b.0, "{i}: {l:?} + {r:?} against {b:?}");
    }
    let total = |f: &Frame| {
        let of = |values: &[f64]| values.iter().sum::<f64>();
        let squares: Vec<f64> = f.planes[0].standard_uncertainty_e.iter().map(|u| u * u).collect();
        (of(&f.planes[0].expected_e), of(&squares).sqrt())
    };
    let [(l, ul), (r, ur), (b, ub)] = [total(&left), total(&right), total(&both)];
    let joint = ul.hypot(ur).hypot(ub);
    assert!((l + r - b).abs() <= 4.0 * joint && joint < 5e-3 * b, "{l} + {r} against {b} ± {joint}");
    let alone = with_threads(Some(1), || take(&panel(-1.0), 1));
    for threads in [2, 8] {
        let again = with_threads(Some(threads), || take(&panel(-1.0), 1));
        assert_eq!((&again.planes, &again.luminance_cd_m2), (&alone.planes, &alone.luminance_cd_m2), "{threads} threads");
    }
    assert_eq!(left.planes, alone.planes);
    assert_ne!(left.planes, take(&panel(-1.0), 7).planes);
}

#[test]
fn a_lamp_that_is_hardly_a_pixel_is_found_and_a_point_is_its_limit() {
    let lens = "Thin(focal_length_mm: 50, f_number: 1, focus_m: 2)";
    let total = |things: &str| {
        let plane = taken(&scene(things, &camera(lens, [31, 31]), ""), 8, 3).planes.swap_remove(0);
        let u2: f64 = plane.standard_uncertainty_e.iter().map(|u| u * u).sum();
        (plane.expected_e.iter().sum::<f64>(), u2.sqrt())
    };
    let at = "at: (0, 2, 0)";
    let (point, u) =
        total(&format!("sources: [(name: \"star\", shape: Point, {at}, strength: WattsPerSteradian(1e-3), spectrum: Line(550))],"));
    // Images from a thousandth of a pixel to nine pixels wide: traced from the lamp up to four, looked for from the pixels beyond.
    for radius in [1e-7, 1e-5, 1e-4, 3.5e-4, 9e-4] {
        let radiance = 1e-3 / (PI * radius * radius);
        let disc = format!(
            "sources: [(name: \"star\", shape: Disc({radius}), {at}, facing: (0, -1, 0), strength: Radiance({radiance}), spectrum: Line(550))],"
        );
        let (value, u_disc) = total(&disc);
        // A disc sends less askew than a point: cosθ over a pupil of ± 0.7°.
        assert!(u_disc > 0.0 && u_disc < 0.05 * point, "{radius}: {value} ± {u_disc}");
        assert!((value - point).abs() <= 6.0 * u.hypot(u_disc) + 2e-4 * point, "{radius}: {value} ± {u_disc}, a point {point}");
    }
}
