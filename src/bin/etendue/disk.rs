//! Files on disk.

use std::fs::{self, File};
use std::io::{Error, ErrorKind, Read};
use std::path::{Component, Path, PathBuf};

use etendue::characterization::campaign::ChannelReadings;
use etendue::characterization::readings_table::readings_from_csv;
use etendue::scene::{Calibration, Device, FileProblem, Files, Scene, device_from_file, held_by, read_calibration, read_scene};

use crate::{Failure, complain};

/// The disk, as the library sees it.
pub(crate) struct Disk {
    /// The folder that no file may lie outside of, symbolic links followed. The library sees that no name leads out of it.
    root: PathBuf,
}

impl Files for Disk {
    fn read(&self, path: &str, most_bytes: u64) -> Result<Vec<u8>, FileProblem> {
        let path = fs::canonicalize(path).map_err(problem)?;
        let root = fs::canonicalize(&self.root).map_err(problem)?;
        if !path.starts_with(&root) {
            return Err(FileProblem::Unreadable(format!("the link leads out of the root `{}`", root.display())));
        }
        regular_file(&path, most_bytes)
    }

    fn neighbours(&self, path: &str) -> Vec<String> {
        names_beside(path)
    }
}

/// Files that whoever runs the program names on the command line: anywhere.
pub(crate) struct Anywhere;

impl Files for Anywhere {
    fn read(&self, path: &str, most_bytes: u64) -> Result<Vec<u8>, FileProblem> {
        regular_file(Path::new(path), most_bytes)
    }

    fn neighbours(&self, path: &str) -> Vec<String> {
        names_beside(path)
    }
}

fn problem(e: std::io::Error) -> FileProblem {
    match e.kind() {
        ErrorKind::NotFound => FileProblem::Missing,
        _ => FileProblem::Unreadable(e.to_string()),
    }
}

fn regular_file(path: &Path, most_bytes: u64) -> Result<Vec<u8>, FileProblem> {
    // Looked at before it is opened: to open a pipe would wait for a writer.
    let about = fs::metadata(path).map_err(problem)?;
    if !about.is_file() {
        return Err(FileProblem::Unreadable("it is not a file".to_owned()));
    }
    if about.len() > most_bytes {
        return Err(FileProblem::TooLong { bytes: about.len() });
    }
    let file = File::open(path).map_err(problem)?;
    let mut bytes = Vec::new();
    // A file that grows meanwhile is cut at the limit plus one byte, and so noticed.
    file.take(most_bytes + 1).read_to_end(&mut bytes).map_err(problem)?;
    match bytes.len() as u64 {
        n if n > most_bytes => Err(FileProblem::TooLong { bytes: n }),
        _ => Ok(bytes),
    }
}

/// The text of a file that whoever runs the program named.
pub(crate) fn text(path: &str, most_bytes: u64) -> Result<String, Failure> {
    String::from_utf8(bytes_of(path, most_bytes)?)
        .map_err(|error| Failure::Input(format!("error: {path}: byte {} is no UTF-8", error.utf8_error().valid_up_to() + 1)))
}

fn bytes_of(path: &str, most_bytes: u64) -> Result<Vec<u8>, Failure> {
    Anywhere.read(path, most_bytes).map_err(|problem| match problem {
        FileProblem::Missing => Failure::Input(format!("error: there is no file {path}")),
        FileProblem::TooLong { bytes } => Failure::Input(format!("error: {path} has {bytes} bytes; allowed: {most_bytes}")),
        FileProblem::Unreadable(why) => Failure::Input(format!("error: cannot read {path}: {why}")),
    })
}

fn names_beside(path: &str) -> Vec<String> {
    let folder = Path::new(path).parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let mut names: Vec<String> = entries.flatten().filter_map(|e| e.file_name().into_string().ok()).collect();
    names.sort();
    names
}

/// Reads a scene and says how its files were understood, or says everything that is wrong with it.
pub(crate) fn scene(path: &str, root: Option<&str>) -> Result<Scene, Failure> {
    let (path, disk) = with_root(path, root);
    let scene = read_scene(&path, &disk, root).map_err(|problems| Failure::Input(problems.to_string()))?;
    scene.remarks.iter().for_each(|remark| complain(&format!("note: {remark}")));
    Ok(scene)
}

/// The path as the library is asked for it, and the disk within its root.
fn with_root(path: &str, root: Option<&str>) -> (String, Disk) {
    let path = match root {
        None => through_scenes_folder(path),
        Some(_) => path.to_owned(),
    };
    let folder = root.map_or_else(|| root_of(&path), PathBuf::from);
    // The empty path is the current folder to the library, and nothing to the disk.
    (path, Disk { root: Path::new(".").join(folder) })
}

/// The name that a file begins with, such as `Scene` or `Sensor`.
pub(crate) fn holds(path: &str) -> Option<String> {
    held_by(path, &Anywhere)
}

/// Reads a file of the shelf, as [`scene`] does a scene.
pub(crate) fn device(path: &str, root: Option<&str>) -> Result<Device, Failure> {
    let (path, disk) = with_root(path, root);
    device_from_file(&path, &disk, root).map_err(|problems| Failure::Input(problems.to_string()))
}

/// Reads a calibration, as [`scene`] does a scene.
pub(crate) fn calibration(path: &str, root: Option<&str>) -> Result<Calibration, Failure> {
    let (path, disk) = with_root(path, root);
    let calibration = read_calibration(&path, &disk, root).map_err(|problems| Failure::Input(problems.to_string()))?;
    calibration.remarks.iter().for_each(|remark| complain(&format!("note: {remark}")));
    Ok(calibration)
}

