//! Quantiles of the normal, Student's t and χ² distributions; density and cumulative probability of the normal one.
//!
//! ```text
//! normal   Φ(z) = p            z = −√2 erfc⁻¹(2p)
//! t        P(|T| > t) = I_x(ν/2, 1/2),   x = ν/(ν + t²)
//! χ²       P(X < c) = P(ν/2, c/2)
//! ```
//!
//! The incomplete beta and gamma functions are those of `statrs`; they are inverted here by a Newton iteration inside a
//! bracket, on a logarithmic axis, because degrees of freedom below one put the quantiles at powers of ten that no
//! linear search reaches. Far in a tail the leading term of the series is exact to rounding and is used instead; for
//! many degrees of freedom the expansion in 1/ν is. Relative accuracy 1e-10 or better for p in 1e-15..1 − 1e-15.
//!
//! Sources: M. Abramowitz, I. A. Stegun, *Handbook of Mathematical Functions*, 26.5, 26.7.5; H. Goldberg, H. Levine,
//! Annals of Mathematical Statistics 17 (1946) 216.

use statrs::function::{beta, erf, gamma};
use std::f64::consts::{LN_2, PI, SQRT_2};

/// From here on the expansion in 1/ν of Student's t is closer than the incomplete beta function.
const MANY_DEGREES_STUDENT: f64 = 1e3;
/// From here on the expansion in 1/√ν of χ² is closer than the incomplete gamma function.
const MANY_DEGREES_CHI_SQUARED: f64 = 1e4;
/// Below this argument the series of the incomplete functions is its first two terms.
const LEADING_TERM: f64 = 1e-9;
/// Bisection alone would need this many halvings of the bracket to reach rounding.
const ITERATIONS: usize = 200;

fn is_open_probability(p: f64) -> bool {
    p > 0.0 && p < 1.0
}

/// The `z` that a standard normal variable stays below with probability `p`.
/// `None` unless 0 < p < 1. `normal_quantile(0.975)` is 1.959964.
pub fn normal_quantile(p: f64) -> Option<f64> {
    // The smaller tail is inverted: there 1 − p is exact and erfc keeps its digits.
    if !is_open_probability(p) {
        None
    } else if p <= 0.5 {
        Some(-SQRT_2 * erf::erfc_inv(2.0 * p))
    } else {
        Some(SQRT_2 * erf::erfc_inv(2.0 * (1.0 - p)))
    }
}

/// Probability density of a standard normal variable at `z`.
pub fn normal_density(z: f64) -> f64 {
    (-0.5 * z * z).exp() / (2.0 * PI).sqrt()
}

/// Probability that a standard normal variable stays below `z`. Small probabilities keep their digits.
pub fn normal_cumulative(z: f64) -> f64 {
    0.5 * erf::erfc(-z / SQRT_2)
}

/// The `t` that a variable of Student's distribution with `dof` degrees of freedom stays below with probability `p`.
///
/// `dof` is any number above zero, infinity included (then the normal quantile). For a `dof` of a few thousandths the
/// quantile can exceed the range of `f64`; it is then infinite. `None` unless 0 < p < 1 and dof > 0.
pub fn student_t_quantile(p: f64, dof: f64) -> Option<f64> {
    if !is_open_probability(p) || dof.is_nan() || dof <= 0.0 {
        return None;
    }
    if p == 0.5 {
        return Some(0.0);
    }
    let (tail, sign) = if p < 0.5 { (p, -1.0) } else { (1.0 - p, 1.0) };
    let t = if dof >= MANY_DEGREES_STUDENT { student_t_of_normal(-normal_quantile(tail)?, dof) } else { student_t_of_tail(tail, dof) };
    Some(sign * t)
}

/// Expansion of the quantile in 1/ν about the normal one, A&S 26.7.5.
fn student_t_of_normal(z: f64, dof: f64) -> f64 {
    let w = z * z;
    let g1 = z * (w + 1.0) / 4.0;
    let g2 = z * ((5.0 * w + 16.0) * w + 3.0) / 96.0;
    let g3 = z * (((3.0 * w + 19.0) * w + 17.0) * w - 15.0) / 384.0;
    let g4 = z * ((((79.0 * w + 776.0) * w + 1482.0) * w - 1920.0) * w - 945.0) / 92160.0;
    let r = 1.0 / dof;
    z + r * (g1 + r * (g2 + r * (g3 + r * g4)))
}

