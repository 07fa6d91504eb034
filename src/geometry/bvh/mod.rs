//! The bounding volume hierarchy of triangle meshes.
