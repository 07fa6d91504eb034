//! From readings to the few parameters of a [model](super::parametric), and to its curve with covariance.
//!
//! ```text
//! min  Σ ((yᵢ − aᵢ·s(p)) / uᵢ)² + Σ ((pⱼ − mⱼ)/σⱼ)²         N = Σ (aᵢ·J)ᵀ (aᵢ·J) / uᵢ²,  P = diag(1/σ²),  C = (N + P)⁻¹,  J = ∂s/∂p
//! noise:      J C N C Jᵀ
//! structure:  J C P C Jᵀ + (χ²/ν − 1) J C Jᵀ  if χ² > ν = readings − parameters
//! ```
//!
//! The second term widens the uncertainty by `√(χ²/ν)` where the model fits worse than the noise explains (Birge, Phys. Rev. 40 (1932) 207). That is the least
//! that a misfit means: a model that is wrong is wrong by an amount that no number here knows, so a misfit is said in words, too.
//!
//! The search starts from several places (`parametric.rs`), always the same ones; the lowest minimum is taken. Other minima that fit nearly as well with
//! another curve are told, and a search that does not end is an error.

use nalgebra::{DMatrix, DVector};

use super::consistency::Consistency;
use super::error::CalibrationError;
use super::evidence::Whitened;
use super::exposures::{Exposures, Readings};
use super::fit::{Fitted, FittedCurve};
use super::least_squares::{Minimum, jacobian, minimise};
use super::parametric::{MOST_GAUSSIANS, Model, OnNodes, Rule};
use super::posterior::product;

/// A parameter whose uncertainty is still this share of that before the readings is not determined.
const OPEN: f64 = 0.5;
/// Another minimum is told if its sum of squares is larger by at most this: it has a hundredth of the probability.
const NEARLY: f64 = 9.0;
/// And if its curve is apart by this many standard uncertainties somewhere.
const APART: f64 = 3.0;

/// A fitted parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// What it is.
    pub name: String,
    /// Its unit; empty for that of the curve.
    pub unit: &'static str,
    /// Its value.
    pub value: f64,
    /// Its standard uncertainty, misfit included.
    pub standard_uncertainty: f64,
    /// Whether the readings determine it: else it is what was plausible before.
    pub determined: bool,
}

/// What a parametric fit says beside its curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Parametric {
    /// The parameters.
    pub parameters: Vec<Parameter>,
    /// Readings minus parameters; none are left if it is zero.
    pub degrees_of_freedom: usize,
    /// What the uncertainties were multiplied by for the misfit, `√(χ²/ν)` and at least 1.
    pub widening: f64,
    /// Searches that were started, and how many of them ended in a minimum.
    pub searches: (usize, usize),
}

/// Fits the model to each channel; `smooth` is the smooth fit of the same readings.
pub(super) fn fit_model(
    exposures: &Exposures,
    readings: &[Readings],
    model: &Model,
    smooth: &Fitted,
    data: &Whitened,
) -> Result<Fitted, CalibrationError> {
    if let Model::SumOfGaussians(n) = model
        && !(1..=MOST_GAUSSIANS).contains(n)
    {
        return Err(CalibrationError::Model(format!("a sum of {n} Gaussians; allowed: 1 to {MOST_GAUSSIANS}")));
    }
    let on_nodes = OnNodes::new(model, exposures.wavelengths_nm());
    let mut remarks = Vec::new();
    let mut curves = Vec::with_capacity(readings.len());
    for (c, r) in readings.iter().enumerate() {
        let channel = ChannelFit { on_nodes: &on_nodes, data, channel: c, rules: on_nodes.rules(peak(&smooth.curves[c].values, data)) };
        curves.push(channel.fitted(&r.channel, &smooth.curves[c].values, &mut remarks)?);
    }
    Ok(Fitted {
        wavelengths_nm: exposures.wavelengths_nm().to_vec(),
        curves,
        prior: on_nodes.name(),
        length_nm: f64::NAN,
        log_evidence: f64::NAN,
        rule_points: Vec::new(),
        remarks,
    })
}

