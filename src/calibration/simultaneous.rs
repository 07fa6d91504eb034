//! A band that holds the whole curve at once.
//!
//! ```text
//! pointwise      P(|s(λₖ) − ŝₖ| ≤ k uₖ)            = p for each node        k = 1.96 for p = 95 %
//! simultaneous   P(|s(λₖ) − ŝₖ| ≤ K uₖ for all k)  = p                      K: the quantile of maxₖ |zₖ| over draws of the curve, z = (s − ŝ)/u
//! ```
//!
//! Of many nodes some lie outside of their 95 % bands even if everything is right; K says how much wider a band must be to hold them all. It depends on
//! how many numbers are free: 1.96 for a curve whose scale alone is uncertain, about 3 for twenty of them. Nodes that the readings do not determine are left
//! out: there the curve is a guess, and so would be a promise.
//!
//! Source: Ruppert, Wand, Carroll, Semiparametric Regression (2003), 6.5.
//!
//! ```
//! use etendue::calibration::{Exposures, FitOptions, Readings, fit, simultaneous};
//! use etendue::spectrum::Density;
//!
//! let nodes: Vec<f64> = (40..=70).map(|k| 10.0 * f64::from(k)).collect();
//! let spectra = [450.0, 500.0, 550.0, 600.0, 650.0].map(|nm| Ok(("scan", Density::gaussian(1.0, nm, 20.0)?)));
//! let exposures = Exposures::new(&nodes, &spectra.into_iter().collect::<Result<Vec<_>, etendue::spectrum::SpectrumError>>()?)?;
//! let readings = Readings { channel: "E".into(), values: vec![1.0, 2.0, 3.0, 2.0, 1.0], standard_uncertainties: vec![0.01; 5] };
//! let curve = fit(&exposures, &[readings], &FitOptions::default())?.curves.remove(0);
//! let factor = simultaneous::factor(&curve, 0.0, &|_| true, 0.95, 1).unwrap();
//! assert!(factor > 1.96 && factor < 5.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use nalgebra::DVector;

use super::fit::FittedCurve;
use super::propagation::root_of;
use crate::math::random::Stream;

/// Draws of the curve: they know a quantile of 95 % within 0.5 % of probability.
pub const DRAWS: usize = 2000;
/// Keeps these random numbers apart from those of others.
const STREAM: u64 = 0x5157_4241_4e44;

/// The factor K that makes `± K u` hold the whole curve with this probability, over the nodes for which `counts` holds; `scale` is a relative standard
/// uncertainty common to the whole curve. `None` if no node counts, none of them is uncertain, or the probability is none.
#[must_use]
pub fn factor(curve: &FittedCurve, scale: f64, counts: &dyn Fn(usize) -> bool, probability: f64, seed: u64) -> Option<f64> {
    let root = root_of(curve);
    let u = |k: usize| root.row(k).norm().hypot(scale * curve.values[k]);
    let nodes: Vec<(usize, f64)> = (0..curve.values.len()).filter(|k| counts(*k)).map(|k| (k, u(k))).filter(|(_, u)| *u > 0.0).collect();
    if nodes.is_empty() || !(probability > 0.0 && probability < 1.0) {
        return None;
    }
    // Two draws, z and −z, have the same largest |z|: nothing is gained by signs.
    let mut largest: Vec<f64> = (0..DRAWS as u64)
        .map(|draw| {
            let normals = normals(seed, draw, root.ncols() + 1);
            let common = scale * normals[root.ncols()];
            let apart = &root * DVector::from_column_slice(&normals[..root.ncols()]);
            nodes.iter().map(|&(k, u)| (apart[k] + common * curve.values[k]).abs() / u).fold(0.0, f64::max)
        })
        .collect();
    largest.sort_by(f64::total_cmp);
    largest.get(((DRAWS as f64 * probability).ceil() as usize).clamp(1, DRAWS) - 1).copied()
}

/// Standard normal numbers, in pairs (Box and Muller, Ann. Math. Stat. 29 (1958) 610).
fn normals(seed: u64, draw: u64, count: usize) -> Vec<f64> {
    (0..count.div_ceil(2) as u64)
        .flat_map(|pair| {
            let stream = Stream::new(seed, &[STREAM, draw, pair]);
            let radius = (-2.0 * stream.child(0).number().ln()).sqrt();
            let (sin, cos) = (std::f64::consts::TAU * stream.child(1).number()).sin_cos();
            [radius * cos, radius * sin]
        })
        .collect()
}
