//! Numbers of Poisson's distribution, exact for any mean.
//!
//! ```text
//! P(n) = e^−μ μⁿ / n!
//! ln P(n) = −μ D(n/μ) − δ(n) − ½ ln 2πn,   D(x) = x ln x + 1 − x
//! ```
//!
//! | mean | method |
//! |---|---|
//! | below [`SMALL_MEAN`] | inversion: one number, terms summed from 0 |
//! | above | transformed rejection with squeeze, PTRS: about 1.1 pairs of numbers |
//!
//! `δ(n)` is the error of Stirling's formula; with `D` the logarithm keeps its digits where `n ln μ − ln n!` would cancel.
//!
//! Sources: W. Hörmann, Insurance: Mathematics and Economics 12 (1993) 39 (PTRS); C. Loader, *Fast and accurate computation of binomial
//! probabilities* (2000).

use crate::math::random::Stream;
use std::f64::consts::PI;

/// Means below are drawn by inversion.
const SMALL_MEAN: f64 = 10.0;

/// Below the smallest distance of a uniform number from 1.
const NEGLIGIBLE: f64 = 1e-17;

/// 32 bits as a number in (0, 1).
#[inline(always)]
fn unit_interval(x: u32) -> f64 {
    (f64::from(x) + 0.5) * (1.0 / 4_294_967_296.0)
}

/// A number of Poisson's distribution of the finite `mean`, 0 or more, from the numbers of `stream` that follow `first`.
#[inline]
pub(super) fn poisson(mean: f64, stream: Stream, first: u64) -> f64 {
    if mean < SMALL_MEAN { by_inversion(mean, stream.bits(first)) } else { by_rejection(mean, stream, first) }
}

fn by_inversion(mean: f64, bits: u64) -> f64 {
    let mut left = ((bits >> 12) as f64 + 0.5) * (1.0 / (1u64 << 52) as f64);
    let (mut n, mut term) = (0.0, (-mean).exp());
    // Terms past the mean that are below the spacing of `left` end the search: what is left then is the rounding of the sum.
    while left > term && (n < mean || term > NEGLIGIBLE) {
        left -= term;
        n += 1.0;
        term *= mean / n;
    }
    n
}

fn by_rejection(mean: f64, stream: Stream, first: u64) -> f64 {
    let b = 0.931 + 2.53 * mean.sqrt();
    let a = -0.059 + 0.02483 * b;
    let squeeze = 0.9277 - 3.6224 / (b - 2.0);
    let mut counter = first;
    loop {
        let bits = stream.bits(counter);
        counter += 1;
        let (u, v) = (unit_interval((bits >> 32) as u32) - 0.5, unit_interval(bits as u32));
        let edge = 0.5 - u.abs();
        let n = ((2.0 * a / edge + b) * u + mean + 0.43).floor();
        if edge >= 0.07 && v <= squeeze {
            return n;
        }
        if n < 0.0 || (edge < 0.013 && v > edge) {
            continue;
        }
        let inverse_alpha = 1.1239 + 1.1328 / (b - 3.4);
        if (v * inverse_alpha / (a / (edge * edge) + b)).ln() <= ln_probability(n, mean) {
            return n;
        }
    }
}

/// ln P(n) of the mean `mean` above 0, for a whole number n, 0 or more.
fn ln_probability(n: f64, mean: f64) -> f64 {
    if n == 0.0 {
        return -mean;
    }
    -deviance(n, mean) - stirling_error(n) - 0.5 * (2.0 * PI * n).ln()
}

/// `n ln(n/μ) + μ − n`.
fn deviance(n: f64, mean: f64) -> f64 {
    let difference = n - mean;
    if difference.abs() >= 0.1 * (n + mean) {
        return n * (n / mean).ln() - difference;
    }
    // ln(n/μ) = 2 artanh v.
    let v = difference / (n + mean);
    let (mut sum, mut term, mut odd) = (difference * v, 2.0 * n * v, 1.0);
    loop {
        term *= v * v;
        odd += 2.0;
        let next = sum + term / odd;
        if next == sum {
            return sum;
        }
        sum = next;
    }
}

