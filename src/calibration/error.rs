//! Why readings cannot be fitted.

/// Why there is no fit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CalibrationError {
    /// Readings that cannot be used: which, and why.
    Readings(String),
    /// No exposure shines where the curve is sought.
    NothingSeen,
    /// A parametric model that these readings cannot be fitted with.
    Model(String),
    /// The numbers leave their range, or the solver finds nothing.
    Numbers(String),
}

impl std::fmt::Display for CalibrationError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Readings(what) | Self::Model(what) => f.write_str(what),
            Self::NothingSeen => f.write_str("no exposure has light where the curve is sought; give spectra that overlap its wavelengths"),
            Self::Numbers(what) => write!(f, "the fit fails: {what}"),
        }
    }
}

impl std::error::Error for CalibrationError {}