/// Reads the readings of a laboratory for a calibration.
pub(crate) fn readings(path: &str, calibration: &Calibration) -> Result<Vec<ChannelReadings>, Failure> {
    const LONGEST: u64 = 64 << 20;
    let bytes = bytes_of(path, LONGEST)?;
    // Instruments write `°` and `µ` as bytes of their own: those of Latin-1 are the first characters of Unicode.
    let text = String::from_utf8(bytes).unwrap_or_else(|error| {
        complain(&format!("note: {path} is no UTF-8 text, and is read as Latin-1"));
        error.into_bytes().into_iter().map(char::from).collect()
    });
    readings_from_csv(path, &text, calibration).map_err(|problems| Failure::Input(problems.to_string()))
}

/// The files of the nearest folder of this name, here or above, as (path, text) in the order of their names; `None` if there is no folder.
///
/// What is not a text file of ordinary size is left out.
pub(crate) fn shelf(name: &str) -> Option<Vec<(String, String)>> {
    const MOST_BYTES: u64 = 1 << 20;
    let here = std::env::current_dir().ok()?;
    let holder = here.ancestors().find(|folder| folder.join(name).is_dir())?;
    let disk = Disk { root: holder.join(name) };
    let text_of = |file: String| {
        let path = holder.join(name).join(&file);
        let text = String::from_utf8(disk.read(path.to_str()?, MOST_BYTES).ok()?).ok()?;
        Some((format!("{name}/{file}"), text))
    };
    Some(disk.neighbours(holder.join(name).join("any").to_str()?).into_iter().filter_map(text_of).collect())
}

/// The files of the nearest folder of this name, here or above, that end so, as paths that can be opened; `None` if there is no folder.
pub(crate) fn names_on_shelf(name: &str, extension: &str) -> Option<Vec<String>> {
    let here = std::env::current_dir().ok()?;
    let holder = here.ancestors().find(|folder| folder.join(name).is_dir())?;
    let folder = if holder == here { PathBuf::from(name) } else { holder.join(name) };
    let files = names_beside(folder.join("any").to_str()?).into_iter().map(|file| folder.join(file));
    let wanted = files.filter(|file| file.extension().is_some_and(|e| e == extension));
    Some(wanted.filter_map(|file| file.to_str().map(str::to_owned)).collect())
}

/// The root of a scene as [`read_scene`] has it: the parent of the innermost folder `scenes` on its way, else its own folder.
fn root_of(scene: &str) -> PathBuf {
    let mut path = PathBuf::new();
    for part in Path::new(scene).components() {
        match part {
            Component::ParentDir if matches!(path.components().next_back(), Some(Component::Normal(_))) => {
                path.pop();
            }
            Component::CurDir => {}
            part => path.push(part),
        }
    }
    path.pop();
    let holder = path.ancestors().find(|folder| folder.file_name().is_some_and(|name| name == "scenes")).and_then(Path::parent);
    holder.map_or(path.clone(), Path::to_owned)
}

/// The path by way of the folder `scenes` in which the program runs, if it does: `bench.ron` becomes `../scenes/bench.ron`.
///
/// The library sees names only. Without this a scene could not reach the `sensors` beside its folder when it is named from within.
fn through_scenes_folder(path: &str) -> String {
    if Path::new(path).is_absolute() || Path::new(path).components().any(|c| c.as_os_str() == "scenes" || c.as_os_str() == "..") {
        return path.to_owned();
    }
    let Ok(here) = std::env::current_dir() else { return path.to_owned() };
    let folders: Vec<_> = here.iter().map(|part| part.to_string_lossy()).collect();
    match folders.iter().rposition(|part| part == "scenes") {
        Some(at) => format!("{}{}/{path}", "../".repeat(folders.len() - at), folders[at..].join("/")),
        None => path.to_owned(),
    }
}

/// Puts the bytes into a file: beside the target first and then moved, so that there is never half a file. A link is followed; what is there
/// and is no file (a pipe, a device such as `/dev/stdout`) is written to and not replaced.
pub(crate) fn save(target: &Path, written: &[u8]) -> Result<(), Error> {
    let target = fs::canonicalize(target).unwrap_or_else(|_| target.to_owned());
    if fs::metadata(&target).is_ok_and(|about| !about.is_file() && !about.is_dir()) {
        return fs::write(&target, written);
    }
    let mut partial = target.as_os_str().to_owned();
    partial.push(".partial");
    fs::write(&partial, written).and_then(|()| fs::rename(&partial, &target)).inspect_err(|_| {
        let _ = fs::remove_file(&partial);
    })
}

/// Moves a file that is written to its place; links and devices as [`save`] has them.
pub(crate) fn moved(partial: &Path, target: &Path) -> Result<(), Error> {
    let target = fs::canonicalize(target).unwrap_or_else(|_| target.to_owned());
    if fs::metadata(&target).is_ok_and(|about| !about.is_file() && !about.is_dir()) {
        return fs::copy(partial, &target).and_then(|_| fs::remove_file(partial));
    }
    fs::rename(partial, &target)
}

/// A full disk is nobody's mistake; any other place that cannot be written to is for whoever named it to change.
pub(crate) fn unwritable(path: &Path, e: &Error, help: &str) -> Failure {
    let message = format!("error: cannot write `{}`: {e}", path.display());
    match e.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded | ErrorKind::FileTooLarge | ErrorKind::WriteZero => Failure::Run(message),
        _ => Failure::Input(format!("{message}\n  = help: {help}")),
    }
}
