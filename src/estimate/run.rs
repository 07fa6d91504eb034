//! Threads. Work is cut into pieces that do not depend on their number, and results come back in the order of the pieces: sums
//! that are folded in that order have the same bits on one thread and on a hundred.

use rayon::prelude::*;

/// Applies `work` to every piece, on all threads of the current pool; the results are in the order of the pieces.
pub(super) fn in_order<P: Sync, R: Send>(pieces: &[P], work: impl Fn(&P) -> R + Sync + Send) -> Vec<R> {
    pieces.par_iter().map(work).collect()
}

/// Applies `work` to pieces of `length` items of `whole`, on all threads of the current pool; each is told the index of its first item.
pub(super) fn in_pieces<T: Send>(whole: &mut [T], length: usize, work: impl Fn(usize, &mut [T]) + Sync + Send) {
    let length = length.max(1);
    whole.par_chunks_mut(length).enumerate().for_each(|(i, piece)| work(i * length, piece));
}

/// Runs `work` on a pool of so many threads; `None`, or a pool that cannot be had, means as many as there are cores.
pub fn with_threads<R: Send>(threads: Option<usize>, work: impl FnOnce() -> R + Send) -> R {
    match rayon::ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0)).build() {
        Ok(pool) => pool.install(work),
        Err(_) => work(),
    }
}
