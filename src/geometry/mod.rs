//! Shapes and rays.

pub mod bvh;
