//! From runs to a row: how often the interval held, and what kept it from holding.

use super::truth::{Truth, TruthOrigin};
use crate::metrology::Moments;
use crate::metrology::budget::DEFAULT_COVERAGE_PROBABILITY;

/// Standard deviations of a binomial share that coverage may lie below 95 %.
const LIMIT_SIGMA: f64 = 3.0;
/// Standard errors by which the mean deviation may differ from zero.
const MOST_BIAS: f64 = 4.0;
/// Largest uncertainty of the truth over that of a run with which a verdict is given.
const COARSE: f64 = 0.25;

/// Lowest share of `n` intervals at 95 % that may cover: 0.95 − 3 √(0.95 · 0.05 / n).
#[must_use]
pub fn lowest_share(n: u64) -> f64 {
    let p = DEFAULT_COVERAGE_PROBABILITY;
    p - LIMIT_SIGMA * (p * (1.0 - p) / n as f64).sqrt()
}

/// One reading of one run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Run {
    /// The indication, in its unit.
    pub value: f64,
    /// u_c.
    pub standard_uncertainty: f64,
    /// U at 95 %.
    pub expanded_uncertainty: f64,
    /// Samples that the reading is made of.
    pub samples: u64,
    /// Whether U is as small as the target asks.
    pub target_met: bool,
}

/// What a row shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The intervals cover at their rate, and the mean is right.
    Holds,
    /// Fewer intervals cover than chance allows.
    TooLow,
    /// The mean of the readings is off.
    Biased,
    /// The truth is not known well enough to tell.
    TruthTooCoarse,
}

impl Verdict {
    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Verdict::Holds => "holds",
            Verdict::TooLow => "TOO LOW",
            Verdict::Biased => "BIASED",
            Verdict::TruthTooCoarse => "truth too coarse",
        }
    }

    /// Whether the intervals are to be mended.
    #[must_use]
    pub fn is_wrong(self) -> bool {
        matches!(self, Verdict::TooLow | Verdict::Biased)
    }
}

/// The runs of one pose and channel.
#[derive(Clone, Debug, PartialEq)]
pub struct Tally {
    truth: Truth,
    target: f64,
    covered: u64,
    outside: u64,
    unmet: u64,
    samples: f64,
    claimed: Moments,
    deviations: Moments,
    squares: Moments,
}

impl Tally {
    /// No runs yet, to be held to this truth; `target` is relative.
    #[must_use]
    pub fn new(truth: Truth, target: f64) -> Tally {
        Tally {
            truth,
            target,
            covered: 0,
            outside: 0,
            unmet: 0,
            samples: 0.0,
            claimed: Moments::new(),
            deviations: Moments::new(),
            squares: Moments::new(),
        }
    }

    /// Adds a run.
    pub fn add(&mut self, run: &Run) {
        let deviation = run.value - self.truth.value;
        let k = if run.standard_uncertainty > 0.0 { run.expanded_uncertainty / run.standard_uncertainty } else { 2.0 };
        let allowed = run.expanded_uncertainty.hypot(k * self.truth.standard_uncertainty);
        self.covered += u64::from(deviation.abs() <= allowed);
        self.outside += u64::from(deviation.abs() > self.target * self.truth.value.abs());
        self.unmet += u64::from(!run.target_met);
        self.samples += run.samples as f64;
        self.claimed.push(run.standard_uncertainty);
        self.deviations.push(deviation);
        self.squares.push(deviation * deviation);
    }

    fn runs(&self) -> u64 {
        self.deviations.count()
    }

    /// Root mean square deviation from the truth.
    fn rms(&self) -> f64 {
        self.squares.mean().unwrap_or(0.0).sqrt()
    }

    /// Mean deviation in its own standard errors.
    fn bias(&self) -> f64 {
        let mean = self.deviations.mean().unwrap_or(0.0);
        let error = self.deviations.standard_uncertainty_of_mean().unwrap_or(0.0).hypot(self.truth.standard_uncertainty);
        if mean == 0.0 { 0.0 } else { mean / error }
    }

