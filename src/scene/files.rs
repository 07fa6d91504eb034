//! The only door to files: whoever calls the reader passes something that can read them.
//!
//! Names in a file are relative to the file that mentions them and use `/`. No name leaves the *root*: the folder that
//! holds the scene's `scenes` folder (and with it `sensors`, curves, meshes), else the scene's own folder, or one that
//! is given. The rule looks at names only; an implementation of [`Files`] that follows links decides where they may lead.

use std::collections::BTreeMap;
use std::fmt;

/// Longest scene or sensor file that is read, bytes.
pub const LONGEST_DOCUMENT_BYTES: u64 = 16 << 20;
/// Longest curve that is read, bytes.
pub const LONGEST_CURVE_BYTES: u64 = 64 << 20;
/// Longest mesh that is read, bytes.
pub const LONGEST_MESH_BYTES: u64 = 2 << 30;
/// Bytes that a scene and all that it mentions may have together; a file that is read twice counts twice.
pub const MOST_BYTES: u64 = 4 << 30;

/// Why a file could not be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FileProblem {
    /// There is no such file.
    Missing,
    /// The file is longer than what is read of its kind.
    TooLong {
        /// Its length, bytes.
        bytes: u64,
    },
    /// Anything else, in words: no permission, a folder, a broken disk.
    Unreadable(String),
}

impl fmt::Display for FileProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FileProblem::Missing => f.write_str("there is no such file"),
            FileProblem::TooLong { bytes } => write!(f, "the file has {bytes} bytes"),
            FileProblem::Unreadable(why) => f.write_str(why),
        }
    }
}

/// Something that can read files.
pub trait Files {
    /// The bytes of a file. One that is longer than `most_bytes` must not be read but answered with its length.
    fn read(&self, path: &str, most_bytes: u64) -> Result<Vec<u8>, FileProblem>;

    /// Names of the files in the folder of `path`, to offer the nearest one when it is missing.
    fn neighbours(&self, path: &str) -> Vec<String> {
        let _ = path;
        Vec::new()
    }
}

/// Files that are held in memory, by path.
#[derive(Clone, Debug, Default)]
pub struct MemoryFiles(pub BTreeMap<String, Vec<u8>>);

impl MemoryFiles {
    /// No files yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The same files and one more.
    #[must_use]
    pub fn with(mut self, path: &str, bytes: impl Into<Vec<u8>>) -> Self {
        self.0.insert(path.into(), bytes.into());
        self
    }
}

impl Files for MemoryFiles {
    fn read(&self, path: &str, most_bytes: u64) -> Result<Vec<u8>, FileProblem> {
        let bytes = self.0.get(path).ok_or(FileProblem::Missing)?;
        if bytes.len() as u64 > most_bytes {
            return Err(FileProblem::TooLong { bytes: bytes.len() as u64 });
        }
        Ok(bytes.clone())
    }

    fn neighbours(&self, path: &str) -> Vec<String> {
        let folder = folder_of(path);
        self.0.keys().filter(|key| folder_of(key) == folder).map(|key| key[folder.len()..].trim_start_matches('/').to_string()).collect()
    }
}

/// The folder of a file, without a slash at its end; empty for the current one.
fn folder_of(path: &str) -> &str {
    path.rfind('/').map_or("", |slash| &path[..slash.max(usize::from(slash == 0))])
}

/// A path without `.`, empty parts, and `..` after a name.
pub(super) fn normalised(path: &str) -> String {
    let mut parts: Vec<&str> = Vec::new();
    for part in path.split('/') {
        match part {
            "" | "." => {}
            ".." if parts.last().is_some_and(|&last| last != "..") => {
                parts.pop();
            }
            ".." if path.starts_with('/') => {}
            _ => parts.push(part),
        }
    }
    format!("{}{}", if path.starts_with('/') { "/" } else { "" }, parts.join("/"))
}

