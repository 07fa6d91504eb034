//! What a further reading would take from the covariance of fitted curves.
//!
//! ```text
//! C′ = C − C a aᵀ C / (u² + aᵀ C a)            tr C − tr C′ = |C a|² / (u² + aᵀ C a)
//! ```
//!
//! For a quantity with the derivative g the variance gᵀ C g takes the place of the trace, and `(gᵀ C a)² / (u² + aᵀ C a)` that of the gain.
//!
//! C is the covariance of a curve, a are the weights of an exposure, u is the uncertainty that its reading would have.

use nalgebra::{DMatrix, DVector};

use super::exposures::Exposures;
use super::fit::FittedCurve;

/// One exposure more.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Which candidate.
    pub index: usize,
    /// The variance that is to fall, summed over all curves, without it.
    pub before: f64,
    /// With it.
    pub after: f64,
}

/// The candidates that take most from the variance, one after the other, each once; `relative` is the relative standard uncertainty that their
/// readings would have. The variance is that of a quantity with these derivatives, a curve each, or the sum over all nodes if there are none.
#[must_use]
pub fn greedy(curves: &[FittedCurve], gradients: &[Vec<f64>], candidates: &Exposures, relative: f64, count: usize) -> Vec<Step> {
    let gradients: Vec<DVector<f64>> = gradients.iter().map(|g| DVector::from_column_slice(g)).collect();
    let variance = |covariances: &[DMatrix<f64>]| -> f64 {
        let of =
            |(c, covariance): (usize, &DMatrix<f64>)| gradients.get(c).map_or_else(|| covariance.trace(), |g| g.dot(&(covariance * g)));
        covariances.iter().enumerate().map(of).sum()
    };
    let mut covariances: Vec<DMatrix<f64>> = curves.iter().map(FittedCurve::covariance).collect();
    let mut left: Vec<usize> = (0..candidates.len()).collect();
    let mut steps = Vec::new();
    while steps.len() < count && !left.is_empty() {
        let before: f64 = covariances.iter().map(DMatrix::trace).sum();
        let gain =
            |i: usize| updates(curves, &covariances, candidates, relative, i).map(|(c_a, below)| c_a.norm_squared() / below).sum::<f64>();
        let Some((place, _)) = left.iter().map(|i| gain(*i)).enumerate().max_by(|a, b| a.1.total_cmp(&b.1)) else { break };
        let index = left.remove(place);
        let found: Vec<(DVector<f64>, f64)> = updates(curves, &covariances, candidates, relative, index).collect();
        for (covariance, (c_a, below)) in covariances.iter_mut().zip(found) {
            covariance.ger(-1.0 / below, &c_a, &c_a, 1.0);
        }
        steps.push(Step { index, before, after: variance(&covariances) });
    }
    steps
}

/// `C a` and `u² + aᵀ C a` of each curve.
fn updates<'a>(
    curves: &'a [FittedCurve],
    covariances: &'a [DMatrix<f64>],
    candidates: &'a Exposures,
    relative: f64,
    index: usize,
) -> impl Iterator<Item = (DVector<f64>, f64)> + 'a {
    let a: DVector<f64> = candidates.matrix.row(index).transpose();
    curves.iter().zip(covariances).map(move |(curve, covariance)| {
        let reading: f64 = a.iter().zip(&curve.values).map(|(a, s)| a * s).sum();
        let c_a = covariance * &a;
        let below = (relative * reading).powi(2) + a.dot(&c_a).max(0.0);
        // An exposure without light takes nothing.
        (c_a, if below > 0.0 { below } else { f64::INFINITY })
    })
}
