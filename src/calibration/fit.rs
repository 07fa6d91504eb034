//! From exposures and readings to a fitted curve.
//!
//! ```text
//! first pass    smooth priors of every length and scale, by their evidence        → how large the curve is where
//! second pass   the same with ripples in proportion to √(curve/peak + 0.03)        → the curve, made non-negative
//! u²            noise of the second pass + 2² · structure of the first
//! ```
//!
//! The second pass knows where the curve is small. Its own structure variance would count the readings twice, so the first pass gives that,
//! widened by a factor of 2: a prior of one length is smoother than a curve with a notch. Without it 91 % to 98 % of the nodes lay
//! within their 99 % bands on the reference problems; with it 95 % and more do.

use nalgebra::{DMatrix, DVector};

use super::consistency::{self, Consistency, Outliers};
use super::error::CalibrationError;
use super::evidence::{ClassicRule, RulePoint, Trial, Whitened, classic_scale, rule_points, weighted};
use super::exposures::{Exposures, Readings, lit};
use super::parametric::Model;
use super::parametric_fit::{Parametric, fit_model};
use super::passes::{Passes, best, made_non_negative, non_negative, passes};
use super::posterior::{self, Posterior};
use super::prior::{self, Candidate, PriorKind};
use super::refit::Refitter;
use super::whitening::whitened;

/// Widening of the structure variance's root.
const STRUCTURE_FACTOR: f64 = 2.0;
/// Standard deviations of χ² beyond which a fit is said not to hold.
const MISFIT: f64 = 6.0;

/// How the smoothness is chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Chooser {
    /// Every smoothness, length and scale by its evidence: did best over the reference problems without knowing the truth.
    #[default]
    Evidence,
    /// One scale of second differences, by a classic rule.
    Classic(ClassicRule),
}

/// How to fit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FitOptions {
    /// What the curve is: any smooth one, or one of few parameters.
    pub model: Model,
    /// Which curves are plausible.
    pub prior: PriorKind,
    /// How the smoothness is chosen.
    pub chooser: Chooser,
    /// What becomes of readings that contradict the rest.
    pub outliers: Outliers,
}

/// A fitted curve.
#[derive(Clone, Debug)]
pub struct FittedCurve {
    /// The channel.
    pub channel: String,
    /// The curve at the nodes; nowhere negative.
    pub values: Vec<f64>,
    /// Covariance from the noise of the readings.
    pub noise: DMatrix<f64>,
    /// Covariance of what the readings leave open: bias of the smooth fit, and parts that no exposure sees.
    pub structure: DMatrix<f64>,
    /// Covariance, noise and structure, under the prior that knows where the curve is small: what to expect of further readings. It counts these
    /// readings twice, so it is no statement of uncertainty.
    pub expected: DMatrix<f64>,
    /// `curve = gain · readings`, but for non-negativity.
    pub gain: DMatrix<f64>,
    /// What is open, 0 to 1, a node each: near 1 the curve there is the prior's guess. The share of the variance before the readings that is left, or what
    /// the averaging kernel misses of a curve that is 1 everywhere, whichever is larger (a camera's prior holds no such curve). It is 1 below the first and
    /// above the last node within the width at half maximum of an exposure: how a curve goes on is not known from where it was seen.
    pub undetermined: Vec<f64>,
    /// χ² of the residuals in units of the uncertainties, those of down-weighted readings widened.
    pub chi_squared: f64,
    /// How many numbers the readings determine.
    pub effective_parameters: f64,
    /// Residuals over their stated standard uncertainties.
    pub residuals: Vec<f64>,
    /// Which readings contradict the rest.
    pub consistency: Consistency,
    /// What the square of each reading's uncertainty was divided by, an exposure each: 1, unless readings were down-weighted.
    pub weights: Vec<f64>,
    /// The parameters, if the curve is that of a parametric model.
    pub parametric: Option<Parametric>,
}

/// What came of a fit.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// The nodes, nm.
    pub wavelengths_nm: Vec<f64>,
    /// A channel each.
    pub curves: Vec<FittedCurve>,
    /// The prior that the readings speak for, or the parametric model, in words.
    pub prior: String,
    /// Its length, nm; not a number for a parametric model, and neither is the next.
    pub length_nm: f64,
    /// ln p of the readings, up to a constant.
    pub log_evidence: f64,
    /// What the classic rules look at, a channel each; empty unless one was asked for.
    pub rule_points: Vec<Vec<RulePoint>>,
    /// What a reader should know.
    pub remarks: Vec<String>,
}

