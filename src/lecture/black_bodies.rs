//! Black bodies.

use super::Given;
use super::equation::Domain::Positive;
use super::equation::{Equation, Group, Input, cell, input, outcome};
use crate::observer::{Efficiency, efficiency};
use crate::quantity::table::{Luminance, Radiance, RadiantExitance};
use crate::spectrum::{Density, black_body};

const WAVELENGTH: Input = input("wavelength_nm", "λ", "nm", Positive, "wavelength, taken as in vacuum");
const TEMPERATURE: Input = input("temperature_k", "T", "K", Positive, "temperature");
const PLANCK: &str = "Planck's law with the exact constants of the SI";

/// A spectral quantity; what is too small for a number is said, not printed as a zero.
fn spectral(g: &Given, of: fn(f64, f64) -> f64) -> Result<f64, String> {
    let (nm, kelvin) = (g.number("wavelength_nm"), g.number("temperature_k"));
    let value = of(nm, kelvin);
    if value > 0.0 {
        return Ok(value);
    }
    let ln = black_body::ln_spectral_radiance(nm, kelvin);
    Err(format!("the result is too small for a number: the natural logarithm of the spectral radiance in W/(m² sr nm) is {ln:.6e}"))
}

pub(super) const EQUATIONS: &[Equation] = &[
    Equation {
        name: "planck",
        group: Group::BlackBodies,
        formula: "L_λ = (2hc²/λ⁵) / (exp(hc/(λkT)) − 1)",
        about: "spectral radiance of a black body",
        inputs: &[WAVELENGTH, TEMPERATURE],
        outcome: outcome("spectral radiance", "L_λ", "W/(m² sr nm)"),
        source: PLANCK,
        example: &[("wavelength_nm", "555"), ("temperature_k", "5772")],
        compute: |g| spectral(g, black_body::spectral_radiance),
        also: &[],
    },
    Equation {
        name: "planck-exitance",
        group: Group::BlackBodies,
        formula: "M_λ = π L_λ",
        about: "spectral exitance of a black body",
        inputs: &[WAVELENGTH, TEMPERATURE],
        outcome: outcome("spectral exitance", "M_λ", "W/(m² nm)"),
        source: PLANCK,
        example: &[("wavelength_nm", "10000"), ("temperature_k", "300")],
        compute: |g| spectral(g, black_body::spectral_exitance),
        also: &[],
    },
    Equation {
        name: "stefan-boltzmann",
        group: Group::BlackBodies,
        formula: "M = σ T⁴",
        about: "exitance of a black body over all wavelengths",
        inputs: &[TEMPERATURE],
        outcome: cell::<RadiantExitance>(),
        source: "σ = 2π⁵k⁴/(15h³c²)",
        example: &[("temperature_k", "300")],
        compute: |g| Ok(black_body::exitance_w_m2(g.number("temperature_k"))),
        also: &[],
    },
    Equation {
        name: "black-body-radiance",
        group: Group::BlackBodies,
        formula: "L = σ T⁴ / π",
        about: "radiance of a black body over all wavelengths",
        inputs: &[TEMPERATURE],
        outcome: cell::<Radiance>(),
        source: "σ = 2π⁵k⁴/(15h³c²)",
        example: &[("temperature_k", "2856")],
        compute: |g| Ok(black_body::radiance_w_m2_sr(g.number("temperature_k"))),
        also: &[],
    },
    Equation {
        name: "wien",
        group: Group::BlackBodies,
        formula: "λ_max = h c / (4.965114 k T)",
        about: "wavelength of the largest spectral radiance per nm",
        inputs: &[TEMPERATURE],
        outcome: outcome("wavelength of the maximum", "λ_max", "nm"),
        source: "positive root of x = 5(1 − exp(−x))",
        example: &[("temperature_k", "5772")],
        compute: |g| Ok(black_body::peak_wavelength_nm(g.number("temperature_k"))),
        also: &[],
    },
    Equation {
        name: "black-body-luminance",
        group: Group::BlackBodies,
        formula: "L_v = K_m ∫ L_λ V dλ",
        about: "luminance of a black body",
        inputs: &[TEMPERATURE],
        outcome: cell::<Luminance>(),
        source: "Planck's law and CIE 1924 V(λ), K_m = 683.002 lm/W",
        example: &[("temperature_k", "2042")],
        compute: |g| {
            let body = Density::black_body(g.number("temperature_k")).map_err(|e| e.to_string())?;
            let luminance = efficiency::luminous(&body, Efficiency::Photopic1924);
            if luminance > 0.0 { Ok(luminance) } else { Err("the luminance is too small for a number".into()) }
        },
        also: &[],
    },
];
