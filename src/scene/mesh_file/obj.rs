//! Wavefront OBJ: `v x y z` is a vertex, `f a b c ...` a polygon of vertices counted from 1, or backwards from -1.
//!
//! | statement | what happens |
//! |---|---|
//! | `v` | three coordinates; weight and colours behind them are passed over |
//! | `f` | corners `v`, `v/vt`, `v//vn`, `v/vt/vn`; only `v` matters |
//! | `vt vn vp g o s mg usemtl mtllib l p` and display attributes | passed over: they have no area |
//! | free-form curves and surfaces (`surf`, `cstype`, ...) | a problem, because surface would be missing |
//!
//! Source: Wavefront Technologies, "Advanced Visualizer Manual", appendix B.

use super::{ELEMENT_LIMIT, MeshData, MeshProblems, Place, number, push_fan, quoted, words};
use crate::math::DVec3;

/// Statements without area.
const PASSED_OVER: [&[u8]; 20] = [
    b"vt",
    b"vn",
    b"vp",
    b"g",
    b"o",
    b"s",
    b"mg",
    b"usemtl",
    b"mtllib",
    b"l",
    b"p",
    b"usemap",
    b"maplib",
    b"lod",
    b"bevel",
    b"c_interp",
    b"d_interp",
    b"shadow_obj",
    b"trace_obj",
    b"call",
];
/// Statements of free-form geometry.
const FREE_FORM: [&[u8]; 12] =
    [b"cstype", b"deg", b"bmat", b"step", b"curv", b"curv2", b"surf", b"parm", b"trim", b"hole", b"scrv", b"con"];

/// A word with its line and column.
type Word<'a> = (usize, usize, &'a [u8]);

/// Reads a Wavefront OBJ file.
///
/// # Errors
/// Every problem of the file.
pub fn parse_obj(bytes: &[u8]) -> Result<MeshData, MeshProblems> {
    let mut reader = Reader::default();
    let mut statement: Vec<Word> = Vec::new();
    for (index, line) in bytes.split(|&c| c == b'\n').enumerate() {
        let text = line.split(|&c| c == b'#').next().unwrap_or_default().trim_ascii_end();
        // A backslash at the end of a line continues the statement.
        let (text, continued) = text.strip_suffix(b"\\").map_or((text, false), |text| (text, true));
        statement.extend(words(text).map(|(column, word)| (index + 1, column, word)));
        if !continued {
            reader.statement(&statement);
            statement.clear();
        }
    }
    reader.statement(&statement);
    reader.finish()
}

#[derive(Default)]
struct Reader {
    mesh: MeshData,
    problems: MeshProblems,
    polygon: Vec<u32>,
    /// Corners that name a vertex further down: line, column, index.
    forward: Vec<(usize, usize, u32)>,
}

impl Reader {
    fn statement(&mut self, statement: &[Word]) {
        let Some((&(line, column, keyword), arguments)) = statement.split_first() else {
            return;
        };
        let at = Place::text(line, column);
        match keyword {
            b"v" => self.vertex(at, arguments),
            b"f" | b"fo" => self.face(at, arguments),
            _ if PASSED_OVER.contains(&keyword) => {}
            _ if FREE_FORM.contains(&keyword) => {
                self.problems.push(
                    at,
                    || format!("{} describes a free-form curve or surface", quoted(keyword)),
                    "export the surface as polygons",
                );
            }
            b"end" | b"sp" | b"ctech" | b"stech" => {}
            _ => self.problems.push(
                at,
                || format!("unknown statement {}", quoted(keyword)),
                "statements of an OBJ file begin with v, f, vt, vn, g, o, s, usemtl, mtllib, ...",
            ),
        }
    }

    fn vertex(&mut self, at: Place, arguments: &[Word]) {
        if self.mesh.points.len() == ELEMENT_LIMIT {
            self.problems.push(at, || format!("more than {ELEMENT_LIMIT} vertices"), "divide the mesh");
            return;
        }
        if arguments.len() < 3 {
            self.problems.push(at, || format!("a vertex with {} coordinates", arguments.len()), "a vertex is v x y z");
        }
        let mut point = [0.0; 3];
        for (coordinate, &(line, column, word)) in point.iter_mut().zip(arguments) {
            match number(word) {
                Some(value) if value.is_finite() => *coordinate = value,
                _ => self.problems.push(
                    Place::text(line, column),
                    || format!("{} is not a finite number", quoted(word)),
                    "a coordinate is a decimal number such as -1.5e-3",
                ),
            }
        }
        // Also after a problem, so that the indices behind it stay right.
        self.mesh.points.push(DVec3::from_array(point));
    }

    fn face(&mut self, at: Place, arguments: &[Word]) {
        if arguments.len() < 3 {
            self.problems.push(at, || format!("a face with {} corners", arguments.len()), "a face has at least three corners: f a b c");
            return;
        }
        let mut polygon = std::mem::take(&mut self.polygon);
        polygon.clear();
        for &(line, column, word) in arguments {
            match self.corner(line, column, word) {
                Ok(index) => polygon.push(index),
                Err((message, help)) => self.problems.push(Place::text(line, column), || message, help),
            }
        }
        if polygon.len() == arguments.len() && self.problems.is_empty() {
            if self.mesh.triangles.len() + polygon.len() - 2 > ELEMENT_LIMIT {
                self.problems.push(at, || format!("more than {ELEMENT_LIMIT} triangles"), "divide the mesh");
            } else {
                push_fan(&polygon, &mut self.mesh.triangles);
            }
        }
        self.polygon = polygon;
    }

    fn corner(&mut self, line: usize, column: usize, word: &[u8]) -> Result<u32, (String, &'static str)> {
        const FORM: &str = "a corner is v, v/vt, v//vn or v/vt/vn with whole numbers counted from 1, or from -1 backwards";
        let mut parts = word.split(|&c| c == b'/');
        let index = parts.next().and_then(integer).filter(|&index| index != 0);
        let rest_is_right = parts.by_ref().take(2).all(|part| part.is_empty() || integer(part).is_some()) && parts.next().is_none();
        let (Some(index), true) = (index, rest_is_right) else {
            return Err((format!("{} is not a corner", quoted(word)), FORM));
        };
        let known = self.mesh.points.len() as i64;
        let zero_based = if index < 0 { known + index } else { index - 1 };
        match u32::try_from(zero_based) {
            Err(_) if index < 0 => Err((
                format!("vertex {index}, but only {known} vertices are above"),
                "a negative number counts backwards from the last vertex above",
            )),
            Err(_) => Err((format!("vertex {index} does not exist"), FORM)),
            Ok(zero_based) => {
                if i64::from(zero_based) >= known {
                    self.forward.push((line, column, zero_based));
                }
                Ok(zero_based)
            }
        }
    }

    fn finish(mut self) -> Result<MeshData, MeshProblems> {
        let count = self.mesh.points.len();
        for (line, column, index) in self.forward {
            if index as usize >= count {
                self.problems.push(
                    Place::text(line, column),
                    || format!("vertex {} does not exist", u64::from(index) + 1),
                    &format!("the file has {count} vertices"),
                );
            }
        }
        if self.problems.is_empty() && self.mesh.triangles.is_empty() {
            self.problems.push(
                Place::text(1, 1),
                || "the file has no faces".to_owned(),
                "a face is f a b c; lines and points have no area",
            );
        }
        if self.problems.is_empty() { Ok(self.mesh) } else { Err(self.problems) }
    }
}

fn integer(word: &[u8]) -> Option<i64> {
    std::str::from_utf8(word).ok()?.parse().ok()
}
