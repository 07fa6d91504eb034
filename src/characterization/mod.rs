//! Quality indices of instruments: from their curves, and measured on a virtual bench.
//!
//! | file | index | of |
//! |---|---|---|
//! | `spectral_mismatch` | f1′, spectral mismatch correction factor F | a spectral responsivity |
//! | `out_of_band` | u, r | the same |
//! | `directional_mismatch` | f2 of a planar head | a directional response |
//! | `head_mismatch` | f2 of heads over the full sphere | the same |
//! | `linearity` | f3, f11 | a readout |
//! | `class_limits` | classes L, A, B, C and how sure they are | indices |
//! | `bench/` | readings of a sensor on a goniometer, a monochromator, an attenuator | a sensor |
//! | `emva/` | the figures of EMVA 1288 | frames of a camera |
//! | `traced_field` | photons and electrons of the pixels in a flat field | a camera in a scene |
//! | `sheet/` | all of them for one sensor, each by both routes | a sensor |
//! | `substitution` | the light of a calibration bench, measured by a reference detector | a detector in A/W |
//! | `campaign` | readings of a calibration bench, simulated | a sensor |
//! | `readings_table`, `readings_text` | readings of a laboratory, read | a table |
//!
//! Indices are pure functions on curves and frames. What could not be checked against the text of the defining standards (ISO/CIE 19476, CIE S 023,
//! DIN 5032-7) is an input there, and each file says so.

pub mod bench;
pub mod campaign;
pub mod class_limits;
pub mod directional_mismatch;
pub mod emva;
mod figure;
pub mod head_mismatch;
pub mod linearity;
pub mod out_of_band;
pub mod readings_table;
mod readings_text;
pub mod sheet;
pub mod spectral_mismatch;
pub mod substitution;
pub mod traced_field;

pub use figure::Figure;
