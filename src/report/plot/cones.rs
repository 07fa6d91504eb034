//! Cone fundamentals over wavelength, of standard observers and of any age and field (CIE 170-1).

use crate::observer::{Cone, Cones, Individual};

use super::PlotError;
use super::chart::{Axis, Chart, Curve, Dash, Ink, Key};
use super::sample::{of_factor, on_whole_nm, strip};

/// What is to be drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// The sets of fundamentals, at most four.
    pub sets: Vec<Cones>,
    /// Share of the photons at the cornea that the pigment absorbs, in place of fundamentals relative to their peak. Only of ages and fields.
    pub quantal: bool,
    /// A logarithmic axis.
    pub log: bool,
}

const FROM_NM: f64 = 390.0;
const TO_NM: f64 = 780.0;
/// Decades of a logarithmic axis.
const DECADES: f64 = 5.0;
/// How the sets are told apart: dashes, and width.
const LINES: [(Dash, f64); 4] = [(Dash::Solid, 1.0), (Dash::Dashed, 1.0), (Dash::Dotted, 1.0), (Dash::Solid, 0.5)];

/// Colours of L, M and S, here and wherever cones are drawn.
pub(super) const INKS: [Ink; 3] = [Ink::Palette(1), Ink::Palette(2), Ink::Palette(0)];

/// Cone fundamentals. Errors if there is no set, or more than four, or an age or field outside its range.
pub fn chart(choice: &Choice) -> Result<Chart, PlotError> {
    if choice.sets.is_empty() || choice.sets.len() > LINES.len() {
        let what = format!("{} sets of cone fundamentals; 1 to {} can be told apart in one plot", choice.sets.len(), LINES.len());
        return Err(PlotError::Request { what });
    }
    let mut curves = Vec::new();
    for (set, (dash, width)) in choice.sets.iter().zip(LINES) {
        let points = match (choice.quantal, set) {
            (false, _) => set.fundamentals()?.map(|cone| of_factor(&cone, FROM_NM, TO_NM)).to_vec(),
            (true, Cones::Individual(individual)) => {
                let of = |cone| on_whole_nm(FROM_NM, TO_NM, |nm| individual.quantal_sensitivity(cone, nm));
                Cone::ALL.into_iter().map(of).collect::<Result<_, _>>()?
            }
            (true, _) => {
                let what = format!("{} has no absolute sensitivity; give an age or a field", set.title());
                return Err(PlotError::Request { what });
            }
        };
        for ((cone, ink), points) in Cone::ALL.into_iter().zip(INKS).zip(points) {
            let label =
                if choice.sets.len() == 1 { cone.name().to_owned() } else { format!("{} {}", cone.name(), distinction(*set, choice)) };
            // The first set bears the names; the others are told from it by their dashes.
            let written = Some(if curves.len() < Cone::ALL.len() { cone.name().to_owned() } else { String::new() });
            // A fundamental is zero by definition where it was not measured; a line along the axis would say that it was.
            let end = points.iter().rposition(|point: &[f64; 2]| point[1] > 0.0).map_or(0, |last| last + 1);
            let points = if choice.log { points[..end].to_vec() } else { points };
            curves.push(Curve { width, written, ..Curve::new(&label, points, ink).dashed(dash) });
        }
    }
    let largest = curves.iter().flat_map(|curve| &curve.points).map(|point| point[1]).fold(0.0, f64::max);
    let (quantity, unit) =
        if choice.quantal { ("Photons absorbed of those at the cornea", "1") } else { ("Cone fundamental, energy", "peak = 1") };
    let y = if choice.log {
        let top = 10f64.powf((largest.log10() - 1e-9).ceil());
        Axis::log(quantity, unit, top * 10f64.powf(-DECADES), 1.5 * top)
    } else {
        Axis::linear(quantity, unit, 0.0, 1.08 * largest)
    };
    let x = Axis::linear("Wavelength λ", "nm", FROM_NM, TO_NM);
    let titles: Vec<String> = choice.sets.iter().map(|set| set.title()).collect();
    let subtitle = titles.join(" · ");
    let keys = choice.sets.iter().zip(LINES).map(|(set, (dash, width))| Key { text: distinction(*set, choice), width, dash });
    let keys = if choice.sets.len() > 1 { keys.collect() } else { Vec::new() };
    Ok(Chart { curves, keys, strip: strip(FROM_NM, TO_NM), ..Chart::new("Sensitivity of the cones", &subtitle, x, y) })
}

/// What a set differs in from the others of the plot.
fn distinction(set: Cones, choice: &Choice) -> String {
    let individuals = choice.sets.iter().filter_map(|set| if let Cones::Individual(one) = set { Some(*one) } else { None });
    let individuals: Vec<Individual> = individuals.collect();
    let all = individuals.len() == choice.sets.len();
    let same = |of: fn(&Individual) -> f64| all && individuals.windows(2).all(|pair| of(&pair[0]) == of(&pair[1]));
    match set {
        Cones::StockmanSharpe2 => "2°".to_owned(),
        Cones::StockmanSharpe10 => "10°".to_owned(),
        Cones::Individual(Individual { field_deg, .. }) if individuals.len() < choice.sets.len() => format!("{field_deg}°"),
        Cones::Individual(Individual { field_deg, .. }) if same(|one| one.age_yr) => format!("{field_deg}°"),
        Cones::Individual(Individual { age_yr, .. }) if same(|one| one.field_deg) => format!("{age_yr} years"),
        Cones::Individual(Individual { age_yr, field_deg }) => format!("{age_yr} years, {field_deg}°"),
    }
}
