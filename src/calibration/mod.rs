//! Calibration: a responsivity curve from readings, with its uncertainty, and what the readings do not determine.
//!
//! ```text
//! yᵢ = Σₖ Aᵢₖ s(λₖ) + noise      Aᵢₖ = ∫ Sᵢ(λ) hatₖ(λ) dλ      s ≥ 0, s smooth
//! ```
//!
//! `Sᵢ` is the spectrum of exposure i, `hatₖ` the function that is 1 at node k and falls linearly to 0 at its neighbours: the curve is linear
//! between its nodes, and the integrals are exact. Few readings, broad spectra and noise leave infinitely many curves that fit; the prior
//! says which are plausible, and the posterior how far apart those are.
//!
//! | file | what |
//! |---|---|
//! | [`exposures`] | spectra on the nodes of the curve, readings with their uncertainties |
//! | [`prior`] | what is plausible before any reading: smooth curves of unknown scale, cameras |
//! | [`evidence`] | which smoothness and which scale the readings speak for, and the classic rules beside |
//! | [`posterior`] | curve, covariance, averaging kernels |
//! | [`non_negative`] | the most plausible curve that is nowhere negative |
//! | [`propagation`] | what a curve is used for, with its uncertainty |
//! | [`refit`] | the same fit of other readings, fast: for Monte Carlo |
//! | [`simultaneous`] | the band that holds the whole curve at once |
//! | [`suggestion`] | what a further reading would take from the covariance |
//! | [`parametric`] | curves of few parameters: sums of Gaussians, a filter before a detector, a visual pigment |
//! | [`least_squares`] | Levenberg and Marquardt |
//! | [`parametric_fit`] | the parameters from readings, and the curve with its covariance |
//! | [`consistency`] | which readings contradict the rest, and what becomes of them |
//! | [`whitening`] | readings in units of their uncertainties, after checks |
//! | [`error`] | why readings cannot be fitted |
//! | [`mod@fit`] | all of it, from exposures and readings to a fitted curve |
//!
//! Works on real and on simulated readings alike; knows no scenes and no rays.

pub mod consistency;
pub mod error;
pub mod evidence;
pub mod exposures;
pub mod fit;
pub mod least_squares;
mod low_rank;
pub mod non_negative;
pub mod parametric;
pub mod parametric_fit;
mod passes;
pub mod posterior;
pub mod prior;
pub mod propagation;
pub mod refit;
mod remarks;
pub mod simultaneous;
pub mod suggestion;
pub mod whitening;

pub use consistency::Outliers;
pub use error::CalibrationError;
pub use exposures::{Exposures, Readings};
pub use fit::{Chooser, FitOptions, Fitted, FittedCurve, fit, warm};
pub use parametric::{Model, OpticalDensity};
pub use prior::PriorKind;
