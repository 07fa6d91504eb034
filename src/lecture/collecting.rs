//! Collecting light: étendue, the measurement equation, light on a surface.

use super::equation::Domain::{AboveUpTo, Between, NotNegative, Positive};
use super::equation::{Equation, Group, Input, Outcome, cell, in_any_system, input, outcome};
use crate::math::angle::sin_cos_deg;
use crate::quantity::cell::Row;
use crate::quantity::measurand::Measurand;
use crate::quantity::table::{Illuminance, Luminance, LuminousFlux, LuminousIntensity, Radiance};
use crate::quantity::{Area, Distance, Etendue, ProjectedSolidAngle, SolidAngle};
use crate::sensor::{Acceptance, Aperture, Channel};
use crate::spectrum::Factor;

const AREA: Input = input("area_m2", "A", "m²", NotNegative, "area that receives");
const ANGLE: Input = input("angle_deg", "θ", "°", Between(0.0, 90.0), "angle of incidence, from the normal");
const HALF_ANGLE: Input = input("half_angle_deg", "α", "°", Between(0.0, 90.0), "half angle of the cone about the normal");
const DISTANCE: Input = input("distance_m", "r", "m", Positive, "distance from the source");
const RADIANCE: Input = in_any_system("radiance", "L", Row::Radiance, "radiance, uniform over the directions");
const ETENDUE: Outcome = outcome("étendue", "G", "m² sr");
const ISO: &str = "ISO 80000-7; CIE S 017 (ILV)";

fn etendue_of_cone(g: &super::Given) -> Etendue {
    Etendue::cone(Area::new(g.number("area_m2")), g.number("half_angle_deg").to_radians())
}

