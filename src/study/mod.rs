//! Studies: what the program's readings are worth.
//!
//! | module | what it asks |
//! |---|---|
//! | [`coverage`] | how often the interval of a sampled reading covers the truth |
//! | [`calibrate`] | which responsivity a campaign finds, how well, and what it does not see |
//! | [`converge`] | true error and claimed uncertainty against run time |
//! | [`savings`] | what each rule of the plan saves |
//! | [`stability`] | where readings of stiff and extreme scenes begin to fail |
//! | [`verify`] | does every reference case come out, on this machine |
//!
//! A study measures like anybody else and looks only at readings; the clocks are lent by the shell.

pub mod calibrate;
pub mod converge;
pub mod coverage;
pub mod savings;
pub mod stability;
pub mod verify;

/// What the shell lends to a study: clocks and an ear.
pub struct StudyWatch<'a> {
    /// Wall time, seconds since any fixed moment.
    pub now: &'a (dyn Fn() -> f64 + Sync),
    /// Processor time of all threads of this process, seconds since any fixed moment.
    pub cpu: &'a (dyn Fn() -> f64 + Sync),
    /// Told the share of the study that is done, 0 to 1, now and then.
    pub progress: &'a (dyn Fn(f64) + Sync),
}
