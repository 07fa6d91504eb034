//! A virtual bench: the sensor is put before sources and read by the engine, as a laboratory would characterise it.
//!
//! ```text
//! parallel beam from +z ─→ sensor at the origin, turned by (ε, φ)          a reading each: value, u
//! ```
//!
//! | file | apparatus | measured |
//! |---|---|---|
//! | `goniometer` | a parallel beam, the sensor turned | R(ε, φ) cos ε |
//! | `monochromator` | a parallel beam of one wavelength after the other | s(λ), relative |
//! | `substitution` | the sensor and an ideal meter in turn before the same lamp | reading over truth |
//! | `attenuator` | one lamp over decades of strength | Y(X)/X |
//! | `sphere` | a parallel beam from all round | w(θ, φ) of a head |
//! | `field` | a narrow beam across the edge of a cone; a bright surround with a black middle | half-angle, stray light |
//! | `flat_field` | a uniform luminous hemisphere, sampled by rays; a uniform disc at an f-number | ∫ R cos θ dω; photons |
//!
//! Every reading passes through scene, plan, estimate and measurement: nothing here looks at the curves of the sensor. Uncertainties are
//! those of the readings; what lies between the measured points is added by whoever computes an index (`sampling.rs`).

pub mod attenuator;
pub mod field;
pub mod flat_field;
pub mod goniometer;
pub mod monochromator;
pub mod sampling;
pub mod sphere;
pub mod substitution;

use std::cell::Cell;
use std::f64::consts::FRAC_PI_2;
use std::fmt;
use std::sync::Arc;

use super::Figure;
use crate::estimate::{EstimateError, Stop, Watch};
use crate::math::DVec3;
use crate::measurement::measure;
use crate::plan::{Plan, PlanError, PlanOptions};
use crate::scene::{Element, Instrument, Layout, Pose, Scene};
use crate::sensor::{Acceptance, Sensor};
use crate::source::{Emitter, Source};
use crate::spectrum::{Density, SpectrumError};
use crate::surface::Surface;

/// Why a sensor cannot be measured.
#[derive(Debug, Clone, PartialEq)]
pub enum BenchError {
    /// The engine has no reading.
    Estimate(EstimateError),
    /// The engine has no plan.
    Plan(String),
    /// A wavelength, a step or a spectrum of the bench is out of range.
    Spectrum(SpectrumError),
    /// The sensor reads nothing where it has to be compared with itself.
    Dark {
        /// Name of the channel.
        channel: String,
        /// What it was shown.
        before: String,
    },
}

impl fmt::Display for BenchError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Estimate(error) => error.fmt(f),
            Self::Plan(error) => f.write_str(error),
            Self::Spectrum(error) => error.fmt(f),
            Self::Dark { channel, before } => write!(f, "channel `{channel}` reads nothing of {before}"),
        }
    }
}

impl std::error::Error for BenchError {}

impl From<EstimateError> for BenchError {
    fn from(error: EstimateError) -> Self {
        Self::Estimate(error)
    }
}

impl From<PlanError> for BenchError {
    fn from(error: PlanError) -> Self {
        Self::Plan(error.to_string())
    }
}

impl From<SpectrumError> for BenchError {
    fn from(error: SpectrumError) -> Self {
        Self::Spectrum(error)
    }
}

/// A bench with a sensor on it.
pub struct Bench<'a> {
    sensor: Arc<Sensor>,
    reference: Pose,
    seed: u64,
    watch: &'a Watch<'a>,
    readings: Cell<usize>,
    rays: Cell<u64>,
}

impl<'a> Bench<'a> {
    /// A bench for a sensor, which faces the beam but for a cylinder, which has it at its side. The seed serves the readings that are sampled.
    ///
    /// The stated uncertainty of the responsivity is left out: it is the same in all readings and would not cancel in their quotients.
    pub fn new(mut sensor: Sensor, seed: u64, watch: &'a Watch<'a>) -> Self {
        sensor.channels.iter_mut().for_each(|channel| channel.responsivity_uncertainty.clear());
        let sensor = Arc::new(sensor);
        let theta = if sensor.acceptance == Acceptance::Cylindrical { FRAC_PI_2 } else { 0.0 };
        Self { sensor, reference: turned(theta, 0.0), seed, watch, readings: Cell::new(0), rays: Cell::new(0) }
    }

