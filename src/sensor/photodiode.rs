//! A photodiode with its amplifier, converter and display: from a photocurrent to what is indicated.
//!
//! ```text
//! I  = I_ph + I_d,   I_d = I_d0 · 2^((T − T_ref)/D)            photocurrent and dark current
//! U  = R (1 + e) N(I)                                         transimpedance R of the range, its error e, non-linearity N
//! Î  = (1 + e) N(I) − I_d(T_zero)                             indication, as a current
//! s² = 2 q I B + 4 k T B (1/R + 1/R_sh) + flicker + LSB²/12    variance of one reading, as a current
//! ```
//!
//! | symbol | field | unit |
//! |---|---|---|
//! | R, e | `ranges` | V/A, relative |
//! | B | `bandwidth` | Hz; an integration over t has B = 1/(2t) |
//! | T | `temperature_c` | °C |
//! | I_d0, T_ref, D, T_zero | `dark` | A, °C, K, °C |
//! | R_sh | `shunt_ohm` | Ω |
//! | corner, lowest frequency | `flicker` | Hz; 1/f noise equals the white noise at the corner |
//! | N | `nonlinearity` | quadratic `I (1 + β I)` or saturating `I / (1 + I/I_s)` |
//! | largest voltage | `saturation_v` | V |
//! | LSB | `adc` | full scale / 2^bits |
//!
//! Noise: Nyquist 1928, Schottky 1918; flicker noise integrated from the lowest frequency to B. The range is the one of highest gain that the
//! light, crests included, does not overdrive. Nothing is clipped without being said: see [`Readout::saturation`].
//!
//! ```
//! use etendue::sensor::photodiode::{Bandwidth, Photodiode, Range};
//!
//! let diode = Photodiode::new(vec![Range { feedback_ohm: 1e6, error: 0.0 }], Bandwidth::Hertz(10.0));
//! let readout = diode.readout(1e-6);
//! assert_eq!((readout.voltage_v, readout.indicated_a), (1.0, 1e-6));
//! // √(2 q I B) = 1.79 pA, √(4 k T B/R) = 0.41 pA at 25 °C.
//! assert!((readout.standard_deviation_a() - 1.836e-12).abs() < 1e-15);
//! ```

mod modulation;
mod noise;
#[cfg(test)]
mod tests;

pub use modulation::{Modulation, Waveform};
pub use noise::Noise;

/// 0 °C in K.
pub const ZERO_CELSIUS_K: f64 = 273.15;

/// A range of a transimpedance amplifier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Transimpedance gain, V/A, above zero; the feedback resistance in Ω.
    pub feedback_ohm: f64,
    /// Relative error of the gain after adjustment, such as 0.001: what a change of range brings.
    pub error: f64,
}

/// How fast the readout is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bandwidth {
    /// Equivalent noise bandwidth, Hz, above zero.
    Hertz(f64),
    /// Mean over this time, s, above zero.
    Integration(f64),
}

impl Bandwidth {
    /// Equivalent noise bandwidth, Hz.
    #[must_use]
    pub fn hertz(self) -> f64 {
        match self {
            Bandwidth::Hertz(hertz) => hertz,
            Bandwidth::Integration(seconds) => 0.5 / seconds,
        }
    }
}

/// Dark current over temperature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DarkCurrent {
    /// At the reference temperature, A, zero or more.
    pub current_a: f64,
    /// Reference temperature, °C.
    pub reference_temperature_c: f64,
    /// Rise of the temperature that doubles it, K, above zero.
    pub doubling_k: f64,
    /// Temperature at which the readout was set to zero in the dark, °C; if it never was, nothing is taken off.
    pub zeroed_at_c: Option<f64>,
}

impl DarkCurrent {
    /// At a temperature in °C, A.
    #[must_use]
    pub fn at_a(&self, temperature_c: f64) -> f64 {
        self.current_a * ((temperature_c - self.reference_temperature_c) / self.doubling_k).exp2()
    }

    /// What is taken off every reading, A.
    #[must_use]
    pub fn taken_off_a(&self) -> f64 {
        self.zeroed_at_c.map_or(0.0, |c| self.at_a(c))
    }
}

