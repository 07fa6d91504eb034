//! A journal of several recordings, each of one share of the pieces of a run.

use std::sync::atomic::{AtomicU64, Ordering};

use super::{Answer, Journal, Piece, PieceKey, Recording};

/// Recordings that make a whole, in the order of their shares. Nothing is sampled: a piece that none holds is missing.
#[derive(Debug)]
pub struct Shares {
    recordings: Vec<Recording>,
    recalled: AtomicU64,
}

impl Shares {
    /// The recordings of the shares 1, 2, … of a run, in this order.
    #[must_use]
    pub fn new(recordings: Vec<Recording>) -> Shares {
        Shares { recordings, recalled: AtomicU64::new(0) }
    }

    /// Pieces that were recorded and have not been asked for: more than zero after a run means that the recordings are of another one.
    #[must_use]
    pub fn left_over(&self) -> u64 {
        let recorded: u64 = self.recordings.iter().map(Recording::pieces).sum();
        recorded.saturating_sub(self.recalled.load(Ordering::Relaxed))
    }
}

impl Journal for Shares {
    fn ask(&self, index: u64, key: &PieceKey) -> Answer {
        let of = self.recordings.len().max(1) as u64;
        match self.recordings.get((index % of) as usize).and_then(|recording| recording.recall(key)) {
            Some(piece) => {
                self.recalled.fetch_add(1, Ordering::Relaxed);
                Answer::Known(piece)
            }
            None => Answer::Elsewhere,
        }
    }

    fn record(&self, _: &PieceKey, _: &Piece) {}
}
