//! Photons of monochromatic radiation.
//!
//! ```text
//! Q_p = h c / λ = ħ ω     energy of one photon
//! ν = c / λ,  ω = 2π ν    frequency and angular frequency
//! Φ_p = Φ_e λ / (h c)     photon flux of a monochromatic radiant flux
//! ```
//!
//! λ is the wavelength **in vacuum**: the energy of a photon belongs to its frequency, and the wavelength in air is
//! shorter by 2.8e-4 ([`wavelength_in_vacuum_nm`](super::air::wavelength_in_vacuum_nm)). For a spectrum the factor λ/(hc) belongs under the integral; factors such as 4.57 µmol/J hold for
//! one spectrum only.
//!
//! Moles of photons: `n = N / N_A`, in every row of the photon column of the table.
//!
//! Source: BIPM, *The International System of Units*, 9th edition, appendix 3.

use super::constants::{AVOGADRO_PER_MOL, ELEMENTARY_CHARGE_C, PLANCK_J_S, REDUCED_PLANCK_J_S, SPEED_OF_LIGHT_M_S};
use super::table::{Irradiance, PhotonFlux, PhotonIrradiance, Quantity, RadiantFlux, system};
use std::f64::consts::PI;

const NANOMETRES_PER_METRE: f64 = 1e9;
const MICROMOLES_PER_MOLE: f64 = 1e6;

/// Energy of one photon, in J, of the wavelength `wavelength_vacuum_nm` in nanometres, above zero: `h c / λ`.
///
/// ```
/// use etendue::quantity::photon::{electronvolts, photon_energy_j};
///
/// // Green light: 2.23 eV.
/// assert!((electronvolts(photon_energy_j(555.0)) - 2.234).abs() < 1e-3);
/// ```
pub fn photon_energy_j(wavelength_vacuum_nm: f64) -> f64 {
    PLANCK_J_S * SPEED_OF_LIGHT_M_S / (wavelength_vacuum_nm / NANOMETRES_PER_METRE)
}

/// Frequency, in Hz, of radiation of the wavelength `wavelength_vacuum_nm`, above zero: `ν = c / λ`.
///
/// ```
/// let nu = etendue::quantity::photon::frequency_hz(299.792458);
/// assert!((nu / 1e15 - 1.0).abs() < 1e-15);
/// ```
pub fn frequency_hz(wavelength_vacuum_nm: f64) -> f64 {
    SPEED_OF_LIGHT_M_S / wavelength_vacuum_nm * NANOMETRES_PER_METRE
}

/// Angular frequency, in rad/s, of radiation of the wavelength `wavelength_vacuum_nm`, above zero: `ω = 2π c / λ`.
///
/// ```
/// use etendue::quantity::photon;
/// let energy_j = photon::photon_energy_of_angular_frequency_j(photon::angular_frequency_rad_s(555.0));
/// assert!((energy_j / photon::photon_energy_j(555.0) - 1.0).abs() < 1e-15);
/// ```
pub fn angular_frequency_rad_s(wavelength_vacuum_nm: f64) -> f64 {
    2.0 * PI * frequency_hz(wavelength_vacuum_nm)
}

/// Energy of one photon, in J, of the angular frequency `angular_frequency_rad_s`: `ħ ω`.
///
/// ```
/// let energy_j = etendue::quantity::photon::photon_energy_of_angular_frequency_j(1e15);
/// assert!((energy_j / 1.054571817e-19 - 1.0).abs() < 1e-9);
/// ```
pub fn photon_energy_of_angular_frequency_j(angular_frequency_rad_s: f64) -> f64 {
    REDUCED_PLANCK_J_S * angular_frequency_rad_s
}

/// An energy in electronvolts: `Q / e`.
///
/// ```
/// use etendue::quantity::photon::{electronvolts, photon_energy_j};
/// assert!((electronvolts(photon_energy_j(1239.841984332)) - 1.0).abs() < 1e-12);
/// ```
pub fn electronvolts(energy_j: f64) -> f64 {
    energy_j / ELEMENTARY_CHARGE_C
}

/// Photons per joule of monochromatic radiation, in 1/J: `λ / (h c)`.
///
/// ```
/// let photons = etendue::quantity::photon::photons_per_joule(555.0);
/// assert!((photons / 2.794e18 - 1.0).abs() < 1e-4);
/// ```
pub fn photons_per_joule(wavelength_vacuum_nm: f64) -> f64 {
    wavelength_vacuum_nm / NANOMETRES_PER_METRE / (PLANCK_J_S * SPEED_OF_LIGHT_M_S)
}

/// Photon flux of a monochromatic radiant flux: `Φ_p = Φ_e λ / (h c)`.
///
/// ```
/// use etendue::quantity::{photon::monochromatic_photon_flux, table::RadiantFlux};
///
/// // A pointer of a milliwatt.
/// let photons = monochromatic_photon_flux(RadiantFlux::new(1e-3), 632.8);
/// assert!((photons.value() / 3.1856e15 - 1.0).abs() < 1e-4);
/// ```
pub fn monochromatic_photon_flux(flux: RadiantFlux, wavelength_vacuum_nm: f64) -> PhotonFlux {
    PhotonFlux::new(flux.value() * photons_per_joule(wavelength_vacuum_nm))
}

