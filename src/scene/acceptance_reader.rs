//! Acceptances of a sensor file: from which directions light counts.
//!
//! | how it is written | what it is |
//! |---|---|
//! | `Cosine` | an ideal plane receptor |
//! | `Cone(half_angle_deg: 0.5)` | the same within a cone |
//! | `NumericalAperture(0.22)` | a fibre in air: a cone of half-angle asin(NA) |
//! | `Directional("directional.csv")` | a table (`directional_table.rs`) |
//! | `Spot(field_deg: 1, focus_m: 1, edge: 0.05)` | a luminance meter: what its pupil, a disc, sees through a spot in the plane of focus; `edge` may be left out |
//! | `Spherical`, `Hemispherical`, `Cylindrical`, `Semicylindrical` | a small head that sees all round; the aperture is a point |
//!
//! What a head reads has words of its own: `reads: Illuminance` with `Cylindrical` is the cylindrical illuminance E_v,z.

use super::channel_reader::weighted;
use super::decode::Value;
use super::directional_table::read_directional;
use super::document::Kind;
use super::reading::Reading;
use crate::quantity::measurand::Measurand;
use crate::sensor::{Acceptance, Aperture, Head, Spot};

const ACCEPTANCES: [&str; 9] =
    ["Cosine", "Cone", "NumericalAperture", "Directional", "Spot", "Spherical", "Hemispherical", "Cylindrical", "Semicylindrical"];

/// Reads an acceptance. `aperture` is that of its sensor, if it could be read.
pub(super) fn read_acceptance(value: &Value, aperture: Option<Aperture>, reading: &mut Reading) -> Option<Acceptance> {
    let name = value.variant("an acceptance", &ACCEPTANCES, &mut reading.problems)?;
    let plain = match name {
        "Cone" => return read_cone(value, reading),
        "Spot" => return read_spot(value, aperture, reading),
        "NumericalAperture" => return read_numerical_aperture(value, reading),
        "Directional" => {
            let name = value.positional(1, "Directional(\"directional.csv\")", &mut reading.problems)?.into_iter().next()?;
            return read_directional(&name, reading).map(Acceptance::Directional);
        }
        "Spherical" => Acceptance::Spherical,
        "Hemispherical" => Acceptance::Hemispherical,
        "Cylindrical" => Acceptance::Cylindrical,
        "Semicylindrical" => Acceptance::Semicylindrical,
        _ => Acceptance::Cosine,
    };
    value.without_brackets(&mut reading.problems).map(|()| plain)
}

fn read_cone(value: &Value, reading: &mut Reading) -> Option<Acceptance> {
    let problems = &mut reading.problems;
    let angle = value.fields("`Cone`", &["half_angle_deg"], problems)?.require("half_angle_deg", "0.5", problems)?;
    let half_angle_deg = angle.number(problems)?;
    if half_angle_deg == 0.0 {
        angle.problem(problems, "an acceptance of zero collects nothing", "give a half-angle above 0°, such as `half_angle_deg: 0.5`");
        return None;
    }
    if !(half_angle_deg > 0.0 && half_angle_deg <= 90.0) {
        angle.problem(problems, format!("the half-angle is {half_angle_deg}°"), "allowed: above 0° to 90°");
        return None;
    }
    Some(Acceptance::Cone { half_angle_rad: half_angle_deg.to_radians() })
}

fn read_numerical_aperture(value: &Value, reading: &mut Reading) -> Option<Acceptance> {
    let given = value.positional(1, "NumericalAperture(0.22)", &mut reading.problems)?.into_iter().next()?;
    let na = given.number(&mut reading.problems)?;
    if !(na > 0.0 && na <= 1.0) {
        let help = "allowed: above 0 to 1, the sine of the half-angle in air; a common fibre has 0.22";
        given.problem(&mut reading.problems, format!("the numerical aperture is {na}"), help);
        return None;
    }
    Some(Acceptance::Cone { half_angle_rad: na.asin() })
}

fn read_spot(value: &Value, aperture: Option<Aperture>, reading: &mut Reading) -> Option<Acceptance> {
    let problems = &mut reading.problems;
    let fields = value.fields("`Spot`", &["field_deg", "focus_m", "edge"], problems)?;
    let field = fields.require("field_deg", "1", problems);
    let field_deg =
        field.and_then(|v| v.number_in("the measured field", "above 0° to 90°, the whole angle", |x| x > 0.0 && x <= 90.0, problems));
    let focus_m = fields.require("focus_m", "1", problems).and_then(|v| match v.node.kind {
        Kind::Number(f64::INFINITY) => {
            let help = "for a meter that is set to infinity write a distance far beyond everything in the scene, such as `focus_m: 1e6`";
            v.problem(problems, "the plane of focus of a spot lies at a finite distance", help);
            None
        }
        _ => v.length_m("`focus_m`", 1.0, problems),
    });
    let edge = match fields.get("edge") {
        Some(edge) => edge.number_in("the edge", "0 to 1, a share of the field's radius", |x| (0.0..=1.0).contains(&x), problems),
        None => Some(0.0),
    };
    let pupil_radius_m = match aperture {
        Some(Aperture::Disc { radius_m }) => Some(radius_m),
        Some(_) => {
            value.problem_at(
                &value.name_span(),
                problems,
                "a spot is seen through a round entrance pupil",
                "give the sensor `aperture: Disc(radius_mm: 10)`, the pupil of the meter",
            );
            None
        }
        None => None,
    };
    let spot = Spot { half_angle_rad: 0.5 * field_deg?.to_radians(), focus_m: focus_m?, edge: edge?, pupil_radius_m: pupil_radius_m? };
    Some(Acceptance::Spot(spot))
}

/// Name and symbol of what a channel reads at a head: "cylindrical illuminance", E_v,z. A signal stays a signal.
pub(super) fn words_of_head(reads: &Measurand, head: Option<Head>) -> Measurand {
    let (Some(head), false) = (head, matches!(reads, Measurand::Signal { .. })) else { return reads.clone() };
    let (stem, power) = reads.symbol().split_once('^').map_or((reads.symbol(), String::new()), |(a, b)| (a, format!("^{b}")));
    let joint = if stem.contains('_') { ',' } else { '_' };
    weighted(&format!("{} {}", head.name(), reads.name()), &format!("{stem}{joint}{}{power}", head.index()), reads.unit())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_head_has_words_of_its_own() {
        let cylinder = words_of_head(&Measurand::Illuminance, Some(Head::Cylindrical));
        assert_eq!([cylinder.name(), cylinder.symbol(), cylinder.unit()], ["cylindrical illuminance", "E_v,z", "lx"]);
        let daylight = weighted("melanopic equivalent daylight (D65) illuminance", "E_v,mel^D65", "lx");
        assert_eq!(words_of_head(&daylight, Some(Head::Spherical)).symbol(), "E_v,mel,o^D65");
        assert_eq!(words_of_head(&Measurand::Illuminance, None), Measurand::Illuminance);
        let signal = Measurand::Signal { unit: "V".into() };
        assert_eq!(words_of_head(&signal, Some(Head::Spherical)), signal);
    }
}
