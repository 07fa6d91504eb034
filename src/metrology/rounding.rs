//! A value and its uncertainty written with the same last place.
//!
//! GUM 7.2.6: the uncertainty is given to two significant digits and the value to the same decimal place,
//!
//! ```text
//! 512.3368, 0.4170      →  512.34 ± 0.42
//! 1.23452e-9, 1.2e-12   →  (1.2345 ± 0.0012)e-9
//! 512.5, 0              →  512.5 ± 0
//! ```
//!
//! All digits come from the exact decimal expansion of the double, rounded once; numbers are moved between fixed and
//! scientific form as text, so that no place is lost to arithmetic.

use std::fmt;

/// Significant digits of an uncertainty.
const UNCERTAINTY_DIGITS: i32 = 2;
/// Leading decimal places that are written without a power of ten: 0.0001 up to 9999999.
const FIXED: std::ops::RangeInclusive<i32> = -4..=6;
/// A double holds at most this many significant decimal digits.
const DOUBLE_DIGITS: i32 = 17;

/// A value and its uncertainty as text. Each of the two reads back as a number of its own.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rounded {
    /// The value, e.g. "512.34" or "1.2345e-9".
    pub value: String,
    /// The uncertainty, e.g. "0.42" or "0.0012e-9".
    pub uncertainty: String,
}

impl Rounded {
    /// Rounds `value` and `uncertainty`, in one unit, to the second significant digit of the uncertainty.
    ///
    /// An uncertainty of zero gives the shortest text that reads back as the value, and "0". An uncertainty below the
    /// resolution of the value (its 17th digit) gives the same shortest text and the uncertainty on its own.
    /// `None` when either is NaN or infinite, or the uncertainty is negative: such a result has no text.
    pub fn new(value: f64, uncertainty: f64) -> Option<Self> {
        if !value.is_finite() || !uncertainty.is_finite() || uncertainty < 0.0 {
            return None;
        }
        if uncertainty == 0.0 {
            return Some(Self { value: shortest(value), uncertainty: "0".into() });
        }
        let (digits, leading) = significant_digits(uncertainty, UNCERTAINTY_DIGITS);
        let last = leading - UNCERTAINTY_DIGITS + 1;
        let uncertainty_text = Decimal { negative: false, digits, last };
        if value != 0.0 && leading_place(value) - last >= DOUBLE_DIGITS {
            return Some(Self { value: shortest(value), uncertainty: uncertainty_text.written() });
        }
        let value_text = Decimal::rounded_at(value, last);
        let leading = uncertainty_text.leading().max(value_text.leading());
        let exponent = if FIXED.contains(&leading) { 0 } else { leading };
        Some(Self { value: value_text.with_exponent(exponent), uncertainty: uncertainty_text.with_exponent(exponent) })
    }

    /// The result with its unit: "(512.34 ± 0.42) lx". An empty unit or the unit "1" leaves the plain form.
    pub fn with_unit(&self, unit: &str) -> String {
        if unit.is_empty() || unit == "1" {
            return self.to_string();
        }
        match self.common_exponent() {
            Some(_) => format!("{self} {unit}"),
            None => format!("({self}) {unit}"),
        }
    }

    /// Both numbers before their common power of ten, and that power.
    fn common_exponent(&self) -> Option<(&str, &str, &str)> {
        let (value, exponent) = self.value.split_once('e')?;
        let (uncertainty, other) = self.uncertainty.split_once('e')?;
        (exponent == other).then_some((value, uncertainty, exponent))
    }
}

/// In one piece: "512.34 ± 0.42" or "(1.2345 ± 0.0012)e-9".
impl fmt::Display for Rounded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.common_exponent() {
            Some((value, uncertainty, exponent)) => {
                write!(f, "({value} ± {uncertainty})e{exponent}")
            }
            None => write!(f, "{} ± {}", self.value, self.uncertainty),
        }
    }
}

/// `x` with `digits` significant digits, 1 to 17 (other numbers are taken as the nearest of these): "0.04200" for
/// 0.042 and 4. In scientific form below 0.0001 and from 10⁷ on, and where fixed form would show more digits than
/// asked for. Zero is "0"; what is no finite number is "not a number", "infinity" or "-infinity".
pub fn format_significant(x: f64, digits: usize) -> String {
    if x.is_nan() {
        return "not a number".into();
    }
    if x.is_infinite() {
        return if x > 0.0 { "infinity" } else { "-infinity" }.into();
    }
    if x == 0.0 {
        return "0".into();
    }
    let count = digits.clamp(1, DOUBLE_DIGITS as usize) as i32;
    let (digits, leading) = significant_digits(x, count);
    Decimal { negative: x < 0.0, digits, last: leading - count + 1 }.written()
}

