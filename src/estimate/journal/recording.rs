//! The bytes of a journal: a header in words, then records that are only ever appended.
//!
//! ```text
//! file    = "etendue checkpoint, format 1\n"  "header LENGTH CHECKSUM\n"  header  record*
//! record  = length (u32)  check (u32)  payload  checksum of the payload (u64)          little-endian
//! check   = low half of XXH64(number of the record, length) with the checksum of the header as its seed
//! payload = 1 piece | 2 records pieces        the second kind ends a finished journal
//! ```
//!
//! | what happened to the file | what is made of it |
//! |---|---|
//! | it ends within a record: the writer was killed | the torn end is no part of the recording; everything before it counts |
//! | a byte was changed, cut out or put in; a record was taken out, doubled, moved, or comes from another file | an error that names the record |
//! | it ends after a whole record | a recording that has not got further |
//!
//! `check` is what tells the first from the second: a length that was edited does not pass for a torn end, and no record stands at
//! another place than its own.

use std::collections::HashMap;

use super::checksum::xxh64;
use super::piece::{Piece, PieceKey, take_number};

const MAGIC: &[u8] = b"etendue checkpoint, format ";
const FORMAT: &str = "1";
/// Bytes of a record before and after its payload.
pub(super) const BEFORE: usize = 8;
pub(super) const AFTER: usize = 8;
pub(super) const PIECE: u8 = 1;
pub(super) const END: u8 = 2;

/// Why bytes are not a recording.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RecordingError {
    /// Something else altogether.
    #[error("it is not a checkpoint of this program")]
    NotARecording,
    /// Of a later or an earlier program.
    #[error("it is a checkpoint of format {found}; this program writes and reads format {FORMAT}")]
    OtherFormat {
        /// The format that it has.
        found: String,
    },
    /// The header was cut or edited.
    #[error("its header is cut short or was edited")]
    Header,
    /// A record was edited, moved, taken out or put in.
    #[error("record {number}, {offset} bytes into the file, is damaged: {why}")]
    Damaged {
        /// Number of the record, from 1.
        number: u64,
        /// Bytes before it.
        offset: usize,
        /// What is wrong with it.
        why: &'static str,
    },
}

/// How a finished journal ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Completion {
    /// Pieces that are recorded.
    pub recorded: u64,
    /// Pieces of the whole run, all shares together.
    pub pieces: u64,
}

/// A journal that was read back.
#[derive(Clone, Debug)]
pub struct Recording {
    bytes: Vec<u8>,
    header: String,
    /// Where the payload of each piece lies.
    places: HashMap<PieceKey, (usize, usize)>,
    completion: Option<Completion>,
    whole: usize,
    pub(super) numbering: Numbering,
}

/// The number of the next record, and what its check depends on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Numbering {
    seed: u64,
    next: u64,
}

impl Numbering {
    pub(super) fn after_header(header: &str) -> Numbering {
        Numbering { seed: xxh64(0, header.as_bytes()), next: 0 }
    }

    fn check(self, length: u32) -> u32 {
        let mut bytes = [0; 12];
        bytes[..8].copy_from_slice(&self.next.to_le_bytes());
        bytes[8..].copy_from_slice(&length.to_le_bytes());
        xxh64(self.seed, &bytes) as u32
    }

    /// What stands before a payload of this length in the next record; `None` for one that is too long for a record.
    pub(super) fn before(&mut self, payload: usize) -> Option<[u8; BEFORE]> {
        let length = u32::try_from(payload).ok()?;
        let mut bytes = [0; BEFORE];
        bytes[..4].copy_from_slice(&length.to_le_bytes());
        bytes[4..].copy_from_slice(&self.check(length).to_le_bytes());
        self.next += 1;
        Some(bytes)
    }
}

/// What stands after the payload of a record.
pub(super) fn after(payload: &[u8]) -> [u8; AFTER] {
    xxh64(0, payload).to_le_bytes()
}

/// The bytes with which a new journal begins. The header is free text, such as who may resume it.
#[must_use]
pub fn header_bytes(header: &str) -> Vec<u8> {
    let mut bytes = MAGIC.to_vec();
    bytes.extend_from_slice(format!("{FORMAT}\nheader {} {:016x}\n{header}", header.len(), xxh64(0, header.as_bytes())).as_bytes());
    bytes
}