/// Height of a curve; of one that is zero, the scale of the readings.
fn peak(curve: &[f64], data: &Whitened) -> f64 {
    let peak = curve.iter().copied().fold(0.0, f64::max);
    if peak > 0.0 { peak } else { data.scale }
}

struct ChannelFit<'a> {
    on_nodes: &'a OnNodes<'a>,
    data: &'a Whitened,
    channel: usize,
    rules: Vec<Rule>,
}

impl ChannelFit<'_> {
    fn curve(&self, p: &DVector<f64>) -> Option<DVector<f64>> {
        self.on_nodes.curve(p.as_slice()).map(DVector::from_vec)
    }

    /// Residuals in units of the uncertainties, and distances from the prior in units of its spread.
    fn residuals(&self, p: &DVector<f64>) -> Option<DVector<f64>> {
        let of_readings = &self.data.matrix * self.curve(p)? - &self.data.readings[self.channel];
        let of_prior = self.rules.iter().zip(p.iter()).map(|(rule, p)| (p - rule.mean) / rule.spread);
        Some(DVector::from_iterator(of_readings.len() + self.rules.len(), of_readings.iter().copied().chain(of_prior)))
    }

    fn fitted(&self, name: &str, smooth: &[f64], remarks: &mut Vec<String>) -> Result<FittedCurve, CalibrationError> {
        let (m, n) = self.data.matrix.shape();
        let count = self.rules.len();
        let what = self.on_nodes.name();
        if m < count {
            let say =
                format!("{name}: {m} readings for the {count} parameters of a {what}; take as many exposures at least, or a simpler model");
            return Err(CalibrationError::Model(say));
        }
        let sizes = DVector::from_iterator(count, self.rules.iter().map(|rule| if rule.logarithm { 1.0 } else { 0.1 * rule.spread }));
        let starts = self.on_nodes.starts(smooth);
        let residuals = |p: &DVector<f64>| self.residuals(p);
        let found: Vec<Minimum> =
            starts.iter().filter_map(|start| minimise(&residuals, &DVector::from_column_slice(start), &sizes)).collect();
        let ended: Vec<&Minimum> = found.iter().filter(|minimum| minimum.converged).collect();
        let Some(&best) = ended.iter().min_by(|a, b| a.square.total_cmp(&b.square)) else {
            let lowest = found.iter().map(|m| m.square).fold(f64::INFINITY, f64::min);
            return Err(CalibrationError::Model(format!(
                "{name}: the {what} does not converge from any of {} starts (least χ² {lowest:.3e} for {m} readings); take a simpler model, or none for a \
                 smooth curve",
                starts.len()
            )));
        };
        if found.iter().any(|m| !m.converged && m.square < best.square - NEARLY) {
            remarks.push(format!("{name}: a search for the {what} fits better than the minimum that is taken, but did not end"));
        }
        let undefined = || CalibrationError::Numbers(format!("{name}: the {what} has no derivatives where it fits best"));
        let p = &best.parameters;
        let curve = self.curve(p).ok_or_else(undefined)?;
        let j = jacobian(&|p: &DVector<f64>| self.curve(p), p, &sizes, n).ok_or_else(undefined)?;
        let seen = &self.data.matrix * &j;
        // [A J/u; 1/σ] = U S Vᵀ keeps the digits that N + P would lose.
        let stacked = DMatrix::from_fn(m + count, count, |i, k| match i.checked_sub(m) {
            None => seen[(i, k)],
            Some(i) if i == k => 1.0 / self.rules[k].spread,
            Some(_) => 0.0,
        });
        let svd = stacked.try_svd(false, true, f64::EPSILON, 10_000).ok_or_else(undefined)?;
        let v = svd.v_t.ok_or_else(undefined)?.transpose();
        let c = product(&v, &svd.singular_values.map(|s| s.powi(-2)));
        let of_data = &self.data.readings[self.channel] - &self.data.matrix * &curve;
        let chi_squared = of_data.norm_squared();
        let degrees_of_freedom = m - count;
        let ratio = if degrees_of_freedom > 0 { (chi_squared / degrees_of_freedom as f64).max(1.0) } else { 1.0 };
        let c_p_half = &c * DMatrix::from_diagonal(&DVector::from_iterator(count, self.rules.iter().map(|rule| 1.0 / rule.spread)));
        let from_prior = &c_p_half * c_p_half.transpose();
        let onto_nodes = |covariance: &DMatrix<f64>| &j * covariance * j.transpose();
        let half = &c * seen.transpose();
        let noise = onto_nodes(&(&half * half.transpose()));
        let structure = onto_nodes(&(from_prior + (ratio - 1.0) * &c));
        let mut gain = &j * &half;
        for (i, unit) in self.data.units.iter().enumerate() {
            gain.column_mut(i).scale_mut(1.0 / unit);
        }
        let before: Vec<f64> = (0..n).map(|k| (0..count).map(|l| (j[(k, l)] * self.rules[l].spread).powi(2)).sum::<f64>()).collect();
        let after = |k: usize| noise[(k, k)] + structure[(k, k)];
        let undetermined = (0..n).map(|k| if before[k] > 0.0 { (after(k) / before[k]).clamp(0.0, 1.0) } else { 0.0 }).collect();
        let effective_parameters = (0..m).map(|i| (0..count).map(|k| seen[(i, k)] * half[(k, i)]).sum::<f64>()).sum();
        self.other_minima(&ended, best, &curve, &|k| after(k).sqrt(), name, remarks);
        Ok(FittedCurve {
            channel: name.to_owned(),
            values: curve.iter().copied().collect(),
            expected: &noise + &structure,
            undetermined,
            noise,
            structure,
            gain,
            chi_squared,
            effective_parameters,
            residuals: of_data.iter().copied().collect(),
            consistency: Consistency::default(),
            weights: vec![1.0; m],
            parametric: Some(Parametric {
                parameters: self.parameters(p, &(ratio * &c)),
                degrees_of_freedom,
                widening: ratio.sqrt(),
                searches: (starts.len(), ended.len()),
            }),
        })
    }

    fn parameters(&self, p: &DVector<f64>, covariance: &DMatrix<f64>) -> Vec<Parameter> {
        let of = |(k, rule): (usize, &Rule)| {
            let u = covariance[(k, k)].max(0.0).sqrt();
            let (value, per) = if rule.logarithm { (p[k].exp(), p[k].exp()) } else { (p[k], 1.0) };
            Parameter { name: rule.name.clone(), unit: rule.unit, value, standard_uncertainty: per * u, determined: u < OPEN * rule.spread }
        };
        self.rules.iter().enumerate().map(of).collect()
    }

    /// Tells of a minimum that fits nearly as well with another curve.
    fn other_minima(
        &self,
        ended: &[&Minimum],
        best: &Minimum,
        curve: &DVector<f64>,
        u: &dyn Fn(usize) -> f64,
        name: &str,
        remarks: &mut Vec<String>,
    ) {
        let apart = |other: &DVector<f64>| {
            (0..curve.len()).map(|k| (other[k] - curve[k]).abs() / u(k).max(1e-6 * curve.amax())).fold(0.0, f64::max)
        };
        let others = ended.iter().filter(|m| m.square < best.square + NEARLY);
        let worst = others.filter_map(|m| Some((apart(&self.curve(&m.parameters)?), m))).max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((apart, other)) = worst.filter(|(apart, _)| *apart > APART) {
            remarks.push(format!(
                "{name}: another {} fits nearly as well (χ² larger by {:.1}) with a curve that is up to {apart:.0} u away: the readings do not tell them apart",
                self.on_nodes.name(),
                other.square - best.square
            ));
        }
    }
}
