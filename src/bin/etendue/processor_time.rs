//! Processor time of this process.
//!
//! The standard library has no such clock. Linux counts the nanoseconds that each thread ran in `/proc/self/task/*/schedstat`;
//! elsewhere wall time × threads stands in, which is never less.

use std::time::Instant;

/// A clock of the processor time that all threads took.
pub(crate) struct ProcessorClock {
    start: Instant,
    threads: u64,
    counted: bool,
}

impl ProcessorClock {
    /// A clock for runs on so many threads.
    pub(crate) fn new(threads: u64) -> ProcessorClock {
        ProcessorClock { start: Instant::now(), threads, counted: counted_seconds().is_some() }
    }

    /// Seconds since any fixed moment.
    pub(crate) fn seconds(&self) -> f64 {
        let bound = || self.start.elapsed().as_secs_f64() * self.threads as f64;
        if self.counted { counted_seconds().unwrap_or_else(bound) } else { bound() }
    }

    /// What is reported.
    pub(crate) fn in_words(&self) -> &'static str {
        match (self.counted, self.threads) {
            (true, _) => "CPU time is what the threads really ran (/proc/self/task/*/schedstat)",
            (false, 1) => "CPU time is wall time: this system counts no other",
            (false, _) => "CPU time is wall time times threads: this system counts no other",
        }
    }
}

fn counted_seconds() -> Option<f64> {
    // A thread is charged when the scheduler looks at it, at the latest every few milliseconds: this makes it look.
    std::thread::yield_now();
    let mut nanoseconds = 0u64;
    for task in std::fs::read_dir("/proc/self/task").ok()? {
        // A thread that has just ended is no more there.
        let Ok(text) = std::fs::read_to_string(task.ok()?.path().join("schedstat")) else { continue };
        nanoseconds += text.split_whitespace().next()?.parse::<u64>().ok()?;
    }
    (nanoseconds > 0).then_some(nanoseconds as f64 * 1e-9)
}
