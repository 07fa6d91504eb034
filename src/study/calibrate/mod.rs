//! A calibration from end to end: light by the ray engine, readings simulated or given, fit, and what the curve is worth in use.
//!
//! ```text
//! Calibration ─campaign::light→ spectra at the sensor ─┬ campaign::simulated ─┐
//!                                                      └ a laboratory's table ┴→ readings ─calibration::fit→ curve ─→ f1′, F*, s_v
//! ```
//!
//! | file | what |
//! |---|---|
//! | `mod.rs` | the way from a campaign to fitted channels |
//! | `bends` | what a curve bends between its nodes, as a part of its uncertainty |
//! | [`colour`] | the colour error of a camera of three channels |
//! | `measured_light` | the light of the exposures, where a reference detector measured it |
//! | [`propagate`] | f1′, mismatch correction and luminous responsivity, with their uncertainties |
//! | [`range`] | readings beyond the straight range of the readout |
//! | [`suggest`] | which further exposure helps most |

pub(super) mod bends;
pub mod colour;
mod measured_light;
pub mod propagate;
pub mod range;
pub mod suggest;

use std::fmt;

use crate::calibration::evidence::RulePoint;
use crate::calibration::{
    CalibrationError, Exposures, FitOptions, Fitted, FittedCurve, Model, OpticalDensity, PriorKind, Readings, fit, simultaneous,
};
use crate::characterization::campaign::{self, CampaignError, ChannelReadings, Light};
use crate::characterization::substitution::MeasuredBeam;
use crate::estimate::{Stop, Watch};
use crate::quantity::Measurand;
use crate::scene::{Calibration, CurveModel};
use crate::spectrum::{Density, Factor, Outside, SpectrumError, Table};

pub(super) use measured_light::per_factor;
use measured_light::{add_shared, at_power, beam};
use propagate::Propagated;
use suggest::{Suggestion, Wanted};

/// What may be open at a node that counts as determined: a quarter of the variance before the readings (half of the uncertainty), or of what its averaging
/// kernel should weigh; see [`FittedCurve::undetermined`].
pub const UNDETERMINED: f64 = 0.25;

/// Probability with which a simultaneous band holds the whole curve.
pub const SIMULTANEOUS: f64 = 0.95;

/// How to calibrate.
#[derive(Clone, Debug, Default)]
pub struct CalibrateOptions {
    /// How to fit; the model is that of the file.
    pub fit: FitOptions,
    /// Seed of the noise of simulated readings and of the rays.
    pub seed: u64,
    /// How many further exposures to suggest.
    pub suggest: usize,
    /// What these are to make more certain.
    pub wanted: Wanted,
    /// When the ray engine stops.
    pub stop: Stop,
    /// Readings of a laboratory, a channel each and then the reference, if the campaign has one; simulated if there are none.
    pub data: Option<Vec<ChannelReadings>>,
}

/// Why there is no calibration.
#[derive(Debug)]
pub enum CalibrateError {
    /// The bench cannot be simulated.
    Campaign(CampaignError),
    /// The readings cannot be fitted.
    Fit(CalibrationError),
    /// A spectrum leaves the range of numbers.
    Spectrum(SpectrumError),
    /// No quantity of this name follows from the curve.
    Wanted {
        /// The name.
        name: String,
        /// Names of those that do.
        known: String,
    },
}

impl fmt::Display for CalibrateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Campaign(e) => e.fmt(f),
            Self::Fit(e) => e.fmt(f),
            Self::Spectrum(e) => e.fmt(f),
            Self::Wanted { name, known } => write!(f, "no quantity called \"{name}\" follows from the curve; there are: curve, {known}"),
        }
    }
}

impl std::error::Error for CalibrateError {}

impl From<CampaignError> for CalibrateError {
    fn from(e: CampaignError) -> Self {
        Self::Campaign(e)
    }
}

impl From<CalibrationError> for CalibrateError {
    fn from(e: CalibrationError) -> Self {
        Self::Fit(e)
    }
}

impl From<SpectrumError> for CalibrateError {
    fn from(e: SpectrumError) -> Self {
        Self::Spectrum(e)
    }
}

