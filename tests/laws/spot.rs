//! Luminance meters with a spot: a filled field reads the luminance, coaxial discs, a small pupil sees a cone, formulas for nothing else.

use std::f64::consts::PI;

use etendue::estimate::Watch;
use etendue::estimate::closed_form::exchange::coaxial_discs;
use etendue::measurement::measure;
use etendue::plan::{Plan, PlanOptions};
use etendue::scene::scene_from_text;
use proptest::prelude::*;

use crate::bench::{Uncertain, apart, assert_agree, exact, measured, samples, uncertain};

fn spot(pupil_mm: f64, field_deg: f64, focus_m: f64, edge: f64, reads: &str) -> String {
    format!(
        "Sensor(aperture: Disc(radius_mm: {pupil_mm:e}), acceptance: Spot(field_deg: {field_deg:e}, focus_m: {focus_m:e}, edge: {edge:e}), \
         channels: [(name: \"x\", responsivity: 1, reads: {reads})])"
    )
}

/// A source of 3 W/(m² sr) before a meter that faces +z.
fn before(shape: &str, sensor: &str) -> String {
    format!(
        r#"Scene(sources: [(name: "s", {shape}, strength: Radiance(3), spectrum: Line(555))],
            instruments: [(name: "m", sensor: {sensor}, at: (0, 0, 0), facing: (0, 0, 1))])"#
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn a_target_that_fills_the_field_reads_its_radiance(
        pupil_mm in 0.1..30.0f64, field_deg in 0.1..20.0f64, focus_m in 0.2..5.0f64, edge in 0.0..1.0f64, at in 0.1..10.0f64, tilt in -1.0..1.0f64
    ) {
        let target = format!("shape: Disc(100), at: (0, 0, {at:e}), facing: ({tilt:e}, 0, -1)");
        let found = measured(&before(&target, &spot(pupil_mm, field_deg, focus_m, edge, "Radiance")), &samples(1024), 3);
        let reading = &found.readings[0];
        prop_assert!(apart(reading.value, 3.0) < 1e-12, "{}", reading.value);
        prop_assert!(reading.standard_uncertainty() > 0.0);
        let sky = exact(&before("shape: Environment", &spot(pupil_mm, field_deg, focus_m, edge, "Radiance")));
        prop_assert!(apart(sky[0], 3.0) < 1e-12, "{}", sky[0]);
    }
}

/// A disc in the plane of focus, smaller than the field: its étendue over that of the field.
#[test]
fn discs_in_focus_read_their_share_of_the_etendue() {
    let (a, f, field_deg): (f64, f64, f64) = (0.02, 0.8, 3.0);
    let r0 = f * (0.5 * field_deg).to_radians().tan();
    for share in [0.05, 0.3, 0.9] {
        let disc = format!("shape: Disc({:e}), at: (0, 0, {f}), facing: (0, 0, -1)", share * r0);
        let found = uncertain(&before(&disc, &spot(1e3 * a, field_deg, f, 0.0, "Radiance")), &samples(1 << 14), 5)[0];
        assert_agree("disc in focus", found, Uncertain::exactly(3.0 * coaxial_discs(a, share * r0, f) / coaxial_discs(a, r0, f)));
    }
    // As flux, without a field to divide by.
    let disc = format!("shape: Disc({:e}), at: (0, 0, {f}), facing: (0, 0, -1)", 0.5 * r0);
    let flux = uncertain(&before(&disc, &spot(1e3 * a, field_deg, f, 0.0, "RadiantFlux")), &samples(1 << 14), 5)[0];
    assert_agree("flux of a disc in focus", flux, Uncertain::exactly(3.0 * coaxial_discs(a, 0.5 * r0, f)));
}

