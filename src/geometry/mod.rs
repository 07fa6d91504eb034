//! Shapes and rays.

pub mod bvh;
pub mod mesh;
