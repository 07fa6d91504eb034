//! Least squares of a function that is not linear: Levenberg and Marquardt.
//!
//! ```text
//! min |r(p)|²      step δ:  (JᵀJ + μ D) δ = −Jᵀ r       solved as  [J; √μ √D] δ = [−r; 0]  by QR
//! μ follows the gain  (|r|² − |r(p + δ)|²) / (|r|² − |r + J δ|²);       D: the largest squares of the columns of J so far
//! ```
//!
//! Derivatives are central differences. The crate `levenberg-marquardt` would serve, but its newest version holds to nalgebra 0.34, and two versions of
//! one linear algebra are worse than this loop.
//!
//! Source: Moré, Lecture Notes in Mathematics 630 (1978) 105; damping: Nielsen, IMM-REP-1999-05.

use nalgebra::{DMatrix, DVector};

/// Steps after which it is given up.
const STEPS: usize = 400;
/// Steps below this share of a parameter's natural size end the search.
const SMALL_STEP: f64 = 1e-9;
/// Predicted relative gains below this end the search: a thousandth of what rounding leaves of a square.
const SMALL_GAIN: f64 = 1e-13;
/// First damping.
const DAMPING: f64 = 1e-3;
/// Damping beyond which no step helps.
const STUCK: f64 = 1e20;

/// Residuals as a function of the parameters; `None` where the function is not defined.
pub type Residuals<'a> = dyn Fn(&DVector<f64>) -> Option<DVector<f64>> + 'a;

/// Where the search ended.
#[derive(Clone, Debug)]
pub struct Minimum {
    /// The parameters.
    pub parameters: DVector<f64>,
    /// `|r|²`.
    pub square: f64,
    /// Whether the steps or the gains became small, rather than the patience.
    pub converged: bool,
    /// Steps that were tried.
    pub steps: usize,
}

/// The minimum that a start leads to; `sizes` are natural sizes of the parameters, above zero. `None` if the function is not defined at the start.
///
/// ```
/// use etendue::calibration::least_squares::minimise;
/// use nalgebra::DVector;
///
/// // Rosenbrock's valley.
/// let residuals = |p: &DVector<f64>| Some(DVector::from_vec(vec![10.0 * (p[1] - p[0] * p[0]), 1.0 - p[0]]));
/// let sizes = DVector::from_element(2, 1.0);
/// let found = minimise(&residuals, &DVector::from_vec(vec![-1.2, 1.0]), &sizes).unwrap();
/// assert!(found.converged && (found.parameters[0] - 1.0).abs() < 1e-8 && found.square < 1e-16);
/// ```
#[must_use]
pub fn minimise(residuals: &Residuals, start: &DVector<f64>, sizes: &DVector<f64>) -> Option<Minimum> {
    let mut p = start.clone();
    let mut r = residuals(&p).filter(|r| r.iter().all(|x| x.is_finite()))?;
    let (mut mu, mut grows) = (DAMPING, 2.0);
    let mut scale = DVector::<f64>::zeros(p.len());
    let mut j = jacobian(residuals, &p, sizes, r.len())?;
    for step in 1..=STEPS {
        let ended = |p: DVector<f64>, square: f64, converged: bool| Some(Minimum { parameters: p, square, converged, steps: step });
        for (k, column) in j.column_iter().enumerate() {
            scale[k] = scale[k].max(column.norm_squared());
        }
        let largest = scale.max();
        if largest == 0.0 || r.norm_squared() == 0.0 {
            return ended(p, r.norm_squared(), true);
        }
        // A parameter that moves nothing is held where it is.
        let held = scale.map(|s| (mu * s.max(f64::EPSILON * largest)).sqrt());
        let Some(delta) = solved(&j, &held, &r) else { return ended(p, r.norm_squared(), false) };
        let square = r.norm_squared();
        let predicted = square - (&r + &j * &delta).norm_squared();
        let small = delta.iter().zip(p.iter().zip(sizes.iter())).all(|(d, (p, s))| d.abs() <= SMALL_STEP * (s + p.abs() * 1e-3));
        if small || predicted <= SMALL_GAIN * square {
            return ended(p, square, true);
        }
        let next = &p + &delta;
        let at_next = residuals(&next).filter(|r| r.iter().all(|x| x.is_finite()));
        let gain = at_next.as_ref().map_or(-1.0, |r| (square - r.norm_squared()) / predicted);
        match at_next.filter(|_| gain > 0.0) {
            Some(better) => {
                (p, r) = (next, better);
                j = jacobian(residuals, &p, sizes, r.len())?;
                mu *= (1.0 - (2.0 * gain - 1.0).powi(3)).max(1.0 / 3.0);
                grows = 2.0;
            }
            None => {
                mu *= grows;
                grows *= 2.0;
                if mu > STUCK {
                    return ended(p, square, false);
                }
            }
        }
    }
    let square = r.norm_squared();
    Some(Minimum { parameters: p, square, converged: false, steps: STEPS })
}

/// The solution of `[J; diag(held)] δ = [−r; 0]`.
fn solved(j: &DMatrix<f64>, held: &DVector<f64>, r: &DVector<f64>) -> Option<DVector<f64>> {
    let (m, n) = j.shape();
    let stacked = DMatrix::from_fn(m + n, n, |i, k| match i.checked_sub(m) {
        None => j[(i, k)],
        Some(i) if i == k => held[k],
        Some(_) => 0.0,
    });
    let right = DVector::from_fn(m + n, |i, _| if i < m { -r[i] } else { 0.0 });
    let qr = stacked.qr();
    let delta = qr.r().solve_upper_triangular(&(qr.q().transpose() * right))?;
    delta.iter().all(|d| d.is_finite()).then_some(delta)
}

/// Derivatives by central differences, one-sided where the function ends.
#[must_use]
pub fn jacobian(function: &Residuals, p: &DVector<f64>, sizes: &DVector<f64>, rows: usize) -> Option<DMatrix<f64>> {
    let mut j = DMatrix::zeros(rows, p.len());
    let here = function(p)?;
    for k in 0..p.len() {
        let h = f64::EPSILON.cbrt() * sizes[k];
        let at = |by: f64| {
            let mut shifted = p.clone();
            shifted[k] += by;
            function(&shifted).map(|r| (r, shifted[k]))
        };
        let (up, down) = (at(h), at(-h));
        let ((high, to), (low, from)) = match (up, down) {
            (Some(up), Some(down)) => (up, down),
            (Some(up), None) => (up, (here.clone(), p[k])),
            (None, Some(down)) => ((here.clone(), p[k]), down),
            (None, None) => return None,
        };
        j.set_column(k, &((high - low) / (to - from)));
    }
    Some(j)
}
