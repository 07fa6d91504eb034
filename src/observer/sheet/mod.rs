//! Every quantity of one spectrum, as rows.
//!
//! ```text
//! I_k = ∫ φ(λ) s_k(λ) dλ          functionals: 1, λ, λ/(hc), V, V′, s_α, l̄ m̄ s̄, x̄ ȳ z̄, …
//! q = f(I_1, I_2, …)              rows: totals, ratios, chromaticities, temperatures
//! u²(q) = Jᵀ C J                  where the table of φ carries standard uncertainties; J = ∂f/∂I, C = cov(I)
//! ```
//!
//! | file | what |
//! |---|---|
//! | `functional` | the integrals, and their weights on the rows of a table |
//! | `words` | names, symbols and units of the totals |
//! | `totals`, `colour_rows` | the rows |
//! | `propagation` | standard uncertainties |
//! | `coverage` | what of the weighting functions lies outside the table |
//!
//! An absolute spectrum gives absolute quantities. A relative one is scaled to an illuminance or an irradiance that is stated, so that
//! no number is without a unit; its ratios do not depend on the scale.
//!
//! ```
//! use etendue::observer::sheet::{SheetOptions, SpectrumSheet};
//! use etendue::spectrum::library;
//!
//! // 1000 lx from an incandescent lamp are about 496 lx of daylight to the melanopsin of the eye.
//! let sheet = SpectrumSheet::new(&library::density("A")?, &SheetOptions::default())?;
//! let edi = sheet.number("mel_equivalent_daylight").ok_or("no such row")?;
//! assert!((edi - 496.0).abs() < 1.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod colour_rows;
mod coverage;
mod functional;
mod propagation;
mod totals;
mod words;

pub use words::SpectralQuantity;

use super::colour::{Chromaticity, Tristimulus};
use super::{Matching, ObserverError};
use crate::quantity::constants::K_M_LM_W;
use crate::spectrum::{Density, Factor, library};
use functional::{Functional, Functionals};

/// How the numbers of the density are to be read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scale {
    /// The density is absolute: W nm⁻¹ and so on.
    Absolute(SpectralQuantity),
    /// Relative; scaled to 1000 lx, or to 1 W m⁻² if it has less than 0.001 lm W⁻¹: what is next to invisible is no illuminance.
    Relative,
    /// Scaled to this illuminance, lx.
    Illuminance(f64),
    /// Scaled to this irradiance, W m⁻².
    Irradiance(f64),
}

/// Standard uncertainties of the rows of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct RowUncertainty {
    /// The wavelengths of the table that the density is, nm.
    pub wavelengths_nm: Vec<f64>,
    /// The standard uncertainty of each row, in the unit of the density.
    pub standard_uncertainty: Vec<f64>,
    /// Whether the rows err together (one factor for all, stray light) rather than each on its own (noise).
    pub correlated: bool,
}

/// What is to be stated, and how.
#[derive(Debug, Clone, PartialEq)]
pub struct SheetOptions {
    /// How the numbers of the density are to be read.
    pub scale: Scale,
    /// The illuminant from which dominant wavelength and purity are counted: a name of the library.
    pub white: String,
    /// Luminance to which the eye is adapted, cd m⁻², for the mesopic quantities.
    pub adaptation_cd_m2: f64,
    /// First and last wavelength that the spectrum was given for, nm, if it ends there rather than being zero.
    pub range_nm: Option<(f64, f64)>,
    /// Standard uncertainties, if the spectrum has them.
    pub uncertainty: Option<RowUncertainty>,
}

impl Default for SheetOptions {
    /// Relative, white E, an eye adapted to 1 cd m⁻².
    fn default() -> Self {
        Self { scale: Scale::Relative, white: "E".into(), adaptation_cd_m2: 1.0, range_nm: None, uncertainty: None }
    }
}

/// The value of a row.
#[derive(Debug, Clone, PartialEq)]
pub enum SheetValue {
    /// A number in the unit of the row.
    Number(f64),
    /// A text, such as the code of a colour.
    Text(String),
    /// Not defined for this spectrum, and why.
    Undefined(String),
}

/// Parts of the sheet, in their order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Group {
    /// Where the spectrum lies.
    Shape,
    /// In energy.
    Radiant,
    /// In photons.
    Photon,
    /// By day, by night, in between.
    Luminous,
    /// CIE S 026.
    AlphaOpic,
    /// Excitations of the cones.
    Cones,
    /// Tristimulus values and chromaticities.
    Tristimulus,
    /// What the light looks like.
    Colour,
}

