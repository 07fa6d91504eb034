//! `readout: Photodiode(…)` of a sensor file.
//!
//! ```ron
//! readout: Photodiode(
//!     ranges: [(feedback_ohm: 1e8), (feedback_ohm: 1e6, error_percent: 0.2)],   // or feedback_ohm: 1e6
//!     integration_s: 0.1,                                                      // or bandwidth_hz: 10
//!     temperature_c: 35,
//!     dark: (current_a: 1e-11, at_c: 25, doubling_k: 10, zeroed_at_c: 25),
//!     shunt_ohm: 1e9, flicker: (corner_hz: 5, lowest_hz: 0.01),
//!     nonlinearity: Quadratic(percent: -0.2, at_a: 1e-5), saturation_v: 4.5,
//!     adc: (bits: 16, full_scale_v: 5), display_digits: 4,
//!     modulation: (frequency_hz: 100, depth: 0.3, waveform: Sine),
//! )
//! ```
//!
//! Only the gain and the speed must be given; what is left out is not there. `current_a_per_unit` says which photocurrent a unit of the
//! indication stands for, such as 1e-9 A per lx; channels whose responsivity is in A/W behind an aperture with an area need none.

use super::decode::{Fields, Value};
use super::diagnostic::Problems;
use super::reading::Reading;
use crate::sensor::photodiode::{Adc, Bandwidth, DarkCurrent, Flicker, Modulation, Nonlinearity, Photodiode, Range, Waveform};

const KEYS: [&str; 14] = [
    "feedback_ohm",
    "ranges",
    "bandwidth_hz",
    "integration_s",
    "temperature_c",
    "dark",
    "shunt_ohm",
    "flicker",
    "nonlinearity",
    "saturation_v",
    "adc",
    "display_digits",
    "modulation",
    "current_a_per_unit",
];

/// What electronics can be, whatever the unit.
const PHYSICAL: &str = "above 0, up to 1e30";
/// Largest dark current, A.
const MOST_DARK_A: f64 = 1.0;

fn is_physical(x: f64) -> bool {
    (1e-30..=1e30).contains(&x)
}

/// Reads the electronics of a sensor.
pub(super) fn read_readout(value: &Value, reading: &mut Reading) -> Option<Photodiode> {
    value.variant("a readout", &["Photodiode"], &mut reading.problems)?;
    let problems = &mut reading.problems;
    let before = problems.count();
    let fields = value.fields("`Photodiode`", &KEYS, problems)?;
    let ranges = read_ranges(value, &fields, problems);
    let bandwidth = read_bandwidth(value, &fields, problems);
    let above_zero =
        |key: &str, what: &str, problems: &mut Problems| fields.get(key).and_then(|v| v.number_in(what, PHYSICAL, is_physical, problems));
    let mut diode = Photodiode::new(Vec::new(), Bandwidth::Hertz(1.0));
    if let Some(v) = fields.get("temperature_c") {
        let found = v.number_in("the temperature", "-200 °C to 200 °C", |c| (-200.0..=200.0).contains(&c), problems);
        diode.temperature_c = found.unwrap_or(diode.temperature_c);
    }
    diode.dark = fields.get("dark").and_then(|v| read_dark(&v, problems));
    diode.shunt_ohm = above_zero("shunt_ohm", "the shunt resistance", problems);
    diode.flicker = fields.get("flicker").and_then(|v| {
        let f = v.fields("`flicker`", &["corner_hz", "lowest_hz"], problems)?;
        let corner_hz = required(&f, "corner_hz", "5", "the corner frequency", problems);
        let lowest_hz = required(&f, "lowest_hz", "0.01", "the lowest frequency", problems);
        Some(Flicker { corner_hz: corner_hz?, lowest_hz: lowest_hz? })
    });
    diode.nonlinearity = fields.get("nonlinearity").and_then(|v| read_nonlinearity(&v, problems));
    diode.saturation_v = above_zero("saturation_v", "the largest voltage", problems);
    diode.adc = fields.get("adc").and_then(|v| read_adc(&v, problems));
    let whole = |x: f64, most: f64| x.fract() == 0.0 && (1.0..=most).contains(&x);
    diode.display_digits = fields
        .get("display_digits")
        .and_then(|v| v.number_in("the number of digits", "whole, 1 to 9", |x| whole(x, 9.0), problems))
        .map(|x| x as u32);
    diode.current_a_per_unit = above_zero("current_a_per_unit", "the current of one unit", problems);
    diode.modulation = fields.get("modulation").and_then(|v| read_modulation(&v, bandwidth, problems));
    let bounded = diode.saturation_v.is_some() || diode.adc.is_some();
    if let (Some(v), false) = (fields.get("display_digits"), bounded || fields.get("adc").is_some()) {
        v.problem(
            problems,
            "digits of a display are counted from its largest reading, and there is none",
            "add `saturation_v: 5` or an `adc`",
        );
    }
    if let (Some(v), Some(2..), false) = (fields.get("ranges"), ranges.as_ref().map(Vec::len), bounded) {
        v.problem(problems, "nothing says when to change the range", "add the largest voltage, such as `saturation_v: 5`, or an `adc`");
    }
    if let (Some(v), Some(dark)) = (fields.get("dark"), &diode.dark) {
        let temperatures = [Some(diode.temperature_c), dark.zeroed_at_c];
        for temperature_c in temperatures.into_iter().flatten().filter(|c| dark.at_a(*c) > MOST_DARK_A || dark.at_a(*c).is_nan()) {
            let found = format!("at {temperature_c} °C the dark current would be {:.3e} A", dark.at_a(temperature_c));
            v.problem(problems, found, "allowed: up to 1 A; `doubling_k` is the rise of the temperature that doubles it, such as 10");
        }
    }
    if problems.count() > before {
        return None;
    }
    Some(Photodiode { ranges: ranges?, bandwidth: bandwidth?, ..diode })
}

