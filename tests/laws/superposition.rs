//! Superposition: the reading of several sources is the sum of the readings of each, the others being dark but in place.

use proptest::prelude::*;

use crate::bench::{EXACT, METER, Uncertain, apart, assert_agree, exact, room, samples, uncertain};

fn four_sources(strengths: [f64; 4], place: [f64; 3]) -> String {
    let [x, y, z] = place;
    let [point, disc, ball, beam] = strengths;
    format!(
        r#"Scene(sources: [
            (name: "point", shape: Point, at: ({x:e}, {y:e}, {z:e}), strength: WattsPerSteradian({point:e}), spectrum: Line(500)),
            (name: "disc", shape: Disc(0.4), at: (-2, 1, 3), facing: (1, 0.1, -1), strength: Radiance({disc:e}), spectrum: "A"),
            (name: "ball", shape: Sphere(0.2), at: (3, 0.1, 0.05), strength: Watts({ball:e}), spectrum: BlackBody(3000)),
            (name: "beam", shape: Directional, facing: (0.2, -0.3, -1), strength: WattsPerSquareMetre({beam:e}), spectrum: Line(700)),
        ], instruments: [(name: "m", sensor: {METER}, at: (0, 0, 0), facing: (0.2, 0.1, 1))])"#
    )
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(24) })]

    #[test]
    fn readings_of_sources_add_up(strengths in prop::array::uniform4(1e-3..1e3_f64), x in -1.0..1.0_f64, y in -1.0..1.0_f64, z in 6.0..9.0_f64) {
        // The point is above all others, so that none of them stands in its way.
        let read = |s: [f64; 4]| exact(&four_sources(s, [x, y, z]))[0];
        let together = read(strengths);
        let alone: f64 = (0..4).map(|i| read(std::array::from_fn(|j| if i == j { strengths[j] } else { 0.0 }))).sum();
        prop_assert!(apart(together, alone) < EXACT, "{together} {alone}");
    }
}

#[test]
fn reflections_of_sources_add_up() {
    let read = |panel: f64, lamp: f64, seed: u64| uncertain(&room(1.0, 0.7, panel, lamp), &samples(1 << 15), seed);
    let (both, panel, lamp) = (read(5.0, 1.0, 1), read(5.0, 0.0, 2), read(0.0, 1.0, 3));
    for i in 0..both.len() {
        assert_agree("superposition", both[i], Uncertain::sum(&[panel[i], lamp[i]]));
    }
}
