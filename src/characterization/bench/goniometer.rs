//! The goniometer: a parallel beam, the sensor turned before it.
//!
//! ```text
//! r(ε, φ) = Y(ε, φ) / Y(0)  =  R(ε, φ) cos ε / R(0)
//! ```

use std::f64::consts::TAU;

use super::{Bench, BenchError, beam, quotient, turned};
use crate::characterization::Figure;
use crate::spectrum::Density;

/// Relative readings over angles, of one channel.
#[derive(Debug, Clone, PartialEq)]
pub struct Goniogram {
    /// Angles of incidence ε, rad, rising from 0.
    pub theta_rad: Vec<f64>,
    /// Azimuths φ, rad, rising from 0.
    pub phi_rad: Vec<f64>,
    /// `readings[i_phi][i_theta]`, relative to that along the normal.
    pub readings: Vec<Vec<Figure>>,
}

impl Goniogram {
    /// R(ε, φ) = r / cos ε along one azimuth, at angles below 90°.
    #[must_use]
    pub fn response(&self, i_phi: usize) -> Vec<Figure> {
        self.theta_rad.iter().zip(&self.readings[i_phi]).map(|(theta, reading)| reading.scaled(1.0 / theta.cos())).collect()
    }
}

impl Bench<'_> {
    /// Turns the sensor from 0 to `upper_rad` in `steps` equal steps, in `azimuths` planes. `spectrum` is that of the beam.
    ///
    /// # Errors
    /// If the engine has no reading, or the sensor reads nothing along its normal.
    pub fn goniogram(
        &self,
        channel: usize,
        spectrum: &Density,
        upper_rad: f64,
        steps: u32,
        azimuths: u32,
    ) -> Result<Goniogram, BenchError> {
        let theta_rad: Vec<f64> = (0..=steps).map(|k| upper_rad * f64::from(k) / f64::from(steps)).collect();
        let phi_rad: Vec<f64> = (0..azimuths).map(|k| TAU * f64::from(k) / f64::from(azimuths)).collect();
        let poses = phi_rad.iter().flat_map(|phi| theta_rad.iter().map(|theta| turned(*theta, *phi))).collect();
        let figures: Vec<Figure> = self.read(vec![beam(spectrum.clone())], poses)?.iter().map(|pose| pose[channel]).collect();
        let along_normal = figures[0];
        if !(along_normal.value > 0.0 && along_normal.value.is_finite()) {
            return Err(self.dark(channel, "a beam along its normal"));
        }
        let relative: Vec<Figure> = figures.iter().map(|figure| quotient(figure, &along_normal)).collect();
        let readings = relative.chunks(theta_rad.len()).map(<[Figure]>::to_vec).collect();
        Ok(Goniogram { theta_rad, phi_rad, readings })
    }

    pub(super) fn dark(&self, channel: usize, before: &str) -> BenchError {
        let channel = self.sensor.channels.get(channel).map_or_else(String::new, |c| c.name.clone());
        BenchError::Dark { channel, before: before.to_owned() }
    }
}
