//! Cosine law: an element turned away by θ receives cos θ of what it received, as long as all of the source is above its horizon;
//! and a Lambertian source turned away by θ sends cos θ of what it sent to a far receiver.

use proptest::prelude::*;

use crate::bench::{EXACT, METER, apart, at, exact};
use etendue::math::DVec3;

fn read(source: &str, facing: DVec3) -> f64 {
    let facing = at(facing);
    exact(&format!(
        r#"Scene(sources: [(name: "s", {source}, spectrum: Line(555))], instruments: [(name: "m", sensor: {METER}, at: (0, 0, 0), facing: {facing})])"#
    ))[0]
}

fn turned(theta: f64, phi: f64) -> DVec3 {
    DVec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos())
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(64) })]

    #[test]
    fn irradiance_falls_with_the_cosine_of_incidence(theta in 0.0..1.35_f64, phi in 0.0..6.3_f64) {
        let sources = [
            "shape: Point, at: (0, 0, 3), strength: WattsPerSteradian(5)",
            "shape: Directional, facing: (0, 0, -1), strength: WattsPerSquareMetre(5)",
            // The sphere spans 0.2 rad, so that it is above the horizon at every angle that is tried.
            "shape: Sphere(0.2), at: (0, 0, 1), strength: Radiance(5)",
        ];
        for source in sources {
            let (full, less) = (read(source, DVec3::Z), read(source, turned(theta, phi)));
            prop_assert!(apart(less, full * theta.cos()) < EXACT, "{source}: {less}");
        }
    }

    #[test]
    fn a_flat_source_turned_away_sends_less_by_the_cosine(theta in 0.0..1.5_f64, phi in 0.0..6.3_f64) {
        for shape in ["Disc(1)", "Rectangle(1, 0.5)"] {
            let source = |facing: DVec3| format!("shape: {shape}, at: (0, 0, 1e6), facing: {}, strength: Radiance(5e9)", at(-facing));
            let (full, less) = (read(&source(DVec3::Z), DVec3::Z), read(&source(turned(theta, phi)), DVec3::Z));
            prop_assert!(apart(less, full * theta.cos()) < EXACT, "{shape}: {less} {full}");
        }
    }

    #[test]
    fn an_element_turned_away_by_more_than_a_right_angle_receives_nothing(theta in 1.58..3.1_f64, phi in 0.0..6.3_f64) {
        for source in ["shape: Point, at: (0, 0, 3), strength: Watts(5)", "shape: Directional, facing: (0, 0, -1), strength: WattsPerSquareMetre(5)"] {
            prop_assert_eq!(read(source, turned(theta, phi)), 0.0);
        }
    }
}
