//! Planck's law: `L_λ(λ, T) = (2hc²/λ⁵) / (exp(c₂/(λT)) − 1)`, with `c₂ = hc/k`.
//!
//! | symbol | unit | meaning |
//! |---|---|---|
//! | λ | nm | wavelength |
//! | T | K | temperature |
//! | L_λ | W m⁻² sr⁻¹ nm⁻¹ | spectral radiance, emissivity 1, refractive index 1 |
//!
//! Evaluated as `(2ckT/λ⁴) · x/(eˣ − 1)` with `x = c₂/(λT)`, which has no cancellation at small x and no overflow at large x.
//! The law holds for vacuum wavelengths; as in the CIE's illuminant A, the tabulated wavelength in air is inserted as it is.

use std::f64::consts::{LN_2, PI};

use crate::quantity::constants::{BOLTZMANN_J_K, SECOND_RADIATION_CONSTANT_M_K, SPEED_OF_LIGHT_M_S, STEFAN_BOLTZMANN_W_M2_K4};

/// Second radiation constant `c₂ = hc/k`, in nm K.
pub const SECOND_RADIATION_CONSTANT_NM_K: f64 = SECOND_RADIATION_CONSTANT_M_K * 1e9;

/// `2ck` in W m² sr⁻¹ K⁻¹ and nm: the Rayleigh–Jeans radiance is this times `T/λ⁴` with λ in nm, per nm.
const RAYLEIGH_JEANS: f64 = 2.0 * SPEED_OF_LIGHT_M_S * BOLTZMANN_J_K * 1e36 * 1e-9;

/// Temperatures of a black body as a spectrum, K: from below anything that was ever cooled to above anything that radiates thermally.
/// Beyond them the fourth power and the wavelengths leave the range of `f64`.
pub const TEMPERATURES_K: (f64, f64) = (1e-12, 1e12);

/// `c₂/(λT)`, the photon energy in units of kT.
fn reduced_energy(wavelength_nm: f64, temperature_k: f64) -> f64 {
    SECOND_RADIATION_CONSTANT_NM_K / wavelength_nm / temperature_k
}

/// Whether Planck's law says anything about this wavelength and temperature.
fn is_physical(wavelength_nm: f64, temperature_k: f64) -> bool {
    wavelength_nm > 0.0 && wavelength_nm.is_finite() && temperature_k > 0.0 && temperature_k.is_finite()
}

/// Spectral radiance of a black body, W m⁻² sr⁻¹ nm⁻¹; zero for arguments that are not positive and finite.
/// Underflows to zero where the logarithm is below -745.
///
/// ```
/// use etendue::spectrum::black_body::spectral_radiance;
///
/// // The sun in the green, per nm.
/// assert!((spectral_radiance(555.0, 5772.0) / 25_633.0 - 1.0).abs() < 1e-5);
/// ```
pub fn spectral_radiance(wavelength_nm: f64, temperature_k: f64) -> f64 {
    if !is_physical(wavelength_nm, temperature_k) {
        return 0.0;
    }
    let x = reduced_energy(wavelength_nm, temperature_k);
    let inverse_square = 1.0 / (wavelength_nm * wavelength_nm);
    let rayleigh_jeans = RAYLEIGH_JEANS * temperature_k * inverse_square * inverse_square;
    // Above x = 700, exp overflows and the -1 is far below rounding; the product is smaller than any f64 unless λ is tiny.
    if x > 700.0 {
        return ln_spectral_radiance(wavelength_nm, temperature_k).exp();
    }
    rayleigh_jeans * (x / x.exp_m1())
}

/// Natural logarithm of [`spectral_radiance`] in W m⁻² sr⁻¹ nm⁻¹, without overflow or underflow;
/// `-inf` for arguments that are not positive and finite.
///
/// ```
/// use etendue::spectrum::black_body::{ln_spectral_radiance, spectral_radiance};
///
/// // Visible light from liquid helium is too little for a number, but not for its logarithm.
/// assert_eq!(spectral_radiance(555.0, 4.2), 0.0);
/// assert!(ln_spectral_radiance(555.0, 4.2) < -6000.0);
/// ```
pub fn ln_spectral_radiance(wavelength_nm: f64, temperature_k: f64) -> f64 {
    if !is_physical(wavelength_nm, temperature_k) {
        return f64::NEG_INFINITY;
    }
    let x = reduced_energy(wavelength_nm, temperature_k);
    if x.is_infinite() {
        return f64::NEG_INFINITY;
    }
    // ln(eˣ − 1): for large x the exponential is split off, for small x the difference is taken by expm1.
    let ln_bose = if x > LN_2 { x + (-(-x).exp()).ln_1p() } else { x.exp_m1().ln() };
    let ln_rayleigh_jeans = RAYLEIGH_JEANS.ln() + temperature_k.ln() - 4.0 * wavelength_nm.ln();
    ln_rayleigh_jeans + x.ln() - ln_bose
}

/// Spectral exitance `π L_λ`, W m⁻² nm⁻¹.
///
/// ```
/// use etendue::spectrum::black_body::{spectral_exitance, spectral_radiance};
///
/// assert_eq!(spectral_exitance(1e4, 300.0), std::f64::consts::PI * spectral_radiance(1e4, 300.0));
/// ```
pub fn spectral_exitance(wavelength_nm: f64, temperature_k: f64) -> f64 {
    PI * spectral_radiance(wavelength_nm, temperature_k)
}

