//! Photometry: the same light in another system, through its spectrum.

use super::Given;
use super::equation::Domain::{Between, NotNegative};
use super::equation::{Also, Equation, Group, Input, SPECTRUM, cell, input, outcome};
use crate::observer::conversion::{ConversionError, FixedSystem, convert, to_mesopic};
use crate::observer::mesopic::{EFFICACY_RATIO, mesopic};
use crate::observer::{AlphaOpic, Efficiency, efficiency};
use crate::quantity::table::{
    Illuminance, Irradiance, Luminance, LuminousFlux, MelanopicIrradiance, MesopicLuminance, PhotonIrradiance, Quantity, Radiance,
    RadiantFlux, ScotopicLuminance, system,
};
use crate::spectrum::Density;

const AIR_WAVELENGTH: Input = input("wavelength_nm", "λ", "nm", Between(360.0, 830.0), "wavelength in air, where V(λ) is tabulated");
const RADIANCE: Input = input("radiance_w_m2_sr", "L_e", "W/(m² sr)", NotNegative, "radiance");
const LUMINANCE: Input = input("luminance_cd_m2", "L_v", "cd/m²", NotNegative, "luminance");
const ILLUMINANCE: Input = input("illuminance_lx", "E_v", "lx", NotNegative, "illuminance");
const K_M: &str = "ISO 23539: K_m = 683.002 lm/W with V(λ) in air, from 683 lm/W at 540 THz";
const S026: &str = "CIE S 026";

/// A conversion; nothing out of something is said, not printed as a zero.
fn through<K, From: FixedSystem, To: FixedSystem>(quantity: Quantity<K, From>, g: &Given) -> Result<f64, String> {
    let converted: Quantity<K, To> = convert(quantity, &g.spectrum()).map_err(|e: ConversionError| e.to_string())?;
    something(converted.value(), quantity.value(), To::SYSTEM)
}

fn something(value: f64, given: f64, system: crate::observer::conversion::System) -> Result<f64, String> {
    let nothing = value == 0.0 && given != 0.0;
    if nothing { Err(format!("the {system} system sees nothing of this spectrum")) } else { Ok(value) }
}

fn line(g: &Given) -> Result<Density, String> {
    Density::line(g.number("wavelength_nm"), 1.0).map_err(|e| e.to_string())
}

