//! What is read off a sensor: a spectral responsivity and the quantity that the indication stands for.
//!
//! ```text
//! indication = scale · ∫ s(λ) E(λ) dλ · {1 | A | 1/∫R cosθ dω}
//! ```
//!
//! | the channel reads | the weighted irradiance is | unit |
//! |---|---|---|
//! | irradiance, illuminance, photon irradiance, signal | taken as it is | W/m², lx, 1/(m² s), … |
//! | radiant flux, luminous flux, photon flux, photocurrent | multiplied by the area of the aperture | W, lm, 1/s, A |
//! | radiance, luminance, photon radiance | divided by the projected solid angle of the acceptance | W/(m² sr), cd/m², … |

use super::{Acceptance, Aperture};
use crate::quantity::Measurand;
use crate::spectrum::Factor;

/// One channel of a sensor.
#[derive(Clone, Debug)]
pub struct Channel {
    /// The name in the sensor file, unique in the sensor.
    pub name: String,
    /// Spectral responsivity s(λ), relative or absolute (A/W for a photocurrent).
    pub responsivity: Factor,
    /// What the indication stands for.
    pub reads: Measurand,
    /// Indication per unit of `∫ s(λ) E(λ) dλ`: 1, K_m, or what the adjustment gave.
    pub scale: f64,
}

impl Channel {
    /// Indication per unit of the weighted irradiance that the aperture receives on average.
    ///
    /// `None` where the measurand needs an aperture with an area and this one is a point.
    #[must_use]
    pub fn indication_per_irradiance(&self, aperture: &Aperture, acceptance: &Acceptance) -> Option<f64> {
        Some(match self.reads {
            Measurand::RadiantFlux | Measurand::LuminousFlux | Measurand::PhotonFlux | Measurand::Photocurrent => {
                self.scale * aperture.area_m2()?
            }
            Measurand::Radiance | Measurand::Luminance | Measurand::PhotonRadiance => self.scale / acceptance.projected_solid_angle_sr(),
            _ => self.scale,
        })
    }
}
