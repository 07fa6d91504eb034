//! Measurements and studies as text, JSON and CSV; plots.
//!
//! | file | what |
//! |---|---|
//! | `text.rs` | a table for a person |
//! | `ideal.rs` | what ideal instruments would indicate, a part of that table |
//! | `json.rs` | everything, for programs; numbers keep all their digits |
//! | `csv.rs` | a row a reading, for spreadsheets |
//! | `calibration/` | fitted curves: a page, JSON, CSV with covariance, a sensor file |
//! | `convergence/` | error against run time, in the same three forms; reads references |
//! | `coverage/` | how often intervals cover the truth, in the same three forms and Markdown |
//! | `datasheet/` | data sheets of sensors, as text, JSON and charts |
//! | `lecture/` | equations of the lecture and the table of quantities, as text and JSON |
//! | `spectrum/` | the quantities of one spectrum, in the same three forms |
//! | `verify/` | what became of reference cases, as text, JSON, CSV and a page of HTML |
//! | `savings/` | what each rule of the plan saves, in the same three forms and as Markdown |
//! | `stability/` | sweeps of numerical stability |
//! | `emva/` | figures of EMVA 1288 as text and JSON, descriptors of frames |
//! | `image/` | frames as PNG, TIFF, NPY and EXR (feature `image`) |
//! | `picture/` | frames for the eye: a preview, luminance in false colours |
//! | `plot/` | plots in SVG and PNG (feature `plot`) |

pub mod calibration;
pub mod convergence;
pub mod coverage;
pub mod csv;
pub mod datasheet;
pub mod emva;
mod ideal;
#[cfg(feature = "image")]
pub mod image;
pub mod json;
pub mod lecture;
pub mod picture;
#[cfg(feature = "plot")]
pub mod plot;
pub mod savings;
pub mod spectrum;
pub mod stability;
pub mod text;
pub mod verify;
