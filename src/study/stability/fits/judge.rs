//! Fits the readings of a point, and holds the curves to what must come out.

use super::super::{Judgement, Point, Row};
use super::{Expected, FitProblem};
use crate::calibration::{CalibrationError, FitOptions, Fitted, Readings, fit};

/// Coverage factor of a band that holds 99 % of a normal distribution.
const BAND_99: f64 = 2.58;
/// Least share of the nodes that have to lie within their bands.
const LEAST_INSIDE: f64 = 0.95;
/// Share of the peak by which curves of a law may differ: many roundings, far below any noise.
const LAW: f64 = 1e-9;

/// Nodes that were held to their references.
#[derive(Default)]
struct Tally {
    /// Sums of squares: of (s − s₀)/peak, of (s − s₀)/u, of u/peak.
    error: f64,
    in_u: f64,
    claimed: f64,
    inside: usize,
    nodes: usize,
    /// The node that is furthest off: in u, its value, its reference.
    worst: Option<(f64, f64, f64)>,
}

impl Tally {
    fn add(&mut self, fitted: &Fitted, truths: &[Vec<f64>]) {
        let peak = truths.iter().flatten().fold(0.0f64, |most, s| most.max(*s));
        for (curve, truth) in fitted.curves.iter().zip(truths) {
            for ((s, t), u) in curve.values.iter().zip(truth).zip(curve.standard_uncertainties()) {
                let off = (s - t).abs();
                let in_u = if off == 0.0 { 0.0 } else { off / u };
                self.error += (off / peak).powi(2);
                self.in_u += in_u * in_u;
                self.claimed += (u / peak).powi(2);
                self.inside += usize::from(in_u <= BAND_99);
                self.nodes += 1;
                if self.worst.is_none_or(|(most, ..)| in_u > most) {
                    self.worst = Some((in_u, *s, *t));
                }
            }
        }
    }

    fn holds(&self) -> bool {
        self.inside as f64 >= LEAST_INSIDE * self.nodes as f64
    }

    fn write(&self, row: &mut Row) {
        let n = self.nodes as f64;
        row.deviation = Some((self.error / n).sqrt());
        row.deviation_u = Some((self.in_u / n).sqrt());
        row.expanded = Some(2.0 * (self.claimed / n).sqrt());
        row.inside = Some(self.inside as f64 / n);
        if let Some((_, s, t)) = self.worst {
            (row.reading, row.reference) = (Some(s), Some(t));
        }
    }
}

/// What a user is told by a fit that is there.
fn told(fitted: &Fitted) -> String {
    fitted.remarks.join("; ")
}

fn fits(problem: &FitProblem) -> Vec<Result<Fitted, CalibrationError>> {
    let options = FitOptions { prior: problem.prior.clone(), ..FitOptions::default() };
    problem.sets.iter().map(|set: &Vec<Readings>| fit(&problem.exposures, set, &options)).collect()
}

/// The row of a point; seconds are those of one fit.
pub(in super::super) fn row(point: &Point, problem: &FitProblem, now: &(dyn Fn() -> f64 + Sync)) -> Row {
    let start = now();
    let found = fits(problem);
    let mut row = Row::empty(point, (now() - start) / problem.sets.len().max(1) as f64);
    row.samples = problem.sets.len() as u64;
    "A/W".clone_into(&mut row.unit);
    if problem.sets.is_empty() {
        "there are no readings".clone_into(&mut row.note);
        row.judgement = Judgement::Wrong;
        return row;
    }
    let mut fitted = Vec::new();
    for found in found {
        match found {
            Ok(found) => fitted.push(found),
            Err(why) => row.note = format!("error: {why}"),
        }
    }
    if fitted.len() < problem.sets.len() {
        return row;
    }
    // Every set has to be told of: the first that is not is what the row shows.
    let note = fitted.iter().map(told).min_by_key(String::len).unwrap_or_default();
    row.note = if note.is_empty() { note } else { format!("note: {note}") };
    let is_told = !row.note.is_empty();
    let mut tally = Tally::default();
    match &problem.expected {
        Expected::Curves(truths) => {
            fitted.iter().for_each(|f| tally.add(f, truths));
            tally.write(&mut row);
            row.judgement = match (tally.holds(), is_told) {
                (true, _) => Judgement::Holds,
                (false, true) => Judgement::Told,
                (false, false) => Judgement::Wrong,
            };
        }
        Expected::Words(truths) => {
            fitted.iter().for_each(|f| tally.add(f, truths));
            tally.write(&mut row);
            row.judgement = if is_told { Judgement::Told } else { Judgement::Wrong };
        }
        Expected::Law { base, factor } => {
            let others: Vec<Fitted> = fits(base).into_iter().flatten().collect();
            for (fitted, other) in fitted.iter().zip(&others) {
                let scaled: Vec<Vec<f64>> = other.curves.iter().map(|c| c.values.iter().map(|s| s * factor).collect()).collect();
                tally.add(fitted, &scaled);
                for (curve, of_base) in fitted.curves.iter().zip(&other.curves) {
                    let largest = of_base.standard_uncertainties().iter().fold(0.0f64, |most, u| most.max(*u)) * factor;
                    let both = curve.standard_uncertainties().into_iter().zip(of_base.standard_uncertainties());
                    let off = both.fold(0.0f64, |most, (u, other)| most.max((u - other * factor).abs()));
                    if off > LAW * largest {
                        row.note = format!("the uncertainties differ by {:.1e} of the largest", off / largest);
                        row.judgement = Judgement::Wrong;
                    }
                }
            }
            tally.write(&mut row);
            // Where two curves are the same numbers, bands say nothing.
            row.inside = None;
            let agrees = others.len() == fitted.len() && row.deviation.is_some_and(|d| d <= LAW);
            row.judgement = if agrees && row.note.is_empty() { Judgement::Holds } else { Judgement::Wrong };
        }
    }
    row
}
