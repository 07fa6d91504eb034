//! Spectral distributions over wavelength: continua as curves, lines as lines.
//!
//! A continuum is per nm and a line is not, so a line has an axis of its own at the right. Of a spectrum with both, the right axis is in
//! the unit of the left one times nm.

use crate::spectrum::Density;
use crate::spectrum::library::RELATIVE;

use super::PlotError;
use super::chart::{Axis, Chart, Curve, Dash, Impulse, Ink, Under};
use super::sample::{of_density, strip, wavelength_ink};

/// A spectrum with its name.
#[derive(Debug, Clone, PartialEq)]
pub struct Item {
    /// What it is called.
    pub name: String,
    /// The spectrum.
    pub density: Density,
}

/// What a height of one means.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scaling {
    /// The largest value of each continuum; of lines alone the strongest.
    Peak,
    /// The value of each continuum at 560 nm.
    At560Nm,
    /// What the numbers say.
    AsGiven,
}

/// What is to be drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// The spectra.
    pub items: Vec<Item>,
    /// What a height of one means.
    pub scaling: Scaling,
    /// Unit of the spectra if they are drawn as given; empty if it is not known.
    pub unit: String,
    /// First wavelength, nm.
    pub from_nm: f64,
    /// Last wavelength, nm.
    pub to_nm: f64,
}

/// Most lines that bear their wavelength.
const MOST_NAMED_LINES: usize = 12;

/// Colours of the palette; with more spectra they come again, dashed and then dotted.
const COLOURS: usize = 8;
/// How the spectra of each round of colours are broken.
const DASHES: [Dash; 3] = [Dash::Solid, Dash::Dashed, Dash::Dotted];

