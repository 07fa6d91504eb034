//! Samplers, each as three neighbours: `sample_x` maps numbers in (0, 1) to points, `x_pdf` is their density, `invert_x` maps back.
//!
//! | file | density over |
//! |---|---|
//! | `disc.rs` | the unit disc: 1/π |
//! | `hemisphere.rs` | directions above a horizon: cosθ/π; within a cone: cosθ/(π sin²α) |
//! | `cone.rs` | directions within a cone: 1/Ω |
//! | `triangle.rs` | barycentric coordinates: 2 (per unit area of the parameter triangle) |

mod cone;
mod disc;
mod hemisphere;
mod triangle;

pub use cone::{cone_pdf, invert_cone, sample_cone};
pub use disc::{disc_pdf, invert_disc, sample_disc};
pub use hemisphere::{cosine_cone_pdf, invert_cosine_cone, sample_cosine_cone, sample_cosine_hemisphere};
pub use triangle::{invert_triangle, sample_triangle, triangle_pdf};

#[cfg(test)]
mod tests;
