//! The integrals `I_k = ∫ φ s_k dλ` that the rows of a sheet are made of, and their weights on the rows of a table.
//!
//! For a table that is linear between its rows, φ = Σ φ_j h_j with hat functions h_j, so
//!
//! ```text
//! I_k = Σ_j w_kj φ_j,    w_kj = ∫ h_j s_k dλ
//! cov(I_k, I_l) = Σ_j w_kj w_lj u_j²                     rows that err each on its own
//!               = (Σ_j w_kj u_j)(Σ_j w_lj u_j)           rows that err together
//! ```
//!
//! All s_k are linear between their breakpoints, so that two Gauss–Legendre nodes a piece are exact.

use super::RowUncertainty;
use crate::observer::{AlphaOpic, Cone, Cones, Efficiency, Matching, ObserverError};
use crate::quantity::constants::AVOGADRO_PER_MOL;
use crate::spectrum::{Density, Factor, photometry};

/// Edges of the visible range, nm (CIE S 017, 17-21-003: 360 to 400 and 760 to 830; the sheet states which).
pub(super) const VISIBLE_NM: (f64, f64) = (380.0, 780.0);
/// Photosynthetically active radiation, nm.
pub(super) const PHOTOSYNTHETIC_NM: (f64, f64) = (400.0, 700.0);

/// What the density is integrated against.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Functional {
    Radiant,
    Ultraviolet,
    Visible,
    Infrared,
    /// λ, nm.
    FirstMoment,
    /// Photons, mol.
    Photon,
    /// Photons from 400 nm to 700 nm, mol.
    Photosynthetic,
    Luminous(Efficiency),
    AlphaOpic(AlphaOpic),
    Cone(Field, Cone),
    Matching(Matching, usize),
}

/// Size of the field that cones are seen with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Field {
    TwoDegrees,
    TenDegrees,
}

/// Luminous efficiencies of the sheet.
const EFFICIENCIES: [Efficiency; 4] =
    [Efficiency::Photopic1924, Efficiency::Scotopic1951, Efficiency::Physiological2, Efficiency::Physiological10];
/// Observers of the sheet.
pub(super) const OBSERVERS: [Matching; 4] = [Matching::Cie1931, Matching::Cie1964, Matching::Cie2015TwoDegree, Matching::Cie2015TenDegree];

impl Functional {
    pub(super) const PHOTOPIC: Self = Self::Luminous(Efficiency::Photopic1924);
    pub(super) const SCOTOPIC: Self = Self::Luminous(Efficiency::Scotopic1951);
}

/// Every functional with its weighting function.
pub(super) struct Functionals {
    list: Vec<(Functional, Factor)>,
}

/// Standard uncertainties of the integrals.
pub(super) enum Spread {
    /// Covariance matrix.
    Each(Vec<Vec<f64>>),
    /// All move together: how far each.
    Together(Vec<f64>),
}

impl Functionals {
    pub(super) fn new() -> Result<Self, ObserverError> {
        let band = |from_nm: f64, to_nm: f64| Factor::Band { from_nm, to_nm, value: 1.0 };
        let mol = photometry::photons_per_joule(photometry::WavelengthsIn::StandardAir).scaled(1.0 / AVOGADRO_PER_MOL);
        let (low_nm, high_nm) = VISIBLE_NM;
        // A line exactly on an edge counts once, as visible.
        let mut list = vec![
            (Functional::Radiant, Factor::ONE),
            (Functional::Ultraviolet, band(0.0, low_nm.next_down())),
            (Functional::Visible, band(low_nm, high_nm)),
            (Functional::Infrared, band(high_nm.next_up(), f64::INFINITY)),
            (Functional::FirstMoment, Factor::Proportional(1.0)),
            (Functional::Photon, mol.clone()),
            (Functional::Photosynthetic, Factor::Product(vec![mol, band(PHOTOSYNTHETIC_NM.0, PHOTOSYNTHETIC_NM.1)])),
        ];
        list.extend(EFFICIENCIES.map(|efficiency| (Functional::Luminous(efficiency), efficiency.curve())));
        list.extend(AlphaOpic::ALL.map(|receptor| (Functional::AlphaOpic(receptor), receptor.curve())));
        for (field, cones) in [(Field::TwoDegrees, Cones::StockmanSharpe2), (Field::TenDegrees, Cones::StockmanSharpe10)] {
            let fundamentals = cones.fundamentals()?;
            list.extend(Cone::ALL.into_iter().zip(fundamentals).map(|(cone, curve)| (Functional::Cone(field, cone), curve)));
        }
        for observer in OBSERVERS {
            let functions = observer.functions().into_iter().enumerate();
            list.extend(functions.map(|(i, function)| (Functional::Matching(observer, i), function)));
        }
        Ok(Self { list })
    }

