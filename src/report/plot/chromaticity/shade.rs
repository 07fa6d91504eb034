//! The colours of a chromaticity diagram: what sRGB can show, and beyond it a colour that fades towards what it can.
//!
//! ```text
//! c = M (x, y, 1 − x − y) / |…|;   c′ = max(c, 0) + s ln(1 + exp(−|c| / s));   C = c′ / (Σ c′⁸)^(1/8)
//! ```
//!
//! The eighth power stands for the largest component, which would leave a crease from the white to each secondary colour; `s` is the
//! softness of the edge of the gamut. The colours are for orientation: no screen shows those outside its triangle.

use super::super::chart::{Shade, ShadeRow, Stop};
use super::super::wavelength_colour::{encoded, softened};
use super::Diagram;
use crate::observer::colour::{Tristimulus, linear_srgb_of};

/// Softness of the edge of the gamut.
const SOFTNESS: f64 = 0.07;
/// Rows over the height of the diagram.
const ROWS: usize = 240;
/// Places in a row at which its colour is computed.
const FINE: usize = 192;
/// Furthest a colour between two stops may be from its own, of 255.
const TOLERANCE: f64 = 1.2;

/// The colour of a place of a diagram, sRGB 0 to 255.
pub(super) fn colour(diagram: Diagram, place: [f64; 2]) -> [f64; 3] {
    let chromaticity = diagram.chromaticity(place);
    let (x, y) = (chromaticity.x, chromaticity.y);
    let soft = softened(linear_srgb_of(&Tristimulus { x, y, z: 1.0 - x - y }), SOFTNESS);
    let largest = soft.iter().map(|c| c.powi(8)).sum::<f64>().powf(0.125);
    soft.map(|c| 255.0 * encoded(c / largest))
}

/// The colours inside an outline.
pub(super) fn shade(diagram: Diagram, outline: Vec<[f64; 2]>) -> Shade {
    let (low, high) = extent(outline.iter().map(|p| p[1]));
    let height = (high - low) / ROWS as f64;
    let rows = (0..ROWS).filter_map(|row| {
        let (from, to) = (low + row as f64 * height, low + (row + 1) as f64 * height);
        // As far as the outline reaches in this row and its neighbours.
        let (left, right) = across(&outline, from - height, to + height)?;
        Some(ShadeRow { from, to, stops: stops(diagram, left, right, 0.5 * (from + to)) })
    });
    Shade { rows: rows.collect(), outline }
}

fn extent(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
}

/// Left and right end of a closed outline between two heights.
fn across(outline: &[[f64; 2]], from: f64, to: f64) -> Option<(f64, f64)> {
    let sides = outline.iter().zip(outline.iter().cycle().skip(1));
    let reached = sides.flat_map(|(a, b)| {
        let at = |y: f64| {
            (a[1] != b[1]).then(|| (y - a[1]) / (b[1] - a[1])).filter(|t| (0.0..=1.0).contains(t)).map(|t| a[0] + t * (b[0] - a[0]))
        };
        let corner = (from..=to).contains(&a[1]).then_some(a[0]);
        [at(from), at(to), corner]
    });
    let (left, right) = extent(reached.flatten());
    (left < right).then_some((left, right))
}

/// As few stops as keep the colours between them.
fn stops(diagram: Diagram, left: f64, right: f64, height: f64) -> Vec<Stop> {
    let x = |i: usize| left + (right - left) * i as f64 / FINE as f64;
    let colours: Vec<[f64; 3]> = (0..=FINE).map(|i| colour(diagram, [x(i), height])).collect();
    let far = |from: usize, to: usize| {
        (from + 1..to).any(|i| {
            let t = (i - from) as f64 / (to - from) as f64;
            (0..3).any(|c| (colours[from][c] + t * (colours[to][c] - colours[from][c]) - colours[i][c]).abs() > TOLERANCE)
        })
    };
    let mut kept = vec![0];
    while let Some(last) = kept.last().copied().filter(|last| *last < FINE) {
        let next = (last + 1..=FINE).take_while(|next| !far(last, *next)).last().unwrap_or(FINE);
        kept.push(next);
    }
    kept.into_iter().map(|i| Stop { x: x(i), colour: colours[i].map(|c| c.round() as u8), opacity: 1.0 }).collect()
}
