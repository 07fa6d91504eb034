//! Laws of a journal: what was written reads back, what was torn is cut, what was changed is told.

#![allow(clippy::unwrap_used)]

use proptest::prelude::*;

use super::*;
use crate::estimate::{Counters, REPLICATES};

const HEADER: &str = "version: 1\nseed: 7\n";

fn piece(width: usize, seed: u64) -> (PieceKey, Piece) {
    let key = PieceKey { instrument: seed % 3, pose: seed, reading: seed % 2 == 1, job: seed % 5, first: seed as u32 * 16, count: 16 };
    // Every kind of double: subnormal, huge, negative zero.
    let x = |i: usize| [1.5e-310, -0.0, 1e300, f64::from(seed as u32) / 3.0][i % 4];
    let sums = (0..REPLICATES * width).map(x).collect();
    let counters = Counters { rays: seed << 20, samples: 256, escaped_paths: seed % 256, ..Counters::default() };
    (key, Piece { sums, connections: 200, clear: 100, potential: vec![2.0 / 3.0; width], counters })
}

/// A journal of so many pieces, and where each record ends.
fn written(pieces: u64, ended: bool) -> (Vec<u8>, Vec<usize>) {
    let mut recorder = Recorder::new(HEADER, Share::WHOLE, header_bytes(HEADER));
    let mut ends = Vec::new();
    for n in 0..pieces {
        let (key, piece) = piece(1 + n as usize % 3, n);
        recorder.record(&key, &piece);
        ends.push(recorder.written());
    }
    if ended {
        let bytes = recorder.finish(pieces).unwrap();
        ends.push(bytes.len());
        return (bytes, ends);
    }
    (recorder.into_writer(), ends)
}

impl Recorder<Vec<u8>> {
    fn written(&mut self) -> usize {
        self.out.get_mut().unwrap().to.len()
    }

    fn into_writer(self) -> Vec<u8> {
        self.out.into_inner().unwrap().to
    }
}

#[test]
fn what_was_written_reads_back() {
    let (bytes, _) = written(20, true);
    let recording = Recording::read(bytes).unwrap();
    assert_eq!((recording.header(), recording.pieces(), recording.torn_bytes()), (HEADER, 20, 0));
    assert_eq!(recording.completion(), Some(Completion { recorded: 20, pieces: 20 }));
    for n in 0..20 {
        let (key, piece) = piece(1 + n as usize % 3, n);
        let found = recording.recall(&key).unwrap();
        assert_eq!(found, piece);
        // Equal numbers may differ in their sign of zero.
        assert!(found.sums.iter().zip(&piece.sums).all(|(a, b)| a.to_bits() == b.to_bits()));
    }
}

#[test]
fn a_journal_that_is_resumed_has_the_bytes_of_one_that_was_not_interrupted() {
    let (whole, ends) = written(9, true);
    for cut in 0..whole.len() {
        let Ok(recording) = Recording::read(whole[..cut].to_vec()) else {
            assert!(cut < header_bytes(HEADER).len(), "{cut}");
            continue;
        };
        let kept = ends.iter().filter(|&&end| end <= cut).count();
        assert_eq!(recording.pieces(), kept.min(9) as u64);
        let to = whole[..recording.whole_bytes()].to_vec();
        let recorder = Recorder::resumed(recording, Share::WHOLE, to);
        for n in kept as u64..9 {
            let (key, piece) = piece(1 + n as usize % 3, n);
            assert_eq!(recorder.ask(0, &key), Answer::Wanted);
            recorder.record(&key, &piece);
        }
        assert_eq!(recorder.finish(9).unwrap(), whole, "{cut}");
    }
}

#[test]
fn no_changed_bit_passes() {
    let (whole, ends) = written(3, true);
    for at in 0..whole.len() {
        for bit in 0..8 {
            let mut bytes = whole.clone();
            bytes[at] ^= 1 << bit;
            assert!(Recording::read(bytes).is_err(), "bit {bit} of byte {at}");
        }
    }
    assert_eq!(ends.len(), 4);
}

