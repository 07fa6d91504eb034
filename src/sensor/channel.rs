//! What is read off a sensor: a spectral responsivity and the quantity that the indication stands for.
//!
//! ```text
//! indication = scale · θ · ∫ s(λ) E(λ) dλ · {1 | A | 1/∫R cosθ dω},   θ = 1 + c (T − T₀)
//! ```
//!
//! | the channel reads | the weighted irradiance is | unit |
//! |---|---|---|
//! | irradiance, illuminance, photon irradiance, signal | taken as it is | W/m², lx, 1/(m² s), … |
//! | radiant flux, luminous flux, photon flux, photocurrent | multiplied by the area of the aperture | W, lm, 1/s, A |
//! | radiance, luminance, photon radiance | divided by the projected solid angle of the acceptance | W/(m² sr), cd/m², … |
//!
//! | symbol | field | meaning |
//! |---|---|---|
//! | s | `responsivity`, `kind` | spectral responsivity, relative or in A/W |
//! | u(s) | `responsivity_uncertainty` | its standard uncertainty, one cause for all wavelengths |
//! | c, T, T₀ | `temperature` | temperature coefficient, temperature of use, temperature of adjustment |
//!
//! ```
//! use etendue::{quantity::Measurand, sensor::{Acceptance, Aperture, Channel}, spectrum::Factor};
//!
//! let channel = Channel::new("S", Factor::Constant(0.5), Measurand::Photocurrent, 1.0);
//! let area = Aperture::Rectangle { half_width_m: 0.01, half_height_m: 0.01 };
//! assert_eq!(channel.indication_per_irradiance(&area, &Acceptance::Cosine), Some(4e-4));
//! assert_eq!(channel.indication_per_irradiance(&Aperture::Point, &Acceptance::Cosine), None);
//! ```

use super::{Acceptance, Aperture};
use crate::quantity::Measurand;
use crate::quantity::constants::ELEMENTARY_CHARGE_C;
use crate::spectrum::Factor;
use crate::spectrum::photometry::{WavelengthsIn, photons_per_joule};

/// How a responsivity is stated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ResponsivityKind {
    /// Without a unit: only its shape counts, or its unit is part of the scale.
    #[default]
    Relative,
    /// In A/W.
    AmperesPerWatt,
    /// Electrons per photon; [`Channel::responsivity`] is `η e n λ/(hc)`, in A/W.
    QuantumEfficiency,
}

impl ResponsivityKind {
    /// Whether the responsivity is in A/W, so that there is a photocurrent.
    #[must_use]
    pub fn is_absolute(self) -> bool {
        self != ResponsivityKind::Relative
    }

    /// In words, for reports.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            ResponsivityKind::Relative => "relative responsivity",
            ResponsivityKind::AmperesPerWatt => "responsivity in A/W",
            ResponsivityKind::QuantumEfficiency => "responsivity in A/W from a quantum efficiency, s = η e n λ/(h c)",
        }
    }
}

/// A/W of a quantum efficiency of one: `e n λ/(hc)`, n λ being the wavelength in vacuum.
#[must_use]
pub fn quantum_limit_a_w() -> Factor {
    photons_per_joule(WavelengthsIn::StandardAir).scaled(ELEMENTARY_CHARGE_C)
}

/// Standard uncertainty of a responsivity. Its cause is taken to be the same at all wavelengths, so that the contributions add up.
#[derive(Clone, Debug, PartialEq)]
pub enum ResponsivityUncertainty {
    /// The same share of the responsivity at every wavelength, zero or more.
    Relative(f64),
    /// u(s) over wavelength, in the unit of the responsivity.
    Curve(Factor),
}

/// How an indication follows the temperature: a factor `1 + c (T − T₀)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TemperatureCoefficient {
    /// c, relative change of the indication per kelvin, 1/K.
    pub per_k: f64,
    /// T₀, temperature at which the instrument was adjusted, °C.
    pub adjusted_at_c: f64,
    /// T, temperature at which it is used, °C.
    pub used_at_c: f64,
}

impl TemperatureCoefficient {
    /// What the indication is multiplied by.
    #[must_use]
    pub fn factor(&self) -> f64 {
        1.0 + self.per_k * (self.used_at_c - self.adjusted_at_c)
    }
}

/// What a channel is meant to weigh light with: the definition of its measurand.
#[derive(Clone, Debug, PartialEq)]
pub struct Weighting {
    /// The weighting function, such as V(λ).
    pub curve: Factor,
    /// What an ideal instrument indicates per unit of `∫ curve E dλ`, such as K_m.
    pub scale: f64,
}

/// One channel of a sensor.
#[derive(Clone, Debug)]
pub struct Channel {
    /// The name in the sensor file, unique in the sensor.
    pub name: String,
    /// Spectral responsivity s(λ), relative or absolute (A/W for a photocurrent).
    pub responsivity: Factor,
    /// How the responsivity is stated.
    pub kind: ResponsivityKind,
    /// Its standard uncertainties, one for each independent cause that is stated.
    pub responsivity_uncertainty: Vec<ResponsivityUncertainty>,
    /// How the indication follows the temperature, if it does.
    pub temperature: Option<TemperatureCoefficient>,
    /// What an ideal channel weighs light with, if there is one.
    pub ideal: Option<Weighting>,
    /// What the indication stands for.
    pub reads: Measurand,
    /// Indication per unit of `∫ s(λ) E(λ) dλ`: 1, K_m, or what the adjustment gave.
    pub scale: f64,
}

impl Channel {
    /// A channel of a relative responsivity without an uncertainty.
    #[must_use]
    pub fn new(name: impl Into<String>, responsivity: Factor, reads: Measurand, scale: f64) -> Channel {
        Channel {
            name: name.into(),
            responsivity,
            kind: ResponsivityKind::Relative,
            responsivity_uncertainty: Vec::new(),
            temperature: None,
            ideal: None,
            reads,
            scale,
        }
    }

    /// The same with what an ideal channel weighs light with.
    #[must_use]
    pub fn with_ideal(self, ideal: Weighting) -> Channel {
        Channel { ideal: Some(ideal), ..self }
    }

    /// Indication per unit of the weighted irradiance that the aperture receives on average.
    ///
    /// `None` where the measurand needs an aperture with an area and this one is a point.
    #[must_use]
    pub fn indication_per_irradiance(&self, aperture: &Aperture, acceptance: &Acceptance) -> Option<f64> {
        let scale = self.temperature.map_or(self.scale, |temperature| self.scale * temperature.factor());
        Some(match self.reads {
            Measurand::RadiantFlux | Measurand::LuminousFlux | Measurand::PhotonFlux | Measurand::Photocurrent => {
                scale * aperture.area_m2()?
            }
            Measurand::Radiance | Measurand::Luminance | Measurand::PhotonRadiance => scale / acceptance.projected_solid_angle_sr(),
            _ => scale,
        })
    }
}