impl Recording {
    /// Reads a journal back.
    ///
    /// # Errors
    /// When the bytes are no journal, or were changed after they were written. A torn end is no error: see [`Recording::whole_bytes`].
    pub fn read(bytes: Vec<u8>) -> Result<Recording, RecordingError> {
        let (header, mut at) = header_of(&bytes)?;
        let header = header.to_owned();
        let mut numbering = Numbering::after_header(&header);
        let mut places = HashMap::new();
        let mut completion = None;
        while at < bytes.len() {
            let damaged = |why| RecordingError::Damaged { number: numbering.next + 1, offset: at, why };
            let Some(&[a, b, c, d, check @ ..]) = bytes[at..].first_chunk::<BEFORE>() else { break };
            let length = u32::from_le_bytes([a, b, c, d]);
            if numbering.check(length).to_le_bytes() != check {
                return Err(damaged("its length does not belong to a record at this place"));
            }
            if completion.is_some() {
                return Err(damaged("it stands behind the end"));
            }
            let (from, to) = (at + BEFORE, at + BEFORE + length as usize);
            let Some(checksum) = bytes.get(to..to + AFTER) else { break };
            let payload = &bytes[from..to];
            if after(payload) != checksum {
                return Err(damaged("its checksum is not that of its bytes"));
            }
            match payload.split_first() {
                Some((&PIECE, mut piece)) => {
                    let key = PieceKey::take(&mut piece).ok_or_else(|| damaged("it holds no piece of work"))?;
                    if places.insert(key, (from + 1, to)).is_some() {
                        return Err(damaged("it holds a piece of work that an earlier record holds as well"));
                    }
                }
                Some((&END, mut numbers)) => {
                    let recorded = take_number(&mut numbers);
                    let pieces = take_number(&mut numbers);
                    let (Some(recorded), Some(pieces)) = (recorded, pieces) else { return Err(damaged("it is no end")) };
                    if recorded != places.len() as u64 {
                        return Err(damaged("it ends another number of records"));
                    }
                    completion = Some(Completion { recorded, pieces });
                }
                _ => return Err(damaged("it is of no kind that is known")),
            }
            numbering.next += 1;
            at = to + AFTER;
        }
        Ok(Recording { bytes, header, places, completion, whole: at, numbering })
    }

    /// The header that it was begun with.
    #[must_use]
    pub fn header(&self) -> &str {
        &self.header
    }

    /// Pieces that are recorded.
    #[must_use]
    pub fn pieces(&self) -> u64 {
        self.places.len() as u64
    }

    /// How it ends, if it is finished.
    #[must_use]
    pub fn completion(&self) -> Option<Completion> {
        self.completion
    }

    /// Length of the header and all whole records, bytes: where the next record belongs.
    #[must_use]
    pub fn whole_bytes(&self) -> usize {
        self.whole
    }

    /// Length of the torn record at the end, bytes; zero when the writer was not interrupted.
    #[must_use]
    pub fn torn_bytes(&self) -> usize {
        self.bytes.len() - self.whole
    }

    /// A piece, if it is recorded.
    #[must_use]
    pub fn recall(&self, key: &PieceKey) -> Option<Piece> {
        let &(from, to) = self.places.get(key)?;
        Piece::from_bytes(&self.bytes[from..to]).map(|(_, piece)| piece)
    }
}

/// The header, and where the records begin.
fn header_of(bytes: &[u8]) -> Result<(&str, usize), RecordingError> {
    let rest = bytes.strip_prefix(MAGIC).ok_or(RecordingError::NotARecording)?;
    let line_of = |bytes: &'_ [u8]| bytes.iter().take(80).position(|&b| b == b'\n');
    let end = line_of(rest).ok_or(RecordingError::Header)?;
    if &rest[..end] != FORMAT.as_bytes() {
        return Err(RecordingError::OtherFormat { found: String::from_utf8_lossy(&rest[..end]).escape_default().to_string() });
    }
    let rest = &rest[end + 1..];
    let end = line_of(rest).ok_or(RecordingError::Header)?;
    let fields = std::str::from_utf8(&rest[..end]).ok().and_then(|line| line.strip_prefix("header ")?.split_once(' '));
    let (length, checksum) = fields.ok_or(RecordingError::Header)?;
    let length: usize = length.parse().map_err(|_| RecordingError::Header)?;
    let header = rest[end + 1..].get(..length).ok_or(RecordingError::Header)?;
    if format!("{:016x}", xxh64(0, header)) != checksum {
        return Err(RecordingError::Header);
    }
    let header = std::str::from_utf8(header).map_err(|_| RecordingError::Header)?;
    Ok((header, bytes.len() - rest.len() + end + 1 + length))
}
