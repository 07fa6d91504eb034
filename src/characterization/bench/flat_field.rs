//! The flat field: a uniform luminous surround, sampled by rays; and the uniform disc of EMVA 1288.
//!
//! ```text
//! Y_flat / Y_beam · E/L = ∫ R cos θ dω / R(0)          π for a cosine receptor
//! E = π L / (1 + 4 N²)                                  the disc at the f-number N = distance/diameter
//! ```
//!
//! The plan of the surround is the naive one: every term by rays, nothing by formula. It is the one apparatus that shares nothing with the closed forms,
//! and whose uncertainty is statistical.

use super::{Bench, BenchError, SetUp, quotient};
use crate::characterization::Figure;
use crate::estimate::Stop;
use crate::geometry::shape::{Disc, Shape, Side};
use crate::math::DVec3;
use crate::plan::PlanOptions;
use crate::scene::Element;
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

    /// Readings of all channels behind the port of an integrating sphere: a uniform disc that faces the sensor at an f-number, above 0,
    /// with a spectral radiance in W/(m² sr nm).
    ///
    /// # Errors
    /// If the engine has no reading.
    pub fn port(&self, radiance: &Density, f_number: f64) -> Result<Vec<Figure>, BenchError> {
        let disc = Disc { centre: DVec3::Z, normal: DVec3::NEG_Z, radius_m: 0.5 / f_number, hole_radius_m: 0.0 };
        let elements = vec![Element { owner: "port".to_owned(), shape: Shape::Disc(disc), front: 0, back: 0 }];
        let emitter = Emitter::Area { elements: vec![(0, Side::Front)] };
        let sources = vec![Source { name: "port".to_owned(), emitter, density: radiance.clone() }];
        let sensor = self.sensor.clone();
        let read = self.read_with(&sensor, SetUp { sources, elements }, vec![self.reference], &PlanOptions::default(), &Stop::default())?;
        Ok(read.into_iter().next().unwrap_or_default())
    }
}
