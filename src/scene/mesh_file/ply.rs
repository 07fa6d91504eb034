//! Stanford PLY: a header in text names elements and their properties; their values follow as text or as binary numbers.
//!
//! The element `vertex` needs `x`, `y`, `z` of any number type, the element `face` a list `vertex_indices` (or `vertex_index`) of any whole
//! number type. Other elements and properties are passed over.
//!
//! Source: Greg Turk, "The PLY Polygon File Format", 1994.

mod body;
mod header;

use super::{MeshData, MeshProblems};

/// Reads a PLY file in any of its three formats.
///
/// # Errors
/// Every problem of the file. In a binary part only the first one that makes the rest unreadable, and all those that do not.
pub fn parse_ply(bytes: &[u8]) -> Result<MeshData, MeshProblems> {
    let mut problems = MeshProblems::default();
    let mut mesh = MeshData::default();
    let header = header::read(bytes, &mut problems);
    if let (Some(header), true) = (&header, problems.is_empty()) {
        body::read(bytes, header, &mut mesh, &mut problems);
    }
    if problems.is_empty() { Ok(mesh) } else { Err(problems) }
}