/// A channel, fitted.
#[derive(Clone, Debug)]
pub struct CalibratedChannel {
    /// What was read.
    pub readings: ChannelReadings,
    /// Unit of the curve, such as `lx/(W/m²)`.
    pub unit: String,
    /// What `∫ curve · E dλ` is multiplied by to give the reading: 1, the area of the aperture, or one over its projected solid angle.
    pub per_irradiance: f64,
    /// The curve at the nodes, with the covariance from noise and from what the readings leave open.
    pub curve: FittedCurve,
    /// Standard uncertainty at each node, the common scale and what the curve bends between its nodes included.
    pub standard_uncertainties: Vec<f64>,
    /// What the standard uncertainties are multiplied by for a band that holds the curve at all determined nodes at once with 95 %; `None` if no
    /// node is determined.
    pub simultaneous: Option<f64>,
    /// The true curve at the nodes, if the readings were simulated.
    pub truth: Option<Vec<f64>>,
    /// The largest share of a reading that came from outside of the nodes, with its exposure; known if the readings were simulated.
    pub outside: Option<(f64, String)>,
    /// Ranges of wavelength that the readings do not determine, nm.
    pub unseen_nm: Vec<(f64, f64)>,
    /// What the curve is worth in use.
    pub uses: Vec<Propagated>,
}

/// What came of a campaign.
#[derive(Clone, Debug)]
pub struct Calibrated {
    /// Title of the campaign.
    pub title: String,
    /// Title of the sensor.
    pub sensor: String,
    /// Whether the readings were simulated.
    pub simulated: bool,
    /// Exposures by name.
    pub labels: Vec<String>,
    /// Mean wavelength of each exposure's light, nm.
    pub centres_nm: Vec<f64>,
    /// Weights of the exposures on the nodes.
    pub exposures: Exposures,
    /// The nodes, nm.
    pub nodes_nm: Vec<f64>,
    /// Relative standard uncertainty that is common to the whole curve: irradiance scale and rays.
    pub scale_uncertainty: f64,
    /// The light, if a reference detector measured it.
    pub beam: Option<MeasuredBeam>,
    /// The channels.
    pub channels: Vec<CalibratedChannel>,
    /// The prior that the readings speak for, in words, and its length, nm.
    pub prior: (String, f64),
    /// What the classic rules for the smoothness look at, a channel each; empty unless one was asked for.
    pub rule_points: Vec<Vec<RulePoint>>,
    /// The colour error of a camera of three channels, a lamp each.
    pub colours: Vec<Propagated>,
    /// What further exposures are to make more certain.
    pub wanted: Wanted,
    /// Further exposures, the best first.
    pub suggestions: Vec<Suggestion>,
    /// Seed of noise and rays.
    pub seed: u64,
    /// Samples that the ray engine took.
    pub samples: u64,
    /// What a reader should know.
    pub remarks: Vec<String>,
}

/// Traces, reads, fits and propagates.
///
/// # Errors
/// [`CalibrateError`].
pub fn calibrate(calibration: &Calibration, options: &CalibrateOptions, watch: &Watch<'_>) -> Result<Calibrated, CalibrateError> {
    let light = campaign::light(calibration, &options.stop, options.seed, watch)?;
    let count = calibration.exposures.len();
    let (taken, candidates) = light.spectra.split_at(count);
    let mut readings = match &options.data {
        Some(data) => data.clone(),
        None => campaign::simulated(calibration, taken, options.seed),
    };
    let beam = beam(calibration, options, &mut readings, watch)?;
    let nodes = &calibration.nodes_nm;
    let exposures = match &beam {
        None => Exposures::new(nodes, taken)?,
        Some(beam) => Exposures::new(nodes, &at_power(taken, &beam.powers)?)?,
    };
    let sensor = &calibration.bench.instruments[0].sensor;
    let factors: Vec<f64> = sensor.channels.iter().map(|c| campaign::geometry_factor(sensor, c)).collect();
    let scaled: Vec<Readings> = readings.iter().zip(&factors).map(|(r, g)| per_factor(r, *g, beam.as_ref())).collect();
    let options_of_fit = FitOptions { prior: prior(options, &readings, nodes), model: model(&calibration.model), ..options.fit.clone() };
    let mut fitted = fit(&exposures, &scaled, &options_of_fit)?;
    let rays = calibration.scale_uncertainty.hypot(light.relative_uncertainty);
    let scale_uncertainty = beam.as_ref().map_or(rays, |beam| rays.hypot(beam.scale_uncertainty));
    beam.iter().for_each(|beam| fitted.curves.iter_mut().zip(&scaled).for_each(|(curve, read)| add_shared(curve, read, &beam.shared)));
    let mut channels = Vec::with_capacity(readings.len());
    let mut remarks = calibration.remarks.clone();
    remarks.extend(fitted.remarks.iter().cloned());
    for (c, (curve, readings)) in fitted.curves.iter().zip(readings).enumerate() {
        let simulated = options.data.is_none().then(|| campaign::sought(&sensor.channels[c]));
        let found = channel(calibration, curve, readings, simulated.as_ref(), taken, scale_uncertainty, options.seed)?;
        remarks.extend(bends::too_coarse(
            nodes,
            &found.curve.values,
            &found.curve.standard_uncertainties(),
            (&found.readings.channel, &found.unit),
        ));
        if let Some(truth) = &simulated {
            remarks.extend(propagate::beyond_nodes(&found.readings.channel, nodes, truth, &calibration.lamps)?);
        }
        remarks.extend(range::beyond_range(sensor, &sensor.channels[c], &found.readings, exposures.labels()));
        channels.push(in_units_of_readings(found, factors[c]));
    }
    let suggestions = if options.suggest > 0 && !candidates.is_empty() {
        let further = Exposures::new(nodes, candidates)?;
        let gradients = match &options.wanted {
            Wanted::Curve => Vec::new(),
            Wanted::Quantity(name) => gradients_of(&channels, name)?,
        };
        suggest::suggest(&fitted, &gradients, &further, &scaled, options.suggest)
    } else {
        Vec::new()
    };
    let assembled = assembled(calibration, options, &light, exposures, &fitted, channels, suggestions, scale_uncertainty, remarks);
    let colours = colour::colour_errors(&assembled.nodes_nm, &assembled.channels, &calibration.lamps, options.seed)?;
    Ok(Calibrated { beam, colours, ..assembled })
}

