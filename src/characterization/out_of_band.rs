//! What a meter reads outside its band: UV response u, IR response r.
//!
//! ```text
//! q(s) = ∫ S τ s dλ / ∫ S s dλ            u, r = |q(s) − q(V)|
//! ```
//!
//! | symbol | meaning | default |
//! |---|---|---|
//! | s | spectral responsivity; its scale cancels | |
//! | V | target, whose own reading behind the filter is no error | V(λ) |
//! | S | source | u: CIE D65, which begins at 300 nm; r: a black body at 2856 K (illuminant A is defined up to 830 nm only) |
//! | τ | filter | u: passes below 380 nm; r: passes from 780 nm |
//!
//! A reading behind the filter relative to the reading without it. The literature (Czech metrological regulation 0111-OOP-C010 on lux
//! meters, after DIN 5032-6 and CIE 69) names an ultraviolet lamp and filters by curves that are not at hand; the sharp filters and
//! the sources here are this project's, and inputs. Neither source nor filter could be checked against ISO/CIE 19476.
//!
//! ```
//! use etendue::characterization::out_of_band::{Arrangement, response};
//! use etendue::spectrum::{Factor, library};
//!
//! let v = library::v_lambda();
//! let leaks = Factor::Sum(vec![v.clone(), Factor::band(800.0, 900.0, 0.01)?]);
//! assert!(response(&leaks, &v, &Arrangement::infrared()?)? > 0.01);
//! // What leaks in the infrared is in the whole reading, too, beside which the ultraviolet is smaller.
//! assert!(response(&leaks, &v, &Arrangement::ultraviolet()?)? < 1e-8);
//! # Ok::<(), etendue::characterization::spectral_mismatch::MismatchError>(())
//! ```

use super::spectral_mismatch::MismatchError;
use crate::spectrum::{Density, Factor, SpectrumError, library};

/// Shortest and longest wavelength at which a sharp filter passes, nm.
const FILTER_ENDS_NM: (f64, f64) = (100.0, 20_000.0);
/// Upper edge of the ultraviolet filter, nm.
pub const ULTRAVIOLET_TO_NM: f64 = 380.0;
/// Lower edge of the infrared filter, nm.
pub const INFRARED_FROM_NM: f64 = 780.0;
/// Temperature of the source of the infrared response, K.
pub const INFRARED_SOURCE_K: f64 = 2856.0;

/// A source and a filter before it.
#[derive(Debug, Clone, PartialEq)]
pub struct Arrangement {
    /// Spectrum of the source.
    pub source: Density,
    /// Transmittance of the filter.
    pub filter: Factor,
    /// Both in words.
    pub words: String,
}

impl Arrangement {
    /// D65 behind a filter that passes below 380 nm.
    ///
    /// # Errors
    /// If the table of D65 cannot be read, which the tests of the library exclude.
    pub fn ultraviolet() -> Result<Self, SpectrumError> {
        let source = library::density("D65").unwrap_or_else(|_| Density::zero());
        let filter = Factor::band(FILTER_ENDS_NM.0, ULTRAVIOLET_TO_NM, 1.0)?;
        Ok(Self { source, filter, words: format!("D65, filter passes below {ULTRAVIOLET_TO_NM} nm") })
    }

    /// A black body at 2856 K behind a filter that passes from 780 nm.
    ///
    /// # Errors
    /// None in practice: the temperature and the band are constants.
    pub fn infrared() -> Result<Self, SpectrumError> {
        let source = Density::black_body(INFRARED_SOURCE_K)?;
        let filter = Factor::band(INFRARED_FROM_NM, FILTER_ENDS_NM.1, 1.0)?;
        Ok(Self { source, filter, words: format!("black body {INFRARED_SOURCE_K} K, filter passes from {INFRARED_FROM_NM} nm") })
    }

    /// The source behind the filter.
    #[must_use]
    pub fn filtered(&self) -> Density {
        self.source.filtered(&self.filter)
    }
}

/// Share q of the reading that is left behind the filter, 0 to 1.
///
/// # Errors
/// If nothing of the source is seen.
pub fn share_behind(responsivity: &Factor, arrangement: &Arrangement) -> Result<f64, MismatchError> {
    let all = arrangement.source.integral(&[responsivity]);
    if !(all > 0.0 && all.is_finite()) {
        return Err(MismatchError::NothingSeen { by: "responsivity", of: "filtered" });
    }
    Ok(arrangement.filtered().integral(&[responsivity]) / all)
}

/// |q(s) − q(V)|: the response outside the band of the target; a pure number, 0.01 for 1 %.
///
/// # Errors
/// If nothing of the source is seen by one of the two.
pub fn response(responsivity: &Factor, target: &Factor, arrangement: &Arrangement) -> Result<f64, MismatchError> {
    Ok((share_behind(responsivity, arrangement)? - share_behind(target, arrangement)?).abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flat_detector_passes_the_share_of_the_source() {
        let flat = Density::flat(300.0, 900.0, 1.0).unwrap();
        let arrangement = Arrangement { source: flat, filter: Factor::band(780.0, 900.0, 0.5).unwrap(), words: String::new() };
        let share = share_behind(&Factor::ONE, &arrangement).unwrap();
        assert!((share - 0.5 * 120.0 / 600.0).abs() < 1e-14, "{share}");
    }

    #[test]
    fn a_target_has_no_response_outside_itself() {
        let v = library::v_lambda();
        for arrangement in [Arrangement::ultraviolet().unwrap(), Arrangement::infrared().unwrap()] {
            assert_eq!(response(&v, &v, &arrangement), Ok(0.0));
            assert!(arrangement.source.total() > 0.0);
        }
    }

    #[test]
    fn a_meter_that_sees_nothing_is_told() {
        let blind = Factor::band(5.0, 6.0, 1.0).unwrap();
        assert!(response(&blind, &library::v_lambda(), &Arrangement::ultraviolet().unwrap()).is_err());
    }
}
