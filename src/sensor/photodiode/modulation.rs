//! Light that flickers about its mean, and what an integration leaves of it.
//!
//! ```text
//! sine     1 + m sin(2π(f t + φ))     ripple  m |sin(π f T)/(π f T)| / √2
//! square   1 ± m, half and half       ripple  m √(y² − 4y³/3) / (f T),   y = distance of f T from the nearest whole number
//! ```
//!
//! f is the frequency of the light, twice that of the mains; m the depth; T the time of integration; φ the phase, which is as good as random.
//! The ripple is the standard deviation over the phase, relative to the mean.

use std::f64::consts::{PI, SQRT_2, TAU};

/// Shape of the modulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Waveform {
    /// A sine.
    Sine,
    /// Bright and dim, half of the period each.
    Square,
}

/// Periodic light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Modulation {
    /// Frequency of the light, Hz, above zero: 100 Hz on mains of 50 Hz.
    pub frequency_hz: f64,
    /// (largest − smallest)/(largest + smallest), 0 to 1.
    pub depth: f64,
    /// Its shape.
    pub waveform: Waveform,
}

impl Modulation {
    /// Standard deviation of means over `seconds`, relative to the mean, for light that comes at any phase.
    #[must_use]
    pub fn ripple(&self, seconds: f64) -> f64 {
        let periods = self.frequency_hz * seconds;
        let rest = (periods - periods.round()).abs();
        match self.waveform {
            Waveform::Sine => self.depth * (PI * rest).sin() / (PI * periods) / SQRT_2,
            Waveform::Square => self.depth * rest * (1.0 - 4.0 / 3.0 * rest).sqrt() / periods,
        }
    }

    /// Mean over `seconds` that begin at the phase `start`, in periods; relative to the mean of the light.
    #[must_use]
    pub fn mean_over(&self, start: f64, seconds: f64) -> f64 {
        let periods = self.frequency_hz * seconds;
        let sum = match self.waveform {
            // ∫ sin 2πx dx from x₀ to x₀ + n, without the cancellation of cosines.
            Waveform::Sine => (PI * periods).sin() * (TAU * start + PI * periods).sin() / PI,
            Waveform::Square => {
                // ∫ of ±1 from 0 to x is a triangle wave.
                let triangle = |x: f64| 0.5 - (x.rem_euclid(1.0) - 0.5).abs();
                triangle(start + periods) - triangle(start)
            }
        };
        1.0 + self.depth * sum / periods
    }
}
