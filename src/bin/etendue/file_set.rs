//! Several files at once: all of them are written, or none.

use std::fs;
use std::io::{Error, ErrorKind};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use crate::disk::unwritable;
use crate::{Failure, disk};

/// Files for one folder. Each is written beside its place; [`FileSet::finish`] moves all of them there. Dropped before, it leaves nothing behind.
pub(crate) struct FileSet {
    folder: PathBuf,
    help: &'static str,
    /// The folder was made for them.
    made: bool,
    waiting: Mutex<Vec<String>>,
}

impl FileSet {
    /// Makes the folder, and tells every name whose place is taken before the time of a run is spent. Names may have a folder in front.
    pub(crate) fn new(folder: &Path, names: impl IntoIterator<Item = String>, help: &'static str) -> Result<FileSet, Failure> {
        let set = FileSet { folder: folder.to_owned(), help, made: !folder.exists(), waiting: Mutex::default() };
        fs::create_dir_all(folder).map_err(|e| unwritable(folder, &e, help))?;
        let taken: Vec<PathBuf> = names.into_iter().map(|name| folder.join(name)).filter(|target| target.is_dir()).collect();
        match taken.len() {
            0 => Ok(set),
            _ => Err(Failure::Input(taken.iter().map(|target| occupied(target)).collect())),
        }
    }

    /// Writes a file beside its place; from any thread.
    pub(crate) fn add(&self, name: &str, bytes: &[u8]) -> Result<(), Failure> {
        self.waiting.lock().unwrap_or_else(PoisonError::into_inner).push(name.to_owned());
        let partial = self.partial(name);
        let folder = partial.parent().map_or(Ok(()), fs::create_dir_all);
        folder.and_then(|()| fs::write(&partial, bytes)).map_err(|e| unwritable(&self.folder.join(name), &e, self.help))
    }

    /// Moves every file to its place; gives their names.
    pub(crate) fn finish(self) -> Result<Vec<String>, Failure> {
        let names = std::mem::take(&mut *self.waiting.lock().unwrap_or_else(PoisonError::into_inner));
        for (i, name) in names.iter().enumerate() {
            let target = self.folder.join(name);
            if let Err(e) = disk::moved(&self.partial(name), &target) {
                // What could not be moved is cleared away.
                self.waiting.lock().unwrap_or_else(PoisonError::into_inner).extend_from_slice(&names[i..]);
                return Err(unwritable(&target, &e, self.help));
            }
        }
        Ok(names)
    }

    fn partial(&self, name: &str) -> PathBuf {
        let mut name = self.folder.join(name).into_os_string();
        name.push(".partial");
        PathBuf::from(name)
    }
}

impl Drop for FileSet {
    fn drop(&mut self) {
        let left = std::mem::take(&mut *self.waiting.lock().unwrap_or_else(PoisonError::into_inner));
        for name in &left {
            let partial = self.partial(name);
            let _ = fs::remove_file(&partial);
            // A folder within goes if it is empty.
            let inner = partial.parent().filter(|inner| *inner != self.folder);
            let _ = inner.map(fs::remove_dir);
        }
        if self.made {
            // Only an empty one goes.
            let _ = fs::remove_dir(&self.folder);
        }
    }
}

fn occupied(target: &Path) -> String {
    format!("error: cannot write `{}`: it is a folder\n  = help: move it away, or name another folder with --out\n", target.display())
}

/// Whether files can be put where options name them, told before the time of a study is spent; every problem at once.
pub(crate) fn check_places<'p>(places: impl IntoIterator<Item = (&'static str, &'p PathBuf)>) -> Result<(), Failure> {
    let places: Vec<(&str, &PathBuf)> = places.into_iter().collect();
    let mut problems = String::new();
    for (i, (option, path)) in places.iter().enumerate() {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        let shown = path.display();
        if let Some((first, _)) = places[..i].iter().find(|(_, other)| other == path) {
            problems += &format!("error: {first} and {option} both name `{shown}`\n  = help: give them a file each\n");
        } else if path.is_dir() {
            problems += &format!("error: cannot write `{shown}`: it is a folder\n  = help: name a file in it\n");
        } else if let Some(folder) = folder.filter(|folder| !folder.is_dir()) {
            problems += &format!("error: cannot write `{shown}`: there is no folder `{}`\n  = help: make it first\n", folder.display());
        } else if let Err(e) = tried(path) {
            problems += &format!("error: cannot write `{shown}`: {e}\n  = help: {option} takes a place that can be written\n");
        }
    }
    if problems.is_empty() { Ok(()) } else { Err(Failure::Input(problems)) }
}

/// Tries the place without touching what is there.
fn tried(target: &Path) -> Result<(), Error> {
    if target.exists() && !target.is_file() {
        // A pipe or a device is written to as it stands.
        return Ok(());
    }
    let mut partial = target.as_os_str().to_owned();
    partial.push(".partial");
    match fs::OpenOptions::new().write(true).create_new(true).open(&partial) {
        Ok(_) => fs::remove_file(&partial),
        // Somebody is writing there, so it can be written to.
        Err(e) if e.kind() == ErrorKind::AlreadyExists => Ok(()),
        Err(e) => Err(e),
    }
}
