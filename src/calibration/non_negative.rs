//! The most plausible curve that is nowhere negative.
//!
//! ```text
//! min |x|²   subject to   m + F x ≥ 0 at every node      F Fᵀ = covariance, m = mean
//! ```
//!
//! That is the curve nearest to the mean in units of its own uncertainty. Entries of the solution are clipped at zero: the solver leaves
//! them at 1e-13 of the peak.
//!
//! Source: Goulart, Chen, Clarabel (2024), an interior-point method for conic programs.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettingsBuilder, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};
use nalgebra::{DMatrix, DVector};

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
    let (n, k) = root.shape();
    // A little of everything everywhere, so that a solution exists however few directions the covariance has.
    let slack = 1e-9 * peak.max(root.amax());
    let variables = k + n;
    let objective = CscMatrix::identity(variables);
    let (mut starts, mut rows, mut values) = (vec![0], Vec::new(), Vec::new());
    for j in 0..k {
        for i in 0..n {
            rows.push(i);
            values.push(-root[(i, j)] / peak);
        }
        starts.push(rows.len());
    }
    for i in 0..n {
        rows.push(i);
        values.push(-slack / peak);
        starts.push(rows.len());
    }
    let constraints = CscMatrix::new(n, variables, starts, rows, values);
    let bounds: Vec<f64> = mean.iter().map(|m| m / peak).collect();
    let settings = DefaultSettingsBuilder::default().verbose(false).max_iter(200).build().map_err(|e| e.to_string())?;
    let cones = [SupportedConeT::NonnegativeConeT(n)];
    let mut solver =
        DefaultSolver::new(&objective, &vec![0.0; variables], &constraints, &bounds, &cones, settings).map_err(|e| e.to_string())?;
    solver.solve();
    let almost = match solver.solution.status {
        SolverStatus::Solved => false,
        SolverStatus::AlmostSolved => true,
        other => return Err(format!("{other:?}")),
    };
    let x = &solver.solution.x;
    let curve = DVector::from_fn(n, |i, _| {
        let moved: f64 = (0..k).map(|j| root[(i, j)] * x[j]).sum();
        (mean[i] + moved + slack * x[k + i]).max(0.0)
    });
    Ok(NonNegative { curve, almost })
}
