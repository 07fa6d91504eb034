//! Frames: expected electrons → digital numbers, with noise.
//!
//! ```text
//! n ~ Poisson(g μ_e + μ_I t),   g = 1 + PRNU ζ₁
//! x = min(n, W) + μ_d0 + DSNU ζ₂ + σ_d0 ξ
//! y = clamp(⌊y₀ + K x + ½⌋, 0, 2^b − 1)
//! ```
//!
//! | number | is a function of | so it is |
//! |---|---|---|
//! | ζ₁, ζ₂ | seed, index of the pixel | fixed: the same in every frame |
//! | n, ξ | seed, index of the frame, index of the pixel | new in every frame |
//!
//! Random numbers are counted ([`Stream::bits`]), not taken from a state: a frame has the same bits whatever the number of threads and
//! the order of its parts, and frame 700 costs no more than frame 0. Shot noise is exact ([`poisson`](self), PTRS and inversion), and
//! the mean and variance of every pixel are known without a draw ([`codes`](crate::sensor::pixel::codes)).
//!
//! ```
//! use etendue::sensor::Pixel;
//!
//! let pixel = Pixel { read_noise_e: 8.0, ..Pixel::ideal(0.25, 14000.0, 64.0, 12) };
//! let frame = pixel.expose(&[1000.0; 10_000], 0.01, 20.0, 1, 0);
//! let mean = frame.iter().map(|y| f64::from(*y)).sum::<f64>() / 10_000.0;
//! // 64 DN and 1000 e⁻ at 0.25 DN/e⁻; the mean of 10⁴ pixels scatters by 0.08 DN.
//! assert!((mean - 314.0).abs() < 0.4);
//! ```

mod gaussian;
mod poisson;
#[cfg(test)]
mod tests;

use super::pixel::Pixel;
use crate::math::random::Stream;
use gaussian::normal;
use poisson::poisson;

/// Means from here on fill any well: the draw would be the mean to 1e-8.
const CERTAIN_E: f64 = 1e16;

/// Streams of a seed.
const PATTERN: u64 = 0x1288_0001;
const FRAMES: u64 = 0x1288_0002;

/// Which frame is taken, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exposure {
    /// Exposure time, s, 0 or more.
    pub exposure_s: f64,
    /// Temperature of the sensor, °C.
    pub temperature_c: f64,
    /// The sensor: its fixed pattern, and the series of frames.
    pub seed: u64,
    /// Which frame of the series.
    pub frame: u64,
}

/// The fixed pattern of one pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pattern {
    /// Relative responsivity 1 + PRNU ζ₁, 0 or more.
    pub responsivity: f64,
    /// Dark offset DSNU ζ₂, e⁻.
    pub offset_e: f64,
}

impl Pixel {
    /// The fixed pattern of pixel `index` of the sensor `seed`.
    #[must_use]
    pub fn pattern(&self, seed: u64, index: u64) -> Pattern {
        self.pattern_in(Stream::new(seed, &[PATTERN]), index)
    }

    #[inline(always)]
    fn pattern_in(&self, stream: Stream, index: u64) -> Pattern {
        let own = stream.child(index);
        let responsivity = if self.prnu > 0.0 { (1.0 + self.prnu * normal(own.bits(0))).max(0.0) } else { 1.0 };
        let offset_e = if self.dsnu_e > 0.0 { self.dsnu_e * normal(own.bits(1)) } else { 0.0 };
        Pattern { responsivity, offset_e }
    }

    /// A frame of a sensor all of whose pixels are `self`: `electrons_e` expected photo-electrons a pixel, 0 or more and finite, in any order
    /// of rows and columns. What is below zero or no number counts as no light.
    ///
    /// For more than one thread see [`frames`](crate::estimate::frames).
    #[must_use]
    pub fn expose(&self, electrons_e: &[f32], exposure_s: f64, temperature_c: f64, seed: u64, frame: u64) -> Vec<u16> {
        let mut digital = vec![0; electrons_e.len()];
        self.expose_part(&Exposure { exposure_s, temperature_c, seed, frame }, 0, electrons_e, &mut digital);
        digital
    }

    /// A part of a frame: the pixels from `first` on, into `digital`. As many are filled as the shorter of the two slices has.
    pub fn expose_part(&self, of: &Exposure, first: u64, electrons_e: &[f32], digital: &mut [u16]) {
        let model = self.linear(of.exposure_s, of.temperature_c);
        let pattern = Stream::new(of.seed, &[PATTERN]);
        let frame = Stream::new(of.seed, &[FRAMES, of.frame]);
        let largest = self.largest_dn();
        let offset_dn = self.black_dn + self.gain_dn_per_e * self.mean_dark_e;
        for (i, (electrons, out)) in electrons_e.iter().zip(digital).enumerate() {
            let index = first + i as u64;
            let own = self.pattern_in(pattern, index);
            let noise = frame.child(index);
            // The maximum drops a NaN.
            let mean = f64::from(*electrons).max(0.0) * own.responsivity + model.thermal_e;
            let electrons = if mean < CERTAIN_E { poisson(mean, noise, 1) } else { mean };
            let read = if self.read_noise_e > 0.0 { self.read_noise_e * normal(noise.bits(0)) } else { 0.0 };
            let charge = electrons.min(self.full_well_e) + own.offset_e + read;
            // Rounds to the nearest; a cast to u16 keeps to its range.
            *out = (offset_dn + self.gain_dn_per_e * charge + 0.5).floor().clamp(0.0, largest) as u16;
        }
    }
}
