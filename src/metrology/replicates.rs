//! The type A evaluation of a value that was estimated in `R` independent replicates.
//!
//! ```text
//! y = mean of the replicates,   u = s / √R,   ν = R − 1
//! u_upper = u √(ν / χ²_0.05(ν))
//! ```
//!
//! The second line is the upper 95 % limit of the standard uncertainty itself, for normally distributed replicates: a
//! run that stops on it does not stop on a spread that is small by luck.
//!
//! Sources: GUM 4.2 and E.4.3; the limit is the usual confidence limit of a standard deviation, e.g. NIST/SEMATECH
//! e-Handbook 1.3.5.8.

use super::distribution::chi_squared_quantile;
use super::moments::Moments;

/// Probability that the true spread lies below the upper limit.
const CONFIDENCE: f64 = 0.95;

/// Mean of independent replicates with its type A uncertainty.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Replicates {
    /// Number of replicates `R`, two or more.
    pub count: u64,
    /// Mean of the replicates, in their unit.
    pub mean: f64,
    /// Standard uncertainty of the mean `s/√R`, in the unit of the replicates.
    pub standard_uncertainty: f64,
}

impl Replicates {
    /// From the value of each replicate. `None` below two replicates, which have no spread.
    pub fn evaluate(replicates: &[f64]) -> Option<Self> {
        Self::from_moments(&replicates.iter().copied().collect())
    }

    /// From the moments of the replicates. `None` below two replicates.
    pub fn from_moments(moments: &Moments) -> Option<Self> {
        Some(Self { count: moments.count(), mean: moments.mean()?, standard_uncertainty: moments.standard_uncertainty_of_mean()? })
    }

    /// Degrees of freedom `ν = R − 1`.
    pub fn degrees_of_freedom(&self) -> f64 {
        self.count.saturating_sub(1) as f64
    }

    /// Upper 95 % limit of the standard uncertainty, in the unit of the replicates.
    pub fn upper_standard_uncertainty(&self) -> f64 {
        // Infinite below two replicates: nothing is known of their spread.
        self.standard_uncertainty * spread_upper_factor(self.degrees_of_freedom()).unwrap_or(f64::INFINITY)
    }
}

/// Factor `√(ν / χ²_0.05(ν))` from a standard deviation with `degrees_of_freedom` ν to its upper 95 % limit; 1.44 at
/// ν = 15, one at ν = ∞. `None` unless ν > 0.
pub fn spread_upper_factor(degrees_of_freedom: f64) -> Option<f64> {
    if degrees_of_freedom == f64::INFINITY {
        return Some(1.0);
    }
    let chi_squared = chi_squared_quantile(1.0 - CONFIDENCE, degrees_of_freedom)?;
    Some((degrees_of_freedom / chi_squared).sqrt())
}

#[cfg(test)]
mod tests {
    use super::super::distribution::normal_quantile;
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn sixteen_replicates_have_an_upper_limit_of_1_44() {
        let factor = spread_upper_factor(15.0).unwrap();
        assert!((factor - (15f64 / 7.260_944).sqrt()).abs() < 1e-6);
        assert!((factor - 1.44).abs() < 0.005);
        assert_eq!(spread_upper_factor(f64::INFINITY), Some(1.0));
        for nothing in [0.0, -1.0, f64::NAN] {
            assert_eq!(spread_upper_factor(nothing), None);
        }
    }

    #[test]
    fn one_replicate_has_no_spread() {
        assert_eq!(Replicates::evaluate(&[1.0]), None);
        assert_eq!(Replicates::evaluate(&[]), None);
    }

    #[test]
    fn the_uncertainty_of_huge_and_tiny_replicates_is_finite() {
        for unit in [1e300, 1e-300] {
            let r = Replicates::evaluate(&[1.0 * unit, 1.2 * unit, 0.8 * unit]).unwrap();
            let u = r.standard_uncertainty / unit;
            assert!((u - 0.2 / 3f64.sqrt()).abs() < 1e-15);
            assert!((r.mean / unit - 1.0).abs() < 1e-15);
        }
    }

    /// A uniform number for each counter (finaliser of SplitMix64).
    fn uniform(counter: u64) -> f64 {
        let z = counter.wrapping_mul(0x9E37_79B9_7F4A_7C15);
        let z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (((z ^ (z >> 31)) >> 11) as f64 + 0.5) / (1u64 << 53) as f64
    }

    #[test]
    fn the_upper_limit_holds_in_nineteen_of_twenty_normal_samples() {
        for size in [2, 4, 16] {
            let samples = 4000;
            let covered = (0..samples)
                .filter(|sample| {
                    let normal: Vec<f64> = (0..size).map(|i| normal_quantile(uniform(sample * size + i + 1)).unwrap()).collect();
                    let limit = Replicates::evaluate(&normal).unwrap().upper_standard_uncertainty();
                    limit >= 1.0 / (size as f64).sqrt()
                })
                .count();
            // Four standard deviations of the binomial distribution.
            let share = covered as f64 / samples as f64;
            let spread = (CONFIDENCE * (1.0 - CONFIDENCE) / samples as f64).sqrt();
            assert!((share - CONFIDENCE).abs() < 4.0 * spread, "{size}: {share}");
        }
    }

    proptest! {
        #[test]
        fn the_upper_limit_falls_towards_one_with_the_degrees_of_freedom(nu in 0.1..1e6f64, more in 1.01..10.0f64) {
            let few = spread_upper_factor(nu).unwrap();
            let many = spread_upper_factor(nu * more).unwrap();
            prop_assert!(few > many && many > 1.0);
        }
    }
}
