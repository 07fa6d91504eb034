//! Slivers: triangles far longer than wide.
//!
//! | series | what is in the scene |
//! |---|---|
//! | polygon | a triangular source of 2 m × 2 m / aspect, by formula |
//! | mesh | the same as a mesh |
//! | edge | half of a disc behind a mesh whose outermost triangles are slivers, sampled |
//! | fan | half of a disc behind a mesh of as many slivers as their aspect ratio, sampled |
//!
//! References: product Gauss quadrature over the triangle as its corners are written down; half of E = πL R²/(R² + z²).

use std::f64::consts::PI;
use std::fmt::Write;

use super::reference::{Figure, irradiance};
use super::text::{upwards, vector};
use super::{Point, Reference, Sweep, decades};
use crate::math::DVec3;

/// The sweep.
pub const SWEEP: Sweep = Sweep {
    name: "slivers",
    parameter: "aspect ratio of a triangle",
    unit: "1",
    law: "E = L ∫ cos θ cos θ' / r² dA; half of a disc",
    points,
};

fn points() -> Vec<Point> {
    let aspects = || decades(0, 6, 1);
    let mut points: Vec<Point> = aspects().into_iter().map(|a| source("polygon", a)).collect();
    points.extend(aspects().into_iter().map(|a| source("mesh", a)));
    points.extend(aspects().into_iter().map(|a| shading("edge", a, edge(a))));
    points.extend(decades(0, 4, 1).into_iter().map(|a| shading("fan", a, fan(a))));
    points
}

fn source(series: &'static str, aspect: f64) -> Point {
    let width = 2.0 / aspect;
    let corners = [DVec3::new(-1.0, 0.25, 1.0), DVec3::new(1.0, 0.25, 1.0), DVec3::new(1.0, 0.25 + 0.6 * width, 1.0 + 0.8 * width)];
    let closed = 5.0 * irradiance(Figure::Triangle, corners[0], corners[1] - corners[0], corners[2] - corners[1]);
    let shape = match series {
        "mesh" => "Mesh(\"sliver.obj\")".to_owned(),
        _ => format!("Polygon([{}])", corners.map(vector).join(", ")),
    };
    let item = format!("(name: \"sliver\", shape: {shape}, seen_from: Both, strength: Radiance(5), spectrum: Line(555))");
    // The quadrature sums 4096 terms, which rounds more than a closed form.
    let mut point = Point::new(series, aspect, upwards("", &item), Reference::Values { values: vec![closed], relative: 1e-13 });
    let vertices: String = corners.iter().map(|c| format!("v {:e} {:e} {:e}\n", c.x, c.y, c.z)).collect();
    point.files.push(("sliver.obj".to_owned(), format!("{vertices}f 1 2 3\n").into_bytes()));
    point
}

fn shading(series: &'static str, aspect: f64, obj: String) -> Point {
    let edge = "(name: \"edge\", shape: Mesh(\"edge.obj\"), at: (0, 0, 0.5), surface: \"black\")";
    let disc = "(name: \"disc\", shape: Disc(0.25), at: (0, 0, 1), facing: (0, 0, -1), strength: Radiance(8), spectrum: Line(555))";
    let closed = 0.5 * 8.0 * PI * 0.0625 / 1.0625;
    let mut point = Point::new(series, aspect, upwards(edge, disc), Reference::exactly(closed)).sampled(1 << 14);
    point.files.push(("edge.obj".to_owned(), obj.into_bytes()));
    point
}

/// x from 0 to 4 m and y from −4 to 4 m, cut at x = 4 m / aspect.
fn edge(aspect: f64) -> String {
    let width = 4.0 / aspect;
    let mut obj = format!("v 0 -4 0\nv {width:e} -4 0\nv {width:e} 4 0\nv 0 4 0\nf 1 2 3\nf 1 3 4\n");
    if width < 4.0 {
        obj.push_str("v 4 -4 0\nv 4 4 0\nf 2 5 6\nf 2 6 3\n");
    }
    obj
}

/// Triangles from (4, 0) to as many pieces of the edge x = 0 as the aspect ratio says.
fn fan(aspect: f64) -> String {
    let pieces = aspect as usize;
    let mut obj = "v 4 0 0\n".to_owned();
    for i in 0..=pieces {
        let y = 8.0 * i as f64 / pieces as f64 - 4.0;
        let _ = writeln!(obj, "v 0 {y:e} 0");
    }
    for i in 0..pieces {
        let _ = writeln!(obj, "f 1 {} {}", i + 3, i + 2);
    }
    obj
}
