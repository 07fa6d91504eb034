//! Which smoothness and which scale the readings speak for.
//!
//! ```text
//! whitened:  B = diag(1/u) A L = U S Vᵀ,  z = Uᵀ (y/u),  w = a² s²
//! −2 ln p(y | a, prior) = Σ ln(1 + w) + Σ z²/(1 + w) + |y/u − U z|² + const
//! ```
//!
//! | rule | scale a |
//! |---|---|
//! | evidence | every scale by its probability, and so every smoothness and length |
//! | discrepancy | the smallest whose residuals have χ² = number of readings |
//! | generalised cross-validation | least `χ² / (m − Σ w/(1 + w))²` |
//! | L-curve | the corner of `ln χ²` against `ln |curve|²` |
//!
//! The last three are the classic ones: they choose a scale, of second differences alone.
//!
//! Source: MacKay, Neural Comput. 4 (1992) 415; Hansen, Rank-Deficient and Discrete Ill-Posed Problems (1998), 7.

use nalgebra::{DMatrix, DVector};

use super::prior::Candidate;

/// Scales that are tried, as powers of e about that of the readings, and their number.
const SCALES: (f64, f64, usize) = (-3.0, 5.0, 33);
/// Steps of the L-curve, in logarithms, below which it stands still.
const STANDING: f64 = 1e-3;
/// Probabilities below this share of the largest are left out.
pub(super) const NEGLIGIBLE: f64 = 1e-2;

/// Readings and weights in units of the standard uncertainties.
pub(super) struct Whitened {
    pub(super) matrix: DMatrix<f64>,
    /// A channel each.
    pub(super) readings: Vec<DVector<f64>>,
    /// What a reading was divided by.
    pub(super) units: Vec<f64>,
    /// The scale of a curve that reads what was read.
    pub(super) scale: f64,
    /// Share of a prior's trace that its factor may miss.
    pub(super) left_out: f64,
}

/// One member of the family, held against the readings.
pub(super) struct Trial {
    pub(super) candidate: Candidate,
    /// A channel each, or one for all.
    decompositions: Vec<Decomposition>,
    /// A channel each: `Uᵀ y`, and ln p at each scale.
    pub(super) channels: Vec<TrialChannel>,
    /// ln p, summed over the channels and over the scales.
    pub(super) log_evidence: f64,
}

pub(super) struct Decomposition {
    pub(super) u: DMatrix<f64>,
    pub(super) s: DVector<f64>,
    pub(super) v_t: DMatrix<f64>,
}

pub(super) struct TrialChannel {
    pub(super) z: DVector<f64>,
    /// `|y − U z|²`.
    pub(super) rest: f64,
    log_probability: Vec<f64>,
}

impl Trial {
    /// Holds a candidate against the readings; `None` where the numbers leave their range.
    pub(super) fn new(candidate: Candidate, data: &Whitened) -> Option<Trial> {
        let scales = scales(data.scale);
        let mut decompositions = Vec::with_capacity(candidate.factors.len());
        for factor in &candidate.factors {
            let svd = (&data.matrix * factor).try_svd(true, true, f64::EPSILON, 10_000)?;
            decompositions.push(Decomposition { u: svd.u?, s: svd.singular_values, v_t: svd.v_t? });
        }
        let mut channels = Vec::with_capacity(data.readings.len());
        let mut log_evidence = 0.0;
        for (c, y) in data.readings.iter().enumerate() {
            let d = &decompositions[c.min(decompositions.len() - 1)];
            let z = d.u.transpose() * y;
            let rest = (y - &d.u * &z).norm_squared();
            let log_probability: Vec<f64> = scales.iter().map(|a| log_probability(*a, &d.s, &z, rest)).collect();
            log_evidence += log_sum(&log_probability);
            channels.push(TrialChannel { z, rest, log_probability });
        }
        log_evidence.is_finite().then_some(Trial { candidate, decompositions, channels, log_evidence })
    }

    pub(super) fn decomposition(&self, channel: usize) -> &Decomposition {
        &self.decompositions[channel.min(self.decompositions.len() - 1)]
    }

    /// Scales of a channel with their probabilities, which sum to one.
    pub(super) fn scales(&self, channel: usize, data: &Whitened) -> Vec<(f64, f64)> {
        let log = &self.channels[channel].log_probability;
        let most = log.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let mut kept: Vec<(f64, f64)> =
            scales(data.scale).into_iter().zip(log).map(|(a, l)| (a, (l - most).exp())).filter(|(_, p)| *p > NEGLIGIBLE).collect();
        normalise(&mut kept);
        kept
    }

    /// The most probable scale of a channel.
    pub(super) fn best_scale(&self, channel: usize, data: &Whitened) -> f64 {
        self.scales(channel, data).iter().fold((0.0, 0.0), |best, s| if s.1 > best.1 { *s } else { best }).0
    }
}

