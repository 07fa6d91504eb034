//! How large and how small a factor becomes, and where.
//!
//! Bounds by interval arithmetic come first; they are exact for all but sums and products. Where they are too wide to decide,
//! the factor is looked at on both sides of every breakpoint and at points between neighbours. Between breakpoints factors are
//! low polynomials or parts of a bell curve, of which 16 points show the extremes.

use crate::spectrum::Factor;

/// Points between two breakpoints that are looked at.
const POINTS_BETWEEN: u32 = 16;
/// Rounding of sums that should be one or zero.
const ROUNDING: f64 = 1e-12;

/// Largest value of a factor that may be larger than one.
pub(super) const LARGEST: f64 = 1e100;

/// A wavelength in nm and the value there.
type At = (f64, f64);

/// Where the factor falls below `least` or exceeds `most`, if it does: the place of the worst excess.
pub(super) fn outside_of(factor: &Factor, least: f64, most: f64) -> Option<At> {
    let (low, high) = factor.range_over(0.0, f64::INFINITY);
    if low >= least && high <= most {
        return None;
    }
    let excess = |value: f64| (value - most).max(least - value);
    let worst = looked_at(factor).into_iter().rev().max_by(|a, b| excess(a.1).total_cmp(&excess(b.1)))?;
    // A value that is not a number is outside as well.
    (!excess(worst.1).le(&ROUNDING)).then_some(worst)
}

/// Whether the factor is zero at every wavelength.
pub(super) fn is_zero(factor: &Factor) -> bool {
    factor.support().is_empty() || factor.range_over(0.0, f64::INFINITY) == (0.0, 0.0)
}

fn looked_at(factor: &Factor) -> Vec<At> {
    let breakpoints = factor.breakpoints();
    let mut wavelengths = vec![555.0];
    for nm in &breakpoints {
        wavelengths.extend([nm.next_down(), *nm, nm.next_up()]);
    }
    for pair in breakpoints.windows(2) {
        let step = (pair[1] - pair[0]) / f64::from(POINTS_BETWEEN);
        wavelengths.extend((1..POINTS_BETWEEN).map(|i| pair[0] + step * f64::from(i)));
    }
    if let (Some(first), Some(last)) = (breakpoints.first(), breakpoints.last()) {
        wavelengths.extend([0.5 * first, 2.0 * last]);
    }
    wavelengths.into_iter().map(|nm| (nm, factor.at(nm))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::{Outside, Table};

    fn band(from_nm: f64, to_nm: f64) -> Factor {
        Factor::Band { from_nm, to_nm, value: 0.8 }
    }

    #[test]
    fn parts_of_a_sum_that_do_not_overlap_stay_within_their_bounds() {
        assert_eq!(outside_of(&Factor::Sum(vec![band(400.0, 500.0), band(600.0, 700.0)]), 0.0, 1.0), None);
        let (nm, value) = outside_of(&Factor::Sum(vec![band(400.0, 500.0), band(450.0, 700.0)]), 0.0, 1.0).unwrap();
        assert!((450.0..=500.0).contains(&nm) && value == 1.6);
        let rising = Table::from_rows(&[(400.0, 0.0), (700.0, 1.0)], Outside::Hold).unwrap();
        let falling = Table::from_rows(&[(400.0, 1.0), (700.0, 0.0)], Outside::Hold).unwrap();
        assert_eq!(outside_of(&Factor::Sum(vec![rising.into(), falling.into()]), 0.0, 1.0), None);
    }

    #[test]
    fn constants_and_differences_are_judged_by_their_values() {
        assert_eq!(outside_of(&Factor::Constant(1.0), 0.0, 1.0), None);
        assert_eq!(outside_of(&Factor::Constant(1.02), 0.0, 1.0).map(|at| at.1), Some(1.02));
        let difference = |share: f64| Factor::Sum(vec![band(400.0, 500.0), band(400.0, 500.0).scaled(-share)]);
        assert_eq!(outside_of(&difference(0.5), 0.0, LARGEST), None);
        assert!(outside_of(&difference(1.5), 0.0, LARGEST).is_some());
        let endless = Factor::Product(vec![Factor::Constant(1e300), Factor::Constant(1e300)]);
        assert!(outside_of(&endless, 0.0, LARGEST).is_some());
        assert!(is_zero(&band(400.0, 500.0).scaled(0.0)) && !is_zero(&band(400.0, 500.0)));
    }
}
