//! `Mesh("file.obj")` → triangles in the world: points × scale, turned, moved.
//!
//! The formats are Wavefront OBJ and Stanford PLY. Triangles without an area are left out: no light meets them.

use std::sync::Arc;

use super::decode::{LARGEST_M, SMALLEST_M, Value};
use super::diagnostic::{Diagnostic, lines_of};
use super::files::LONGEST_MESH_BYTES;
use super::mesh_file::{MeshData, MeshProblems, parse_obj, parse_ply};
use super::placement::Placement;
use super::reading::Reading;
use crate::geometry::mesh::{Mesh, MeshError};
use crate::math::DVec3;

/// Reads the mesh that a value names and places it. A mesh that is placed twice alike is built once.
pub(super) fn read_mesh(name: &Value, place: Placement, scale: f64, reading: &mut Reading) -> Option<Arc<Mesh>> {
    let file = name.text(&mut reading.problems)?;
    let path = reading.path(name, file)?;
    let lower = file.to_lowercase();
    let parse = if lower.ends_with(".obj") {
        parse_obj
    } else if lower.ends_with(".ply") {
        parse_ply
    } else {
        name.problem(
            &mut reading.problems,
            format!("`{file}` is not the name of a mesh file"),
            "meshes are read from files that end in .obj or .ply",
        );
        return None;
    };
    let numbers = [place.at.x, place.at.y, place.at.z, place.x.x, place.x.y, place.x.z, place.y.x, place.y.y, place.y.z, scale];
    let key = (path.clone(), numbers.map(f64::to_bits));
    if let Some(known) = reading.meshes.get(&key) {
        return known.clone();
    }
    let mesh = reading.bytes(name, &path, "mesh file", LONGEST_MESH_BYTES).and_then(|bytes| match parse(&bytes) {
        Ok(data) => build(name, &path, data, place, scale, reading),
        Err(problems) => {
            tell(&path, &bytes, problems, reading);
            None
        }
    });
    let mesh = mesh.map(Arc::new);
    reading.meshes.insert(key, mesh.clone());
    mesh
}

fn build(name: &Value, path: &str, data: MeshData, place: Placement, scale: f64, reading: &mut Reading) -> Option<Mesh> {
    let points: Vec<DVec3> = data.points.iter().map(|&point| place.point(point * scale)).collect();
    let within = points.iter().all(|point| point.abs().max_element() <= LARGEST_M);
    if !within {
        let help = format!("allowed: coordinates up to {LARGEST_M:e} m; is the `scale` right?");
        name.problem(&mut reading.problems, format!("the mesh `{path}` reaches absurdly far"), help);
        return None;
    }
    match Mesh::new(&points, data.triangles) {
        Ok(mesh) => {
            let (low, high) = mesh.bounds();
            let extent_m = (high - low).max_element();
            if extent_m >= SMALLEST_M {
                return Some(mesh);
            }
            name.problem(
                &mut reading.problems,
                format!("the mesh `{path}` is {extent_m:.3e} m large"),
                format!("allowed: {SMALLEST_M:e} m and above; is the `scale` right?"),
            );
            None
        }
        Err(error) => {
            let help = match error {
                MeshError::NoTriangles => "a mesh needs at least one face",
                MeshError::AllDegenerate { .. } => "a triangle needs three corners that do not lie on one line",
                _ => "",
            };
            name.problem(&mut reading.problems, format!("the mesh `{path}` cannot be used: {error}"), help);
            None
        }
    }
}

/// Notes what is wrong with a mesh file. Problems of its binary part have a place in bytes and no line to show.
fn tell(path: &str, bytes: &[u8], problems: MeshProblems, reading: &mut Reading) {
    let lines = lines_of(bytes, problems.problems.iter().filter(|p| p.byte_offset.is_none()).map(|p| p.line));
    for problem in problems.problems {
        if let Some(offset) = problem.byte_offset {
            let help = Some(problem.help).filter(|help| !help.is_empty());
            reading.problems.add(Diagnostic::of_file(path, format!("{} (at byte {offset})", problem.message), help));
            continue;
        }
        let line = lines.get(&problem.line).map_or(&[][..], |line| line);
        let before = &line[..line.len().min(problem.column.saturating_sub(1))];
        let column = 1 + String::from_utf8_lossy(before).chars().count();
        let text = String::from_utf8_lossy(line);
        reading.problems.add(Diagnostic::of_column(path, problem.line, column, &text, problem.message, problem.help));
    }
    if problems.more > 0 {
        reading.problems.add(Diagnostic::of_file(path, format!("{} more problems in this file", problems.more), None));
    }
}