/// Radiance over all wavelengths, `σT⁴/π`, W m⁻² sr⁻¹.
///
/// ```
/// use etendue::spectrum::black_body::radiance_w_m2_sr;
///
/// assert!((radiance_w_m2_sr(2856.0) / 1.200_866e6 - 1.0).abs() < 1e-6);
/// ```
pub fn radiance_w_m2_sr(temperature_k: f64) -> f64 {
    exitance_w_m2(temperature_k) / PI
}

/// Exitance over all wavelengths, `σT⁴`, W m⁻².
///
/// ```
/// use etendue::spectrum::black_body::exitance_w_m2;
///
/// // A room.
/// assert!((exitance_w_m2(300.0) - 459.300).abs() < 1e-3);
/// ```
pub fn exitance_w_m2(temperature_k: f64) -> f64 {
    STEFAN_BOLTZMANN_W_M2_K4 * temperature_k.powi(4)
}

/// Wavelength of the largest spectral radiance per nm (Wien), nm.
///
/// ```
/// use etendue::spectrum::black_body::peak_wavelength_nm;
///
/// assert!((peak_wavelength_nm(5772.0) - 502.04).abs() < 0.01);
/// ```
pub fn peak_wavelength_nm(temperature_k: f64) -> f64 {
    // The positive root of x = 5(1 − e⁻ˣ).
    const PEAK_X: f64 = 4.965_114_231_744_276;
    SECOND_RADIATION_CONSTANT_NM_K / PEAK_X / temperature_k
}

/// Second radiation constant in the definition of illuminant A, nm K (CIE 015:2018, equation 4.1), not today's value.
const ILLUMINANT_A_C2_NM_K: f64 = 1.435e7;
/// Temperature in the definition of illuminant A, K.
const ILLUMINANT_A_TEMPERATURE_K: f64 = 2848.0;

/// Range on which the CIE defines illuminant A, nm.
pub const ILLUMINANT_A_RANGE_NM: (f64, f64) = (300.0, 830.0);

/// Temperature at which Planck's law with today's c₂ has the shape of illuminant A: `2848 K · c₂/0.01435 m K`.
pub(super) fn illuminant_a_temperature_k() -> f64 {
    ILLUMINANT_A_TEMPERATURE_K * (SECOND_RADIATION_CONSTANT_NM_K / ILLUMINANT_A_C2_NM_K)
}

/// CIE illuminant A, relative, 100 at 560 nm; zero outside 300–830 nm:
/// `S = 100 (560/λ)⁵ (exp(1.435·10⁷/(2848·560)) − 1)/(exp(1.435·10⁷/(2848 λ)) − 1)`.
pub fn illuminant_a(wavelength_nm: f64) -> f64 {
    let (from, to) = ILLUMINANT_A_RANGE_NM;
    if !(from <= wavelength_nm && wavelength_nm <= to) {
        return 0.0;
    }
    let x = |nm: f64| ILLUMINANT_A_C2_NM_K / (ILLUMINANT_A_TEMPERATURE_K * nm);
    100.0 * (560.0 / wavelength_nm).powi(5) * (x(560.0).exp_m1() / x(wavelength_nm).exp_m1())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn logarithms_agree_with_the_reference_cases() {
        // /reference/g4_extreme.json, g4e.planck-1, -3, -5: temperature in K, wavelength in nm, ln L.
        for (temperature_k, nm, reference) in
            [(10.0, 360.0, -3979.80642643764), (300.0, 555.0, -71.7813350141029), (2856.0, 1e-3, -5037653.39962211)]
        {
            let deviation = ln_spectral_radiance(nm, temperature_k) / reference - 1.0;
            assert!(deviation.abs() < 1e-12, "{temperature_k} K, {nm} nm: {deviation:e}");
        }
    }

    #[test]
    fn illuminant_a_agrees_with_the_reference_cases() {
        // /reference/g2_spectral.json, g2b.illA-*.
        for (nm, reference) in [(300.0, 0.930482705616484), (450.0, 33.0858929715025), (700.0, 198.261223231287), (830.0, 261.602339765577)]
        {
            assert!((illuminant_a(nm) / reference - 1.0).abs() < 1e-12, "{nm} nm");
        }
        assert_eq!(illuminant_a(560.0), 100.0);
        assert_eq!([illuminant_a(299.9), illuminant_a(830.1), illuminant_a(f64::NAN)], [0.0; 3]);
    }

    proptest! {
        #[test]
        fn the_logarithm_is_that_of_the_radiance(ln_nm in -7.0..23.0_f64, ln_k in 0.0..16.0_f64) {
            let (nm, kelvin) = (ln_nm.exp(), ln_k.exp());
            let (radiance, ln) = (spectral_radiance(nm, kelvin), ln_spectral_radiance(nm, kelvin));
            prop_assert!(radiance.is_finite() && !ln.is_nan());
            if radiance > 1e-290 {
                // The exponent x is itself rounded, so the relative deviation grows with it.
                prop_assert!((radiance.ln() - ln).abs() < 1e-12 * (1.0 + ln.abs()));
            }
        }

        #[test]
        fn the_peak_is_a_maximum(ln_k in 0.0..16.0_f64, step in 0.001..0.5_f64) {
            let kelvin = ln_k.exp();
            let peak = peak_wavelength_nm(kelvin);
            let at_peak = spectral_radiance(peak, kelvin);
            prop_assert!(spectral_radiance(peak * (1.0 + step), kelvin) < at_peak);
            prop_assert!(spectral_radiance(peak * (1.0 - step), kelvin) < at_peak);
        }
    }
}
