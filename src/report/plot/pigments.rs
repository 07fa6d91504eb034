//! Photopigments over wavelength: what the pigments of cones and rods absorb.
//!
//! ```text
//! absorbance   A(λ)                  relative to its peak, of a thin layer
//! absorptance  1 − 10^(−D A(λ))      share of the photons that arrive at the receptor
//! ```
//!
//! Cones: CIE 170-1 with the peak densities D of the field. Rods: the template of Govardovskii (2000) with its maximum at 498 nm, the mean
//! of human rods measured by Bowmaker and Dartnall (J. Physiol. 298 (1980) 501), and an axial density that the caller states.

use crate::observer::{Components, Cone, Individual, template};

use super::PlotError;
use super::chart::{Axis, Chart, Curve, Dash, Ink};
use super::cones::INKS;
use super::sample::{on_whole_nm, strip};

/// Wavelength of the maximum of human rods, nm.
pub const ROD_MAXIMUM_NM: f64 = 498.0;

/// What is drawn of a pigment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Relative to its peak.
    Absorbance,
    /// Share of the photons.
    Absorptance,
}

/// What is to be drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// Absorbance or absorptance.
    pub quantity: Quantity,
    /// Age and field: peak densities, and what lens and macula transmit.
    pub individual: Individual,
    /// Peak optical density of rods along their axis; `None` leaves the rods out.
    pub rod_density: Option<f64>,
    /// Transmittance of lens and macula beside the pigments.
    pub media: bool,
    /// A logarithmic axis.
    pub log: bool,
}

impl Default for Choice {
    fn default() -> Self {
        let individual = Individual { age_yr: 32.0, field_deg: 2.0 };
        Self { quantity: Quantity::Absorptance, individual, rod_density: Some(0.4), media: false, log: false }
    }
}

const FROM_NM: f64 = 390.0;
const TO_NM: f64 = 780.0;
/// Decades of a logarithmic axis.
const DECADES: f64 = 5.0;

/// Pigments over wavelength. Errors if age, field or density are out of range.
pub fn chart(choice: &Choice) -> Result<Chart, PlotError> {
    let one = choice.individual.checked()?;
    let components = Components::cie()?;
    let mut curves = Vec::new();
    if choice.media {
        let lens = on_whole_nm(FROM_NM, TO_NM, |nm| one.lens_density(nm).map(|density| 10f64.powf(-density)))?;
        let macula = on_whole_nm(FROM_NM, TO_NM, |nm| one.macular_density(nm).map(|density| 10f64.powf(-density)))?;
        curves.push(Curve::new("lens transmits", lens, Ink::Muted).behind());
        curves.push(Curve::new("macula transmits", macula, Ink::Muted).behind().dashed(Dash::Dashed));
    }
    let absorbed = |density: f64, absorbance: f64| -(-density * absorbance * std::f64::consts::LN_10).exp_m1();
    if let Some(density) = choice.rod_density {
        if !(density > 0.0 && density <= 5.0) {
            return Err(PlotError::Request { what: format!("the optical density of the rods is {density}; allowed: above 0, to 5") });
        }
        let points = on_whole_nm(FROM_NM, TO_NM, |nm| {
            let absorbance = template::govardovskii(ROD_MAXIMUM_NM, nm)?;
            Ok::<_, PlotError>(if choice.quantity == Quantity::Absorbance { absorbance } else { absorbed(density, absorbance) })
        })?;
        curves.push(Curve::new("rods", points, Ink::Palette(6)));
    }
    for (cone, ink) in [Cone::S, Cone::M, Cone::L].into_iter().zip([INKS[2], INKS[1], INKS[0]]) {
        let points = on_whole_nm(FROM_NM, TO_NM, |nm| match choice.quantity {
            Quantity::Absorbance => components.absorbance(cone, nm),
            Quantity::Absorptance => one.absorptance(cone, nm),
        })?;
        curves.push(Curve::new(&format!("{} cones", cone.name()), points, ink));
    }
    let mut sources = Vec::new();
    let (title, quantity, unit) = match choice.quantity {
        Quantity::Absorbance => {
            sources.push("Cones CIE 170-1, low density".to_owned());
            ("Absorbance of the photopigments", "Absorbance", "peak = 1")
        }
        Quantity::Absorptance => {
            let [lm, s] = [Cone::L, Cone::S].map(|cone| one.peak_optical_density(cone));
            sources.push(format!("Cones CIE 170-1, {}° field: densities {lm:.2} (L, M), {s:.2} (S)", one.field_deg));
            ("Absorption by the photopigments", "Absorptance, share of the photons at the receptor", "1")
        }
    };
    if let Some(density) = choice.rod_density {
        let density = if choice.quantity == Quantity::Absorptance { format!(", density {density}") } else { String::new() };
        sources.push(format!("rods Govardovskii template, {ROD_MAXIMUM_NM} nm{density}"));
    }
    if choice.media {
        sources.push(format!("media {} years, {}°", one.age_yr, one.field_deg));
    }
    let largest = curves.iter().flat_map(|curve| &curve.points).map(|point| point[1]).fold(0.0, f64::max);
    let y = if choice.log {
        Axis::log(quantity, unit, 10f64.powf(-DECADES), 1.5)
    } else {
        Axis::linear(quantity, unit, 0.0, if largest > 0.9 { 1.08 * largest } else { 1.12 * largest })
    };
    let x = Axis::linear("Wavelength λ", "nm", FROM_NM, TO_NM);
    Ok(Chart { curves, strip: strip(FROM_NM, TO_NM), ..Chart::new(title, &sources.join("; "), x, y) })
}
