//! Measurements as text, JSON and CSV.
//!
//! | file | what |
//! |---|---|
//! | `text.rs` | a table for a person |
//! | `json.rs` | everything, for programs; numbers keep all their digits |
//! | `csv.rs` | a row a reading, for spreadsheets |

pub mod csv;
pub mod json;
pub mod text;
