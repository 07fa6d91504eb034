//! The goniometer over the full sphere, for heads that see all round: a parallel beam from every node of a grid of directions.
//!
//! ```text
//! y(θ, φ) = Y(θ, φ) / Y(θ₀, φ₀),  bilinear between the nodes
//! ```
//!
//! θ and φ are those of the head (`head_mismatch`): the axis of a semicylinder is the sensor's y axis and its front the normal.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::{Bench, BenchError, beam, turned_towards};
use crate::characterization::Figure;
use crate::characterization::head_mismatch::Head;
use crate::math::DVec3;
use crate::spectrum::Density;

/// Steps in θ from pole to pole and in φ round; multiples of four, so that half of them and the reference are nodes.
const STEPS_THETA: usize = 72;
const STEPS_PHI: usize = 72;

/// Readings of a head over the sphere of directions, in the unit of the channel.
#[derive(Debug, Clone, PartialEq)]
pub struct Sphere {
    /// `readings[i_theta][i_phi]`, θ from 0 to π, φ from 0, without 2π.
    readings: Vec<Vec<Figure>>,
}

/// The direction (θ, φ) of a head in the frame of its sensor.
#[must_use]
pub fn to_local(head: Head, theta_rad: f64, phi_rad: f64) -> DVec3 {
    let ((sin, cos), (sin_phi, cos_phi)) = (theta_rad.sin_cos(), phi_rad.sin_cos());
    match head {
        Head::Semicylindrical => DVec3::new(sin * sin_phi, cos, sin * cos_phi),
        _ => DVec3::new(sin * cos_phi, sin * sin_phi, cos),
    }
}

impl Sphere {
    /// y(θ, φ), bilinear between every node, or between every other one.
    #[must_use]
    pub fn at(&self, theta_rad: f64, phi_rad: f64, coarse: bool) -> f64 {
        let stride = if coarse { 2 } else { 1 };
        let (rows, columns) = (STEPS_THETA / stride, STEPS_PHI / stride);
        let x = (theta_rad / PI * rows as f64).clamp(0.0, rows as f64);
        let y = phi_rad.rem_euclid(TAU) / TAU * columns as f64;
        let (i, j) = ((x.floor() as usize).min(rows - 1), y.floor() as usize % columns);
        let (s, t) = (x - i as f64, y - y.floor());
        let node = |i: usize, j: usize| self.readings[stride * i][stride * (j % columns)].value;
        let row = |i: usize| (1.0 - t) * node(i, j) + t * node(i, j + 1);
        (1.0 - s) * row(i) + s * row(i + 1)
    }

    /// Largest standard uncertainty of a reading.
    #[must_use]
    pub fn standard_uncertainty(&self) -> f64 {
        self.readings.iter().flatten().map(|figure| figure.standard_uncertainty).fold(0.0, f64::max)
    }
}

impl Bench<'_> {
    /// Reads a head before a beam from every node of the grid.
    ///
    /// # Errors
    /// If the engine has no reading.
    pub fn sphere(&self, channel: usize, spectrum: &Density, head: Head) -> Result<Sphere, BenchError> {
        let theta = |i: usize| PI * i as f64 / STEPS_THETA as f64;
        let phi = |j: usize| TAU * j as f64 / STEPS_PHI as f64;
        let nodes = (0..=STEPS_THETA).flat_map(|i| (0..STEPS_PHI).map(move |j| (i, j)));
        let poses = nodes.map(|(i, j)| turned_towards(to_local(head, theta(i), phi(j)))).collect();
        let figures: Vec<Figure> = self.read(vec![beam(spectrum.clone())], poses)?.iter().map(|pose| pose[channel]).collect();
        let sphere = Sphere { readings: figures.chunks(STEPS_PHI).map(<[Figure]>::to_vec).collect() };
        let (theta, phi) = head.reference_rad();
        debug_assert!(theta == 0.0 || theta == FRAC_PI_2);
        if sphere.at(theta, phi, false) > 0.0 { Ok(sphere) } else { Err(self.dark(channel, "a beam from the direction of reference")) }
    }
}
