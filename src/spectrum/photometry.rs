//! One spectrum in three systems of quantities: radiant, luminous, photon.
//!
//! | system | total of a density φ in W nm⁻¹ | unit |
//! |---|---|---|
//! | radiant | `∫ φ dλ` | W |
//! | luminous | `K_m ∫ φ V dλ`, `K_m` = 683.002 lm W⁻¹ | lm |
//! | photon | `∫ φ n λ/(hc) dλ` | s⁻¹; divided by N_A, mol s⁻¹ |
//!
//! The same functions turn W m⁻² into lx and W m⁻² sr⁻¹ into cd m⁻²: what is per area or per solid angle stays so.
//! What `K_m` is and why is written at the head of [`constants`](crate::quantity::constants).

use super::{Density, Factor, Outside, Table};
use crate::quantity::air::wavelength_in_vacuum_nm;
use crate::quantity::constants::{AVOGADRO_PER_MOL, K_M_LM_W, PLANCK_J_S, SPEED_OF_LIGHT_M_S};

/// In which medium the wavelengths of a spectrum are counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WavelengthsIn {
    /// Standard air, as all wavelengths of this library are unless stated otherwise.
    StandardAir,
    /// Vacuum.
    Vacuum,
}

/// Photons per energy, `n λ/(hc)`, J⁻¹: what turns a spectral flux in W into photons per second. The energy of a photon goes by its
/// wavelength in vacuum, which is n = 1.00028 times that in air.
pub fn photons_per_joule(wavelengths: WavelengthsIn) -> Factor {
    let vacuum = Factor::Proportional(1e-9 / (PLANCK_J_S * SPEED_OF_LIGHT_M_S));
    match wavelengths {
        WavelengthsIn::StandardAir => Factor::Product(vec![vacuum, refractive_index_of_air()]),
        WavelengthsIn::Vacuum => vacuum,
    }
}

/// Refractive index of standard air over the wavelength in air, every 5 nm from 200 nm to 2500 nm and held outside; straight to 1e-8
/// between the nodes. NaN if the table could not be made, which a test excludes.
fn refractive_index_of_air() -> Factor {
    let rows: Vec<(f64, f64)> = (40..=500).map(|i| 5.0 * f64::from(i)).map(|nm| (nm, wavelength_in_vacuum_nm(nm) / nm)).collect();
    Table::from_rows(&rows, Outside::Hold).map_or(Factor::Constant(f64::NAN), Factor::Table)
}

/// Radiant total, in the density's unit times nm (W for W nm⁻¹).
pub fn radiant(density: &Density) -> f64 {
    density.total()
}

/// Luminous total through the luminous efficiency `v` (`library::v_lambda()`): lm for W nm⁻¹, lx for W m⁻² nm⁻¹.
pub fn luminous(density: &Density, v: &Factor) -> f64 {
    density.integral(&[v, &Factor::Constant(K_M_LM_W)])
}

/// Photons per second for W nm⁻¹, photons s⁻¹ m⁻² for W m⁻² nm⁻¹.
pub fn photons(density: &Density, wavelengths: WavelengthsIn) -> f64 {
    density.integral(&[&photons_per_joule(wavelengths)])
}

/// Photons in mol s⁻¹ for W nm⁻¹, mol s⁻¹ m⁻² for W m⁻² nm⁻¹.
pub fn photons_mol(density: &Density, wavelengths: WavelengthsIn) -> f64 {
    density.integral(&[&photons_per_joule(wavelengths), &Factor::Constant(1.0 / AVOGADRO_PER_MOL)])
}

/// Luminous efficacy of radiation, lm W⁻¹; `None` for a density that is zero.
pub fn luminous_efficacy_lm_w(density: &Density, v: &Factor) -> Option<f64> {
    Some(K_M_LM_W * density.mean_of(v)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_watt_at_555_nm_is_683_lumens_and_2_8e18_photons() {
        let laser = Density::line(555.0, 1.0).unwrap();
        let v = Factor::Constant(1.0);
        assert_eq!(luminous(&laser, &v), 683.002);
        // Photon energy hc/λ = 1239.841984 eV nm / 555 nm, 1 eV = 1.602176634e-19 J.
        let expected = 1.0 / (1_239.841_984_332 / 555.0 * 1.602_176_634e-19);
        assert!((photons(&laser, WavelengthsIn::Vacuum) / expected - 1.0).abs() < 1e-11);
        assert!((photons_mol(&laser, WavelengthsIn::Vacuum) * 6.022_140_76e23 / expected - 1.0).abs() < 1e-11);
    }

    #[test]
    fn photons_of_a_black_body_follow_the_third_power_of_temperature() {
        // Photon radiance 2c (kT/(hc))³ Γ(3) ζ(3); Γ(3) ζ(3) = 2 · 1.2020569031595942.
        for kelvin in [1.0_f64, 300.0, 2856.0, 1e7] {
            let wavenumber = 1e9 * kelvin / super::super::black_body::SECOND_RADIATION_CONSTANT_NM_K;
            let expected = 2.0 * SPEED_OF_LIGHT_M_S * wavenumber.powi(3) * 2.0 * 1.202_056_903_159_594_2;
            let found = photons(&Density::black_body(kelvin).unwrap(), WavelengthsIn::Vacuum);
            assert!((found / expected - 1.0).abs() < 1e-11, "{kelvin} K: {found:e} against {expected:e}");
        }
    }

    #[test]
    fn a_photon_has_the_energy_of_its_wavelength_in_vacuum() {
        for nm in [210.0, 405.3, 546.07, 1064.0, 2400.0] {
            let found = photons(&Density::line(nm, 1.0).unwrap(), WavelengthsIn::StandardAir);
            let expected = crate::quantity::photon::photons_per_joule(wavelength_in_vacuum_nm(nm));
            assert!((found / expected - 1.0).abs() < 5e-8, "{nm} nm: {found:e} against {expected:e}");
        }
    }

    #[test]
    fn a_density_of_nothing_has_no_efficacy() {
        assert_eq!(luminous_efficacy_lm_w(&Density::zero(), &Factor::ONE), None);
    }
}
