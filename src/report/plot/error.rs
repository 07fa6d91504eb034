//! Why a picture cannot be drawn.

use crate::observer::ObserverError;
use crate::spectrum::SpectrumError;
use crate::spectrum::library::LookupError;

/// A chart that is not one, or a drawing that failed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PlotError {
    /// The ends of an axis are no range: not finite, not rising, or not positive on a logarithmic axis.
    #[error("the axis `{axis}` from {from} to {to} is no range: finite, rising, and positive if logarithmic")]
    Range {
        /// Name of the axis.
        axis: String,
        /// Lower end.
        from: f64,
        /// Upper end.
        to: f64,
    },
    /// What has to be written takes more room than there is.
    #[error(
        "{width_px:.0} px × {height_px:.0} px is too small for what has to be written beside the curves; take a larger size or fewer items"
    )]
    TooSmall {
        /// Width of the picture, px.
        width_px: f64,
        /// Height of the picture, px.
        height_px: f64,
    },
    /// Nothing to draw.
    #[error("nothing to draw: {what}")]
    Nothing {
        /// What is missing.
        what: String,
    },
    /// Something that was asked for is outside what can be plotted.
    #[error("{what}")]
    Request {
        /// What was found and what is allowed.
        what: String,
    },
    /// A value that an observer does not have.
    #[error(transparent)]
    Observer(#[from] ObserverError),
    /// A curve that is none.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
    /// A name that the library does not have.
    #[error(transparent)]
    Lookup(#[from] LookupError),
    /// The drawing library failed.
    #[error("the drawing failed: {0}")]
    Drawing(String),
}
