//! The values behind the header, element by element.

use super::super::{ELEMENT_LIMIT, MeshData, MeshProblems, Place, number, push_fan, quoted, words};
use super::header::{Element, Format, Header, Property, Type, is_corners};
use crate::math::DVec3;

/// Why a number could not be read.
struct Fault {
    message: String,
    help: &'static str,
}

/// Numbers one after another. All types fit into `f64` without loss.
enum Numbers<'a> {
    Text { rest: &'a [u8], line: usize, words: Vec<(usize, &'a [u8])>, next: usize },
    Binary { bytes: &'a [u8], at: usize, last: usize, big: bool, header_lines: usize },
}

impl<'a> Numbers<'a> {
    /// Begins the next item of an element: in a text, the next line that is not empty.
    fn begin(&mut self) {
        if let Numbers::Text { rest, line, words: found, next } = self {
            *next = 0;
            found.clear();
            while found.is_empty() && !rest.is_empty() {
                let length = rest.iter().position(|&c| c == b'\n').unwrap_or(rest.len());
                found.extend(words(&rest[..length]));
                *line += 1;
                *rest = rest.get(length + 1..).unwrap_or_default();
            }
        }
    }

    /// Ends the item: nothing may be left on its line.
    fn end(&self) -> Result<(), Fault> {
        match self {
            Numbers::Text { words, next, .. } if *next < words.len() => Err(Fault {
                message: format!("{} numbers too many", words.len() - next),
                help: "each line has the numbers that the header declares",
            }),
            _ => Ok(()),
        }
    }

    fn next(&mut self, kind: Type) -> Result<f64, Fault> {
        match self {
            Numbers::Text { words, next, .. } => {
                let Some((_, word)) = words.get(*next) else {
                    return Err(Fault {
                        message: "a number is missing".to_owned(),
                        help: "each line has the numbers that the header declares",
                    });
                };
                *next += 1;
                number(word).filter(|value| !kind.is_whole() || value.fract() == 0.0).ok_or_else(|| Fault {
                    message: format!("{} is not a number of its type", quoted(word)),
                    help: "the header declares the type",
                })
            }
            Numbers::Binary { bytes, at, last, big, .. } => {
                let size = kind.size();
                let Some(raw) = bytes.get(*at..*at + size) else {
                    return Err(Fault { message: "the file ends here".to_owned(), help: "the file is cut off, or a count is wrong" });
                };
                *last = *at;
                *at += size;
                Ok(binary(raw, kind, *big))
            }
        }
    }

    /// Bytes that are left, as a limit for lengths of lists.
    fn capacity(&self) -> usize {
        match self {
            Numbers::Text { words, next, .. } => words.len() - next,
            Numbers::Binary { bytes, at, .. } => bytes.len() - at,
        }
    }

    /// Where the last number was.
    fn place(&self) -> Place {
        match self {
            Numbers::Text { line, words, next, .. } => {
                Place::text(*line, words.get(next.saturating_sub(1)).map_or(1, |(column, _)| *column))
            }
            Numbers::Binary { last, header_lines, .. } => Place { line: *header_lines, column: 1, byte_offset: Some(*last) },
        }
    }
}

fn binary(raw: &[u8], kind: Type, big: bool) -> f64 {
    let mut bytes = [0; 8];
    // Little end first, whatever the file says.
    if big {
        raw.iter().rev().zip(&mut bytes).for_each(|(from, to)| *to = *from);
    } else {
        raw.iter().zip(&mut bytes).for_each(|(from, to)| *to = *from);
    }
    let word = u64::from_le_bytes(bytes);
    match kind {
        Type::I8 => f64::from(word as i8),
        Type::U8 => f64::from(word as u8),
        Type::I16 => f64::from(word as i16),
        Type::U16 => f64::from(word as u16),
        Type::I32 => f64::from(word as i32),
        Type::U32 => f64::from(word as u32),
        Type::F32 => f64::from(f32::from_bits(word as u32)),
        Type::F64 => f64::from_bits(word),
    }
}

/// What becomes of a property.
#[derive(Clone, Copy, PartialEq)]
enum Role {
    Coordinate(usize),
    Corners,
    PassedOver,
}