impl FittedCurve {
    /// Standard uncertainty at each node, noise and structure together.
    #[must_use]
    pub fn standard_uncertainties(&self) -> Vec<f64> {
        (0..self.values.len()).map(|k| (self.noise[(k, k)] + self.structure[(k, k)]).max(0.0).sqrt()).collect()
    }

    /// Covariance, noise and structure together.
    #[must_use]
    pub fn covariance(&self) -> DMatrix<f64> {
        &self.noise + &self.structure
    }
}

/// Fits a curve to each channel; the channels share their exposures and the smoothness.
///
/// # Errors
/// Readings that are not finite, too few or too many, uncertainties below zero, exposures that see nothing.
///
/// ```
/// use etendue::calibration::{Exposures, FitOptions, Readings, fit};
/// use etendue::spectrum::Density;
///
/// let nodes: Vec<f64> = (40..=70).map(|k| 10.0 * f64::from(k)).collect();
/// let spectra: Vec<(String, Density)> = (40..=70)
///     .map(|k| Ok((format!("{k}0 nm"), Density::gaussian(1.0, 10.0 * f64::from(k), 8.0)?)))
///     .collect::<Result<_, etendue::spectrum::SpectrumError>>()?;
/// let exposures = Exposures::new(&nodes, &spectra)?;
/// let truth: Vec<f64> = nodes.iter().map(|nm| (-0.5 * ((nm - 555.0) / 45.0).powi(2)).exp()).collect();
/// let values = exposures.expected(&truth);
/// let readings = Readings { channel: "E_v".into(), standard_uncertainties: vec![1e-4; values.len()], values };
/// let fitted = fit(&exposures, &[readings], &FitOptions::default())?;
/// assert!(fitted.curves[0].values.iter().zip(&truth).all(|(s, t)| (s - t).abs() < 2e-3));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn fit(exposures: &Exposures, readings: &[Readings], options: &FitOptions) -> Result<Fitted, CalibrationError> {
    let once = |exposures: &Exposures, readings: &[Readings]| -> Result<Fitted, CalibrationError> {
        let data = whitened(exposures, readings)?;
        match (&options.model, options.chooser) {
            (Model::Smooth, Chooser::Evidence) => by_evidence(exposures, readings, &options.prior, &data),
            (Model::Smooth, Chooser::Classic(rule)) => by_rule(exposures, readings, rule, &data),
            (model, Chooser::Evidence) => {
                fit_model(exposures, readings, model, &by_evidence(exposures, readings, &options.prior, &data)?, &data)
            }
            (_, Chooser::Classic(_)) => {
                let say = "a parametric model has no smoothness to be chosen; leave out the rule (`--choose`) or the model";
                Err(CalibrationError::Model(say.to_owned()))
            }
        }
    };
    let mut fitted = consistency::examined(exposures, readings, options.outliers, &once)?;
    for (curve, readings) in fitted.curves.iter().zip(readings) {
        let m = exposures.len() as f64;
        // Readings without noise are held to their rounding, which says nothing of the model.
        if readings.standard_uncertainties.iter().all(|u| *u > 0.0) && curve.chi_squared > m + MISFIT * (2.0 * m).sqrt() {
            fitted.remarks.push(format!(
                "{}: the curve does not explain the readings (χ² = {:.3e} of {m} readings), so its uncertainty means nothing: the stated \
                 uncertainties, the exposures, the model or the rule for the smoothness are wrong",
                curve.channel, curve.chi_squared
            ));
        }
    }
    let said: Vec<String> = fitted.curves.iter().zip(readings).flat_map(|(curve, readings)| super::remarks::of(curve, readings)).collect();
    fitted.remarks.extend(said);
    Ok(fitted)
}

/// Prepares fits of further readings of the same exposures, as noisy as these: for Monte Carlo, whose thousand fits share every factorisation.
///
/// # Errors
/// As [`fit`].
pub fn warm(exposures: &Exposures, readings: &[Readings], prior: &PriorKind) -> Result<Refitter, CalibrationError> {
    let data = whitened(exposures, readings)?;
    let passes = passes(exposures, readings, prior, &data)?;
    Refitter::new(passes.second, data, readings)
}

