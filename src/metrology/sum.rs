//! A sum that keeps small terms beside large ones.
//!
//! ```text
//! t = s + x;   c ← c + ((larger − t) + smaller);   s ← t;   value = s + c
//! ```
//!
//! The bracket is the part of the smaller of `s` and `x` that the addition lost, and it is exact. The error of the
//! value is about one unit in the last place of the sum plus n² ε² Σ|x|.
//!
//! Source: A. Neumaier, Zeitschrift für Angewandte Mathematik und Mechanik 54 (1974) 39.

/// A running sum with a compensation for what its additions lose.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CompensatedSum {
    sum: f64,
    compensation: f64,
}

impl CompensatedSum {
    /// The sum of nothing.
    pub const fn new() -> Self {
        Self { sum: 0.0, compensation: 0.0 }
    }

    /// Adds one term.
    pub fn add(&mut self, term: f64) {
        let total = self.sum + term;
        self.compensation += if self.sum.abs() >= term.abs() { (self.sum - total) + term } else { (term - total) + self.sum };
        self.sum = total;
    }

    /// Adds all terms of another sum.
    pub fn merge(&mut self, other: &Self) {
        self.add(other.sum);
        self.compensation += other.compensation;
    }

    /// The sum. Infinite when a term or the running sum was, NaN when a term was NaN or both infinities met.
    pub fn value(&self) -> f64 {
        if self.sum.is_finite() {
            self.sum + self.compensation
        } else {
            // Beside an infinite sum the compensation is the NaN of ∞ − ∞.
            self.sum
        }
    }
}

impl Extend<f64> for CompensatedSum {
    fn extend<I: IntoIterator<Item = f64>>(&mut self, terms: I) {
        for term in terms {
            self.add(term);
        }
    }
}

impl FromIterator<f64> for CompensatedSum {
    fn from_iter<I: IntoIterator<Item = f64>>(terms: I) -> Self {
        let mut sum = Self::new();
        sum.extend(terms);
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_million_thousandths_beside_ten_million_million_are_kept() {
        let large_first: CompensatedSum = std::iter::once(1e13).chain(std::iter::repeat_n(1e-3, 1_000_000)).collect();
        assert_eq!(large_first.value(), 1e13 + 1e3);
        let mut large_last: CompensatedSum = std::iter::repeat_n(1e-3, 1_000_000).collect();
        large_last.add(1e13);
        assert_eq!(large_last.value(), 1e13 + 1e3);
        let plain = (0..1_000_000).fold(1e13, |s, _| s + 1e-3);
        assert!((plain - 1e13 - 1e3f64).abs() > 1.0, "a plain sum loses them");
    }

    #[test]
    fn a_term_that_cancels_leaves_the_rest() {
        let sum: CompensatedSum = [1.0, 1e100, 1.0, -1e100].into_iter().collect();
        assert_eq!(sum.value(), 2.0);
    }

    #[test]
    fn infinities_are_reported_and_not_turned_into_nan() {
        let sum: CompensatedSum = [1.0, f64::INFINITY, 1.0].into_iter().collect();
        assert_eq!(sum.value(), f64::INFINITY);
        let sum: CompensatedSum = [f64::MAX, f64::MAX].into_iter().collect();
        assert_eq!(sum.value(), f64::INFINITY);
        let sum: CompensatedSum = [f64::INFINITY, f64::NEG_INFINITY].into_iter().collect();
        assert!(sum.value().is_nan());
    }

    proptest! {
        #[test]
        fn the_sum_of_integers_with_a_large_pair_is_exact(
            terms in prop::collection::vec(-1_000_000i64..1_000_000, 0..200),
            cut in 0usize..200,
            exponent in 30i32..150,
        ) {
            let large = 2f64.powi(exponent);
            let mut floats: Vec<f64> = terms.iter().map(|&t| t as f64).collect();
            floats.insert(floats.len() / 3, large);
            floats.push(-large);
            let exact = terms.iter().sum::<i64>() as f64;
            let whole: CompensatedSum = floats.iter().copied().collect();
            prop_assert_eq!(whole.value(), exact);
            let (a, b) = floats.split_at(cut.min(floats.len()));
            let mut a: CompensatedSum = a.iter().copied().collect();
            a.merge(&b.iter().copied().collect());
            prop_assert_eq!(a.value(), exact);
        }
    }
}