#[test]
fn no_record_may_be_taken_out_doubled_or_moved_or_come_from_elsewhere() {
    let (whole, ends) = written(4, true);
    let start = header_bytes(HEADER).len();
    let edges: Vec<usize> = std::iter::once(start).chain(ends).collect();
    let record = |n: usize| &whole[edges[n]..edges[n + 1]];
    let damaged_at = |records: &[&[u8]]| match Recording::read([&whole[..start], &records.concat()].concat()) {
        Err(RecordingError::Damaged { number, .. }) => number,
        other => panic!("{other:?}"),
    };
    assert_eq!(damaged_at(&[record(0), record(2), record(3)]), 2, "taken out");
    assert_eq!(damaged_at(&[record(0), record(0), record(1)]), 2, "doubled");
    assert_eq!(damaged_at(&[record(1), record(0)]), 1, "moved");
    assert_eq!(damaged_at(&[record(0), record(1), record(2), record(3), record(4), record(0)]), 6, "behind the end");
    let other = "version: 1\nseed: 8\n";
    let recorder = Recorder::new(other, Share::WHOLE, header_bytes(other));
    recorder.record(&piece(1, 0).0, &piece(1, 0).1);
    let foreign = recorder.into_writer();
    assert_eq!(damaged_at(&[&foreign[header_bytes(other).len()..]]), 1, "of another journal");
}

#[test]
fn other_files_are_told() {
    assert_eq!(Recording::read(b"Scene()".to_vec()).unwrap_err(), RecordingError::NotARecording);
    assert_eq!(Recording::read(Vec::new()).unwrap_err(), RecordingError::NotARecording);
    let later = b"etendue checkpoint, format 2\nwhatever".to_vec();
    assert_eq!(Recording::read(later).unwrap_err(), RecordingError::OtherFormat { found: "2".to_owned() });
    let mut edited = header_bytes(HEADER);
    let at = edited.len() - 2;
    edited[at] = b'8';
    assert_eq!(Recording::read(edited).unwrap_err(), RecordingError::Header);
}

#[test]
fn a_writer_that_fails_is_told_at_the_end_and_gets_no_more_records() {
    struct Full(usize);
    impl std::io::Write for Full {
        fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
            self.0 += 1;
            if self.0 == 2 { Err(std::io::Error::from(std::io::ErrorKind::StorageFull)) } else { Ok(bytes.len()) }
        }
        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }
    let recorder = Recorder::new(HEADER, Share::WHOLE, Full(0));
    (0..5).for_each(|n| recorder.record(&piece(1, n).0, &piece(1, n).1));
    assert_eq!(recorder.out.lock().unwrap().to.0, 2);
    assert_eq!(recorder.finish(5).map(|_| ()).unwrap_err().kind(), std::io::ErrorKind::StorageFull);
}

#[test]
fn every_piece_is_in_one_share() {
    for of in 1..7 {
        for index in 0..100 {
            assert_eq!((1..=of).filter(|&number| Share::new(number, of).unwrap().holds(index)).count(), 1);
        }
    }
    assert_eq!((Share::new(0, 3), Share::new(4, 3), Share::new(0, 0)), (None, None, None));
}

proptest! {
    #[test]
    fn numbers_read_back(n in any::<u64>(), shift in 0u32..64) {
        let n = n >> shift;
        let mut bytes = Vec::new();
        piece::put_number(n, &mut bytes);
        let mut rest = &bytes[..];
        prop_assert_eq!(piece::take_number(&mut rest), Some(n));
        prop_assert!(rest.is_empty());
    }

    #[test]
    fn no_bytes_make_it_panic(noise in proptest::collection::vec(any::<u8>(), 0..200), after in 0usize..4) {
        let (mut bytes, ends) = written(3, false);
        bytes.truncate(if after == 0 { 20 } else { ends[after - 1] });
        bytes.extend_from_slice(&noise);
        let _ = Recording::read(bytes);
        let _ = Piece::from_bytes(&noise);
    }
}
