//! Intervals that hold: how often the 95 % interval of a sampled reading covers the truth, with the stopping rule on.
//!
//! ```text
//! N runs, each with a seed of its own:      δ = S − S₀
//! covered      |δ| ≤ √(U² + (k u₀)²)        U = k u_c of the run, u₀ the uncertainty of the truth
//! limit        0.95 − 3 √(0.95 · 0.05 / N)  three standard deviations of a binomial share
//! bias         mean δ / √(s²/N + u₀²)       s the standard deviation of δ
//! claimed      mean u_c / √(mean δ²)
//! ```
//!
//! | file | what |
//! |---|---|
//! | `run.rs` | the runs of a scene, until all seeds are done or the time is over |
//! | `truth.rs` | what they are held to: a closed form, or a long run |
//! | `subset.rs` | the poses of a grid that are read |
//! | `tally.rs` | from runs to rows and verdicts |
//!
//! Every pose of an instrument has random numbers of its own, so poses of one seed are independent, and the poses of an instrument
//! that has several are pooled: N counts readings. Channels of one pose share their paths and are rows of their own. Seed 0 of the
//! study is that of the long run, the runs follow it; nothing is held to its own numbers.

mod run;
mod subset;
mod tally;
mod truth;

pub use run::{CoverageError, SceneCoverage, coverage};
pub use tally::{CoverageRow, Run, Tally, Verdict, lowest_share};
pub use truth::{Truth, TruthOrigin};

/// How to study.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoverageOptions {
    /// Runs of each scene, 2 or more; fewer are made where the budget ends before.
    pub seeds: u64,
    /// Seed of the long run; those of the runs follow it.
    pub seed: u64,
    /// The stopping rule's target: U over the value.
    pub target: f64,
    /// Wall time of a scene, s.
    pub budget_seconds: f64,
    /// Poses of an instrument that are read; of more, so many that are evenly spread over their order.
    pub most_poses: usize,
}

impl Default for CoverageOptions {
    fn default() -> CoverageOptions {
        CoverageOptions { seeds: 1000, seed: 0, target: 0.05, budget_seconds: 30.0, most_poses: 16 }
    }
}
