//! Seconds of the processor that the calling thread has used.
//!
//! Linux counts them in nanoseconds in `/proc/thread-self/schedstat`, but brings the count up to date only when the scheduler runs;
//! giving up the processor for a moment makes it run. Elsewhere there is no such count, and the wall clock stands in for it.

use std::time::Instant;

/// A stop watch for one thread.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clock {
    wall: Instant,
    cpu_s: Option<f64>,
}

impl Clock {
    /// Starts now.
    pub(crate) fn start() -> Clock {
        let cpu_s = thread_cpu_s();
        Clock { wall: Instant::now(), cpu_s }
    }

    /// Wall and processor seconds since the start. Without a count of the processor both are wall seconds.
    pub(crate) fn stop(self) -> (f64, f64) {
        let wall_s = self.wall.elapsed().as_secs_f64();
        let cpu_s = self.cpu_s.zip(thread_cpu_s()).map(|(from, to)| to - from);
        (wall_s, cpu_s.unwrap_or(wall_s))
    }

    /// What is counted as seconds of the processor, in words.
    pub(crate) fn kind() -> &'static str {
        if thread_cpu_s().is_some() {
            "CPU time of the thread (schedstat)"
        } else {
            "wall clock: this system does not count the time of a thread"
        }
    }
}

fn thread_cpu_s() -> Option<f64> {
    std::thread::yield_now();
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds: u64 = text.split_whitespace().next()?.parse().ok()?;
    Some(nanoseconds as f64 * 1e-9)
}
