//! Files that are written: whole or not at all.

use std::ffi::OsString;
use std::io::{Error, ErrorKind};
use std::path::Path;

use crate::Failure;

/// Writes beside the target first and then moves: there is never half a file.
pub(crate) fn save(target: &Path, written: &[u8]) -> Result<(), Failure> {
    let partial = with_appended(target, "partial");
    std::fs::write(&partial, written).and_then(|()| std::fs::rename(&partial, target)).map_err(|e| {
        let _ = std::fs::remove_file(&partial);
        unwritable(target, &e)
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
pub(crate) fn unwritable(path: &Path, e: &Error) -> Failure {
    let message = format!("error: cannot write `{}`: {e}", path.display());
    match e.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded | ErrorKind::FileTooLarge | ErrorKind::WriteZero => Failure::Run(message),
        _ => Failure::Input(format!("{message}\n  = help: name a place in a folder that exists and can be written")),
    }
}