/// 1/f noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flicker {
    /// Frequency at which its density is that of the white noise, Hz, above zero.
    pub corner_hz: f64,
    /// Lowest frequency that matters, about one over the time since the readout was set to zero, Hz, above zero.
    pub lowest_hz: f64,
}

/// How the current departs from a straight line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Nonlinearity {
    /// `I (1 + β I)`.
    Quadratic {
        /// β, 1/A.
        per_a: f64,
    },
    /// `I / (1 + I/I_s)`.
    Saturating {
        /// I_s, the current that is never reached, A, above zero.
        limit_a: f64,
    },
}

impl Nonlinearity {
    /// The current beyond which nothing rises, A: where a parabola that opens downwards turns; infinite otherwise.
    #[must_use]
    pub fn turns_at_a(&self) -> f64 {
        match *self {
            Nonlinearity::Quadratic { per_a } if per_a < 0.0 => -0.5 / per_a,
            _ => f64::INFINITY,
        }
    }

    /// What becomes of a current, A. Beyond the turn of a parabola it stays at its top: no detector reads less of more light.
    #[must_use]
    pub fn of_a(&self, current_a: f64) -> f64 {
        match *self {
            Nonlinearity::Quadratic { per_a } => {
                let current_a = current_a.min(self.turns_at_a());
                current_a * (1.0 + per_a * current_a)
            }
            Nonlinearity::Saturating { limit_a } => current_a / (1.0 + current_a / limit_a),
        }
    }
}

/// An analogue-to-digital converter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Adc {
    /// Number of bits, 1 to 32.
    pub bits: u32,
    /// Voltage of the full scale, V, above zero.
    pub full_scale_v: f64,
}

impl Adc {
    /// Number of codes, 2^bits.
    #[must_use]
    pub fn codes(&self) -> f64 {
        f64::from(self.bits).exp2()
    }

    /// Voltage of one code, V.
    #[must_use]
    pub fn step_v(&self) -> f64 {
        self.full_scale_v / self.codes()
    }

    /// The code of a voltage: rounded, within 0 and 2^bits − 1.
    #[must_use]
    pub fn code(&self, voltage_v: f64) -> f64 {
        (voltage_v / self.step_v()).round().clamp(0.0, self.codes() - 1.0)
    }
}

/// A photodiode with its electronics.
#[derive(Clone, Debug, PartialEq)]
pub struct Photodiode {
    /// At least one.
    pub ranges: Vec<Range>,
    /// How fast it is.
    pub bandwidth: Bandwidth,
    /// Temperature of diode and resistors, °C, above absolute zero.
    pub temperature_c: f64,
    /// Dark current, if there is one.
    pub dark: Option<DarkCurrent>,
    /// Shunt resistance of the diode, Ω, above zero, if it counts.
    pub shunt_ohm: Option<f64>,
    /// 1/f noise, if there is some.
    pub flicker: Option<Flicker>,
    /// Departure from a straight line, if there is one.
    pub nonlinearity: Option<Nonlinearity>,
    /// Largest voltage of the amplifier, V, above zero, if it is bounded.
    pub saturation_v: Option<f64>,
    /// Converter, if there is one.
    pub adc: Option<Adc>,
    /// Digits of the display, 1 to 9, if it has one.
    pub display_digits: Option<u32>,
    /// How the light flickers, if it does.
    pub modulation: Option<Modulation>,
    /// Photocurrent per unit of the indication, A; needed where the responsivity is not in A/W or the aperture has no area.
    pub current_a_per_unit: Option<f64>,
}

/// What made a reading other than it should be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Deviation {
    /// Dark current that is not taken off, or taken off too much.
    Dark,
    /// Departure from a straight line.
    Nonlinearity,
    /// Error of the range.
    Range,
    /// What saturation cuts off.
    Saturation,
}

impl Deviation {
    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Deviation::Dark => "dark current",
            Deviation::Nonlinearity => "non-linearity",
            Deviation::Range => "error of the range",
            Deviation::Saturation => "saturation",
        }
    }
}

