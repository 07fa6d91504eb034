//! Noisy frames on all threads: expected electrons → digital numbers, frame after frame in the memory of one.
//!
//! A frame is cut into pieces of [`PIECE`] pixels; every pixel has random numbers of its own, so the bits are those of
//! [`Pixel::expose`](crate::sensor::Pixel::expose) whatever the number of threads.
//!
//! ```
//! use etendue::estimate::frames::expose_into;
//! use etendue::sensor::{Exposure, Pixel};
//!
//! let pixel = Pixel::ideal(0.25, 14000.0, 64.0, 12);
//! let expected = vec![1000.0f32; 64 * 64];
//! let mut frame = vec![0u16; expected.len()];
//! for number in 0..3 {
//!     expose_into(&pixel, &Exposure { exposure_s: 0.01, temperature_c: 20.0, seed: 1, frame: number }, &expected, &mut frame);
//!     assert_eq!(frame, pixel.expose(&expected, 0.01, 20.0, 1, number));
//! }
//! ```

use super::run::in_pieces;
use crate::sensor::{Exposure, Pixel};

/// Pixels that one thread exposes at a time.
pub const PIECE: usize = 1 << 14;

/// One frame into `digital`, on all threads of the current pool. As many pixels are filled as the shorter of the two slices has.
pub fn expose_into(pixel: &Pixel, of: &Exposure, electrons_e: &[f32], digital: &mut [u16]) {
    let length = digital.len().min(electrons_e.len());
    in_pieces(&mut digital[..length], PIECE, |first, piece| {
        pixel.expose_part(of, first as u64, &electrons_e[first..first + piece.len()], piece);
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimate::run::with_threads;

    #[test]
    fn threads_do_not_change_a_bit() {
        let pixel = Pixel { read_noise_e: 5.0, dsnu_e: 2.0, prnu: 0.01, ..Pixel::ideal(0.25, 14000.0, 64.0, 12) };
        let electrons: Vec<f32> = (0..3 * PIECE + 77).map(|i| i as f32 * 0.3).collect();
        let of = Exposure { exposure_s: 0.01, temperature_c: 20.0, seed: 9, frame: 4 };
        let alone = pixel.expose(&electrons, of.exposure_s, of.temperature_c, of.seed, of.frame);
        for threads in [1, 2, 5] {
            let mut frame = vec![0; electrons.len()];
            with_threads(Some(threads), || expose_into(&pixel, &of, &electrons, &mut frame));
            assert_eq!(frame, alone, "{threads} threads");
        }
    }
}
