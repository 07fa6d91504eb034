//! Deviation, stated uncertainty and time against the parameter of a sweep, on logarithmic axes.
//!
//! Angles are drawn by their complement to 90°, which is what goes to zero. A deviation of zero has no place on a logarithmic axis and
//! stands on its lower end.

use crate::report::plot::chart::{Axis, Chart, Curve, Dash, Ink, Key, Point};
use crate::study::stability::{Row, SweepResult};

/// Lowest deviation that is drawn.
const LOWEST: f64 = 1e-17;
/// Least and largest error over uncertainty that are drawn where they belong.
const LEAST_RATIO: f64 = 0.01;
const MOST_RATIO: f64 = 100.0;

/// Relative deviation of each series; dotted, the expanded uncertainty that its readings state. `None` without two readings.
#[must_use]
pub fn deviations(result: &SweepResult) -> Option<Chart> {
    let deviation = |row: &Row| row.deviation.map(|d| d.max(LOWEST));
    let mut chart = drawn(result, "Deviation", "Relative deviation", "1", deviation)?;
    for (i, series) in names(result).into_iter().enumerate() {
        let points = points(result, series, |row| row.expanded.map(|u| u.max(LOWEST)));
        let curve = Curve::new(&format!("{series}, U"), points, Ink::Palette(i)).dashed(Dash::Dotted).unwritten();
        chart.curves.push(curve);
    }
    fit_y(&mut chart);
    chart.keys = vec![
        Key { text: "deviation".to_owned(), width: 1.0, dash: Dash::Solid },
        Key { text: "U as stated (95 %)".to_owned(), width: 1.0, dash: Dash::Dotted },
    ];
    Some(chart)
}

/// Seconds of each series. `None` without two readings.
#[must_use]
pub fn times(result: &SweepResult) -> Option<Chart> {
    let mut chart = drawn(result, "Time", "Time", "s", |row| Some(row.seconds.max(1e-7)))?;
    fit_y(&mut chart);
    Some(chart)
}

/// Errors of fitted curves over their stated uncertainties, RMS over the nodes: 1 is honest, less is cautious. `None` without two fits.
#[must_use]
pub fn in_bands(result: &SweepResult) -> Option<Chart> {
    let ratio = |row: &Row| row.inside.and(row.deviation_u).map(|x| x.clamp(LEAST_RATIO, MOST_RATIO));
    let mut chart = drawn(result, "Error over stated uncertainty", "RMS of error over u", "1", ratio)?;
    chart.y = Axis::log("RMS of error over u", "1", LEAST_RATIO, MOST_RATIO);
    let ends = [chart.x.from, chart.x.to].map(|x| [x, 1.0]);
    chart.curves.push(Curve::new("as stated", ends.to_vec(), Ink::Text).dashed(Dash::Dashed));
    Some(chart)
}

fn names(result: &SweepResult) -> Vec<&'static str> {
    result.summary().iter().map(|failing| failing.series).collect()
}

/// Where a row stands: its parameter, or what is left to 90°.
fn place(result: &SweepResult, row: &Row) -> f64 {
    if result.sweep.unit == "°" { 90.0 - row.parameter } else { row.parameter }
}

fn points(result: &SweepResult, series: &str, y: impl Fn(&Row) -> Option<f64>) -> Vec<[f64; 2]> {
    let rows = result.rows.iter().filter(|row| row.series == series);
    rows.filter_map(|row| Some([place(result, row), y(row)?])).filter(|[x, y]| *x > 0.0 && y.is_finite()).collect()
}

fn drawn(result: &SweepResult, what: &str, quantity: &str, unit: &str, y: impl Fn(&Row) -> Option<f64>) -> Option<Chart> {
    let sweep = &result.sweep;
    let mut curves = Vec::new();
    let mut marks = Vec::new();
    for (i, series) in names(result).into_iter().enumerate() {
        let points = points(result, series, &y);
        marks.extend(points.iter().map(|&at| Point { label: series.to_owned(), at, ink: Ink::Palette(i), radius: 0.5, written: false }));
        curves.push(Curve::new(series, points, Ink::Palette(i)));
    }
    let all = || curves.iter().flat_map(|c: &Curve| c.points.iter().map(|p| p[0]));
    let (low, high) = (all().fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max));
    if low >= high {
        return None;
    }
    let parameter = if sweep.unit == "°" { "90° less the angle from the normal" } else { sweep.parameter };
    let x = Axis::log(&capitalised(parameter), sweep.unit, low, high);
    let mut chart = Chart::new(&format!("{what}: {}", sweep.name), sweep.law, x, Axis::log(quantity, unit, 1.0, 10.0));
    chart.curves = curves;
    chart.points = marks;
    Some(chart)
}

fn capitalised(text: &str) -> String {
    let mut rest = text.chars();
    rest.next().map_or(String::new(), |first| first.to_uppercase().chain(rest).collect())
}

/// Whole decades around everything that is drawn.
fn fit_y(chart: &mut Chart) {
    let all = || chart.curves.iter().flat_map(|c| c.points.iter().map(|p| p[1])).filter(|y| *y > 0.0);
    let (low, high) = (all().fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max));
    if low <= high {
        let from = 10f64.powf(low.log10().floor());
        let to = 10f64.powf(high.log10().ceil());
        (chart.y.from, chart.y.to) = (from, if to > from { to } else { 10.0 * from });
    }
}
