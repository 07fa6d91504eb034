//! Measurements and studies as text, JSON and CSV; plots.
//!
//! | file | what |
//! |---|---|
//! | `text.rs` | a table for a person |
//! | `json.rs` | everything, for programs; numbers keep all their digits |
//! | `csv.rs` | a row a reading, for spreadsheets |
//! | `calibration/` | fitted curves: a page, JSON, CSV with covariance, a sensor file |
//! | `convergence/` | error against run time, in the same three forms; reads references |
//! | `lecture/` | equations of the lecture and the table of quantities, as text and JSON |
//! | `spectrum/` | the quantities of one spectrum, in the same three forms |
//! | `verify/` | what became of reference cases, as text, JSON, CSV and a page of HTML |
//! | `stability/` | sweeps of numerical stability |
//! | `plot/` | plots in SVG and PNG (feature `plot`) |

pub mod calibration;
pub mod convergence;
pub mod csv;
pub mod json;
pub mod lecture;
#[cfg(feature = "plot")]
pub mod plot;
pub mod spectrum;
pub mod stability;
pub mod text;
pub mod verify;