pub(super) const EQUATIONS: &[Equation] = &[
    Equation {
        name: "luminous-efficacy",
        group: Group::Photometry,
        formula: "K(λ) = K_m V(λ)",
        about: "luminous efficacy of monochromatic radiation",
        inputs: &[AIR_WAVELENGTH],
        outcome: outcome("luminous efficacy of radiation", "K", "lm/W"),
        source: K_M,
        example: &[("wavelength_nm", "546.07")],
        compute: |g| {
            efficiency::luminous_efficacy_lm_w(&line(g)?, Efficiency::Photopic1924).ok_or_else(|| "the line has no power".to_owned())
        },
        also: &[],
    },
    Equation {
        name: "luminous-flux-of-a-line",
        group: Group::Photometry,
        formula: "Φ_v = K_m V(λ) Φ_e",
        about: "luminous flux of monochromatic radiation",
        inputs: &[input("radiant_flux_w", "Φ_e", "W", NotNegative, "radiant flux"), AIR_WAVELENGTH],
        outcome: cell::<LuminousFlux>(),
        source: K_M,
        example: &[("radiant_flux_w", "1"), ("wavelength_nm", "546.07")],
        compute: |g| {
            let flux: LuminousFlux = convert(RadiantFlux::new(g.number("radiant_flux_w")), &line(g)?).map_err(|e| e.to_string())?;
            Ok(flux.value())
        },
        also: &[],
    },
    Equation {
        name: "luminous-efficacy-of-a-spectrum",
        group: Group::Photometry,
        formula: "K = K_m ∫ S V dλ / ∫ S dλ",
        about: "luminous efficacy of radiation of a spectrum",
        inputs: &[SPECTRUM],
        outcome: outcome("luminous efficacy of radiation", "K", "lm/W"),
        source: K_M,
        example: &[("spectrum", "LED-B3")],
        compute: |g| {
            efficiency::luminous_efficacy_lm_w(&g.spectrum(), Efficiency::Photopic1924).ok_or_else(|| ConversionError::NoLight.to_string())
        },
        also: &[],
    },
    Equation {
        name: "radiance-to-luminance",
        group: Group::Photometry,
        formula: "L_v = K_m ∫ L_λ V dλ = L_e K_m ∫ S V dλ / ∫ S dλ",
        about: "luminance of a radiance of a spectrum",
        inputs: &[RADIANCE, SPECTRUM],
        outcome: cell::<Luminance>(),
        source: K_M,
        example: &[("radiance_w_m2_sr", "1"), ("spectrum", "D65")],
        compute: |g| through::<_, _, system::Luminous>(Radiance::new(g.number("radiance_w_m2_sr")), g),
        also: &[],
    },
    Equation {
        name: "luminance-to-radiance",
        group: Group::Photometry,
        formula: "L_e = L_v ∫ S dλ / (K_m ∫ S V dλ)",
        about: "radiance of a luminance of a spectrum, over all wavelengths that the spectrum has",
        inputs: &[LUMINANCE, SPECTRUM],
        outcome: cell::<Radiance>(),
        source: K_M,
        example: &[("luminance_cd_m2", "100"), ("spectrum", "D65")],
        compute: |g| through::<_, _, system::Radiant>(Luminance::new(g.number("luminance_cd_m2")), g),
        also: &[],
    },
    Equation {
        name: "irradiance-to-illuminance",
        group: Group::Photometry,
        formula: "E_v = E_e K_m ∫ S V dλ / ∫ S dλ",
        about: "illuminance of an irradiance of a spectrum",
        inputs: &[input("irradiance_w_m2", "E_e", "W/m²", NotNegative, "irradiance"), SPECTRUM],
        outcome: cell::<Illuminance>(),
        source: K_M,
        example: &[("irradiance_w_m2", "1"), ("spectrum", "555")],
        compute: |g| through::<_, _, system::Luminous>(Irradiance::new(g.number("irradiance_w_m2")), g),
        also: &[],
    },
    Equation {
        name: "illuminance-to-photon-irradiance",
        group: Group::Photometry,
        formula: "E_p = E_v ∫ S nλ/(hc) dλ / (K_m ∫ S V dλ)",
        about: "photons per second and area of an illuminance of a spectrum, over all wavelengths that the spectrum has",
        inputs: &[ILLUMINANCE, SPECTRUM],
        outcome: cell::<PhotonIrradiance>(),
        source: K_M,
        example: &[("illuminance_lx", "1000"), ("spectrum", "D65")],
        compute: |g| through::<_, _, system::Photon>(Illuminance::new(g.number("illuminance_lx")), g),
        also: &[Also { what: "in micromoles of photons", unit: "µmol/(m² s)", compute: |_, n| PhotonIrradiance::new(n).umol_m2_s() }],
    },
    Equation {
        name: "luminance-to-scotopic-luminance",
        group: Group::Photometry,
        formula: "L_v' = L_v K'_m ∫ S V' dλ / (K_m ∫ S V dλ)",
        about: "scotopic luminance, for dark-adapted eyes, of a luminance of a spectrum",
        inputs: &[LUMINANCE, SPECTRUM],
        outcome: cell::<ScotopicLuminance>(),
        source: "CIE 018.2; ISO 23539",
        example: &[("luminance_cd_m2", "0.01"), ("spectrum", "A")],
        compute: |g| through::<_, _, system::Scotopic>(Luminance::new(g.number("luminance_cd_m2")), g),
        also: &[],
    },
    Equation {
        name: "luminance-to-mesopic-luminance",
        group: Group::Photometry,
        formula: "L_mes = K_m,mes ∫ L_λ V_mes,m dλ,  m = 0.7670 + 0.3334 lg L_mes",
        about: "mesopic luminance of a field that an eye has adapted to",
        inputs: &[LUMINANCE, SPECTRUM],
        outcome: cell::<MesopicLuminance>(),
        source: "CIE 191 (MES2)",
        example: &[("luminance_cd_m2", "0.1"), ("spectrum", "LED-B3")],
        compute: |g| {
            let luminance = Luminance::new(g.number("luminance_cd_m2"));
            let ratio = efficiency::sp_ratio_with(&g.spectrum(), EFFICACY_RATIO).ok_or("V(λ) sees nothing of this spectrum")?;
            let adapted = mesopic(luminance.value(), ratio).map_err(|e| e.to_string())?;
            Ok(to_mesopic(luminance, &g.spectrum(), adapted.adaptation).map_err(|e| e.to_string())?.value())
        },
        also: &[],
    },
    Equation {
        name: "illuminance-to-melanopic-irradiance",
        group: Group::Photometry,
        formula: "E_mel = E_v ∫ S s_mel dλ / (K_m ∫ S V dλ)",
        about: "melanopic irradiance of an illuminance of a spectrum",
        inputs: &[ILLUMINANCE, SPECTRUM],
        outcome: cell::<MelanopicIrradiance>(),
        source: S026,
        example: &[("illuminance_lx", "1000"), ("spectrum", "D65")],
        compute: |g| through::<_, _, system::Melanopic>(Illuminance::new(g.number("illuminance_lx")), g),
        also: &[Also {
            what: "melanopic equivalent daylight illuminance",
            unit: "lx",
            compute: |_, irradiance| irradiance / AlphaOpic::Melanopic.elr_of_d65(),
        }],
    },
    Equation {
        name: "melanopic-daylight-efficacy-ratio",
        group: Group::Photometry,
        formula: "γ = (∫ S s_mel dλ / ∫ S V dλ) / (the same of D65)",
        about: "melanopic daylight efficacy ratio: lux of daylight that are as melanopic as one lux of this light",
        inputs: &[SPECTRUM],
        outcome: outcome("melanopic daylight efficacy ratio", "γ_mel", "1"),
        source: S026,
        example: &[("spectrum", "LED-B3")],
        compute: |g| {
            AlphaOpic::Melanopic.daylight_efficacy_ratio(&g.spectrum()).ok_or_else(|| "V(λ) sees nothing of this spectrum".to_owned())
        },
        also: &[],
    },
];
