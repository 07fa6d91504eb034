//! What lies between measured points: curves from points, and how wrong they may be.
//!
//! ```text
//! s_h through every point, s_2h through every other one        |s − s_h| ≲ e = |s_h − s_2h|
//! |δ ∫ S s dλ| ≤ ∫ S e dλ
//! ```
//!
//! Halving the step divides the error of straight lines by four on smooth curves and by two at jumps, so the difference of the two curves
//! is no smaller than the error that is left. Bounds are taken without regard to sign and count as rectangular: u = bound/√3.

use super::monochromator::Spectrogram;
use crate::characterization::Figure;
use crate::characterization::spectral_mismatch::{MismatchError, Wavelengths, mismatch_index};
use crate::spectrum::{Density, Factor, Outside, SpectrumError, Table};

/// A curve through measured points, with its uncertainty between and at them.
#[derive(Debug, Clone, PartialEq)]
pub struct Sampled {
    /// Through every point.
    pub curve: Factor,
    /// Largest error of the curve between the points.
    between: Factor,
    /// Standard uncertainty at the points.
    at_points: Factor,
}

impl Sampled {
    /// The measured responsivity of a channel.
    ///
    /// # Errors
    /// If there are fewer than three points.
    pub fn responsivity(spectrogram: &Spectrogram, channel: usize) -> Result<Self, SpectrumError> {
        Self::new(&spectrogram.wavelengths_nm, &spectrogram.readings[channel])
    }

    /// A curve through points with rising abscissae, the first of them not left out of the coarser curve.
    ///
    /// # Errors
    /// If there are fewer than three points, or they do not rise.
    pub fn new(at: &[f64], figures: &[Figure]) -> Result<Self, SpectrumError> {
        let table = |values: Vec<f64>| Ok(Factor::Table(Table::new(at.to_vec(), values, Outside::Zero)?));
        let values: Vec<f64> = figures.iter().map(|figure| figure.value).collect();
        Ok(Self {
            between: table(halving_error(at, &values))?,
            at_points: table(figures.iter().map(|figure| figure.standard_uncertainty).collect())?,
            curve: table(values)?,
        })
    }

    /// `∫ φ s dλ` with its uncertainty.
    #[must_use]
    pub fn integral(&self, density: &Density) -> Figure {
        Figure { value: density.integral(&[&self.curve]), standard_uncertainty: self.standard_uncertainty(|e| density.integral(&[e])) }
    }

    /// Uncertainty of what depends linearly on the curve, from its largest change for an error of the curve.
    fn standard_uncertainty(&self, bound: impl Fn(&Factor) -> f64) -> f64 {
        (bound(&self.between) / 3f64.sqrt()).hypot(bound(&self.at_points))
    }

    /// The mismatch index of the curve, by the function that serves curves.
    ///
    /// # Errors
    /// As [`mismatch_index`].
    pub fn mismatch(&self, target: &Factor, calibration: &Density, over: Wavelengths) -> Result<Figure, MismatchError> {
        let value = mismatch_index(&self.curve, target, calibration, over)?;
        let (band, spectrum) = (over.uniform()?, over.of(calibration)?);
        let (seen, truth) = (spectrum.integral(&[&self.curve]), spectrum.integral(&[target]));
        let (area, all) = (band.integral(&[&self.curve]), band.integral(&[target]));
        // |k s − V| changes by k e, and by the change of k.
        let bound = |e: &Factor| truth / seen * (band.integral(&[e]) + spectrum.integral(&[e]) / seen * area) / all;
        Ok(Figure { value, standard_uncertainty: self.standard_uncertainty(bound) + f64::EPSILON })
    }

    /// Mean wavelength `∫ S s λ dλ / ∫ S s dλ`, nm.
    ///
    /// # Errors
    /// If nothing of the spectrum is seen.
    pub fn mean_wavelength_nm(&self, spectrum: &Density) -> Result<Figure, MismatchError> {
        let value = super::super::spectral_mismatch::mean_wavelength_nm(&self.curve, spectrum)?;
        let seen = spectrum.integral(&[&self.curve]);
        let Factor::Table(points) = &self.curve else { return Ok(Figure { value, standard_uncertainty: f64::INFINITY }) };
        let lever = points.wavelengths_nm().iter().map(|nm| (nm - value).abs()).collect();
        let lever = Factor::Table(Table::new(points.wavelengths_nm().to_vec(), lever, Outside::Zero)?);
        let bound = |e: &Factor| spectrum.integral(&[e, &lever]) / seen;
        Ok(Figure { value, standard_uncertainty: self.standard_uncertainty(bound) + f64::EPSILON * value })
    }
}

/// |s_h − s_2h| at every point: zero at those of the coarser curve, and at a last one that has no partner the error of its neighbour.
#[must_use]
pub fn halving_error(at: &[f64], values: &[f64]) -> Vec<f64> {
    let mut errors = vec![0.0; values.len()];
    for k in (1..values.len().saturating_sub(1)).step_by(2) {
        let share = (at[k] - at[k - 1]) / (at[k + 1] - at[k - 1]);
        errors[k] = (values[k] - (values[k - 1] + share * (values[k + 1] - values[k - 1]))).abs();
    }
    if values.len() > 2 && values.len().is_multiple_of(2) {
        let last = values.len() - 1;
        errors[last] = errors[last - 2];
    }
    errors
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::library;
    use proptest::prelude::*;

    fn measured(curve: &Factor, step: u32) -> Sampled {
        let at: Vec<f64> = (300..=1100).step_by(step as usize).map(f64::from).collect();
        let figures: Vec<Figure> = at.iter().map(|nm| Figure::exact(curve.at(*nm), 0.0)).collect();
        Sampled::new(&at, &figures).unwrap()
    }

    proptest! {
        #[test]
        fn curves_through_points_have_the_index_within_their_uncertainty(
            centre in 530.0..590.0f64, sigma in 30.0..60.0f64, edge in 620.0..720.0f64, leak in 0.0..0.05f64, step in 1u32..8,
        ) {
            let curve = Factor::Sum(vec![Factor::gaussian(1.0, centre, sigma).unwrap(), Factor::band(edge, edge + 100.0, leak).unwrap()]);
            let (v, a) = (library::v_lambda(), Density::illuminant_a());
            let exact = mismatch_index(&curve, &v, &a, Wavelengths::VISIBLE).unwrap();
            let found = measured(&curve, step).mismatch(&v, &a, Wavelengths::VISIBLE).unwrap();
            prop_assert!((found.value - exact).abs() <= 2.0 * found.standard_uncertainty, "{} {:?}", exact, found);
        }
    }

    #[test]
    fn the_error_of_a_parabola_is_seen_four_times() {
        let at: Vec<f64> = (0..9).map(f64::from).collect();
        let values: Vec<f64> = at.iter().map(|x| x * x).collect();
        // Straight lines over 2 h err by h² in the middle, over h by h²/4.
        assert_eq!(halving_error(&at, &values), [0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0]);
        assert_eq!(halving_error(&at[..4], &values[..4]), [0.0, 1.0, 0.0, 1.0]);
    }
}
