//! Names of points inside a diagram, where many stand close together: beside their point, or further off with a line that leads to it.
//!
//! Candidates are boxes around the point in rings of growing distance; the nearest one is taken that lies inside the locus, covers
//! no line, point or other name, and is not nearer to another point than to its own.

use super::super::chart::{Anchor, Chart, Curve, Ink, Note};
use super::super::polyline::{is_inside, walked};

/// Width of a letter and half the height of capitals, in sizes of the text; on the safe side for most words.
const LETTER_EM: f64 = 0.56;
const HALF_HEIGHT_EM: f64 = 0.38;
/// Distances of a name from its point; from the third on a line leads there.
const RINGS_EM: [f64; 11] = [0.5, 0.75, 1.4, 2.0, 2.8, 3.8, 5.0, 6.5, 8.5, 11.0, 14.0];
const FIRST_LED: usize = 2;
/// Room around a name.
const CLEAR_EM: f64 = 0.16;

/// A rectangle in the plane: middle and half sides.
#[derive(Debug, Clone, Copy)]
struct Area {
    middle: [f64; 2],
    half: [f64; 2],
}

impl Area {
    fn grown(self, by: f64) -> Self {
        Self { half: self.half.map(|h| h + by), ..self }
    }

    fn overlaps(&self, other: &Self) -> bool {
        (0..2).all(|i| (self.middle[i] - other.middle[i]).abs() < self.half[i] + other.half[i])
    }

    /// Distance of a point from the rectangle; zero inside.
    fn distance(&self, point: [f64; 2]) -> f64 {
        let beyond = |i: usize| ((point[i] - self.middle[i]).abs() - self.half[i]).max(0.0);
        beyond(0).hypot(beyond(1))
    }

    fn corners(&self) -> [[f64; 2]; 4] {
        [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
            .map(|s| [self.middle[0] + s[0] * self.half[0], self.middle[1] + s[1] * self.half[1]])
    }
}

/// What names have to keep clear of, and the names that stand already.
pub(super) struct Names<'a> {
    outline: &'a [[f64; 2]],
    em: f64,
    /// Lines as points closer than a letter is wide.
    lines: Vec<[f64; 2]>,
    points: Vec<[f64; 2]>,
    taken: Vec<Area>,
}

impl<'a> Names<'a> {
    /// Around the lines and points of a chart. `em` is the size of the text in units of the plane.
    pub(super) fn new(chart: &Chart, outline: &'a [[f64; 2]], em: f64) -> Self {
        let pieces = chart.curves.iter().flat_map(|curve| curve.points.split(|point| !point.iter().all(|c| c.is_finite())));
        let lines = pieces.filter(|piece| piece.len() > 1).flat_map(|piece| walked(piece, 0.12 * em)).collect();
        Self { outline, em, lines, points: chart.points.iter().map(|point| point.at).collect(), taken: Vec::new() }
    }

    /// Half the sides of the box of a name.
    fn half(&self, text: &str) -> [f64; 2] {
        [0.5 * LETTER_EM * self.em * text.chars().count() as f64, HALF_HEIGHT_EM * self.em]
    }

    fn is_free(&self, area: &Area) -> bool {
        let clear = area.grown(CLEAR_EM * self.em);
        clear.corners().into_iter().all(|corner| is_inside(self.outline, corner))
            && self.taken.iter().all(|other| !clear.overlaps(&other.grown(CLEAR_EM * self.em)))
            && self.lines.iter().all(|point| clear.distance(*point) > 0.0)
            && self.points.iter().all(|point| area.distance(*point) > 0.3 * self.em)
    }

    /// Whether a line leads past all points and names.
    fn leads(&self, from: [f64; 2], to: [f64; 2], own: [f64; 2]) -> bool {
        let way = walked(&[from, to], 0.2 * self.em);
        let past = |point: &[f64; 2]| way.iter().all(|w| (w[0] - point[0]).hypot(w[1] - point[1]) > 0.35 * self.em);
        self.points.iter().filter(|point| (point[0] - own[0]).hypot(point[1] - own[1]) > 0.5 * self.em).all(past)
            && self.taken.iter().all(|area| way.iter().all(|w| area.distance(*w) > 0.1 * self.em))
    }

    /// Writes the name of a point; false if there is no room.
    pub(super) fn beside_point(&mut self, chart: &mut Chart, text: &str, at: [f64; 2]) -> bool {
        let half = self.half(text);
        for (ring, distance) in RINGS_EM.into_iter().enumerate() {
            for step in 0..32 {
                // To the right first, then below and above it, at last to the left.
                let turn = f64::from((step + 1) / 2) * if step % 2 == 0 { 1.0 } else { -1.0 };
                let (sin, cos) = (std::f64::consts::PI / 16.0 * turn).sin_cos();
                let reach = |i: usize, along: f64| {
                    along * distance * self.em + half[i] * along.signum() * f64::from(along.abs() > 1e-9).min(along.abs() * 1.5)
                };
                let area = Area { middle: [at[0] + reach(0, cos), at[1] + reach(1, sin)], half };
                let nearest =
                    self.points.iter().filter(|point| **point != at).map(|point| area.distance(*point)).fold(f64::INFINITY, f64::min);
                let led = ring >= FIRST_LED;
                if !self.is_free(&area) || (!led && nearest < 1.5 * area.distance(at)) {
                    continue;
                }
                let foot = [0, 1].map(|i| at[i].clamp(area.middle[i] - half[i], area.middle[i] + half[i]));
                if led && !self.leads(at, foot, at) {
                    continue;
                }
                if led {
                    let short = 1.0 - 0.15 * self.em / area.distance(at).max(0.15 * self.em);
                    let end = [0, 1].map(|i| at[i] + short * (foot[i] - at[i]));
                    chart
                        .curves
                        .push(Curve { width: 0.4, ..Curve::new(&format!("line to {text}"), vec![at, end], Ink::OnShade).unwritten() });
                    self.lines.extend(walked(&[at, end], 0.12 * self.em));
                }
                self.write(chart, text, area);
                return true;
            }
        }
        false
    }

    /// Writes a text at an end of a short line, along its direction; false if there is no room.
    pub(super) fn at_end(&mut self, chart: &mut Chart, text: &str, end: [f64; 2], along: [f64; 2]) -> bool {
        let half = self.half(text);
        let distance = 0.32 * self.em + along[0].abs() * half[0] + along[1].abs() * half[1];
        let area = Area { middle: [0, 1].map(|i| end[i] + along[i] * distance), half };
        let free = self.is_free(&area);
        if free {
            self.write(chart, text, area);
        }
        free
    }

    fn write(&mut self, chart: &mut Chart, text: &str, area: Area) {
        self.taken.push(area);
        let note = Note { text: text.to_owned(), at: area.middle, shift_em: [0.0; 2], anchor: Anchor::Middle, ink: Ink::OnShade };
        chart.notes.push(note);
    }
}