/// The rim of the field lies on the target, which is larger or smaller than the field: both ways of looking for it agree with a cone.
#[test]
fn a_small_pupil_sees_a_cone() {
    let (half_deg, f) = (2.0, 1.0);
    for (radius, shift) in [(0.03, 0.02), (0.5, 0.49), (0.036, 0.05)] {
        let disc = format!("shape: Disc({radius}), at: ({shift}, 0, {f}), facing: (0, 0, -1)");
        let cone = format!(
            "Sensor(aperture: Point, acceptance: Cone(half_angle_deg: {half_deg}), channels: [(name: \"x\", responsivity: 1, reads: Radiance)])"
        );
        let expected = exact(&before(&disc, &cone))[0];
        let found = uncertain(&before(&disc, &spot(1e-3, 2.0 * half_deg, f, 0.0, "Radiance")), &samples(1 << 14), 9)[0];
        assert_agree(&disc, found, Uncertain::exactly(expected));
    }
}

/// Reflected light, an obstacle and a lamp within the field: the plan against all rays.
#[test]
fn planned_and_naive_readings_of_a_spot_in_a_room_agree() {
    let text = format!(
        r#"Scene(
            surfaces: {{ "paint": Lambertian(0.5) }},
            objects: [
                (name: "walls", shape: Box(size: (2, 3, 2.5)), at: (-1, -1.5, 0), surface: "paint", seen_from: Inside),
                (name: "plate", shape: Disc(0.1), at: (0.05, 0.9, 1), facing: (0.1, -1, 0.2), surface: Black),
            ],
            sources: [
                (name: "panel", shape: Rectangle(0.5, 0.75), at: (0, 0.25, 2.25), facing: (0, 0, -1), strength: Radiance(1), spectrum: Line(555)),
                (name: "lit wall", shape: Rectangle(0.4, 0.4), at: (-0.2, 1.4, 1), facing: (0, -1, 0), strength: Radiance(0.2), spectrum: Line(555)),
                (name: "spark", shape: Sphere(0.01), at: (-0.1, 1, 1.05), strength: Radiance(5), spectrum: Line(555)),
            ],
            instruments: [(name: "m", sensor: {}, at: (0, -1, 1), facing: (0, 1, 0))],
        )"#,
        spot(15.0, 20.0, 1.5, 0.1, "Radiance")
    );
    let scene = scene_from_text(&text).unwrap_or_else(|problems| panic!("{problems}"));
    let read = |naive: bool, seed: u64| {
        let plan = Plan::new(&scene, &PlanOptions { naive, ..PlanOptions::default() }).unwrap();
        let found = measure(&scene, &plan, &samples(1 << 14), seed, &Watch { now: &|| 0.0, progress: &|_| {} }).unwrap();
        Uncertain { value: found.readings[0].value, u: found.readings[0].standard_uncertainty() }
    };
    assert_agree("spot in a room", read(true, 1), read(false, 2));
}

/// A point source that every point of the pupil sees within the field: mean irradiance I cos³/h² over the pupil, as the open disc has it.
#[test]
fn a_lamp_within_the_field_lights_the_whole_pupil() {
    let lamp = |sensor: &str| {
        format!(
            r#"Scene(sources: [(name: "s", shape: Point, at: (0.01, 0, 1.2), strength: WattsPerSteradian(3), spectrum: Line(555))],
                instruments: [(name: "m", sensor: {sensor}, at: (0, 0, 0), facing: (0, 0, 1))])"#
        )
    };
    let open = r#"Sensor(aperture: Disc(radius_mm: 20), acceptance: Cosine, channels: [(name: "x", responsivity: 1, reads: RadiantFlux)])"#;
    let expected = exact(&lamp(open))[0];
    assert!(apart(expected, 3.0 * PI * 0.02 * 0.02 / 1.44) < 1e-3);
    let found = uncertain(&lamp(&spot(20.0, 10.0, 1.0, 0.0, "RadiantFlux")), &samples(1 << 14), 5)[0];
    assert_agree("lamp within the field", found, Uncertain::exactly(expected));
}
