//! Rotation and translation: a reading does not depend on where the whole scene is and how it is turned.

use proptest::prelude::*;

use crate::bench::{EXACT, METER, apart, assert_agree, at, exact, measured, samples, uncertain};
use etendue::math::{DMat3, DVec3};

/// A rectangle with an opaque disc and a polygon before it, a ball and a lamp, moved as a whole. Without `plates` nothing hides anything.
fn moved(turn: DMat3, shift: DVec3, plates: bool) -> String {
    let p = |x: f64, y: f64, z: f64| at(turn * DVec3::new(x, y, z) + shift);
    let v = |x: f64, y: f64, z: f64| at(turn * DVec3::new(x, y, z));
    let objects = format!(
        r#"(name: "disc", shape: Disc(0.25), at: {}, facing: {}, surface: "paint"),
           (name: "triangle", shape: Polygon([{}, {}, {}]), surface: "paint"),"#,
        p(1.25, -0.25, 1.0),
        v(0.0, 0.25, 1.0),
        p(-0.5, 0.25, 0.75),
        p(-0.5, -0.25, 0.75),
        p(-1.0, 0.0, 0.75),
    );
    format!(
        r#"Scene(surfaces: {{ "paint": Lambertian(0.5) }}, objects: [{}],
        sources: [
            (name: "rectangle", shape: Rectangle(0.75, 0.5), at: {}, facing: {}, up: {}, strength: Radiance(3), spectrum: Line(555)),
            (name: "ball", shape: Sphere(0.25), at: {}, strength: Radiance(4), spectrum: Line(555)),
            (name: "lamp", shape: Point, at: {}, strength: WattsPerSteradian(2), spectrum: Line(555)),
        ], instruments: [
            (name: "point", sensor: {METER}, at: {}, facing: {}),
            (name: "rectangle", at: {}, facing: {}, up: {}, sensor: Sensor(aperture: Rectangle(width_m: 0.5, height_m: 0.25), acceptance: Cosine, channels: [(name: "E", responsivity: 1, reads: Irradiance)])),
        ])"#,
        if plates { objects.as_str() } else { "" },
        p(1.5, -0.25, 2.0),
        v(0.0, 0.0, -1.0),
        v(0.0, 1.0, 0.0),
        p(-1.0, 0.5, 1.5),
        p(0.25, 0.75, 3.0),
        p(0.0, 0.0, 0.0),
        v(0.0, 0.0, 1.0),
        p(0.25, 0.125, 0.0),
        v(0.0, 0.0, 1.0),
        v(0.0, 1.0, 0.0),
    )
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(16) })]

    #[test]
    fn readings_do_not_depend_on_how_the_scene_is_turned(axis in prop::array::uniform3(-1.0..1.0_f64), angle in 0.0..6.3_f64) {
        prop_assume!(DVec3::from_array(axis).length() > 0.1);
        let turn = DMat3::from_axis_angle(DVec3::from_array(axis).normalize(), angle);
        let (still, turned) = (exact(&moved(DMat3::IDENTITY, DVec3::ZERO, false)), exact(&moved(turn, DVec3::ZERO, false)));
        for (still, turned) in still.iter().zip(&turned) {
            prop_assert!(apart(*turned, *still) < EXACT, "{still} {turned}");
        }
    }

    /// Coordinates that stay exact lose nothing; others are rounded to 1e-9 m at 1e7 m.
    #[test]
    fn readings_do_not_depend_on_where_the_scene_is(whole in prop::array::uniform3(-10_000_000..10_000_000_i32), rest in prop::array::uniform3(0.0..1.0_f64)) {
        let still = exact(&moved(DMat3::IDENTITY, DVec3::ZERO, false));
        let whole = DVec3::from_array(whole.map(f64::from));
        let far = exact(&moved(DMat3::IDENTITY, whole, false));
        let rounded = exact(&moved(DMat3::IDENTITY, whole + DVec3::from_array(rest), false));
        for ((still, far), rounded) in still.iter().zip(&far).zip(&rounded) {
            prop_assert!(apart(*far, *still) < EXACT, "{still} {far}");
            prop_assert!(apart(*rounded, *still) < 1e-7, "{still} {rounded}");
        }
    }
}

#[test]
fn shadows_and_reflections_do_not_depend_on_how_the_scene_is_turned() {
    let turn = DMat3::from_axis_angle(DVec3::new(1.0, -2.0, 0.5).normalize(), 2.0);
    let still = uncertain(&moved(DMat3::IDENTITY, DVec3::ZERO, true), &samples(1 << 15), 1);
    let turned = uncertain(&moved(turn, DVec3::ZERO, true), &samples(1 << 15), 2);
    for (still, turned) in still.into_iter().zip(turned) {
        assert_agree("rotation", turned, still);
    }
}

#[test]
fn shadows_and_reflections_do_not_depend_on_where_the_scene_is() {
    let read = |shift: DVec3| measured(&moved(DMat3::IDENTITY, shift, true), &samples(1 << 12), 1).readings;
    let still = read(DVec3::ZERO);
    for shift in [DVec3::new(1e7, -1e7, 1e7), DVec3::new(-3.0, 1e7, 0.0)] {
        for (still, far) in still.iter().zip(read(shift)) {
            // The same samples: what differs is the rounding of coordinates at 1e7 m, 2e-9 m.
            assert!(still.samples > 0 && apart(far.value, still.value) < 1e-6, "{} {}", still.value, far.value);
        }
    }
}
