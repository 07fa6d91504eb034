//! Vectors, frames, samplers, random streams and quadrature: mathematics without units.
//!
//! | file | what |
//! |---|---|
//! | `angle.rs` | sine and cosine of degrees and of small arguments, without cancellation |
//! | `frame.rs` | orthonormal frames |
//! | `random.rs` | counter-based streams: Owen-scrambled Sobol points |
//! | `sample/` | samplers as triples: `sample_x`, `x_pdf`, `invert_x` |

pub mod angle;
pub mod frame;
pub mod random;
pub mod sample;

pub use glam::{DMat3, DVec2, DVec3, Vec3};