    /// All integrals, exact.
    pub(super) fn integrals(&self, density: &Density) -> Vec<f64> {
        density.integrals(&self.list.iter().map(|(_, weight)| weight).collect::<Vec<_>>())
    }

    /// The place of a functional in the lists; beyond them for one that there is not, which every use would show at once.
    pub(super) fn place(&self, wanted: Functional) -> usize {
        self.list.iter().position(|(functional, _)| *functional == wanted).unwrap_or(usize::MAX)
    }

    /// The integral of a functional.
    pub(super) fn pick(&self, integrals: &[f64], wanted: Functional) -> f64 {
        integrals.get(self.place(wanted)).copied().unwrap_or(f64::NAN)
    }

    /// Weighting function of a functional.
    pub(super) fn weight(&self, wanted: Functional) -> Option<&Factor> {
        self.list.get(self.place(wanted)).map(|(_, weight)| weight)
    }

    /// How uncertain the integrals are.
    pub(super) fn spread(&self, rows: &RowUncertainty) -> Result<Spread, ObserverError> {
        let u = &rows.standard_uncertainty;
        if u.len() != rows.wavelengths_nm.len() {
            let (value, what) = (u.len() as f64, "the number of standard uncertainties");
            return Err(ObserverError::OutOfRange { what, value, allowed: format!("{}, one a row", rows.wavelengths_nm.len()) });
        }
        if let Some(&value) = u.iter().find(|value| !(value.is_finite() && **value >= 0.0)) {
            return Err(ObserverError::OutOfRange { what: "a standard uncertainty", value, allowed: "0 and above".into() });
        }
        let moved: Vec<Vec<f64>> = self
            .list
            .iter()
            .map(|(_, weight)| hat_weights(&rows.wavelengths_nm, weight).iter().zip(u).map(|(w, u)| w * u).collect())
            .collect();
        if rows.correlated {
            return Ok(Spread::Together(moved.iter().map(|row| row.iter().sum()).collect()));
        }
        let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum();
        Ok(Spread::Each(moved.iter().map(|a| moved.iter().map(|b| product(a, b)).collect()).collect()))
    }
}

/// `∫ h_j s dλ` for the hat functions of the rows; exact for an s that is linear between its breakpoints.
pub(super) fn hat_weights(wavelengths_nm: &[f64], s: &Factor) -> Vec<f64> {
    let mut weights = vec![0.0; wavelengths_nm.len()];
    let breakpoints = s.breakpoints();
    for (j, pair) in wavelengths_nm.windows(2).enumerate() {
        let (low, high) = (pair[0], pair[1]);
        let first = breakpoints.partition_point(|nm| *nm <= low);
        let inside = breakpoints[first..].iter().copied().take_while(|nm| *nm < high);
        let mut from = low;
        for to in inside.chain([high]) {
            let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
            for sign in [-1.0, 1.0] {
                let nm = middle + sign * half / 3f64.sqrt();
                let value = half * s.at(nm);
                let share = (nm - low) / (high - low);
                weights[j] += value * (1.0 - share);
                weights[j + 1] += value * share;
            }
            from = to;
        }
    }
    weights
}
