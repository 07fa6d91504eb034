//! Error against run time, both axes logarithmic: true errors and claimed uncertainties of each plan, and slopes to hold them to.
//!
//! ```text
//! solid   true error, RMS over seeds        dashed   claimed standard uncertainty        thin   t^(−1/2) and t^(−1)
//! ```

use crate::study::converge::{Convergence, ErrorCurve, PlanConvergence};

use super::PlotError;
use super::axis::superscript;
use super::chart::{Axis, Chart, Curve, Dash, Ink, Key, Point};

/// Channels that are drawn one by one; of more, all readings together.
const MOST_CHANNELS: usize = 4;
/// How far above the first curve the slopes begin.
const ABOVE: f64 = 2.5;

/// The curves of a study. Errors if no plan samples, for then there is nothing to follow.
pub fn chart(study: &Convergence) -> Result<Chart, PlotError> {
    let curves_of = |plan: &'_ PlanConvergence| drawn(&plan.curves, study.plans.len()).to_vec();
    let mut curves = Vec::new();
    let mut points = Vec::new();
    let mut ink = 0;
    let mut ends: Vec<[f64; 2]> = Vec::new();
    for plan in &study.plans {
        for curve in curves_of(plan) {
            let name = if curves_of(plan).len() == 1 { plan.name.clone() } else { curve.name.clone() };
            let placed = |y: fn(&crate::study::converge::Rung) -> f64| -> Vec<[f64; 2]> {
                let rungs = curve.rungs.iter().map(|r| [r.cpu_seconds, 100.0 * y(r)]);
                rungs.filter(|p| p.iter().all(|c| *c > 0.0 && c.is_finite())).collect()
            };
            let (error, claimed) = (placed(|r| r.error), placed(|r| r.claimed));
            ends.extend(error.iter().chain(&claimed));
            points.extend(error.iter().map(|at| Point {
                label: String::new(),
                at: *at,
                ink: Ink::Palette(ink),
                radius: 0.7,
                written: false,
            }));
            curves.push(Curve::new(&name, error, Ink::Palette(ink)));
            curves.push(Curve::new(&format!("{name}, claimed"), claimed, Ink::Palette(ink)).dashed(Dash::Dashed).unwritten());
            ink += 1;
        }
    }
    if ends.is_empty() {
        let what = "every reading is exact, by formulas: no error falls with time".to_owned();
        return Err(PlotError::Nothing { what });
    }
    let reach = |k: usize| ends.iter().fold((f64::INFINITY, 0.0f64), |(low, high), p| (low.min(p[k]), high.max(p[k])));
    let ((x_low, x_high), (y_low, y_high)) = (reach(0), reach(1));
    let (from, to) = (below(x_low), above(x_high));
    let (bottom, top) = (below(y_low), above(y_high));
    let largest = study.plans.iter().flat_map(curves_of).map(|c| 100.0 * c.reference_uncertainty).fold(0.0, f64::max);
    if largest > bottom {
        let level = Curve::new("u of the reference", vec![[from, largest], [to, largest]], Ink::Muted);
        curves.push(level.behind().dashed(Dash::Dotted));
    }
    // Both slopes start a little above the first rung that slopes are taken over, and end with the frame.
    let first = study.plans.iter().flat_map(curves_of).next();
    let from_samples = first.as_ref().and_then(|c| c.error_by_samples).map_or(0.0, |law| law.range.0);
    let start = first.iter().flat_map(|c| &c.rungs).find(|r| r.samples as f64 >= from_samples && r.error > 0.0 && r.cpu_seconds > 0.0);
    let start = start.map_or([x_low, y_high], |r| [r.cpu_seconds, 100.0 * r.error.max(r.claimed)]);
    for (exponent, name) in [(-0.5, "slope −1/2"), (-1.0, "slope −1")] {
        let at = |x: f64| [x, ABOVE * start[1] * (x / start[0]).powf(exponent)];
        let floor = start[0] * (bottom / (ABOVE * start[1])).powf(1.0 / exponent);
        curves.push(Curve::new(name, vec![at(start[0]), at(floor.min(to))], Ink::Muted).behind());
    }
    let key = |text: &str, dash| Key { text: text.to_owned(), width: 1.0, dash };
    let seeds = study.plans.iter().flat_map(|p| &p.curves).flat_map(|c| &c.rungs).map(|r| r.seeds).max().unwrap_or(0);
    let exact = study.plans.iter().filter(|p| p.exact.is_some()).map(|p| format!("; {}: exact, by formulas", p.name));
    let readings = study.plans.iter().flat_map(|p| p.curves.first()).map(|c| c.readings).max().unwrap_or(0);
    let over = if readings > 1 { format!(" and {readings} readings") } else { String::new() };
    let subtitle = format!("RMS over {seeds} seeds{over}{}", exact.collect::<String>());
    let x = Axis::log("Processor time of a run", "s", from, to);
    let y = Axis { ticks: decades(bottom, top), ..Axis::log("Relative error, standard uncertainty", "%", bottom, top) };
    Ok(Chart {
        curves,
        points,
        keys: vec![key("true error", Dash::Solid), key("claimed uncertainty", Dash::Dashed)],
        ..Chart::new(&format!("{}: error against run time", study.scene), &subtitle, x, y)
    })
}

/// Each channel where there are few and one plan, else all together.
fn drawn(curves: &[ErrorCurve], plans: usize) -> &[ErrorCurve] {
    match curves {
        [] | [_] => curves,
        [_, channels @ ..] if channels.len() <= MOST_CHANNELS && plans == 1 => channels,
        [all, ..] => std::slice::from_ref(all),
    }
}

/// The largest of 1, 2, 5 times a power of ten that is clearly below.
pub(super) fn below(x: f64) -> f64 {
    let least = x / 1.2;
    let power = 10f64.powf(least.log10().floor());
    [5.0, 2.0, 1.0].into_iter().map(|digit| digit * power).find(|candidate| *candidate <= least).unwrap_or(power)
}

/// The smallest of 1, 2, 5 times a power of ten that is clearly above.
pub(super) fn above(x: f64) -> f64 {
    let most = x * 1.2;
    let power = 10f64.powf(most.log10().floor());
    [1.0, 2.0, 5.0].into_iter().map(|digit| digit * power).find(|candidate| *candidate >= most).unwrap_or(10.0 * power)
}

/// A tick a decade, fewer where there are many, in plain digits where these are few; of a short axis none, for it finds its own.
pub(super) fn decades(from: f64, to: f64) -> Vec<(f64, String)> {
    let (first, last) = ((from.log10() - 1e-9).ceil() as i32, (to.log10() + 1e-9).floor() as i32);
    if (to / from).log10() <= 2.5 {
        return Vec::new();
    }
    let every = ((last - first) / 8 + 1) as usize;
    let label = |exponent: i32| match exponent {
        0..=5 => format!("{:.0}", 10f64.powi(exponent)),
        -4..0 => format!("{:.*}", exponent.unsigned_abs() as usize, 10f64.powi(exponent)),
        _ => format!("10{}", superscript(i64::from(exponent))),
    };
    (first..=last).step_by(every).map(|exponent| (10f64.powi(exponent), label(exponent))).collect()
}
