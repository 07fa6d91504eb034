//! Processor time of this program, which a busy machine does not stretch as it does the time on the wall.

use std::time::Instant;

/// Ticks of Linux a second.
const TICKS_PER_S: f64 = 100.0;

/// Seconds that all threads have worked, in steps of 10 ms; `None` where `/proc` does not say.
fn worked_s() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/stat").ok()?;
    // The name of the program stands in brackets and may hold blanks.
    let fields: Vec<&str> = status.rsplit_once(')')?.1.split_whitespace().collect();
    let ticks = fields.get(11)?.parse::<f64>().ok()? + fields.get(12)?.parse::<f64>().ok()?;
    Some(ticks / TICKS_PER_S)
}

/// What some work took, in words and in seconds: processor time, or where that is not known time on the wall.
pub(crate) fn timed(work: impl FnOnce()) -> (f64, &'static str) {
    let (start, before) = (Instant::now(), worked_s());
    work();
    match before.zip(worked_s()) {
        Some((before, after)) => (after - before, "of processor time"),
        None => (start.elapsed().as_secs_f64(), "on the wall"),
    }
}
