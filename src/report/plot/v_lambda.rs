//! Luminous efficiency functions: V(λ), V′(λ), what lies between them, and the newer ones.
//!
//! ```text
//! V_mes,m(λ) = (m V(λ) + (1 − m) V′(λ)) / M(m)          m = 0 rods alone, m = 1 cones alone
//! K(λ)       = K_m V(λ)                                  absolute, lm/W
//! ```

use crate::observer::{Efficiency, mesopic};

use super::PlotError;
use super::chart::{Axis, Chart, Curve, Dash, Ink};
use super::sample::{listed, of_factor, strip, subscripted};

/// What is to be drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// The functions.
    pub functions: Vec<Efficiency>,
    /// Coefficients of adaptation m of mesopic functions between V′ and V, 0 to 1.
    pub mesopic: Vec<f64>,
    /// Luminous efficacy in lm/W in place of values relative to the peak.
    pub absolute: bool,
    /// A logarithmic axis.
    pub log: bool,
}

impl Default for Choice {
    fn default() -> Self {
        let functions = vec![Efficiency::Scotopic1951, Efficiency::Photopic1924, Efficiency::Physiological2];
        Self { functions, mesopic: vec![0.25, 0.5, 0.75], absolute: false, log: false }
    }
}

const FROM_NM: f64 = 380.0;
const TO_NM: f64 = 780.0;
/// Decades of a logarithmic axis.
const DECADES: f64 = 5.0;

fn style(function: Efficiency) -> (Ink, Dash, &'static str) {
    match function {
        Efficiency::Photopic1924 => (Ink::Palette(1), Dash::Solid, "CIE 1924"),
        Efficiency::Scotopic1951 => (Ink::Palette(0), Dash::Solid, "CIE 1951"),
        Efficiency::JuddVos1978 => (Ink::Palette(2), Dash::Dashed, "Judd–Vos 1978"),
        Efficiency::Physiological2 => (Ink::Palette(3), Dash::Dashed, "CIE 2015, 2°"),
        Efficiency::Physiological10 => (Ink::Palette(7), Dash::Dashed, "CIE 2015, 10°"),
        Efficiency::TenDegree1964 => (Ink::Palette(4), Dash::Dashed, "CIE 1964, 10°"),
    }
}

/// Luminous efficiency functions over wavelength. Errors if there is none, or an m lies outside 0 to 1.
pub fn chart(choice: &Choice) -> Result<Chart, PlotError> {
    let mut curves = Vec::new();
    let mut largest = 0.0_f64;
    for m in &choice.mesopic {
        let unit = if choice.absolute { mesopic::max_efficacy_lm_w(*m)? } else { 1.0 };
        largest = largest.max(unit);
        let points = of_factor(&mesopic::curve(*m)?.scaled(unit), FROM_NM, TO_NM);
        curves.push(Curve { width: 0.6, ..Curve::new(&format!("m = {m}"), points, Ink::Muted) });
    }
    for function in &choice.functions {
        let unit = if choice.absolute { function.max_efficacy_lm_w() } else { 1.0 };
        largest = largest.max(unit);
        let points = of_factor(&function.curve(), FROM_NM, TO_NM).into_iter().map(|[nm, value]| [nm, unit * value]).collect();
        let (ink, dash, _) = style(*function);
        curves.push(Curve::new(&subscripted(function.symbol()), points, ink).dashed(dash));
    }
    if curves.is_empty() {
        return Err(PlotError::Nothing { what: "no function was asked for".to_owned() });
    }
    let sources: Vec<String> =
        choice.functions.iter().map(|function| format!("{} {}", subscripted(function.symbol()), style(*function).2)).collect();
    let mesopic = if choice.mesopic.is_empty() { "" } else { "; mesopic CIE 191, adaptation m" };
    let (quantity, unit) = if choice.absolute { ("Luminous efficacy K(λ)", "lm/W") } else { ("Relative luminous efficiency", "peak = 1") };
    let y = if choice.log {
        let top = 10f64.powf(largest.log10().ceil());
        Axis::log(quantity, unit, top * 10f64.powf(-DECADES), if top < 1.2 * largest { 1.5 * top } else { top })
    } else {
        Axis::linear(quantity, unit, 0.0, 1.08 * largest)
    };
    let x = Axis::linear("Wavelength λ", "nm", FROM_NM, TO_NM);
    let subtitle = format!("{}{mesopic}", listed(&sources));
    Ok(Chart { curves, strip: strip(FROM_NM, TO_NM), ..Chart::new("Luminous efficiency of the eye", &subtitle, x, y) })
}
