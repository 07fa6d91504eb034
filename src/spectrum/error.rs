//! What can be wrong with a function of wavelength.

/// A table, a line or a parameter that is not a function of wavelength.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SpectrumError {
    /// The two columns of a table have different lengths.
    #[error("the table has {wavelengths} wavelengths but {values} values; each row needs one of both")]
    LengthsDiffer {
        /// Number of wavelengths.
        wavelengths: usize,
        /// Number of values.
        values: usize,
    },
    /// A table needs two rows to have a segment between them.
    #[error("the table has {rows} row(s); at least 2 are needed")]
    TooFewRows {
        /// Number of rows found.
        rows: usize,
    },
    /// A wavelength that is not a finite number above zero. Rows are counted from 1.
    #[error("row {row}: the wavelength is {wavelength_nm} nm; it must be finite and above 0")]
    Wavelength {
        /// Row, counted from 1.
        row: usize,
        /// What was found, nm.
        wavelength_nm: f64,
    },
    /// Wavelengths that do not strictly increase. Rows are counted from 1.
    #[error("row {row}: {wavelength_nm} nm follows {previous_nm} nm; wavelengths must increase from row to row")]
    NotIncreasing {
        /// Row of the second of the two, counted from 1.
        row: usize,
        /// The wavelength before, nm.
        previous_nm: f64,
        /// The wavelength found, nm.
        wavelength_nm: f64,
    },
    /// A value that is NaN or infinite. Rows are counted from 1.
    #[error("row {row} ({wavelength_nm} nm): the value is {value}; it must be finite")]
    NotFinite {
        /// Row, counted from 1.
        row: usize,
        /// Wavelength of the row, nm.
        wavelength_nm: f64,
        /// What was found.
        value: f64,
    },
    /// A negative value where only zero and above has a meaning. Rows are counted from 1.
    #[error("row {row} ({wavelength_nm} nm): the value is {value}; a density cannot be negative")]
    Negative {
        /// Row, counted from 1.
        row: usize,
        /// Wavelength of the row, nm.
        wavelength_nm: f64,
        /// What was found.
        value: f64,
    },
    /// A parameter outside its range.
    #[error("{name} is {value}; it must be {allowed}")]
    Parameter {
        /// The parameter, with its unit.
        name: &'static str,
        /// What was found.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// A table of the library that is needed is not there.
    #[error("the library has no table `{name}`")]
    NoTable {
        /// Its name.
        name: &'static str,
    },
    /// A band that ends before it begins.
    #[error("the band runs from {from_nm} nm to {to_nm} nm; its end must lie above its beginning")]
    Band {
        /// Lower edge, nm.
        from_nm: f64,
        /// Upper edge, nm.
        to_nm: f64,
    },
}

/// `value` if it is finite and above zero.
pub(super) fn positive(name: &'static str, value: f64) -> Result<f64, SpectrumError> {
    if value.is_finite() && value > 0.0 {
        return Ok(value);
    }
    Err(SpectrumError::Parameter { name, value, allowed: "finite and above 0" })
}

/// `value` if it is finite and not below zero.
pub(super) fn not_negative(name: &'static str, value: f64) -> Result<f64, SpectrumError> {
    if value.is_finite() && value >= 0.0 {
        return Ok(value);
    }
    Err(SpectrumError::Parameter { name, value, allowed: "finite and not below 0" })
}

/// `value` if it is finite.
pub(super) fn finite(name: &'static str, value: f64) -> Result<f64, SpectrumError> {
    if value.is_finite() {
        return Ok(value);
    }
    Err(SpectrumError::Parameter { name, value, allowed: "finite" })
}

/// The two edges of a band if they are positive, finite and in order.
pub(super) fn band(from_nm: f64, to_nm: f64) -> Result<(f64, f64), SpectrumError> {
    let from = not_negative("the lower edge of the band in nm", from_nm)?;
    let to = positive("the upper edge of the band in nm", to_nm)?;
    if from < to { Ok((from, to)) } else { Err(SpectrumError::Band { from_nm, to_nm }) }
}
