//! Quality indices of instruments, from their curves.
//!
//! | file | index | of |
//! |---|---|---|
//! | `spectral_mismatch` | f1′, spectral mismatch correction factor F | a spectral responsivity |
//! | `campaign` | readings of a calibration bench, simulated | |
//! | `readings_table` | readings of a laboratory, read | |
//! | `directional_mismatch` | f2 | a directional response |
//!
//! Pure functions on curves. What could not be checked against the text of the defining standards (ISO/CIE 19476, CIE S 023, DIN 5032-7)
//! is an input here, and each file says so.

pub mod campaign;
pub mod directional_mismatch;
pub mod readings_table;
pub mod spectral_mismatch;
