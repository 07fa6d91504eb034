//! A calibration campaign, simulated: the light of each exposure at the sensor, and what the sensor reads.
//!
//! ```text
//! Eᵢ(λ) = Sᵢ(λ) [T₀(λ) + ρᵢ(λ) T₁(λ)]        yᵢ = g (1 + δ) ∫ s(λ) Eᵢ(λ) dλ + noise
//! ```
//!
//! | symbol | meaning | from |
//! |---|---|---|
//! | Sᵢ | what the source of the bench emits in exposure i | the calibration file |
//! | T₀, T₁ | irradiance per unit of source, with the test surface black, and what a white one adds | the ray engine, once for all exposures of a pose |
//! | ρᵢ | reflectance of the patch | the calibration file |
//! | s | responsivity of the channel times its scale | the sensor |
//! | δ | error of the irradiance scale, the same for all readings; with a reference the unknown power of the beam | drawn from its stated uncertainty; the file |
//! | g | 1, the area of the aperture, or one over its projected solid angle | what the channel reads |
//!
//! Light is linear, so one tracing serves every spectrum. Where every surface reflects alike at all wavelengths T is a number and the
//! integrals over wavelength are exact; else T is linear between [`BANDS`] wavelengths.

use std::sync::Arc;

use crate::estimate::{EstimateError, Stop, Watch};
use crate::math::random::Stream;
use crate::measurement::measure;
use crate::plan::{Plan, PlanError, PlanOptions};
use crate::quantity::Measurand;
use crate::scene::{Calibration, Exposure, Scene};
use crate::sensor::{Channel, Sensor};
use crate::spectrum::{Density, Factor, Outside, SpectrumError, Table};
use crate::surface::Surface;

/// Wavelengths between which the transfer of a coloured bench is linear.
pub const BANDS: usize = 48;
/// Keeps the random number of the scale apart from those of the readings, whose streams begin with the number of a channel.
const SCALE_STREAM: u64 = u64::MAX - 1;
/// Wavelengths at which a bench is looked at where the responsivity does not end, nm.
const WIDEST_NM: (f64, f64) = (200.0, 3000.0);

/// Readings of one channel.
#[derive(Clone, Debug, PartialEq)]
pub struct ChannelReadings {
    /// The channel.
    pub channel: String,
    /// What it reads.
    pub measurand: Measurand,
    /// The readings, an exposure each, in the unit of the measurand.
    pub values: Vec<f64>,
    /// Their standard uncertainties from noise.
    pub standard_uncertainties: Vec<f64>,
}

/// The light of all exposures at the sensor.
#[derive(Clone, Debug)]
pub struct Light {
    /// Label and spectral irradiance, W m⁻² nm⁻¹, of the exposures and then of the candidates.
    pub spectra: Vec<(String, Density)>,
    /// Relative standard uncertainty of the irradiance from the ray engine, the largest of all poses.
    pub relative_uncertainty: f64,
    /// Samples that were taken.
    pub samples: u64,
}

/// Why a campaign cannot be simulated.
#[derive(Debug)]
pub enum CampaignError {
    /// The bench cannot be planned.
    Plan(PlanError),
    /// The bench cannot be measured.
    Estimate(EstimateError),
    /// A spectrum leaves the range of numbers.
    Spectrum(SpectrumError),
    /// No light reaches the sensor in a pose.
    Dark(usize),
    /// The reading of the reference is too uncertain to scale another by.
    Reference {
        /// The exposure.
        exposure: String,
        /// What it reads.
        value: f64,
        /// The standard uncertainty of that.
        standard_uncertainty: f64,
    },
}

impl std::fmt::Display for CampaignError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Plan(e) => e.fmt(f),
            Self::Estimate(e) => e.fmt(f),
            Self::Spectrum(e) => e.fmt(f),
            Self::Reference { exposure, value, standard_uncertainty: u } => write!(
                f,
                "the reference reads {value:.3e} ± {u:.1e} in exposure \"{exposure}\", which gives no scale; allowed: above ten times its \
                 uncertainty; leave the exposure out, or give it more light"
            ),
            Self::Dark(pose) => {
                write!(f, "no light of the bench's source reaches the sensor in pose {pose}; see `etendue measure` with the bench's scene")
            }
        }
    }
}

