//! Scale: with all lengths times k, radiances give the same reading. Nothing knows how long a metre is.
//!
//! | series | what is in the scene |
//! |---|---|
//! | disc | a disc beside the normal: E = (πL/2) (1 − (r² + z² − R²) / √((r² + z² + R²)² − 4R²r²)) |
//! | quadrature | a disc aperture that collects from a rectangle: the reading at 1 m |
//! | paths | a closed grey room with a panel and a plate that shades: the reading at 1 m, with the same random numbers |

use std::f64::consts::PI;

use super::text::{METER, at, upwards};
use super::{Point, Reference, Sweep, decades};

/// The sweep.
pub const SWEEP: Sweep = Sweep {
    name: "scale",
    parameter: "length of one metre",
    unit: "m",
    law: "radiance has no length: the same reading at every scale",
    points,
};

/// Share within which the same random numbers give the same reading at another scale.
const SAME: f64 = 1e-9;

fn points() -> Vec<Point> {
    let scales = || decades(-9, 9, 1);
    let mut points: Vec<Point> = scales().into_iter().map(disc).collect();
    points.extend(scales().into_iter().map(|s| law("quadrature", s, collecting)));
    points.extend(scales().into_iter().map(|s| law("paths", s, |s| room(s, [0.0; 3])).sampled(1 << 12)));
    points
}

fn law(series: &'static str, s: f64, scene: impl Fn(f64) -> String) -> Point {
    Point::new(series, s, scene(s), Reference::Law { scene: scene(1.0), factor: 1.0, relative: Some(SAME) })
}

fn disc(s: f64) -> Point {
    let (radius, aside, z) = (0.5 * s, 0.25 * s, s);
    let source = format!(
        "(name: \"disc\", shape: Disc({radius:e}), at: {}, facing: (0, 0, -1), strength: Radiance(3), spectrum: Line(555))",
        at(aside, 0.0, z)
    );
    // Of the unit scale: 1, R = 0.5, r = 0.25 are exact.
    let (r2, c2) = (0.0625, 0.25);
    let sum: f64 = r2 + 1.0 + c2;
    let closed = 1.5 * PI * (1.0 - (r2 + 1.0 - c2) / (sum * sum - 4.0 * c2 * r2).sqrt());
    Point::new("disc", s, upwards("", &source), Reference::exactly(closed))
}

fn collecting(s: f64) -> String {
    format!(
        "Scene(sources: [(name: \"panel\", shape: Rectangle({:e}, {:e}), at: {}, facing: (0, 0.2, -1), strength: Radiance(3), spectrum: Line(555))],
            instruments: [(name: \"meter\", at: {}, facing: (0.1, 0.2, 1), sensor: Sensor(aperture: Disc(radius_m: {:e}),
                acceptance: Cosine, channels: [(name: \"E\", responsivity: 1, reads: Irradiance)]))])",
        0.75 * s,
        0.5 * s,
        at(1.5 * s, -0.25 * s, 2.0 * s),
        at(0.125 * s, 0.125 * s, 0.0),
        0.125 * s,
    )
}

/// A closed room of 2 m × 3 m × 2.5 m with grey walls, a panel and a plate that shades; `s` is the length of one metre, `o` its corner.
pub(super) fn room(s: f64, o: [f64; 3]) -> String {
    let p = |x: f64, y: f64, z: f64| at(o[0] + x * s, o[1] + y * s, o[2] + z * s);
    format!(
        "Scene(
            surfaces: {{ \"paint\": Lambertian(0.7) }},
            objects: [
                (name: \"walls\", shape: Box(size: {}), at: {}, surface: \"paint\", seen_from: Inside),
                (name: \"plate\", shape: Disc({:e}), at: {}, facing: (0.1, 0.2, 1), surface: \"paint\"),
            ],
            sources: [
                (name: \"panel\", shape: Rectangle({:e}, {:e}), at: {}, facing: (0, 0, -1), strength: Radiance(5), spectrum: Line(555)),
            ],
            instruments: [
                (name: \"floor\", sensor: {METER}, at: {}, facing: (0, 0, 1)),
                (name: \"air\", sensor: {METER}, at: {}, facing: (1, -0.5, 0.3)),
            ],
        )",
        at(2.0 * s, 3.0 * s, 2.5 * s),
        p(-1.0, -1.5, 0.0),
        0.25 * s,
        p(0.25, 0.125, 1.5),
        0.5 * s,
        0.75 * s,
        p(0.0, 0.25, 2.25),
        p(0.5, 0.375, 0.0),
        p(-0.25, 0.5, 1.0),
    )
}
