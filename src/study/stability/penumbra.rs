//! Width of a penumbra, to zero: a disc of radius R at 1 m behind a straight edge half-way has a penumbra of 2R.
//!
//! | series | where the meter stands | reference |
//! |---|---|---|
//! | lit | outside, on the bright side | E = πL R²/(R² + 1) |
//! | quarter | where the edge hides x < R/2 of the disc | the integral over the rest |
//! | rim | where only x > 0.998 R is seen, 4·10⁻⁵ of the disc | the integral over it |
//! | shadow | outside, on the dark side | 0 |
//! | point | on the dark and the bright side of a point's shadow, as far from its edge as the parameter says | I/r², 0 |

use std::f64::consts::PI;

use super::reference::cut_disc;
use super::text::upwards;
use super::{Point, Reference, Sweep, decades};

/// The sweep.
pub const SWEEP: Sweep = Sweep {
    name: "penumbra",
    parameter: "width of the penumbra",
    unit: "m",
    law: "the integral over the part of the disc that is seen",
    points,
};

fn points() -> Vec<Point> {
    let widths = || decades(-9, 0, 1).into_iter().rev();
    let mut points = Vec::new();
    for (series, cut) in [("lit", -1.5), ("quarter", 0.5), ("rim", 0.998), ("shadow", 1.5)] {
        for width in widths() {
            let radius = 0.5 * width;
            let closed = 8.0 * cut_disc(radius, 1.0, cut * radius);
            let closed = if series == "lit" { 8.0 * PI * radius * radius / (1.0 + radius * radius) } else { closed };
            let reference = if series == "shadow" { 0.0 } else { closed };
            let disc = format!(
                "(name: \"disc\", shape: Disc({radius:e}), at: (0, 0, 1), facing: (0, 0, -1), strength: Radiance(8), spectrum: Line(555))"
            );
            let scene = upwards(&edge(-0.5 * cut * radius), &disc);
            let reference = Reference::Values { values: vec![reference], relative: 1e-13 };
            points.push(Point::new(series, width, scene, reference).sampled(1 << 14));
        }
    }
    for (series, side, closed) in [("point, lit", 1.0, 8.0), ("point, dark", -1.0, 0.0)] {
        for width in widths() {
            let lamp = "(name: \"lamp\", shape: Point, at: (0, 0, 1), strength: WattsPerSteradian(8), spectrum: Line(555))";
            points.push(Point::new(series, width, upwards(&edge(0.5 * side * width), lamp), Reference::exactly(closed)));
        }
    }
    points
}

/// A black half-plane, x > `from`, at half the height; it hides the part x > 2 `from` of the plane of the source.
fn edge(from: f64) -> String {
    format!("(name: \"edge\", shape: Quad(corner: ({from:e}, -4, 0.5), u: (4, 0, 0), v: (0, 8, 0)), surface: \"black\")")
}
