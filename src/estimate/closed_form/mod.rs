//! Closed forms: uniform sources of simple shape, seen without obstruction.
//!
//! Every function answers with a purely geometric quantity; radiance and intensity are applied by the caller:
//!
//! ```text
//! G = ∫ max(0, ω·n) dΩ   projected solid angle of a source, sr        E = L · G
//! Ω                      solid angle of an aperture, sr               Φ = I · Ω
//! ∬ G dA                 etendue of a pair of surfaces, m² sr         Φ = L · etendue
//! ```
//!
//! * The receiver is the origin; every position is *relative to the receiver*, subtracted by the caller. Its normal `n`
//!   need not have unit length.
//! * Results are never negative and never NaN. What has no size, no direction or a coordinate that is not finite
//!   contributes 0; each function names the limits it takes.
//! * Coordinates are first scaled by a power of two, so nothing depends on the unit of length.
//! * Forms with a textbook cancellation are replaced by equivalent forms without it. Where a sum of edge terms would cancel, the
//!   same integral is taken in azimuthal strips whose contributions are all positive (`fan.rs`).

pub mod across_axis;
pub mod aperture;
pub mod cone;
pub mod directional;
pub mod disc;
pub mod exchange;
mod fan;
mod frame;
pub mod head;
pub mod point;
pub mod polygon;
pub mod polygon_in_cone;
mod quadrature;
mod sign_change;
pub mod sphere;

#[cfg(test)]
mod tests;
