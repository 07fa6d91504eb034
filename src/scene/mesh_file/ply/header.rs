//! The header: `ply`, `format ascii|binary_little_endian|binary_big_endian 1.0`, then for each element `element NAME COUNT` and its
//! `property TYPE NAME` or `property list TYPE TYPE NAME`, at last `end_header`.

use super::super::{ELEMENT_LIMIT, MeshProblems, Place, quoted, words};

/// How numbers are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Ascii,
    Little,
    Big,
}

/// The type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Type {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Type {
    fn named(word: &[u8]) -> Option<Type> {
        Some(match word {
            b"char" | b"int8" => Type::I8,
            b"uchar" | b"uint8" => Type::U8,
            b"short" | b"int16" => Type::I16,
            b"ushort" | b"uint16" => Type::U16,
            b"int" | b"int32" => Type::I32,
            b"uint" | b"uint32" => Type::U32,
            b"float" | b"float32" => Type::F32,
            b"double" | b"float64" => Type::F64,
            _ => return None,
        })
    }

    /// Bytes of a binary number.
    pub(super) fn size(self) -> usize {
        match self {
            Type::I8 | Type::U8 => 1,
            Type::I16 | Type::U16 => 2,
            Type::I32 | Type::U32 | Type::F32 => 4,
            Type::F64 => 8,
        }
    }

    pub(super) fn is_whole(self) -> bool {
        !matches!(self, Type::F32 | Type::F64)
    }
}

/// One property: `list` is the type of the length if it is a list.
#[derive(Clone, Debug)]
pub(super) struct Property {
    pub(super) name: Vec<u8>,
    pub(super) list: Option<Type>,
    pub(super) item: Type,
}

#[derive(Clone, Debug)]
pub(super) struct Element {
    pub(super) name: Vec<u8>,
    pub(super) count: usize,
    pub(super) properties: Vec<Property>,
    place: Place,
}

#[derive(Clone, Debug)]
pub(super) struct Header {
    pub(super) format: Format,
    pub(super) elements: Vec<Element>,
    /// Byte at which the body begins, and lines above it.
    pub(super) body: usize,
    pub(super) lines: usize,
}

const TYPES: &str = "types are char, uchar, short, ushort, int, uint, float, double, or int8 ... float64";

