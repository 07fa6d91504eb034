//! The two passes of a fit by evidence, and the curve that is nowhere negative.

use nalgebra::{DMatrix, DVector};

use super::error::CalibrationError;
use super::evidence::{Trial, Whitened, weighted};
use super::exposures::{Exposures, Readings};
use super::non_negative::nearest;
use super::posterior::{self, Posterior};
use super::prior::{self, PriorKind, Smoothness};

/// Where the curve is zero its ripples are as large as where it is this share of its peak.
const ENVELOPE_FLOOR: f64 = 0.03;
/// Lengths per factor e in the first search, and in the second about the best.
const LENGTHS_PER_E: (f64, f64) = (2.5, 5.0);
/// A search ends when ln p has fallen by this much below its best.
const FALLEN: f64 = 12.0;

/// Both passes: trials and means of the first, trials of the second.
pub(super) struct Passes {
    pub(super) first: Vec<Trial>,
    pub(super) posteriors: Vec<Posterior>,
    pub(super) second: Vec<Trial>,
}

/// Holds every prior against the readings, and then those with an envelope.
pub(super) fn passes(exposures: &Exposures, readings: &[Readings], kind: &PriorKind, data: &Whitened) -> Result<Passes, CalibrationError> {
    let nodes = exposures.wavelengths_nm();
    let first = match kind {
        PriorKind::Smooth => search(nodes, data),
        PriorKind::Camera { components } => {
            prior::cameras(nodes, components, data.left_out).into_iter().filter_map(|c| Trial::new(c, data)).collect()
        }
    };
    let best = best(&first)?;
    let weights = weighted(&first);
    let channels = readings.len();
    let posteriors: Vec<Posterior> = (0..channels).map(|c| posterior::average(&weights, c, data)).collect();
    // What the solver says of the second pass counts.
    let mut remarks = Vec::new();
    let mut envelopes = Vec::with_capacity(channels);
    for (c, posterior) in posteriors.iter().enumerate() {
        let curve = non_negative(posterior, best, c, data, &readings[c].channel, &mut remarks)?;
        let peak = curve.amax();
        envelopes.push(curve.iter().map(|s| (if peak > 0.0 { s / peak } else { 1.0 } + ENVELOPE_FLOOR).sqrt()).collect());
    }
    let untouched = prior::components_of(kind);
    let near = |t: &Trial| (0.7 * best.candidate.length_nm..=3.0 * best.candidate.length_nm).contains(&t.candidate.length_nm);
    let second: Vec<Trial> = first
        .iter()
        .filter(|t| untouched > 0 || near(t))
        .filter_map(|t| Trial::new(prior::enveloped(&t.candidate, &envelopes, untouched), data))
        .collect();
    drop(weights);
    Ok(Passes { first, posteriors, second })
}

/// Smooth priors of every smoothness, from the longest length down until the readings speak against it.
fn search(nodes: &[f64], data: &Whitened) -> Vec<Trial> {
    let coarse = prior::lengths_nm(nodes, LENGTHS_PER_E.0);
    let mut trials: Vec<Trial> = Vec::new();
    let mut most = f64::NEG_INFINITY;
    for smoothness in Smoothness::ALL {
        let (mut own, mut at) = (f64::NEG_INFINITY, 0.0);
        for &length_nm in coarse.iter().rev() {
            let Some(trial) = Trial::new(prior::smooth(nodes, smoothness, length_nm, data.left_out), data) else { continue };
            let found = trial.log_evidence;
            if found > own {
                (own, at) = (found, length_nm);
            }
            trials.push(trial);
            if found < own - FALLEN {
                break;
            }
        }
        most = most.max(own);
        if own > most - FALLEN {
            for shift in [-1.0, 1.0] {
                let length_nm = at * (shift / LENGTHS_PER_E.1).exp();
                trials.extend(Trial::new(prior::smooth(nodes, smoothness, length_nm, data.left_out), data));
            }
        }
        // Readings that speak against a smoothness speak against all rougher ones.
        if own < most - FALLEN {
            break;
        }
    }
    trials
}

pub(super) fn best(trials: &[Trial]) -> Result<&Trial, CalibrationError> {
    let best = trials.iter().max_by(|a, b| a.log_evidence.total_cmp(&b.log_evidence));
    best.ok_or_else(|| CalibrationError::Numbers("no prior can be held against the readings in double precision".to_owned()))
}

pub(super) fn non_negative(
    posterior: &Posterior,
    best: &Trial,
    channel: usize,
    data: &Whitened,
    name: &str,
    remarks: &mut Vec<String>,
) -> Result<DVector<f64>, CalibrationError> {
    if posterior.mean.min() >= 0.0 {
        return Ok(posterior.mean.clone());
    }
    let root = posterior::root(best, channel, best.best_scale(channel, data));
    made_non_negative(&posterior.mean, &root, name, remarks)
}

pub(super) fn made_non_negative(
    mean: &DVector<f64>,
    root: &DMatrix<f64>,
    name: &str,
    remarks: &mut Vec<String>,
) -> Result<DVector<f64>, CalibrationError> {
    let found = nearest(mean, root).map_err(|why| CalibrationError::Numbers(format!(
            "no curve that is nowhere negative explains the readings of {name} ({why}): they contradict each other, or their uncertainties are stated too small"
        )))?;
    if found.almost {
        remarks.push(format!("{name}: the solver for the non-negative curve met its looser tolerances only"));
    }
    Ok(found.curve)
}
