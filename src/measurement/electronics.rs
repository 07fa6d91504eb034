//! From what is collected to what is displayed: the readout of a sensor applied to a reading.
//!
//! ```text
//! photocurrent I = c X      c: photocurrent of one unit of the indication X      display = step · round(Î / (c · step))
//! ```
//!
//! The reading becomes what the display shows for the expected current. Noise of one reading and steps are rows of its budget. Dark current,
//! non-linearity and errors of a range are no uncertainty: they are in the value, and a note states each.

use crate::metrology::rounding::format_significant;
use crate::metrology::{Budget, BudgetRow};
use crate::sensor::photodiode::{Deviation, Photodiode, Saturation};

/// What the electronics made of a reading; in the unit of the reading where no other is named.
#[derive(Clone, Debug, PartialEq)]
pub struct DisplayReading {
    /// The indication without electronics.
    pub analogue: f64,
    /// Photocurrent, A.
    pub photocurrent_a: f64,
    /// Gain of the range, V/A.
    pub feedback_ohm: f64,
    /// Expected voltage, V.
    pub voltage_v: f64,
    /// Expected code of the converter, if there is one.
    pub code: Option<f64>,
    /// Expected indication before the display.
    pub expected: f64,
    /// Standard deviation of one reading, the steps of the converter included, before the display.
    pub standard_deviation: f64,
    /// Standard uncertainty of one displayed reading that comes from noise and steps.
    pub standard_uncertainty: f64,
    /// One displayed reading with its noise; the seed of the measurement gives it.
    pub one: f64,
    /// Step of the display, if there is one.
    pub step: Option<f64>,
    /// What makes `expected` differ from `analogue`.
    pub deviations: Vec<(Deviation, f64)>,
    /// Whether something was cut off.
    pub saturation: Option<Saturation>,
}

/// Applies the electronics: the rows of their noise go into the budget, what is to be known into the notes.
pub(super) fn displayed(
    diode: &Photodiode,
    analogue: f64,
    a_per_unit: f64,
    (seed, path): (u64, &[u64]),
    unit: &str,
    budget: &mut Budget,
    notes: &mut Vec<String>,
) -> (f64, DisplayReading) {
    let photocurrent_a = a_per_unit * analogue;
    let readout = diode.readout(photocurrent_a);
    let step = diode.display_step(readout.range, a_per_unit);
    let shown = |x: f64| step.map_or(x, |step| (x / step).round() * step);
    let expected = readout.indicated_a / a_per_unit;
    let mut own = Budget::new();
    for (cause, a) in &readout.noise_a {
        own.push(BudgetRow::normal(format!("one reading: {}", cause.words()), a / a_per_unit));
    }
    if let Some(step) = step {
        own.push(BudgetRow::rectangular("one reading: last digit of the display", 0.5 * step));
    }
    let standard_uncertainty = own.combined_standard_uncertainty();
    // What moves the current moves the display.
    let slope = diode.slope(readout.range, photocurrent_a);
    *budget = budget.scaled(slope);
    budget.rows.extend(own.rows);
    let deviations: Vec<(Deviation, f64)> = readout.deviations_a.iter().map(|&(cause, a)| (cause, a / a_per_unit)).collect();
    for (cause, x) in deviations.iter().filter(|(cause, _)| *cause != Deviation::Saturation) {
        let sign = if *x > 0.0 { "+" } else { "−" };
        let share =
            if analogue == 0.0 { String::new() } else { format!(" ({sign}{} %)", format_significant((100.0 * x / analogue).abs(), 2)) };
        notes.push(format!("includes {sign}{} {unit}{share} from {}", format_significant(x.abs(), 2), cause.words()));
    }
    match readout.saturation {
        Some(Saturation::Whole) => notes.push(format!(
            "saturated: the readout is at its limit of {} V; the light would give {} {unit}. The reading is a lower bound, U that of the display",
            format_significant(diode.limit_v(), 3),
            format_significant(analogue, 4)
        )),
        Some(Saturation::Crests) => {
            notes.push(
                "saturated: the crests of the flickering light exceed the limit; the reading leaves that out and is too high, and U does not hold it"
                    .to_owned(),
            );
        }
        None => {}
    }
    let value = shown(expected);
    if value == 0.0 && expected != 0.0 {
        notes.push(format!("shows zero: {} {unit} is below half of the last digit", format_significant(expected, 2)));
    }
    let display = DisplayReading {
        analogue,
        photocurrent_a,
        feedback_ohm: diode.ranges.get(readout.range).map_or(f64::NAN, |range| range.feedback_ohm),
        voltage_v: readout.voltage_v,
        code: diode.adc.map(|adc| adc.code(readout.voltage_v)),
        expected,
        standard_deviation: readout.standard_deviation_a() / a_per_unit,
        standard_uncertainty,
        one: shown(diode.noisy_a(photocurrent_a, seed, path) / a_per_unit),
        step,
        deviations,
        saturation: readout.saturation,
    };
    (value, display)
}
