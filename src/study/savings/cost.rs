//! What it costs a plan to reach an error, and how that compares.

use super::{Cost, Factor};
use crate::estimate::Counters;
use crate::study::converge::{PlanConvergence, Rung, TimeTo, time_to};

/// The cost of a plan, and its factor to the first one; each with its planning time, s.
pub(super) fn cost(
    (first, first_planning): (&PlanConvergence, f64),
    (found, planning_seconds): (&PlanConvergence, f64),
    counters: &Counters,
    error: f64,
) -> Cost {
    let at = comparable(first, found, error);
    let seconds = |rung: &Rung| rung.cpu_seconds;
    let factor = at.and_then(|at| {
        let mine = reach(first, at, seconds);
        let theirs = reach(found, at, seconds);
        let ratio = (planning_seconds + theirs.seconds()?) / Some(first_planning + mine.seconds()?).filter(|s| *s > 0.0)?;
        let either = |is: fn(&TimeTo) -> bool| is(&mine) || is(&theirs);
        Some(Factor {
            ratio,
            error: at,
            extrapolated: either(|t| matches!(t, TimeTo::Extrapolated(_))),
            lowest: either(|t| matches!(t, TimeTo::AtMost(_))),
        })
    });
    let rays = |found: &PlanConvergence, at: f64| counted(found, at, |rung| rung.rays);
    let rays_saved = at.and_then(|at| Some(1.0 - rays(first, at)? / rays(found, at).filter(|n| *n > 0.0)?));
    Cost {
        planning_seconds,
        measuring: reach(found, error, seconds),
        rays: rays(found, error),
        samples: counted(found, error, |rung| rung.samples_in_all),
        bvh_nodes: counters.bvh_nodes,
        spectral_nodes: counters.spectral_nodes,
        factor,
        rays_saved,
    }
}

/// The error at which two plans are compared: the one asked for if both reach it, or one is exact; else the smallest that both reached.
/// Where ladders are cut short, slopes of their own would compare chance with chance.
fn comparable(first: &PlanConvergence, found: &PlanConvergence, error: f64) -> Option<f64> {
    let (Some(a), Some(b)) = (first.curves.first(), found.curves.first()) else { return Some(error) };
    if first.exact.is_some() || found.exact.is_some() {
        return Some(error);
    }
    let reached = |curve: &crate::study::converge::ErrorCurve| {
        let rungs: Vec<(f64, f64, f64)> = curve.telling(error).map(|(r, e)| (r.samples as f64, r.cpu_seconds, e)).collect();
        match time_to(error, &rungs, None) {
            TimeTo::Unknown => rungs.last().map(|rung| rung.2),
            _ => Some(error),
        }
    };
    Some(reached(a)?.max(reached(b)?))
}

/// What a plan costs until the error; one of formulas alone costs a run.
fn reach(found: &PlanConvergence, error: f64, of: fn(&Rung) -> f64) -> TimeTo {
    match (&found.exact, found.curves.first()) {
        (Some(exact), _) => TimeTo::Interpolated(exact.cpu_seconds),
        (None, Some(curve)) => curve.cost_to(error, of),
        (None, None) => TimeTo::Unknown,
    }
}

/// Rays or samples until the error; none for formulas, and where none are ever counted.
fn counted(found: &PlanConvergence, error: f64, of: fn(&Rung) -> f64) -> Option<f64> {
    if found.exact.is_some() {
        return Some(0.0);
    }
    let curve = found.curves.first()?;
    if curve.rungs.iter().all(|rung| of(rung) == 0.0) { Some(0.0) } else { curve.cost_to(error, of).seconds() }
}