impl Group {
    /// All groups, in their order.
    pub const ALL: [Self; 8] =
        [Self::Shape, Self::Radiant, Self::Photon, Self::Luminous, Self::AlphaOpic, Self::Cones, Self::Tristimulus, Self::Colour];

    /// Heading of the group.
    pub fn title(self) -> &'static str {
        match self {
            Self::Shape => "Spectrum",
            Self::Radiant => "Radiant",
            Self::Photon => "Photon",
            Self::Luminous => "Luminous",
            Self::AlphaOpic => "α-opic (CIE S 026)",
            Self::Cones => "Cone excitation (CIE 170-1)",
            Self::Tristimulus => "Tristimulus values (Y = 100) and chromaticity",
            Self::Colour => "Colour (CIE 1931 observer)",
        }
    }
}

/// How many digits of a number without uncertainty are worth showing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Digits {
    /// Significant digits.
    Significant(usize),
    /// Places behind the decimal point, for what lives on a fixed scale.
    Decimals(usize),
}

/// One quantity of the sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct SheetRow {
    /// Name for programs, such as `mel_equivalent_daylight`. No two rows share one.
    pub id: String,
    /// The part of the sheet that it belongs to.
    pub group: Group,
    /// What it is, such as "illuminance" or, in a table, the label of its line.
    pub name: String,
    /// The heading of its column if the group is a table; else empty.
    pub column: String,
    /// Symbol, such as "E_v".
    pub symbol: String,
    /// The value.
    pub value: SheetValue,
    /// Unit symbol; "1" for a number.
    pub unit: String,
    /// Standard uncertainty, in the same unit, if the spectrum carries one.
    pub standard_uncertainty: Option<f64>,
    /// Digits worth showing.
    pub digits: Digits,
}

/// Every quantity of one spectrum.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectrumSheet {
    /// How the numbers of the spectrum were read, in words.
    pub scale: String,
    /// The quantities.
    pub rows: Vec<SheetRow>,
    /// What is to be known about them.
    pub remarks: Vec<String>,
}

/// A row before it has a value: what it computes from the integrals.
struct Definition {
    row: SheetRow,
    compute: Box<Compute>,
}

