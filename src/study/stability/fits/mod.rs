//! Fits of responsivity curves, driven to where they are stiff or extreme.
//!
//! ```text
//! a row holds     at least 95 % of the nodes are within their 99 % bands, |s − s₀| ≤ 2.58 u, over all sets of readings
//! by a law        the same readings in other units give the same curve to 1e-9 of its peak
//! it is told      the fit says in words why there is none, or that its uncertainty means nothing
//! ```
//!
//! Deviation: RMS over nodes and sets of s − s₀ over the peak. In u: RMS of (s − s₀)/u. U: twice the RMS of u over the peak. The reading of a row is the
//! fitted curve at the node that is furthest off in u, the reference the true curve there.
//!
//! | sweep | parameter |
//! |---|---|
//! | [`condition`] | condition number of the exposures, 1e2 to 1e17, noise 0 to 10 % |
//! | [`noise`] | noise over the largest reading, 0 to 10 % |
//! | [`counts`] | exposures, 3 to 400; how often each of them is taken |
//! | [`faults`] | channels that see nothing, readings that are lost, readings that contradict each other |
//! | [`units`] | unit of the readings and of the light, 1e-30 to 1e30 |
//!
//! `design` makes exposures and readings, `judge` fits them.

pub mod condition;
pub mod counts;
mod design;
pub mod faults;
mod judge;
pub mod noise;
pub mod units;

pub(super) use judge::row;

use crate::calibration::{Exposures, PriorKind, Readings};

/// Exposures with sets of readings, and what the fits have to find.
#[derive(Clone, Debug)]
pub struct FitProblem {
    /// What is put in front of the sensor.
    pub exposures: Exposures,
    /// Sets of readings of the same exposures, each a channel each; every set is fitted on its own.
    pub sets: Vec<Vec<Readings>>,
    /// Which curves are plausible.
    pub prior: PriorKind,
    /// What must come out.
    pub expected: Expected,
}

/// What must come out of fits.
#[derive(Clone, Debug)]
pub enum Expected {
    /// The true curves at the nodes, a channel each, within their bands; or words.
    Curves(Vec<Vec<f64>>),
    /// Words: readings that no curve explains, or that say nothing.
    Words(Vec<Vec<f64>>),
    /// The curve of another problem times a factor.
    Law {
        /// Exposures and readings in other units.
        base: Box<FitProblem>,
        /// What its curve is multiplied by.
        factor: f64,
    },
}
