//! Count, mean and spread of a series of numbers, accumulated one by one and merged.
//!
//! ```text
//! push:   d = x − m;  m ← m + d/n;  M₂ ← M₂ + d (x − m)
//! merge:  d = m_b − m_a;  m = m_a + d n_b/n;  M₂ = M₂a + M₂b + d² n_a n_b/n
//! s² = M₂ / (n − 1)
//! ```
//!
//! `M₂` is a square and would leave the range of `f64` for values beyond 1e±154. Mean and `M₂` are therefore held in a
//! unit of a power of two near the size of the values, which costs no rounding: where the plain recurrences stay in
//! range, the results are the same bits.
//!
//! Sources: B. P. Welford, Technometrics 4 (1962) 419; T. F. Chan, G. H. Golub, R. J. LeVeque, The American
//! Statistician 37 (1983) 242.

/// Exponents of the unit stay where both 2^e and 2^−e are normal numbers.
const LARGEST_EXPONENT: i32 = 1022;

/// A value may outgrow the unit by this power of two before the unit follows: its square, times any count, is in range.
const HEADROOM: f64 = (1u128 << 100) as f64 * (1u128 << 100) as f64;

/// Count, mean and sum of squared deviations of a series.
///
/// NaN and infinite values are not dropped: they make the results NaN or infinite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moments {
    count: u64,
    /// Mean and sum of squared deviations in units of 2^exponent and its square.
    scaled_mean: f64,
    scaled_m2: f64,
    exponent: i32,
}

impl Default for Moments {
    fn default() -> Self {
        Self::new()
    }
}

/// 2^exponent; below the normal numbers it is zero, above them the largest power of two.
fn power_of_two(exponent: i32) -> f64 {
    if exponent < -1022 {
        return 0.0;
    }
    f64::from_bits(((exponent.min(1023) + 1023) as u64) << 52)
}

/// The binary exponent of `x`, limited to the range of units.
fn unit_exponent(x: f64) -> i32 {
    let biased = ((x.to_bits() >> 52) & 0x7ff) as i32;
    (biased - 1023).clamp(-LARGEST_EXPONENT, LARGEST_EXPONENT)
}

impl Moments {
    /// The moments of no values.
    pub const fn new() -> Self {
        Self {
            count: 0,
            scaled_mean: 0.0,
            scaled_m2: 0.0,
            // The smallest unit: the first value that is not zero sets it.
            exponent: -LARGEST_EXPONENT,
        }
    }

    /// Changes the unit to a larger one.
    fn rescale(&mut self, exponent: i32) {
        // What underflows here is smaller than the rounding of the value that asked for the larger unit.
        let ratio = power_of_two(self.exponent - exponent);
        self.scaled_mean *= ratio;
        self.scaled_m2 = self.scaled_m2 * ratio * ratio;
        self.exponent = exponent;
    }

    /// Adds one value.
    pub fn push(&mut self, value: f64) {
        let mut scaled = value * power_of_two(-self.exponent);
        if scaled.abs() > HEADROOM {
            self.rescale(unit_exponent(value));
            scaled = value * power_of_two(-self.exponent);
        }
        self.count += 1;
        let deviation = scaled - self.scaled_mean;
        self.scaled_mean += deviation / self.count as f64;
        self.scaled_m2 += deviation * (scaled - self.scaled_mean);
    }

    /// Adds all values of another series. Any order of merging gives the same result to rounding.
    pub fn merge(&mut self, other: &Self) {
        if other.count == 0 {
            return;
        }
        if self.count == 0 {
            *self = *other;
            return;
        }
        let mut other = *other;
        let exponent = self.exponent.max(other.exponent);
        self.rescale(exponent);
        other.rescale(exponent);
        let (n_a, n_b) = (self.count as f64, other.count as f64);
        let share_b = n_b / (n_a + n_b);
        let difference = other.scaled_mean - self.scaled_mean;
        self.count += other.count;
        self.scaled_mean += difference * share_b;
        self.scaled_m2 += other.scaled_m2 + difference * difference * n_a * share_b;
    }

    /// Number of values.
    pub const fn count(&self) -> u64 {
        self.count
    }

    /// Arithmetic mean, `None` for an empty series.
    pub fn mean(&self) -> Option<f64> {
        (self.count > 0).then(|| self.scaled_mean * power_of_two(self.exponent))
    }

    /// Experimental standard deviation `s` of one value, with n − 1 degrees of freedom; `None` below two values.
    pub fn standard_deviation(&self) -> Option<f64> {
        (self.count > 1).then(|| (self.scaled_m2 / (self.count - 1) as f64).sqrt() * power_of_two(self.exponent))
    }

    /// Standard uncertainty of the mean, `s / √n` (GUM 4.2.3); `None` below two values.
    pub fn standard_uncertainty_of_mean(&self) -> Option<f64> {
        self.standard_deviation().map(|s| s / (self.count as f64).sqrt())
    }

    /// Experimental variance `s²`; `None` below two values. Leaves the range of `f64` for values beyond 1e±154, where
    /// [`standard_deviation`](Self::standard_deviation) does not.
    pub fn variance(&self) -> Option<f64> {
        self.standard_deviation().map(|s| s * s)
    }
}

