//! Wavelength in air and in vacuum.
//!
//! ```text
//! λ_air = λ_vacuum / n
//! 10⁸ (n − 1) = 5792105 / (238.0185 − σ²) + 167917 / (57.362 − σ²),   σ = 1 / λ_vacuum in 1/µm
//! ```
//!
//! Standard air: dry, 15 °C, 101 325 Pa, 450 µmol/mol CO₂. The formula was fitted from 230 nm to 1690 nm and is smooth
//! beyond that. Below 200 nm air is opaque, and wavelengths are by custom those in vacuum: n is taken as one there.
//!
//! Needed wherever photons are counted: spectra are tabulated in air, the energy of a photon belongs to the wavelength
//! in vacuum.
//!
//! Source: P. E. Ciddor, Applied Optics 35 (1996) 1566, equation 1.

/// Below this wavelength, in nm, a wavelength is one in vacuum.
const VACUUM_BELOW_NM: f64 = 200.0;
/// Each step of the inversion gains five digits or more; four reach rounding.
const INVERSION_STEPS: usize = 4;

/// Refractive index of standard air at the vacuum wavelength `wavelength_vacuum_nm`, in nm; 1.00028 in the visible.
pub fn refractive_index_of_air(wavelength_vacuum_nm: f64) -> f64 {
    if wavelength_vacuum_nm < VACUUM_BELOW_NM {
        return 1.0;
    }
    let per_um = 1e3 / wavelength_vacuum_nm;
    let s = per_um * per_um;
    1.0 + 1e-8 * (5_792_105.0 / (238.0185 - s) + 167_917.0 / (57.362 - s))
}

/// Wavelength in standard air, in nm, of radiation with the vacuum wavelength `wavelength_vacuum_nm`.
pub fn wavelength_in_air_nm(wavelength_vacuum_nm: f64) -> f64 {
    wavelength_vacuum_nm / refractive_index_of_air(wavelength_vacuum_nm)
}

/// Wavelength in vacuum, in nm, of radiation with the wavelength `wavelength_air_nm` in standard air.
pub fn wavelength_in_vacuum_nm(wavelength_air_nm: f64) -> f64 {
    let mut vacuum_nm = wavelength_air_nm;
    for _ in 0..INVERSION_STEPS {
        vacuum_nm = wavelength_air_nm * refractive_index_of_air(vacuum_nm);
    }
    vacuum_nm
}

#[cfg(test)]
mod tests {
    use super::super::constants::SPEED_OF_LIGHT_M_S;
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn radiation_of_540_thz_lies_at_555_016_nm_in_air() {
        let vacuum_nm = SPEED_OF_LIGHT_M_S / 540e12 * 1e9;
        assert!((vacuum_nm - 555.171).abs() < 5e-4);
        assert!((wavelength_in_air_nm(vacuum_nm) - 555.016).abs() < 2e-3);
    }

    #[test]
    fn the_helium_neon_and_sodium_lines_agree_with_spectroscopic_tables() {
        // NIST Atomic Spectra Database: the red line of the helium-neon laser and sodium D2, wavelength in vacuum and in air.
        for (vacuum_nm, air_nm) in [(632.991_4, 632.816_4), (589.158_3, 588.995_0)] {
            assert!((wavelength_in_air_nm(vacuum_nm) - air_nm).abs() < 3e-4);
        }
    }

    proptest! {
        #[test]
        fn the_way_to_air_and_back_is_the_identity(vacuum_nm in 201.0..1e6f64) {
            let back = wavelength_in_vacuum_nm(wavelength_in_air_nm(vacuum_nm));
            prop_assert!((back / vacuum_nm - 1.0).abs() < 5e-16);
            prop_assert!(wavelength_in_air_nm(vacuum_nm) < vacuum_nm);
        }

        #[test]
        fn below_200_nm_wavelengths_are_those_in_vacuum(nm in 1e-3..199.9f64) {
            prop_assert_eq!(wavelength_in_air_nm(nm), nm);
            prop_assert_eq!(wavelength_in_vacuum_nm(nm), nm);
        }
    }
}
