//! What a surface does with the light that meets it.
//!
//! ```text
//! L_r(λ) = ρ(λ) E(λ) / π        a Lambertian reflector: the same radiance in every direction
//! ```
//!
//! | parameter | meaning | range |
//! |---|---|---|
//! | `reflectance` | ρ(λ), the share of the incident flux that is reflected | 0 to 1 |
//!
//! In a scene file: `surfaces: { "white paint": Lambertian(0.85), "oak": Lambertian("oak.csv"), "velvet": Black }`

use crate::spectrum::Factor;

/// A Lambertian surface; black when its reflectance is zero.
#[derive(Clone, Debug)]
pub struct Surface {
    /// The name in the scene file.
    pub name: String,
    /// Spectral reflectance ρ(λ), 0 to 1.
    pub reflectance: Factor,
}

impl Surface {
    /// A surface that absorbs everything.
    #[must_use]
    pub fn black() -> Surface {
        Surface { name: "black".into(), reflectance: Factor::Constant(0.0) }
    }

    /// Whether nothing is reflected at any wavelength.
    #[must_use]
    pub fn is_black(&self) -> bool {
        self.reflectance.max_over(0.0, f64::INFINITY) <= 0.0
    }
}
