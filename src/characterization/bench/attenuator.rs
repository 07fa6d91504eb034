//! The attenuator: one lamp over decades of strength.
//!
//! ```text
//! Y(X), X = X₀ · 10^k
//! ```

use super::{Bench, BenchError};
use crate::characterization::Figure;
use crate::spectrum::Density;

impl Bench<'_> {
    /// Readings of a channel before the same spectrum at several strengths: `strengths` multiply the density.
    ///
    /// # Errors
    /// If a strength leaves the range of numbers, or the engine has no reading.
    pub fn attenuated(&self, channel: usize, spectrum: &Density, strengths: &[f64]) -> Result<Vec<Figure>, BenchError> {
        strengths.iter().map(|strength| self.along_normal(channel, &spectrum.scaled(*strength)?)).collect()
    }
}
