//! Ticks of an axis, and where a value stands on it.
//!
//! Linear ticks are multiples of 1, 2, 2.5 or 5 times a power of ten; logarithmic ticks are decades, with 2 and 5 between them where
//! there are few.

use super::chart::{Axis, Scale};

/// A tick: its value and what stands beside it (nothing for a minor one).
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tick {
    pub(super) value: f64,
    pub(super) label: String,
}

/// Where a value stands: 0 at the lower end of the axis, 1 at the upper; not finite where there is no place.
pub(super) fn place(axis: &Axis, value: f64) -> f64 {
    match axis.scale {
        // Halves, so that a range of the largest numbers does not overflow.
        Scale::Linear => (0.5 * value - 0.5 * axis.from) / (0.5 * axis.to - 0.5 * axis.from),
        Scale::Log if value > 0.0 => (value.ln() - axis.from.ln()) / (axis.to.ln() - axis.from.ln()),
        Scale::Log => f64::NAN,
    }
}

/// Whether the ends of an axis are a range.
pub(super) fn is_range(axis: &Axis) -> bool {
    let ends = axis.from.is_finite() && axis.to.is_finite() && axis.from < axis.to;
    let resolved = (axis.to - axis.from).is_finite() && axis.to - axis.from > 1e-12 * axis.from.abs().max(axis.to.abs());
    ends && match axis.scale {
        Scale::Linear => resolved,
        Scale::Log => axis.from > 0.0,
    }
}

/// Ticks of an axis, about `wanted` of them, rising.
pub(super) fn ticks(axis: &Axis, wanted: usize) -> Vec<Tick> {
    if !axis.ticks.is_empty() {
        return axis.ticks.iter().map(|(value, label)| Tick { value: *value, label: label.clone() }).collect();
    }
    match axis.scale {
        Scale::Linear => linear(axis.from, axis.to, wanted),
        Scale::Log => decades(axis.from, axis.to, wanted),
    }
}

fn linear(from: f64, to: f64, wanted: usize) -> Vec<Tick> {
    let rough = (to - from) / wanted.max(1) as f64;
    let power = rough.log10().floor();
    let nice = |m: f64| m * 10f64.powf(power);
    let step = [1.0, 2.0, 2.5, 5.0, 10.0].into_iter().map(nice).find(|step| *step >= rough * (1.0 - 1e-9)).unwrap_or(nice(10.0));
    let (first, last) = ((from / step - 1e-9).ceil(), (to / step + 1e-9).floor());
    if !(step > 0.0 && first.is_finite() && last - first < 1000.0) {
        return Vec::new();
    }
    let values: Vec<f64> = (0..=(last - first) as i64).map(|i| (first + i as f64) * step).collect();
    let labels = common_labels(&values, step);
    values.into_iter().zip(labels).map(|(value, label)| Tick { value, label }).collect()
}

/// All labels with the same number of decimals; powers of ten where plain digits would be many.
fn common_labels(values: &[f64], step: f64) -> Vec<String> {
    let largest = values.iter().fold(0.0_f64, |largest, v| largest.max(v.abs()));
    if (1e-3..1e5).contains(&largest) {
        let decimals = (0..9)
            .find(|d| {
                let scaled = step * 10f64.powi(*d);
                (scaled - scaled.round()).abs() < 1e-6 * scaled
            })
            .unwrap_or(9);
        return values.iter().map(|v| plain(*v, decimals as usize)).collect();
    }
    let exponent = largest.log10().floor();
    let scale = 10f64.powf(exponent);
    let unit = step / scale;
    let decimals = (0..9)
        .find(|d| {
            let scaled = unit * 10f64.powi(*d);
            (scaled - scaled.round()).abs() < 1e-6 * scaled
        })
        .unwrap_or(9);
    let label = |v: &f64| {
        if *v == 0.0 { "0".to_owned() } else { format!("{}·10{}", plain(v / scale, decimals as usize), superscript(exponent as i64)) }
    };
    values.iter().map(label).collect()
}

