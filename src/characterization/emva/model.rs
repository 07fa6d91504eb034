//! The figures of EMVA 1288 from the parameters of a pixel: what frames are expected to show.
//!
//! ```text
//! R = K η,   σ_y.dark² = K² σ_d0² + 1/12,   μ_p.sat = μ_e.sat/η,   SNR_max = √μ_e.sat,   DR = μ_e.sat/μ_e.min
//! ```
//!
//! Saturation and threshold are those of [`LinearModel`](crate::sensor::LinearModel). Dark noise, threshold and dynamic range are those of
//! an exposure without time; the linear model has no linearity error. Source: as the figures themselves.

use crate::sensor::{LinearModel, Pixel};

/// The keys of [`Figures`](super::Figures) with their values: of a pixel at a quantum efficiency above 0, up to 1, at a temperature in °C, that
/// is saturated in an exposure of `saturated_s`.
#[must_use]
pub fn expected(pixel: &Pixel, quantum_efficiency: f64, temperature_c: f64, saturated_s: f64) -> [(&'static str, f64); 17] {
    let still = pixel.linear(0.0, temperature_c);
    let saturation_e = pixel.linear(saturated_s, temperature_c).saturation_e();
    let dark_current_e_s = pixel.dark_current_at(temperature_c);
    [
        ("quantum_efficiency", quantum_efficiency),
        ("gain_dn_per_e", pixel.gain_dn_per_e),
        ("responsivity_dn_per_photon", pixel.responsivity_dn_per_photon(quantum_efficiency)),
        ("dark_noise_dn", still.variance_dn2(0.0).sqrt()),
        ("dark_noise_e", pixel.read_noise_e),
        ("dark_current_e_s", dark_current_e_s),
        ("dark_current_by_variance_e_s", dark_current_e_s),
        ("threshold_photons", still.threshold_photons(quantum_efficiency)),
        ("threshold_e", still.threshold_e()),
        ("saturation_photons", saturation_e / quantum_efficiency),
        ("saturation_e", saturation_e),
        ("largest_snr", LinearModel::largest_snr(saturation_e)),
        ("dynamic_range", saturation_e / still.threshold_e()),
        ("dsnu_e", pixel.dsnu_e),
        ("prnu", pixel.prnu),
        ("linearity_error_min", 0.0),
        ("linearity_error_max", 0.0),
    ]
}
