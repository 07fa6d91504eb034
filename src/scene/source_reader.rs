//! Sources of a scene file: `(name, shape, strength, spectrum, surface?, seen_from?, at?, facing?, up?, turned_deg?, scale?)`
//!
//! | shape | placed by | emits |
//! |---|---|---|
//! | `Point` | `at` | in all directions |
//! | `Directional` | `facing`: where the light travels to | parallel light |
//! | `Environment` | | from wherever nothing stands |
//! | those of objects | as objects | from the side that `seen_from` says: `Outside` (default, front), `Inside`, `Both` |

use super::Element;
use super::decode::{Fields, Value};
use super::reading::Reading;
use super::shape_reader::{SHAPES, check_place, read_shape};
use super::spectrum_reader::{read_spectrum, v_lambda};
use super::strength::{Emission, check_strength, read_strength};
use super::surface_reader::{BLACK, Surfaces};
use crate::geometry::shape::Side;
use crate::source::{Emitter, Source};

const KEYS: [&str; 11] = ["name", "shape", "strength", "spectrum", "surface", "seen_from", "at", "facing", "up", "turned_deg", "scale"];
const POSE_KEYS: [&str; 5] = ["at", "facing", "up", "turned_deg", "scale"];

/// Reads a source. The elements of its shape are added to the scene's elements.
pub(super) fn read_source(
    value: &Value,
    name: Option<&str>,
    surfaces: &Surfaces,
    elements: &mut Vec<Element>,
    reading: &mut Reading,
) -> Option<Source> {
    let fields = value.fields("a source", &KEYS, &mut reading.problems)?;
    let spectrum = fields.require("spectrum", "\"A\"", &mut reading.problems).and_then(|v| read_spectrum(&v, reading));
    let strength = fields.require("strength", "Lumens(800)", &mut reading.problems);
    let shape = fields.require("shape", "Point", &mut reading.problems)?;
    let delta = ["Point", "Directional", "Environment"].contains(&shape.name());
    let density = |emission: Emission, reading: &mut Reading| {
        read_strength(strength.as_ref()?, emission, spectrum.as_ref(), &v_lambda(), &mut reading.problems)
    };
    if delta {
        let emission = match shape.name() {
            "Point" => Emission::Point,
            "Directional" => Emission::Directional,
            _ => Emission::Environment,
        };
        let emitter = read_delta(&shape, &fields, reading);
        let density = density(emission, reading);
        return Some(Source { name: name?.into(), emitter: emitter?, density: density? });
    }
    if !SHAPES.contains(&shape.name()) {
        let allowed: Vec<&str> = ["Point", "Directional", "Environment"].into_iter().chain(SHAPES).collect();
        shape.variant("the shape of a source", &allowed, &mut reading.problems);
        check_place(&fields, reading);
        if let Some(strength) = &strength {
            check_strength(strength, &mut reading.problems);
        }
        return None;
    }
    let shapes = read_shape(&shape, &fields, reading);
    let surface = match fields.get("surface") {
        Some(surface) => surfaces.find(&surface, reading),
        None => Some(BLACK),
    };
    let sides: Option<&[Side]> = match fields.get("seen_from") {
        None => Some(&[Side::Front]),
        Some(seen_from) => read_seen_from(&seen_from, reading),
    };
    let (shapes, sides) = (shapes?, sides?);
    let emission = Emission::Area { shapes: &shapes, sides: sides.len() as f64, inwards: sides == [Side::Back] };
    let density = density(emission, reading);
    let (name, surface, density) = (name?, surface?, density?);
    let mut emitting = Vec::new();
    for shape in shapes {
        emitting.extend(sides.iter().map(|&side| (elements.len(), side)));
        elements.push(Element { owner: name.into(), shape, front: surface, back: surface });
    }
    Some(Source { name: name.into(), emitter: Emitter::Area { elements: emitting }, density })
}

/// Reads the sides that `seen_from` names.
pub(super) fn read_seen_from(value: &Value, reading: &mut Reading) -> Option<&'static [Side]> {
    let name = value.variant("a side", &["Outside", "Inside", "Both"], &mut reading.problems)?;
    value.without_brackets(&mut reading.problems)?;
    Some(match name {
        "Outside" => &[Side::Front],
        "Inside" => &[Side::Back],
        _ => &[Side::Front, Side::Back],
    })
}

/// A source without an area.
fn read_delta(shape: &Value, fields: &Fields, reading: &mut Reading) -> Option<Emitter> {
    let problems = &mut reading.problems;
    let bare = shape.without_brackets(problems);
    let (kind, used): (&str, &str) = match shape.name() {
        "Point" => ("a point is placed by `at` alone and emits alike in all directions", "at"),
        "Directional" => ("directional light has a direction, `facing`, and no place", "facing"),
        _ => ("an environment is everywhere", ""),
    };
    let refused: Vec<&str> = POSE_KEYS.into_iter().filter(|&key| key != used).collect();
    fields.refuse(&refused, kind, problems);
    fields.refuse(&["surface", "seen_from"], "this source has no surface", problems);
    let emitter = match used {
        "at" => Emitter::Point { at: fields.require("at", "(0, 0, 2)", problems)?.point_m(problems)? },
        "facing" => Emitter::Directional { travels: fields.require("facing", "(0, 0, -1)", problems)?.direction(problems)? },
        _ => Emitter::Environment,
    };
    bare.map(|()| emitter)
}
