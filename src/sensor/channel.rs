//! What is read off a sensor: a spectral responsivity and the quantity that the indication stands for.
//!
//! ```text
//! indication = scale · ∫ s(λ) E(λ) dλ · {1 | A | 1/∫R cosθ dω}
//! ```
//!
//! | the channel reads | the weighted irradiance is | unit |
//! |---|---|---|
//! | irradiance, illuminance, photon irradiance, signal per area | taken as it is | W/m², lx, µmol/(m² s) |
//! | radiant flux, luminous flux, photocurrent | multiplied by the area of the aperture | W, lm, A |
//! | radiance, luminance | divided by the projected solid angle of the acceptance | W/(m² sr), cd/m² |

use crate::quantity::measurand::Measurand;
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
