//! Width of a spectral line, to zero: a bell curve becomes a line.
//!
//! ```text
//! E_v = K_m E ∫ V(λ) g(λ) dλ        g: a bell curve of unit area, σ = FWHM / (2 √(2 ln 2))
//! σ ≪ 1 nm:  ∫ V g = V(λ₀) + ½ (V′₊ − V′₋) σ √(2/π)        V is linear between whole nm: the second term is there on a whole nm only
//! ```
//!
//! | series | what is read |
//! |---|---|
//! | on a node | illuminance, centre 555 nm |
//! | between nodes | illuminance, centre 610.5 nm |
//! | reflected | radiance of a red wall, centre 605 nm: ∫ ρ g E/π, by paths |
//!
//! The reference is Gauss quadrature over each nanometre, in λ − λ₀, so that the narrowest line keeps its digits. Width zero is no
//! bell curve; the program has to say so.

use std::f64::consts::PI;

use super::reference::gauss;
use super::text::{METER, radiance_meter, upwards_with};
use super::{Point, Reference, Sweep, decades};
use crate::quantity::constants::K_M_LM_W;
use crate::spectrum::{Factor, library};

/// The sweep.
pub const SWEEP: Sweep = Sweep {
    name: "line-width",
    parameter: "full width at half maximum",
    unit: "nm",
    law: "∫ V g dλ, towards V(λ₀) as the line narrows",
    points,
};

/// Standard deviations beyond which a bell curve is nothing.
const REACH: f64 = 12.0;

fn points() -> Vec<Point> {
    let widths = || decades(-9, 2, 1).into_iter().rev();
    let mut points = Vec::new();
    for (series, centre) in [("on a node", 555.0), ("between nodes", 610.5)] {
        let meter = METER.replace("responsivity: 1, reads: Irradiance", "responsivity: \"V\", reads: Illuminance");
        let scene = |width: f64| upwards_with(&meter, "", &light(centre, width));
        for width in widths() {
            let closed = 2.0 * K_M_LM_W * folded(&library::v_lambda(), centre, width);
            points.push(Point::new(series, width, scene(width), Reference::Values { values: vec![closed], relative: 1e-14 }));
        }
        points.push(Point::new(series, 0.0, scene(0.0), Reference::Refused));
    }
    // A wall without its table would be a scene that the program refuses; the sweep then shows it.
    let paint = library::factor("ColorChecker red").unwrap_or(Factor::Constant(f64::NAN));
    for width in widths().filter(|width| *width <= 10.0) {
        let closed = 2.0 / PI * folded(&paint, 605.0, width);
        points.push(
            Point::new("reflected", width, wall(width), Reference::Values { values: vec![closed], relative: 1e-14 }).sampled(1 << 10),
        );
    }
    points
}

fn light(centre: f64, width: f64) -> String {
    format!(
        "(name: \"light\", shape: Directional, facing: (0, 0, -1), strength: WattsPerSquareMetre(2), \
         spectrum: Gaussian(centre_nm: {centre:e}, fwhm_nm: {width:e}))"
    )
}

fn wall(width: f64) -> String {
    format!(
        "Scene(surfaces: {{ \"red\": Lambertian(\"ColorChecker red\") }},
            objects: [(name: \"wall\", shape: Rectangle(8, 8), at: (0, 0, 0), facing: (0, 0, 1), surface: \"red\")],
            sources: [{}],
            instruments: [(name: \"meter\", sensor: {}, at: (0, 0, 1), facing: (0, 0, -1))])",
        light(605.0, width),
        radiance_meter(1.0),
    )
}

/// ∫ f(λ) g(λ) dλ for a curve that is linear between whole nm.
fn folded(curve: &Factor, centre_nm: f64, fwhm_nm: f64) -> f64 {
    let sigma = fwhm_nm / (2.0 * (2.0 * std::f64::consts::LN_2).sqrt());
    let reach = REACH * sigma;
    let (first, last) = ((centre_nm - reach).ceil(), (centre_nm + reach).floor());
    let whole = (0..=(last - first).max(-1.0) as usize).map(|k| first + k as f64 - centre_nm).filter(|x| x.abs() < reach);
    let mut ends: Vec<f64> = whole.chain([-reach, 0.0, reach]).collect();
    ends.sort_by(f64::total_cmp);
    let nodes = gauss(64);
    let mut sum = 0.0;
    for pair in ends.windows(2) {
        let length = pair[1] - pair[0];
        // The middle of the interval says on which side of a node the curve is taken.
        for &(s, weight) in &nodes {
            let x = pair[0] + s * length;
            let z = x / sigma;
            sum += weight * length / sigma * curve.at(centre_nm + x) * (-0.5 * z * z).exp() / (2.0 * PI).sqrt();
        }
    }
    sum
}
