//! Real roots of a polynomial in an interval, where it changes its sign.
//!
//! ```text
//! p(t) = Σ cₖ tᵏ,  −1 ≤ t ≤ 1
//! ```
//!
//! Between two neighbouring extrema a polynomial has at most one root, and bisection finds it to the last bit; the extrema are the sign
//! changes of the derivative, found in the same way. Double roots, where the sign stays, are of no interest here.

/// Values of t in [−1, 1] at which a polynomial (ascending coefficients) changes its sign: between the extrema, by bisection.
pub(super) fn sign_changes_in_unit_interval(polynomial: &[f64]) -> Vec<f64> {
    let value = |t: f64| polynomial.iter().rev().fold(0.0, |sum, &coefficient| sum * t + coefficient);
    if polynomial.len() < 2 {
        return Vec::new();
    }
    let derivative: Vec<f64> = polynomial.iter().enumerate().skip(1).map(|(k, &c)| k as f64 * c).collect();
    let mut nodes = vec![-1.0];
    nodes.extend(sign_changes_in_unit_interval(&derivative));
    nodes.push(1.0);
    let mut roots = Vec::new();
    for pair in nodes.windows(2) {
        let (mut low, mut high) = (pair[0], pair[1]);
        let low_positive = value(low) > 0.0;
        if low_positive == (value(high) > 0.0) {
            continue;
        }
        loop {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            if (value(middle) > 0.0) == low_positive {
                low = middle;
            } else {
                high = middle;
            }
        }
        roots.push(0.5 * (low + high));
    }
    roots
}
