//! Files that are written: whole or not at all.

use std::ffi::OsString;
use std::io::{Error, ErrorKind};
use std::path::Path;

use crate::Failure;

/// What `--out` takes where it names one file.
pub(crate) const A_FILE: &str = "a file in a folder that can be written";
/// What `--out` takes where it names a folder.
pub(crate) const A_FOLDER: &str = "a folder that can be written";

/// Writes beside the target first and then moves: there is never half a file. `takes` is [`A_FILE`] or [`A_FOLDER`].
pub(crate) fn save(target: &Path, written: &[u8], takes: &str) -> Result<(), Failure> {
    let partial = with_appended(target, "partial");
    std::fs::write(&partial, written).and_then(|()| std::fs::rename(&partial, target)).map_err(|e| {
        let _ = std::fs::remove_file(&partial);
        unwritable(target, &e, takes)
    })
}

/// The name with an extension more; a dot that the name has itself stays.
pub(crate) fn with_appended(name: impl Into<OsString>, extension: &str) -> OsString {
    let mut name = name.into();
    name.push(".");
    name.push(extension);
    name
}

/// A full disk is nobody's mistake; any other place that cannot be written to is for whoever named it to change.
pub(crate) fn unwritable(path: &Path, e: &Error, takes: &str) -> Failure {
    let message = format!("error: cannot write `{}`: {e}", path.display());
    match e.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded | ErrorKind::FileTooLarge | ErrorKind::WriteZero => Failure::Run(message),
        _ => Failure::Input(format!("{message}\n  = help: --out takes {takes}")),
    }
}
