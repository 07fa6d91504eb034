//! A journal that writes what it is given, behind what it knows already.

use std::io::{self, Write};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use super::piece::{Piece, PieceKey, put_number};
use super::recording::{AFTER, BEFORE, END, Numbering, PIECE, Recording, after};
use super::{Answer, Journal, Share};

/// A journal that writes to anything that takes bytes. Each record is handed over whole, in one call of `write_all`, as soon as
/// its piece is done; when bytes reach a disk is for the writer to decide.
#[derive(Debug)]
pub struct Recorder<W> {
    known: Option<Recording>,
    share: Share,
    recalled: AtomicU64,
    pub(super) out: Mutex<Out<W>>,
}

#[derive(Debug)]
pub(super) struct Out<W> {
    pub(super) to: W,
    numbering: Numbering,
    recorded: u64,
    /// What went wrong first. Nothing is written after it: records must follow one another.
    failed: Option<io::Error>,
}

impl<W: Write + Send> Recorder<W> {
    /// A new journal; [`super::header_bytes`] of the same header must have been written.
    pub fn new(header: &str, share: Share, to: W) -> Recorder<W> {
        let out = Out { to, numbering: Numbering::after_header(header), recorded: 0, failed: None };
        Recorder { known: None, share, recalled: AtomicU64::new(0), out: Mutex::new(out) }
    }

    /// Goes on with a journal; the writer must stand at its [`Recording::whole_bytes`].
    pub fn resumed(known: Recording, share: Share, to: W) -> Recorder<W> {
        let out = Out { to, numbering: known.numbering, recorded: known.pieces(), failed: None };
        Recorder { known: Some(known), share, recalled: AtomicU64::new(0), out: Mutex::new(out) }
    }

    /// Pieces that did not have to be sampled again so far.
    pub fn recalled(&self) -> u64 {
        self.recalled.load(Ordering::Relaxed)
    }

    /// Says that all pieces are recorded, out of so many of the whole run, and returns the writer, flushed. A journal that says so
    /// already stays as it is.
    ///
    /// # Errors
    /// The first that the writer had, also while pieces were recorded.
    pub fn finish(self, pieces: u64) -> io::Result<W> {
        let ended = self.is_complete();
        let mut out = self.out.into_inner().unwrap_or_else(PoisonError::into_inner);
        if !ended {
            let mut frame = vec![0; BEFORE];
            frame.push(END);
            put_number(out.recorded, &mut frame);
            put_number(pieces, &mut frame);
            out.append(sealed(frame));
        }
        match out.failed {
            Some(error) => Err(error),
            None => out.to.flush().map(|()| out.to),
        }
    }

    fn is_complete(&self) -> bool {
        self.known.as_ref().is_some_and(|known| known.completion().is_some())
    }

    fn out(&self) -> MutexGuard<'_, Out<W>> {
        self.out.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<W: Write> Out<W> {
    /// Writes a record that lacks only what stands before its payload.
    fn append(&mut self, mut frame: Vec<u8>) {
        if self.failed.is_some() {
            return;
        }
        let Some(before) = self.numbering.before(frame.len() - BEFORE - AFTER) else {
            self.failed = Some(io::Error::new(io::ErrorKind::FileTooLarge, "a record of more than 4 GiB"));
            return;
        };
        frame[..BEFORE].copy_from_slice(&before);
        self.failed = self.to.write_all(&frame).err();
    }
}

/// A record with its checksum; the bytes before its payload are for when its number is known.
fn sealed(mut frame: Vec<u8>) -> Vec<u8> {
    let checksum = after(&frame[BEFORE..]);
    frame.extend_from_slice(&checksum);
    frame
}

impl<W: Write + Send> Journal for Recorder<W> {
    fn ask(&self, index: u64, key: &PieceKey) -> Answer {
        if !self.share.holds(index) {
            return Answer::Elsewhere;
        }
        match self.known.as_ref().and_then(|known| known.recall(key)) {
            Some(piece) => {
                self.recalled.fetch_add(1, Ordering::Relaxed);
                Answer::Known(piece)
            }
            // A journal that says that it is finished and lacks a piece is not one of this run.
            None if self.is_complete() => Answer::Elsewhere,
            None => Answer::Wanted,
        }
    }

    fn record(&self, key: &PieceKey, piece: &Piece) {
        let mut frame = Vec::with_capacity(96 + 8 * (piece.sums.len() + piece.potential.len()));
        frame.extend_from_slice(&[0; BEFORE]);
        frame.push(PIECE);
        piece.to_bytes(key, &mut frame);
        let frame = sealed(frame);
        let mut out = self.out();
        out.append(frame);
        out.recorded += 1;
    }
}
