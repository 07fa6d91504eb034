//! Quality indices of instruments, from their curves.
//!
//! | file | index | of |
//! |---|---|---|
//! | `spectral_mismatch` | f1′, spectral mismatch correction factor F | a spectral responsivity |
//! | `directional_mismatch` | f2 | a directional response |
//! | `emva/` | the figures of EMVA 1288 | frames of a camera |
//!
//! Pure functions on curves and frames. What could not be checked against the text of the defining standards (ISO/CIE 19476, CIE S 023, DIN 5032-7)
//! is an input here, and each file says so.

pub mod directional_mismatch;
pub mod emva;
pub mod spectral_mismatch;
