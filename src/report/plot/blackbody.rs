//! Black bodies over wavelength, both axes logarithmic: Planck's law and the line of its peaks.
//!
//! ```text
//! L_λ(λ, T) = (2hc²/λ⁵) / (exp(c₂/(λT)) − 1)          M_λ = π L_λ          peak at λ T = 2.898·10⁶ nm K
//! ```

use crate::spectrum::black_body::{ln_spectral_radiance, peak_wavelength_nm};

use super::PlotError;
use super::axis::superscript;
use super::chart::{Axis, Chart, Curve, Dash, Ink, Span};
use super::sample::{every, strip};

/// Radiance or exitance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Spectral radiance, W m⁻² sr⁻¹ nm⁻¹.
    Radiance,
    /// Spectral exitance, W m⁻² nm⁻¹.
    Exitance,
}

/// Temperatures that are drawn when none are asked for, K: a room, a hot plate, illuminant A, the sun, a blue star.
pub const TEMPERATURES_K: [f64; 5] = [300.0, 1000.0, 2856.0, 5772.0, 20_000.0];

/// Range of temperatures, K.
const ALLOWED_K: (f64, f64) = (1.0, 1e7);
/// Most temperatures in one plot.
const MOST: usize = 12;
/// Points of a curve to each decade of wavelength.
const POINTS_A_DECADE: f64 = 200.0;

/// Black bodies over wavelength. Errors if there is no temperature, more than twelve, or one outside 1 K to 10⁷ K.
pub fn chart(temperatures_k: &[f64], quantity: Quantity) -> Result<Chart, PlotError> {
    if temperatures_k.is_empty() || temperatures_k.len() > MOST {
        return Err(PlotError::Request { what: format!("{} temperatures; allowed: 1 to {MOST}", temperatures_k.len()) });
    }
    if let Some(wrong) = temperatures_k.iter().find(|t| !(ALLOWED_K.0..=ALLOWED_K.1).contains(*t)) {
        return Err(PlotError::Request { what: format!("a temperature of {wrong} K; allowed: 1 K to 10⁷ K") });
    }
    let mut temperatures = temperatures_k.to_vec();
    temperatures.sort_by(f64::total_cmp);
    temperatures.dedup();
    let (coldest, hottest) = (temperatures[0], temperatures[temperatures.len() - 1]);
    let ln_factor = if quantity == Quantity::Exitance { std::f64::consts::PI.ln() } else { 0.0 };
    // Logarithms throughout, so that a cold body's far tail does not underflow before it is cut at the frame.
    let log10 = |nm: f64, t: f64| (ln_spectral_radiance(nm, t) + ln_factor) / std::f64::consts::LN_10;
    let peak = |t: f64| (peak_wavelength_nm(t), log10(peak_wavelength_nm(t), t));

    let bottom = peak(coldest).1.floor() - 2.0;
    let top = (peak(hottest).1 + 0.3).ceil();
    let x_from = 10f64.powf((peak(hottest).0 / 3.0).log10().floor());
    let x_to = 10f64.powf((10.0 * peak(coldest).0).log10().ceil());
    let (low, high) = (x_from.log10(), x_to.log10());
    let mut curves = Vec::new();
    if temperatures.len() > 1 {
        let line = every(coldest.ln(), hottest.ln(), 0.05).into_iter().map(|ln_t| peak(ln_t.exp()));
        let points = line.map(|(nm, log10)| [nm, 10f64.powf(log10)]).collect();
        curves.push(Curve::new("", points, Ink::Muted).behind().dashed(Dash::Dashed));
    }
    for (index, t) in temperatures.iter().enumerate() {
        let values = every(low, high, 1.0 / POINTS_A_DECADE).into_iter().map(|log_nm| (10f64.powf(log_nm), log10(10f64.powf(log_nm), *t)));
        let seen = values.filter(|(_, log)| *log >= bottom - 2.0).map(|(nm, log)| [nm, 10f64.powf(log)]);
        curves.push(Curve::new(&kelvin(*t), seen.collect(), warm_to_cold(index, temperatures.len())));
    }
    let (name, unit) = match quantity {
        Quantity::Radiance => ("Spectral radiance L_{λ}", "W m⁻² sr⁻¹ nm⁻¹"),
        Quantity::Exitance => ("Spectral exitance M_{λ}", "W m⁻² nm⁻¹"),
    };
    let x = Axis::log("Wavelength λ", "nm", x_from, x_to);
    let y = Axis::log(name, unit, 10f64.powf(bottom), 10f64.powf(top));
    let subtitle = if temperatures.len() > 1 { "Planck’s law; dashed: the peaks, λT = 2.898·10⁶ nm K" } else { "Planck’s law" };
    let visible = Span { label: "visible".to_owned(), from: 380.0, to: 780.0 };
    let spans = if x_from < 780.0 && x_to > 380.0 { vec![visible] } else { Vec::new() };
    Ok(Chart { curves, spans, strip: strip(x_from, x_to), ..Chart::new("Black bodies", subtitle, x, y) })
}

/// `2856 K`; powers of ten where the digits would be many.
fn kelvin(temperature_k: f64) -> String {
    if temperature_k < 1e5 {
        return format!("{temperature_k} K");
    }
    let exponent = temperature_k.log10().floor();
    let digits = format!("{:.3}", temperature_k / 10f64.powf(exponent));
    match digits.trim_end_matches('0').trim_end_matches('.') {
        "1" => format!("10{} K", superscript(exponent as i64)),
        digits => format!("{digits}·10{} K", superscript(exponent as i64)),
    }
}

/// Reds for the coldest, blues for the hottest, of the palette.
fn warm_to_cold(index: usize, count: usize) -> Ink {
    const ORDER: [usize; 6] = [7, 1, 4, 2, 5, 0];
    let step = if count > 1 { (index * (ORDER.len() - 1) + (count - 1) / 2) / (count - 1) } else { 0 };
    Ink::Palette(if count > ORDER.len() { index } else { ORDER[step.min(ORDER.len() - 1)] })
}
