//! Work that is done once: the pieces of a run, written down so that a run can be resumed, shared and repeated.
//!
//! ```text
//! piece    (instrument, pose, trial | reading, job, first, count) → sums      a pure function of scene, plan, seed and key
//! run      a deterministic function of its pieces, and of the rounds after which a clock ended it, if one did
//! ```
//!
//! A run asks its journal for a piece before it samples it, and hands over every piece that it samples. So a run that is resumed is
//! one whose journal knows some pieces already, and a run merged from shares one whose journal knows them all: the recorded numbers
//! have all their bits, sums are folded in the order of the run, and the readings have the bits of an uninterrupted run.
//! What needs no samples is computed anew; it is cheap.
//!
//! | file | what |
//! |---|---|
//! | `piece.rs` | a piece and its key, as bytes |
//! | `recording.rs` | the bytes of a whole journal: header, records, checksums; what is torn and what is damaged |
//! | `recorder.rs` | a journal that writes: new, resumed, or of one share of the pieces |
//! | `shares.rs` | a journal of several recordings that make a whole |
//! | `checksum.rs` | XXH64 |

mod checksum;
mod piece;
mod recorder;
mod recording;
mod shares;

#[cfg(test)]
mod tests;

pub use piece::{Piece, PieceKey};
pub use recorder::Recorder;
pub use recording::{Completion, Recording, RecordingError, header_bytes};
pub use shares::Shares;

/// What a journal knows of a piece.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    /// It has been sampled.
    Known(Piece),
    /// It has not been sampled and shall be.
    Wanted,
    /// It shall not be sampled here.
    Elsewhere,
}

/// Where a run looks before it samples. Pieces are asked for and recorded on several threads, in any order.
pub trait Journal: Sync {
    /// What is known of a piece. `index` numbers the pieces of the run, those of one job one after the other; it is the same
    /// whatever the number of threads.
    fn ask(&self, index: u64, key: &PieceKey) -> Answer;

    /// Takes down a piece that has been sampled.
    fn record(&self, key: &PieceKey, piece: &Piece);

    /// The rounds after which a clock ended each batch of poses, when a run is repeated that one ended; the clock of the present
    /// run does not count then.
    fn rounds(&self) -> Option<&[u32]> {
        None
    }
}

/// No journal: everything is sampled.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unrecorded;

impl Journal for Unrecorded {
    fn ask(&self, _: u64, _: &PieceKey) -> Answer {
        Answer::Wanted
    }

    fn record(&self, _: &PieceKey, _: &Piece) {}
}

/// A run that a clock ended, to be done again: it ends after the same rounds.
#[derive(Clone, Debug)]
pub struct Rounds(pub Vec<u32>);

impl Journal for Rounds {
    fn ask(&self, _: u64, _: &PieceKey) -> Answer {
        Answer::Wanted
    }

    fn record(&self, _: &PieceKey, _: &Piece) {}

    fn rounds(&self) -> Option<&[u32]> {
        Some(&self.0)
    }
}

/// One share of the pieces of a run: those whose index is `number − 1` modulo `of`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Share {
    /// Which share, from 1.
    pub number: u32,
    /// How many shares make the whole.
    pub of: u32,
}

impl Share {
    /// All pieces.
    pub const WHOLE: Share = Share { number: 1, of: 1 };

    /// The share with this number of so many; `None` unless 1 ≤ `number` ≤ `of`.
    #[must_use]
    pub fn new(number: u32, of: u32) -> Option<Share> {
        (1..=of).contains(&number).then_some(Share { number, of })
    }

    /// Whether a piece is in this share.
    #[must_use]
    pub fn holds(self, index: u64) -> bool {
        index % u64::from(self.of.max(1)) + 1 == u64::from(self.number)
    }
}
