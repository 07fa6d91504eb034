//! What is shared while a scene and the files that it mentions are read.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::decode::Value;
use super::diagnostic::{Diagnostic, Problems};
use super::document::Document;
use super::files::{FileProblem, Files, LONGEST_DOCUMENT_BYTES, MOST_BYTES, hashed, resolved};
use crate::geometry::mesh::Mesh;
use crate::naming::{by_distance, nearest};
use crate::sensor::Sensor;
use crate::sensor::camera::Camera;
use crate::spectrum::file::{CurveFile, Meaning};

/// Most files that are offered instead of a missing one.
const OFFERED: usize = 5;

/// What a file could have been called: the name that was probably meant, else the nearest ones of its kind in its folder.
fn instead_of(file: &str, neighbours: &[String]) -> Option<String> {
    if let Some(name) = nearest(file, neighbours.iter().map(String::as_str)) {
        return Some(format!("did you mean `{name}` in the same folder?"));
    }
    let (_, ending) = file.rsplit_once('.')?;
    let of_its_kind = neighbours.iter().map(String::as_str).filter(|name| name.rsplit_once('.').is_some_and(|(_, e)| e == ending));
    let (names, more) = by_distance(file, of_its_kind, OFFERED);
    let listed = names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
    let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
    (!names.is_empty()).then(|| format!("in the same folder: {listed}{rest}"))
}

/// Files that have been read, problems that have been found.
pub(super) struct Reading<'f> {
    files: &'f dyn Files,
    /// The folder that no name may leave; none if names are taken as they are.
    root: Option<String>,
    bytes_left: u64,
    /// Problems of all files so far.
    pub(super) problems: Problems,
    /// Hash of everything that was read, file by file in the order of reading.
    pub(super) hash: u64,
    /// Curves by path and meaning; none for one that has problems.
    pub(super) curves: BTreeMap<(String, Meaning), Option<CurveFile>>,
    /// How curve files were understood, file by file.
    pub(super) remarks: Vec<String>,
    /// Sensors by path; none for one that has problems.
    pub(super) sensors: BTreeMap<String, Option<Arc<Sensor>>>,
    /// Cameras by path; none for one that has problems.
    pub(super) cameras: BTreeMap<String, Option<Arc<Camera>>>,
    /// Meshes by path and placement; none for one that has problems.
    pub(super) meshes: BTreeMap<(String, [u64; 10]), Option<Arc<Mesh>>>,
}

impl<'f> Reading<'f> {
    /// Nothing read yet. `root` is the folder that no name may leave.
    pub(super) fn new(files: &'f dyn Files, scene: &str, root: String) -> Self {
        Self {
            files,
            root: Some(root),
            bytes_left: MOST_BYTES,
            problems: Problems::new(scene),
            hash: 0,
            curves: BTreeMap::new(),
            remarks: Vec::new(),
            sensors: BTreeMap::new(),
            cameras: BTreeMap::new(),
            meshes: BTreeMap::new(),
        }
    }

    /// Nothing read yet; names of files are taken as they are, because whoever runs the program has written them.
    pub(super) fn anywhere(files: &'f dyn Files, first_file: &str) -> Self {
        Self { root: None, ..Self::new(files, first_file, String::new()) }
    }

    /// The path of the file that a value names.
    pub(super) fn path(&mut self, mention: &Value, name: &str) -> Option<String> {
        let Some(root) = &self.root else { return Some(name.into()) };
        match resolved(&mention.document.file, name, root) {
            Ok(path) => Some(path),
            Err(why) => {
                let root = if root.is_empty() { "the current folder".to_string() } else { format!("`{root}`") };
                let help = format!(
                    "names are relative to the file that mentions them and stay within {root}; move the file there, or give the folder that holds both: `--root DIR`"
                );
                mention.problem(&mut self.problems, why, help);
                None
            }
        }
    }