/// Derivatives of the quantity of this name, a channel each.
fn gradients_of(channels: &[CalibratedChannel], name: &str) -> Result<Vec<Vec<f64>>, CalibrateError> {
    let known: Vec<&str> = channels.iter().flat_map(|c| &c.uses).map(|q| q.name.as_str()).collect();
    let found = crate::naming::nearest(name, known.iter().copied());
    let of = |c: &CalibratedChannel| c.uses.iter().find(|q| Some(q.name.as_str()) == found).map(|q| q.gradient.clone());
    let gradients: Option<Vec<Vec<f64>>> = channels.iter().map(of).collect();
    gradients.filter(|g| !g.is_empty()).ok_or_else(|| CalibrateError::Wanted { name: name.to_owned(), known: known.join(", ") })
}

#[allow(clippy::too_many_arguments)]
fn assembled(
    calibration: &Calibration,
    options: &CalibrateOptions,
    light: &Light,
    exposures: Exposures,
    fitted: &Fitted,
    channels: Vec<CalibratedChannel>,
    suggestions: Vec<Suggestion>,
    scale_uncertainty: f64,
    remarks: Vec<String>,
) -> Calibrated {
    Calibrated {
        title: calibration.title.clone(),
        sensor: calibration.bench.instruments[0].sensor.title.clone(),
        simulated: options.data.is_none(),
        labels: exposures.labels().to_vec(),
        centres_nm: light.spectra[..exposures.len()].iter().map(|(_, s)| centre_nm(s)).collect(),
        exposures,
        nodes_nm: calibration.nodes_nm.clone(),
        scale_uncertainty,
        beam: None,
        channels,
        prior: (fitted.prior.clone(), fitted.length_nm),
        rule_points: fitted.rule_points.clone(),
        colours: Vec::new(),
        wanted: options.wanted.clone(),
        suggestions,
        seed: options.seed,
        samples: light.samples,
        remarks,
    }
}

/// Cameras have a prior of their own: three channels for red, green and blue, as their names say.
pub(super) fn prior(options: &CalibrateOptions, readings: &[ChannelReadings], nodes_nm: &[f64]) -> PriorKind {
    let names: Vec<String> = readings.iter().map(|r| r.channel.to_lowercase()).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    match (&options.fit.prior, names.as_slice()) {
        (PriorKind::Smooth, ["r", "g", "b"] | ["red", "green", "blue"]) => PriorKind::camera(nodes_nm).unwrap_or_default(),
        (given, _) => given.clone(),
    }
}

/// The model of the file, as the fit takes it.
pub(super) fn model(given: &CurveModel) -> Model {
    match given {
        CurveModel::Smooth => Model::Smooth,
        CurveModel::SumOfGaussians(n) => Model::SumOfGaussians(*n),
        CurveModel::FilterOnDetector(detector) => Model::FilterOnDetector(detector.clone()),
        CurveModel::DilutePigment => Model::VisualPigment(OpticalDensity::Dilute),
        CurveModel::Pigment(density) => Model::VisualPigment(OpticalDensity::Known(*density)),
        CurveModel::PigmentOfUnknownDensity => Model::VisualPigment(OpticalDensity::Fitted),
    }
}