impl Extend<f64> for Moments {
    fn extend<I: IntoIterator<Item = f64>>(&mut self, values: I) {
        for value in values {
            self.push(value);
        }
    }
}

impl FromIterator<f64> for Moments {
    fn from_iter<I: IntoIterator<Item = f64>>(values: I) -> Self {
        let mut moments = Self::new();
        moments.extend(values);
        moments
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn close(a: f64, b: f64, scale: f64) -> bool {
        (a - b).abs() <= 1e-13 * scale
    }

    fn values() -> impl Strategy<Value = Vec<f64>> {
        prop::collection::vec(-1.0..1.0f64, 2..60)
    }

    #[test]
    fn mean_and_spread_of_five_numbers() {
        let m: Moments = [2.0, 4.0, 6.0, 8.0, 10.0].into_iter().collect();
        assert_eq!(m.mean(), Some(6.0));
        assert_eq!(m.standard_deviation(), Some(10f64.sqrt()));
        assert_eq!(m.standard_uncertainty_of_mean(), Some(10f64.sqrt() / 5f64.sqrt()));
    }

    #[test]
    fn nothing_is_claimed_of_too_few_values() {
        assert_eq!(Moments::new().mean(), None);
        let one: Moments = [3.0].into_iter().collect();
        assert_eq!(one.mean(), Some(3.0));
        assert_eq!(one.standard_deviation(), None);
    }

    #[test]
    fn the_spread_stays_finite_and_positive_over_the_whole_range_of_f64() {
        let shape = [1.0, 1.25, 0.75, 1.5];
        let one: Moments = shape.into_iter().collect();
        for exponent in [-1020, -997, -600, 0, 600, 997, 1022] {
            let unit = power_of_two(exponent);
            let m: Moments = shape.into_iter().map(|x| x * unit).collect();
            let expected = one.standard_deviation().map(|s| s * unit);
            assert_eq!(m.standard_deviation(), expected, "2^{exponent}");
            assert_eq!(m.mean(), one.mean().map(|x| x * unit));
        }
    }

    #[test]
    fn a_zero_or_tiny_start_does_not_hide_a_huge_value() {
        for first in [0.0, 5e-324, 1e-300] {
            let m: Moments = [first, 1e300].into_iter().collect();
            assert!(close(m.mean().unwrap(), 5e299, 5e299));
            assert!(close(m.standard_deviation().unwrap(), 1e300 / 2f64.sqrt(), 1e300));
        }
    }

    #[test]
    fn a_value_that_is_not_a_number_is_not_hidden() {
        let m: Moments = [1.0, f64::NAN, 2.0].into_iter().collect();
        assert!(m.mean().unwrap().is_nan() && m.standard_deviation().unwrap().is_nan());
        let m: Moments = [1.0, f64::INFINITY, 2.0].into_iter().collect();
        assert!(!m.mean().unwrap().is_finite() && !m.standard_deviation().unwrap().is_finite());
    }

    #[test]
    fn a_small_spread_on_a_large_mean_keeps_its_digits() {
        let m: Moments = [4.0, 7.0, 13.0, 16.0].into_iter().map(|x| x + 1e9).collect();
        assert_eq!(m.variance().map(f64::round), Some(30.0));
        assert!(close(m.variance().unwrap(), 30.0, 30.0));
    }

    proptest! {
        #[test]
        fn merging_is_concatenation(v in values(), cut in 0usize..60, unit in -300i32..300) {
            let unit = 10f64.powi(unit);
            let v: Vec<f64> = v.into_iter().map(|x| x * unit).collect();
            let (a, b) = v.split_at(cut.min(v.len()));
            let whole: Moments = v.iter().copied().collect();
            let (a, b): (Moments, Moments) = (a.iter().copied().collect(), b.iter().copied().collect());
            let (mut ab, mut ba) = (a, b);
            ab.merge(&b);
            ba.merge(&a);
            for merged in [ab, ba] {
                prop_assert_eq!(merged.count(), whole.count());
                prop_assert!(close(merged.mean().unwrap(), whole.mean().unwrap(), unit));
                prop_assert!(close(merged.standard_deviation().unwrap(), whole.standard_deviation().unwrap(), unit));
            }
        }

        #[test]
        fn moments_agree_with_two_passes(v in values()) {
            let n = v.len() as f64;
            let mean = v.iter().sum::<f64>() / n;
            let variance = v.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n - 1.0);
            let m: Moments = v.into_iter().collect();
            prop_assert!(close(m.mean().unwrap(), mean, 1.0));
            prop_assert!(close(m.variance().unwrap(), variance, 1.0));
        }

        #[test]
        fn moments_follow_a_change_of_unit_and_origin(v in values(), scale in 1e-3..1e3f64, shift in -10.0..10.0f64) {
            let m: Moments = v.iter().copied().collect();
            let moved: Moments = v.iter().map(|x| scale * x + shift).collect();
            let size = scale + shift.abs();
            prop_assert!(close(moved.mean().unwrap(), scale * m.mean().unwrap() + shift, size));
            prop_assert!(close(moved.standard_deviation().unwrap(), scale * m.standard_deviation().unwrap(), 10.0 * size));
        }
    }
}