/// Why a reading is not what the light would give.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Saturation {
    /// The mean is at the limit: the reading is a lower bound.
    Whole,
    /// Crests of the modulated light are cut off; the reading leaves that out and is an upper bound.
    Crests,
}

/// An expected reading and how readings scatter about it.
#[derive(Clone, Debug, PartialEq)]
pub struct Readout {
    /// Index of the range.
    pub range: usize,
    /// Expected voltage, V.
    pub voltage_v: f64,
    /// Expected indication as a current, A.
    pub indicated_a: f64,
    /// Parts of `indicated_a` minus the photocurrent, A; they add up to it.
    pub deviations_a: Vec<(Deviation, f64)>,
    /// Standard deviations of one reading by cause, as currents, A.
    pub noise_a: Vec<(Noise, f64)>,
    /// Whether something was cut off.
    pub saturation: Option<Saturation>,
}

impl Readout {
    /// Standard deviation of one reading, the steps of the converter included, A.
    #[must_use]
    pub fn standard_deviation_a(&self) -> f64 {
        self.noise_a.iter().map(|(_, a)| *a).fold(0.0, f64::hypot)
    }
}

impl Photodiode {
    /// Noise of photocurrent and feedback alone, at 25 °C; the rest is set field by field.
    #[must_use]
    pub fn new(ranges: Vec<Range>, bandwidth: Bandwidth) -> Photodiode {
        Photodiode {
            ranges,
            bandwidth,
            temperature_c: 25.0,
            dark: None,
            shunt_ohm: None,
            flicker: None,
            nonlinearity: None,
            saturation_v: None,
            adc: None,
            display_digits: None,
            modulation: None,
            current_a_per_unit: None,
        }
    }

    /// Dark current at the temperature of use, A.
    #[must_use]
    pub fn dark_a(&self) -> f64 {
        self.dark.map_or(0.0, |dark| dark.at_a(self.temperature_c))
    }

    /// Largest voltage that is passed on, V; infinite without a limit.
    #[must_use]
    pub fn limit_v(&self) -> f64 {
        let converter = self.adc.map_or(f64::INFINITY, |adc| adc.step_v() * (adc.codes() - 1.0));
        self.saturation_v.unwrap_or(f64::INFINITY).min(converter)
    }

    /// Voltage on a range, V, as if there were no limit.
    fn voltage_v(&self, range: Range, current_a: f64) -> f64 {
        range.feedback_ohm * (1.0 + range.error) * self.nonlinearity.map_or(current_a, |n| n.of_a(current_a))
    }

    /// The range for a photocurrent: the highest gain that is not overdriven, or else the lowest gain.
    #[must_use]
    pub fn range_for(&self, photocurrent_a: f64) -> usize {
        let crest = self.modulation.map_or(1.0, |m| 1.0 + m.depth);
        let current_a = photocurrent_a * crest + self.dark_a();
        let mut by_gain: Vec<usize> = (0..self.ranges.len()).collect();
        by_gain.sort_by(|&a, &b| self.ranges[b].feedback_ohm.total_cmp(&self.ranges[a].feedback_ohm));
        let fits = |&&k: &&usize| self.voltage_v(self.ranges[k], current_a) <= self.limit_v();
        by_gain.iter().find(fits).or(by_gain.last()).copied().unwrap_or(0)
    }

