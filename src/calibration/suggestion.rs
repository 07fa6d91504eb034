//! What a further reading would take from the expected error of fitted curves.
//!
//! ```text
//! C′ = C − C a aᵀ C / (u² + aᵀ C a)            tr C − tr C′ = |C a|² / (u² + aᵀ C a)
//! ```
//!
//! For a quantity with the derivative g the variance gᵀ C g takes the place of the trace, and `(gᵀ C a)² / (u² + aᵀ C a)` that of the gain.
//!
//! C is what is [expected](FittedCurve::expected) of a curve's error, a are the weights of an exposure, u is the uncertainty that its reading would have. That is
//! less than the stated covariance where the curve is small: there is little to find there. Exposures are chosen by it and told with it.

use nalgebra::{DMatrix, DVector};

use super::exposures::Exposures;
use super::fit::FittedCurve;

/// One exposure more.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Which candidate.
    pub index: usize,
    /// The expected square of the error that is to fall, summed over all curves, without it.
    pub before: f64,
    /// With it.
    pub after: f64,
}

/// The candidates that take most from the expected square of the error, one after the other, each once; `relative` is the relative standard uncertainty that their
/// readings would have. It is that of a quantity with these derivatives, a curve each, or the sum over all nodes if there are none.
#[must_use]
pub fn greedy(curves: &[FittedCurve], gradients: &[Vec<f64>], candidates: &Exposures, relative: f64, count: usize) -> Vec<Step> {
    let gradients: Vec<DVector<f64>> = gradients.iter().map(|g| DVector::from_column_slice(g)).collect();
    let mut expected: Vec<DMatrix<f64>> = curves.iter().map(|c| c.expected.clone()).collect();
    let variance = |covariances: &[DMatrix<f64>]| -> f64 {
        let of =
            |(c, covariance): (usize, &DMatrix<f64>)| gradients.get(c).map_or_else(|| covariance.trace(), |g| g.dot(&(covariance * g)));
        covariances.iter().enumerate().map(of).sum()
    };
    let mut left: Vec<usize> = (0..candidates.len()).collect();
    let mut steps = Vec::new();
    while steps.len() < count && !left.is_empty() {
        let before = variance(&expected);
        let gain = |i: usize| -> f64 {
            let each = updates(curves, &expected, candidates, relative, i).into_iter().enumerate();
            each.map(|(c, (c_a, below))| gradients.get(c).map_or_else(|| c_a.norm_squared(), |g| g.dot(&c_a).powi(2)) / below).sum()
        };
        let Some((place, _)) = left.iter().map(|i| gain(*i)).enumerate().max_by(|a, b| a.1.total_cmp(&b.1)) else { break };
        let index = left.remove(place);
        let found = updates(curves, &expected, candidates, relative, index);
        for (covariance, (c_a, below)) in expected.iter_mut().zip(found) {
            covariance.ger(-1.0 / below, &c_a, &c_a, 1.0);
        }
        steps.push(Step { index, before, after: variance(&expected) });
    }
    steps
}

/// `C a` and `u² + aᵀ C a` of each curve.
fn updates(
    curves: &[FittedCurve],
    covariances: &[DMatrix<f64>],
    candidates: &Exposures,
    relative: f64,
    index: usize,
) -> Vec<(DVector<f64>, f64)> {
    let a: DVector<f64> = candidates.matrix.row(index).transpose();
    let of = |(curve, covariance): (&FittedCurve, &DMatrix<f64>)| {
        let reading: f64 = a.iter().zip(&curve.values).map(|(a, s)| a * s).sum();
        let c_a = covariance * &a;
        let below = (relative * reading).powi(2) + a.dot(&c_a).max(0.0);
        // An exposure without light takes nothing.
        (c_a, if below > 0.0 { below } else { f64::INFINITY })
    };
    curves.iter().zip(covariances).map(of).collect()
}
