//! Numbers for the terms of a plan: values with their spread, reproducible whatever the number of threads.
//!
//! ```text
//! deterministic terms  → one exact sum a channel
//! sampled terms        → jobs; each in 16 independent replicates of randomised quasi-Monte Carlo points
//! E_c = Σ exact + Σ_jobs mean of replicates        u from the spread of the replicates, 15 degrees of freedom
//! ```
//!
//! | file | what |
//! |---|---|
//! | `closed_form/` | formulas for unobstructed sources, as pure functions |
//! | `deterministic.rs` | the direct terms that have one |
//! | `all_round.rs` | the same at heads that have no horizon |
//! | `light.rs`, `receiver.rs` | the two ends of a connection |
//! | `direct.rs` | direct light of a source that may be hidden |
//! | `sky.rs` | direct light of an environment that may be hidden |
//! | `paths/` | reflected light |
//! | `camera/` | what the pixels of a camera receive |
//! | `job.rs`, `lanes.rs` | what these three have in common |
//! | `task.rs` | what is to be done for an instrument |
//! | `campaign.rs` | a run, batch by batch |
//! | `batch.rs` | how many samples for which job: the stopping rule |
//! | `frames.rs` | noisy frames of a camera pixel |
//! | `run.rs` | threads |
//! | `journal/` | work that is done once: resumed, shared and repeated runs |
//!
//! Values are weighted irradiances `∫ s(λ) E(λ) dλ`, means over the aperture; what an instrument makes of them is for
//! `measurement` to say. Sums are geometric until they are asked for a channel, so radiances of any size are safe.

mod all_round;
mod batch;
pub mod camera;
mod campaign;
pub mod closed_form;
mod deterministic;
mod direct;
pub mod frames;
mod job;
pub mod journal;
mod lanes;
mod light;
mod near_light;
mod paths;
mod receiver;
pub mod run;
mod sky;
mod task;

pub use campaign::{Tally, contribute, estimate, estimate_with};

/// Independent randomisations of every sampled term. Few replicates make a lucky small spread likely; many cost strata.
pub const REPLICATES: usize = 16;

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// Expanded uncertainty at 95 % over the value at which a reading is good enough, e.g. 0.01.
    pub target: Option<f64>,
    /// Seconds after which no further round of samples starts. Readings then depend on the speed of the machine; the number of
    /// samples that they state does not, and repeats them.
    pub budget_seconds: Option<f64>,
    /// Samples a job and pose, rounded up to 16 times a power of two; nothing else stops the run then.
    pub samples: Option<u64>,
}

impl Default for Stop {
    fn default() -> Stop {
        Stop { target: Some(0.01), budget_seconds: None, samples: None }
    }
}

/// What the shell lends to a run: a clock and an ear.
pub struct Watch<'a> {
    /// Seconds since any fixed moment.
    pub now: &'a (dyn Fn() -> f64 + Sync),
    /// Told the share of poses that are done, 0 to 1, now and then.
    pub progress: &'a (dyn Fn(f64) + Sync),
}

/// What was really done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Rays traced, shadow rays included.
    pub rays: u64,
    /// Points of the sampled integrals, over all replicates, jobs and poses.
    pub samples: u64,
    /// Nodes of the bounding volume hierarchies that were searched; zero if no ray was traced.
    pub bvh_nodes: u64,
    /// Wavelengths carried by paths, the largest number of any instrument; zero without paths.
    pub spectral_nodes: u64,
    /// Paths that left the scene without meeting anything.
    pub escaped_paths: u64,
}

impl Counters {
    pub(crate) fn add(&mut self, other: &Counters) {
        self.rays += other.rays;
        self.samples += other.samples;
        self.bvh_nodes = self.bvh_nodes.max(other.bvh_nodes);
        self.spectral_nodes = self.spectral_nodes.max(other.spectral_nodes);
        self.escaped_paths += other.escaped_paths;
    }
}

/// A value from a formula.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Exact {
    /// Weighted irradiance.
    pub value: f64,
    /// Estimated error of the quadratures in it; rounding is apart.
    pub quadrature_error: f64,
    /// Whether any term went into it.
    pub terms: usize,
}

/// A sampled contribution, as one channel sees it.
#[derive(Clone, Debug, PartialEq)]
pub struct Sampled {
    /// What was sampled, for the budget: "direct light of `panel`".
    pub label: String,
    /// The mean of each replicate.
    pub replicates: [f64; REPLICATES],
    /// Samples over all replicates.
    pub samples: u64,
    /// What may have been missed when every connection was clear, or none was: a bound, and why.
    pub missed: Option<(f64, String)>,
    /// What the wavelengths between the nodes may contribute, as a share of the value.
    pub spectral_residual: f64,
}

/// What a channel of an instrument receives in one pose.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ChannelEstimate {
    /// From formulas.
    pub exact: Exact,
    /// From samples.
    pub sampled: Vec<Sampled>,
}

/// One pose of an instrument.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PoseEstimate {
    /// A channel each.
    pub channels: Vec<ChannelEstimate>,
    /// Whether the target was met, or none was set.
    pub target_met: bool,
    /// Seconds that passed while the batch of poses was estimated, shared evenly.
    pub seconds: f64,
}

/// Everything that was estimated.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Estimates {
    /// `poses[instrument][pose]`.
    pub poses: Vec<Vec<PoseEstimate>>,
    /// What was really done.
    pub counters: Counters,
    /// Rounds of samples that each batch of poses took: with them a run that a clock ended can be repeated.
    pub rounds: Vec<u32>,
    /// Pieces of work that the samples were taken in.
    pub pieces: u64,
}

/// Why there is no estimate.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EstimateError {
    /// A reading beyond the range of double precision.
    #[error(
        "the reading of `{instrument}` is beyond the range of numbers, some 1e308: a source is too strong or too close; \
         give strengths and distances that a laboratory could have"
    )]
    OutOfRange {
        /// The instrument.
        instrument: String,
    },
    /// Light is never absorbed.
    #[error(
        "the instrument `{instrument}` has no finite reading: a path was reflected 100000 times without loss. \
         A closed space with reflectance 1 stores light without end; give its surfaces a reflectance below 1"
    )]
    Endless {
        /// The instrument.
        instrument: String,
    },
    /// There is no plan for a companion of an instrument: an error of the program.
    #[error("internal error: a companion of an instrument cannot be planned: {why}; please report this")]
    Companion {
        /// What planning said.
        why: String,
    },
    /// A journal does not hold all that a run needs, and may not be added to.
    #[error("{missing} of {pieces} pieces of work are missing")]
    Incomplete {
        /// Pieces that are not there; more may be missing.
        missing: u64,
        /// Pieces that were asked for.
        pieces: u64,
    },
    /// A journal answered with something that is no piece of this run.
    #[error("a recorded piece of work for the instrument `{instrument}` is not one of this run")]
    Foreign {
        /// The instrument.
        instrument: String,
    },
}
