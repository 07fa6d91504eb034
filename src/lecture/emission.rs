//! What lamps emit.

use super::equation::Domain::{Above, Between, NotNegative, Positive};
use super::equation::{Equation, Group, Input, Outcome, cell, in_any_system, input, outcome};
use crate::quantity::cell::Row;
use crate::quantity::emission::electrical_power_w;
use crate::quantity::table::{Luminance, LuminousExitance, LuminousFlux, LuminousIntensity, RadiantFlux};
use crate::quantity::{Area, SolidAngle};

const EFFICIENCY: Input = input("efficiency", "ε", "1", Between(0.0, 1.0), "radiant flux per electrical power");
const VOLTAGE: Input = input("voltage_v", "V", "V", NotNegative, "voltage");
const CURRENT: Input = input("current_a", "C", "A", NotNegative, "current");
const AREA: Input = input("area_m2", "A", "m²", Positive, "area that emits, to one side");
const FLUX: Input = in_any_system("flux", "Φ", Row::Flux, "flux");
const RADIANCE: Input = in_any_system("radiance", "L", Row::Radiance, "radiance, the same in every direction");
const ON_AXIS: Input = in_any_system("intensity", "I₀", Row::Intensity, "intensity on the axis");
const EXPONENT: Input = input("exponent", "n", "1", Above(-1.0), "power of the cosine; 1 for a Lambertian element");
const ILV: &str = "CIE S 017 (ILV); ISO 80000-7";

