//! The measuring field of a luminance meter: a narrow beam across its edge, and a bright surround with a black middle.
//!
//! ```text
//! half-angle α₅₀: R(α₅₀) = R(0)/2        edge: α₁₀ − α₉₀        surround: Y(bright surround, black field) / Y(bright all over)
//! ```
//!
//! The last one is the index of the surrounding field as the literature on CIE 69 describes it. The sizes are this project's: the black
//! field is 10 % wider than the measuring field, the surround three times as wide or 80°, whichever is less.

use std::f64::consts::FRAC_PI_2;

use super::{Bench, BenchError, SetUp, beam, quotient, turned};
use crate::characterization::Figure;
use crate::estimate::Stop;
use crate::geometry::shape::{Disc, Shape, Side};
use crate::math::DVec3;
use crate::plan::PlanOptions;
use crate::scene::{Element, Pose};
use crate::source::{Emitter, Source};
use crate::spectrum::Density;

/// Poses of each of the two scans.
const POSES: u32 = 400;
/// Samples of a reading that has no formula: all points of the pupil see the same.
const POINT_SAMPLES: u64 = 64;
/// Rays of the screen.
const SAMPLES: u64 = 1 << 18;
/// How much wider than the field the black disc is.
const BLACK_OVER_FIELD: f64 = 1.1;
/// Distance of the screen in radii of the aperture, for a field of 1 rad; and the radius that stands for a point, m.
const APART: f64 = 1e3;
const NO_APERTURE_M: f64 = 1e-3;
/// How much wider than the field the surround is, and its largest half-angle, degrees.
const SURROUND_OVER_FIELD: f64 = 3.0;
const WIDEST_SURROUND_DEG: f64 = 80.0;

/// What was found about a measuring field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Field {
    /// Angle from the axis at which the response falls to one half, rad.
    pub half_angle_rad: Figure,
    /// Angle between 90 % and 10 % of the response, rad.
    pub edge_rad: Figure,
    /// Share of the reading of a bright field that its surround alone gives.
    pub surround: Figure,
}

/// What is led across the field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Probe {
    /// A parallel beam, the sensor turned before it.
    Beam,
    /// A point in the plane of focus, the sensor moved across it.
    PointAt {
        /// Distance of the plane of focus, m.
        focus_m: f64,
    },
}

impl Probe {
    /// The source, and the pose in which it stands at an angle from the axis.
    fn source(self, density: Density) -> Source {
        match self {
            Self::Beam => beam(density),
            Self::PointAt { focus_m } => Source { name: "point".to_owned(), emitter: Emitter::Point { at: focus_m * DVec3::Z }, density },
        }
    }

    fn pose(self, theta_rad: f64) -> Pose {
        match self {
            Self::Beam => turned(theta_rad, 0.0),
            Self::PointAt { focus_m } => Pose { at: -focus_m * theta_rad.tan() * DVec3::X, ..turned(0.0, 0.0) },
        }
    }

    /// Irradiance of the aperture over that on the axis: the cosine, and for a point two more of them by its distance.
    fn irradiance(self, theta_rad: f64) -> f64 {
        theta_rad.cos().powi(if self == Self::Beam { 1 } else { 3 })
    }
}

impl Bench<'_> {
    /// Scans the field out to `reach_rad`, which must lie beyond its edge.
    ///
    /// # Errors
    /// If the engine has no reading, or the sensor reads nothing along its axis or no edge up to `reach_rad`.
    pub fn field(&self, channel: usize, spectrum: &Density, reach_rad: f64, probe: Probe) -> Result<Field, BenchError> {
        let reach = reach_rad.min(0.999 * FRAC_PI_2);
        let levels = [0.9, 0.5, 0.1].map(|level| self.crossing(channel, spectrum, (reach, probe), level));
        let [at_90, at_50, at_10] = levels;
        let (at_90, half_angle_rad, at_10) = (at_90?, at_50?, at_10?);
        let edge_rad =
            Figure { value: at_10.value - at_90.value, standard_uncertainty: at_10.standard_uncertainty.hypot(at_90.standard_uncertainty) };
        let surround = self.surround(channel, spectrum, half_angle_rad.value.max(at_10.value), probe)?;
        Ok(Field { half_angle_rad, edge_rad, surround })
    }

    /// Where the response falls through a level for the first time: a scan over the field, and one over the step where it happens.
    fn crossing(&self, channel: usize, spectrum: &Density, (reach, probe): (f64, Probe), level: f64) -> Result<Figure, BenchError> {
        let (mut low, mut high) = (0.0, reach);
        for _ in 0..2 {
            let angles: Vec<f64> = (0..=POSES).map(|k| low + (high - low) * f64::from(k) / f64::from(POSES)).collect();
            let poses = std::iter::once(0.0).chain(angles.iter().copied()).map(|theta| probe.pose(theta)).collect();
            let set_up = SetUp { sources: vec![probe.source(spectrum.clone())], ..SetUp::default() };
            let stop = Stop { target: None, budget_seconds: None, samples: Some(POINT_SAMPLES) };
            let read = self.read_with(&self.sensor, set_up, poses, &PlanOptions::default(), &stop)?;
            let axis = read[0][channel].value;
            let response = |k: usize| read[k + 1][channel].value / (axis * probe.irradiance(angles[k]));
            let after = (1..angles.len()).find(|k| response(*k) < level && axis > 0.0);
            let Some(after) = after else { return Err(self.dark(channel, "the edge of a field that a beam was led across")) };
            (low, high) = (angles[after - 1], angles[after]);
        }
        // Anywhere within the last step.
        Ok(Figure { value: 0.5 * (low + high), standard_uncertainty: (high - low) / 12f64.sqrt() })
    }

    fn surround(&self, channel: usize, spectrum: &Density, half_angle_rad: f64, probe: Probe) -> Result<Figure, BenchError> {
        let outer = (SURROUND_OVER_FIELD * half_angle_rad).min(WIDEST_SURROUND_DEG.to_radians());
        let inner = BLACK_OVER_FIELD * half_angle_rad;
        if inner >= outer {
            return Err(self.dark(channel, "the surround of a field that leaves no room for one"));
        }
        let disc = |height_m: f64, angle: f64| Element {
            owner: "screen".to_owned(),
            shape: Shape::Disc(Disc {
                centre: height_m * DVec3::Z,
                normal: DVec3::NEG_Z,
                radius_m: height_m * angle.tan(),
                hole_radius_m: 0.0,
            }),
            front: 0,
            back: 0,
        };
        let stop = Stop { target: None, budget_seconds: None, samples: Some(SAMPLES) };
        let read = |elements: Vec<Element>| {
            let emitter = Emitter::Area { elements: vec![(0, Side::Front)] };
            let sources = vec![Source { name: "screen".to_owned(), emitter, density: spectrum.clone() }];
            let sensor = self.sensor.clone();
            let set_up = SetUp { sources, elements };
            self.read_with(&sensor, set_up, vec![turned(0.0, 0.0)], &PlanOptions::default(), &stop)
        };
        // So far that the aperture, seen from there, is small beside the gap between field and black disc.
        let far_m = match probe {
            Probe::Beam => APART / half_angle_rad * self.sensor.aperture.radius_m().max(NO_APERTURE_M),
            Probe::PointAt { focus_m } => focus_m,
        };
        let full = read(vec![disc(far_m, outer)])?[0][channel];
        let ring = read(vec![disc(far_m, outer), disc(0.99 * far_m, inner)])?[0][channel];
        if full.value > 0.0 { Ok(quotient(&ring, &full)) } else { Err(self.dark(channel, "a bright screen")) }
    }
}
