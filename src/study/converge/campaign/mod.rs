//! Error of a calibrated curve against the number of exposures, against noise, and against run time.
//!
//! ```text
//! true error   √ mean over seeds, channels and nodes of ((s − s₀) / max s₀)²
//! claimed      √ mean over seeds, channels and nodes of (u / max s₀)²
//! slope        d ln error / d ln parameter, by least squares
//! ```
//!
//! | ladder | from rung to rung | all else |
//! |---|---|---|
//! | exposures | 3, 6, 12 … all of them: each rung has those of the one before | as the file says |
//! | noise | every uncertainty of the file times 16, 4, 1, 1/4 … 1/4096 | as the file says |
//! | samples | 256, 1024, 4096 … samples of the bench, where it is sampled; the readings are of a bench traced 16 times as long as the highest rung | as the file says |
//!
//! Exposures are taken in bit-reversed order of their place in the file (0, 1/2, 1/4, 3/4, 1/8 …), so that every rung is spread over all of them; candidates
//! follow, in the same order among themselves. The common scale is taken as known in the first two: no further reading makes it better. All nodes
//! count, those that no exposure sees as well. A fit is the same bits for any machine; how many seeds and rungs there are depends on the budget.
//!
//! `ladder.rs` climbs, `order.rs` says which exposures come first.

mod ladder;
mod order;

pub use order::nested_order;

use super::power_law::{PowerLaw, fit};
use super::{ConvergeError, ConvergeOptions};
use crate::scene::Calibration;
use crate::study::StudyWatch;

/// Processor times of the rungs, the longest over the shortest, from which a slope means anything.
const TIME_RATIO: f64 = 3.0;

/// What a ladder changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LadderKind {
    /// The number of exposures.
    Exposures,
    /// The noise of the readings.
    Noise,
    /// The samples that the bench is traced with.
    Samples,
}

impl LadderKind {
    /// One word.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            LadderKind::Exposures => "exposures",
            LadderKind::Noise => "noise",
            LadderKind::Samples => "samples",
        }
    }

    /// What the parameter is.
    #[must_use]
    pub fn parameter(self) -> &'static str {
        match self {
            LadderKind::Exposures => "number of exposures",
            LadderKind::Noise => "RMS noise over the largest reading",
            LadderKind::Samples => "samples of the bench",
        }
    }

    /// How its rungs follow each other.
    #[must_use]
    pub fn rule(self) -> &'static str {
        match self {
            LadderKind::Exposures => "nested, in bit-reversed order of the file, then the candidates",
            LadderKind::Noise => "every uncertainty of the file times a power of four",
            LadderKind::Samples => "readings of a bench that was traced 16 times as long as the highest rung",
        }
    }
}

/// A rung.
#[derive(Clone, Debug, PartialEq)]
pub struct CampaignRung {
    /// Value of the parameter.
    pub parameter: f64,
    /// Exposures.
    pub exposures: usize,
    /// What the uncertainties of the file were multiplied by.
    pub noise_factor: f64,
    /// Samples that the bench was traced with in one run; zero where formulas served.
    pub samples: u64,
    /// Fits, each with its own noise.
    pub seeds: u64,
    /// Mean processor time of a run: tracing and fit, s.
    pub cpu_seconds: f64,
    /// Mean wall time of a run, s.
    pub wall_seconds: f64,
    /// True error, RMS over the peak.
    pub error: f64,
    /// Claimed standard uncertainty, RMS over the peak.
    pub claimed: f64,
    /// Share of the nodes that lie within their 95 % bands.
    pub within_95: f64,
    /// Fits that say that their uncertainty means nothing: of curves that bend between their nodes, say. Such rungs are in no slope.
    pub told: u64,
}

impl CampaignRung {
    /// Claimed over true.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        self.claimed / self.error
    }
}

/// A ladder that was climbed.
#[derive(Clone, Debug, PartialEq)]
pub struct CampaignLadder {
    /// What it changes.
    pub kind: LadderKind,
    /// From the largest error to the least, as it is expected.
    pub rungs: Vec<CampaignRung>,
    /// True error against the parameter.
    pub error_by_parameter: Option<PowerLaw>,
    /// Claimed uncertainty against the parameter.
    pub claimed_by_parameter: Option<PowerLaw>,
    /// True error against processor time; none where the rungs take hardly different times.
    pub error_by_time: Option<PowerLaw>,
    /// Claimed over true, geometric mean over the rungs.
    pub ratio: Option<f64>,
}

/// What came of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct CampaignConvergence {
    /// Title of the campaign.
    pub title: String,
    /// How it was made.
    pub options: ConvergeOptions,
    /// The ladders that there was something to climb on.
    pub ladders: Vec<CampaignLadder>,
    /// What a reader should know.
    pub remarks: Vec<String>,
}

impl CampaignConvergence {
    /// The ladder of this kind.
    #[must_use]
    pub fn ladder(&self, kind: LadderKind) -> Option<&CampaignLadder> {
        self.ladders.iter().find(|l| l.kind == kind)
    }
}

impl CampaignLadder {
    fn new(kind: LadderKind, rungs: Vec<CampaignRung>) -> CampaignLadder {
        // The RMS of n independent normal errors scatters by 1/√(2n); nodes of one fit are not independent.
        let seeds = rungs.iter().map(|r| r.seeds).min().unwrap_or(1).max(1);
        let scatter = (0.5 / seeds as f64).sqrt();
        let sound: Vec<&CampaignRung> = rungs.iter().filter(|r| r.told == 0).collect();
        let law = |x: fn(&CampaignRung) -> f64, y: fn(&CampaignRung) -> f64| {
            let points: Vec<(f64, f64)> = sound.iter().map(|r| (x(r), y(r))).collect();
            fit(&points, scatter)
        };
        let ratios: Vec<f64> = sound.iter().map(|r| r.ratio().ln()).filter(|l| l.is_finite()).collect();
        let seconds = || sound.iter().map(|r| r.cpu_seconds);
        let takes_time = seconds().fold(0.0, f64::max) > TIME_RATIO * seconds().fold(f64::INFINITY, f64::min);
        CampaignLadder {
            kind,
            error_by_parameter: law(|r| r.parameter, |r| r.error),
            claimed_by_parameter: law(|r| r.parameter, |r| r.claimed),
            error_by_time: if takes_time { law(|r| r.cpu_seconds, |r| r.error) } else { None },
            ratio: (!ratios.is_empty()).then(|| (ratios.iter().sum::<f64>() / ratios.len() as f64).exp()),
            rungs,
        }
    }
}

/// Studies a campaign: simulates its readings again and again and fits them.
///
/// # Errors
/// When the bench cannot be simulated, readings cannot be fitted, or the budget is too short for two fits of a rung.
pub fn converge_campaign(
    calibration: &Calibration,
    options: &ConvergeOptions,
    watch: &StudyWatch<'_>,
) -> Result<CampaignConvergence, ConvergeError> {
    let mut climber = ladder::Climber::new(calibration, options, watch)?;
    let ladders = [climber.exposures()?, climber.noise()?, climber.samples()?].into_iter().flatten();
    let ladders = ladders.map(|(kind, rungs)| CampaignLadder::new(kind, rungs)).collect();
    (watch.progress)(1.0);
    Ok(CampaignConvergence { title: calibration.title.clone(), options: *options, ladders, remarks: climber.remarks })
}
