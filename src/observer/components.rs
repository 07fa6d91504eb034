//! What stands between light and a cone signal: lens, macular pigment, photopigments. Tables, and the formula that joins them.
//!
//! ```text
//! q(λ)  = (1 − 10^(−D_pig A(λ))) · 10^(−D_mac(λ) − D_oc(λ))          corneal quantal sensitivity, not normalised
//! s̄(λ)  = λ q(λ) / max                                              cone fundamental, energy, unit peak
//! D_pig = 0.38 + 0.54 exp(−f/1.333) for L and M,  0.30 + 0.45 exp(−f/1.333) for S
//! D_mac = 0.485 exp(−f/6.132) · D_mac,rel(λ)
//! D_oc  = D_oc,1(λ) (1 + 0.02 (a − 32)) + D_oc,2(λ)                  20 ≤ a ≤ 60
//!         D_oc,1(λ) (1.56 + 0.0667 (a − 60)) + D_oc,2(λ)             60 < a ≤ 80
//! ```
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | A | low-density absorbance of a pigment, 1 at its maximum | 1 | table |
//! | D | (decadic) optical density | 1 | |
//! | f | angle that the field subtends, its diameter | ° | 1 to 10 |
//! | a | age | yr | 20 to 80 |
//!
//! Between the nodes of the tables (5 nm in the ones that come with the library) densities and logarithms of absorbances follow the cubic
//! through the four nearest nodes. Fundamentals are tabulated every 1 nm from it. Outside the tables: an error for a value, zero
//! for a fundamental, as in the published tables. Source: CIE 170-1:2006.

use std::sync::OnceLock;

use super::error::within;
use super::{Cone, Individual, ObserverError, embedded};
use crate::spectrum::{Factor, Outside, SpectrumError, Table};

/// Spectral tables of lens, macula and pigments on common wavelengths.
#[derive(Debug, Clone, PartialEq)]
pub struct Components {
    wavelengths_nm: Vec<f64>,
    /// Logarithms to base 10, −∞ where a pigment absorbs nothing; L, M, S.
    log_absorbance: [Vec<f64>; 3],
    macula: Vec<f64>,
    lens: [Vec<f64>; 2],
}

impl Components {
    /// Tables of one's own: low-density absorbances of the L, M and S pigment (1 at the maximum), macular density relative to its
    /// maximum, and the two densities of the lens, of which the first grows with age, for an age of 32.
    ///
    /// Errors if the wavelengths (nm) do not rise, a column has another length, or a value is negative or not finite.
    ///
    /// ```
    /// use etendue::observer::{Components, Cone, Individual};
    ///
    /// // An eye without lens and macular pigment.
    /// let nm = vec![400.0, 500.0, 600.0, 700.0];
    /// let none = vec![0.0; 4];
    /// let pigment = vec![0.2, 0.5, 1.0, 0.01];
    /// let bare = Components::new(nm, [pigment.clone(), pigment.clone(), pigment], none.clone(), [none.clone(), none])?;
    /// let seen = bare.quantal_sensitivity(Individual { age_yr: 30.0, field_deg: 2.0 }, Cone::L, 600.0)?;
    /// assert!((seen - (1.0 - 10f64.powf(-0.38 - 0.54 * (-2.0_f64 / 1.333).exp()))).abs() < 1e-15);
    /// # Ok::<(), etendue::observer::ObserverError>(())
    /// ```
    pub fn new(wavelengths_nm: Vec<f64>, absorbance: [Vec<f64>; 3], macula: Vec<f64>, lens: [Vec<f64>; 2]) -> Result<Self, ObserverError> {
        for column in absorbance.iter().chain([&macula]).chain(&lens) {
            let table = Table::new(wavelengths_nm.clone(), column.clone(), Outside::Zero)?;
            if let Some((index, (wavelength_nm, value))) = table.rows().enumerate().find(|(_, (_, value))| *value < 0.0) {
                return Err(SpectrumError::Negative { row: index + 1, wavelength_nm, value }.into());
            }
        }
        let log_absorbance = absorbance.map(|column| column.into_iter().map(f64::log10).collect());
        Ok(Self { wavelengths_nm, log_absorbance, macula, lens })
    }

