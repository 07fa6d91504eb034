//! Error against run time as text, JSON and CSV, and the references that are read for it.
//!
//! | file | what |
//! |---|---|
//! | `text.rs` | tables for a person |
//! | `json.rs` | everything, for programs; numbers keep all their digits |
//! | `csv.rs` | a row a rung of each curve, for spreadsheets |
//! | `reference.rs` | values, or a file of readings, as a reference |
//! | `campaign.rs`, `campaign_json.rs` | the same of calibrations |

mod campaign;
mod campaign_json;
mod csv;
mod json;
mod reference;
mod text;

pub use campaign::{campaign_to_csv, campaign_to_text};
pub use campaign_json::campaign_to_json;
pub use csv::to_csv;
pub use json::to_json;
pub use reference::{reference_from_csv, reference_from_json, reference_from_values};
pub use text::to_text;

use crate::study::converge::Convergence;
use crate::study::converge::campaign::CampaignConvergence;

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

/// A study of a campaign, and how its times were taken.
#[derive(Debug, Clone, PartialEq)]
pub struct CampaignReport {
    /// What was found.
    pub study: CampaignConvergence,
    /// The calibration file as it was named.
    pub file: String,
    /// Threads of the runs.
    pub threads: u64,
    /// What the processor time is.
    pub cpu_clock: String,
}
