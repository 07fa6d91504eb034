//! Substitution: the sensor and an ideal meter in turn before the same lamp, along the normal.
//!
//! ```text
//! reading over truth  q(S) = Y(S) / X(S)              mismatch  F = q(A) / q(S):  true = reading × F after adjustment with A
//! ```

use std::sync::Arc;

use super::{Bench, BenchError, SetUp, beam, quotient, turned};
use crate::characterization::Figure;
use crate::estimate::Stop;
use crate::plan::PlanOptions;
use crate::quantity::Measurand;
use crate::sensor::{Acceptance, Aperture, Channel, Sensor};
use crate::spectrum::{Density, Factor};

impl Bench<'_> {
    /// What a channel reads of a parallel beam along the normal; the density is that of the irradiance.
    ///
    /// # Errors
    /// If the engine has no reading.
    pub fn along_normal(&self, channel: usize, spectrum: &Density) -> Result<Figure, BenchError> {
        let read = self.read(vec![beam(spectrum.clone())], vec![self.reference])?;
        Ok(read[0][channel])
    }

    /// What an ideal meter with the responsivity `target` reads in the same place: `∫ S V dλ`.
    ///
    /// # Errors
    /// If the engine has no reading.
    pub fn standard(&self, target: &Factor, spectrum: &Density) -> Result<Figure, BenchError> {
        let set_up = SetUp { sources: vec![beam(spectrum.clone())], ..SetUp::default() };
        let meter = Arc::new(ideal_meter(target));
        let read = self.read_with(&meter, set_up, vec![turned(0.0, 0.0)], &PlanOptions::default(), &Stop::default())?;
        Ok(read[0][0])
    }

    /// Reading over truth, in the unit of the channel per unit of `∫ S V dλ`.
    ///
    /// # Errors
    /// If the engine has no reading, or the ideal meter reads nothing.
    pub fn over_truth(&self, channel: usize, target: &Factor, spectrum: &Density) -> Result<Figure, BenchError> {
        let (reading, truth) = (self.along_normal(channel, spectrum)?, self.standard(target, spectrum)?);
        if truth.value > 0.0 && reading.value > 0.0 {
            Ok(quotient(&reading, &truth))
        } else {
            Err(self.dark(channel, "a lamp that it is compared with the truth before"))
        }
    }

    /// Share of a reading that is left when a filter is put before the lamp.
    ///
    /// # Errors
    /// If the engine has no reading, or reads nothing without the filter.
    pub fn share_behind(&self, channel: usize, source: &Density, filter: &Factor) -> Result<Figure, BenchError> {
        let (with, without) = (self.along_normal(channel, &source.filtered(filter))?, self.along_normal(channel, source)?);
        if without.value > 0.0 { Ok(quotient(&with, &without)) } else { Err(self.dark(channel, "a lamp without its filter")) }
    }

    /// The same for an ideal meter with the responsivity `target`.
    ///
    /// # Errors
    /// As [`Bench::share_behind`].
    pub fn share_of_standard(&self, target: &Factor, source: &Density, filter: &Factor) -> Result<Figure, BenchError> {
        let (with, without) = (self.standard(target, &source.filtered(filter))?, self.standard(target, source)?);
        Ok(quotient(&with, &without))
    }
}

/// Cosine receptor at a point that weighs with `target`.
fn ideal_meter(target: &Factor) -> Sensor {
    let channel = Channel::new("standard", target.clone(), Measurand::Irradiance, 1.0);
    Sensor::new("standard", Aperture::Point, Acceptance::Cosine, vec![channel])
}
