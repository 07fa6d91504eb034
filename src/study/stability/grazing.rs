//! Grazing angles, to 89.9999° from the normal.
//!
//! ```text
//! E = I cos θ / r²        E = E₀ cos θ        L = ρ E₀ cos θ / π        a sphere above the horizon: E = πL sin²α cos θ
//! ```
//!
//! | series | how it is read |
//! |---|---|
//! | point | a lamp, by formula |
//! | parallel light | by formula |
//! | sphere | a sphere that stays above the horizon, by formula |
//! | shadowed | half of a disc that faces the meter, behind an edge, sampled |
//! | reflected | parallel light that grazes a wall, by paths |
//!
//! Directions are written as (cos, sin) of the complement, so that the cosine has all its digits.

use std::f64::consts::{FRAC_PI_2, PI};

use super::reference::cut_disc;
use super::text::{METER, at, radiance_meter, upwards};
use super::{Point, Reference, Sweep};

/// The sweep.
pub const SWEEP: Sweep = Sweep { name: "grazing", parameter: "angle from the normal", unit: "°", law: "E = E₀ cos θ", points };

const ANGLES_DEG: [f64; 10] = [0.0, 45.0, 80.0, 89.0, 89.9, 89.99, 89.999, 89.9999, 89.999_999, 89.999_999_999];

/// Sine and cosine of an angle near 90°, by its complement.
fn sine_cosine(deg: f64) -> (f64, f64) {
    let complement = (90.0 - deg).to_radians();
    (complement.cos(), complement.sin())
}

fn points() -> Vec<Point> {
    let mut points = Vec::new();
    for deg in ANGLES_DEG {
        let (sine, cosine) = sine_cosine(deg);
        let lamp = format!(
            "(name: \"lamp\", shape: Point, at: {}, strength: WattsPerSteradian(8), spectrum: Line(555))",
            at(2.0 * sine, 0.0, 2.0 * cosine)
        );
        points.push(Point::new("point", deg, upwards("", &lamp), Reference::exactly(2.0 * cosine)));
    }
    for deg in ANGLES_DEG {
        let (sine, cosine) = sine_cosine(deg);
        let light = format!(
            "(name: \"light\", shape: Directional, facing: {}, strength: WattsPerSquareMetre(8), spectrum: Line(555))",
            at(-sine, 0.0, -cosine)
        );
        points.push(Point::new("parallel light", deg, upwards("", &light), Reference::exactly(8.0 * cosine)));
    }
    for deg in ANGLES_DEG {
        let (sine, cosine) = sine_cosine(deg);
        // Half of the height above the horizon.
        let radius = 0.5 * cosine.min(0.5);
        let ball = format!(
            "(name: \"ball\", shape: Sphere({radius:e}), at: {}, strength: Radiance(8), spectrum: Line(555))",
            at(sine, 0.0, cosine)
        );
        points.push(Point::new("sphere", deg, upwards("", &ball), Reference::exactly(8.0 * PI * radius * radius * cosine)));
    }
    for deg in ANGLES_DEG.into_iter().filter(|&deg| deg < 90.0) {
        points.push(shadowed(deg));
    }
    for deg in ANGLES_DEG {
        let (sine, cosine) = sine_cosine(deg);
        let scene = format!(
            "Scene(surfaces: {{ \"grey\": Lambertian(0.5) }},
                objects: [(name: \"wall\", shape: Rectangle(8, 8), at: (0, 0, 0), facing: (0, 0, 1), surface: \"grey\")],
                sources: [(name: \"sun\", shape: Directional, facing: {}, strength: WattsPerSquareMetre(3), spectrum: Line(555))],
                instruments: [(name: \"meter\", sensor: {}, at: (0, 0, 1), facing: (0, 0, -1))])",
            at(-sine, 0.0, -cosine),
            radiance_meter(1.0),
        );
        points.push(Point::new("reflected", deg, scene, Reference::exactly(1.5 * cosine / PI)).sampled(1 << 12));
    }
    points
}

/// A disc at 1 m that faces the meter; the meter is turned away by the angle, about the axis across the edge, and the disc is small
/// enough to stay above its horizon. Seen from the meter the disc is symmetric about the edge, and so is cos θ.
fn shadowed(deg: f64) -> Point {
    let (sine, cosine) = sine_cosine(deg);
    let radius = 0.25 * (cosine / (sine + cosine)).min(FRAC_PI_2);
    let scene = format!(
        "Scene(surfaces: {{ \"black\": Lambertian(0) }},
            objects: [(name: \"edge\", shape: Quad(corner: (0, -4, 0.5), u: (4, 0, 0), v: (0, 8, 0)), surface: \"black\")],
            sources: [(name: \"disc\", shape: Disc({radius:e}), at: (0, 0, 1), facing: (0, 0, -1), strength: Radiance(8), spectrum: Line(555))],
            instruments: [(name: \"meter\", sensor: {METER}, at: (0, 0, 0), facing: {})])",
        at(0.0, sine, cosine),
    );
    // The part of cos θ that goes with y is odd over the visible half.
    let closed = 8.0 * cosine * cut_disc(radius, 1.0, 0.0);
    Point::new("shadowed", deg, scene, Reference::exactly(closed)).sampled(1 << 14)
}
