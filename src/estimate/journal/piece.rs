//! A piece of work and what it brought, as bytes.
//!
//! ```text
//! bytes = instrument pose reading job first count connections clear rays samples escaped n m   (LEB128)   n + m doubles (little-endian)
//! ```
//!
//! | symbol | meaning |
//! |---|---|
//! | n | sums: replicates × groups × nodes |
//! | m | potentials, a group each |

use crate::estimate::{Counters, REPLICATES};

/// Which points of which integral: the points `first .. first + count` of all replicates of a job in a pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct PieceKey {
    /// Index of the instrument in its scene.
    pub instrument: u64,
    /// Index of its pose.
    pub pose: u64,
    /// Whether the points are reported, or only find out how many are needed.
    pub reading: bool,
    /// Index of the sampled contribution among those of the instrument.
    pub job: u64,
    /// The first point of each replicate.
    pub first: u32,
    /// Points of each replicate.
    pub count: u32,
}

/// What a piece of work brought: sums of all replicates.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    pub(in crate::estimate) sums: Vec<f64>,
    pub(in crate::estimate) connections: u64,
    pub(in crate::estimate) clear: u64,
    pub(in crate::estimate) potential: Vec<f64>,
    pub(in crate::estimate) counters: Counters,
}

/// Rays that a piece may claim to have traced: more than any piece can.
const MOST_RAYS: u64 = 1 << 40;

impl Piece {
    /// Whether this can be what a job of this width brings for so many points: bytes come from outside.
    pub(in crate::estimate) fn fits(&self, width: usize, count: u32) -> bool {
        let samples = u64::from(count) * REPLICATES as u64;
        self.sums.len() == REPLICATES * width
            && self.counters.samples == samples
            && self.connections <= samples
            && self.clear <= self.connections
            && self.counters.escaped_paths <= samples
            && self.counters.rays <= MOST_RAYS
            && self.potential.len() <= width
    }

    pub(super) fn to_bytes(&self, key: &PieceKey, bytes: &mut Vec<u8>) {
        let c = &self.counters;
        let numbers = [
            key.instrument,
            key.pose,
            u64::from(key.reading),
            key.job,
            u64::from(key.first),
            u64::from(key.count),
            self.connections,
            self.clear,
            c.rays,
            c.samples,
            c.escaped_paths,
            self.sums.len() as u64,
            self.potential.len() as u64,
        ];
        bytes.reserve(5 * numbers.len() + 8 * (self.sums.len() + self.potential.len()));
        numbers.iter().for_each(|&n| put_number(n, bytes));
        self.sums.iter().chain(&self.potential).for_each(|x| bytes.extend_from_slice(&x.to_le_bytes()));
    }

    /// Key and piece; `None` for bytes that are not those of a piece.
    pub(super) fn from_bytes(mut bytes: &[u8]) -> Option<(PieceKey, Piece)> {
        let key = PieceKey::take(&mut bytes)?;
        let mut numbers = [0; 7];
        for n in &mut numbers {
            *n = take_number(&mut bytes)?;
        }
        let [connections, clear, rays, samples, escaped_paths, n, m] = numbers;
        if n.checked_add(m)?.checked_mul(8)? != bytes.len() as u64 {
            return None;
        }
        let mut doubles = bytes.chunks_exact(8).filter_map(|b| Some(f64::from_le_bytes(b.try_into().ok()?)));
        let sums = doubles.by_ref().take(usize::try_from(n).ok()?).collect();
        let counters = Counters { rays, samples, escaped_paths, ..Counters::default() };
        Some((key, Piece { sums, connections, clear, potential: doubles.collect(), counters }))
    }
}

impl PieceKey {
    /// The key at the beginning of the bytes of a piece.
    pub(super) fn take(bytes: &mut &[u8]) -> Option<PieceKey> {
        let instrument = take_number(bytes)?;
        let pose = take_number(bytes)?;
        let reading = match take_number(bytes)? {
            0 => false,
            1 => true,
            _ => return None,
        };
        let job = take_number(bytes)?;
        let first = u32::try_from(take_number(bytes)?).ok()?;
        let count = u32::try_from(take_number(bytes)?).ok()?;
        Some(PieceKey { instrument, pose, reading, job, first, count })
    }
}

/// Appends a number in base 128, the lowest digit first; the eighth bit says that more follow.
pub(super) fn put_number(mut n: u64, bytes: &mut Vec<u8>) {
    while n >= 0x80 {
        bytes.push(n as u8 | 0x80);
        n >>= 7;
    }
    bytes.push(n as u8);
}

/// Takes a number off the beginning; `None` where there is none, or one beyond 64 bits.
pub(super) fn take_number(bytes: &mut &[u8]) -> Option<u64> {
    let mut n = 0u64;
    for shift in (0..64).step_by(7) {
        let (&byte, rest) = bytes.split_first()?;
        *bytes = rest;
        let digit = u64::from(byte & 0x7f);
        if (digit << shift) >> shift != digit {
            return None;
        }
        n |= digit << shift;
        if byte & 0x80 == 0 {
            return Some(n);
        }
    }
    None
}
