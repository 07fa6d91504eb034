//! Vectors, frames, samplers, random streams and quadrature: mathematics without units.

pub use glam::{DMat3, DVec2, DVec3, Vec3};
