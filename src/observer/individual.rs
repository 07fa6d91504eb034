//! The cones of an eye of a certain age, looking at a field of a certain size.
//!
//! Formula, symbols and tables are those of [`super::components`], with the tables of CIE 170-1.
//!
//! | parameter | meaning | unit | range |
//! |---|---|---|---|
//! | `age_yr` | age of the average observer | yr | 20 to 80 |
//! | `field_deg` | diameter of the field in view | ° | 1 to 10 |

use super::error::within;
use super::{Components, Cone, ObserverError};
use crate::spectrum::Factor;

/// An average observer of an age, for a field. Values outside the ranges are errors wherever they are used.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Individual {
    /// Age, yr, 20 to 80.
    pub age_yr: f64,
    /// Diameter of the field in view, °, 1 to 10.
    pub field_deg: f64,
}

impl Individual {
    /// Range of ages, yr.
    pub const AGES_YR: (f64, f64) = (20.0, 80.0);
    /// Range of fields, °.
    pub const FIELDS_DEG: (f64, f64) = (1.0, 10.0);

    /// The observer if its age and field are in range. Errors with the range otherwise.
    pub fn checked(self) -> Result<Self, ObserverError> {
        within("the age", self.age_yr, Self::AGES_YR.0, Self::AGES_YR.1, "yr")?;
        within("the field", self.field_deg, Self::FIELDS_DEG.0, Self::FIELDS_DEG.1, "°")?;
        Ok(self)
    }

    /// Peak optical density D_pig of the pigment of a cone.
    ///
    /// ```
    /// use etendue::observer::{Cone, Individual};
    ///
    /// let eye = Individual { age_yr: 32.0, field_deg: 2.0 };
    /// assert!((eye.peak_optical_density(Cone::L) - 0.50).abs() < 0.01);
    /// assert!((eye.peak_macular_density() - 0.35).abs() < 0.01);
    /// ```
    pub fn peak_optical_density(self, cone: Cone) -> f64 {
        let (least, range) = if cone == Cone::S { (0.30, 0.45) } else { (0.38, 0.54) };
        least + range * (-self.field_deg / 1.333).exp()
    }

    /// Density of the macular pigment at its maximum.
    pub fn peak_macular_density(self) -> f64 {
        0.485 * (-self.field_deg / 6.132).exp()
    }

    /// Density of lens and other ocular media at `nm`. Errors outside the tables and ranges.
    ///
    /// ```
    /// use etendue::observer::Individual;
    ///
    /// let at = |age_yr| Individual { age_yr, field_deg: 2.0 }.lens_density(400.0);
    /// assert!(at(20.0)? < at(60.0)? && at(60.0)? < at(80.0)?);
    /// assert!(at(90.0).is_err());
    /// # Ok::<(), etendue::observer::ObserverError>(())
    /// ```
    pub fn lens_density(self, nm: f64) -> Result<f64, ObserverError> {
        Components::cie()?.lens_density(self, nm)
    }

    /// Density of the macular pigment at `nm`. Errors outside the tables and ranges.
    ///
    /// ```
    /// use etendue::observer::Individual;
    ///
    /// let eye = Individual { age_yr: 32.0, field_deg: 2.0 };
    /// assert_eq!(eye.macular_density(460.0)?, eye.peak_macular_density());
    /// # Ok::<(), etendue::observer::ObserverError>(())
    /// ```
    pub fn macular_density(self, nm: f64) -> Result<f64, ObserverError> {
        Components::cie()?.macular_density(self, nm)
    }

    /// Share of the photons arriving at a cone that its pigment absorbs, at `nm`. Errors outside the tables and ranges.
    ///
    /// ```
    /// use etendue::observer::{Cone, Individual};
    ///
    /// // Two thirds at the maximum, for D = 0.5.
    /// let share = Individual { age_yr: 32.0, field_deg: 2.0 }.absorptance(Cone::L, 560.0)?;
    /// assert!((share - 0.68).abs() < 0.01);
    /// # Ok::<(), etendue::observer::ObserverError>(())
    /// ```
    pub fn absorptance(self, cone: Cone, nm: f64) -> Result<f64, ObserverError> {
        Components::cie()?.absorptance(self, cone, nm)
    }

    /// Share of the photons arriving at the eye that the pigment of a cone absorbs, at `nm`: corneal quantal sensitivity, not
    /// normalised. Errors outside the tables and ranges.
    ///
    /// ```
    /// use etendue::observer::{Cone, Individual};
    ///
    /// // An old lens takes most of the blue.
    /// let at = |age_yr| Individual { age_yr, field_deg: 2.0 }.quantal_sensitivity(Cone::S, 420.0);
    /// assert!(at(70.0)? < 0.5 * at(25.0)?);
    /// # Ok::<(), etendue::observer::ObserverError>(())
    /// ```
    pub fn quantal_sensitivity(self, cone: Cone, nm: f64) -> Result<f64, ObserverError> {
        Components::cie()?.quantal_sensitivity(self, cone, nm)
    }

    /// Cone fundamentals L, M, S: corneal sensitivity to energy, 1 at the maximum, every 1 nm from 390 nm to 780 nm, zero outside. Errors
    /// outside the ranges.
    ///
    /// ```
    /// use etendue::observer::Individual;
    ///
    /// let [l, m, s] = Individual { age_yr: 60.0, field_deg: 4.0 }.fundamentals()?;
    /// assert!(l.at(570.0) > 0.99 && m.at(545.0) > 0.99 && s.at(450.0) > 0.95);
    /// # Ok::<(), etendue::observer::ObserverError>(())
    /// ```
    pub fn fundamentals(self) -> Result<[Factor; 3], ObserverError> {
        Components::cie()?.fundamentals(self)
    }
}