pub(super) const EQUATIONS: &[Equation] = &[
    Equation {
        name: "electrical-power",
        group: Group::Emission,
        formula: "P = V C",
        about: "electrical power of a lamp",
        inputs: &[VOLTAGE, CURRENT],
        outcome: outcome("electrical power", "P", "W"),
        source: "ISO 80000-6",
        example: &[("voltage_v", "12"), ("current_a", "0.35")],
        compute: |g| Ok(electrical_power_w(g.number("voltage_v"), g.number("current_a"))),
        also: &[],
    },
    Equation {
        name: "flux-from-power",
        group: Group::Emission,
        formula: "Φ = ε P",
        about: "radiant flux of a lamp of a power and an efficiency",
        inputs: &[EFFICIENCY, input("power_w", "P", "W", NotNegative, "electrical power")],
        outcome: cell::<RadiantFlux>(),
        source: ILV,
        example: &[("efficiency", "0.4"), ("power_w", "60")],
        compute: |g| Ok(RadiantFlux::from_electrical_power(g.number("efficiency"), g.number("power_w")).value()),
        also: &[],
    },
    Equation {
        name: "flux-from-current",
        group: Group::Emission,
        formula: "Φ = ε V C",
        about: "radiant flux of a lamp that is run at a voltage and a current",
        inputs: &[EFFICIENCY, VOLTAGE, CURRENT],
        outcome: cell::<RadiantFlux>(),
        source: ILV,
        example: &[("efficiency", "0.4"), ("voltage_v", "12"), ("current_a", "0.35")],
        compute: |g| {
            let [efficiency, volts, amperes] = ["efficiency", "voltage_v", "current_a"].map(|key| g.number(key));
            Ok(RadiantFlux::from_voltage_and_current(efficiency, volts, amperes).value())
        },
        also: &[],
    },
    Equation {
        name: "homogeneous-emitter",
        group: Group::Emission,
        formula: "I = Φ / Ω",
        about: "intensity of an emitter that sends its flux evenly into a solid angle",
        inputs: &[FLUX, input("solid_angle_sr", "Ω", "sr", Positive, "solid angle into which it emits")],
        outcome: Outcome::Of(Row::Intensity),
        source: ILV,
        example: &[("flux_lm", "100"), ("solid_angle_sr", "0.5")],
        compute: |g| Ok((LuminousFlux::new(g.number("flux")) / SolidAngle::new(g.number("solid_angle_sr"))).value()),
        also: &[],
    },
    Equation {
        name: "isotropic-emitter",
        group: Group::Emission,
        formula: "I = Φ / 4π",
        about: "intensity of an emitter that is the same in all directions",
        inputs: &[FLUX],
        outcome: Outcome::Of(Row::Intensity),
        source: ILV,
        example: &[("flux_lm", "1256.6370614359173")],
        compute: |g| Ok(LuminousFlux::new(g.number("flux")).isotropic_intensity().value()),
        also: &[],
    },
    Equation {
        name: "exitance",
        group: Group::Emission,
        formula: "M = Φ / A",
        about: "flux that leaves an area, per area",
        inputs: &[FLUX, AREA],
        outcome: Outcome::Of(Row::FluxDensityOut),
        source: ILV,
        example: &[("flux_w", "5"), ("area_m2", "0.25")],
        compute: |g| Ok(LuminousFlux::new(g.number("flux")).leaving(Area::new(g.number("area_m2"))).value()),
        also: &[],
    },
    Equation {
        name: "diffuse-exitance",
        group: Group::Emission,
        formula: "B = π L",
        about: "exitance (the lecture's B) of a diffuse, that is Lambertian, surface",
        inputs: &[RADIANCE],
        outcome: Outcome::Of(Row::FluxDensityOut),
        source: ILV,
        example: &[("radiance_cd_m2", "250")],
        compute: |g| Ok(Luminance::new(g.number("radiance")).lambertian_exitance().value()),
        also: &[],
    },
    Equation {
        name: "diffuse-radiance",
        group: Group::Emission,
        formula: "L = M / π",
        about: "radiance of a diffuse surface of an exitance",
        inputs: &[in_any_system("exitance", "M", Row::FluxDensityOut, "flux that leaves, per area")],
        outcome: Outcome::Of(Row::Radiance),
        source: ILV,
        example: &[("exitance_lm_m2", "1000")],
        compute: |g| Ok(LuminousExitance::new(g.number("exitance")).lambertian_radiance().value()),
        also: &[],
    },
    Equation {
        name: "diffuse-emitter",
        group: Group::Emission,
        formula: "Φ = π L A",
        about: "flux of a diffuse emitter, to one side",
        inputs: &[RADIANCE, AREA],
        outcome: Outcome::Of(Row::Flux),
        source: ILV,
        example: &[("radiance_cd_m2", "1000"), ("area_m2", "0.36")],
        compute: |g| Ok(Luminance::new(g.number("radiance")).lambertian_flux(Area::new(g.number("area_m2"))).value()),
        also: &[],
    },
    Equation {
        name: "cosine-power-intensity",
        group: Group::Emission,
        formula: "I = I₀ cosⁿ θ",
        about: "intensity beside the axis of an emitter that is brightest along it",
        inputs: &[ON_AXIS, input("angle_deg", "θ", "°", Between(0.0, 90.0), "angle from the axis"), EXPONENT],
        outcome: Outcome::Of(Row::Intensity),
        source: ILV,
        example: &[("intensity_cd", "100"), ("angle_deg", "60"), ("exponent", "1")],
        compute: |g| {
            let angle_rad = g.number("angle_deg").to_radians();
            Ok(LuminousIntensity::new(g.number("intensity")).at_angle(angle_rad, g.number("exponent")).value())
        },
        also: &[],
    },
    Equation {
        name: "cosine-power-emitter",
        group: Group::Emission,
        formula: "Φ = 2π I₀ / (n + 1)",
        about: "flux of an emitter whose intensity falls as a power of the cosine",
        inputs: &[ON_AXIS, EXPONENT],
        outcome: Outcome::Of(Row::Flux),
        source: "integral of I₀ cosⁿ θ over the half space",
        example: &[("intensity_cd", "1"), ("exponent", "80")],
        compute: |g| Ok(LuminousIntensity::new(g.number("intensity")).cosine_power_flux(g.number("exponent")).value()),
        also: &[],
    },
];
