//! The same fit of other readings, fast: for Monte Carlo.
//!
//! ```text
//! first fit    exposures, uncertainties → priors with their factorisations B = U S Vᵀ, envelope          0.1 s
//! each refit   z = Uᵀ y/u → probabilities of all priors and scales → mean → nowhere negative             0.001 s
//! ```
//!
//! Exposures and uncertainties do not change, so the factorisations of every prior that the first readings leave possible are kept. The envelope
//! (where the curve is small) stays that of the first readings; smoothness, length and scale are weighed anew. The spread of refits is what noise
//! does to the curve, and so the check of the linear propagation.
//!
//! Source: JCGM 101 (GUM Supplement 1), 5.
//!
//! ```
//! use etendue::calibration::{Exposures, PriorKind, Readings, warm};
//! use etendue::spectrum::Density;
//!
//! let nodes: Vec<f64> = (40..=70).map(|k| 10.0 * f64::from(k)).collect();
//! let spectra = [500.0, 550.0, 600.0].map(|nm| Ok(("scan", Density::gaussian(1.0, nm, 20.0)?)));
//! let exposures = Exposures::new(&nodes, &spectra.into_iter().collect::<Result<Vec<_>, etendue::spectrum::SpectrumError>>()?)?;
//! let readings = Readings { channel: "E".into(), values: vec![1.0, 2.0, 1.0], standard_uncertainties: vec![0.01; 3] };
//! let refitter = warm(&exposures, &[readings], &PriorKind::Smooth)?;
//! let curves = refitter.refit(&[vec![1.01, 1.99, 1.0]])?;
//! assert_eq!(curves[0].len(), nodes.len());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use nalgebra::{DMatrix, DVector};

use super::error::CalibrationError;
use super::evidence::{NEGLIGIBLE, Trial, Whitened, log_probability, log_sum, normalise, scales};
use super::exposures::Readings;
use super::passes::{best, made_non_negative};
use super::posterior;

/// Priors that the first readings make less probable than this, relative to the best, are not kept.
const KEPT: f64 = 1e-6;

/// A prior with its factorisation, for one channel.
struct Kept {
    u_t: DMatrix<f64>,
    s: DVector<f64>,
    /// L V.
    l_v: DMatrix<f64>,
}

/// Fits further readings of the exposures that it was made for.
pub struct Refitter {
    /// `priors[prior][channel]`.
    priors: Vec<Vec<Kept>>,
    /// A square root of the covariance, a channel each, for the curve that is nowhere negative.
    roots: Vec<DMatrix<f64>>,
    scales: Vec<f64>,
    units: Vec<f64>,
    channels: Vec<String>,
}

impl Refitter {
    /// Of the trials of the second pass.
    pub(super) fn new(trials: Vec<Trial>, data: Whitened, readings: &[Readings]) -> Result<Refitter, CalibrationError> {
        let channels = 0..readings.len();
        let chosen = best(&trials)?;
        let most = chosen.log_evidence;
        let roots = channels.clone().map(|c| posterior::root(chosen, c, chosen.best_scale(c, &data))).collect();
        let kept = |trial: &Trial, c: usize| {
            let d = trial.decomposition(c);
            Kept { u_t: d.u.transpose(), s: d.s.clone(), l_v: trial.candidate.factor(c) * d.v_t.transpose() }
        };
        let possible = trials.iter().filter(|t| t.log_evidence - most > KEPT.ln());
        Ok(Refitter {
            priors: possible.map(|t| channels.clone().map(|c| kept(t, c)).collect()).collect(),
            roots,
            scales: scales(data.scale),
            units: data.units,
            channels: readings.iter().map(|r| r.channel.clone()).collect(),
        })
    }

    /// The curves of other readings, `values[channel][exposure]`.
    ///
    /// # Errors
    /// Readings of another number of channels or exposures, or that are not finite; no curve that is nowhere negative.
    pub fn refit(&self, values: &[Vec<f64>]) -> Result<Vec<Vec<f64>>, CalibrationError> {
        let m = self.units.len();
        if values.len() != self.channels.len() || values.iter().any(|v| v.len() != m || v.iter().any(|y| !y.is_finite())) {
            let what = format!("give {} channels of {m} finite readings each", self.channels.len());
            return Err(CalibrationError::Readings(what));
        }
        let readings: Vec<DVector<f64>> = values.iter().map(|v| DVector::from_fn(m, |i, _| v[i] / self.units[i])).collect();
        // For each prior: ln p over all channels, and of each channel z and ln p at each scale.
        let held = |prior: &Vec<Kept>| {
            let of = |(kept, y): (&Kept, &DVector<f64>)| {
                let z = &kept.u_t * y;
                let rest = (y - kept.u_t.tr_mul(&z)).norm_squared();
                let log: Vec<f64> = self.scales.iter().map(|a| log_probability(*a, &kept.s, &z, rest)).collect();
                (z, log)
            };
            let channels: Vec<(DVector<f64>, Vec<f64>)> = prior.iter().zip(&readings).map(of).collect();
            (channels.iter().map(|(_, log)| log_sum(log)).sum::<f64>(), channels)
        };
        let all: Vec<_> = self.priors.iter().map(held).collect();
        let weights = probable(all.iter().map(|(log, _)| *log));
        let mut curves = Vec::with_capacity(readings.len());
        for (c, channel) in self.channels.iter().enumerate() {
            let mut mean = DVector::zeros(self.roots[c].nrows());
            for &(prior, p) in &weights {
                let (kept, (z, log)) = (&self.priors[prior][c], &all[prior].1[c]);
                let at = probable(log.iter().copied());
                let filter = DVector::from_fn(z.len(), |j, _| {
                    let s = kept.s[j];
                    let share = |a: f64| a * a * s / (1.0 + (a * s).powi(2));
                    z[j] * at.iter().map(|&(i, p)| p * share(self.scales[i])).sum::<f64>()
                });
                mean += p * (&kept.l_v * filter);
            }
            let curve = made_non_negative(&mean, &self.roots[c], channel, &mut Vec::new())?;
            curves.push(curve.iter().copied().collect());
        }
        Ok(curves)
    }
}

/// Which are not negligible, and their probabilities, which sum to one.
fn probable(logs: impl Iterator<Item = f64> + Clone) -> Vec<(usize, f64)> {
    let most = logs.clone().fold(f64::NEG_INFINITY, f64::max);
    let mut kept: Vec<(usize, f64)> = logs.map(|l| (l - most).exp()).enumerate().filter(|(_, p)| *p > NEGLIGIBLE).collect();
    normalise(&mut kept);
    kept
}