impl std::error::Error for CampaignError {}

impl From<SpectrumError> for CampaignError {
    fn from(e: SpectrumError) -> Self {
        Self::Spectrum(e)
    }
}

/// Irradiance per unit of source at each wavelength, one for each pose.
struct Transfer {
    poses: Vec<Factor>,
    relative_uncertainty: f64,
    samples: u64,
}

/// Traces the bench and gives the light of each exposure at the sensor.
///
/// # Errors
/// [`CampaignError`].
pub fn light(calibration: &Calibration, stop: &Stop, seed: u64, watch: &Watch<'_>) -> Result<Light, CampaignError> {
    let test = calibration.test_surface;
    let dark = transfer(&with_test_surface(&calibration.bench, test, 0.0), stop, seed, watch)?;
    let all = || calibration.exposures.iter().chain(&calibration.candidates);
    let white = match test {
        Some(_) if all().any(|e| e.patch.is_some()) => {
            Some(transfer(&with_test_surface(&calibration.bench, test, 1.0), stop, seed, watch)?)
        }
        _ => None,
    };
    let at_sensor = |exposure: &Exposure| {
        let direct = dark.poses[exposure.pose].clone();
        let factor = match (&exposure.patch, &white) {
            (Some(patch), Some(white)) => {
                let added = Factor::Sum(vec![white.poses[exposure.pose].clone(), direct.clone().scaled(-1.0)]);
                Factor::Sum(vec![direct, Factor::Product(vec![patch.clone(), added])])
            }
            _ => direct,
        };
        if factor.support().is_empty() || factor.range_over(0.0, f64::INFINITY) == (0.0, 0.0) {
            return Err(CampaignError::Dark(exposure.pose));
        }
        Ok((exposure.label.clone(), exposure.emitted.filtered(&factor)))
    };
    let relative = white.as_ref().map_or(0.0, |w| w.relative_uncertainty).max(dark.relative_uncertainty);
    Ok(Light {
        spectra: all().map(at_sensor).collect::<Result<_, _>>()?,
        relative_uncertainty: relative,
        samples: dark.samples + white.map_or(0, |w| w.samples),
    })
}

fn with_test_surface(bench: &Scene, test: Option<usize>, reflectance: f64) -> Scene {
    let mut bench = bench.clone();
    if let Some(surface) = test.and_then(|at| bench.surfaces.get_mut(at)) {
        *surface = Surface { name: surface.name.clone(), reflectance: Factor::Constant(reflectance) };
    }
    bench
}

/// Measures the bench with a source of 1 per nm and an instrument that weighs wavelengths alike, or by bands.
fn transfer(bench: &Scene, stop: &Stop, seed: u64, watch: &Watch<'_>) -> Result<Transfer, CampaignError> {
    let sensor = &bench.instruments[0].sensor;
    let (from, to) = seen_nm(&sensor.channels);
    let grey = bench.surfaces.iter().all(|s| s.reflectance.is_constant_over(from, to).is_some());
    let knots: Vec<f64> = (0..BANDS).map(|i| from + (to - from) * i as f64 / (BANDS - 1) as f64).collect();
    let bands = if grey { vec![Factor::band(from, to, 1.0)?] } else { hats(&knots)? };
    let mut bench = bench.clone();
    bench.sources[0].density = Density::flat(from, to, 1.0)?;
    let channel = |(i, band): (usize, &Factor)| Channel::new(format!("band {i}"), band.clone(), Measurand::Irradiance, 1.0);
    let channels = bands.iter().enumerate().map(channel).collect();
    bench.instruments[0].sensor = Arc::new(Sensor::new(sensor.title.clone(), sensor.aperture, sensor.acceptance.clone(), channels));
    let plan = Plan::new(&bench, &PlanOptions::default()).map_err(CampaignError::Plan)?;
    let measured = measure(&bench, &plan, stop, seed, watch).map_err(CampaignError::Estimate)?;
    let per_pose = bands.len();
    let mut relative_uncertainty = 0.0f64;
    let uniform = Density::flat(from, to, 1.0)?;
    let areas: Vec<f64> = bands.iter().map(|band| uniform.integral(&[band])).collect();
    let mut poses = Vec::new();
    for readings in measured.readings.chunks(per_pose) {
        let values: Vec<f64> = readings.iter().zip(&areas).map(|(r, area)| r.value / area).collect();
        let (sum, u) = readings.iter().fold((0.0, 0.0), |(sum, u), r| (sum + r.value, u + r.standard_uncertainty()));
        if sum > 0.0 {
            relative_uncertainty = relative_uncertainty.max(u / sum);
        }
        poses.push(if grey { Factor::Constant(values[0]) } else { Factor::Table(Table::new(knots.clone(), values, Outside::Hold)?) });
    }
    Ok(Transfer { poses, relative_uncertainty, samples: measured.readings.iter().map(|r| r.samples).sum() })
}

