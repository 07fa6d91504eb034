//! The most plausible curve that is nowhere negative.
//!
//! ```text
//! min |x|²   subject to   m + F x ≥ 0 at every node      F Fᵀ = covariance, m = mean
//! ```
//!
//! That is the curve nearest to the mean in units of its own uncertainty. Most nodes are far from zero and constrain nothing: the programme is solved for
//! the nodes where the mean is negative, and again with those that became so. With `F = Rᵀ Qᵀ` on these nodes `x = Q y`, and `|x| = |y|`: as
//! many unknowns as nodes. Entries of the solution are clipped at zero: the solver leaves them at 1e-13 of the peak.
//!
//! Source: Goulart, Chen, Clarabel (2024), an interior-point method for conic programs.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettingsBuilder, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};
use nalgebra::{DMatrix, DVector};

/// Below this share of the peak a node counts as negative, and is constrained in the next round.
const NEGATIVE: f64 = 1e-9;
/// Rounds after which every node is constrained.
const ROUNDS: usize = 12;

/// A curve that is nowhere negative, and whether the solver met its own tolerances.
#[derive(Clone, Debug, PartialEq)]
pub struct NonNegative {
    /// The curve.
    pub curve: DVector<f64>,
    /// Whether the solution is accurate only to the looser tolerances of the solver.
    pub almost: bool,
}

/// The nearest curve to `mean` that is nowhere negative; `root` is a square root of its covariance.
///
/// # Errors
/// What the solver says if it finds none.
///
/// ```
/// use etendue::calibration::non_negative::nearest;
/// use nalgebra::{DMatrix, DVector};
///
/// let found = nearest(&DVector::from_vec(vec![1.0, -0.5]), &DMatrix::identity(2, 2))?;
/// assert!((found.curve[0] - 1.0).abs() < 1e-6 && found.curve[1].abs() < 1e-6);
/// # Ok::<(), String>(())
/// ```
pub fn nearest(mean: &DVector<f64>, root: &DMatrix<f64>) -> Result<NonNegative, String> {
    let peak = mean.amax();
    if mean.min() >= 0.0 || peak == 0.0 {
        return Ok(NonNegative { curve: mean.clone(), almost: false });
    }
    let n = mean.len();
    let mut constrained: Vec<bool> = mean.iter().map(|m| *m < 0.0).collect();
    for round in 0..=ROUNDS {
        let nodes: Vec<usize> = (0..n).filter(|i| constrained[*i]).collect();
        let (curve, almost) = solved(mean, root, &nodes, peak)?;
        let mut more = false;
        for i in 0..n {
            if curve[i] < -NEGATIVE * peak && !constrained[i] {
                constrained[i] = true;
                more = true;
            }
        }
        if !more {
            return Ok(NonNegative { curve: curve.map(|s| s.max(0.0)), almost });
        }
        if round + 1 == ROUNDS {
            constrained.fill(true);
        }
    }
    Err("the nodes at zero keep changing".to_owned())
}

/// The nearest curve that is not negative at these nodes.
fn solved(mean: &DVector<f64>, root: &DMatrix<f64>, nodes: &[usize], peak: f64) -> Result<(DVector<f64>, bool), String> {
    let qr = DMatrix::from_fn(root.ncols(), nodes.len(), |j, i| root[(nodes[i], j)]).qr();
    let (q, r) = (qr.q(), qr.r());
    let (a, k) = (nodes.len(), r.nrows());
    // A little of everything everywhere, so that a solution exists however few directions the covariance has.
    let slack = 1e-9 * peak.max(root.amax());
    let variables = k + a;
    let objective = CscMatrix::identity(variables);
    let (mut starts, mut rows, mut values) = (vec![0], Vec::new(), Vec::new());
    for j in 0..k {
        for i in j..a {
            rows.push(i);
            values.push(-r[(j, i)] / peak);
        }
        starts.push(rows.len());
    }
    for i in 0..a {
        rows.push(i);
        values.push(-slack / peak);
        starts.push(rows.len());
    }
    let constraints = CscMatrix::new(a, variables, starts, rows, values);
    let bounds: Vec<f64> = nodes.iter().map(|i| mean[*i] / peak).collect();
    let settings = DefaultSettingsBuilder::default().verbose(false).max_iter(200).build().map_err(|e| e.to_string())?;
    let cones = [SupportedConeT::NonnegativeConeT(a)];
    let mut solver =
        DefaultSolver::new(&objective, &vec![0.0; variables], &constraints, &bounds, &cones, settings).map_err(|e| e.to_string())?;
    solver.solve();
    let almost = match solver.solution.status {
        SolverStatus::Solved => false,
        SolverStatus::AlmostSolved => true,
        other => return Err(format!("{other:?}")),
    };
    let x = &solver.solution.x;
    let mut curve = mean + root * (&q * DVector::from_column_slice(&x[..k]));
    for (i, node) in nodes.iter().enumerate() {
        curve[*node] += slack * x[k + i];
    }
    Ok((curve, almost))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The conditions of Karush, Kuhn and Tucker: x = Fᵀ ν with ν ≥ 0, and ν only where the curve is zero.
    #[test]
    fn the_curve_is_the_nearest_one() {
        let n = 60;
        let kernel = |i: usize, j: usize| (-0.5 * ((i as f64 - j as f64) / 6.0).powi(2)).exp() + if i == j { 1e-3 } else { 0.0 };
        let covariance = DMatrix::from_fn(n, n, kernel);
        let mean = DVector::from_fn(n, |i, _| (i as f64 / 7.0).sin() - 0.2);
        let root = covariance.clone().cholesky().map(|c| c.l()).unwrap_or_else(|| DMatrix::zeros(n, n));
        let found = nearest(&mean, &root).unwrap_or_else(|e| panic!("{e}"));
        assert!(found.curve.min() >= 0.0 && !found.almost);
        let multipliers = covariance.lu().solve(&(&found.curve - &mean)).unwrap_or_else(|| DVector::zeros(n));
        for i in 0..n {
            assert!(multipliers[i] > -1e-4, "node {i}: {}", multipliers[i]);
            assert!(multipliers[i].abs() * found.curve[i] < 1e-5, "node {i}: {} at {}", multipliers[i], found.curve[i]);
        }
        assert!((0..n).filter(|i| found.curve[*i] == 0.0 || multipliers[*i] > 1e-4).count() > 3);
    }
}
