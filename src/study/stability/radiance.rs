//! Radiance: readings are proportional to it over sixty powers of ten.
//!
//! | series | what is in the scene |
//! |---|---|
//! | formula | a sphere: E = πL (R/d)² |
//! | shadow | half of a disc behind an edge, sampled: E = πL R²/(R² + z²) / 2 |
//! | paths | a closed grey room: the reading at 5 W m⁻² sr⁻¹, with the same random numbers |

use std::f64::consts::PI;

use super::scale::room;
use super::source_size::half_hidden;
use super::text::upwards;
use super::{Point, Reference, Sweep, decades};

/// The sweep.
pub const SWEEP: Sweep =
    Sweep { name: "radiance", parameter: "radiance", unit: "W m⁻² sr⁻¹", law: "readings are proportional to the radiance", points };

fn points() -> Vec<Point> {
    let radiances = || decades(-30, 30, 5);
    let mut points = Vec::new();
    for l in radiances() {
        let source = format!("(name: \"ball\", shape: Sphere(0.5), at: (0, 0, 2), strength: Radiance({l:e}), spectrum: Line(555))");
        points.push(Point::new("formula", l, upwards("", &source), Reference::exactly(PI * l / 16.0)));
    }
    for l in radiances() {
        let reference = Reference::exactly(0.5 * PI * l * 0.0625 / 1.0625);
        points.push(Point::new("shadow", l, half_hidden(0.25, l), reference).sampled(1 << 14));
    }
    for l in radiances() {
        let brighter = room(1.0, [0.0; 3]).replace("Radiance(5)", &format!("Radiance({l:e})"));
        let reference = Reference::Law { scene: room(1.0, [0.0; 3]), factor: l / 5.0, relative: Some(1e-12) };
        points.push(Point::new("paths", l, brighter, reference).sampled(1 << 12));
    }
    points
}
