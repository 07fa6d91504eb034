//! Shapes of a scene file → shapes in the world.
//!
//! | in the file | what it is | placed by |
//! |---|---|---|
//! | `Rectangle(width, height)` | centred at `at`; width along local x, height along local y, m | `at`, `facing`, `up` or `turned_deg` |
//! | `Quad(corner: …, u: …, v: …)` | a rectangle by one corner and two edges; its front is the side of u × v | itself |
//! | `Polygon([(x, y, z), …])` | a plane polygon by its corners; its front is the side from which they run counter-clockwise | itself |
//! | `Disc(radius)` | centred at `at` | `at`, `facing`, `up` or `turned_deg` |
//! | `Annulus(inner, outer)` | a plate with a round hole, centred at `at`; radii | `at`, `facing`, `up` or `turned_deg` |
//! | `Sphere(radius)` | centred at `at` | `at` |
//! | `Box(size: (x, y, z))` | its lowest corner at `at`; six rectangles that face outwards | `at`, `turned_deg` |
//! | `Mesh("file.obj")` | triangles; points × `scale`, turned, moved to `at` | `at`, `turned_deg`, `scale` |

use super::decode::{Fields, LARGEST_M, SMALLEST_M, Value, normalised};
use super::mesh_reader::read_mesh;
use super::placement::{Placement, read_at, read_flat, read_turned};
use super::reading::Reading;
use crate::geometry::polygon::{MOST_CORNERS, Polygon, PolygonError};
use crate::geometry::shape::{Disc, Rectangle, Shape, Sphere};
use crate::math::DVec3;

/// The shapes that an object can have; sources have more.
pub(super) const SHAPES: [&str; 8] = ["Rectangle", "Quad", "Polygon", "Disc", "Annulus", "Sphere", "Box", "Mesh"];

/// How far from perpendicular the edges of a quad may be: the cosine of the angle between them.
const PERPENDICULAR: f64 = 1e-9;

/// Notes what is wrong with the place of something whose shape is not known.
pub(super) fn check_place(fields: &Fields, reading: &mut Reading) {
    for key in ["at", "facing", "up", "turned_deg"] {
        if let Some(value) = fields.get(key) {
            let _ = value.vector(&mut reading.problems);
        }
    }
}