/// The root of a scene file: the parent of the innermost folder called `scenes` on its way, else its own folder.
pub(super) fn root_of(scene: &str) -> String {
    let scene = normalised(scene);
    let folder = folder_of(&scene);
    let parts: Vec<&str> = folder.split('/').collect();
    match parts.iter().rposition(|&part| part == "scenes") {
        Some(0) => String::new(),
        Some(1) if parts[0].is_empty() => "/".into(),
        Some(at) => parts[..at].join("/"),
        None => folder.into(),
    }
}

/// Whether a path lies within a root, both normalised.
pub(super) fn within(path: &str, root: &str) -> bool {
    if root.is_empty() {
        return !path.starts_with('/') && path != ".." && !path.starts_with("../");
    }
    let root = root.trim_end_matches('/');
    path.strip_prefix(root).is_some_and(|rest| rest.starts_with('/')) && !path[root.len()..].split('/').any(|part| part == "..")
}

/// The path of `name` as mentioned by the file `by`; the error says why it is not allowed.
pub(super) fn resolved(by: &str, name: &str, root: &str) -> Result<String, String> {
    if name.is_empty() {
        return Err("a file name is empty".into());
    }
    if name.starts_with(['/', '\\']) || name.chars().nth(1) == Some(':') {
        return Err(format!("`{name}` is an absolute path"));
    }
    if name.contains(['\\', '\0']) {
        return Err(format!("`{}` contains a character that file names must not have here", name.escape_default()));
    }
    if name.ends_with('/') || matches!(name.rsplit('/').next(), Some("." | "..")) {
        return Err(format!("`{name}` is a folder, not a file"));
    }
    let path = normalised(&format!("{}/{name}", if folder_of(by).is_empty() { "." } else { folder_of(by) }));
    if within(&path, root) {
        return Ok(path);
    }
    Err(format!("`{name}` leaves the folder that the scene may read from"))
}

/// FNV-1a, 64 bit (Fowler, Noll, Vo; public domain), continued over more bytes.
pub(crate) fn hashed(hash: u64, bytes: &[u8]) -> u64 {
    let start = if hash == 0 { 0xcbf2_9ce4_8422_2325 } else { hash };
    bytes.iter().fold(start, |h, &b| (h ^ u64::from(b)).wrapping_mul(0x0000_0100_0000_01b3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_root_holds_the_scenes_folder() {
        assert_eq!(root_of("scenes/x.ron"), "");
        assert_eq!(root_of("../lab/scenes/deep/x.ron"), "../lab");
        assert_eq!(root_of("/a/scenes/x.ron"), "/a");
        assert_eq!(root_of("/scenes/x.ron"), "/");
        assert_eq!(root_of("here/x.ron"), "here");
        assert_eq!(root_of("x.ron"), "");
    }

    #[test]
    fn no_name_leaves_the_root() {
        assert_eq!(resolved("scenes/x.ron", "../sensors/a.ron", "").as_deref(), Ok("sensors/a.ron"));
        assert_eq!(resolved("../lab/scenes/x.ron", "../sensors/a.ron", "../lab").as_deref(), Ok("../lab/sensors/a.ron"));
        assert_eq!(resolved("/scenes/x.ron", "../a.csv", "/").as_deref(), Ok("/a.csv"));
        for name in ["../../a", "/etc/passwd", "../../../etc/passwd", "C:/a", "a\\..\\b", "", "..", "../.."] {
            assert!(resolved("scenes/x.ron", name, "").is_err(), "{name}");
        }
        assert!(resolved("lab/x.ron", "../labels/a", "lab").is_err());
        assert!(resolved("../lab/x.ron", "../../a", "../lab").is_err());
    }

    #[test]
    fn the_hash_is_fnv_1a() {
        // Test vectors of the authors of the function.
        assert_eq!(hashed(0, b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(hashed(0, b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(hashed(0, b"foobar"), 0x8594_4171_f739_67e8);
    }
}