fn by_evidence(exposures: &Exposures, readings: &[Readings], kind: &PriorKind, data: &Whitened) -> Result<Fitted, CalibrationError> {
    let nodes = exposures.wavelengths_nm();
    let Passes { first, posteriors, second } = passes(exposures, readings, kind, data)?;
    let (chosen, best) = (best(&second)?, best(&first)?);
    let mut remarks = Vec::new();
    let weights = weighted(&second);
    let mut curves = Vec::with_capacity(readings.len());
    for (c, first) in posteriors.into_iter().enumerate() {
        let second = posterior::average(&weights, c, data);
        let curve = non_negative(&second, chosen, c, data, &readings[c].channel, &mut remarks)?;
        let structure = first.structure.clone() * STRUCTURE_FACTOR.powi(2);
        curves.push(fitted(&readings[c], c, &curve, second, structure, &first, prior::components_of(kind) == 0, data));
    }
    Ok(Fitted {
        wavelengths_nm: nodes.to_vec(),
        curves,
        prior: best.candidate.name.clone(),
        length_nm: best.candidate.length_nm,
        log_evidence: best.log_evidence,
        rule_points: Vec::new(),
        remarks,
    })
}

fn by_rule(exposures: &Exposures, readings: &[Readings], rule: ClassicRule, data: &Whitened) -> Result<Fitted, CalibrationError> {
    let nodes = exposures.wavelengths_nm();
    let candidate: Candidate = prior::second_differences(nodes);
    let trial =
        Trial::new(candidate, data).ok_or_else(|| CalibrationError::Numbers("the readings leave the range of numbers".to_owned()))?;
    let mut remarks = Vec::new();
    let (mut curves, mut points) = (Vec::new(), Vec::new());
    for (c, r) in readings.iter().enumerate() {
        let of_channel = rule_points(&trial, c, data);
        let a = classic_scale(rule, &of_channel, r.values.len()).unwrap_or(data.scale);
        let posterior = posterior::at_scale(&trial, c, a, data);
        let root = posterior::root(&trial, c, a);
        let curve = made_non_negative(&posterior.mean, &root, &r.channel, &mut remarks)?;
        let structure = posterior.structure.clone();
        let first = posterior.clone();
        curves.push(fitted(r, c, &curve, posterior, structure, &first, true, data));
        points.push(of_channel);
    }
    Ok(Fitted {
        wavelengths_nm: nodes.to_vec(),
        curves,
        prior: trial.candidate.name.clone(),
        length_nm: trial.candidate.length_nm,
        log_evidence: trial.log_evidence,
        rule_points: points,
        remarks,
    })
}

#[allow(clippy::too_many_arguments)]
fn fitted(
    readings: &Readings,
    channel: usize,
    curve: &DVector<f64>,
    posterior: Posterior,
    structure: DMatrix<f64>,
    first: &Posterior,
    constants: bool,
    data: &Whitened,
) -> FittedCurve {
    let residuals: DVector<f64> = &data.readings[channel] - &data.matrix * curve;
    let lit = lit(&data.matrix);
    let left =
        |k: usize| if first.prior_variance[k] > 0.0 { (first.structure[(k, k)] / first.prior_variance[k]).clamp(0.0, 1.0) } else { 0.0 };
    // The row of the averaging kernel, summed: what becomes of a curve that is 1 everywhere.
    let light = DVector::from_fn(data.units.len(), |i, _| data.units[i] * data.matrix.row(i).sum());
    let resolved = &first.gain * light;
    let left = |k: usize| if constants { left(k).max((1.0 - resolved[k]).abs().min(1.0)) } else { left(k) };
    let undetermined = (0..curve.len()).map(|k| if lit.contains(&k) { left(k) } else { 1.0 }).collect();
    // tr(A G): what the fitted readings owe to the readings.
    let effective_parameters = (0..data.units.len())
        .map(|i| data.units[i] * data.matrix.row(i).iter().zip(posterior.gain.column(i).iter()).map(|(a, g)| a * g).sum::<f64>())
        .sum();
    FittedCurve {
        channel: readings.channel.clone(),
        values: curve.iter().copied().collect(),
        expected: &posterior.noise + &posterior.structure,
        noise: posterior.noise,
        structure,
        gain: posterior.gain,
        undetermined,
        chi_squared: residuals.norm_squared(),
        effective_parameters,
        residuals: residuals.iter().copied().collect(),
        consistency: Consistency::default(),
        weights: vec![1.0; data.units.len()],
        parametric: None,
    }
}