fn required(fields: &Fields, key: &str, example: &str, what: &str, problems: &mut Problems) -> Option<f64> {
    fields.require(key, example, problems).and_then(|v| v.number_in(what, PHYSICAL, is_physical, problems))
}

fn read_ranges(value: &Value, fields: &Fields, problems: &mut Problems) -> Option<Vec<Range>> {
    match (fields.get("feedback_ohm"), fields.get("ranges")) {
        (Some(_), Some(_)) => {
            let span = fields.key_span("ranges");
            value.problem_at(&span, problems, "both `feedback_ohm` and `ranges` are given", "keep one of them");
            None
        }
        (None, None) => {
            fields.require("feedback_ohm", "1e6", problems);
            None
        }
        (Some(v), None) => {
            let feedback_ohm = v.number_in("the gain", "above 0, up to 1e30 V/A", is_physical, problems)?;
            Some(vec![Range { feedback_ohm, error: 0.0 }])
        }
        (None, Some(list)) => {
            let items = list.list("`ranges`", problems)?;
            if items.is_empty() {
                list.problem(problems, "there is no range", "write `ranges: [(feedback_ohm: 1e6)]`");
                return None;
            }
            let ranges: Vec<Option<Range>> = items
                .iter()
                .map(|item| {
                    let f = item.fields("a range", &["feedback_ohm", "error_percent"], problems)?;
                    let feedback_ohm = required(&f, "feedback_ohm", "1e6", "the gain", problems);
                    let percent = match f.get("error_percent") {
                        Some(v) => v.number_in("the error of the range", "-50 % to 50 %", |x| x.abs() <= 50.0, problems),
                        None => Some(0.0),
                    };
                    Some(Range { feedback_ohm: feedback_ohm?, error: 0.01 * percent? })
                })
                .collect();
            ranges.into_iter().collect()
        }
    }
}

