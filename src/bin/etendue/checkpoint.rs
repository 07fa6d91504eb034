//! The file of a journal: begun, resumed or read, and never left as something that it is not.
//!
//! A new file is written beside its place with its header and then moved there. After that it is only ever appended to, at most
//! a second (or what is asked for) or four megabytes late, and locked while a run writes to it. Whatever is wrong with a file is told before it is touched.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use etendue::estimate::journal::{Recorder, Recording, RecordingError, header_bytes};
use etendue::measurement::CheckpointHeader;

use crate::disk::unwritable;
use crate::output::with_appended;
use crate::{Failure, complain};

/// Bytes that are held back at most.
const MOST_HELD: usize = 4 << 20;

/// A file that collects records and writes them now and then.
pub(crate) struct Log {
    file: File,
    path: PathBuf,
    held: Vec<u8>,
    written: Instant,
    latest: Duration,
}

impl Log {
    fn new(file: File, path: &Path, latest_seconds: f64) -> Log {
        // A time beyond all times means never before the end.
        let latest = Duration::try_from_secs_f64(latest_seconds).unwrap_or(Duration::MAX);
        Log { file, path: path.to_owned(), held: Vec::new(), written: Instant::now(), latest }
    }
}

impl Write for Log {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.held.extend_from_slice(bytes);
        if self.held.len() >= MOST_HELD || self.written.elapsed() >= self.latest {
            self.flush()?;
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        let written = self.file.write_all(&self.held);
        // Also when it failed: nothing may follow a record that is not whole.
        self.held.clear();
        self.written = Instant::now();
        written.inspect_err(|e| {
            // The run goes on without: its readings are good. How it ends says it again.
            complain(&format!("warning: cannot write the checkpoint `{}`: {e}", self.path.display()));
        })
    }
}

impl Drop for Log {
    /// A run that fails keeps its work.
    fn drop(&mut self) {
        let _ = self.flush();
    }
}

/// A journal on disk for a run, with what it knows already; records wait at most so many seconds for the disk.
pub(crate) fn open(path: &Path, header: &CheckpointHeader, latest_seconds: f64) -> Result<Recorder<Log>, Failure> {
    match fs::metadata(path) {
        Err(e) if e.kind() == ErrorKind::NotFound => begin(path, header, latest_seconds),
        _ => resume(path, header, latest_seconds),
    }
}

const PLACE: &str = "--checkpoint takes a file in a folder that can be written";

fn begin(path: &Path, header: &CheckpointHeader, latest_seconds: f64) -> Result<Recorder<Log>, Failure> {
    let partial = PathBuf::from(with_appended(path, "partial"));
    let failed = |e: &std::io::Error| unwritable(path, e, PLACE);
    let mut file = OpenOptions::new().write(true).create(true).truncate(false).open(&partial).map_err(|e| failed(&e))?;
    lock(&file, path)?;
    let text = header.to_text();
    let written = file.set_len(0).and_then(|()| file.write_all(&header_bytes(&text))).and_then(|()| fs::rename(&partial, path));
    written.map_err(|e| {
        let _ = fs::remove_file(&partial);
        failed(&e)
    })?;
    Ok(Recorder::new(&text, header.share, Log::new(file, path, latest_seconds)))
}

fn resume(path: &Path, header: &CheckpointHeader, latest_seconds: f64) -> Result<Recorder<Log>, Failure> {
    must_be_a_file(path)?;
    let mut file = OpenOptions::new().read(true).write(true).open(path).map_err(|e| unwritable(path, &e, PLACE))?;
    lock(&file, path)?;
    let (recording, there) = parsed(path, &mut file)?;
    let differences = header.differences(&there);
    if !differences.is_empty() {
        return Err(Failure::Input(format!(
            "error: the checkpoint `{}` is of another run\n{}  = help: repeat the command that began it, or name another file to begin anew",
            path.display(),
            differences.iter().map(|d| format!("  {}\n", d.told("here", "in the checkpoint"))).collect::<String>()
        )));
    }
    let known = format!("checkpoint `{}`: {} pieces of work are known", path.display(), recording.pieces());
    complain(&match (recording.completion(), recording.torn_bytes()) {
        (Some(_), _) => format!("{known}, all of the run"),
        (None, 0) => format!("{known}; going on from there"),
        (None, torn) => format!("{known}; {torn} bytes of a record that was being written are cut off; going on from there"),
    });
    let cut = if recording.torn_bytes() > 0 { file.set_len(recording.whole_bytes() as u64) } else { Ok(()) };
    cut.and_then(|()| file.seek(SeekFrom::Start(recording.whole_bytes() as u64))).map_err(|e| unwritable(path, &e, PLACE))?;
    Ok(Recorder::resumed(recording, header.share, Log::new(file, path, latest_seconds)))
}

/// A checkpoint to be read only, and whose it is.
pub(crate) fn read(path: &Path) -> Result<(Recording, CheckpointHeader), Failure> {
    let unreadable = |e: &std::io::Error| Failure::Input(format!("error: cannot read `{}`: {e}", path.display()));
    must_be_a_file(path)?;
    parsed(path, &mut File::open(path).map_err(|e| unreadable(&e))?)
}

/// Looked at before it is opened: to open a pipe would wait for a writer.
fn must_be_a_file(path: &Path) -> Result<(), Failure> {
    let wrong = |why: String| Failure::Input(format!("error: cannot read `{}`: {why}", path.display()));
    match fs::metadata(path) {
        Err(e) => Err(wrong(e.to_string())),
        Ok(about) if !about.is_file() => Err(wrong("it is not a file".to_owned())),
        Ok(_) => Ok(()),
    }
}

fn parsed(path: &Path, file: &mut File) -> Result<(Recording, CheckpointHeader), Failure> {
    let name = path.display();
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes).map_err(|e| Failure::Input(format!("error: cannot read `{name}`: {e}")))?;
    let recording = Recording::read(bytes).map_err(|e| {
        let help = match &e {
            RecordingError::NotARecording => "name a file that does not exist yet to begin a checkpoint".to_owned(),
            RecordingError::OtherFormat { .. } => "finish it with the program that began it, or name another file to begin anew".to_owned(),
            RecordingError::Header => "nothing of it can be used: name another file to begin anew".to_owned(),
            RecordingError::Damaged { offset, .. } => {
                format!("a copy that is cut off before it (`head -c {offset} FILE > COPY`) keeps the records before it")
            }
        };
        Failure::Input(format!("error: cannot use `{name}` as a checkpoint: {e}\n  = help: {help}"))
    })?;
    let header = CheckpointHeader::from_text(recording.header()).map_err(|why| {
        Failure::Input(format!("error: cannot use `{name}` as a checkpoint: its header is not one of this program: {why}"))
    })?;
    Ok((recording, header))
}

/// Two runs that write to one file would spoil it. Where files cannot be locked, nothing keeps them apart.
fn lock(file: &File, path: &Path) -> Result<(), Failure> {
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => Err(Failure::Input(format!(
            "error: another run writes to the checkpoint `{}`\n  = help: wait for it to end, or name another file",
            path.display()
        ))),
        Err(TryLockError::Error(_)) | Ok(()) => Ok(()),
    }
}
