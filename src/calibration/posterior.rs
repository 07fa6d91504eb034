//! Curve and covariance, given the readings and a prior.
//!
//! ```text
//! ŝ = G y,  G = a² L V diag(s / (1 + w)) Uᵀ diag(1/u)                    w = a² s²
//! noise:      G diag(u²) Gᵀ            = a² L V diag(w / (1 + w)²) Vᵀ Lᵀ
//! structure:  (1 − G A) K (1 − G A)ᵀ   = a² L V diag(1 / (1 + w)²) Vᵀ Lᵀ + a² L (1 − V Vᵀ) Lᵀ
//! ```
//!
//! *Noise* is what other readings of the same exposures would change. *Structure* is what the readings leave open: the expected square of the
//! bias of a smooth fit, and all of the curve where no exposure sees it. Several priors are averaged by their probabilities;
//! how far their curves are apart is structure, too, and so is what the columns L miss of K. No difference of large numbers is taken.
//!
//! Source: Rodgers, Inverse Methods for Atmospheric Sounding (2000), 3 and 4.

use nalgebra::{DMatrix, DVector};

use super::evidence::{Trial, Whitened};

/// What is known of a curve after the readings.
#[derive(Clone, Debug)]
pub(super) struct Posterior {
    /// The mean; may be negative.
    pub(super) mean: DVector<f64>,
    /// `ŝ = G y`, in units of the readings.
    pub(super) gain: DMatrix<f64>,
    pub(super) noise: DMatrix<f64>,
    pub(super) structure: DMatrix<f64>,
    /// Variance before the readings, a node each.
    pub(super) prior_variance: DVector<f64>,
}

/// The average over priors, each with its probability.
pub(super) fn average(trials: &[(&Trial, f64)], channel: usize, data: &Whitened) -> Posterior {
    let (m, n) = data.matrix.shape();
    let mut mean = DVector::zeros(n);
    let mut means: Vec<(f64, DVector<f64>)> = Vec::new();
    let (mut gain, mut noise, mut structure) = (DMatrix::zeros(n, m), DMatrix::zeros(n, n), DMatrix::zeros(n, n));
    let mut prior_variance = DVector::zeros(n);
    for (trial, probability) in trials {
        let (l, d) = (trial.candidate.factor(channel), trial.decomposition(channel));
        let z = &trial.channels[channel].z;
        let l_v = l * d.v_t.transpose();
        let unseen = unseen(l, &l_v, &d.v_t);
        let scales = trial.scales(channel, data);
        let over_scales = |f: &dyn Fn(f64, f64) -> f64| d.s.map(|s| scales.iter().map(|&(a, p)| p * f(a, s)).sum::<f64>());
        for &(a, p) in &scales {
            let curve = &l_v * DVector::from_fn(z.len(), |j, _| a * a * d.s[j] / (1.0 + (a * d.s[j]).powi(2)) * z[j]);
            mean += probability * p * &curve;
            means.push((probability * p, curve));
        }
        let filter = over_scales(&|a, s| a * a * s / (1.0 + (a * s).powi(2)));
        gain += *probability * (&l_v * DMatrix::from_diagonal(&filter) * d.u.transpose());
        let of_noise = over_scales(&|a, s| (a * a * s / (1.0 + (a * s).powi(2))).powi(2));
        let of_structure = over_scales(&|a, s| (a / (1.0 + (a * s).powi(2))).powi(2));
        let mean_square: f64 = scales.iter().map(|(a, p)| p * a * a).sum();
        noise += *probability * product(&l_v, &of_noise);
        structure += *probability * product(&l_v, &of_structure);
        if let Some(unseen) = unseen {
            structure += (*probability * mean_square) * (&unseen * unseen.transpose());
        }
        for k in 0..n {
            let missing = probability * mean_square * trial.candidate.missing[k];
            structure[(k, k)] += missing;
            prior_variance[k] += probability * mean_square * l.row(k).norm_squared() + missing;
        }
    }
    for (p, curve) in means {
        let apart = curve - &mean;
        structure.ger(p, &apart, &apart, 1.0);
    }
    for (i, unit) in data.units.iter().enumerate() {
        gain.column_mut(i).scale_mut(1.0 / unit);
    }
    Posterior { mean, gain, noise, structure, prior_variance }
}

/// `M diag(d) Mᵀ`.
pub(super) fn product(m: &DMatrix<f64>, d: &DVector<f64>) -> DMatrix<f64> {
    let half = m * DMatrix::from_diagonal(&d.map(f64::sqrt));
    &half * half.transpose()
}

/// `L (1 − V Vᵀ)`, if there is anything in it.
fn unseen(l: &DMatrix<f64>, l_v: &DMatrix<f64>, v_t: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    (v_t.nrows() < v_t.ncols()).then(|| l - l_v * v_t)
}

/// A square root of the covariance under one prior and scale: `C = F Fᵀ`.
pub(super) fn root(trial: &Trial, channel: usize, a: f64) -> DMatrix<f64> {
    let (l, d) = (trial.candidate.factor(channel), trial.decomposition(channel));
    let l_v = l * d.v_t.transpose();
    let seen = &l_v * DMatrix::from_diagonal(&d.s.map(|s| a / (1.0 + (a * s).powi(2)).sqrt()));
    match unseen(l, &l_v, &d.v_t) {
        None => seen,
        Some(unseen) => {
            let (p, r) = (seen.ncols(), unseen.ncols());
            DMatrix::from_fn(l.nrows(), p + r, |k, j| if j < p { seen[(k, j)] } else { a * unseen[(k, j - p)] })
        }
    }
}

/// The posterior under one prior and one scale.
pub(super) fn at_scale(trial: &Trial, channel: usize, a: f64, data: &Whitened) -> Posterior {
    let (l, d) = (trial.candidate.factor(channel), trial.decomposition(channel));
    let l_v = l * d.v_t.transpose();
    let filter = d.s.map(|s| a * a * s / (1.0 + (a * s).powi(2)));
    let mean = &l_v * filter.component_mul(&trial.channels[channel].z);
    let mut gain = &l_v * DMatrix::from_diagonal(&filter) * d.u.transpose();
    for (i, unit) in data.units.iter().enumerate() {
        gain.column_mut(i).scale_mut(1.0 / unit);
    }
    let noise = product(&l_v, &filter.map(|f| f * f));
    let mut structure = product(&l_v, &d.s.map(|s| (a / (1.0 + (a * s).powi(2))).powi(2)));
    if let Some(unseen) = unseen(l, &l_v, &d.v_t) {
        structure += a * a * (&unseen * unseen.transpose());
    }
    let prior_variance = DVector::from_fn(l.nrows(), |k, _| a * a * l.row(k).norm_squared());
    Posterior { mean, gain, noise, structure, prior_variance }
}