/// `ln n! − ((n + ½) ln n − n + ½ ln 2π)`, n at least 1.
fn stirling_error(n: f64) -> f64 {
    if n < 16.0 {
        let factorial: f64 = (2..=n as u32).map(f64::from).product();
        return factorial.ln() - ((n + 0.5) * n.ln() - n + 0.5 * (2.0 * PI).ln());
    }
    let r = 1.0 / (n * n);
    (1.0 / 12.0 - r * (1.0 / 360.0 - r * (1.0 / 1260.0 - r / 1680.0))) / n
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metrology::distribution::chi_squared_quantile;

    #[test]
    fn the_logarithm_of_the_probability_is_that_of_its_recurrence() {
        for mean in [10.0, 25.5, 1e3, 1e6] {
            let top = f64::floor(mean);
            let whole: f64 = (0..)
                .map(|i| top + f64::from(i))
                .map(|n| ln_probability(n, mean).exp())
                .take_while(|p| *p > 1e-18)
                .chain(
                    (1..)
                        .map(|i| top - f64::from(i))
                        .take_while(|n| *n >= 0.0)
                        .map(|n| ln_probability(n, mean).exp())
                        .take_while(|p| *p > 1e-18),
                )
                .sum();
            assert!((whole - 1.0).abs() < 1e-11, "{mean}: {whole}");
            for n in [1.0, 15.0, 16.0, top, top * 1.3 + 1.0] {
                let step = ln_probability(n + 1.0, mean) - ln_probability(n, mean);
                assert!((step - (mean / (n + 1.0)).ln()).abs() < 1e-9 * (1.0 + mean / n), "{mean} {n}");
            }
        }
    }

    /// Bins of at least `least` expected draws, and χ² of what was found in them.
    fn chi_squared(mean: f64, draws: u64, least: f64) -> (f64, f64) {
        let stream = Stream::new(1288, &[mean.to_bits()]);
        let mut counts = std::collections::BTreeMap::new();
        for i in 0..draws {
            *counts.entry(poisson(mean, stream.child(i), 0) as i64).or_insert(0u64) += 1;
        }
        let reach = 12.0 * mean.sqrt() + 40.0;
        let (low, high) = ((mean - reach).max(0.0) as i64, (mean + reach) as i64);
        let (first, last) = (*counts.keys().next().unwrap(), *counts.keys().last().unwrap());
        assert!(first >= low && last <= high, "{mean}: {first} … {last}");
        let (mut sum, mut bins, mut expected, mut found) = (0.0, 0.0, 0.0, 0.0);
        for n in low..=high {
            let p = if n == 0 { (-mean).exp() } else { ln_probability(n as f64, mean).exp() };
            expected += p * draws as f64;
            found += counts.get(&n).copied().unwrap_or(0) as f64;
            if expected >= least {
                sum += (found - expected).powi(2) / expected;
                (bins, expected, found) = (bins + 1.0, 0.0, 0.0);
            }
        }
        (sum, bins - 1.0)
    }

    #[test]
    fn draws_follow_the_distribution_for_small_and_large_means() {
        for mean in [0.02, 0.7, 3.0, 9.99, 10.0, 10.5, 27.0, 400.0, 2.5e4, 3e6] {
            let (found, dof) = chi_squared(mean, 400_000, 200.0);
            assert!(dof >= 1.0, "{mean}");
            let (low, high) = (chi_squared_quantile(1e-4, dof).unwrap(), chi_squared_quantile(1.0 - 1e-4, dof).unwrap());
            assert!((low..high).contains(&found), "mean {mean}: χ² {found} of {dof} degrees of freedom, {low} … {high}");
        }
    }

    #[test]
    fn no_light_is_no_electron() {
        assert!((0..1000).all(|i| poisson(0.0, Stream::new(1, &[i]), 0) == 0.0));
    }

    #[test]
    fn the_smallest_and_largest_bits_end_the_search() {
        assert_eq!(by_inversion(9.9, 0), 0.0);
        let most = by_inversion(9.9, u64::MAX);
        assert!((40.0..60.0).contains(&most), "{most}");
    }
}
