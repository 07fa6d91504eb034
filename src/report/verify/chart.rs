//! Plots of a verification: a point a case, the parts of the groups side by side.

use crate::report::plot::Chart;
use crate::report::plot::chart::{Axis, Curve, Dash, Ink, Point, Span};
use crate::study::verify::{Check, Verification};

/// Share of a part's width that its points take.
const FILLED: f64 = 0.8;

/// A chart with the parts along x and `value` of each case on a logarithmic axis; values below `floor` stand on it.
fn chart(of: &Verification, title: &str, subtitle: &str, y: Axis, floor: f64, value: fn(&Check) -> Option<f64>) -> Chart {
    let parts: Vec<String> = of.parts().into_iter().map(|part| part.name).collect();
    let groups: Vec<String> = of.groups().into_iter().map(|group| group.name).collect();
    let mut x = Axis::linear("part of the suite", "group and letter", 0.0, parts.len().max(1) as f64);
    x.ticks = parts.iter().enumerate().map(|(i, part)| (i as f64 + 0.5, part.clone())).collect();
    let mut chart = Chart::new(title, subtitle, x, y);
    for (i, part) in parts.iter().enumerate() {
        let values: Vec<(&Check, f64)> =
            of.checks.iter().filter(|check| check.part == *part).filter_map(|check| Some((check, value(check)?))).collect();
        for (k, (check, value)) in values.iter().enumerate() {
            let place = i as f64 + 0.5 + FILLED * ((k as f64 + 0.5) / values.len() as f64 - 0.5);
            let ink = Ink::Palette(if check.fails() { 1 } else { 0 });
            let group = groups.iter().position(|group| *group == check.group);
            let ink = if check.fails() { ink } else { Ink::Palette([0, 2, 3, 5][group.unwrap_or(0) % 4]) };
            // What is no number stands at the top.
            let height = if value.is_nan() { chart.y.to } else { value.clamp(floor, chart.y.to) };
            chart.points.push(Point { label: check.id.clone(), at: [place, height], ink, radius: 0.8, written: check.fails() });
        }
        if i % 2 == 1 {
            chart.spans.push(Span { label: String::new(), from: i as f64, to: i as f64 + 1.0 });
        }
    }
    chart
}

/// Smallest and largest power of ten that hold the values that are above zero; a decade at least.
fn decades(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) =
        values.filter(|x| *x > 0.0 && x.is_finite()).fold((f64::INFINITY, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
    if high == 0.0 {
        return (0.1, 1.0);
    }
    let (from, to) = (low.log10().floor().max(-300.0), high.log10().ceil().min(300.0));
    (10f64.powf(from), 10f64.powf(to.max(from + 1.0)))
}

/// |deviation| over the largest that passes, case by case, with the limit.
#[must_use]
pub fn deviations(of: &Verification) -> Chart {
    let (from, to) = decades(of.checks.iter().filter_map(Check::deviation_in_limits).chain([1.0]));
    // Below the smallest is where a deviation of zero stands, and what is hardly more; above the limit there is always room.
    let from = from.max(1e-10);
    let (floor, to) = (0.2 * from, to.max(10.0));
    let y = Axis::log("deviation over the limit", "1", 0.1 * from, to);
    let about = "one point a case; exact agreement, and all below 10⁻¹⁰, stands at the lower edge; above the line a case fails";
    let mut chart = chart(of, "Deviation from the reference, case by case", about, y, floor, Check::deviation_in_limits);
    let end = chart.x.to;
    chart.curves.push(Curve::new("limit", vec![[0.0, 1.0], [end, 1.0]], Ink::Text).dashed(Dash::Dashed).unwritten());
    chart
}

/// Time of each case.
#[must_use]
pub fn times(of: &Verification) -> Chart {
    let seconds = |check: &Check| check.found().map(|_| check.seconds);
    let (from, to) = decades(of.checks.iter().filter_map(seconds));
    chart(of, "Time of each case", "one point a case", Axis::log("time", "s", 0.5 * from, to), from, seconds)
}