fn read_bandwidth(value: &Value, fields: &Fields, problems: &mut Problems) -> Option<Bandwidth> {
    match (fields.get("bandwidth_hz"), fields.get("integration_s")) {
        (Some(_), Some(_)) => {
            let span = fields.key_span("integration_s");
            let help = "keep one of them: an integration over t has a bandwidth of 1/(2t)";
            value.problem_at(&span, problems, "both `bandwidth_hz` and `integration_s` are given", help);
            None
        }
        (Some(v), None) => v.number_in("the bandwidth", "above 0, up to 1e30 Hz", is_physical, problems).map(Bandwidth::Hertz),
        (None, Some(v)) => {
            v.number_in("the time of integration", "above 0, up to 1e30 s", is_physical, problems).map(Bandwidth::Integration)
        }
        (None, None) => {
            fields.require("integration_s", "0.1", problems);
            None
        }
    }
}

fn read_dark(value: &Value, problems: &mut Problems) -> Option<DarkCurrent> {
    let f = value.fields("`dark`", &["current_a", "at_c", "doubling_k", "zeroed_at_c"], problems)?;
    let current = f.require("current_a", "1e-11", problems);
    let current_a = current.and_then(|v| v.number_in("the dark current", "0 to 1 A", |x| (0.0..=MOST_DARK_A).contains(&x), problems));
    let reference_temperature_c = f.require("at_c", "25", problems).and_then(|v| v.number(problems));
    let doubling_k = required(&f, "doubling_k", "10", "the rise that doubles the dark current", problems);
    let zeroed_at_c = match f.get("zeroed_at_c") {
        Some(v) => Some(v.number(problems)?),
        None => None,
    };
    Some(DarkCurrent { current_a: current_a?, reference_temperature_c: reference_temperature_c?, doubling_k: doubling_k?, zeroed_at_c })
}

fn read_nonlinearity(value: &Value, problems: &mut Problems) -> Option<Nonlinearity> {
    match value.variant("a non-linearity", &["Quadratic", "Saturating"], problems)? {
        "Quadratic" => {
            let f = value.fields("`Quadratic`", &["percent", "at_a"], problems)?;
            let percent = f.require("percent", "-0.2", problems);
            let percent = percent.and_then(|v| v.number_in("the departure", "-50 % to 50 %", |x| x.abs() <= 50.0, problems));
            let at_a = required(&f, "at_a", "1e-5", "the current", problems);
            Some(Nonlinearity::Quadratic { per_a: 0.01 * percent? / at_a? })
        }
        _ => {
            let f = value.fields("`Saturating`", &["limit_a"], problems)?;
            Some(Nonlinearity::Saturating { limit_a: required(&f, "limit_a", "1e-3", "the limit", problems)? })
        }
    }
}

fn read_adc(value: &Value, problems: &mut Problems) -> Option<Adc> {
    let f = value.fields("`adc`", &["bits", "full_scale_v"], problems)?;
    let bits = f.require("bits", "16", problems);
    let bits = bits.and_then(|v| {
        v.number_in("the number of bits of the converter", "whole, 1 to 32", |x| x.fract() == 0.0 && (1.0..=32.0).contains(&x), problems)
    });
    let full_scale_v = required(&f, "full_scale_v", "5", "the full scale", problems);
    Some(Adc { bits: bits? as u32, full_scale_v: full_scale_v? })
}

fn read_modulation(value: &Value, bandwidth: Option<Bandwidth>, problems: &mut Problems) -> Option<Modulation> {
    let f = value.fields("`modulation`", &["frequency_hz", "depth", "waveform"], problems)?;
    let frequency_hz = required(&f, "frequency_hz", "100", "the frequency", problems);
    let depth = f.require("depth", "0.3", problems);
    let depth = depth.and_then(|v| v.number_in("the depth", "0 to 1", |x| (0.0..=1.0).contains(&x), problems));
    let waveform = f.require("waveform", "Sine", problems);
    let waveform = waveform.and_then(|v| v.variant("a waveform", &["Sine", "Square"], problems)).map(|name| match name {
        "Sine" => Waveform::Sine,
        _ => Waveform::Square,
    });
    if let Some(Bandwidth::Hertz(_)) = bandwidth {
        value.problem(
            problems,
            "what is left of flickering light is known for an integration, not for a bandwidth",
            "give `integration_s: 0.1` in place of `bandwidth_hz`",
        );
        return None;
    }
    Some(Modulation { frequency_hz: frequency_hz?, depth: depth?, waveform: waveform? })
}
