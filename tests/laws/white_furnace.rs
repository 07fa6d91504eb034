//! White furnace: in a closed space whose walls emit L and reflect ρ, the radiance is `L/(1 − ρ)` everywhere and in every direction,
//! and the irradiance `π L/(1 − ρ)` on every element, whatever the shape of the space.

use std::f64::consts::PI;

use crate::bench::{METER, Uncertain, assert_agree, target, uncertain};

const RADIANCE_METER: &str =
    r#"Sensor(aperture: Point, acceptance: Cone(half_angle_deg: 5), channels: [(name: "L", responsivity: 1, reads: Radiance)])"#;

fn furnace(shape: &str, rho: f64) -> String {
    format!(
        r#"Scene(
            surfaces: {{ "wall": Lambertian({rho}) }},
            sources: [(name: "walls", shape: {shape}, seen_from: Inside, surface: "wall", strength: Radiance(2), spectrum: Line(555))],
            instruments: [
                (name: "in the middle", sensor: {METER}, at: (0.1, -0.2, 0.05), facing: (1, 2, -0.5)),
                (name: "near the wall", sensor: {METER}, at: (0.1, 0.05, -0.9), facing: (0, 0.1, -1)),
                (name: "radiance", sensor: {RADIANCE_METER}, at: (0.3, 0.1, 0.2), facing: (-1, 1, 1)),
            ],
        )"#
    )
}

fn check(shape: &str, rho: f64, share: f64) {
    let found = uncertain(&furnace(shape, rho), &target(share), 7);
    let l = 2.0 / (1.0 - rho);
    for (reading, expected) in found.into_iter().zip([PI * l, PI * l, l]) {
        assert_agree(&format!("furnace {shape} with ρ = {rho}"), reading, Uncertain::exactly(expected));
    }
}

#[test]
fn a_box_that_emits_and_reflects_is_uniformly_bright() {
    for rho in [0.1, 0.5, 0.8, 0.95] {
        check("Box(size: (2, 3, 2)), at: (-1, -1.5, -1)", rho, 0.01);
    }
}

#[test]
fn a_sphere_that_emits_and_reflects_is_uniformly_bright() {
    for rho in [0.1, 0.5, 0.8, 0.95] {
        check("Sphere(1), at: (0, 0, 0)", rho, 0.01);
    }
}

/// Points of the wall that were found by rays are beside it by the rounding of coordinates, which is large here.
#[test]
fn a_bright_sphere_far_from_the_origin_is_uniformly_bright() {
    let text = furnace("Sphere(1), at: (1e7, -1e7, 1e7)", 0.5).replace("at: (0.1, -0.2, 0.05)", "at: (1e7, -1e7, 9999999.5)");
    let text = text.replace("at: (0.1, 0.05, -0.9)", "at: (10000000.5, -1e7, 1e7)").replace("at: (0.3, 0.1, 0.2)", "at: (1e7, -1e7, 1e7)");
    for (reading, expected) in uncertain(&text, &target(0.01), 7).into_iter().zip([4.0 * PI, 4.0 * PI, 4.0]) {
        assert_agree("furnace far away", reading, Uncertain::exactly(expected));
    }
}

#[test]
fn a_furnace_that_hardly_absorbs_is_still_uniformly_bright() {
    check("Box(size: (2, 3, 2)), at: (-1, -1.5, -1)", 0.99, 0.04);
}
