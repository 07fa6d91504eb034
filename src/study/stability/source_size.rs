//! Solid angle of a source, down to 10⁻¹² sr.
//!
//! ```text
//! sphere of solid angle Ω on the normal:    sin²α = (Ω/π)(1 − Ω/4π),   E = πL sin²α
//! disc of radius R at the height z, half of it behind a straight edge:   E = πL R²/(R² + z²) / 2
//! ```
//!
//! | series | how it is read |
//! |---|---|
//! | sphere | by formula |
//! | half hidden | by shadow rays |
//! | by reflection | a small disc lights a wall, which a meter looks at: paths |

use std::f64::consts::PI;

use super::text::{radiance_meter, upwards};
use super::{Point, Reference, Sweep, decades};

/// The sweep.
pub const SWEEP: Sweep =
    Sweep {
        name: "source-solid-angle", parameter: "solid angle of the source", unit: "sr", law: "E = π L sin²α = L Ω (1 − Ω/4π)", points
    };

fn points() -> Vec<Point> {
    let sizes = || decades(-12, 0, 1).into_iter().rev();
    let mut points = Vec::new();
    for omega in sizes() {
        let squared = omega / PI * (1.0 - omega / (4.0 * PI));
        let radius = squared.sqrt();
        let source = format!("(name: \"ball\", shape: Sphere({radius:e}), at: (0, 0, 1), strength: Radiance(1e6), spectrum: Line(555))");
        points.push(Point::new("sphere", omega, upwards("", &source), Reference::exactly(PI * 1e6 * radius * radius)));
    }
    for omega in sizes() {
        let radius = disc_radius(omega);
        let closed = 0.5 * PI * radius * radius / (1.0 + radius * radius);
        points.push(Point::new("half hidden", omega, half_hidden(radius, 1.0), Reference::exactly(closed)).sampled(1 << 14));
    }
    for omega in sizes() {
        points.push(lit_wall(omega));
    }
    points
}

/// Radius of a disc at 1 m that has the solid angle Ω seen from its axis: 2π (1 − 1/√(1 + R²)) = Ω.
fn disc_radius(omega: f64) -> f64 {
    let share = omega / (2.0 * PI);
    // R² = 1/(1 − s)² − 1 without cancellation.
    (share * (2.0 - share)).sqrt() / (1.0 - share)
}

/// A meter below a disc of this radius at 1 m, half of which an edge hides.
pub(super) fn half_hidden(radius: f64, radiance: f64) -> String {
    let edge = "(name: \"edge\", shape: Quad(corner: (0, -4, 0.5), u: (4, 0, 0), v: (0, 8, 0)), surface: \"black\")";
    let source = format!(
        "(name: \"disc\", shape: Disc({radius:e}), at: (0, 0, 1), facing: (0, 0, -1), strength: Radiance({radiance:e}), spectrum: Line(555))"
    );
    upwards(edge, &source)
}

/// A narrow meter looks straight at a wall of reflectance ½ that a disc on the wall's normal lights from 1 m, the meter beside it:
/// L = ρ E / π with E = π L₀ R²/(1 + R²) at the point that it looks at.
fn lit_wall(omega: f64) -> Point {
    let radius = disc_radius(omega);
    let scene = format!(
        "Scene(surfaces: {{ \"grey\": Lambertian(0.5) }},
            objects: [(name: \"wall\", shape: Rectangle(8, 8), at: (0, 0, 0), facing: (0, 0, 1), surface: \"grey\")],
            sources: [(name: \"disc\", shape: Disc({radius:e}), at: (0, 0, 1), facing: (0, 0, -1), strength: Radiance(1e6), spectrum: Line(555))],
            instruments: [(name: \"meter\", sensor: {}, at: (3, 0, 2), facing: (-3, 0, -2))])",
        radiance_meter(1e-4),
    );
    let closed = 0.5 * 1e6 * radius * radius / (1.0 + radius * radius);
    // The spot is 2e-5 m wide; to second order in it the irradiance is that of its centre.
    Point::new("by reflection", omega, scene, Reference::Values { values: vec![closed], relative: 1e-9 }).sampled(1 << 12)
}
