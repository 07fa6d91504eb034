//! Inverse square: the irradiance of a point falls with the square of its distance, that of a sphere with the square of the distance
//! of its centre, at every distance; that of a disc far away.

use std::f64::consts::PI;

use proptest::prelude::*;

use crate::bench::{EXACT, METER, apart, exact};

fn read(source: &str) -> f64 {
    exact(&format!(
        r#"Scene(sources: [(name: "s", {source}, spectrum: Line(555))], instruments: [(name: "m", sensor: {METER}, at: (0, 0, 0), facing: (0, 0, 1))])"#
    ))[0]
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(64) })]

    #[test]
    fn irradiance_falls_with_the_square_of_distance(exponent in -12.0..12.0_f64, intensity in 1e-6..1e6_f64) {
        let r = 10f64.powf(exponent);
        let e = read(&format!("shape: Point, at: (0, 0, {r:e}), strength: WattsPerSteradian({intensity:e})"));
        prop_assert!(apart(e * r * r, intensity) < EXACT);
    }

    #[test]
    fn a_sphere_acts_as_if_it_were_in_its_centre(gap in -6.0..6.0_f64, radius in 1e-3..1e3_f64) {
        let r = radius * (1.0 + 10f64.powf(gap));
        let e = read(&format!("shape: Sphere({radius:e}), at: (0, 0, {r:e}), strength: Radiance(3)"));
        prop_assert!(apart(e * (r / radius).powi(2), 3.0 * PI) < EXACT);
    }

    #[test]
    fn a_disc_far_away_acts_as_a_point(exponent in 5.0..12.0_f64) {
        let r = 10f64.powf(exponent);
        let e = read(&format!("shape: Disc(2), at: (0, 0, {r:e}), facing: (0, 0, -1), strength: Radiance(3)"));
        prop_assert!(apart(e * r * r, 3.0 * PI * 4.0) < EXACT);
    }
}