fn role(element: &Element, property: &Property) -> Role {
    match (element.name.as_slice(), property.name.as_slice(), property.list) {
        (b"vertex", b"x", None) => Role::Coordinate(0),
        (b"vertex", b"y", None) => Role::Coordinate(1),
        (b"vertex", b"z", None) => Role::Coordinate(2),
        (b"face", ..) if is_corners(property) => Role::Corners,
        _ => Role::PassedOver,
    }
}

/// Reads the body into the mesh. The header has been checked.
pub(super) fn read(bytes: &[u8], header: &Header, mesh: &mut MeshData, problems: &mut MeshProblems) {
    let mut numbers = match header.format {
        Format::Ascii => Numbers::Text { rest: &bytes[header.body..], line: header.lines, words: Vec::new(), next: 0 },
        format => Numbers::Binary { bytes, at: header.body, last: header.body, big: format == Format::Big, header_lines: header.lines },
    };
    let vertices = header.elements.iter().find(|element| element.name == b"vertex").map_or(0, |element| element.count);
    for element in header.elements.iter().filter(|element| !element.properties.is_empty()) {
        let roles: Vec<Role> = element.properties.iter().map(|property| role(element, property)).collect();
        match element.name.as_slice() {
            b"vertex" => mesh.points.reserve_exact(element.count),
            b"face" => mesh.triangles.reserve(element.count),
            _ => {}
        }
        let mut item = Item { point: [0.0; 3], corners: Vec::new(), vertices };
        for _ in 0..element.count {
            numbers.begin();
            let result = item.read(element, &roles, &mut numbers, problems).and_then(|()| numbers.end());
            if let Err(Fault { message, help }) = result {
                problems.push(numbers.place(), || message, help);
                // A text goes on at its next line; binary numbers have lost their place.
                if header.format != Format::Ascii {
                    return;
                }
            }
            match element.name.as_slice() {
                b"vertex" => mesh.points.push(DVec3::from_array(item.point)),
                b"face" if mesh.triangles.len() + item.corners.len() > ELEMENT_LIMIT => {
                    problems.push(numbers.place(), || format!("more than {ELEMENT_LIMIT} triangles"), "divide the mesh");
                    return;
                }
                b"face" if problems.is_empty() => push_fan(&item.corners, &mut mesh.triangles),
                _ => {}
            }
        }
    }
    if problems.is_empty() && mesh.triangles.is_empty() {
        problems.push(Place::text(header.lines, 1), || "the file has no faces".to_owned(), "the element face has a count above 0");
    }
}

struct Item {
    point: [f64; 3],
    corners: Vec<u32>,
    vertices: usize,
}

impl Item {
    fn read(&mut self, element: &Element, roles: &[Role], numbers: &mut Numbers, problems: &mut MeshProblems) -> Result<(), Fault> {
        self.corners.clear();
        for (property, role) in element.properties.iter().zip(roles) {
            let Some(length) = property.list else {
                let value = numbers.next(property.item)?;
                if let Role::Coordinate(axis) = role {
                    self.point[*axis] = value;
                    if !value.is_finite() {
                        problems.push(numbers.place(), || "a coordinate is not finite".to_owned(), "coordinates are finite numbers");
                    }
                }
                continue;
            };
            let length = numbers.next(length)?;
            if !(length >= 0.0 && length <= numbers.capacity() as f64) {
                return Err(Fault {
                    message: format!("a list of {length} numbers does not fit"),
                    help: "the file is cut off, or the length is wrong",
                });
            }
            for _ in 0..length as usize {
                let index = numbers.next(property.item)?;
                if *role == Role::Corners {
                    if !(index >= 0.0 && index < self.vertices as f64) {
                        let vertices = self.vertices;
                        problems.push(
                            numbers.place(),
                            || format!("vertex {index} does not exist"),
                            &format!("vertices count from 0, and there are {vertices}"),
                        );
                    }
                    self.corners.push(index as u32);
                }
            }
            if *role == Role::Corners && self.corners.len() < 3 {
                problems.push(numbers.place(), || format!("a face with {length} corners"), "a face has at least three corners");
            }
        }
        Ok(())
    }
}
