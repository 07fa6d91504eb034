//! Energy balance: in a closed space the walls absorb what the sources emit.
//!
//! ```text
//! Σ_walls (1 − ρ_w) Φ_w = Φ        Φ_w: the flux through an aperture that covers the wall and faces inwards
//! ```

use std::f64::consts::PI;

use proptest::prelude::*;

use crate::bench::{EXACT, Uncertain, apart, assert_agree, exact, samples, uncertain};
use etendue::math::DVec3;

/// Centre, outward normal and the two edges (along the sensor's x and y) of each wall of a room with the corner at the origin.
fn walls(size: DVec3) -> Vec<(DVec3, DVec3, f64, f64)> {
    let half = 0.5 * size;
    let mut walls = Vec::new();
    for (axis, width, height) in [(DVec3::X, size.y, size.z), (DVec3::Y, size.x, size.z), (DVec3::Z, size.x, size.y)] {
        for sign in [-1.0, 1.0] {
            walls.push((half + axis * half * sign, axis * sign, width, height));
        }
    }
    walls
}

fn instruments(size: DVec3) -> String {
    let one = |(i, (centre, outwards, width, height)): (usize, (DVec3, DVec3, f64, f64))| {
        let (at, facing) = (crate::bench::at(centre), crate::bench::at(-outwards));
        format!(
            r#"(name: "wall {i}", at: {at}, facing: {facing}, sensor: Sensor(aperture: Rectangle(width_m: {width:e}, height_m: {height:e}), acceptance: Cosine,
                channels: [(name: "x", responsivity: 1, reads: RadiantFlux)])),"#
        )
    };
    walls(size).into_iter().enumerate().map(one).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(24) })]

    #[test]
    fn apertures_around_a_point_collect_all_of_its_light(
        size in prop::array::uniform3(0.2..5.0_f64), place in prop::array::uniform3(0.02..0.98_f64), watts in 1e-9..1e9_f64,
    ) {
        let size = DVec3::from_array(size);
        let at = crate::bench::at(size * DVec3::from_array(place));
        let text = format!(
            r#"Scene(sources: [(name: "lamp", shape: Point, at: {at}, strength: Watts({watts:e}), spectrum: Line(555))], instruments: [{}])"#,
            instruments(size)
        );
        prop_assert!(apart(exact(&text).iter().sum(), watts) < EXACT);
    }

    #[test]
    fn the_walls_opposite_a_bright_wall_collect_all_of_its_light(size in prop::array::uniform3(0.5..2.0_f64), l in 1e-3..1e3_f64) {
        let size = DVec3::from_array(size);
        // The wall z = 0 emits; its own aperture faces the same way and receives nothing.
        let text = format!(
            r#"Scene(sources: [(name: "floor", shape: Quad(corner: (0, 0, 0), u: ({:e}, 0, 0), v: (0, {:e}, 0)), strength: Radiance({l:e}), spectrum: Line(555))],
                instruments: [{}])"#,
            size.x, size.y, instruments(size)
        );
        prop_assert!(apart(exact(&text).iter().sum(), PI * l * size.x * size.y) < EXACT);
    }
}

#[test]
fn reflecting_walls_absorb_what_the_sources_emit() {
    let size = DVec3::new(2.0, 3.0, 2.5);
    let rho = [0.1, 0.8, 0.5, 0.7, 0.3, 0.9];
    let surfaces: String = rho.iter().enumerate().map(|(i, rho)| format!("\"paint {i}\": Lambertian({rho}), ")).collect();
    let objects: String = walls(size)
        .into_iter()
        .enumerate()
        .map(|(i, (centre, outwards, width, height))| {
            format!(
                "(name: \"wall {i}\", shape: Rectangle({width:e}, {height:e}), at: {}, facing: {}, surface: \"paint {i}\"),",
                crate::bench::at(centre),
                crate::bench::at(-outwards)
            )
        })
        .collect();
    // The panel is grey: it absorbs as well, on both of its sides, and has apertures close to them.
    let (panel_rho, gap) = (0.4, 1e-7);
    let side = |name: &str, z: f64, facing: f64| {
        format!(
            r#"(name: "{name}", at: (1, 1.5, {z:e}), facing: (0, 0, {facing}), sensor: Sensor(aperture: Rectangle(width_m: 0.5, height_m: 0.75), acceptance: Cosine,
                channels: [(name: "x", responsivity: 1, reads: RadiantFlux)])),"#
        )
    };
    let text = format!(
        r#"Scene(surfaces: {{ {surfaces} "panel": Lambertian({panel_rho}) }}, objects: [{objects}],
            sources: [
                (name: "panel", shape: Rectangle(0.5, 0.75), at: (1, 1.5, 2), facing: (0, 0, -1), surface: "panel", strength: Watts(3), spectrum: Line(555)),
                (name: "lamp", shape: Point, at: (0.5, 2.5, 0.5), strength: Watts(2), spectrum: Line(555)),
            ],
            instruments: [{} {} {}])"#,
        instruments(size),
        side("above the panel", 2.0 + gap, 1.0),
        side("below the panel", 2.0 - gap, -1.0),
    );
    let found = uncertain(&text, &samples(1 << 17), 3);
    let share = rho.iter().copied().chain([panel_rho; 2]);
    let absorbed: Vec<Uncertain> = found.iter().zip(share).map(|(flux, rho)| flux.times(1.0 - rho)).collect();
    assert_agree("energy balance", Uncertain::sum(&absorbed), Uncertain::exactly(5.0));
}
