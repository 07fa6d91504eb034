//! The figures of EMVA 1288 as text and JSON, and the description of a set of frames for other programs.
//!
//! | file | what |
//! |---|---|
//! | `text.rs` | a table for a person |
//! | `json.rs` | figures and photon-transfer curve, for programs |
//! | `descriptor.rs` | which frame is which: the text file that the package emva1288 reads |

pub mod descriptor;
mod json;
mod text;

pub use json::to_json;
pub use text::to_text;