/// Trials with their probabilities, which sum to one; the negligible ones are left out.
pub(super) fn weighted(trials: &[Trial]) -> Vec<(&Trial, f64)> {
    let most = trials.iter().map(|t| t.log_evidence).fold(f64::NEG_INFINITY, f64::max);
    let mut kept: Vec<(&Trial, f64)> = trials.iter().map(|t| (t, (t.log_evidence - most).exp())).filter(|(_, p)| *p > NEGLIGIBLE).collect();
    normalise(&mut kept);
    kept
}

pub(super) fn normalise<T>(kept: &mut [(T, f64)]) {
    let sum: f64 = kept.iter().map(|k| k.1).sum();
    kept.iter_mut().for_each(|k| k.1 /= sum);
}

pub(super) fn scales(about: f64) -> Vec<f64> {
    let (low, high, count) = SCALES;
    (0..count).map(|i| about * (low + (high - low) * i as f64 / (count - 1) as f64).exp()).collect()
}

pub(super) fn log_probability(a: f64, s: &DVector<f64>, z: &DVector<f64>, rest: f64) -> f64 {
    let sum: f64 = s
        .iter()
        .zip(z.iter())
        .map(|(s, z)| {
            let w = (a * s).powi(2);
            w.ln_1p() + z * z / (1.0 + w)
        })
        .sum();
    -0.5 * (sum + rest)
}

pub(super) fn log_sum(logs: &[f64]) -> f64 {
    let most = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    most + logs.iter().map(|l| (l - most).exp()).sum::<f64>().ln()
}

/// A classic rule for one scale.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClassicRule {
    /// χ² of the residuals equals the number of readings.
    Discrepancy,
    /// Generalised cross-validation.
    CrossValidation,
    /// The corner of the L-curve.
    LCurve,
}

/// A point of the curves that the classic rules look at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RulePoint {
    /// The scale a.
    pub scale: f64,
    /// χ² of the residuals.
    pub chi_squared: f64,
    /// `|curve|²` in the norm of the prior.
    pub roughness: f64,
    /// `Σ w/(1 + w)`: how many numbers the readings determine.
    pub effective_parameters: f64,
    /// `χ² / (m − parameters)²`.
    pub cross_validation: f64,
}

/// The curves that the classic rules look at, from the stiffest to the loosest.
pub(super) fn rule_points(trial: &Trial, channel: usize, data: &Whitened) -> Vec<RulePoint> {
    const COUNT: usize = 241;
    let (d, c) = (trial.decomposition(channel), &trial.channels[channel]);
    let readings = data.readings[channel].len() as f64;
    (0..COUNT)
        .map(|i| {
            let scale = data.scale * (-14.0 + 32.0 * i as f64 / (COUNT - 1) as f64).exp();
            let (mut chi_squared, mut roughness, mut effective_parameters) = (c.rest, 0.0, 0.0);
            // m − p without a difference: a loose curve goes through every reading, and the ratio is one of small numbers.
            let mut left = readings - d.s.len() as f64;
            for (s, z) in d.s.iter().zip(c.z.iter()) {
                let w = (scale * s).powi(2);
                chi_squared += (z / (1.0 + w)).powi(2);
                roughness += (scale * scale * s * z / (1.0 + w)).powi(2);
                effective_parameters += w / (1.0 + w);
                left += 1.0 / (1.0 + w);
            }
            let cross_validation = if left > 0.0 { (chi_squared.sqrt() / left).powi(2) } else { f64::INFINITY };
            RulePoint { scale, chi_squared, roughness, effective_parameters, cross_validation }
        })
        .collect()
}

/// The scale that a classic rule chooses.
pub(super) fn classic_scale(rule: ClassicRule, points: &[RulePoint], readings: usize) -> Option<f64> {
    match rule {
        ClassicRule::Discrepancy => points.iter().find(|p| p.chi_squared <= readings as f64).or(points.last()).map(|p| p.scale),
        ClassicRule::CrossValidation => points.iter().min_by(|a, b| a.cross_validation.total_cmp(&b.cross_validation)).map(|p| p.scale),
        ClassicRule::LCurve => {
            let log = |p: &RulePoint| (p.chi_squared.max(f64::MIN_POSITIVE).ln(), p.roughness.max(f64::MIN_POSITIVE).ln());
            let bend = |w: &[RulePoint]| {
                let [(x0, y0), (x1, y1), (x2, y2)] = [log(&w[0]), log(&w[1]), log(&w[2])];
                let (dx, dy) = (0.5 * (x2 - x0), 0.5 * (y2 - y0));
                let (ddx, ddy) = (x2 - 2.0 * x1 + x0, y2 - 2.0 * y1 + y0);
                let step = dx.hypot(dy);
                // At both ends the curve stands still, and what is left of its steps is rounding.
                if step > STANDING { (dx * ddy - dy * ddx) / step.powi(3) } else { 0.0 }
            };
            // From stiff to loose the curve comes down the residuals and turns right, up the roughness.
            points.windows(3).min_by(|a, b| bend(a).total_cmp(&bend(b))).map(|w| w[1].scale)
        }
    }
}
