//! The monochromator: a parallel beam along the normal, of one wavelength after the other.
//!
//! ```text
//! s(λ) ∝ Y(λ) / E_e(λ),   E_e = 1 W/m² in a line at λ
//! ```
//!
//! Lines and not bands: a reading is s(λ) at that wavelength and no mean over a slit.

use super::{Bench, BenchError, beam};
use crate::characterization::Figure;
use crate::spectrum::Density;

/// Readings over wavelengths, of every channel.
#[derive(Debug, Clone, PartialEq)]
pub struct Spectrogram {
    /// Wavelengths, nm, in equal steps.
    pub wavelengths_nm: Vec<f64>,
    /// `readings[channel][i]`, per W/m², in the unit of the channel.
    pub readings: Vec<Vec<Figure>>,
}

impl Bench<'_> {
    /// Reads the sensor at `from_nm`, `from_nm + step_nm`, … up to `to_nm`.
    ///
    /// # Errors
    /// If a wavelength is not above zero, or the engine has no reading.
    pub fn spectrogram(&self, from_nm: f64, to_nm: f64, step_nm: f64) -> Result<Spectrogram, BenchError> {
        let steps = ((to_nm - from_nm) / step_nm).round().max(0.0) as u32;
        let wavelengths_nm: Vec<f64> = (0..=steps).map(|k| from_nm + step_nm * f64::from(k)).collect();
        let mut readings = vec![Vec::with_capacity(wavelengths_nm.len()); self.sensor.channels.len()];
        for nm in &wavelengths_nm {
            let read = self.read(vec![beam(Density::line(*nm, 1.0)?)], vec![self.reference])?;
            for (channel, figure) in readings.iter_mut().zip(&read[0]) {
                channel.push(*figure);
            }
        }
        Ok(Spectrogram { wavelengths_nm, readings })
    }
}
