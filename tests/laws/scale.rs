//! Scale: with all lengths × k, radiances give the same irradiance and intensities a k²-th of it. Nothing knows how long a metre is.

use proptest::prelude::*;

use crate::bench::{EXACT, METER, apart, at, exact, measured, measured_by, room, samples};
use etendue::math::DVec3;
use etendue::plan::PlanOptions;

fn sources_without_obstacle(s: f64) -> String {
    let p = |x: f64, y: f64, z: f64| at(DVec3::new(x * s, y * s, z * s));
    format!(
        r#"Scene(sources: [
            (name: "rectangle", shape: Rectangle({:e}, {:e}), at: {}, facing: (0, 0.2, -1), strength: Radiance(3), spectrum: Line(555)),
            (name: "disc", shape: Disc({:e}), at: {}, facing: (1, 0, -1), strength: Radiance(2), spectrum: Line(555)),
            (name: "polygon", shape: Polygon([{}, {}, {}]), seen_from: Both, strength: Radiance(5), spectrum: Line(555)),
            (name: "ball", shape: Sphere({:e}), at: {}, strength: Radiance(4), spectrum: Line(555)),
        ], instruments: [
            (name: "point", sensor: {METER}, at: {}, facing: (0.1, 0.2, 1)),
            (name: "disc", at: {}, facing: (0, 0.2, 1), sensor: Sensor(aperture: Disc(radius_m: {:e}), acceptance: Cosine, channels: [(name: "E", responsivity: 1, reads: Irradiance)])),
        ])"#,
        0.7 * s,
        0.4 * s,
        p(1.5, -0.3, 2.0),
        0.3 * s,
        p(-1.0, 0.2, 1.5),
        p(0.0, 2.0, 0.5),
        p(0.0, 2.5, 1.5),
        p(0.4, 2.0, 1.0),
        0.2 * s,
        p(0.5, -2.0, 0.3),
        p(0.0, 0.0, 0.0),
        p(0.1, 0.1, 0.0),
        0.1 * s,
    )
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(24) })]

    #[test]
    fn formulas_do_not_depend_on_the_unit_of_length(exponent in -9.0..9.0_f64) {
        let (one, scaled) = (exact(&sources_without_obstacle(1.0)), exact(&sources_without_obstacle(10f64.powf(exponent))));
        for (one, scaled) in one.iter().zip(&scaled) {
            prop_assert!(*one > 0.1 && apart(*scaled, *one) < EXACT, "{one} {scaled}");
        }
    }

    #[test]
    fn samples_do_not_depend_on_the_unit_of_length(exponent in -9.0..9.0_f64, seed in 0..1000_u64) {
        let k = 10f64.powf(exponent);
        let read = |s: f64| measured(&room(s, 0.7, 5.0, s * s), &samples(1 << 9), seed).readings;
        for (one, scaled) in read(1.0).iter().zip(read(k)) {
            prop_assert!(one.samples > 0 && apart(scaled.value, one.value) < EXACT, "{} {}", one.value, scaled.value);
            prop_assert!(apart(scaled.standard_uncertainty(), one.standard_uncertainty()) < 1e-6);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(24) })]

    /// A wall is in the way however large it is: half-way between a meter and a lamp, 1 m from each.
    #[test]
    fn nothing_is_seen_through_a_wall_of_any_size(exponent in 0.5..12.0_f64, kind in 0..3_usize, lamp in 0..2_usize, naive in proptest::bool::ANY) {
        let r = 10f64.powf(exponent);
        let wall = [
            format!("shape: Disc({r:e}), at: (0, 0, 1), facing: (0, 0, -1)"),
            format!("shape: Rectangle({:e}, {:e}), at: (0, 0, 1), facing: (0, 0, -1)", 2.0 * r, 3.0 * r),
            format!("shape: Sphere({r:e}), at: (0, 0, {:e})", 1.0 + r),
        ];
        let lamp = [
            "shape: Point, at: (0, 0, 2), strength: WattsPerSteradian(1)",
            "shape: Disc(0.1), at: (0, 0, 2), facing: (0, 0, -1), strength: Radiance(30)",
        ][lamp];
        let text = format!(
            r#"Scene(surfaces: {{ "black": Black }}, objects: [(name: "wall", {}, surface: "black")],
                sources: [(name: "lamp", {lamp}, spectrum: Line(555))],
                instruments: [(name: "meter", sensor: {METER}, at: (0, 0, 0), facing: (0, 0, 1))])"#,
            wall[kind]
        );
        let found = measured_by(&text, &PlanOptions { naive, ..PlanOptions::default() }, &samples(1 << 9), 1);
        prop_assert_eq!(found.readings[0].value, 0.0, "{}", text);
    }
}

#[test]
fn irradiance_of_a_point_falls_with_the_square_of_the_scale() {
    let read = |s: f64| {
        exact(&format!(
            r#"Scene(sources: [(name: "lamp", shape: Point, at: {}, strength: WattsPerSteradian(7), spectrum: Line(555))],
            instruments: [(name: "m", sensor: {METER}, at: {}, facing: (0.3, 0, 1))])"#,
            at(DVec3::new(1.0, 2.0, 3.0) * s),
            at(DVec3::new(0.1, -0.2, 0.3) * s)
        ))[0]
    };
    for exponent in [-30, -9, -3, 3, 9, 30] {
        let k = 10f64.powi(exponent);
        assert!(apart(read(k) * k * k, read(1.0)) < EXACT);
    }
}
