//! Triangles from the bytes of a mesh file: Wavefront OBJ and Stanford PLY.
//!
//! A file is read completely and all its problems are reported together. Sizes that a file claims are compared with its length before memory is taken.

mod obj;
mod ply;
#[cfg(test)]
mod tests;

pub use obj::parse_obj;
pub use ply::parse_ply;

use crate::math::DVec3;
use std::fmt;

/// Vertices, polygons or other elements that a file may have of each kind.
pub const ELEMENT_LIMIT: usize = 50_000_000;
/// Problems that are described; further ones are only counted.
pub const PROBLEM_LIMIT: usize = 20;

/// What a mesh file describes. Polygons are cut into fans of triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshData {
    /// Vertices in the file's unit; all are finite.
    pub points: Vec<DVec3>,
    /// Indices into the points; all exist.
    pub triangles: Vec<[u32; 3]>,
}

/// One problem of a mesh file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeshProblem {
    /// Line, counted from 1. In the binary part of a file: the line of the header's end.
    pub line: usize,
    /// Column in bytes, counted from 1.
    pub column: usize,
    /// In the binary part of a file: where, in bytes from the file's beginning.
    pub byte_offset: Option<usize>,
    /// What is wrong.
    pub message: String,
    /// What is allowed, or what to do.
    pub help: String,
}

impl fmt::Display for MeshProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.byte_offset {
            Some(byte) => write!(f, "byte {byte}: {} ({})", self.message, self.help),
            None => write!(f, "{}:{}: {} ({})", self.line, self.column, self.message, self.help),
        }
    }
}

/// All problems of a mesh file, in the order in which they were found.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MeshProblems {
    /// The first ones, at most [`PROBLEM_LIMIT`].
    pub problems: Vec<MeshProblem>,
    /// How many more there are.
    pub more: usize,
}

impl MeshProblems {
    fn push(&mut self, at: Place, message: impl FnOnce() -> String, help: &str) {
        if self.problems.len() < PROBLEM_LIMIT {
            let Place { line, column, byte_offset } = at;
            self.problems.push(MeshProblem { line, column, byte_offset, message: message(), help: help.to_owned() });
        } else {
            self.more += 1;
        }
    }

    fn is_empty(&self) -> bool {
        self.problems.is_empty()
    }
}

impl fmt::Display for MeshProblems {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for problem in &self.problems {
            writeln!(f, "{problem}")?;
        }
        if self.more > 0 {
            writeln!(f, "and {} more", self.more)?;
        }
        Ok(())
    }
}

impl std::error::Error for MeshProblems {}

#[derive(Clone, Copy, Debug)]
struct Place {
    line: usize,
    column: usize,
    byte_offset: Option<usize>,
}

impl Place {
    fn text(line: usize, column: usize) -> Place {
        Place { line, column, byte_offset: None }
    }
}

/// The words of a line with the column of each, counted from 1.
fn words(line: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    let mut at = 0;
    std::iter::from_fn(move || {
        at += line[at..].iter().position(|c| !c.is_ascii_whitespace())?;
        let start = at;
        at += line[start..].iter().position(u8::is_ascii_whitespace).unwrap_or(line.len() - start);
        Some((start + 1, &line[start..at]))
    })
}

fn number(word: &[u8]) -> Option<f64> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// A word for a message: readable whatever its bytes, and not long.
fn quoted(word: &[u8]) -> String {
    let text: String = String::from_utf8_lossy(word).chars().take(40).collect();
    format!("{text:?}")
}

/// Appends the fan of triangles of a polygon with at least three corners.
fn push_fan(polygon: &[u32], triangles: &mut Vec<[u32; 3]>) {
    for pair in polygon.get(1..).unwrap_or_default().windows(2) {
        triangles.push([polygon[0], pair[0], pair[1]]);
    }
}
