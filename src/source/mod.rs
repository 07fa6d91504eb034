//! What emits light.
//!
//! ```text
//! point        dE = I cosθ / r²            directional   dE = E₀ cosθ
//! Lambertian   dE = L cosθ dω              environment   dE = L cosθ dω, from wherever a ray meets nothing
//! ```
//!
//! | emitter | the source's `density` is a spectral | unit |
//! |---|---|---|
//! | `Point` | radiant intensity, the same in every direction | W sr⁻¹ nm⁻¹ |
//! | `Directional` | irradiance of a plane that faces the beam | W m⁻² nm⁻¹ |
//! | `Area` | radiance, the same everywhere and in every direction of the emitting side | W m⁻² sr⁻¹ nm⁻¹ |
//! | `Environment` | radiance, the same from every direction | W m⁻² sr⁻¹ nm⁻¹ |

use crate::geometry::shape::Side;
use crate::math::DVec3;
use crate::spectrum::Density;

/// Where and how a source emits.
#[derive(Clone, Debug, PartialEq)]
pub enum Emitter {
    /// A point that emits equally in all directions.
    Point {
        /// Position, m.
        at: DVec3,
    },
    /// Parallel light from infinitely far away.
    Directional {
        /// Unit vector along which the light travels.
        travels: DVec3,
    },
    /// Lambertian emission from one side of some elements of the scene.
    Area {
        /// Indices into `Scene::elements`, with the side that emits.
        elements: Vec<(usize, Side)>,
    },
    /// The same radiance from every direction in which nothing stands.
    Environment,
}

/// A source: where it emits, and how much at each wavelength.
#[derive(Clone, Debug)]
pub struct Source {
    /// The name in the scene file, unique among the sources.
    pub name: String,
    /// Where and how.
    pub emitter: Emitter,
    /// How much; its unit depends on the emitter, see the table above.
    pub density: Density,
}
