//! The repository's files as the library sees them, for tests.

use std::fs;
use std::path::{Path, PathBuf};

use etendue::scene::{FileProblem, Files};

/// Files below the root of the repository; names are relative to it.
pub(crate) struct Repository;

/// Where the repository is.
pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_path_buf()
}

impl Files for Repository {
    fn read(&self, path: &str, most_bytes: u64) -> Result<Vec<u8>, FileProblem> {
        let bytes = fs::read(root().join(path)).map_err(|_| FileProblem::Missing)?;
        match bytes.len() as u64 {
            n if n > most_bytes => Err(FileProblem::TooLong { bytes: n }),
            _ => Ok(bytes),
        }
    }

    fn neighbours(&self, _path: &str) -> Vec<String> {
        Vec::new()
    }
}

/// Names of the files of a folder with one of these endings, sorted.
pub(crate) fn files_in(folder: &str, endings: &[&str]) -> Vec<String> {
    let entries = fs::read_dir(root().join(folder)).unwrap_or_else(|e| panic!("{folder}: {e}"));
    let mut names: Vec<String> = entries.flatten().filter_map(|e| e.file_name().into_string().ok()).collect();
    names.retain(|name| endings.iter().any(|ending| name.ends_with(ending)));
    names.sort();
    names
}
