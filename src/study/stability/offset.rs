//! Distance from the origin: a scene far out reads the same.
//!
//! Doubles 10⁹ m from the origin are 1.2·10⁻⁷ m apart. Coordinates that are multiples of ⅛ m are kept exactly out there, decimal ones
//! are rounded before anything is computed.
//!
//! | series | what is in the scene |
//! |---|---|
//! | polygon | a triangle, by formula; coordinates that are kept exactly |
//! | decimal | a lamp at (0.1, 0.2, 1.1) m from a meter: I cos θ / r², coordinates that are rounded |
//! | mesh | half of a disc behind the edge of a mesh, sampled: E = πL R²/(R² + z²) / 2 |
//! | paths | a closed grey room with a plate that shades: the reading at the origin |

use std::f64::consts::PI;

use super::scale::room;
use super::text::{METER, at};
use super::{Point, Reference, Sweep, decades};

/// The sweep.
pub const SWEEP: Sweep =
    Sweep { name: "offset", parameter: "distance from the origin on each axis", unit: "m", law: "the same reading everywhere", points };

/// Share within which formulas give the same reading.
const SAME: f64 = 1e-12;

fn points() -> Vec<Point> {
    let offsets = || std::iter::once(0.0).chain(decades(0, 9, 1));
    let mut points = Vec::new();
    for o in offsets() {
        points.push(Point::new("polygon", o, triangle(o), Reference::Law { scene: triangle(0.0), factor: 1.0, relative: Some(SAME) }));
    }
    for o in offsets() {
        points.push(decimal(o));
    }
    for o in offsets() {
        points.push(behind_a_mesh(o));
    }
    for o in offsets() {
        let law = Reference::Law { scene: room(1.0, [0.0; 3]), factor: 1.0, relative: None };
        points.push(Point::new("paths", o, room(1.0, [o; 3]), law).sampled(1 << 12));
    }
    points
}

fn triangle(o: f64) -> String {
    let p = |x: f64, y: f64, z: f64| at(o + x, o + y, o + z);
    format!(
        "Scene(sources: [(name: \"triangle\", shape: Polygon([{}, {}, {}]), seen_from: Both, strength: Radiance(5), spectrum: Line(555))],
            instruments: [(name: \"meter\", sensor: {METER}, at: {}, facing: (0.5, 0.25, 1))])",
        p(1.0, 0.0, 1.0),
        p(-0.5, 0.75, 1.25),
        p(-0.25, -1.0, 1.5),
        p(0.0, 0.0, 0.0),
    )
}

fn decimal(o: f64) -> Point {
    let (x, y, z): (f64, f64, f64) = (0.1, 0.2, 1.1);
    let scene = format!(
        "Scene(sources: [(name: \"lamp\", shape: Point, at: {}, strength: WattsPerSteradian(5), spectrum: Line(555))],
            instruments: [(name: \"meter\", sensor: {METER}, at: {}, facing: (0, 0, 1))])",
        at(o + x, o + y, o + z),
        at(o, o, o),
    );
    let squared = x * x + y * y + z * z;
    Point::new("decimal", o, scene, Reference::exactly(5.0 * z / (squared * squared.sqrt())))
}

/// The mesh is two triangles that make up x ≥ 0 of a square, turned by nothing and moved by `at`.
fn behind_a_mesh(o: f64) -> Point {
    let obj = "v 0 -4 0\nv 4 -4 0\nv 4 4 0\nv 0 4 0\nf 1 2 3\nf 1 3 4\n";
    let scene = format!(
        "Scene(surfaces: {{ \"black\": Lambertian(0) }},
            objects: [(name: \"edge\", shape: Mesh(\"edge.obj\"), at: {}, surface: \"black\")],
            sources: [(name: \"disc\", shape: Disc(0.25), at: {}, facing: (0, 0, -1), strength: Radiance(8), spectrum: Line(555))],
            instruments: [(name: \"meter\", sensor: {METER}, at: {}, facing: (0, 0, 1))])",
        at(o, o, o + 0.5),
        at(o, o, o + 1.0),
        at(o, o, o),
    );
    let closed = 0.5 * 8.0 * PI * 0.0625 / 1.0625;
    let mut point = Point::new("mesh", o, scene, Reference::exactly(closed)).sampled(1 << 14);
    point.files.push(("edge.obj".to_owned(), obj.as_bytes().to_vec()));
    point
}
