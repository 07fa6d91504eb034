//! The program, as the tests of this folder run it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::disk::root;

/// A box with a meter in a penumbra: some twenty pieces of work with `--samples 65536`.
pub(crate) const BOX: &str = "scenes/cornell-box.ron";

pub(crate) fn etendue(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_etendue")).args(arguments).current_dir(root()).output().unwrap()
}

pub(crate) fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

pub(crate) fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// What a command says that ends well.
pub(crate) fn done(arguments: &[&str]) -> String {
    let output = etendue(arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", stderr(&output));
    stdout(&output)
}

/// What a command says that refuses its input; nothing is on stdout.
pub(crate) fn refused(arguments: &[&str]) -> String {
    let output = etendue(arguments);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}{}", stdout(&output), stderr(&output));
    assert!(output.stdout.is_empty(), "{arguments:?}: {}", stdout(&output));
    stderr(&output)
}

/// A folder of its own for files that a test writes.
pub(crate) fn scratch(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("survival").join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

pub(crate) fn name(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// JSON without what a clock says.
pub(crate) fn timeless(json: &str) -> String {
    json.lines().filter(|line| !line.contains("seconds\": ") || line.contains("budget_seconds")).collect::<Vec<_>>().join("\n")
}
