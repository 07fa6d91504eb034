//! Objects of a scene file: `(name, shape, surface, seen_from?, at?, facing?, up?, turned_deg?, scale?)`

use super::Element;
use super::decode::Value;
use super::reading::Reading;
use super::shape_reader::read_shape;
use super::source_reader::read_seen_from;
use super::surface_reader::{BLACK, Surfaces};
use crate::geometry::shape::Side;

const KEYS: [&str; 9] = ["name", "shape", "surface", "seen_from", "at", "facing", "up", "turned_deg", "scale"];

/// Reads an object and gives its elements. The side that `seen_from` names carries the surface, the other one is black.
pub(super) fn read_object(value: &Value, name: Option<&str>, surfaces: &Surfaces, reading: &mut Reading) -> Option<Vec<Element>> {
    let fields = value.fields("an object", &KEYS, &mut reading.problems)?;
    let surface = fields.require("surface", "\"white paint\"", &mut reading.problems).and_then(|v| surfaces.find(&v, reading));
    let sides: Option<&[Side]> = match fields.get("seen_from") {
        None => Some(&[Side::Front, Side::Back]),
        Some(seen_from) => read_seen_from(&seen_from, reading),
    };
    let shapes = fields.require("shape", "Sphere(0.5)", &mut reading.problems).and_then(|v| {
        if ["Point", "Directional", "Environment"].contains(&v.name()) {
            v.problem(
                &mut reading.problems,
                format!("`{}` is a source, not something to stand in a scene", v.name()),
                "move it to `sources: [ … ]`",
            );
            return None;
        }
        read_shape(&v, &fields, reading)
    });
    let (name, surface, sides, shapes) = (name?, surface?, sides?, shapes?);
    let on = |side: Side| if sides.contains(&side) { surface } else { BLACK };
    Some(shapes.into_iter().map(|shape| Element { owner: name.into(), shape, front: on(Side::Front), back: on(Side::Back) }).collect())
}
