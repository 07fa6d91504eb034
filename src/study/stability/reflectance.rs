//! Reflectance, to 1 − 10⁻⁶: a closed sphere, stiff because light is reflected 1/(1 − ρ) times.
//!
//! ```text
//! E = Φ / (4πR² (1 − ρ))    anywhere on the wall, for a lamp at the centre
//! ```
//!
//! | series | how it is read |
//! |---|---|
//! | formula | the sum of all reflections |
//! | paths | the same sphere without that formula |
//! | no loss | ρ = 1, for which there is no reading |

use std::f64::consts::PI;

use super::text::METER;
use super::{Point, Reference, Sweep, decades};

/// The sweep.
pub const SWEEP: Sweep =
    Sweep { name: "reflectance", parameter: "1 − ρ", unit: "1", law: "a closed sphere: E = Φ / (4πR² (1 − ρ))", points };

fn points() -> Vec<Point> {
    let mut points: Vec<Point> = decades(-12, -1, 1).into_iter().rev().map(|lost| sphere("formula", lost)).collect();
    for lost in decades(-6, -1, 1).into_iter().rev() {
        // A sample costs 1/(1 − ρ) reflections: where they are many there are fewer samples.
        let paths = sphere("paths", lost).sampled(if lost < 5e-5 { 1 << 6 } else { 1 << 8 });
        points.push(Point { without: vec!["closed_sphere"], ..paths });
    }
    points.push(Point { reference: Reference::Refused, ..sphere("no loss", 0.0) });
    points
}

/// A lamp of 1 W in a sphere of 0.25 m that absorbs the share `lost` of what falls on it, but for the rounding of ρ = 1 − `lost`.
pub(super) fn sphere(series: &'static str, lost: f64) -> Point {
    let rho = 1.0 - lost;
    let scene = format!(
        "Scene(surfaces: {{ \"wall\": Lambertian({rho:e}) }},
            objects: [(name: \"sphere\", shape: Sphere(0.25), at: (0, 0, 0), seen_from: Inside, surface: \"wall\")],
            sources: [(name: \"lamp\", shape: Point, at: (0, 0, 0), strength: Watts(1), spectrum: Line(555))],
            instruments: [(name: \"port\", sensor: {METER}, at: (0.25, 0, 0), facing: (-1, 0, 0))])"
    );
    // 1 − ρ of the number that is written, which is exact.
    Point::new(series, lost, scene, Reference::exactly(1.0 / (4.0 * PI * 0.0625 * (1.0 - rho))))
}