    /// The bytes of a file that a value mentions; `what` says what is expected in it.
    pub(super) fn bytes(&mut self, mention: &Value, path: &str, what: &str, most_bytes: u64) -> Option<Vec<u8>> {
        match self.files.read(path, most_bytes.min(self.bytes_left)) {
            Ok(bytes) => {
                self.bytes_left = self.bytes_left.saturating_sub(bytes.len() as u64);
                self.hash = hashed(hashed(self.hash, path.as_bytes()), &bytes);
                Some(bytes)
            }
            Err(problem) => {
                let neighbours = if self.problems.is_full() { Vec::new() } else { self.files.neighbours(path) };
                let file = path.rsplit('/').next().unwrap_or(path);
                let (message, help) = match problem {
                    FileProblem::Missing => {
                        let help = match instead_of(file, &neighbours) {
                            Some(offer) => offer,
                            None => "names are relative to the file that mentions them".into(),
                        };
                        (format!("there is no {what} `{path}`"), help)
                    }
                    FileProblem::TooLong { bytes } if bytes <= most_bytes => (
                        format!("with the {what} `{path}` the files of the scene are too long together"),
                        format!("at most {MOST_BYTES} bytes ({} MiB) are read in all", MOST_BYTES >> 20),
                    ),
                    FileProblem::TooLong { bytes } => (
                        format!("the {what} `{path}` has {bytes} bytes"),
                        format!("at most {most_bytes} bytes ({} MiB) are read", most_bytes >> 20),
                    ),
                    FileProblem::Unreadable(why) => (format!("the {what} `{path}` cannot be read: {why}"), String::new()),
                };
                mention.problem(&mut self.problems, message, help);
                None
            }
        }
    }

    /// A text that a value mentions.
    pub(super) fn text(&mut self, mention: &Value, path: &str, what: &str, most_bytes: u64) -> Option<String> {
        let bytes = self.bytes(mention, path, what, most_bytes)?;
        self.utf8(path, bytes)
    }

    fn utf8(&mut self, path: &str, bytes: Vec<u8>) -> Option<String> {
        match String::from_utf8(bytes) {
            Ok(text) => Some(text),
            Err(error) => {
                let good = &error.as_bytes()[..error.utf8_error().valid_up_to()];
                let line = 1 + good.iter().filter(|&&b| b == b'\n').count();
                let start = good.iter().rposition(|&b| b == b'\n').map_or(0, |at| at + 1);
                let column = 1 + String::from_utf8_lossy(&good[start..]).chars().count();
                let text = String::from_utf8_lossy(&error.as_bytes()[start..]);
                let text = text.lines().next().unwrap_or_default();
                self.problems.add(Diagnostic::of_column(
                    path,
                    line,
                    column,
                    text,
                    "the file holds bytes that are not UTF-8 text",
                    "save the file as UTF-8 text",
                ));
                None
            }
        }
    }

    /// The document of a file that a value mentions.
    pub(super) fn document(&mut self, mention: &Value, path: &str, what: &str) -> Option<Document> {
        let text = self.text(mention, path, what, LONGEST_DOCUMENT_BYTES)?;
        self.parsed(path, &text)
    }

    /// The document of the scene file itself.
    pub(super) fn first_document(&mut self, path: &str, what: &str) -> Option<Document> {
        match self.files.read(path, LONGEST_DOCUMENT_BYTES) {
            Ok(bytes) => {
                self.hash = hashed(self.hash, &bytes);
                let text = self.utf8(path, bytes)?;
                self.parsed(path, &text)
            }
            Err(problem) => {
                let help = match problem {
                    FileProblem::TooLong { .. } => {
                        Some(format!("at most {LONGEST_DOCUMENT_BYTES} bytes ({} MiB) are read", LONGEST_DOCUMENT_BYTES >> 20))
                    }
                    FileProblem::Missing => {
                        let neighbours = self.files.neighbours(path);
                        let file = path.rsplit('/').next().unwrap_or(path);
                        instead_of(file, &neighbours)
                    }
                    FileProblem::Unreadable(_) => None,
                };
                self.problems.add(Diagnostic::of_file(path, format!("the {what} cannot be read: {problem}"), help));
                None
            }
        }
    }

    fn parsed(&mut self, path: &str, text: &str) -> Option<Document> {
        match Document::parse(path, text) {
            Ok(document) => Some(document),
            Err(problem) => {
                self.problems.add(*problem);
                None
            }
        }
    }
}
