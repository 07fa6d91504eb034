//! Reflected light by paths from the instrument, connected to a source at every reflection.
//!
//! ```text
//! S = ⟨ W Σ_k (Π_{j≤k} ρ_j(λ)) · E_k/π ⟩      W = R(ω₀) π sin²α
//! ```
//!
//! | factor | density | what is left |
//! |---|---|---|
//! | R cosθ at the sensor | cosθ/(π sin²α) within the acceptance | W = R π sin²α |
//! | w at a head that sees all round | 1/4π | W = 4π w |
//! | R cosθ at a spot in a plane of focus, at a distance ρ | even over its area | W = R π r² cos²θ/ρ² |
//! | (ρ/π) cosθ at a surface | cosθ/π | ρ |
//! | (ρ/π) at the end of a path | a connection to a light | ρ/π times its irradiance |
//! | survival | p, after the third reflection | 1/p |
//!
//! The paths carry the product of reflectances at every node of the spectral plan, so there is no colour noise and one run
//! serves every channel. Russian roulette starts after the third reflection, with the surface's largest reflectance: earlier it
//! throws away what the low-discrepancy points gain. There is no limit to the number of reflections.
//!
//! Sixteen paths run in lockstep; a lane whose path has ended takes the next one.

mod bright_spot;
mod kernel;
mod prepare;
mod start;

pub(super) use bright_spot::BrightSpot;
pub(super) use kernel::trace;
pub(super) use prepare::PathScene;
pub(super) use start::{FirstRay, Start};

/// Reflections after which a path may end by chance.
const ROULETTE_AFTER: u32 = 3;

/// Reflections without loss, one after the other, after which a path is taken to be endless.
const ENDLESS: u32 = 100_000;
