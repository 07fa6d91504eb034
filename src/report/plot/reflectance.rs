//! Reflectances over wavelength, each drawn in the colour it has under daylight.
//!
//! Colour: CIE 1931 under D65, as sRGB; what the screen cannot show is mixed with grey of the same luminance.

use crate::observer::Matching;
use crate::observer::colour::{Gamut, Srgb, Tristimulus};
use crate::spectrum::{Factor, library};

use super::PlotError;
use super::chart::{Axis, Chart, Curve, Ink};
use super::sample::{of_factor, strip};

/// A reflectance with its name.
#[derive(Debug, Clone, PartialEq)]
pub struct Item {
    /// What it is called.
    pub name: String,
    /// The reflectance.
    pub factor: Factor,
}

const FROM_NM: f64 = 380.0;
const TO_NM: f64 = 780.0;

/// Reflectances over wavelength. Errors if there is none, or one without a value in the visible.
pub fn chart(title: &str, items: &[Item]) -> Result<Chart, PlotError> {
    if items.is_empty() {
        return Err(PlotError::Nothing { what: "no reflectance was asked for".to_owned() });
    }
    let (d65, matching) = (library::density("D65")?, Matching::Cie1931.functions());
    let white = Tristimulus::of(&d65, &matching);
    let mut curves = Vec::new();
    for Item { name, factor } in items {
        let points = of_factor(factor, FROM_NM, TO_NM);
        if points.is_empty() {
            return Err(PlotError::Nothing { what: format!("`{name}` has no values from {FROM_NM} nm to {TO_NM} nm") });
        }
        // Relative to white, whose Y is 1.
        let seen = Tristimulus::of(&d65.filtered(factor), &matching).scaled(1.0 / white.y);
        let ink = Srgb::of(&seen, Gamut::Desaturate).map_or(Ink::Text, |colour| Ink::Fixed(colour.bytes));
        curves.push(Curve::new(name, points, ink));
    }
    let largest = curves.iter().flat_map(|curve| &curve.points).map(|point| point[1]).fold(0.0, f64::max);
    let (from, to) = extent(&curves);
    let y = Axis::linear("Spectral reflectance factor", "1", 0.0, if largest > 0.75 { largest.max(1.0) } else { 1.1 * largest });
    let x = Axis::linear("Wavelength λ", "nm", from, to);
    let subtitle = "Each line in the colour of the sample under D65 (CIE 1931, sRGB)";
    Ok(Chart { curves, strip: strip(from, to), ..Chart::new(title, subtitle, x, y) })
}

/// First and last wavelength of all curves.
fn extent(curves: &[Curve]) -> (f64, f64) {
    let nm = || curves.iter().flat_map(|curve| &curve.points).map(|point| point[0]);
    (nm().fold(TO_NM, f64::min), nm().fold(FROM_NM, f64::max))
}