pub(super) const EQUATIONS: &[Equation] = &[
    Equation {
        name: "etendue",
        group: Group::Collecting,
        formula: "G = A cos θ Ω",
        about: "étendue of a small area and a small solid angle",
        inputs: &[AREA, ANGLE, input("solid_angle_sr", "Ω", "sr", NotNegative, "solid angle")],
        outcome: ETENDUE,
        source: ISO,
        example: &[("area_m2", "1e-4"), ("angle_deg", "60"), ("solid_angle_sr", "0.01")],
        compute: |g| {
            let cosine = sin_cos_deg(g.number("angle_deg")).1;
            Ok(Etendue::small(Area::new(g.number("area_m2")), cosine, SolidAngle::new(g.number("solid_angle_sr"))).value())
        },
        also: &[],
    },
    Equation {
        name: "etendue-of-a-cone",
        group: Group::Collecting,
        formula: "G = π A sin²α",
        about: "étendue of an area and a cone about its normal",
        inputs: &[AREA, HALF_ANGLE],
        outcome: ETENDUE,
        source: ISO,
        example: &[("area_m2", "1e-4"), ("half_angle_deg", "30")],
        compute: |g| Ok(etendue_of_cone(g).value()),
        also: &[],
    },
    Equation {
        name: "flux-through-etendue",
        group: Group::Collecting,
        formula: "Φ = L G",
        about: "flux of a uniform radiance through an étendue",
        inputs: &[RADIANCE, input("etendue_m2_sr", "G", "m² sr", NotNegative, "étendue")],
        outcome: Outcome::Of(Row::Flux),
        source: ISO,
        example: &[("radiance_w_m2_sr", "10"), ("etendue_m2_sr", "7.85e-5")],
        compute: |g| Ok((Luminance::new(g.number("radiance")) * Etendue::new(g.number("etendue_m2_sr"))).value()),
        also: &[],
    },
    Equation {
        name: "measurement-equation",
        group: Group::Collecting,
        formula: "S = s L A π sin²α",
        about: "photocurrent of a detector whose acceptance cone is filled with a uniform radiance: ∫λ ∫A ∫Ω s L cos θ dω dA dλ",
        inputs: &[
            input("responsivity_a_w", "s", "A/W", NotNegative, "responsivity at the wavelengths of the light"),
            input("radiance_w_m2_sr", "L", "W/(m² sr)", NotNegative, "radiance, uniform over aperture and cone"),
            input("radius_m", "R", "m", Positive, "radius of the aperture, A = π R²"),
            input("half_angle_deg", "α", "°", AboveUpTo(0.0, 90.0), "half angle of the acceptance"),
        ],
        outcome: outcome("photocurrent", "S", "A"),
        source: "the front page of this library; EMVA 1288 for the photocurrent",
        example: &[("responsivity_a_w", "0.5"), ("radiance_w_m2_sr", "10"), ("radius_m", "0.002"), ("half_angle_deg", "5")],
        compute: |g| {
            let acceptance = Acceptance::Cone { half_angle_rad: g.number("half_angle_deg").to_radians() };
            // Light of one responsivity: the relative curve is one, the scale carries the number.
            let scale = g.number("responsivity_a_w");
            let channel = Channel::new("S", Factor::ONE, Measurand::Photocurrent, scale);
            let aperture = Aperture::Disc { radius_m: g.number("radius_m") };
            let per_irradiance = channel.indication_per_irradiance(&aperture, &acceptance).ok_or("the aperture has no area")?;
            let collected = Radiance::new(g.number("radiance_w_m2_sr")) * ProjectedSolidAngle::new(acceptance.projected_solid_angle_sr());
            Ok(collected.value() * per_irradiance)
        },
        also: &[],
    },
    Equation {
        name: "inverse-square",
        group: Group::Collecting,
        formula: "E = I cos θ / r²",
        about: "small source that lights a surface",
        inputs: &[in_any_system("intensity", "I", Row::Intensity, "intensity towards the surface"), DISTANCE, ANGLE],
        outcome: Outcome::Of(Row::FluxDensityIn),
        source: ISO,
        example: &[("intensity_cd", "100"), ("distance_m", "2"), ("angle_deg", "60")],
        compute: |g| {
            let intensity = LuminousIntensity::new(g.number("intensity"));
            Ok(intensity.arriving_at(Distance::new(g.number("distance_m")), sin_cos_deg(g.number("angle_deg")).1).value())
        },
        also: &[],
    },
    Equation {
        name: "point-source",
        group: Group::Collecting,
        formula: "E = Φ cos θ / (4π r²)",
        about: "isotropic source of a flux that lights a surface",
        inputs: &[in_any_system("flux", "Φ", Row::Flux, "flux into all directions"), DISTANCE, ANGLE],
        outcome: Outcome::Of(Row::FluxDensityIn),
        source: ISO,
        example: &[("flux_lm", "1000"), ("distance_m", "2"), ("angle_deg", "0")],
        compute: |g| {
            let intensity = LuminousFlux::new(g.number("flux")).isotropic_intensity();
            Ok(intensity.arriving_at(Distance::new(g.number("distance_m")), sin_cos_deg(g.number("angle_deg")).1).value())
        },
        also: &[],
    },
    Equation {
        name: "uniform-cone",
        group: Group::Collecting,
        formula: "E = π L sin²α",
        about: "uniform radiance in a cone about the normal; a disc on the axis, sin²α = R²/(R² + d²)",
        inputs: &[RADIANCE, HALF_ANGLE],
        outcome: Outcome::Of(Row::FluxDensityIn),
        source: ISO,
        example: &[("radiance_cd_m2", "1000"), ("half_angle_deg", "30")],
        compute: |g| Ok((Luminance::new(g.number("radiance")) * ProjectedSolidAngle::cone(g.number("half_angle_deg").to_radians())).value()),
        also: &[],
    },
    Equation {
        name: "uniform-hemisphere",
        group: Group::Collecting,
        formula: "E = π L",
        about: "uniform radiance from the whole half space: an overcast sky over a plain",
        inputs: &[RADIANCE],
        outcome: Outcome::Of(Row::FluxDensityIn),
        source: ISO,
        example: &[("radiance_cd_m2", "1")],
        compute: |g| Ok(Luminance::new(g.number("radiance")).under_uniform_hemisphere().value()),
        also: &[],
    },
    Equation {
        name: "flux-on-an-area",
        group: Group::Collecting,
        formula: "Φ = E A",
        about: "flux that a uniformly lit area receives",
        inputs: &[in_any_system("flux_density", "E", Row::FluxDensityIn, "irradiance or illuminance"), AREA],
        outcome: Outcome::Of(Row::Flux),
        source: ISO,
        example: &[("flux_density_lx", "500"), ("area_m2", "12")],
        compute: |g| Ok((Illuminance::new(g.number("flux_density")) * Area::new(g.number("area_m2"))).value()),
        also: &[],
    },
    Equation {
        name: "illuminance-on-an-area",
        group: Group::Collecting,
        formula: "E_v = Φ_v / A",
        about: "mean illuminance of an area that receives a luminous flux",
        inputs: &[
            input("luminous_flux_lm", "Φ_v", "lm", NotNegative, "luminous flux on the area"),
            input("area_m2", "A", "m²", Positive, "area that receives"),
        ],
        outcome: cell::<Illuminance>(),
        source: ISO,
        example: &[("luminous_flux_lm", "6000"), ("area_m2", "12")],
        compute: |g| Ok(LuminousFlux::new(g.number("luminous_flux_lm")).arriving_on(Area::new(g.number("area_m2"))).value()),
        also: &[],
    },
];