/// Readings that contradict the rest, told in the unit of the readings.
fn in_units_of_readings(mut channel: CalibratedChannel, factor: f64) -> CalibratedChannel {
    channel.per_irradiance = factor;
    let consistency = &mut channel.curve.consistency;
    for outlier in &mut consistency.outliers {
        outlier.reading *= factor;
        outlier.expected *= factor;
    }
    consistency.contradictions.iter_mut().flat_map(|c| &mut c.readings).for_each(|y| *y *= factor);
    channel
}

fn channel(
    calibration: &Calibration,
    curve: &FittedCurve,
    readings: ChannelReadings,
    truth: Option<&Factor>,
    spectra: &[(String, Density)],
    scale: f64,
    seed: u64,
) -> Result<CalibratedChannel, CalibrateError> {
    let nodes = &calibration.nodes_nm;
    let (from, to) = (nodes[0], nodes[nodes.len() - 1]);
    let within = Factor::band(from, to, 1.0)?;
    let outside = truth.and_then(|truth| {
        let share = |(label, light): &(String, Density)| {
            let all = light.integral(&[truth]);
            (all > 0.0).then(|| (((all - light.integral(&[truth, &within])) / all).max(0.0), label.clone()))
        };
        spectra.iter().filter_map(share).max_by(|a, b| a.0.total_cmp(&b.0))
    });
    let on_nodes = |f: &Factor| nodes.iter().map(|nm| f.at(*nm)).collect::<Vec<f64>>();
    let fitted: Vec<f64> = curve.standard_uncertainties().iter().zip(&curve.values).map(|(u, s)| u.hypot(scale * s)).collect();
    Ok(CalibratedChannel {
        unit: curve_unit(&readings.measurand),
        standard_uncertainties: bends::with_bends(&curve.values, &fitted),
        simultaneous: simultaneous::factor(curve, scale, &|k| curve.undetermined[k] <= UNDETERMINED, SIMULTANEOUS, seed),
        truth: truth.map(on_nodes),
        outside,
        unseen_nm: ranges(nodes, &curve.undetermined),
        uses: propagate::uses(nodes, curve, truth, &calibration.lamps, scale, seed)?,
        curve: curve.clone(),
        per_irradiance: 1.0,
        readings,
    })
}

/// The fitted curve as a factor: linear between its nodes, zero beyond them.
///
/// # Errors
/// Nodes that are no table.
pub fn factor(nodes_nm: &[f64], values: &[f64]) -> Result<Factor, SpectrumError> {
    Ok(Factor::Table(Table::new(nodes_nm.to_vec(), values.to_vec(), Outside::Zero)?))
}

/// Unit of a curve whose integral with an irradiance (a flux, a radiance) is what the channel reads.
#[must_use]
pub fn curve_unit(measurand: &Measurand) -> String {
    let per = match measurand {
        Measurand::RadiantFlux | Measurand::LuminousFlux | Measurand::PhotonFlux | Measurand::Photocurrent => "W",
        Measurand::Radiance | Measurand::Luminance | Measurand::PhotonRadiance => "(W/(m² sr))",
        _ => "(W/m²)",
    };
    format!("{}/{per}", measurand.unit())
}

/// Mean wavelength of a spectrum within 1 nm to 1e5 nm.
fn centre_nm(light: &Density) -> f64 {
    let ramp = Table::from_rows(&[(1.0, 1.0), (1e5, 1e5)], Outside::Zero).map(Factor::Table);
    ramp.ok().and_then(|ramp| light.mean_of(&ramp)).unwrap_or(f64::NAN)
}

/// Ranges of nodes that are not determined, half a step beyond the nodes at either end.
fn ranges(nodes: &[f64], undetermined: &[f64]) -> Vec<(f64, f64)> {
    let mut found: Vec<(f64, f64)> = Vec::new();
    let mut open = false;
    for (k, share) in undetermined.iter().enumerate() {
        let low = if k == 0 { nodes[0] } else { 0.5 * (nodes[k - 1] + nodes[k]) };
        let high = nodes.get(k + 1).map_or(nodes[k], |next| 0.5 * (nodes[k] + next));
        let unseen = *share > UNDETERMINED;
        match found.last_mut().filter(|_| open && unseen) {
            Some(last) => last.1 = high,
            None if unseen => found.push((low, high)),
            None => {}
        }
        open = unseen;
    }
    found
}
