//! The colour of a light: from a spectrum to numbers that say how it looks.
//!
//! ```text
//! spectrum ─ ∫ φ x̄ dλ → Tristimulus ─→ Chromaticity ─┬→ correlated colour temperature, Duv
//!                             └→ sRGB                 └→ dominant wavelength, purity
//! ```
//!
//! | file | what |
//! |---|---|
//! | `tristimulus` | X, Y, Z of a density and three colour-matching functions |
//! | `chromaticity` | x, y; u′, v′; u, v of 1960 |
//! | `planckian` | the chromaticities of black bodies |
//! | `temperature` | correlated colour temperature and Duv |
//! | `dominant` | dominant and complementary wavelength, purity |
//! | `rgb` | linear and 8-bit sRGB, the lecture's R, G, B |
//! | `lab` | CIELAB and the distance of colours |
//! | `locus` | spectral and daylight locus, white points |
//!
//! ```
//! use etendue::observer::Matching;
//! use etendue::observer::colour::{PlanckianLocus, Tristimulus, correlated_temperature};
//! use etendue::spectrum::library;
//!
//! let matching = Matching::Cie1931.functions();
//! let d65 = Tristimulus::of(&library::density("D65")?, &matching).chromaticity().unwrap();
//! assert!((d65.x - 0.3127).abs() < 1e-4 && (d65.y - 0.3290).abs() < 1e-4);
//! let white = correlated_temperature(d65, &PlanckianLocus::new(&matching))?;
//! assert!((white.cct_k - 6503.0).abs() < 2.0 && (white.duv - 0.0032).abs() < 1e-4);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod chromaticity;
mod dominant;
mod lab;
mod locus;
mod planckian;
mod rgb;
mod temperature;
mod tristimulus;

pub use chromaticity::Chromaticity;
pub use dominant::{DominantWavelength, Hue, SpectralLocus, dominant_wavelength};
pub use lab::Lab;
pub use locus::{LOCUS_RANGE_NM, SpectralPoint, spectral_locus, white_point};
pub use planckian::PlanckianLocus;
pub use rgb::{Gamut, Srgb, linear_srgb_of, tristimulus_of_linear_srgb, xyz_of_wright_guild};
pub use temperature::{CorrelatedTemperature, LARGEST_DUV, LEAST_CCT_K, NoTemperature, correlated_temperature};
pub use tristimulus::Tristimulus;

#[cfg(test)]
mod tests;