/// Reads one of [`SHAPES`], with the keys of the object or source that say where it is.
pub(super) fn read_shape(shape: &Value, fields: &Fields, reading: &mut Reading) -> Option<Vec<Shape>> {
    let refuse = |keys: &[&str], why: &str, reading: &mut Reading| fields.refuse(keys, why, &mut reading.problems);
    match shape.name() {
        "Rectangle" => {
            refuse(&["scale"], "only a mesh is scaled", reading);
            let place = read_flat(fields, &mut reading.problems);
            let sides = shape.positional(2, "Rectangle(width, height)", &mut reading.problems)?;
            let width = sides[0].length_m("the width", 1.0, &mut reading.problems);
            let height = sides[1].length_m("the height", 1.0, &mut reading.problems);
            let (place, width, height) = (place?, width?, height?);
            Some(vec![Shape::Rectangle(Rectangle { centre: place.at, half_u: place.x * (0.5 * width), half_v: place.y * (0.5 * height) })])
        }
        "Quad" => {
            refuse(&["at", "facing", "up", "turned_deg", "scale"], "a `Quad` is placed by its corner and edges", reading);
            read_quad(shape, reading)
        }
        "Polygon" => {
            refuse(&["at", "facing", "up", "turned_deg", "scale"], "a `Polygon` is placed by its corners", reading);
            read_polygon(shape, reading)
        }
        "Disc" => {
            refuse(&["scale"], "only a mesh is scaled", reading);
            let place = read_flat(fields, &mut reading.problems);
            let radius_m = read_radius(shape, "Disc(radius)", reading);
            let (place, radius_m) = (place?, radius_m?);
            Some(vec![Shape::Disc(Disc { centre: place.at, normal: place.z, radius_m, hole_radius_m: 0.0 })])
        }
        "Annulus" => {
            refuse(&["scale"], "only a mesh is scaled", reading);
            let place = read_flat(fields, &mut reading.problems);
            let radii = shape.positional(2, "Annulus(inner, outer)", &mut reading.problems)?;
            let inner = radii[0].length_m("the inner radius", 1.0, &mut reading.problems);
            let outer = radii[1].length_m("the outer radius", 1.0, &mut reading.problems);
            let (place, inner, outer) = (place?, inner?, outer?);
            if inner >= outer {
                let message = format!("the inner radius of the ring, {inner} m, is not below the outer one, {outer} m");
                radii[0].problem(
                    &mut reading.problems,
                    message,
                    "write `Annulus(inner, outer)`: the radius of the hole, then that of the plate",
                );
                return None;
            }
            Some(vec![Shape::Disc(Disc { centre: place.at, normal: place.z, radius_m: outer, hole_radius_m: inner })])
        }
        "Sphere" => {
            refuse(&["facing", "up", "turned_deg"], "a sphere looks the same from everywhere", reading);
            refuse(&["scale"], "only a mesh is scaled", reading);
            let centre = read_at(fields, &mut reading.problems);
            let radius_m = read_radius(shape, "Sphere(radius)", reading);
            let (centre, radius_m) = (centre?, radius_m?);
            Some(vec![Shape::Sphere(Sphere { centre, radius_m })])
        }
        "Box" => {
            refuse(&["facing", "up"], "a box is turned with `turned_deg`", reading);
            refuse(&["scale"], "only a mesh is scaled", reading);
            let place = read_turned(fields, &mut reading.problems);
            let size = read_size(shape, reading);
            Some(box_sides(place?, size?))
        }
        "Mesh" => {
            refuse(&["facing", "up"], "a mesh is turned with `turned_deg`", reading);
            let place = read_turned(fields, &mut reading.problems);
            let scale = match fields.get("scale") {
                Some(scale) => scale.number_in("the scale", "above 0", |x| x > 0.0, &mut reading.problems),
                None => Some(1.0),
            };
            let name = shape.positional(1, "Mesh(\"file.obj\")", &mut reading.problems)?.into_iter().next()?;
            read_mesh(&name, place?, scale?, reading).map(|mesh| vec![Shape::Mesh(mesh)])
        }
        _ => {
            shape.variant("a shape", &SHAPES, &mut reading.problems);
            check_place(fields, reading);
            None
        }
    }
}

fn read_radius(shape: &Value, form: &str, reading: &mut Reading) -> Option<f64> {
    let radius = shape.positional(1, form, &mut reading.problems)?;
    radius[0].length_m("the radius", 1.0, &mut reading.problems)
}

fn read_size(shape: &Value, reading: &mut Reading) -> Option<DVec3> {
    let problems = &mut reading.problems;
    let size = shape.fields("`Box`", &["size"], problems)?.require("size", "(4, 3, 2.5)", problems)?;
    let size_m = size.vector(problems)?;
    if size_m.min_element() >= SMALLEST_M && size_m.max_element() <= LARGEST_M {
        return Some(size_m);
    }
    let axis = (0..3).find(|&i| !(SMALLEST_M..=LARGEST_M).contains(&size_m[i])).unwrap_or(0);
    let name = (["x", "y", "z"][axis], size_m[axis]);
    size.problem(
        problems,
        format!("the size of the box along {} is {:e} m", name.0, name.1),
        format!("allowed: {SMALLEST_M:e} m to {LARGEST_M:e} m"),
    );
    None
}

