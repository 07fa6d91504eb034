//! Data sheets as text, JSON and charts.
//!
//! | file | what |
//! |---|---|
//! | `text` | a page of 100 columns for a person |
//! | `json` | every digit, for programs |
//! | `chart` | responsivity, directional response, mismatch of lamps (feature `plot`) |

#[cfg(feature = "plot")]
pub mod chart;
mod json;
pub(super) mod text;

pub use json::to_json;
pub use text::to_text;
