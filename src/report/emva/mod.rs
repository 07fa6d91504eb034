//! The figures of EMVA 1288 as text and JSON, and the description of a set of frames for other programs.
//!
//! | file | what |
//! |---|---|
//! | `text.rs` | a table for a person |
//! | `sheet.rs` | the data sheet of a camera on a page of 100 columns |
//! | `json.rs` | figures and photon-transfer curve, data sheet of a camera, for programs |
//! | `chart.rs` | variance over mean (feature `plot`) |
//! | `descriptor.rs` | which frame is which: the text file that the package emva1288 reads |

#[cfg(feature = "plot")]
pub mod chart;
pub mod descriptor;
mod json;
mod sheet;
mod text;

pub use json::{sheet_to_json, to_json};
pub use sheet::sheet_to_text;
pub use text::to_text;
