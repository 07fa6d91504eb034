//! What is put in front of the sensor, and what it reads.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | λₖ | nodes of the curve that is sought | nm |
//! | Aᵢₖ | `∫ Sᵢ hatₖ dλ` | unit of S times nm |
//! | yᵢ | reading of exposure i | unit of S times nm times that of the curve |
//! | uᵢ | its standard uncertainty, independent from exposure to exposure | as y |
//!
//! ```
//! use etendue::calibration::Exposures;
//! use etendue::spectrum::Density;
//!
//! let nodes: Vec<f64> = (40..=78).map(|k| 10.0 * f64::from(k)).collect();
//! let exposures = Exposures::new(&nodes, &[("green", Density::gaussian(1.0, 550.0, 10.0)?)])?;
//! let sum: f64 = exposures.row(0).iter().sum();
//! assert!((sum - 1.0).abs() < 1e-9);
//! # Ok::<(), etendue::spectrum::SpectrumError>(())
//! ```

use nalgebra::DMatrix;

use crate::spectrum::kernel::Weights;
use crate::spectrum::{Density, SpectrumError};

/// A node has light if it weighs at least this share of the strongest node of an exposure: it lies within the exposure's full width at half maximum.
const DARK: f64 = 0.5;

/// Spectra of the exposures as rows of weights on the nodes of the curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Exposures {
    wavelengths_nm: Vec<f64>,
    labels: Vec<String>,
    pub(super) matrix: DMatrix<f64>,
}

impl Exposures {
    /// Exposures with these spectra, for a curve with nodes at `wavelengths_nm`. What lies outside of the nodes is not seen.
    ///
    /// # Errors
    /// Fewer than two nodes, or nodes that are not finite, positive and strictly increasing.
    pub fn new<L: AsRef<str>>(wavelengths_nm: &[f64], spectra: &[(L, Density)]) -> Result<Exposures, SpectrumError> {
        let rows = spectra.iter().map(|(_, spectrum)| Weights::of(wavelengths_nm, spectrum, &[])).collect::<Result<Vec<_>, _>>()?;
        let labels = spectra.iter().map(|(label, _)| label.as_ref().to_owned()).collect();
        let rows: Vec<&[f64]> = rows.iter().map(Weights::weights).collect();
        Ok(Exposures::from_weights(wavelengths_nm, labels, &rows))
    }

    /// Exposures whose weights on the nodes are known, a row each. Rows that are too short are filled with zeros.
    #[must_use]
    pub fn from_weights(wavelengths_nm: &[f64], labels: Vec<String>, rows: &[&[f64]]) -> Exposures {
        let matrix = DMatrix::from_fn(rows.len(), wavelengths_nm.len(), |i, k| rows[i].get(k).copied().unwrap_or(0.0));
        Exposures { wavelengths_nm: wavelengths_nm.to_vec(), labels, matrix }
    }

    /// The nodes, nm.
    #[must_use]
    pub fn wavelengths_nm(&self) -> &[f64] {
        &self.wavelengths_nm
    }

    /// What the exposures are called.
    #[must_use]
    pub fn labels(&self) -> &[String] {
        &self.labels
    }

    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.matrix.nrows()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Weights of the nodes in exposure `i`; panics never: an exposure that is not there has none.
    #[must_use]
    pub fn row(&self, i: usize) -> Vec<f64> {
        if i < self.len() { self.matrix.row(i).iter().copied().collect() } else { Vec::new() }
    }

    /// From the first wavelength that has light to the last, for the light of any exposure, nm; `None` if none has.
    #[must_use]
    pub fn lit_nm(&self) -> Option<(f64, f64)> {
        let nodes = lit(&self.matrix);
        Some((*self.wavelengths_nm.get(*nodes.start())?, *self.wavelengths_nm.get(*nodes.end())?))
    }

    /// What a curve would read, without noise.
    #[must_use]
    pub fn expected(&self, curve: &[f64]) -> Vec<f64> {
        (0..self.len()).map(|i| self.matrix.row(i).iter().zip(curve).map(|(a, s)| a * s).sum()).collect()
    }

    /// The exposures with these indices, in this order; those that are not there are left out.
    #[must_use]
    pub fn subset(&self, indices: &[usize]) -> Exposures {
        let indices: Vec<usize> = indices.iter().copied().filter(|i| *i < self.len()).collect();
        Exposures {
            wavelengths_nm: self.wavelengths_nm.clone(),
            labels: indices.iter().map(|&i| self.labels.get(i).cloned().unwrap_or_default()).collect(),
            matrix: DMatrix::from_fn(indices.len(), self.wavelengths_nm.len(), |i, k| self.matrix[(indices[i], k)]),
        }
    }
}

/// Readings of one channel, an exposure each.
#[derive(Clone, Debug, PartialEq)]
pub struct Readings {
    /// The channel.
    pub channel: String,
    /// The readings.
    pub values: Vec<f64>,
    /// Their standard uncertainties; zero for readings without noise.
    pub standard_uncertainties: Vec<f64>,
}

/// From the first node that has light to the last, for the light of any exposure.
pub(super) fn lit(matrix: &DMatrix<f64>) -> std::ops::RangeInclusive<usize> {
    let (mut first, mut last) = (usize::MAX, 0);
    for row in matrix.row_iter() {
        let least = DARK * row.amax();
        for (k, _) in row.iter().enumerate().filter(|(_, a)| a.abs() > 0.0 && a.abs() >= least * (1.0 - 1e-9)) {
            first = first.min(k);
            last = last.max(k);
        }
    }
    first..=last
}
