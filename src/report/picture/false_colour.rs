//! Luminance in false colours, with a bar in cd/m².
//!
//! The scale is linear from zero to the next 1, 1.5, 2, 3, 4, 5, 6 or 8 times a power of ten above the luminance that one pixel in a thousand exceeds;
//! what is brighter has the last colour. Colours: nine points of viridis (van der Walt and Smith, CC0), straight between them.

use super::glyphs;
use crate::measurement::Frame;

const COLOURS: [[f64; 3]; 9] = [
    [68.0, 1.0, 84.0],
    [71.0, 44.0, 122.0],
    [59.0, 81.0, 139.0],
    [44.0, 113.0, 142.0],
    [33.0, 144.0, 141.0],
    [39.0, 173.0, 129.0],
    [92.0, 200.0, 99.0],
    [170.0, 220.0, 50.0],
    [253.0, 231.0, 37.0],
];
const STEPS: [f64; 9] = [1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
/// Share of the pixels that may be beyond the scale.
const BEYOND: f64 = 1e-3;
/// Marks of the bar beside zero.
const MARKS: usize = 4;
/// Signs of a label.
const LONGEST: usize = 8;

/// A picture in RGB, three bytes a pixel, a bar at its right.
#[derive(Clone, Debug, PartialEq)]
pub struct FalseColour {
    /// Row by row from the top.
    pub rgb: Vec<u8>,
    /// Columns with the bar.
    pub columns: usize,
    /// Rows.
    pub rows: usize,
    /// The end of the scale, cd/m².
    pub most_cd_m2: f64,
}

/// The luminance of a frame.
#[must_use]
pub fn false_colour(frame: &Frame) -> FalseColour {
    let most_cd_m2 = end_of_scale(&frame.luminance_cd_m2);
    // Signs grow with the picture, and a small picture gets a frame that they fit in.
    let zoom = (frame.rows / 240).max(1);
    let line = glyphs::SIZE[1] * zoom;
    let bar = 4 * zoom * glyphs::SIZE[0];
    let columns = frame.columns + bar + (LONGEST + 2) * (glyphs::SIZE[0] + 1) * zoom;
    let rows = frame.rows.max((MARKS + 3) * 2 * line);
    let mut canvas = Canvas { rgb: vec![255; 3 * columns * rows], columns, rows };
    for (i, &value) in frame.luminance_cd_m2.iter().enumerate() {
        canvas.set(i % frame.columns, i / frame.columns, colour(value / most_cd_m2));
    }
    let (left, top, bottom) = (frame.columns + bar / 2, 3 * line, rows - 2 * line);
    canvas.text("cd/m²", left, line / 2 + zoom, zoom);
    for row in top..bottom {
        let share = (bottom - 1 - row) as f64 / (bottom - 1 - top) as f64;
        (left..left + bar / 2).for_each(|column| canvas.set(column, row, colour(share)));
    }
    for mark in 0..=MARKS {
        let share = mark as f64 / MARKS as f64;
        let row = bottom - 1 - (share * (bottom - 1 - top) as f64).round() as usize;
        (left + bar / 2..left + bar / 2 + 2 * zoom).for_each(|column| canvas.set(column, row, [0; 3]));
        canvas.text(&label(share * most_cd_m2), left + bar / 2 + 4 * zoom, row.saturating_sub(line / 2), zoom);
    }
    FalseColour { rgb: canvas.rgb, columns, rows, most_cd_m2 }
}

/// A round number that all but one pixel in a thousand stay below.
fn end_of_scale(luminance: &[f64]) -> f64 {
    let mut values: Vec<f64> = luminance.to_vec();
    let at = ((1.0 - BEYOND) * values.len() as f64) as usize;
    let last = at.min(values.len().saturating_sub(1));
    let high = if values.is_empty() { 0.0 } else { *values.select_nth_unstable_by(last, f64::total_cmp).1 };
    if high <= 0.0 || !high.is_finite() {
        return 1.0;
    }
    let decade = 10f64.powf(high.log10().floor());
    STEPS.iter().map(|step| step * decade).find(|end| *end >= high * (1.0 - 1e-9)).unwrap_or(10.0 * decade)
}

fn label(x: f64) -> String {
    match x {
        0.0 => "0".to_owned(),
        x if (0.001..1e6).contains(&x) => {
            let digits = (2 - x.log10().floor() as i32).max(0) as usize;
            let text = format!("{x:.digits$}");
            if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
        }
        x => format!("{x:.2e}"),
    }
}

fn colour(share: f64) -> [u8; 3] {
    let last = COLOURS.len() - 1;
    let share = if share.is_nan() { 0.0 } else { share.clamp(0.0, 1.0) };
    let at = (share * last as f64).min(last as f64 - 1e-9);
    let (low, part) = (at as usize, at.fract());
    std::array::from_fn(|k| (COLOURS[low][k] + part * (COLOURS[low + 1][k] - COLOURS[low][k])).round() as u8)
}

struct Canvas {
    rgb: Vec<u8>,
    columns: usize,
    rows: usize,
}

impl Canvas {
    fn set(&mut self, column: usize, row: usize, colour: [u8; 3]) {
        if column < self.columns && row < self.rows {
            let at = 3 * (row * self.columns + column);
            self.rgb[at..at + 3].copy_from_slice(&colour);
        }
    }

    fn text(&mut self, text: &str, left: usize, top: usize, zoom: usize) {
        for (i, sign) in text.chars().enumerate() {
            for (y, bits) in glyphs::rows(sign).into_iter().enumerate() {
                for x in (0..glyphs::SIZE[0]).filter(|x| bits >> (glyphs::SIZE[0] - 1 - x) & 1 == 1) {
                    for dot in 0..zoom * zoom {
                        let column = left + (i * (glyphs::SIZE[0] + 1) + x) * zoom + dot % zoom;
                        self.set(column, top + y * zoom + dot / zoom, [0; 3]);
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_ends_at_a_round_number() {
        for (values, end) in [(vec![0.0; 4], 1.0), (vec![273.0, 1.0], 300.0), (vec![1.0], 1.0), (vec![0.0081; 3], 0.01), (vec![9.7e4], 1e5)]
        {
            assert!((end_of_scale(&values) / end - 1.0).abs() < 1e-12, "{values:?}");
        }
        assert_eq!([0.0, 75.0, 112.5, 0.0075, 1e7].map(label), ["0", "75", "112", "0.0075", "1.00e7"]);
    }

    #[test]
    fn colours_run_from_the_first_to_the_last() {
        assert_eq!((colour(-1.0), colour(0.0), colour(1.0), colour(9.0)), ([68, 1, 84], [68, 1, 84], [253, 231, 37], [253, 231, 37]));
        assert_eq!(colour(0.5), [33, 144, 141]);
        assert_eq!(colour(f64::NAN), [68, 1, 84]);
    }
}