/// Spectra over wavelength. Errors if there is none, if one is zero in the range or where it is to be one, and if a structure is too
/// narrow to be drawn.
pub fn chart(choice: &Choice) -> Result<Chart, PlotError> {
    let Choice { items, scaling, from_nm, to_nm, .. } = choice;
    let range = *from_nm..=*to_nm;
    if items.is_empty() {
        return Err(PlotError::Nothing { what: "no spectrum was asked for".to_owned() });
    }
    if items.len() > COLOURS * DASHES.len() {
        let most = COLOURS * DASHES.len();
        return Err(PlotError::Request { what: format!("{} spectra; at most {most} can be told apart in one plot", items.len()) });
    }
    let mut chart_curves = Vec::new();
    let mut impulses = Vec::new();
    for (index, item) in items.iter().enumerate() {
        let name = &item.name;
        let points = of_density(&item.density, name, *from_nm, *to_nm)?;
        let lines: Vec<_> = item.density.lines().into_iter().filter(|line| range.contains(&line.wavelength_nm)).collect();
        let peak = points.iter().map(|point| point[1]).fold(0.0, f64::max);
        let strongest = lines.iter().map(|line| line.power).fold(0.0, f64::max);
        if peak == 0.0 && strongest == 0.0 {
            let what = format!("`{name}` is zero from {from_nm} nm to {to_nm} nm");
            return Err(PlotError::Nothing { what });
        }
        let one = match scaling {
            Scaling::AsGiven => 1.0,
            Scaling::Peak if peak > 0.0 => peak,
            Scaling::Peak => strongest,
            Scaling::At560Nm => item.density.continuum_at(560.0),
        };
        if !(one > 0.0 && one.is_finite()) {
            let what = format!("`{name}` is zero at 560 nm and cannot be drawn relative to its value there; draw it relative to its peak");
            return Err(PlotError::Request { what });
        }
        let points: Vec<[f64; 2]> = points.into_iter().map(|[nm, value]| [nm, value / one]).collect();
        if peak > 0.0 {
            let ink = if items.len() == 1 { Ink::Text } else { Ink::Palette(index) };
            let under = if items.len() == 1 { Under::Spectral } else { Under::Nothing };
            // The title names the only one.
            let label = if items.len() == 1 { "" } else { name };
            let curve = Curve::new(label, points, ink).filled(under).dashed(DASHES[index / COLOURS]);
            chart_curves.push(Curve { width: if items.len() == 1 { 0.7 } else { 1.0 }, ..curve });
        }
        let alone = items.len() == 1;
        // The curve of a spectrum bears its name; of lines alone, the strongest does.
        let mut bearer = (!alone && peak == 0.0).then_some(strongest);
        for line in &lines {
            let label = if alone && lines.len() <= MOST_NAMED_LINES {
                format!("{} nm", rounded(line.wavelength_nm))
            } else if bearer.take_if(|power| *power == line.power).is_some() {
                name.clone()
            } else {
                String::new()
            };
            let ink = match (items.len(), peak > 0.0) {
                (1, false) => wavelength_ink(line.wavelength_nm),
                // In front of the same colours only another is seen.
                (1, true) => Ink::Text,
                _ => Ink::Palette(index),
            };
            impulses.push(Impulse { label, x: line.wavelength_nm, height: line.power / one, ink });
        }
    }
    let names: Vec<&str> = items.iter().map(|item| item.name.as_str()).collect();
    let title = if names.len() == 1 { names[0].to_owned() } else { "Spectral distributions".to_owned() };
    let given = match choice.unit.as_str() {
        "" => "unit as given, per nm",
        RELATIVE => "relative, per nm",
        unit => unit,
    };
    let (unit, subtitle) = match scaling {
        Scaling::Peak => ("peak = 1".to_owned(), "each relative to its largest value"),
        Scaling::At560Nm => ("560 nm = 1".to_owned(), "each relative to its value at 560 nm"),
        Scaling::AsGiven => (given.to_owned(), "as given"),
    };
    let subtitle = if names.len() == 1 { subtitle.replace("each ", "") } else { format!("{}; {subtitle}", names.join(", ")) };
    let x = Axis::linear("Wavelength λ", "nm", *from_nm, *to_nm);
    let highest = chart_curves.iter().flat_map(|curve: &Curve| &curve.points).map(|point| point[1]).fold(0.0, f64::max);
    let strongest = impulses.iter().map(|impulse: &Impulse| impulse.height).fold(0.0, f64::max);
    let power_unit = match scaling {
        Scaling::AsGiven if choice.unit.is_empty() => "unit as given".to_owned(),
        Scaling::AsGiven if choice.unit == RELATIVE => "relative".to_owned(),
        Scaling::AsGiven => line_unit(&choice.unit),
        _ if chart_curves.is_empty() => "strongest = 1".to_owned(),
        _ => "nm · unit of the left axis".to_owned(),
    };
    // Room above the highest line for its wavelength.
    let power = |top: f64| Axis::linear("Power of a line", &power_unit, 0.0, 1.14 * top);
    let (y, impulse_axis) = match (chart_curves.is_empty(), impulses.is_empty()) {
        (true, _) => (power(strongest), None),
        (false, true) => (Axis::linear("Spectral distribution", &unit, 0.0, 1.1 * highest), None),
        (false, false) => (Axis::linear("Continuum", &unit, 0.0, 1.14 * highest), Some(power(strongest))),
    };
    // Names stay as they are.
    let subtitle = if names.len() == 1 { capitalised(&subtitle) } else { subtitle };
    Ok(Chart { curves: chart_curves, impulses, impulse_axis, strip: strip(*from_nm, *to_nm), ..Chart::new(&title, &subtitle, x, y) })
}

/// The unit of a line from that of the continuum, which is per nm.
fn line_unit(unit: &str) -> String {
    let bare = ["/nm", " nm⁻¹", "·nm⁻¹"].iter().find_map(|end| unit.strip_suffix(end));
    bare.map_or_else(|| format!("({unit}) · nm"), str::to_owned)
}

/// A wavelength with at most two decimals.
fn rounded(nm: f64) -> String {
    format!("{nm:.2}").trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::{Line, library};

    #[test]
    fn every_one_of_several_spectra_is_named_once() {
        let lines = [(435.83, 1.0), (546.07, 3.0)].map(|(wavelength_nm, power)| Line { wavelength_nm, power });
        let items = [("D65", library::density("D65").unwrap()), ("mercury", Density::lines_only(&lines).unwrap())];
        let items = items.map(|(name, density)| Item { name: name.to_owned(), density }).to_vec();
        let choice = Choice { items, scaling: Scaling::Peak, unit: String::new(), from_nm: 380.0, to_nm: 780.0 };
        let chart = chart(&choice).unwrap();
        let curves: Vec<&str> = chart.curves.iter().map(|curve| curve.label.as_str()).collect();
        let impulses: Vec<(f64, &str)> = chart.impulses.iter().map(|impulse| (impulse.x, impulse.label.as_str())).collect();
        assert_eq!((curves, impulses), (vec!["D65"], vec![(435.83, ""), (546.07, "mercury")]));
    }
}