/// The shortest text that reads back as `x`, which is finite.
fn shortest(x: f64) -> String {
    if x == 0.0 {
        "0".into()
    } else if FIXED.contains(&leading_place(x)) {
        x.to_string()
    } else {
        format!("{x:e}")
    }
}

/// Power of ten of the leading digit of `x`, which is finite and not zero.
fn leading_place(x: f64) -> i32 {
    exponent_of(&format!("{x:e}"))
}

/// The exponent of a number that was written in scientific form.
fn exponent_of(scientific: &str) -> i32 {
    scientific.split_once('e').and_then(|(_, exponent)| exponent.parse().ok()).unwrap_or(0)
}

/// `count` significant digits of |x|, correctly rounded, and the power of ten of the first of them.
fn significant_digits(x: f64, count: i32) -> (String, i32) {
    let decimals = (count - 1).max(0) as usize;
    let text = format!("{:.decimals$e}", x.abs());
    let leading = exponent_of(&text);
    let digits = text.chars().take_while(|&c| c != 'e').filter(char::is_ascii_digit).collect();
    (digits, leading)
}

/// A decimal number: an integer, as digits without leading zeros, times 10^last.
struct Decimal {
    negative: bool,
    digits: String,
    last: i32,
}

impl Decimal {
    /// `x` rounded to the decimal place 10^last.
    fn rounded_at(x: f64, last: i32) -> Self {
        let zero = Self { negative: false, digits: "0".into(), last };
        if x == 0.0 {
            return zero;
        }
        let count = leading_place(x) - last + 1;
        let digits = if count > 0 {
            let (mut digits, leading) = significant_digits(x, count);
            // 9.96 to two digits is 1.0e1: the carry has made room for one more.
            if leading - last + 1 > count {
                digits.push('0');
            }
            digits
        } else if count == 0 && format!("{:e}", x.abs()).as_bytes().first() >= Some(&b'5') {
            "1".into()
        } else {
            return zero;
        };
        Self { negative: x < 0.0, digits, last }
    }

    /// Power of ten of the leading digit; for zero that of its only digit.
    fn leading(&self) -> i32 {
        self.last + self.digits.len() as i32 - 1
    }

    /// On its own: in fixed form where that is short and shows no digit that is not significant.
    fn written(&self) -> String {
        let leading = self.leading();
        let fixed = FIXED.contains(&leading) && self.last <= 0;
        self.with_exponent(if fixed { 0 } else { leading })
    }