    fn claimed_over_rms(&self) -> f64 {
        let claimed = self.claimed.mean().unwrap_or(0.0);
        if claimed == 0.0 && self.rms() == 0.0 { 1.0 } else { claimed / self.rms() }
    }

    fn truth_share(&self) -> f64 {
        let u = self.truth.standard_uncertainty;
        if u == 0.0 { 0.0 } else { u / self.claimed.mean().unwrap_or(0.0) }
    }
}

/// The sampled readings of a channel, over the poses that were read and over all seeds.
#[derive(Clone, Debug, PartialEq)]
pub struct CoverageRow {
    /// Instrument and channel; the pose where there is one.
    pub reading: String,
    /// Unit of truth and readings.
    pub unit: String,
    /// Poses that are pooled.
    pub poses: usize,
    /// Where the truth is from.
    pub origin: TruthOrigin,
    /// The truth; its mean over the poses.
    pub truth: f64,
    /// Its standard uncertainty; root mean square over the poses.
    pub truth_standard_uncertainty: f64,
    /// u₀ / u: the uncertainty of the truth over the mean one of the runs, the largest of the poses.
    pub truth_share: f64,
    /// Samples of a reading, mean.
    pub samples: f64,
    /// Readings that were held against the truth: seeds × poses.
    pub runs: u64,
    /// Those whose interval covers it.
    pub covered: u64,
    /// Mean deviation in its own standard errors; of several poses their sum over the root of their number.
    pub bias: f64,
    /// Share of the readings that are off by more than the target.
    pub outside_target: f64,
    /// Share of the readings whose U did not come down to the target.
    pub target_unmet: f64,
    /// Mean u_c over the root mean square deviation; above one, more is claimed than is needed. Infinite if no run is off.
    pub claimed_over_rms: f64,
    /// What it shows.
    pub verdict: Verdict,
}

impl CoverageRow {
    /// The row of the poses of a channel. `None` without runs.
    #[must_use]
    pub fn of(reading: String, unit: String, tallies: &[Tally]) -> Option<CoverageRow> {
        let origin = tallies.first()?.truth.origin;
        let poses = tallies.len() as f64;
        let runs: u64 = tallies.iter().map(Tally::runs).sum();
        if runs == 0 {
            return None;
        }
        let mean = |of: &dyn Fn(&Tally) -> f64| tallies.iter().map(of).sum::<f64>() / poses;
        let share = |of: &dyn Fn(&Tally) -> u64| tallies.iter().map(of).sum::<u64>() as f64 / runs as f64;
        let mut row = CoverageRow {
            reading,
            unit,
            poses: tallies.len(),
            origin,
            truth: mean(&|t| t.truth.value),
            truth_standard_uncertainty: mean(&|t| t.truth.standard_uncertainty.powi(2)).sqrt(),
            truth_share: tallies.iter().map(Tally::truth_share).fold(0.0, f64::max),
            samples: tallies.iter().map(|t| t.samples).sum::<f64>() / runs as f64,
            runs,
            covered: tallies.iter().map(|t| t.covered).sum(),
            bias: mean(&Tally::bias) * poses.sqrt(),
            outside_target: share(&|t| t.outside),
            target_unmet: share(&|t| t.unmet),
            claimed_over_rms: mean(&Tally::claimed_over_rms),
            verdict: Verdict::Holds,
        };
        row.verdict = match row.covered_share() >= lowest_share(runs) {
            // A truth that is as uncertain as the runs says nothing against them; where none is off it says nothing at all.
            _ if row.truth_share > COARSE && row.claimed_over_rms.is_finite() => Verdict::TruthTooCoarse,
            false => Verdict::TooLow,
            true if row.bias.abs() > MOST_BIAS => Verdict::Biased,
            true => Verdict::Holds,
        };
        Some(row)
    }

    /// Share of the intervals that cover the truth.
    #[must_use]
    pub fn covered_share(&self) -> f64 {
        self.covered as f64 / self.runs as f64
    }
}
