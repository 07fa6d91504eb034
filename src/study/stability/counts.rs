//! Numbers of things: spectral lines, sources, instruments. The sums stay right, and time grows in proportion.
//!
//! | sweep | series | reference |
//! |---|---|---|
//! | lines | formula: illuminance of N lines | K_m E Σ V(λᵢ)/N |
//! | | paths: radiance of a red wall under them | E/π Σ ρ(λᵢ)/N |
//! | sources | formula: N lamps on a circle | N I cos θ/r² |
//! | | shadow: the same, half of them hidden | N I cos θ/r² / 2 |
//! | instruments | formula: a line of N poses below a lamp | I h/(h² + x²)^(3/2) for each |
//! | | paths: N meters on the wall of a closed sphere | Φ/(4πR² (1 − ρ)) for each |

use std::f64::consts::{PI, TAU};
use std::fmt::Write;

use super::reflectance::sphere;
use super::text::{METER, at, radiance_meter, upwards, upwards_with};
use super::{Point, Reference, Sweep, decades};
use crate::quantity::constants::K_M_LM_W;
use crate::spectrum::{Factor, library};

/// Number of spectral lines.
pub const LINES: Sweep =
    Sweep { name: "lines", parameter: "number of spectral lines", unit: "1", law: "the sum over the lines", points: lines };
/// Number of sources.
pub const SOURCES: Sweep =
    Sweep { name: "sources", parameter: "number of sources", unit: "1", law: "the sum over the lamps that are seen", points: sources };
/// Number of instruments.
pub const INSTRUMENTS: Sweep =
    Sweep { name: "instruments", parameter: "number of poses", unit: "1", law: "each pose reads its own closed form", points: instruments };

/// A sum of N terms is rounded N times in the reference, too.
fn summed(value: f64, terms: usize) -> Reference {
    Reference::Values { values: vec![value], relative: 4e-15 * (terms as f64).sqrt() }
}

fn wavelengths(n: usize) -> Vec<f64> {
    (0..n).map(|i| 400.0 + 300.0 * (i as f64 + 0.5) / n as f64).collect()
}

fn lines() -> Vec<Point> {
    let counts = || decades(0, 4, 1).into_iter().map(|n| n as usize);
    let mean = |curve: &Factor, n: usize| wavelengths(n).iter().map(|nm| curve.at(*nm)).sum::<f64>() / n as f64;
    let paint = library::factor("ColorChecker red").unwrap_or(Factor::Constant(f64::NAN));
    let meter = METER.replace("responsivity: 1, reads: Irradiance", "responsivity: \"V\", reads: Illuminance");
    let mut points = Vec::new();
    for n in counts() {
        let reference = summed(2.0 * K_M_LM_W * mean(&library::v_lambda(), n), n);
        points.push(Point::new("formula", n as f64, upwards_with(&meter, "", &many_lines(n)), reference));
    }
    for n in counts() {
        let scene = format!(
            "Scene(surfaces: {{ \"red\": Lambertian(\"ColorChecker red\") }},
                objects: [(name: \"wall\", shape: Rectangle(8, 8), at: (0, 0, 0), facing: (0, 0, 1), surface: \"red\")],
                sources: [{}], instruments: [(name: \"meter\", sensor: {}, at: (0, 0, 1), facing: (0, 0, -1))])",
            many_lines(n),
            radiance_meter(1.0),
        );
        points.push(Point::new("paths", n as f64, scene, summed(2.0 / PI * mean(&paint, n), n)).sampled(1 << 10));
    }
    points
}

fn many_lines(n: usize) -> String {
    let list: Vec<String> = wavelengths(n).iter().map(|nm| format!("({nm:e}, 1)")).collect();
    format!(
        "(name: \"light\", shape: Directional, facing: (0, 0, -1), strength: WattsPerSquareMetre(2), spectrum: Lines([{}]))",
        list.join(", ")
    )
}

fn sources() -> Vec<Point> {
    let mut points = Vec::new();
    for (series, hidden, most) in [("formula", false, 5), ("shadow", true, 4)] {
        for n in decades(1, most, 1) {
            let count = n as usize;
            let lamps: String = (0..count).fold(String::new(), |mut text, i| {
                // Half a step, so that none stands in the plane of the edge.
                let angle = TAU * (i as f64 + 0.5) / n;
                let _ = write!(
                    text,
                    "(name: \"{i}\", shape: Point, at: {}, strength: WattsPerSteradian(1), spectrum: Line(555)), ",
                    at(angle.sin(), angle.cos(), 1.0)
                );
                text
            });
            let edge = "(name: \"edge\", shape: Quad(corner: (0, -4, 0.5), u: (4, 0, 0), v: (0, 8, 0)), surface: \"black\")";
            let seen = if hidden { 0.5 * n } else { n };
            let scene = upwards(if hidden { edge } else { "" }, &lamps);
            points.push(Point::new(series, n, scene, summed(seen / (2.0 * 2f64.sqrt()), count)));
        }
    }
    points
}

fn instruments() -> Vec<Point> {
    let mut points = Vec::new();
    for n in decades(1, 5, 1) {
        let scene = format!(
            "Scene(sources: [(name: \"lamp\", shape: Point, at: (0, 0, 1), strength: WattsPerSteradian(1), spectrum: Line(555))],
                instruments: [(name: \"line\", sensor: {METER}, facing: (0, 0, 1),
                    grid: (from: (0, 0, 0), to: (1, 0, 0), points: ({n}, 1)))])"
        );
        let values = (0..n as usize).map(|i| (i as f64 / (n - 1.0)).mul_add(i as f64 / (n - 1.0), 1.0).powf(-1.5)).collect();
        points.push(Point::new("formula", n, scene, Reference::Values { values, relative: 4e-15 }));
    }
    for n in decades(0, 2, 1) {
        let one = sphere("paths", 0.5);
        let poses: Vec<String> = (0..n as usize)
            .map(|i| {
                let angle = TAU * i as f64 / n;
                format!("(at: {}, facing: {})", at(0.25 * angle.cos(), 0.25 * angle.sin(), 0.0), at(-angle.cos(), -angle.sin(), 0.0))
            })
            .collect();
        let scene = one.scene.replace("at: (0.25, 0, 0), facing: (-1, 0, 0)", &format!("list: [{}]", poses.join(", ")));
        points.push(Point { scene, parameter: n, without: vec!["closed_sphere"], ..one }.sampled(1 << 10));
    }
    points
}
