//! The flat field: a uniform luminous surround, sampled by rays.
//!
//! ```text
//! Y_flat / Y_beam · E/L = ∫ R cos θ dω / R(0)          π for a cosine receptor
//! ```
//!
//! The plan is the naive one: every term by rays, nothing by formula. It is the one apparatus that shares nothing with the closed forms,
//! and whose uncertainty is statistical.

use super::{Bench, BenchError, SetUp, quotient};
use crate::characterization::Figure;
use crate::estimate::Stop;
use crate::plan::PlanOptions;
use crate::source::{Emitter, Source};
use crate::spectrum::Density;

/// Rays of the flat field.
const SAMPLES: u64 = 1 << 16;

impl Bench<'_> {
    /// `∫ R cos θ dω / R(0)` of a channel, sr.
    ///
    /// # Errors
    /// If the engine has no reading, or the sensor reads nothing along its normal.
    pub fn flat_field_sr(&self, channel: usize, spectrum: &Density) -> Result<Figure, BenchError> {
        let sky = Source { name: "flat field".to_owned(), emitter: Emitter::Environment, density: spectrum.clone() };
        let set_up = SetUp { sources: vec![sky], ..SetUp::default() };
        let options = PlanOptions { naive: true, ..PlanOptions::default() };
        let stop = Stop { target: None, budget_seconds: None, samples: Some(SAMPLES) };
        let sensor = self.sensor.clone();
        let flat = self.read_with(&sensor, set_up, vec![self.reference], &options, &stop)?[0][channel];
        let beam = self.along_normal(channel, spectrum)?;
        if beam.value > 0.0 { Ok(quotient(&flat, &beam)) } else { Err(self.dark(channel, "a beam along its normal")) }
    }
}