/// Reads and checks the header; `None` if it has no end or no format.
pub(super) fn read(bytes: &[u8], problems: &mut MeshProblems) -> Option<Header> {
    let mut format = None;
    let mut elements: Vec<Element> = Vec::new();
    let mut at = 0;
    let mut line_number = 0;
    loop {
        let rest = &bytes[at..];
        let length = rest.iter().position(|&c| c == b'\n');
        let line = &rest[..length.unwrap_or(rest.len())];
        line_number += 1;
        at += length.map_or(rest.len(), |length| length + 1);
        let here = |column| Place::text(line_number, column);
        let words: Vec<(usize, &[u8])> = words(line).take(8).collect();
        let texts: Vec<&[u8]> = words.iter().map(|(_, word)| *word).collect();
        if line_number == 1 && texts != [b"ply".as_slice()] {
            problems.push(
                here(1),
                || "the first line is not \"ply\"".to_owned(),
                "a PLY file begins with the line ply, ended by a line feed",
            );
            return None;
        }
        match texts.as_slice() {
            [] | [b"comment" | b"obj_info", ..] => {}
            [b"ply"] if line_number == 1 => {}
            [b"end_header"] if length.is_some() => break,
            [b"format", name, b"1.0"] => {
                format = match *name {
                    b"ascii" => Some(Format::Ascii),
                    b"binary_little_endian" => Some(Format::Little),
                    b"binary_big_endian" => Some(Format::Big),
                    _ => {
                        problems.push(
                            here(words[1].0),
                            || format!("unknown format {}", quoted(name)),
                            "formats are ascii, binary_little_endian, binary_big_endian",
                        );
                        return None;
                    }
                }
            }
            [b"element", name, count] => {
                let number = std::str::from_utf8(count).ok().and_then(|count| count.parse().ok()).filter(|&count| count <= ELEMENT_LIMIT);
                if number.is_none() {
                    problems.push(
                        here(words[2].0),
                        || format!("{} is not a possible number of elements", quoted(count)),
                        "a whole number from 0 to 50000000",
                    );
                }
                if elements.iter().any(|element| element.name == *name) {
                    problems.push(here(words[1].0), || format!("a second element {}", quoted(name)), "each element is declared once");
                }
                elements.push(Element { name: name.to_vec(), count: number.unwrap_or(0), properties: Vec::new(), place: here(1) });
            }
            [b"property", rest @ ..] => {
                let (list, item, name) = match rest {
                    [b"list", length, item, name] => (Some(*length), *item, *name),
                    [item, name] => (None, *item, *name),
                    _ => {
                        problems.push(here(1), || "not a property".to_owned(), "property TYPE NAME, or property list TYPE TYPE NAME");
                        continue;
                    }
                };
                let unknown = [list, Some(item)].into_iter().flatten().find(|word| Type::named(word).is_none());
                if let Some(word) = unknown {
                    problems.push(here(words[1].0), || format!("unknown type {}", quoted(word)), TYPES);
                }
                let list = list.and_then(Type::named);
                if list.is_some_and(|list| !list.is_whole()) {
                    problems.push(here(words[2].0), || "the length of a list is not a whole number".to_owned(), TYPES);
                }
                match (elements.last_mut(), Type::named(item)) {
                    (Some(element), Some(item)) => element.properties.push(Property { name: name.to_vec(), list, item }),
                    (None, _) => problems.push(here(1), || "a property above the first element".to_owned(), "declare its element first"),
                    (_, None) => {}
                }
            }
            _ if length.is_none() => {
                problems.push(here(1), || "the header does not end".to_owned(), "a line end_header closes the header");
                return None;
            }
            [first, ..] => problems.push(
                here(1),
                || format!("{} does not belong in a header", quoted(first)),
                "a header has format, comment, element, property, end_header",
            ),
        }
        if length.is_none() {
            problems.push(here(1), || "the header does not end".to_owned(), "a line end_header closes the header");
            return None;
        }
    }
    let Some(format) = format else {
        problems.push(
            Place::text(2, 1),
            || "the header names no format".to_owned(),
            "format ascii 1.0, or binary_little_endian, binary_big_endian",
        );
        return None;
    };
    let header = Header { format, elements, body: at, lines: line_number };
    check(&header, bytes.len() - at, problems);
    Some(header)
}

/// The needed elements and properties exist, and the body can hold what is claimed.
fn check(header: &Header, body_length: usize, problems: &mut MeshProblems) {
    let end = Place::text(header.lines, 1);
    for name in ["vertex", "face"] {
        if !header.elements.iter().any(|element| element.name == name.as_bytes()) {
            problems.push(
                end,
                || format!("no element {name:?}"),
                "a mesh has the elements vertex and face; point clouds and strips have no faces",
            );
        }
    }
    for element in &header.elements {
        let has = |name: &[u8], list: bool| element.properties.iter().filter(|p| p.name == name && p.list.is_some() == list).count();
        if element.name == b"vertex" && [b"x", b"y", b"z"].iter().any(|name| has(*name, false) != 1) {
            problems.push(element.place, || "a vertex needs x, y and z, each once".to_owned(), "property float x");
        }
        let lists = || element.properties.iter().filter(|p| is_corners(p));
        if element.name == b"face" && (lists().count() != 1 || lists().any(|p| !p.item.is_whole())) {
            problems.push(
                element.place,
                || "a face needs one list of vertices of a whole number type".to_owned(),
                "property list uchar int vertex_indices",
            );
        }
    }
    let mut needed = 0_usize;
    for element in &header.elements {
        let smallest: usize = match header.format {
            // A digit and a blank for each number.
            Format::Ascii => 2 * element.properties.len(),
            _ => element.properties.iter().map(|p| p.list.unwrap_or(p.item).size()).sum(),
        };
        needed = needed.saturating_add(smallest.saturating_mul(element.count));
        // The last blank of a text may be missing.
        if needed > body_length + 1 {
            problems.push(
                element.place,
                || format!("at least {needed} bytes are announced, but only {body_length} follow the header"),
                "the file is cut off, or the count is wrong",
            );
            break;
        }
    }
}

/// Whether a property is the list of a face's corners.
pub(super) fn is_corners(property: &Property) -> bool {
    property.list.is_some() && (property.name == b"vertex_indices" || property.name == b"vertex_index")
}
