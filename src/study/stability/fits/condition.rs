//! Condition number of the exposures: broad sources, ever broader, at a spacing of 10 nm before a curve with nodes there.
//!
//! ```text
//! weights  wᵢₖ ∝ exp(−(λᵢ − λₖ)²/2σ²)        κ = ½ exp(π² σ² / 2h²)        an endless row, h = 10 nm
//! ```
//!
//! The largest eigenvalue of an endless row belongs to a flat curve, the smallest to one that alternates from node to node; with ends, κ is lower by
//! a factor of two at most. From 1e16 on no double holds what the narrowest ripple adds to a reading.
//!
//! Source: Gray, Toeplitz and Circulant Matrices (2006), 4; the sums are theta functions, of which one term counts at either end.

use super::super::{Curve, Point, Sweep, decades};
use super::design::{lux_meter, made, nodes, point, sets, sources, two_bands};

pub(in super::super) const SWEEP: Sweep = Sweep {
    name: "fit-condition",
    parameter: "condition number of the exposures",
    unit: "1",
    law: "the true curve, within bands of 99 % at 95 % of the nodes",
    points,
};

/// Spacing of sources and nodes, nm.
const SPACING_NM: f64 = 10.0;
/// Sets of readings of a point.
const SETS: u64 = 4;

/// Full width at half maximum of sources whose weights have this condition, nm.
fn fwhm_nm(condition: f64) -> f64 {
    let sigma_nm = SPACING_NM * (2.0 * (2.0 * condition).ln()).sqrt() / std::f64::consts::PI;
    sigma_nm * (8.0 * std::f64::consts::LN_2).sqrt()
}

fn points() -> Vec<Point> {
    let nodes = nodes(SPACING_NM);
    let series: [(&'static str, f64, Curve); 6] = [
        ("noise 0", 0.0, lux_meter),
        ("noise 1e-4", 1e-4, lux_meter),
        ("noise 1e-3", 1e-3, lux_meter),
        ("noise 1e-2", 1e-2, lux_meter),
        ("noise 0.1", 0.1, lux_meter),
        ("two bands, 1e-3", 1e-3, two_bands),
    ];
    let one = |(name, noise, curve): (&'static str, f64, Curve), condition: f64| {
        let exposures = sources(&nodes, nodes.len(), fwhm_nm(condition))?;
        let truth = curve(&nodes);
        let sets = sets(&exposures, &truth, noise, SETS);
        Ok(point(name, condition, exposures, sets, truth))
    };
    made(
        series
            .into_iter()
            .flat_map(|s| decades(2, 17, 1).into_iter().map(move |condition| (s, condition)))
            .map(|(s, c)| one(s, c))
            .collect(),
    )
}
