//! Light on a pixel: photons from an irradiance, irradiance at an f-number.
//!
//! ```text
//! μ_p = E A t λ/(hc)                 photons, λ in vacuum
//! E   = π L / (1 + 4 N²)             on the axis of a uniform disc of diameter D at the distance d, N = d/D, no lens
//! ```
//!
//! | symbol | argument | unit |
//! |---|---|---|
//! | E | `irradiance_w_m2` | W/m² |
//! | A | `area_m2`, the area that collects | m² |
//! | t | `exposure_s` | s |
//! | λ | `wavelength_vacuum_nm` | nm |
//! | L, N | `radiance_w_m2_sr`, `f_number` | W/(m² sr), 1 |
//!
//! Source: EMVA Standard 1288, release 4.0, 2.2 and 6.2; the second is the form factor of a disc.
//!
//! ```
//! use etendue::sensor::pixel::light::photons;
//!
//! // 50.34 photons a µm², ms, µm and µW/cm².
//! let found = photons(0.01, 1e-12, 1e-3, 1000.0);
//! assert!((found - 50.34).abs() < 0.01);
//! ```

use crate::quantity::photon::photon_energy_j;
use std::f64::consts::PI;

/// Mean photons on a pixel during an exposure, of monochromatic light.
#[must_use]
pub fn photons(irradiance_w_m2: f64, area_m2: f64, exposure_s: f64, wavelength_vacuum_nm: f64) -> f64 {
    irradiance_w_m2 * area_m2 * exposure_s / photon_energy_j(wavelength_vacuum_nm)
}

/// Irradiance, W/m², on the axis of a uniform disc of the radiance `radiance_w_m2_sr` at the f-number N = distance/diameter.
#[must_use]
pub fn irradiance_at_f_number(radiance_w_m2_sr: f64, f_number: f64) -> f64 {
    PI * radiance_w_m2_sr / (1.0 + 4.0 * f_number * f_number)
}
