//! Absorbance of a visual pigment from its wavelength of maximum alone: the template for A1 pigments (rhodopsins).
//!
//! ```text
//! S_α = 1 / (exp(A (a − x)) + exp(B (b − x)) + exp(C (c − x)) + D),     x = λ_max / λ,  a = 0.8795 + 0.0459 exp(−(λ_max − 300)²/11940)
//! S_β = A_β exp(−((λ − λ_β)/w)²),     λ_β = 189 + 0.315 λ_max,  w = −40.5 + 0.195 λ_max
//! ```
//!
//! | A | B | C | D | b | c | A_β |
//! |---|---|---|---|---|---|---|
//! | 69.7 | 28 | −14.9 | 0.674 | 0.922 | 1.104 | 0.26 |
//!
//! Wavelengths in nm. The template was fitted to pigments from 357 nm to 620 nm; it is used here from 330 nm to 700 nm, beyond
//! the fit by extrapolation. Its maximum is 1 to better than 1 %, not exactly.
//!
//! Source: V. I. Govardovskii et al., Visual Neuroscience 17 (2000) 509, equations 1, 2, 4, 5.

use super::ObserverError;
use super::error::within;

/// Relative absorbance of the α and the β band, 1 at about `lambda_max_nm`.
///
/// Errors if `lambda_max_nm` lies outside 330 nm to 700 nm or `wavelength_nm` outside 100 nm to 2000 nm.
///
/// ```
/// use etendue::observer::template::govardovskii;
///
/// // Human rods.
/// assert!((govardovskii(496.3, 496.3)? - 1.0).abs() < 0.01);
/// assert!(govardovskii(496.3, 600.0)? < 0.05);
/// # Ok::<(), etendue::observer::ObserverError>(())
/// ```
pub fn govardovskii(lambda_max_nm: f64, wavelength_nm: f64) -> Result<f64, ObserverError> {
    Ok(alpha_band(lambda_max_nm, wavelength_nm)? + beta_band(lambda_max_nm, wavelength_nm)?)
}

/// The α band alone: the main maximum. Errors as [`govardovskii`].
pub fn alpha_band(lambda_max_nm: f64, wavelength_nm: f64) -> Result<f64, ObserverError> {
    let (peak_nm, nm) = checked(lambda_max_nm, wavelength_nm)?;
    let x = peak_nm / nm;
    let a = 0.8795 + 0.0459 * (-(peak_nm - 300.0).powi(2) / 11_940.0).exp();
    Ok(1.0 / ((69.7 * (a - x)).exp() + (28.0 * (0.922 - x)).exp() + (-14.9 * (1.104 - x)).exp() + 0.674))
}

/// The β band alone: the small maximum in the ultraviolet. Errors as [`govardovskii`].
pub fn beta_band(lambda_max_nm: f64, wavelength_nm: f64) -> Result<f64, ObserverError> {
    let (peak_nm, nm) = checked(lambda_max_nm, wavelength_nm)?;
    let t = (nm - (189.0 + 0.315 * peak_nm)) / (-40.5 + 0.195 * peak_nm);
    Ok(0.26 * (-t * t).exp())
}

fn checked(lambda_max_nm: f64, wavelength_nm: f64) -> Result<(f64, f64), ObserverError> {
    Ok((
        within("the wavelength of the maximum of a pigment", lambda_max_nm, 330.0, 700.0, "nm")?,
        within("the wavelength", wavelength_nm, 100.0, 2000.0, "nm")?,
    ))
}