/// From the integrals to a value.
type Compute = dyn Fn(&Integrals<'_>) -> SheetValue;
/// The integrals, by what they are of.
type Integrals<'a> = dyn Fn(Functional) -> f64 + 'a;

impl SpectrumSheet {
    /// Every quantity of `density`.
    ///
    /// # Errors
    /// [`ObserverError`] if the density is zero, an option is out of range, or the density cannot be scaled as asked for.
    pub fn new(density: &Density, options: &SheetOptions) -> Result<Self, ObserverError> {
        let functionals = Functionals::new()?;
        let integrals = functionals.integrals(density);
        let get = |wanted: Functional| functionals.pick(&integrals, wanted);
        if get(Functional::Radiant) == 0.0 {
            let (what, why) = ("the spectrum", "there is nothing to be said of it");
            return Err(ObserverError::Zero { what: what.into(), why: why.into() });
        }
        if !get(Functional::Radiant).is_finite() {
            let what = "the radiant total of the spectrum";
            return Err(ObserverError::OutOfRange { what, value: get(Functional::Radiant), allowed: "up to 1.8e308".into() });
        }
        let scaling = Scaling::new(options.scale, &get)?;
        let mut remarks: Vec<String> = scaling.remark.iter().cloned().collect();
        if get(Functional::PHOTOPIC) == 0.0 && functionals.weight(Functional::PHOTOPIC).is_some_and(|v| !no_common(density, v)) {
            remarks.push("a number that is 0 here although the spectrum reaches that far is below 1e-308".into());
        }
        let white = white(&options.white)?;
        let mut definitions = totals::definitions(density, &scaling, options)?;
        definitions.extend(colour_rows::definitions(white, &options.white));
        let spread = match &options.uncertainty {
            Some(uncertainty) => Some(functionals.spread(uncertainty)?),
            None => None,
        };
        if let Some(uncertainty) = &options.uncertainty {
            let together = if uncertainty.correlated { "fully correlated" } else { "uncorrelated" };
            remarks.push(format!("standard uncertainties come from those of the rows, taken as {together} between rows"));
        }
        remarks.extend(options.range_nm.and_then(|range| coverage::remark(range, &functionals)));
        let rows = definitions
            .into_iter()
            .map(|definition| {
                let value = finite((definition.compute)(&get));
                let standard_uncertainty = match (&spread, &value) {
                    (Some(spread), SheetValue::Number(_)) => {
                        propagation::standard_uncertainty(&functionals, &integrals, spread, &definition.compute)
                    }
                    _ => None,
                };
                SheetRow { value, standard_uncertainty, ..definition.row }
            })
            .collect();
        Ok(Self { scale: scaling.described(), rows, remarks })
    }

    /// The row of this id.
    pub fn row(&self, id: &str) -> Option<&SheetRow> {
        self.rows.iter().find(|row| row.id == id)
    }

    /// The number in the row of this id; `None` if there is no such row or its value is none.
    pub fn number(&self, id: &str) -> Option<f64> {
        match self.row(id)?.value {
            SheetValue::Number(value) => Some(value),
            _ => None,
        }
    }
}

/// Whether the spectrum has nothing where the function is not zero.
fn no_common(density: &Density, weight: &Factor) -> bool {
    density.support().intersection(&weight.support()).with_width().is_empty()
}

/// What cannot be held in an `f64` is said, not printed.
fn finite(value: SheetValue) -> SheetValue {
    match value {
        SheetValue::Number(number) if number.is_nan() => SheetValue::Undefined("not defined for this spectrum".into()),
        SheetValue::Number(number) if number.is_infinite() => SheetValue::Undefined("infinite, or larger than 1.8e308".into()),
        other => other,
    }
}

/// Chromaticity of the white of this name for the 1931 observer.
fn white(name: &str) -> Result<Chromaticity, ObserverError> {
    let density = library::density(name).map_err(|error| ObserverError::White(error.to_string()))?;
    let seen = Tristimulus::of(&density, &Matching::Cie1931.functions()).chromaticity();
    seen.ok_or_else(|| ObserverError::Zero { what: format!("the white `{name}`"), why: "it is not visible".into() })
}

/// Least luminous efficacy of radiation of a spectrum that is scaled to an illuminance without being asked, lm/W.
const LEAST_EFFICACY_LM_W: f64 = 1e-3;

/// What the density is multiplied by, and what its integrals then are.
#[derive(Debug, Clone)]
struct Scaling {
    scale: Scale,
    quantity: SpectralQuantity,
    remark: Option<String>,
}

impl Scaling {
    fn new(scale: Scale, get: &Integrals<'_>) -> Result<Self, ObserverError> {
        let visible = get(Functional::PHOTOPIC) > 0.0;
        let efficacy_lm_w = K_M_LM_W * (get(Functional::PHOTOPIC) / get(Functional::Radiant));
        let above = |what: &'static str, value: f64, unit: &str| {
            let good = value.is_finite() && value > 0.0;
            good.then_some(()).ok_or_else(|| ObserverError::OutOfRange { what, value, allowed: format!("above 0 {unit}") })
        };
        let mut remark = None;
        let (scale, quantity) = match scale {
            Scale::Absolute(quantity) => (scale, quantity),
            Scale::Relative if efficacy_lm_w >= LEAST_EFFICACY_LM_W => (Scale::Illuminance(1000.0), SpectralQuantity::Irradiance),
            Scale::Relative => {
                let efficacy = format!("the luminous efficacy is below {LEAST_EFFICACY_LM_W} lm/W");
                remark = Some(format!("{efficacy}, so the spectrum is scaled to 1 W/m² and not to 1000 lx"));
                (Scale::Irradiance(1.0), SpectralQuantity::Irradiance)
            }
            Scale::Illuminance(value) => {
                above("the illuminance", value, "lx")?;
                if !visible {
                    let why = "nothing of it is visible; give an irradiance instead";
                    return Err(ObserverError::Zero { what: "the illuminance of the spectrum".into(), why: why.into() });
                }
                (scale, SpectralQuantity::Irradiance)
            }
            Scale::Irradiance(value) => {
                above("the irradiance", value, "W/m²")?;
                (scale, SpectralQuantity::Irradiance)
            }
        };
        Ok(Self { scale, quantity, remark })
    }

    fn described(&self) -> String {
        match self.scale {
            Scale::Absolute(quantity) => format!("absolute: {}", quantity.spectral_words()),
            Scale::Illuminance(lx) => format!("relative, scaled to an illuminance of {lx} lx"),
            Scale::Irradiance(w_m2) => format!("relative, scaled to an irradiance of {w_m2} W/m²"),
            Scale::Relative => "relative".to_owned(),
        }
    }

    /// An integral of the density after scaling: `value` times the scale, the larger factors divided out first.
    fn apply(&self, value: f64, get: &Integrals<'_>) -> f64 {
        match self.scale {
            Scale::Absolute(_) | Scale::Relative => value,
            Scale::Illuminance(lx) => value / get(Functional::PHOTOPIC) * (lx / K_M_LM_W),
            Scale::Irradiance(w_m2) => value / get(Functional::Radiant) * w_m2,
        }
    }
}

#[cfg(test)]
mod tests;
