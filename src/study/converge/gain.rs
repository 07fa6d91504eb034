//! What one plan saves against another: the ratio of the processor times to the same error.

use super::power_law::{TimeTo, time_to};
use super::{ErrorCurve, PlanConvergence, TARGETS};

/// How much longer another plan takes than the first.
#[derive(Clone, Debug, PartialEq)]
pub struct Gain {
    /// The other plan.
    pub other: String,
    /// Relative error that both reach.
    pub error: f64,
    /// Its processor time over that of the first plan.
    pub factor: f64,
    /// Whether both times lie between rungs; else one of them is shorter than the time that was taken, that of the lowest rung.
    pub measured: bool,
}

/// Gains at those of [`TARGETS`] that both plans have reached, or at the smallest error that both have.
pub(super) fn gains(plans: &[PlanConvergence]) -> Vec<Gain> {
    let Some((first, others)) = plans.split_first() else { return Vec::new() };
    let mut gains = Vec::new();
    for other in others {
        let Some(slow) = other.curves.first() else { continue };
        let fast = first.curves.first();
        let smallest = |curve: &ErrorCurve| curve.known().iter().map(|r| r.2).fold(f64::INFINITY, f64::min);
        let common = smallest(slow).max(fast.map_or(0.0, smallest));
        let at = |error: f64| {
            // Only what was reached: without the fitted law nothing is extrapolated.
            let reached = |curve: &ErrorCurve| {
                let rungs: Vec<_> = curve.telling(error).map(|(r, e)| (r.samples as f64, r.cpu_seconds, e)).collect();
                time_to(error, &rungs, None)
            };
            let theirs = reached(slow);
            let mine = match (&first.exact, fast) {
                (Some(exact), _) => TimeTo::Interpolated(exact.cpu_seconds),
                (None, Some(curve)) => reached(curve),
                (None, None) => TimeTo::Unknown,
            };
            let (slow, fast) = (theirs.seconds()?, mine.seconds().filter(|s| *s > 0.0)?);
            let measured = matches!((theirs, mine), (TimeTo::Interpolated(_), TimeTo::Interpolated(_)));
            Some(Gain { other: other.name.clone(), error, factor: slow / fast, measured })
        };
        let before = gains.len();
        gains.extend(TARGETS.into_iter().filter_map(at));
        if gains.len() == before && common.is_finite() && common > 0.0 {
            gains.extend(at(common));
        }
    }
    gains
}
