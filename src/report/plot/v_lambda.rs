//! Luminous efficiency functions: V(λ).

use crate::spectrum::library;

use super::PlotError;
use super::chart::{Axis, Chart, Curve, Ink, Under};

/// V(λ).
pub fn chart() -> Result<Chart, PlotError> {
    let x = Axis::linear("Wavelength λ", "nm", 380.0, 780.0);
    let y = Axis::linear("Relative luminous efficiency", "1 at the peak", 0.0, 1.05);
    let mut chart = Chart::new("Luminous efficiency", "CIE 1924", x, y);
    let v = library::v_lambda();
    let points = (380..=780).map(|nm| [f64::from(nm), v.at(f64::from(nm))]).collect();
    chart.curves.push(Curve::new("V(λ)", points, Ink::Palette(0)).filled(Under::Tint));
    Ok(chart)
}
