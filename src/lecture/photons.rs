//! Photons and energy.

use super::equation::Domain::{NotNegative, Positive};
use super::equation::{Also, Equation, Group, Input, Outcome, cell, in_any_system, input, outcome};
use crate::quantity::Duration;
use crate::quantity::air::wavelength_in_vacuum_nm;
use crate::quantity::cell::Row;
use crate::quantity::photon::{
    angular_frequency_rad_s, electronvolts, frequency_hz, monochromatic_photon_flux, monochromatic_photon_irradiance, photon_energy_j,
    photon_energy_of_angular_frequency_j,
};
use crate::quantity::table::{Irradiance, LuminousEnergy, LuminousFlux, PhotonFlux, PhotonIrradiance, PhotonNumber, RadiantFlux};

pub(super) const WAVELENGTH: Input = input("wavelength_nm", "λ", "nm", Positive, "wavelength in vacuum");
const SI: &str = "BIPM, The International System of Units, 9th edition, appendix 3";
const ENERGY_OF_A_PHOTON: Outcome = outcome("photon energy", "Q", "J");

pub(super) const EQUATIONS: &[Equation] = &[
    Equation {
        name: "photon-energy",
        group: Group::Photons,
        formula: "Q = h c / λ",
        about: "energy of one photon",
        inputs: &[WAVELENGTH],
        outcome: ENERGY_OF_A_PHOTON,
        source: SI,
        example: &[("wavelength_nm", "555")],
        compute: |g| Ok(photon_energy_j(g.number("wavelength_nm"))),
        also: &[
            Also { what: "in electronvolts", unit: "eV", compute: |_, j| electronvolts(j) },
            Also {
                what: "if λ is the wavelength in standard air",
                unit: "J",
                compute: |g, _| photon_energy_j(wavelength_in_vacuum_nm(g.number("wavelength_nm"))),
            },
        ],
    },
    Equation {
        name: "photon-energy-from-angular-frequency",
        group: Group::Photons,
        formula: "Q = ħ ω",
        about: "energy of one photon by its angular frequency",
        inputs: &[input("angular_frequency_rad_s", "ω", "rad/s", Positive, "angular frequency, 2π times the frequency")],
        outcome: ENERGY_OF_A_PHOTON,
        source: SI,
        example: &[("angular_frequency_rad_s", "3.394e15")],
        compute: |g| Ok(photon_energy_of_angular_frequency_j(g.number("angular_frequency_rad_s"))),
        also: &[Also { what: "in electronvolts", unit: "eV", compute: |_, j| electronvolts(j) }],
    },
    Equation {
        name: "frequency",
        group: Group::Photons,
        formula: "ν = c / λ",
        about: "frequency of radiation",
        inputs: &[WAVELENGTH],
        outcome: outcome("frequency", "ν", "Hz"),
        source: SI,
        example: &[("wavelength_nm", "555.171")],
        compute: |g| Ok(frequency_hz(g.number("wavelength_nm"))),
        also: &[Also {
            what: "angular frequency ω = 2π ν",
            unit: "rad/s",
            compute: |g, _| angular_frequency_rad_s(g.number("wavelength_nm")),
        }],
    },
    Equation {
        name: "photon-flux",
        group: Group::Photons,
        formula: "Φ_p = Φ λ / (h c)",
        about: "photons per second of a monochromatic radiant flux",
        inputs: &[input("radiant_flux_w", "Φ", "W", NotNegative, "radiant flux"), WAVELENGTH],
        outcome: cell::<PhotonFlux>(),
        source: SI,
        example: &[("radiant_flux_w", "0.001"), ("wavelength_nm", "632.8")],
        compute: |g| Ok(monochromatic_photon_flux(RadiantFlux::new(g.number("radiant_flux_w")), g.number("wavelength_nm")).value()),
        also: &[Also { what: "in moles of photons, Φ_p / N_A", unit: "mol/s", compute: |_, n| PhotonFlux::new(n).moles() }],
    },
    Equation {
        name: "photon-irradiance",
        group: Group::Photons,
        formula: "E_p = E λ / (h c)",
        about: "photons per second and area of a monochromatic irradiance",
        inputs: &[input("irradiance_w_m2", "E", "W/m²", NotNegative, "irradiance"), WAVELENGTH],
        outcome: cell::<PhotonIrradiance>(),
        source: SI,
        example: &[("irradiance_w_m2", "1"), ("wavelength_nm", "450")],
        compute: |g| Ok(monochromatic_photon_irradiance(Irradiance::new(g.number("irradiance_w_m2")), g.number("wavelength_nm")).value()),
        also: &[Also { what: "in micromoles of photons", unit: "µmol/(m² s)", compute: |_, n| PhotonIrradiance::new(n).umol_m2_s() }],
    },
    Equation {
        name: "moles-of-photons",
        group: Group::Photons,
        formula: "n = N / N_A",
        about: "amount of substance of photons",
        inputs: &[input("photons", "N", "1", NotNegative, "number of photons")],
        outcome: outcome("amount of photons", "n", "mol"),
        source: "BIPM, The International System of Units, 9th edition: N_A = 6.022 140 76e23 / mol",
        example: &[("photons", "6.02214076e23")],
        compute: |g| Ok(PhotonNumber::new(g.number("photons")).moles()),
        also: &[],
    },
    Equation {
        name: "energy",
        group: Group::Photons,
        formula: "Q = Φ t",
        about: "energy of a constant flux over a time, in any system",
        inputs: &[in_any_system("flux", "Φ", Row::Flux, "flux"), input("seconds", "t", "s", NotNegative, "duration")],
        outcome: Outcome::Of(Row::Energy),
        source: "ISO 80000-7",
        example: &[("flux_lm", "800"), ("seconds", "3600")],
        compute: |g| Ok((RadiantFlux::new(g.number("flux")) * Duration::new(g.number("seconds"))).value()),
        also: &[],
    },
    Equation {
        name: "luminous-energy",
        group: Group::Photons,
        formula: "Q_v = Φ_v t",
        about: "luminous energy of a constant luminous flux; one lumen second is called a talbot",
        inputs: &[
            input("luminous_flux_lm", "Φ_v", "lm", NotNegative, "luminous flux"),
            input("seconds", "t", "s", NotNegative, "duration"),
        ],
        outcome: cell::<LuminousEnergy>(),
        source: "ISO 80000-7",
        example: &[("luminous_flux_lm", "800"), ("seconds", "10")],
        compute: |g| Ok((LuminousFlux::new(g.number("luminous_flux_lm")) * Duration::new(g.number("seconds"))).value()),
        also: &[Also { what: "in talbots", unit: "T", compute: |_, lm_s| lm_s }],
    },
];
