//! Studies: a scene measured many times over, to find out what its readings are worth.
//!
//! | file | what |
//! |---|---|
//! | `converge/` | true error and claimed uncertainty against run time |
//!
//! A study measures like anybody else and looks only at readings; the clocks are lent by the shell.

pub mod converge;

/// What the shell lends to a study: clocks and an ear.
pub struct StudyWatch<'a> {
    /// Wall time, seconds since any fixed moment.
    pub now: &'a (dyn Fn() -> f64 + Sync),
    /// Processor time of all threads of this process, seconds since any fixed moment.
    pub cpu: &'a (dyn Fn() -> f64 + Sync),
    /// Told the share of the study that is done, 0 to 1, now and then.
    pub progress: &'a (dyn Fn(f64) + Sync),
}