    /// As a multiple of 10^exponent, the power being left out when it is one.
    fn with_exponent(&self, exponent: i32) -> String {
        let last = self.last - exponent;
        let mut text = self.digits.clone();
        if last > 0 && text != "0" {
            text.extend(std::iter::repeat_n('0', last as usize));
        } else if last < 0 {
            let decimals = last.unsigned_abs() as usize;
            if text.len() <= decimals {
                text.insert_str(0, &"0".repeat(decimals + 1 - text.len()));
            }
            text.insert(text.len() - decimals, '.');
        }
        let sign = if self.negative { "-" } else { "" };
        if exponent == 0 { format!("{sign}{text}") } else { format!("{sign}{text}e{exponent}") }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn together(value: f64, uncertainty: f64) -> String {
        Rounded::new(value, uncertainty).unwrap().to_string()
    }

    #[test]
    fn value_and_uncertainty_end_at_the_same_place() {
        assert_eq!(together(512.3368, 0.417), "512.34 ± 0.42");
        assert_eq!(together(-512.3368, 4.17), "-512.3 ± 4.2");
        assert_eq!(together(512.3368, 41.7), "512 ± 42");
        assert_eq!(together(25.0, 0.0005), "25.00000 ± 0.00050");
        assert_eq!(together(0.0, 0.417), "0.00 ± 0.42");
        assert_eq!(together(512_336.8, 4170.0), "512300 ± 4200");
        assert_eq!(together(0.3, 117.0), "0 ± 120");
        assert_eq!(together(-7.0, 117.0), "-10 ± 120");
        assert_eq!(together(-0.001, 1.0), "0.0 ± 1.0");
    }

    #[test]
    fn rounding_carries_into_the_next_place() {
        assert_eq!(together(99.96, 0.96), "99.96 ± 0.96");
        assert_eq!(together(99.96, 0.996), "100.0 ± 1.0");
        assert_eq!(together(9.96, 1.0), "10.0 ± 1.0");
        assert_eq!(together(9_999_999.6, 10.0), "(1.0000000 ± 0.0000010)e7");
    }

    #[test]
    fn huge_and_small_results_share_a_power_of_ten() {
        assert_eq!(together(1.234_52e-9, 1.2e-12), "(1.2345 ± 0.0012)e-9");
        assert_eq!(together(3.0e-9, 2.0e-7), "(0.0 ± 2.0)e-7");
        assert_eq!(together(-1.5e300, 2.5e298), "(-1.500 ± 0.025)e300");
        let r = Rounded::new(1.234_52e-9, 1.2e-12).unwrap();
        assert_eq!([r.value.as_str(), r.uncertainty.as_str()], ["1.2345e-9", "0.0012e-9"]);
    }

    #[test]
    fn a_unit_stands_outside_the_brackets() {
        let unit = |v, u, unit| Rounded::new(v, u).unwrap().with_unit(unit);
        assert_eq!(unit(512.3368, 0.417, "lx"), "(512.34 ± 0.42) lx");
        assert_eq!(unit(1.234_52e-9, 1.2e-12, "A"), "(1.2345 ± 0.0012)e-9 A");
        assert_eq!(unit(512.3368, 0.417, "1"), "512.34 ± 0.42");
    }

    #[test]
    fn without_uncertainty_every_digit_is_kept() {
        assert_eq!(together(0.1 + 0.2, 0.0), "0.30000000000000004 ± 0");
        assert_eq!(together(0.0, 0.0), "0 ± 0");
        assert_eq!(together(-0.0, 0.0), "0 ± 0");
        assert_eq!(together(1e-300, 0.0), "1e-300 ± 0");
    }

    #[test]
    fn an_uncertainty_below_the_resolution_stands_alone() {
        assert_eq!(together(512.34, 1.2e-20), "512.34 ± 1.2e-20");
    }

    #[test]
    fn what_is_no_result_has_no_text() {
        for (v, u) in [(f64::NAN, 1.0), (1.0, f64::NAN), (f64::INFINITY, 1.0), (1.0, f64::INFINITY), (1.0, -1.0)] {
            assert_eq!(Rounded::new(v, u), None);
        }
    }

    #[test]
    fn significant_digits_are_counted_from_the_first() {
        assert_eq!(format_significant(512.3368, 4), "512.3");
        assert_eq!(format_significant(0.042, 4), "0.04200");
        assert_eq!(format_significant(-0.042, 1), "-0.04");
        assert_eq!(format_significant(51_234.0, 2), "5.1e4");
        assert_eq!(format_significant(99.96, 3), "100");
        assert_eq!(format_significant(1e-9, 3), "1.00e-9");
        assert_eq!(format_significant(0.0, 3), "0");
        assert_eq!(format_significant(2.5, 0), "2");
        assert_eq!(format_significant(f64::NAN, 3), "not a number");
        assert_eq!(format_significant(f64::NEG_INFINITY, 3), "-infinity");
    }

    fn finite() -> impl Strategy<Value = f64> {
        (-1.0..1.0f64, -290i32..290).prop_map(|(m, e)| m * 10f64.powi(e))
    }

    proptest! {
        #[test]
        fn rounding_moves_the_value_by_at_most_half_a_unit_in_the_last_place(
            value in finite(), share in 1e-12..1e3f64,
        ) {
            let uncertainty = (value * share).abs();
            prop_assume!(uncertainty > 1e-290 && uncertainty.is_finite());
            let rounded = Rounded::new(value, uncertainty).unwrap();
            let (v, u): (f64, f64) = (rounded.value.parse().unwrap(), rounded.uncertainty.parse().unwrap());
            // The second digit of u is worth u/10 at most, so half of it is u/20; a carry keeps that bound.
            prop_assert!((v - value).abs() <= 0.0501 * u + 1e-15 * value.abs(), "{rounded}");
            prop_assert!((u - uncertainty).abs() <= 0.0501 * uncertainty, "{rounded}");
            let decimals = |s: &str| {
                let s = s.split('e').next().unwrap_or_default().to_owned();
                s.split_once('.').map_or(0, |(_, d)| d.len())
            };
            prop_assert_eq!(decimals(&rounded.value), decimals(&rounded.uncertainty));
        }

        #[test]
        fn no_finite_pair_is_written_as_nan(bits in any::<u64>(), more in any::<u64>()) {
            let (v, u) = (f64::from_bits(bits), f64::from_bits(more).abs());
            if let Some(rounded) = Rounded::new(v, u) {
                prop_assert!(rounded.value.parse::<f64>().unwrap().is_finite() || v.abs() > 1e308);
                prop_assert!(rounded.uncertainty.parse::<f64>().unwrap().is_finite() || u > 1e308);
                prop_assert!(rounded.to_string().len() < 80, "{rounded}");
            } else {
                prop_assert!(!v.is_finite() || !u.is_finite());
            }
        }

        #[test]
        fn significant_digits_read_back_within_half_a_digit(x in finite(), digits in 1usize..17) {
            prop_assume!(x != 0.0);
            let back: f64 = format_significant(x, digits).parse().unwrap();
            prop_assert!((back / x - 1.0).abs() <= 0.5001 * 10f64.powi(1 - digits as i32) + 2e-16);
        }
    }
}
