//! A covariance as a product of few columns: `K ≈ L Lᵀ` by pivoted Cholesky.
//!
//! Smooth kernels have few directions; what is left out is less than a stated share of the trace. Working with L instead of K keeps the
//! relative accuracy of small singular values, which is what noise-free readings live on.
//!
//! Source: Harbrecht, Peters, Schneider, Appl. Numer. Math. 62 (2012) 428.

use nalgebra::DMatrix;

/// A covariance as columns, and what they miss.
pub(super) struct Factored {
    /// L.
    pub(super) columns: DMatrix<f64>,
    /// The diagonal of K − L Lᵀ: kept while factoring, for the difference itself would be rounding.
    pub(super) missing: Vec<f64>,
}

/// Columns `L` with `trace(K − L Lᵀ) ≤ share · trace(K)`, for the covariance `k(i, j)` of `n` values.
pub(super) fn factor(n: usize, k: &dyn Fn(usize, usize) -> f64, share: f64) -> Factored {
    let mut left: Vec<f64> = (0..n).map(|i| k(i, i)).collect();
    let trace: f64 = left.iter().sum();
    let mut columns: Vec<Vec<f64>> = Vec::new();
    while columns.len() < n && left.iter().sum::<f64>() > share * trace {
        let Some((pivot, &largest)) = left.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)) else { break };
        if largest <= 0.0 {
            break;
        }
        let root = largest.sqrt();
        let mut column: Vec<f64> = (0..n).map(|i| k(i, pivot)).collect();
        for earlier in &columns {
            let at_pivot = earlier[pivot];
            for (c, e) in column.iter_mut().zip(earlier) {
                *c -= at_pivot * e;
            }
        }
        for (c, rest) in column.iter_mut().zip(&mut left) {
            *c /= root;
            *rest = (*rest - *c * *c).max(0.0);
        }
        left[pivot] = 0.0;
        columns.push(column);
    }
    Factored { columns: DMatrix::from_fn(n, columns.len(), |i, j| columns[j][i]), missing: left }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_product_is_the_covariance() {
        let k = |i: usize, j: usize| (-0.5 * ((i as f64 - j as f64) / 7.0).powi(2)).exp();
        let Factored { columns: l, missing } = factor(60, &k, 1e-14);
        assert!(missing.iter().sum::<f64>() <= 60.0 * 1e-14 && missing.iter().all(|m| *m >= 0.0));
        assert!(l.ncols() < 40, "{} columns", l.ncols());
        let product = &l * l.transpose();
        for i in 0..60 {
            for j in 0..60 {
                assert!((product[(i, j)] - k(i, j)).abs() < 1e-6, "{i} {j}");
            }
        }
    }
}
