//! Solid angle of an acceptance, down to 10⁻¹² sr.
//!
//! ```text
//! a cone of half-angle α about the normal under a uniform sky:   E = πL sin²α,   Ω = 2π (1 − cos α)
//! a meter of radiance that is filled:                            the radiance itself
//! ```
//!
//! | series | how it is read |
//! |---|---|
//! | sky | irradiance by formula |
//! | filled | radiance of a disc that fills the cone, by formula |
//! | not filled | radiance of a disc of half the cone's sine: L/4, by formula |
//! | wall | radiance of a wall in a uniform light, by paths: ρ E / π |

use std::f64::consts::PI;

use super::text::{radiance_meter, upwards_with};
use super::{Point, Reference, Sweep, decades};

/// The sweep.
pub const SWEEP: Sweep = Sweep {
    name: "acceptance-solid-angle",
    parameter: "solid angle of the acceptance",
    unit: "sr",
    law: "E = π L sin²α; a filled meter reads the radiance",
    points,
};

/// Half-angle of the cone of solid angle Ω, rad: sin²(α/2) = Ω/4π.
fn half_angle(omega: f64) -> f64 {
    2.0 * (omega / (4.0 * PI)).sqrt().asin()
}

fn points() -> Vec<Point> {
    let sizes = || decades(-12, 0, 1).into_iter().rev();
    let mut points = Vec::new();
    for omega in sizes() {
        let degrees = half_angle(omega).to_degrees();
        let sensor = format!(
            "Sensor(aperture: Point, acceptance: Cone(half_angle_deg: {degrees:e}), \
             channels: [(name: \"E\", responsivity: 1, reads: Irradiance)])"
        );
        let sky = "(name: \"sky\", shape: Environment, strength: Radiance(7), spectrum: Line(555))";
        let closed = 7.0 * PI * degrees.to_radians().sin().powi(2);
        points.push(Point::new("sky", omega, upwards_with(&sensor, "", sky), Reference::exactly(closed)));
    }
    for (series, share, closed) in [("filled", 2.0, 7.0), ("not filled", 0.5, 1.75)] {
        for omega in sizes() {
            let alpha = half_angle(omega);
            // A disc whose sine seen from 1 m is `share` times that of the cone, or which covers 80° where that is not possible.
            let sine = (share * alpha.sin()).min(80f64.to_radians().sin());
            let radius = sine / ((1.0 - sine) * (1.0 + sine)).sqrt();
            let disc = format!(
                "(name: \"disc\", shape: Disc({radius:e}), at: (0, 0, 1), facing: (0, 0, -1), strength: Radiance(7), spectrum: Line(555))"
            );
            let scene = upwards_with(&radiance_meter(alpha.to_degrees()), "", &disc);
            points.push(Point::new(series, omega, scene, Reference::exactly(closed)));
        }
    }
    for omega in sizes() {
        let degrees = half_angle(omega).to_degrees();
        let scene = format!(
            "Scene(surfaces: {{ \"grey\": Lambertian(0.5) }},
                objects: [(name: \"wall\", shape: Rectangle(8, 8), at: (0, 0, 0), facing: (0, 0, 1), surface: \"grey\")],
                sources: [(name: \"sun\", shape: Directional, facing: (0, 0, -1), strength: WattsPerSquareMetre(3), spectrum: Line(555))],
                instruments: [(name: \"meter\", sensor: {}, at: (0, 0, 1), facing: (0, 0, -1))])",
            radiance_meter(degrees),
        );
        points.push(Point::new("wall", omega, scene, Reference::exactly(1.5 / PI)).sampled(1 << 12));
    }
    points
}
