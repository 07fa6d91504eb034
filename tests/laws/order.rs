//! Order: a reading does not depend on the order in which the scene lists its sources and objects.

use proptest::prelude::*;

use crate::bench::{EXACT, METER, apart, assert_agree, exact, samples, uncertain};

const SOURCES: [&str; 5] = [
    r#"(name: "panel", shape: Rectangle(0.5, 1), at: (0.2, 0.3, 1.9), facing: (0, 0, -1), strength: Radiance(5), spectrum: "A")"#,
    r#"(name: "lamp", shape: Point, at: (-0.4, 0.1, 1.5), strength: Watts(20), spectrum: Line(555))"#,
    r#"(name: "ball", shape: Sphere(0.1), at: (0.7, -0.5, 1.7), strength: Watts(4), spectrum: BlackBody(3000))"#,
    r#"(name: "disc", shape: Disc(0.2), at: (-0.6, 0.6, 1.85), facing: (0, -0.1, -1), strength: Radiance(7), spectrum: Line(450))"#,
    r#"(name: "kite", shape: Polygon([(-0.5, -0.7, 1.95), (-0.3, -0.4, 1.95), (-0.5, -0.3, 1.95), (-0.7, -0.4, 1.95)]), seen_from: Inside, strength: Radiance(7), spectrum: Line(450))"#,
];

const OBJECTS: [&str; 3] = [
    r#"(name: "walls", shape: Box(size: (2, 2, 2)), at: (-1, -1, 0), surface: "paint", seen_from: Inside)"#,
    r#"(name: "plate", shape: Disc(0.3), at: (0, 0.1, 0.8), surface: "paint")"#,
    r#"(name: "post", shape: Box(size: (0.1, 0.1, 0.9)), at: (0.5, 0.2, 0), surface: "paint", seen_from: Outside)"#,
];

fn scene(sources: &[&str], objects: &[&str]) -> String {
    format!(
        r#"Scene(surfaces: {{ "paint": Lambertian(0.6) }}, objects: [{}], sources: [{}],
            instruments: [(name: "m", sensor: {METER}, at: (0.1, -0.1, 0.2), facing: (0.1, 0, 1))])"#,
        objects.join(", "),
        sources.join(", ")
    )
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(16) })]

    #[test]
    fn formulas_do_not_depend_on_the_order_of_the_sources(order in Just(SOURCES.to_vec()).prop_shuffle()) {
        // The lamp hangs free: without objects only sources that are beside its way are left.
        prop_assert!(apart(exact(&scene(&order, &[]))[0], exact(&scene(&SOURCES, &[]))[0]) < EXACT);
    }
}

#[test]
fn samples_do_not_depend_on_the_order_of_sources_and_objects() {
    let (mut sources, mut objects) = (SOURCES, OBJECTS);
    let first = uncertain(&scene(&sources, &objects), &samples(1 << 15), 1)[0];
    for seed in 2..4 {
        sources.rotate_left(2);
        objects.rotate_left(1);
        sources.swap(0, 1);
        assert_agree("order", uncertain(&scene(&sources, &objects), &samples(1 << 15), seed)[0], first);
    }
}
