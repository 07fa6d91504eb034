//! What is drawn, as CSV: a row a point, all its digits.
//!
//! | column | meaning |
//! |---|---|
//! | `item` | name of the curve, line or point |
//! | `kind` | `curve`, `band`, `line` (a spectral line) or `point` |
//! | x | with quantity and unit |
//! | y | with quantity and unit; the middle of a band |
//! | `lower`, `upper` | ends of a band, else empty |
//!
//! The height of a spectral line is in the unit of its own axis; if there is one, a column of its own holds it.

use std::fmt::Write as _;

use super::chart::Chart;
use super::text::plain;

/// The table of a chart.
pub fn csv(chart: &Chart) -> String {
    let mut out = String::new();
    let power = chart.impulse_axis.as_ref().map(|axis| format!(",{}", quoted(&axis.name()))).unwrap_or_default();
    let _ = writeln!(out, "item,kind,{},{},lower,upper{power}", quoted(&chart.x.name()), quoted(&chart.y.name()));
    let more = if chart.impulse_axis.is_some() { "," } else { "" };
    for curve in &chart.curves {
        let name = quoted(&curve.label);
        for [x, y] in curve.points.iter().filter(|point| point.iter().all(|c| c.is_finite())) {
            let _ = writeln!(out, "{name},curve,{x},{y},,{more}");
        }
    }
    for band in &chart.bands {
        let name = quoted(&band.label);
        for [x, low, high] in band.points.iter().filter(|point| point.iter().all(|c| c.is_finite())) {
            let _ = writeln!(out, "{name},band,{x},{},{low},{high}{more}", 0.5 * low + 0.5 * high);
        }
    }
    for impulse in &chart.impulses {
        let (name, x, height) = (quoted(&impulse.label), impulse.x, impulse.height);
        let _ = if more.is_empty() { writeln!(out, "{name},line,{x},{height},,") } else { writeln!(out, "{name},line,{x},,,,{height}") };
    }
    for point in &chart.points {
        let _ = writeln!(out, "{},point,{},{},,{more}", quoted(&point.label), point.at[0], point.at[1]);
    }
    out
}

/// A field, in quotes where it holds what would end it. A text that a spreadsheet would take for a formula gets an apostrophe.
fn quoted(text: &str) -> String {
    let text = plain(text);
    let text = if text.starts_with(['=', '+', '@']) { format!("'{text}") } else { text };
    if text.contains([',', '"', '\n', '\r']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text }
}

#[cfg(test)]
mod tests {
    use super::super::chart::{Axis, Curve, Impulse, Ink};
    use super::*;

    #[test]
    fn a_row_a_point_with_all_its_digits() {
        let mut chart = Chart::new("t", "s", Axis::linear("λ", "nm", 0.0, 1.0), Axis::linear("a, b", "1", 0.0, 1.0));
        chart.curves.push(Curve::new("one \"1\"", vec![[0.1, 1.0 / 3.0], [f64::NAN, 1.0]], Ink::Text));
        chart.impulses.push(Impulse { label: "Hg".to_owned(), x: 546.07, height: 2.0, ink: Ink::Text });
        assert_eq!(
            csv(&chart),
            "item,kind,λ (nm),\"a, b (1)\",lower,upper\n\"one \"\"1\"\"\",curve,0.1,0.3333333333333333,,\nHg,line,546.07,2,,\n"
        );
        chart.impulse_axis = Some(Axis::linear("power", "W", 0.0, 3.0));
        assert!(csv(&chart).ends_with("Hg,line,546.07,,,,2\n"));
    }
}
