//! Cone fundamentals: how strongly radiation that arrives at the eye excites the L, M and S cones.
//!
//! ```text
//! L = ∫ X_e,λ l̄(λ) dλ,   M = ∫ X_e,λ m̄(λ) dλ,   S = ∫ X_e,λ s̄(λ) dλ          l̄, m̄, s̄: energy, 1 at the maximum
//! ```
//!
//! | variant | range | source |
//! |---|---|---|
//! | `StockmanSharpe2`, `StockmanSharpe10` | 390 nm to 830 nm, s̄ zero above 615 nm | Stockman and Sharpe 2000, CIE 170-1 |
//! | `Individual` | 390 nm to 780 nm | CIE 170-1, computed ([`super::individual`]) |

use super::{Individual, ObserverError, embedded};
use crate::spectrum::{Density, Factor};

/// A kind of cone.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Cone {
    /// Long wavelengths, maximum at about 565 nm.
    L,
    /// Medium wavelengths, maximum at about 540 nm.
    M,
    /// Short wavelengths, maximum at about 445 nm.
    S,
}

impl Cone {
    /// All three, in the order of the fundamentals.
    pub const ALL: [Self; 3] = [Self::L, Self::M, Self::S];

    /// "L", "M" or "S".
    pub fn name(self) -> &'static str {
        ["L", "M", "S"][self as usize]
    }
}

/// A set of cone fundamentals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Cones {
    /// Of the standard observer for 2°.
    StockmanSharpe2,
    /// Of the standard observer for 10°.
    StockmanSharpe10,
    /// Of an age and a field.
    Individual(Individual),
}

impl Cones {
    /// The fundamentals L, M, S: energy, 1 at the maximum (which may lie between the nodes), zero outside their tables. Errors if age
    /// or field are out of range.
    ///
    /// ```
    /// use etendue::observer::Cones;
    /// use etendue::spectrum::Density;
    ///
    /// // A sodium lamp excites L and M cones and leaves S cones alone.
    /// let sodium = Density::line(589.3, 1.0)?;
    /// let [l, m, s] = Cones::StockmanSharpe2.fundamentals()?.map(|cone| sodium.integral(&[&cone]));
    /// assert!(l > m && m > 0.4 && s < 1e-3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn fundamentals(self) -> Result<[Factor; 3], ObserverError> {
        let title = match self {
            Self::StockmanSharpe2 => "Stockman & Sharpe 2 Degree Cone Fundamentals",
            Self::StockmanSharpe10 => "Stockman & Sharpe 10 Degree Cone Fundamentals",
            Self::Individual(individual) => return individual.fundamentals(),
        };
        Ok(["l_bar", "m_bar", "s_bar"].map(|column| embedded(&format!("{title} {column}"))))
    }

    /// Excitations L, M, S of a density, in its unit times nm: W for W nm⁻¹. Errors if age or field are out of range.
    pub fn excitations(self, density: &Density) -> Result<[f64; 3], ObserverError> {
        Ok(self.fundamentals()?.map(|cone| density.integral(&[&cone])))
    }

    /// What it is, in words.
    pub fn title(self) -> String {
        match self {
            Self::StockmanSharpe2 => "Stockman & Sharpe 2°".to_owned(),
            Self::StockmanSharpe10 => "Stockman & Sharpe 10°".to_owned(),
            Self::Individual(Individual { age_yr, field_deg }) => format!("CIE 170-1, {age_yr} years, {field_deg}°"),
        }
    }
}