/// Photon irradiance of a monochromatic irradiance: `E_p = E_e λ / (h c)`.
///
/// ```
/// use etendue::quantity::{photon::monochromatic_photon_irradiance, table::Irradiance};
///
/// let blue = monochromatic_photon_irradiance(Irradiance::new(1.0), 450.0);
/// assert!((blue.umol_m2_s() - 3.7617).abs() < 1e-4);
/// ```
pub fn monochromatic_photon_irradiance(irradiance: Irradiance, wavelength_vacuum_nm: f64) -> PhotonIrradiance {
    PhotonIrradiance::new(irradiance.value() * photons_per_joule(wavelength_vacuum_nm))
}

impl<K> Quantity<K, system::Photon> {
    /// The number in moles of photons instead of photons (mol, mol/s, mol/(m² s), …): divided by N_A.
    ///
    /// ```
    /// use etendue::quantity::table::PhotonFlux;
    /// assert_eq!(PhotonFlux::new(6.02214076e23).moles(), 1.0);
    /// ```
    pub fn moles(self) -> f64 {
        self.value() / AVOGADRO_PER_MOL
    }

    /// From a number in moles of photons: `N = n N_A`.
    ///
    /// ```
    /// use etendue::quantity::table::PhotonNumber;
    /// assert_eq!(PhotonNumber::from_moles(2.0).value(), 12.04428152e23);
    /// ```
    pub fn from_moles(moles: f64) -> Self {
        Self::new(moles * AVOGADRO_PER_MOL)
    }
}

impl PhotonIrradiance {
    /// The number in µmol/(m² s), the unit of plant physiology: `E_p / N_A`.
    ///
    /// ```
    /// use etendue::quantity::table::PhotonIrradiance;
    ///
    /// assert_eq!(PhotonIrradiance::new(6.02214076e17).umol_m2_s(), 1.0);
    /// ```
    pub fn umol_m2_s(self) -> f64 {
        self.value() / AVOGADRO_PER_MOL * MICROMOLES_PER_MOLE
    }

    /// From a number in µmol/(m² s).
    ///
    /// ```
    /// use etendue::quantity::table::PhotonIrradiance;
    ///
    /// // Full sun on leaves.
    /// assert!((PhotonIrradiance::from_umol_m2_s(2000.0).value() / 1.204428152e21 - 1.0).abs() < 1e-15);
    /// ```
    pub fn from_umol_m2_s(umol_m2_s: f64) -> Self {
        Self::new(umol_m2_s / MICROMOLES_PER_MOLE * AVOGADRO_PER_MOL)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn assert_close(found: f64, expected: f64) {
        assert!((found / expected - 1.0).abs() <= 1e-14, "found {found:e}, expected {expected:e}");
    }

    #[test]
    fn photon_energies_agree_with_the_references() {
        // g1a.photon-energy-1, -3, -5.
        assert_close(photon_energy_j(555.0), 3.579_181_724_592_664_3e-19);
        assert_close(photon_energy_j(1064.0), 1.866_960_392_057_263_9e-19);
        assert_close(photon_energy_j(253.652), 7.831_382_591_696_216e-19);
    }

    #[test]
    fn photon_rate_of_a_femtowatt_agrees_with_the_reference() {
        // g1a.photon-rate-2.
        let rate = monochromatic_photon_flux(RadiantFlux::new(1e-15), 632.8);
        assert_close(rate.value(), 3_185.588_963_941_026_6);
    }

    #[test]
    fn photosynthetic_photon_irradiance_agrees_with_the_reference() {
        // g1a.ppfd-1.
        let e_p = monochromatic_photon_irradiance(Irradiance::new(1.0), 450.0);
        assert_close(e_p.umol_m2_s(), 3.761_706_253_100_299_6);
    }

    proptest! {
        #[test]
        fn photons_times_their_energy_are_the_flux(watts in 1e-300..1e9f64, nm in 1.0..1e6f64) {
            let photons = monochromatic_photon_flux(RadiantFlux::new(watts), nm);
            prop_assert!((photons.value() * photon_energy_j(nm) / watts - 1.0).abs() < 1e-15);
        }

        #[test]
        fn energy_by_wavelength_and_by_frequency_agree(nm in 1e-6..1e12f64) {
            let by_frequency = photon_energy_of_angular_frequency_j(angular_frequency_rad_s(nm));
            prop_assert!((by_frequency / photon_energy_j(nm) - 1.0).abs() < 1e-15);
            prop_assert!((PLANCK_J_S * frequency_hz(nm) / by_frequency - 1.0).abs() < 1e-15);
        }

        #[test]
        fn moles_return(n in 1e-250..1e250f64) {
            let back = PhotonFlux::from_moles(PhotonFlux::new(n).moles());
            prop_assert!((back.value() / n - 1.0).abs() < 1e-15);
        }

        #[test]
        fn micromoles_return(e_p in 1e-300..1e30f64) {
            let back = PhotonIrradiance::from_umol_m2_s(PhotonIrradiance::new(e_p).umol_m2_s());
            prop_assert!((back.value() / e_p - 1.0).abs() < 1e-15);
        }
    }
}
