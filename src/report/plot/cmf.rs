//! Colour-matching functions over wavelength: x̄ ȳ z̄ and r̄ ḡ b̄.

use crate::observer::Matching;

use super::PlotError;
use super::chart::{Axis, Chart, Curve, Dash, Ink, Key};
use super::sample::{of_factor, strip, subscripted};

const FROM_NM: f64 = 380.0;
const TO_NM: f64 = 780.0;
/// How the sets are told apart: dashes, and width.
const LINES: [(Dash, f64); 4] = [(Dash::Solid, 1.0), (Dash::Dashed, 1.0), (Dash::Dotted, 1.0), (Dash::Solid, 0.5)];
const INKS: [Ink; 3] = [Ink::Palette(1), Ink::Palette(2), Ink::Palette(0)];

/// Sets of colour-matching functions. Errors if there is none, more than four, or sets with real and with imaginary primaries, whose units
/// differ.
pub fn chart(sets: &[Matching]) -> Result<Chart, PlotError> {
    if sets.is_empty() || sets.len() > LINES.len() {
        let what = format!("{} sets of colour-matching functions; 1 to {} can be told apart in one plot", sets.len(), LINES.len());
        return Err(PlotError::Request { what });
    }
    let real = sets[0].has_real_primaries();
    if let Some(other) = sets.iter().find(|set| set.has_real_primaries() != real) {
        let what = format!(
            "`{}` and `{}` in one plot: r̄ ḡ b̄ are in units of their own primaries, x̄ ȳ z̄ in those of Y; draw them apart",
            sets[0].title(),
            other.title()
        );
        return Err(PlotError::Request { what });
    }
    let mut curves = Vec::new();
    if real {
        curves.push(Curve::new("", vec![[FROM_NM, 0.0], [TO_NM, 0.0]], Ink::Muted).behind());
    }
    for (set, (dash, width)) in sets.iter().zip(LINES) {
        for ((function, name), ink) in set.functions().iter().zip(set.names()).zip(INKS) {
            let symbol = subscripted(name);
            // The first set bears the symbols; the others are told from it by their dashes.
            let first = curves.len() < INKS.len() + usize::from(real);
            let written = Some(if !first {
                String::new()
            } else if sets.len() == 1 {
                symbol.clone()
            } else {
                bare(name).to_owned()
            });
            let label = if sets.len() == 1 { symbol } else { format!("{symbol} {}", year(*set)) };
            curves.push(Curve { width, written, ..Curve::new(&label, of_factor(function, FROM_NM, TO_NM), ink).dashed(dash) });
        }
    }
    let values = || curves.iter().flat_map(|curve| &curve.points).map(|point| point[1]);
    let (least, largest) = (values().fold(0.0, f64::min), values().fold(0.0, f64::max));
    let bottom = if least < 0.0 { least - 0.06 * (largest - least) } else { 0.0 };
    let symbols = if real { "r̄, ḡ, b̄" } else { "x̄, ȳ, z̄" };
    let y = Axis::linear(&format!("Colour-matching functions {symbols}"), "1", bottom, 1.08 * largest);
    let x = Axis::linear("Wavelength λ", "nm", FROM_NM, TO_NM);
    let titles: Vec<&str> = sets.iter().map(|set| set.title()).collect();
    let keys = sets.iter().zip(LINES).map(|(set, (dash, width))| Key { text: year(*set), width, dash });
    let keys = if sets.len() > 1 { keys.collect() } else { Vec::new() };
    Ok(Chart { curves, keys, strip: strip(FROM_NM, TO_NM), ..Chart::new("Colour-matching functions", &titles.join(" · "), x, y) })
}

/// The symbol without what tells sets apart.
fn bare(symbol: &str) -> &str {
    let end = symbol.find(|c: char| c == '_' || ('₀'..='₉').contains(&c)).unwrap_or(symbol.len());
    &symbol[..end]
}

/// The year of a set, and its field where two sets have the same year.
fn year(set: Matching) -> String {
    let title = set.title();
    let year = title.split_whitespace().find(|word| word.len() == 4 && word.chars().all(|c| c.is_ascii_digit())).unwrap_or(title);
    match set {
        Matching::Cie2015TwoDegree => format!("{year}, 2°"),
        Matching::Cie2015TenDegree => format!("{year}, 10°"),
        _ => year.to_owned(),
    }
}
