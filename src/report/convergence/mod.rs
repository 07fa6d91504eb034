//! Error against run time as text, JSON and CSV, and the references that are read for it.
//!
//! | file | what |
//! |---|---|
//! | `text.rs` | tables for a person |
//! | `json.rs` | everything, for programs; numbers keep all their digits |
//! | `csv.rs` | a row a rung of each curve, for spreadsheets |
//! | `reference.rs` | values, or a file of readings, as a reference |

mod csv;
mod json;
mod reference;
mod text;

pub use csv::to_csv;
pub use json::to_json;
pub use reference::{reference_from_csv, reference_from_json, reference_from_values};
pub use text::to_text;

use crate::study::converge::Convergence;

/// A study, and how its times were taken.
#[derive(Debug, Clone, PartialEq)]
pub struct ConvergenceReport {
    /// What was found.
    pub study: Convergence,
    /// The scene file as it was named.
    pub scene_file: String,
    /// Threads of the runs.
    pub threads: u64,
    /// What the processor time is: "processor time of the process (schedstat)".
    pub cpu_clock: String,
}
