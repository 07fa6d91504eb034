//! What can be wrong with a question to an observer.

use crate::spectrum::SpectrumError;

/// A name, an age, a field, a luminance that no observer answers to.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ObserverError {
    /// No observer of this kind has this name.
    #[error("there is no {what} called `{name}`; allowed: {}", allowed.join(", "))]
    Unknown {
        /// The kind that was asked for, such as "luminous efficiency function".
        what: &'static str,
        /// What was asked for.
        name: String,
        /// All names of the kind.
        allowed: Vec<&'static str>,
    },
    /// A number outside the range over which the observer is defined.
    #[error("{what} is {value}; allowed: {allowed}")]
    OutOfRange {
        /// The number, with its unit.
        what: &'static str,
        /// What was found.
        value: f64,
        /// What is allowed, with its unit.
        allowed: String,
    },
    /// What is asked for would be divided by something that is zero.
    #[error("{what} is zero: {why}")]
    Zero {
        /// What is zero.
        what: String,
        /// Why that matters, or what to do.
        why: String,
    },
    /// The name of a white that is none.
    #[error("the white: {0}")]
    White(String),
    /// Columns that are not functions of wavelength.
    #[error(transparent)]
    Table(#[from] SpectrumError),
}

/// `value` if it lies from `least` to `most`.
pub(super) fn within(what: &'static str, value: f64, least: f64, most: f64, unit: &str) -> Result<f64, ObserverError> {
    if (least..=most).contains(&value) {
        return Ok(value);
    }
    let space = if matches!(unit, "" | "°") { "" } else { " " };
    let most = if most < 1e6 { format!("{most}") } else { format!("{most:e}") };
    Err(ObserverError::OutOfRange { what, value, allowed: format!("{least}{space}{unit} to {most}{space}{unit}") })
}
