//! A calibration campaign: a bench, what is put in front of the sensor, how noisy its readings are, and where the curve is sought.

use std::sync::Arc;

use super::Scene;
use crate::sensor::Sensor;
use crate::spectrum::{Density, Factor};

/// One reading to be taken: light of one spectrum, in one pose of the instrument.
#[derive(Clone, Debug)]
pub struct Exposure {
    /// What it is called: "555 nm", "red", "patch 7 under D65".
    pub label: String,
    /// What the source of the bench emits, in the unit of that source's density.
    pub emitted: Density,
    /// Reflectance of the bench's test surface; none if the surface plays no part.
    pub patch: Option<Factor>,
    /// Pose of the instrument, from 0: exposures at one distance share it.
    pub pose: usize,
}

/// How readings scatter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// Standard deviation as a share of the reading.
    pub relative: f64,
    /// Standard deviation that every reading has, in the unit of the reading.
    pub absolute: f64,
    /// What the sensor reads in the dark, in the unit of the reading. It is read apart and subtracted, so the absolute noise comes twice.
    pub dark: Option<f64>,
}

impl Noise {
    /// Standard uncertainty of the mean of `repeats` readings of `value`.
    #[must_use]
    pub fn standard_uncertainty(&self, value: f64, repeats: u32) -> f64 {
        let times = if self.dark.is_some() { 2f64 } else { 1.0 };
        (self.relative * value).hypot(times.sqrt() * self.absolute) / f64::from(repeats.max(1)).sqrt()
    }
}

/// A detector of known responsivity that is read in the place of the sensor, in each exposure: the light is measured and need not be known.
#[derive(Clone, Debug)]
pub struct Substitution {
    /// The detector; one channel in A/W, with its standard uncertainty.
    pub sensor: Arc<Sensor>,
    /// How its readings scatter; repeated as often as those of the sensor.
    pub noise: Noise,
    /// Relative standard uncertainty of the place: both detectors in the same part of the beam. Common to all readings.
    pub alignment: f64,
    /// Relative standard deviation of the beam from the one reading to the other, independent in each exposure.
    pub stability: f64,
    /// What the beam is when readings are simulated.
    pub beam: Beam,
}

/// By how much a simulated beam differs from what its file says; the fit is not told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beam {
    /// Power over nominal power in the first exposure.
    pub factor: f64,
    /// Relative change of the power until the last exposure, steady.
    pub drift: f64,
}

impl Beam {
    /// Power over nominal power in exposure `index` of `count`.
    #[must_use]
    pub fn power(&self, index: usize, count: usize) -> f64 {
        self.factor * (1.0 + self.drift * index as f64 / count.saturating_sub(1).max(1) as f64)
    }
}

/// What the curve is taken to be.
#[derive(Clone, Debug, Default)]
pub enum CurveModel {
    /// Any smooth curve.
    #[default]
    Smooth,
    /// A sum of this many bell curves.
    SumOfGaussians(usize),
    /// A band of transmittance before a detector of this relative responsivity.
    FilterOnDetector(Factor),
    /// A visual pigment by its template, so dilute that its absorptance has the shape of its absorbance.
    DilutePigment,
    /// A visual pigment of this peak optical density.
    Pigment(f64),
    /// A visual pigment whose peak optical density is to be found.
    PigmentOfUnknownDensity,
}

/// A campaign as its file says it.
#[derive(Clone, Debug)]
pub struct Calibration {
    /// What it is called in reports.
    pub title: String,
    /// The bench: one source, one instrument, whose sensor is the truth when readings are simulated.
    pub bench: Scene,
    /// Index into [`Scene::surfaces`] of the surface that takes the reflectance of a patch.
    pub test_surface: Option<usize>,
    /// The readings to be taken, at least one.
    pub exposures: Vec<Exposure>,
    /// Exposures that could be added; for [suggestions](crate::study::calibrate).
    pub candidates: Vec<Exposure>,
    /// How readings scatter.
    pub noise: Noise,
    /// Readings of each exposure that are averaged.
    pub repeats: u32,
    /// Standard uncertainty of the irradiance scale, as a share: common to all readings.
    pub scale_uncertainty: f64,
    /// The detector that measures the light, if there is one.
    pub reference: Option<Substitution>,
    /// What the curve is taken to be.
    pub model: CurveModel,
    /// Nodes of the curve, nm, rising.
    pub nodes_nm: Vec<f64>,
    /// Lamps for which readings with the fitted curve are propagated, by name.
    pub lamps: Vec<(String, Density)>,
    /// A hash of every file that was read.
    pub hash: u64,
    /// How files were understood.
    pub remarks: Vec<String>,
}