/// A number with its minus sign as typeset, and no minus before zero.
fn plain(value: f64, decimals: usize) -> String {
    let digits = format!("{:.decimals$}", value.abs());
    let zero = digits.chars().all(|c| matches!(c, '0' | '.'));
    if value < 0.0 && !zero { format!("−{digits}") } else { digits }
}

fn decades(from: f64, to: f64, wanted: usize) -> Vec<Tick> {
    let (low, high) = (from.log10(), to.log10());
    let (first, last) = ((low - 1e-9).ceil() as i64, (high + 1e-9).floor() as i64);
    let every = ((high - low) / wanted.max(1) as f64).ceil().max(1.0) as i64;
    let few = high - low <= 2.5;
    let mut ticks = Vec::new();
    for exponent in first - 1..=last {
        for digit in [1.0, 2.0, 5.0] {
            let value = digit * 10f64.powi(exponent as i32);
            let inside = value >= from * (1.0 - 1e-9) && value <= to * (1.0 + 1e-9);
            let label = match (digit == 1.0, few) {
                (true, _) if exponent.rem_euclid(every) == 0 => power_of_ten(exponent, few),
                (false, true) => small(digit, exponent),
                _ => continue,
            };
            if inside {
                ticks.push(Tick { value, label });
            }
        }
    }
    ticks
}

/// `10³`; a plain number if the axis has other labels than powers.
fn power_of_ten(exponent: i64, few: bool) -> String {
    if few { small(1.0, exponent) } else { format!("10{}", superscript(exponent)) }
}

fn small(digit: f64, exponent: i64) -> String {
    match exponent {
        0..=4 => format!("{:.0}", digit * 10f64.powi(exponent as i32)),
        -3..=-1 => format!("{:.*}", exponent.unsigned_abs() as usize, digit * 10f64.powi(exponent as i32)),
        _ if digit == 1.0 => format!("10{}", superscript(exponent)),
        _ => format!("{digit:.0}·10{}", superscript(exponent)),
    }
}

/// An integer in superscript digits.
pub(super) fn superscript(number: i64) -> String {
    let raised = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => digit.to_digit(10).and_then(|d| char::from_u32(0x2070 + d)).unwrap_or(digit),
    };
    number.to_string().chars().map(raised).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn labels(axis: &Axis, wanted: usize) -> Vec<String> {
        ticks(axis, wanted).into_iter().map(|tick| tick.label).collect()
    }

    #[test]
    fn ticks_are_round_numbers() {
        assert_eq!(labels(&Axis::linear("", "", 380.0, 780.0), 8), ["400", "450", "500", "550", "600", "650", "700", "750"]);
        assert_eq!(labels(&Axis::linear("", "", 0.0, 1.0), 5), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(labels(&Axis::linear("", "", -0.1, 0.1), 4), ["−0.10", "−0.05", "0.00", "0.05", "0.10"]);
        assert_eq!(labels(&Axis::linear("", "", 0.0, 3e9), 3), ["0", "1·10⁹", "2·10⁹", "3·10⁹"]);
        assert_eq!(labels(&Axis::log("", "", 1e-3, 1e3), 6), ["10⁻³", "10⁻²", "10⁻¹", "10⁰", "10¹", "10²", "10³"]);
        assert_eq!(labels(&Axis::log("", "", 1e-12, 1e12), 5), ["10⁻¹⁰", "10⁻⁵", "10⁰", "10⁵", "10¹⁰"]);
        assert_eq!(labels(&Axis::log("", "", 100.0, 5000.0), 6), ["100", "200", "500", "1000", "2000", "5000"]);
    }

    proptest! {
        #[test]
        fn ticks_stand_inside_and_rise(from in -1e3..1e3_f64, exponent in -5.0..8.0_f64, wanted in 2usize..12) {
            let to = from + 10f64.powf(exponent);
            let axis = Axis::linear("", "", from, to);
            prop_assume!(is_range(&axis));
            let ticks = ticks(&axis, wanted);
            let slack = 1e-6 * (to - from);
            prop_assert!(ticks.iter().all(|t| t.value >= from - slack && t.value <= to + slack));
            prop_assert!(ticks.windows(2).all(|pair| pair[0].value < pair[1].value));
            prop_assert!(ticks.len() <= wanted + 1);
        }
    }
}