    /// What a photocurrent in A is expected to give, and how readings scatter.
    #[must_use]
    pub fn readout(&self, photocurrent_a: f64) -> Readout {
        let index = self.range_for(photocurrent_a);
        let range = self.ranges.get(index).copied().unwrap_or(Range { feedback_ohm: f64::NAN, error: 0.0 });
        let (dark_a, taken_off_a) = (self.dark_a(), self.dark.map_or(0.0, |dark| dark.taken_off_a()));
        let current_a = photocurrent_a + dark_a;
        let bent_a = self.nonlinearity.map_or(current_a, |n| n.of_a(current_a));
        let (free_v, limit_v) = (self.voltage_v(range, current_a), self.limit_v());
        let voltage_v = free_v.min(limit_v);
        let mut deviations_a = Vec::new();
        let mut state = |cause: Deviation, a: f64| {
            if a != 0.0 {
                deviations_a.push((cause, a));
            }
        };
        state(Deviation::Dark, dark_a - taken_off_a);
        state(Deviation::Nonlinearity, bent_a - current_a);
        state(Deviation::Range, range.error * bent_a);
        state(Deviation::Saturation, (voltage_v - free_v) / range.feedback_ohm);
        let turn_a = self.nonlinearity.map_or(f64::INFINITY, |n| n.turns_at_a());
        let cut = |current_a: f64| self.voltage_v(range, current_a) > limit_v || current_a > turn_a;
        let crests = self.modulation.is_some_and(|m| cut(photocurrent_a * (1.0 + m.depth) + dark_a));
        let saturation = match (cut(current_a), crests) {
            (true, _) => Some(Saturation::Whole),
            (false, true) => Some(Saturation::Crests),
            (false, false) => None,
        };
        let noise_a = self.noise_a(range, photocurrent_a);
        let indicated_a = voltage_v / range.feedback_ohm - taken_off_a;
        Readout { range: index, voltage_v, indicated_a, deviations_a, noise_a, saturation }
    }

    /// Change of the expected indication with the photocurrent on a range; zero where the whole is cut off.
    #[must_use]
    pub fn slope(&self, range: usize, photocurrent_a: f64) -> f64 {
        let Some(range) = self.ranges.get(range) else { return f64::NAN };
        let current_a = photocurrent_a + self.dark_a();
        let turn_a = self.nonlinearity.map_or(f64::INFINITY, |n| n.turns_at_a());
        if self.voltage_v(*range, current_a) > self.limit_v() || current_a > turn_a {
            return 0.0;
        }
        let slope = match self.nonlinearity {
            None => 1.0,
            Some(Nonlinearity::Quadratic { per_a }) => 1.0 + 2.0 * per_a * current_a,
            Some(Nonlinearity::Saturating { limit_a }) => (1.0 + current_a / limit_a).powi(-2),
        };
        (1.0 + range.error) * slope
    }

    /// One reading with its noise, as a current in A: the same for the same seed and path of counters.
    ///
    /// Noise is normal, which holds for many electrons a reading; the light comes at a phase of its flicker that the seed gives.
    #[must_use]
    pub fn noisy_a(&self, photocurrent_a: f64, seed: u64, path: &[u64]) -> f64 {
        let readout = self.readout(photocurrent_a);
        let range = self.ranges.get(readout.range).copied().unwrap_or(Range { feedback_ohm: f64::NAN, error: 0.0 });
        let noise_a = noise::drawn_a(self, &readout, photocurrent_a, seed, path);
        let voltage_v = (readout.voltage_v + range.feedback_ohm * noise_a).min(self.limit_v());
        let seen_v = self.adc.map_or(voltage_v, |adc| adc.code(voltage_v) * adc.step_v());
        seen_v / range.feedback_ohm - self.dark.map_or(0.0, |dark| dark.taken_off_a())
    }

    /// Step of the display on a range, in the unit of the indication; `a_per_unit` is the photocurrent of one unit.
    ///
    /// Four digits show 1999 as well as 9999: the first digit is that of the largest indication of the range. `None` without a display or
    /// without a largest indication.
    #[must_use]
    pub fn display_step(&self, range: usize, a_per_unit: f64) -> Option<f64> {
        let largest = self.limit_v() / self.ranges.get(range)?.feedback_ohm / a_per_unit;
        let digits = i32::try_from(self.display_digits?).ok()?;
        (largest.is_finite() && largest > 0.0).then(|| 10f64.powi(largest.log10().floor() as i32 + 1 - digits))
    }

    /// Refers a standard deviation or a step of the converter to the input, A.
    fn converter_step_a(&self, range: Range) -> Option<f64> {
        self.adc.map(|adc| adc.step_v() / range.feedback_ohm)
    }
}
