//! Which further exposure helps most: the one that takes most from the expected error of the curve.
//!
//! ```text
//! C′ = C − C a aᵀ C / (u² + aᵀ C a)            gain = |C a|² / (u² + aᵀ C a)      = tr C − tr C′
//! ```
//!
//! C is the covariance that is expected of the error under the fitted curve as a prior ([`FittedCurve::expected`](crate::calibration::FittedCurve::expected)):
//! where the curve is small there is little to find. It counts the readings twice, so it is smaller than the stated uncertainty; but it is what
//! the choice goes by, and so what is told.
//!
//! One after the other (greedy): each next one is chosen with the ones before it taken. A reading that has not been taken is expected to be as noisy as
//! the readings that have been: the median of their relative uncertainties.
//!
//! Source: Rodgers, Inverse Methods for Atmospheric Sounding (2000), 2.5; Krause, Guestrin, JMLR 9 (2008) 235.

use crate::calibration::{Exposures, Fitted, Readings, suggestion};

/// A further exposure.
#[derive(Clone, Debug, PartialEq)]
pub struct Suggestion {
    /// The candidate.
    pub label: String,
    /// Its index among the candidates.
    pub index: usize,
    /// Before it: the expected error of the curves over their peak, root mean square over the nodes, or that of the quantity that is wanted.
    pub before: f64,
    /// After it and those before it in the list.
    pub after: f64,
}

/// What is to become more certain.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Wanted {
    /// All nodes of all curves alike.
    #[default]
    Curve,
    /// A quantity that follows from the curve, by its name: "f1′", "s_v for D65".
    Quantity(String),
}

/// The best `count` of the candidates, the best first; the sum over the channels counts. `gradients` are the derivatives of the quantity that is wanted, a
/// channel each, or nothing for the curves themselves.
#[must_use]
pub fn suggest(fitted: &Fitted, gradients: &[Vec<f64>], candidates: &Exposures, readings: &[Readings], count: usize) -> Vec<Suggestion> {
    let relative = median(
        readings.iter().flat_map(|r| r.values.iter().zip(&r.standard_uncertainties).filter(|(y, _)| **y != 0.0).map(|(y, u)| u / y.abs())),
    );
    let peak = fitted.curves.iter().flat_map(|c| &c.values).fold(0.0f64, |most, s| most.max(*s));
    let nodes = (fitted.wavelengths_nm.len() * fitted.curves.len()) as f64;
    let root = |variance: f64| {
        if gradients.is_empty() { (variance.max(0.0) / nodes).sqrt() / peak } else { variance.max(0.0).sqrt() }
    };
    suggestion::greedy(&fitted.curves, gradients, candidates, relative, count)
        .into_iter()
        .map(|step| Suggestion {
            label: candidates.labels()[step.index].clone(),
            index: step.index,
            before: root(step.before),
            after: root(step.after),
        })
        .collect()
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(0.0)
}
