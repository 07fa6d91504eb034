//! Curves and points of a chromaticity diagram: the spectral locus and the white points of illuminants.
//!
//! The Planckian locus is in [`super::PlanckianLocus`]; the daylight locus is `crate::spectrum::daylight::chromaticity`.

use super::{Chromaticity, Tristimulus};
use crate::spectrum::Factor;
use crate::spectrum::library::{self, LookupError};

/// Wavelengths between which the spectral locus is drawn and the purple line closes it: CIE S 017 (17-23-056) puts the ends of the
/// purple boundary at about 380 nm and 780 nm. Beyond, the locus stands still or folds back.
pub const LOCUS_RANGE_NM: (f64, f64) = (380.0, 780.0);

/// A point of the spectral locus.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpectralPoint {
    /// Wavelength, nm.
    pub wavelength_nm: f64,
    /// Its chromaticity.
    pub chromaticity: Chromaticity,
}

/// Chromaticities of single wavelengths from `from_nm` to `to_nm` every `step_nm`; wavelengths that the observer does not see are left out.
/// Empty if the step is not above zero.
pub fn spectral_locus(matching: &[Factor; 3], from_nm: f64, to_nm: f64, step_nm: f64) -> Vec<SpectralPoint> {
    let steps = ((to_nm - from_nm) / step_nm + 1e-9).floor();
    if !(step_nm > 0.0 && (0.0..1e7).contains(&steps)) {
        return Vec::new();
    }
    (0..=steps as usize)
        .filter_map(|i| {
            let wavelength_nm = from_nm + step_nm * i as f64;
            let values = Tristimulus::from(matching.each_ref().map(|function| function.at(wavelength_nm)));
            Some(SpectralPoint { wavelength_nm, chromaticity: values.chromaticity()? })
        })
        .collect()
}

/// The chromaticity of an illuminant of the library for an observer, by exact integration. Errors if the library has no such spectrum;
/// `None` if the observer does not see it.
pub fn white_point(illuminant: &str, matching: &[Factor; 3]) -> Result<Option<Chromaticity>, LookupError> {
    Ok(Tristimulus::of(&library::density(illuminant)?, matching).chromaticity())
}
