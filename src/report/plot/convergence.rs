//! Error against run time, both axes logarithmic: true errors and claimed uncertainties of each plan, and slopes to hold them to.
//!
//! ```text
//! solid   true error, RMS over seeds        dashed   claimed standard uncertainty        thin   t^(−1/2) and t^(−1)
//! ```

use crate::study::converge::{Convergence, ErrorCurve};

use super::PlotError;
use super::axis::superscript;
use super::chart::{Axis, Chart, Curve, Dash, Ink, Key, Point};

/// Channels that are drawn one by one; of more, all readings together.
const MOST_CHANNELS: usize = 4;

/// The curves of a study. Errors if no plan samples, for then there is nothing to follow.
pub fn chart(study: &Convergence) -> Result<Chart, PlotError> {
    let mut curves = Vec::new();
    let mut points = Vec::new();
    let mut ink = 0;
    let mut ends: Vec<[f64; 2]> = Vec::new();
    for plan in &study.plans {
        for curve in drawn(&plan.curves, study.plans.len()) {
            let name = if plan.curves.len() == 1 { plan.name.clone() } else { format!("{}: {}", plan.name, curve.name) };
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
    let largest =
        study.plans.iter().flat_map(|p| drawn(&p.curves, study.plans.len())).map(|c| 100.0 * c.reference_uncertainty).fold(0.0, f64::max);
    if largest > bottom {
        let level = Curve::new("u of the reference", vec![[from, largest], [to, largest]], Ink::Muted);
        curves.push(level.behind().dashed(Dash::Dotted));
    }
    // Both slopes start where the first curve does, a little above it.
    let start = curves.first().and_then(|c| c.points.first()).copied().unwrap_or([x_low, y_high]);
    for (exponent, name) in [(-0.5, "slope −1/2"), (-1.0, "slope −1")] {
        let at = |x: f64| [x, 1.5 * start[1] * (x / start[0]).powf(exponent)];
        // Straight on these axes: two points, ended where the frame ends.
        let floor = start[0] * (bottom / (1.5 * start[1])).powf(1.0 / exponent);
        curves.push(Curve::new(name, vec![at(start[0]), at(floor.min(to))], Ink::Muted).behind());
    }
    let key = |text: &str, dash| Key { text: text.to_owned(), width: 1.0, dash };
    let seeds = study.plans.iter().flat_map(|p| &p.curves).flat_map(|c| &c.rungs).map(|r| r.seeds).max().unwrap_or(0);
    let exact = study.plans.iter().filter(|p| p.exact.is_some()).map(|p| format!("; {}: exact, by formulas", p.name));
    let subtitle = format!("RMS over {seeds} seeds, relative{}", exact.collect::<String>());
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

fn below(x: f64) -> f64 {
    10f64.powf((x.log10() - 0.05).floor())
}

fn above(x: f64) -> f64 {
    10f64.powf((x.log10() + 0.05).ceil())
}

/// A tick a decade, fewer where there are many, without powers where plain digits are few.
fn decades(from: f64, to: f64) -> Vec<(f64, String)> {
    let (first, last) = (from.log10().round() as i32, to.log10().round() as i32);
    let every = ((last - first) / 8 + 1) as usize;
    let label = |exponent: i32| match exponent {
        0..=5 => format!("{:.0}", 10f64.powi(exponent)),
        -4..0 => format!("{:.*}", exponent.unsigned_abs() as usize, 10f64.powi(exponent)),
        _ => format!("10{}", superscript(i64::from(exponent))),
    };
    (first..=last).step_by(every).map(|exponent| (10f64.powi(exponent), label(exponent))).collect()
}
