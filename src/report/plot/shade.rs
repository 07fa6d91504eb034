//! Areas that are coloured point by point, without bitmaps: rows of horizontal gradients, cut at an outline.
//!
//! Each row reaches below its lower end and the next one covers that again, so no background shows between them.

use std::fmt::Write as _;

use super::chart::Shade;
use super::polyline::Rectangle;
use super::style::hex;
use super::text::number;

/// The elements of a shade. `place` puts a point of the chart on the page; `name` is one that no other picture on the page bears.
pub(super) fn svg(shade: &Shade, name: &str, opacity: f64, frame: &Rectangle, place: impl Fn([f64; 2]) -> [f64; 2]) -> String {
    let corner = |p: &[f64; 2]| {
        let [x, y] = place(*p);
        format!("{},{}", number(x), number(y))
    };
    let outline: Vec<String> = shade.outline.iter().map(corner).collect();
    let (mut gradients, mut rows) = (String::new(), String::new());
    // From the top down.
    let mut order: Vec<usize> = (0..shade.rows.len()).collect();
    order.sort_by(|a, b| shade.rows[*b].to.total_cmp(&shade.rows[*a].to));
    for (index, row) in order.into_iter().map(|index| &shade.rows[index]).enumerate() {
        let (Some(first), Some(last)) = (row.stops.first(), row.stops.last()) else { continue };
        let ([left, top], [right, bottom]) = (place([first.x, row.to]), place([last.x, row.from]));
        if !(right > left && bottom > top && top < frame.bottom && bottom > frame.top) {
            continue;
        }
        let _ = write!(gradients, "<linearGradient id=\"{name}-{index}\">");
        for stop in &row.stops {
            let offset = format!("{:.3}", (stop.x - first.x) / (last.x - first.x));
            let _ = write!(gradients, "<stop offset=\"{}\" stop-color=\"{}\"/>", offset.trim_start_matches('0'), hex(stop.colour));
        }
        gradients += "</linearGradient>\n";
        let (x, y, width, height) = (number(left), number(top), number(right - left), number(2.0 * (bottom - top)));
        let _ = writeln!(rows, "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" fill=\"url(#{name}-{index})\"/>");
    }
    format!(
        "<defs>\n{gradients}<clipPath id=\"{name}-outline\"><polygon points=\"{}\"/></clipPath>\n</defs>\n\
         <g clip-path=\"url(#{name}-outline)\" opacity=\"{}\">\n{rows}</g>\n",
        outline.join(" "),
        number(opacity),
    )
}