/// The t above zero whose upper tail is `tail` < 1/2, for fewer than [`MANY_DEGREES_STUDENT`].
fn student_t_of_tail(tail: f64, dof: f64) -> f64 {
    let a = 0.5 * dof;
    let ln_beta = gamma::ln_gamma(a) + gamma::ln_gamma(0.5) - gamma::ln_gamma(a + 0.5);
    let ln_two_tails = LN_2 + tail.ln();
    // Far tail: I_x(a, 1/2) = x^a / (a B) (1 + x a / (2 (a + 1)) + …).
    let ln_x = (ln_two_tails + a.ln() + ln_beta) / a;
    if ln_x < LEADING_TERM.ln() {
        // t² = ν (1/x − 1), to first order in x.
        let correction = 1.0 + ln_x.exp() * (0.25 / (a + 1.0) - 0.5);
        return (0.5 * (dof.ln() - ln_x)).exp() * correction;
    }
    // Unknown w = ln(t²/ν), so that x = 1/(1 + e^w) and its complement are both free of cancellation.
    // The smaller of tail and centre is compared, for the same reason.
    let centre = 1.0 - 2.0 * tail;
    let by_tail = 2.0 * tail < centre;
    let residual = |w: f64| {
        let (x, y) = (1.0 / (1.0 + w.exp()), 1.0 / (1.0 + (-w).exp()));
        // d I_x(a, 1/2) / dw = −x^a √y / B.
        let density = (a * x.ln() + 0.5 * y.ln() - ln_beta).exp();
        if by_tail {
            let found = beta::checked_beta_reg(a, 0.5, x).unwrap_or(f64::NAN);
            ((2.0 * tail / found).ln(), density / found)
        } else {
            let found = beta::checked_beta_reg(0.5, a, y).unwrap_or(f64::NAN);
            ((found / centre).ln(), density / found)
        }
    };
    let w = increasing_root(residual, -90.0 - dof.ln().abs(), 90.0);
    dof.sqrt() * (0.5 * w).exp()
}

/// The `c` that a χ² variable with `dof` degrees of freedom stays below with probability `p`.
///
/// For a `dof` of a few thousandths the quantile can fall below the range of `f64`; it is then zero.
/// `None` unless 0 < p < 1 and 0 < dof < ∞. `chi_squared_quantile(0.05, 15.0)` is 7.26094.
pub fn chi_squared_quantile(p: f64, dof: f64) -> Option<f64> {
    if !is_open_probability(p) || !dof.is_finite() || dof <= 0.0 {
        return None;
    }
    if dof >= MANY_DEGREES_CHI_SQUARED {
        return Some(chi_squared_of_normal(normal_quantile(p)?, dof));
    }
    let a = 0.5 * dof;
    let ln_gamma = gamma::ln_gamma(a);
    // Near zero: P(a, x) = x^a / Γ(a + 1) (1 − x a / (a + 1) + …).
    let ln_x = (p.ln() + a.ln() + ln_gamma) / a;
    if ln_x < LEADING_TERM.ln() {
        let x = ln_x.exp();
        return Some(2.0 * x * (1.0 + x / (a + 1.0)));
    }
    let upper = 1.0 - p;
    let by_lower = p <= 0.5;
    // Unknown w = ln x; d P(a, e^w) / dw = x^a e^−x / Γ(a).
    let residual = |w: f64| {
        let x = w.exp();
        let density = (a * w - x - ln_gamma).exp();
        if by_lower {
            let found = gamma::checked_gamma_lr(a, x).unwrap_or(f64::NAN);
            ((found / p).ln(), density / found)
        } else {
            let found = gamma::checked_gamma_ur(a, x).unwrap_or(f64::NAN);
            ((upper / found).ln(), density / found)
        }
    };
    // x lies above its leading term, and below a + 750 even for the smallest p and 1 − p that a double can hold.
    let w = increasing_root(residual, ln_x, (2.0 * a + 1500.0).ln());
    Some(2.0 * w.exp())
}

/// Expansion of the quantile in 1/√ν about the normal one (Goldberg and Levine).
fn chi_squared_of_normal(z: f64, dof: f64) -> f64 {
    let w = z * z;
    let root = (2.0 * dof).sqrt();
    dof + root * z + 2.0 / 3.0 * (w - 1.0) + z * (w - 7.0) / (9.0 * root) - ((6.0 * w + 14.0) * w - 32.0) / (405.0 * dof)
        + z * ((9.0 * w + 256.0) * w - 433.0) / (4860.0 * SQRT_2 * dof * dof.sqrt())
}

/// The root of an increasing function between `low` and `high`; `residual` returns value and derivative.
/// A Newton step that leaves the bracket, or that is not a number, is replaced by a bisection.
fn increasing_root(residual: impl Fn(f64) -> (f64, f64), mut low: f64, mut high: f64) -> f64 {
    let mut at = 0.5 * (low + high);
    for _ in 0..ITERATIONS {
        let (value, slope) = residual(at);
        if value < 0.0 {
            low = at;
        } else {
            high = at;
        }
        let newton = at - value / slope;
        // A step below the rounding of its argument may leave the bracket and still is the end of the search.
        if (newton - at).abs() <= f64::EPSILON * at.abs().max(1.0) {
            return newton;
        }
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if next == at {
            return at;
        }
        at = next;
    }
    at
}

#[cfg(test)]
mod tests;
