//! What a fitted curve is used for, with its uncertainty: linear propagation, and Monte Carlo draws as its check.
//!
//! ```text
//! q = f(s)      u²(q) = gᵀ C g      g = ∂f/∂s at the fitted curve
//! draws         s + L z,  C = L Lᵀ,  z standard normal
//! ```
//!
//! Draws are not cut at zero: the readings hold sums over wavelengths, and cutting would break them.
//!
//! Source: JCGM 100 (GUM) 5.1.2 and 5.2.2; JCGM 101 (GUM Supplement 1).
//!
//! ```
//! use etendue::calibration::{Exposures, FitOptions, Readings, fit, propagation};
//! use etendue::spectrum::Density;
//!
//! let nodes: Vec<f64> = (40..=70).map(|k| 10.0 * f64::from(k)).collect();
//! let spectra = [500.0, 550.0, 600.0].map(|nm| Ok(("scan", Density::gaussian(1.0, nm, 20.0)?)));
//! let exposures = Exposures::new(&nodes, &spectra.into_iter().collect::<Result<Vec<_>, etendue::spectrum::SpectrumError>>()?)?;
//! let readings = Readings { channel: "E".into(), values: vec![1.0, 2.0, 1.0], standard_uncertainties: vec![0.01; 3] };
//! let curve = fit(&exposures, &[readings], &FitOptions::default())?.curves.remove(0);
//! // The reading of the second exposure, from the curve, is known at least as well as it was read.
//! let u = propagation::standard_uncertainty(&curve, &exposures.row(1), 0.0);
//! assert!(u < 0.05);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use nalgebra::{DMatrix, DVector};

use super::fit::FittedCurve;
use super::low_rank;

/// Share of the variance that draws may miss.
const LEFT_OUT: f64 = 1e-10;

/// Standard uncertainty of a quantity whose derivative with respect to the nodes is `gradient`; `scale` is a relative standard uncertainty
/// common to the whole curve.
#[must_use]
pub fn standard_uncertainty(curve: &FittedCurve, gradient: &[f64], scale: f64) -> f64 {
    let g = DVector::from_fn(curve.values.len(), |k, _| gradient.get(k).copied().unwrap_or(0.0));
    let of = |c: &DMatrix<f64>| g.dot(&(c * &g)).max(0.0);
    let along: f64 = curve.values.iter().zip(g.iter()).map(|(s, g)| s * g).sum();
    (of(&curve.noise) + of(&curve.structure) + (scale * along).powi(2)).sqrt()
}

/// Columns `F` of a root of the covariance, noise and structure together: `C = F Fᵀ`; `F[node][column]`.
#[must_use]
pub fn covariance_root(curve: &FittedCurve) -> Vec<Vec<f64>> {
    let root = root_of(curve);
    root.row_iter().map(|row| row.iter().copied().collect()).collect()
}

pub(super) fn root_of(curve: &FittedCurve) -> DMatrix<f64> {
    low_rank::factor(curve.values.len(), &|i, j| curve.noise[(i, j)] + curve.structure[(i, j)], LEFT_OUT).columns
}

/// Adds a cause that moves all readings together, by `moved` for one standard uncertainty, to the covariance: `C + (G m)(G m)ᵀ`.
pub fn add_shared(curve: &mut FittedCurve, moved: &[f64]) {
    let by = &curve.gain * DVector::from_fn(curve.gain.ncols(), |i, _| moved.get(i).copied().unwrap_or(0.0));
    curve.structure.ger(1.0, &by, &by, 1.0);
}

/// Draws curves as the readings leave them open.
#[derive(Clone, Debug)]
pub struct Sampler {
    mean: DVector<f64>,
    root: DMatrix<f64>,
    scale: f64,
}

impl Sampler {
    /// For this curve; `scale` is a relative standard uncertainty common to the whole curve.
    #[must_use]
    pub fn new(curve: &FittedCurve, scale: f64) -> Sampler {
        Sampler { mean: DVector::from_column_slice(&curve.values), root: root_of(curve), scale }
    }

    /// How many normal numbers a draw takes.
    #[must_use]
    pub fn numbers(&self) -> usize {
        self.root.ncols() + 1
    }

    /// The curve for these standard normal numbers; missing numbers count as zero. It may be negative.
    #[must_use]
    pub fn curve(&self, normals: &[f64]) -> Vec<f64> {
        let z = DVector::from_fn(self.root.ncols(), |j, _| normals.get(j).copied().unwrap_or(0.0));
        let scale = 1.0 + self.scale * normals.get(self.root.ncols()).copied().unwrap_or(0.0);
        (&self.mean + &self.root * z).iter().map(|s| s * scale).collect()
    }
}
