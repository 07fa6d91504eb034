//! Gauss–Legendre rules: `∫₋₁¹ p(x) dx = Σ wᵢ p(xᵢ)` exactly for polynomials of degree `2n − 1`.
//!
//! Nodes by Newton's method on `Pₙ` from `cos(π(i + ¾)/(n + ½))`, weights `2/((1 − x²) P′ₙ(x)²)`
//! (Abramowitz and Stegun 25.4.29). All nodes are interior, so a jump at the end of a segment is never evaluated.

use std::sync::OnceLock;

/// The largest number of nodes that [`rule`] offers.
pub(super) const MAX_NODES: usize = 32;

/// (node, weight) on (-1, 1) for `nodes` = 1..=[`MAX_NODES`]; other numbers are clamped to that range.
pub(super) fn rule(nodes: usize) -> &'static [(f64, f64)] {
    static RULES: OnceLock<Vec<Vec<(f64, f64)>>> = OnceLock::new();
    let rules = RULES.get_or_init(|| (1..=MAX_NODES).map(compute).collect());
    &rules[nodes.clamp(1, MAX_NODES) - 1]
}

/// `Pₙ(x)` and its derivative, by the three-term recurrence.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut previous, mut current) = (1.0, x);
    for k in 2..=n {
        let k = k as f64;
        let next = ((2.0 * k - 1.0) * x * current - (k - 1.0) * previous) / k;
        (previous, current) = (current, next);
    }
    (current, n as f64 * (x * current - previous) / (x * x - 1.0))
}

fn compute(n: usize) -> Vec<(f64, f64)> {
    let mut nodes = Vec::with_capacity(n);
    for i in 0..n {
        let mut x = (std::f64::consts::PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
        // Newton converges quadratically from this start; eight steps are more than twice what n = 32 needs.
        for _ in 0..8 {
            let (value, slope) = legendre(n, x);
            x -= value / slope;
        }
        let (_, slope) = legendre(n, x);
        nodes.push((x, 2.0 / ((1.0 - x * x) * slope * slope)));
    }
    nodes.sort_by(|a, b| a.0.total_cmp(&b.0));
    nodes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_up_to_degree_2n_minus_1_are_exact() {
        for n in 1..=MAX_NODES {
            for degree in 0..2 * n {
                let sum: f64 = rule(n).iter().map(|(x, w)| w * x.powi(degree as i32)).sum();
                let exact = if degree % 2 == 0 { 2.0 / (degree as f64 + 1.0) } else { 0.0 };
                assert!((sum - exact).abs() < 1e-14, "n = {n}, degree = {degree}: {sum} against {exact}");
            }
        }
    }
}