    /// The tables of CIE 170-1, 390 nm to 780 nm, every 5 nm. Errors if the embedded tables could not be read, which the tests exclude.
    ///
    /// ```
    /// use etendue::observer::{Components, Cone};
    ///
    /// // What the pigments absorb at low density, without anything in front of them.
    /// let tables = Components::cie()?;
    /// assert_eq!(tables.range_nm(), (390.0, 780.0));
    /// assert!(tables.absorbance(Cone::M, 530.0)? > 0.99);
    /// # Ok::<(), etendue::observer::ObserverError>(())
    /// ```
    pub fn cie() -> Result<&'static Self, ObserverError> {
        static CIE: OnceLock<Result<Components, ObserverError>> = OnceLock::new();
        CIE.get_or_init(read_cie).as_ref().map_err(Clone::clone)
    }

    /// First and last wavelength, nm.
    pub fn range_nm(&self) -> (f64, f64) {
        (self.wavelengths_nm[0], self.wavelengths_nm[self.wavelengths_nm.len() - 1])
    }

    /// Low-density absorbance A of the pigment of a cone at `nm`, 1 at its maximum. Errors outside the tables.
    pub fn absorbance(&self, cone: Cone, nm: f64) -> Result<f64, ObserverError> {
        Ok(10f64.powf(self.interpolated(&self.log_absorbance[cone as usize], nm)?))
    }

    /// Density of lens and other ocular media for an age, at `nm`. Errors outside the tables and ranges.
    pub fn lens_density(&self, individual: Individual, nm: f64) -> Result<f64, ObserverError> {
        let age_yr = individual.checked()?.age_yr;
        let growth = if age_yr <= 60.0 { 1.0 + 0.02 * (age_yr - 32.0) } else { 1.56 + 0.0667 * (age_yr - 60.0) };
        Ok(growth * self.density(&self.lens[0], nm)? + self.density(&self.lens[1], nm)?)
    }

    /// Density of the macular pigment for a field, at `nm`. Errors outside the tables and ranges.
    pub fn macular_density(&self, individual: Individual, nm: f64) -> Result<f64, ObserverError> {
        let peak = individual.checked()?.peak_macular_density();
        Ok(peak * self.density(&self.macula, nm)?)
    }

    /// Share of the photons arriving at a cone that its pigment absorbs, `1 − 10^(−D A)`, at `nm`. Errors outside the tables and ranges.
    pub fn absorptance(&self, individual: Individual, cone: Cone, nm: f64) -> Result<f64, ObserverError> {
        let density = individual.checked()?.peak_optical_density(cone) * self.absorbance(cone, nm)?;
        Ok(-(-density * std::f64::consts::LN_10).exp_m1())
    }

    /// Share of the photons arriving at the eye that are absorbed by the pigment of a cone, at `nm`: corneal quantal sensitivity, not
    /// normalised. Errors outside the tables and ranges.
    pub fn quantal_sensitivity(&self, individual: Individual, cone: Cone, nm: f64) -> Result<f64, ObserverError> {
        let filters = self.macular_density(individual, nm)? + self.lens_density(individual, nm)?;
        Ok(self.absorptance(individual, cone, nm)? * 10f64.powf(-filters))
    }

    /// Cone fundamentals L, M, S: corneal sensitivity to energy, 1 at the maximum, every 1 nm, zero outside the tables. Errors outside the
    /// ranges of age and field, and if a cone is sensitive nowhere.
    pub fn fundamentals(&self, individual: Individual) -> Result<[Factor; 3], ObserverError> {
        let (from_nm, to_nm) = self.range_nm();
        let mut wavelengths_nm = self.wavelengths_nm.clone();
        // As many as the range is long; a table from 1 nm to 1e300 nm keeps to its nodes.
        if to_nm - from_nm <= 10_000.0 {
            let whole = (from_nm.ceil() as u32..=to_nm.floor() as u32).map(f64::from);
            wavelengths_nm.extend(whole);
            wavelengths_nm.sort_by(f64::total_cmp);
            wavelengths_nm.dedup();
        }
        let of = |cone: Cone| -> Result<Factor, ObserverError> {
            let energy = wavelengths_nm.iter().map(|&nm| self.quantal_sensitivity(individual, cone, nm).map(|quantal| nm * quantal));
            let energy = energy.collect::<Result<Vec<f64>, ObserverError>>()?;
            let peak = energy.iter().copied().fold(0.0, f64::max);
            let unit_peak = energy.iter().map(|value| value / peak).collect();
            Ok(Factor::Table(Table::new(wavelengths_nm.clone(), unit_peak, Outside::Zero)?))
        };
        Ok([of(Cone::L)?, of(Cone::M)?, of(Cone::S)?])
    }

    /// A density between the nodes; a cubic may fall below zero beside a kink.
    fn density(&self, column: &[f64], nm: f64) -> Result<f64, ObserverError> {
        Ok(self.interpolated(column, nm)?.max(0.0))
    }

    /// The cubic through the four nearest nodes, or the straight line where one of them is −∞; −∞ beside a node that is.
    fn interpolated(&self, column: &[f64], nm: f64) -> Result<f64, ObserverError> {
        let (from_nm, to_nm) = self.range_nm();
        let nm = within("the wavelength", nm, from_nm, to_nm, "nm")?;
        let nodes = &self.wavelengths_nm;
        let last = nodes.len() - 1;
        let upper = nodes.partition_point(|&node| node <= nm).clamp(1, last);
        if nm == nodes[upper - 1] || nm == nodes[upper] {
            return Ok(column[if nm == nodes[upper] { upper } else { upper - 1 }]);
        }
        let four = upper.saturating_sub(2).min(last.saturating_sub(3))..(upper + 2).max(4).min(last + 1);
        let finite = column[four.clone()].iter().all(|value| value.is_finite());
        let range = if finite { four } else { upper - 1..upper + 1 };
        if range.clone().any(|i| !column[i].is_finite()) {
            return Ok(f64::NEG_INFINITY);
        }
        let weight = |i: usize| -> f64 { range.clone().filter(|&j| j != i).map(|j| (nm - nodes[j]) / (nodes[i] - nodes[j])).product() };
        Ok(range.clone().map(|i| weight(i) * column[i]).sum())
    }
}

fn read_cie() -> Result<Components, ObserverError> {
    let column = |name: &str| match embedded(&format!("CIE 170-1 components {name}")) {
        Factor::Table(table) => (table.wavelengths_nm().to_vec(), table.values().to_vec()),
        _ => (Vec::new(), Vec::new()),
    };
    let of = |name: &str| column(name).1;
    let absorbance = [of("absorbance_l"), of("absorbance_m"), of("absorbance_s")];
    Components::new(column("macula").0, absorbance, of("macula"), [of("lens_1"), of("lens_2")])
}
