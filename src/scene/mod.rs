//! From files to a validated scene.

pub mod mesh_file;
