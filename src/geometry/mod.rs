//! Shapes and rays.
//!
//! | file | what |
//! |---|---|
//! | `shape.rs` | rectangle, polygon, disc, sphere, mesh, placed in the world |
//! | `polygon/` | plane polygons with exact corners |
//! | `world.rs` | all shapes of a scene: which one does a ray meet first, is the way clear |
//! | `rays.rs` | blocks of rays that are traced in lockstep |
//! | `flats.rs`, `balls.rs`, `blocks.rs` | blocks of rays against plane shapes, spheres and boxes, in double precision |
//! | `mesh/` | triangle meshes |
//! | `bvh/` | the bounding volume hierarchy of a mesh |

pub mod balls;
pub mod blocks;
pub mod bvh;
pub mod flats;
pub mod mesh;
pub mod polygon;
pub mod rays;
pub mod shape;
pub mod world;