    /// The same bench with another sensor on it; what is read there is counted by [`Bench::count`].
    pub fn with(&self, sensor: Sensor) -> Bench<'a> {
        Bench::new(sensor, self.seed, self.watch)
    }

    /// Adds what was read on another bench.
    pub fn count(&self, other: &Bench<'_>) {
        let (readings, rays) = other.tally();
        self.readings.set(self.readings.get() + readings);
        self.rays.set(self.rays.get() + rays);
    }

    /// The sensor.
    pub fn sensor(&self) -> &Sensor {
        &self.sensor
    }

    /// How many readings were taken so far, and rays traced for them.
    pub fn tally(&self) -> (usize, u64) {
        (self.readings.get(), self.rays.get())
    }

    /// Readings of the sensor in several poses before some sources: `[pose][channel]`.
    ///
    /// # Errors
    /// If the engine has no reading.
    fn read(&self, sources: Vec<Source>, poses: Vec<Pose>) -> Result<Vec<Vec<Figure>>, BenchError> {
        let set_up = SetUp { sources, ..SetUp::default() };
        self.read_with(&self.sensor, set_up, poses, &PlanOptions::default(), &Stop::default())
    }

    fn read_with(
        &self,
        sensor: &Arc<Sensor>,
        set_up: SetUp,
        poses: Vec<Pose>,
        options: &PlanOptions,
        stop: &Stop,
    ) -> Result<Vec<Vec<Figure>>, BenchError> {
        let channels = sensor.channels.len().max(1);
        let instrument = Instrument { name: "sensor".to_owned(), sensor: Arc::clone(sensor), layout: Layout::List, poses };
        let scene = Scene {
            title: "virtual bench".to_owned(),
            elements: set_up.elements,
            surfaces: vec![Surface::black()],
            sources: set_up.sources,
            instruments: vec![instrument],
            ..Scene::default()
        };
        let plan = Plan::new(&scene, options)?;
        let quiet = Watch { now: self.watch.now, progress: &|_| {} };
        let measured = measure(&scene, &plan, stop, self.seed, &quiet)?;
        self.readings.set(self.readings.get() + measured.readings.len());
        self.rays.set(self.rays.get() + measured.counters.rays);
        let figures: Vec<Figure> = measured
            .readings
            .iter()
            .map(|reading| Figure { value: reading.value, standard_uncertainty: reading.standard_uncertainty() })
            .collect();
        Ok(figures.chunks(channels).map(<[Figure]>::to_vec).collect())
    }
}

/// What stands on the bench besides the sensor.
#[derive(Default)]
struct SetUp {
    sources: Vec<Source>,
    /// All of them black.
    elements: Vec<Element>,
}

/// A parallel beam that comes from +z; its density is the irradiance of a plane that faces it.
fn beam(density: Density) -> Source {
    Source { name: "beam".to_owned(), emitter: Emitter::Directional { travels: DVec3::NEG_Z }, density }
}

/// The pose in which light from +z comes in at the angle `theta_rad` from the sensor's normal, at the azimuth `phi_rad` from its x axis.
fn turned(theta_rad: f64, phi_rad: f64) -> Pose {
    let ((sin, cos), (sin_phi, cos_phi)) = (theta_rad.sin_cos(), phi_rad.sin_cos());
    Pose { at: DVec3::ZERO, normal: DVec3::new(-sin, 0.0, cos), x_axis: DVec3::new(cos * cos_phi, -sin_phi, sin * cos_phi) }
}

/// The pose in which light from +z comes in from the direction `to_local` of the sensor's frame.
fn turned_towards(to_local: DVec3) -> Pose {
    turned(to_local.x.hypot(to_local.y).atan2(to_local.z), to_local.y.atan2(to_local.x))
}

/// a/b with the uncertainty of both.
fn quotient(a: &Figure, b: &Figure) -> Figure {
    let value = a.value / b.value;
    let relative = |x: &Figure| if x.value == 0.0 { 0.0 } else { x.standard_uncertainty / x.value };
    let of_a = if a.value == 0.0 { a.standard_uncertainty / b.value } else { value * relative(a) };
    Figure { value, standard_uncertainty: of_a.hypot(value * relative(b)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turned_sensors_see_the_beam_where_it_is() {
        for (theta, phi) in [(0.0, 0.0), (0.3, 1.0), (1.2, 4.0), (2.5, -0.7)] {
            let pose = turned(theta, phi);
            let expected = DVec3::new(f64::sin(theta) * f64::cos(phi), f64::sin(theta) * f64::sin(phi), f64::cos(theta));
            let again = turned_towards(expected);
            assert!((again.normal - pose.normal).length() < 1e-14 && (again.x_axis - pose.x_axis).length() < 1e-14);
            let local = DVec3::new(pose.x_axis.z, pose.y_axis().z, pose.normal.z);
            assert!((local - expected).length() < 1e-15, "{theta} {phi}: {local}");
            assert!(pose.normal.dot(pose.x_axis).abs() < 1e-15 && (pose.x_axis.length() - 1.0).abs() < 1e-15);
        }
    }
}
