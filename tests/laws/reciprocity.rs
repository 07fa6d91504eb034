//! Reciprocity: the etendue of two surfaces is the same from both, so that each sends the other the same flux at the same radiance.

use proptest::prelude::*;

use crate::bench::{EXACT, apart, assert_agree, at, exact, samples, uncertain};
use etendue::math::DVec3;

/// A flat surface: as a source, or as an aperture. Both have the width along the local x axis that `up` makes.
#[derive(Clone, Copy, Debug)]
enum Flat {
    Disc(f64),
    Rectangle(f64, f64),
}

#[derive(Clone, Copy, Debug)]
struct Placed {
    flat: Flat,
    at: DVec3,
    facing: DVec3,
}

impl Placed {
    fn source(&self) -> String {
        let shape = match self.flat {
            Flat::Disc(radius) => format!("Disc({radius:e})"),
            Flat::Rectangle(width, height) => format!("Rectangle({width:e}, {height:e})"),
        };
        format!(
            r#"(name: "source", shape: {shape}, at: {}, facing: {}, up: (0, 1, 0), strength: Radiance(1), spectrum: Line(555))"#,
            at(self.at),
            at(self.facing)
        )
    }

    fn instrument(&self) -> String {
        let aperture = match self.flat {
            Flat::Disc(radius) => format!("Disc(radius_m: {radius:e})"),
            Flat::Rectangle(width, height) => format!("Rectangle(width_m: {width:e}, height_m: {height:e})"),
        };
        format!(
            r#"(name: "m", at: {}, facing: {}, up: (0, 1, 0), sensor: Sensor(aperture: {aperture}, acceptance: Cosine, channels: [(name: "x", responsivity: 1, reads: RadiantFlux)]))"#,
            at(self.at),
            at(self.facing)
        )
    }
}

fn flux(from: &Placed, to: &Placed, objects: &str) -> String {
    format!("Scene(objects: [{objects}], sources: [{}], instruments: [{}])", from.source(), to.instrument())
}

/// Two surfaces that see each other fully.
fn pair() -> impl Strategy<Value = (Placed, Placed)> {
    let flat = || prop_oneof![(0.05..0.5_f64).prop_map(Flat::Disc), (0.1..0.8_f64, 0.1..0.8_f64).prop_map(|(w, h)| Flat::Rectangle(w, h))];
    let tilt = || (-0.3..0.3_f64, -0.3..0.3_f64);
    (flat(), flat(), tilt(), tilt(), prop::array::uniform3(-0.5..0.5_f64)).prop_map(|(one, two, (a, b), (c, d), offset)| {
        let one = Placed { flat: one, at: DVec3::new(0.3, -0.7, 0.1), facing: DVec3::new(a, b, 1.0) };
        let two = Placed { flat: two, at: one.at + DVec3::new(0.0, 0.0, 1.5) + DVec3::from_array(offset), facing: DVec3::new(c, d, -1.0) };
        (one, two)
    })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(32) })]

    #[test]
    fn two_surfaces_send_each_other_the_same_flux((one, two) in pair()) {
        let (there, back) = (exact(&flux(&one, &two, ""))[0], exact(&flux(&two, &one, ""))[0]);
        prop_assert!(there > 0.0 && apart(there, back) < EXACT, "{there} {back}");
    }
}

#[test]
fn what_hides_one_surface_from_the_other_hides_the_other_from_the_one() {
    let one = Placed { flat: Flat::Disc(0.4), at: DVec3::ZERO, facing: DVec3::new(0.1, 0.0, 1.0) };
    let two = Placed { flat: Flat::Rectangle(0.7, 0.4), at: DVec3::new(0.2, 0.1, 1.5), facing: DVec3::new(0.0, 0.2, -1.0) };
    let plate = r#"(name: "plate", shape: Disc(0.2), at: (0.2, 0.1, 0.6), facing: (0.2, 0.1, 1), surface: Black)"#;
    let clear = exact(&flux(&one, &two, ""))[0];
    let (there, back) =
        (uncertain(&flux(&one, &two, plate), &samples(1 << 15), 1)[0], uncertain(&flux(&two, &one, plate), &samples(1 << 15), 2)[0]);
    assert!(there.value < 0.8 * clear && there.value > 0.2 * clear);
    assert_agree("reciprocity", there, back);
}