/// Where any of the channels sees anything, nm.
fn seen_nm(channels: &[Channel]) -> (f64, f64) {
    let hulls = channels.iter().filter_map(|c| c.responsivity.support().hull());
    let (low, high) = hulls.fold((f64::INFINITY, 0.0f64), |(low, high), hull| (low.min(hull.0), high.max(hull.1)));
    let (low, high) = (low.max(WIDEST_NM.0), high.min(WIDEST_NM.1));
    if low < high { (low, high) } else { WIDEST_NM }
}

fn hats(knots: &[f64]) -> Result<Vec<Factor>, SpectrumError> {
    (0..knots.len())
        .map(|i| {
            let rows = (i.saturating_sub(1)..(i + 2).min(knots.len())).map(|k| (knots[k], if k == i { 1.0 } else { 0.0 }));
            Ok(Factor::Table(Table::from_rows(&rows.collect::<Vec<_>>(), Outside::Zero)?))
        })
        .collect()
}

/// The curve that a calibration of the channel seeks: its responsivity times its scale.
#[must_use]
pub fn sought(channel: &Channel) -> Factor {
    channel.responsivity.clone().scaled(channel.scale)
}

/// What the channel multiplies `∫ sought · E dλ` by: 1, the area of the aperture, or one over the projected solid angle.
#[must_use]
pub fn geometry_factor(sensor: &Sensor, channel: &Channel) -> f64 {
    channel.indication_per_irradiance(&sensor.aperture, &sensor.acceptance).map_or(1.0, |g| g / channel.scale)
}

/// Readings of the bench's sensor under these lights, with noise, and with an irradiance scale that is wrong by as much as it is uncertain.
#[must_use]
pub fn simulated(calibration: &Calibration, spectra: &[(String, Density)], seed: u64) -> Vec<ChannelReadings> {
    let sensor = &calibration.bench.instruments[0].sensor;
    let scale = 1.0 + calibration.scale_uncertainty * normal(seed, &[SCALE_STREAM]);
    let power = |i: usize| calibration.reference.as_ref().map_or(1.0, |r| r.beam.power(i, calibration.exposures.len()));
    let channels = sensor.channels.iter().enumerate().map(|(c, channel)| {
        let (curve, g) = (sought(channel), geometry_factor(sensor, channel));
        let truths: Vec<f64> = spectra.iter().enumerate().map(|(i, (_, light))| scale * power(i) * g * light.integral(&[&curve])).collect();
        let u: Vec<f64> = truths.iter().map(|y| calibration.noise.standard_uncertainty(*y, calibration.repeats)).collect();
        ChannelReadings {
            channel: channel.name.clone(),
            measurand: channel.reads.clone(),
            values: truths.iter().zip(&u).enumerate().map(|(i, (y, u))| y + u * normal(seed, &[c as u64, i as u64])).collect(),
            standard_uncertainties: u,
        }
    });
    channels.collect()
}

/// A number from the standard normal distribution (Box and Muller, Ann. Math. Stat. 29 (1958) 610).
#[must_use]
pub fn normal(seed: u64, path: &[u64]) -> f64 {
    let stream = Stream::new(seed, path);
    let (a, b) = (stream.child(0).number(), stream.child(1).number());
    (-2.0 * a.ln()).sqrt() * (std::f64::consts::TAU * b).cos()
}
