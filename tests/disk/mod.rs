//! Files of the disk as the library sees them, for tests.

// Each test crate uses its part of this.
#![allow(dead_code)]

use std::fs;
use std::path::{Path, PathBuf};

use etendue::scene::{FileProblem, Files};

/// Files below a folder of the disk; names are relative to it.
pub(crate) struct Folder(pub(crate) PathBuf);

/// Files below the root of the repository; names are relative to it.
pub(crate) struct Repository;

/// Where the repository is.
pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_path_buf()
}

impl Files for Folder {
    fn read(&self, path: &str, most_bytes: u64) -> Result<Vec<u8>, FileProblem> {
        let file = self.0.join(path);
        let about = fs::metadata(&file).map_err(|error| match error.kind() {
            std::io::ErrorKind::NotFound => FileProblem::Missing,
            _ => FileProblem::Unreadable(error.to_string()),
        })?;
        if !about.is_file() {
            return Err(FileProblem::Unreadable("it is not a file".into()));
        }
        if about.len() > most_bytes {
            return Err(FileProblem::TooLong { bytes: about.len() });
        }
        fs::read(&file).map_err(|error| FileProblem::Unreadable(error.to_string()))
    }

    fn neighbours(&self, path: &str) -> Vec<String> {
        let file = self.0.join(path);
        let Some(entries) = file.parent().and_then(|folder| fs::read_dir(folder).ok()) else { return Vec::new() };
        let mut names: Vec<String> = entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }
}

impl Files for Repository {
    fn read(&self, path: &str, most_bytes: u64) -> Result<Vec<u8>, FileProblem> {
        Folder(root()).read(path, most_bytes)
    }

    fn neighbours(&self, path: &str) -> Vec<String> {
        Folder(root()).neighbours(path)
    }
}

/// Names of the files of a folder of the repository with one of these endings, sorted.
pub(crate) fn files_in(folder: &str, endings: &[&str]) -> Vec<String> {
    let entries = fs::read_dir(root().join(folder)).unwrap_or_else(|e| panic!("{folder}: {e}"));
    let mut names: Vec<String> = entries.flatten().filter_map(|e| e.file_name().into_string().ok()).collect();
    names.retain(|name| endings.iter().any(|ending| name.ends_with(ending)));
    names.sort();
    names
}