fn read_quad(shape: &Value, reading: &mut Reading) -> Option<Vec<Shape>> {
    let problems = &mut reading.problems;
    let fields = shape.fields("`Quad`", &["corner", "u", "v"], problems)?;
    let corner = fields.require("corner", "(0, 0, 0)", problems).and_then(|v| v.point_m(problems));
    let mut edge = |key: &str| {
        let value = fields.require(key, "(1, 0, 0)", problems)?;
        let edge = value.point_m(problems)?;
        if edge.abs().max_element() < SMALLEST_M {
            value.problem(problems, format!("the edge `{key}` has no length"), "write the vector from the corner along the edge, m");
            return None;
        }
        Some(edge)
    };
    let (u, v) = (edge("u"), edge("v"));
    let (corner, u, v) = (corner?, u?, v?);
    let cosine = normalised(u)?.dot(normalised(v)?);
    if cosine.abs() > PERPENDICULAR {
        let angle_deg = normalised(u)?.cross(normalised(v)?).length().atan2(cosine).to_degrees();
        shape.problem(
            problems,
            format!("the edges `u` and `v` meet at {angle_deg:.6}°, but a `Quad` is a rectangle"),
            "make them perpendicular, or use a mesh",
        );
        return None;
    }
    Some(vec![Shape::Rectangle(Rectangle { centre: corner + 0.5 * (u + v), half_u: 0.5 * u, half_v: 0.5 * v })])
}

fn read_polygon(shape: &Value, reading: &mut Reading) -> Option<Vec<Shape>> {
    let problems = &mut reading.problems;
    let list = shape.positional(1, "Polygon([(0, 0, 0), (1, 0, 0), (0, 1, 0)])", problems)?.into_iter().next()?;
    let items = list.list("the corners of a polygon", problems)?;
    let corners: Vec<Option<DVec3>> = items.iter().map(|item| item.point_m(problems)).collect();
    let corners: Vec<DVec3> = corners.into_iter().collect::<Option<_>>()?;
    let error = match Polygon::new(&corners) {
        Ok(polygon) => return Some(vec![Shape::Polygon(polygon)]),
        Err(error) => error,
    };
    let help = match error {
        PolygonError::CornerCount(n) if n > MOST_CORNERS => "use a mesh",
        PolygonError::CornerCount(_) | PolygonError::NotFinite(_) => "",
        PolygonError::NoArea => "give corners that enclose an area; a surface without one sends no light",
        PolygonError::NotPlane { .. } => "move the corner into the plane, or use a mesh; corners are counted from 0",
        PolygonError::EdgesMeet(..) => "list each corner once, in the order along the outline; edges are counted from 0",
    };
    list.problem(problems, error.to_string(), help);
    None
}

/// The six sides of a box, each facing outwards: −x, +x, −y, +y, −z, +z.
fn box_sides(place: Placement, size_m: DVec3) -> Vec<Shape> {
    let half = 0.5 * size_m;
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let mut sides = Vec::with_capacity(6);
    for (i, axis) in axes.into_iter().enumerate() {
        let (u, v) = (axes[(i + 1) % 3], axes[(i + 2) % 3]);
        for outwards in [-1.0, 1.0] {
            // u × v is the axis, v × u its opposite.
            let (first, second) = if outwards > 0.0 { (u, v) } else { (v, u) };
            let centre = half + axis * (outwards * half[i]);
            sides.push(Shape::Rectangle(Rectangle {
                centre: place.point(centre),
                half_u: place.vector(first * half),
                half_v: place.vector(second * half),
            }));
        }
    }
    sides
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::placement::turned_frame;

    #[test]
    fn the_sides_of_a_box_face_outwards_and_close_it() {
        let place = turned_frame(DVec3::new(1.0, 2.0, 3.0), DVec3::new(0.0, 0.0, 90.0));
        let sides = box_sides(place, DVec3::new(2.0, 4.0, 6.0));
        let middle = place.point(DVec3::new(1.0, 2.0, 3.0));
        assert_eq!(middle, DVec3::new(-1.0, 3.0, 6.0));
        let mut vector_area = DVec3::ZERO;
        let mut volume = 0.0;
        for side in &sides {
            let Shape::Rectangle(r) = side else { panic!("a side of a box is a rectangle") };
            assert!(r.normal().dot(r.centre - middle) > 0.0);
            vector_area += r.normal() * r.area_m2();
            volume += r.normal().dot(r.centre) * r.area_m2() / 3.0;
        }
        assert_eq!(vector_area, DVec3::ZERO);
        assert!((volume - 48.0_f64).abs() < 1e-12);
    }
}
