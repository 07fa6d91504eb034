//! What each rule of the plan saves, as text, Markdown, JSON and CSV.
//!
//! | file | what |
//! |---|---|
//! | `cells.rs` | numbers and rows that the tables share |
//! | `text.rs` | for a terminal |
//! | `markdown.rs` | for documentation |
//! | `json.rs`, `csv.rs` | for programs; numbers keep all their digits |

mod cells;
mod csv;
mod json;
mod markdown;
mod text;

pub use self::csv::to_csv;
pub use self::json::to_json;
pub use self::markdown::to_markdown;
pub use self::text::to_text;

use crate::study::savings::{SavingsOptions, SceneSavings};

/// A study of savings, and how its times were taken.
#[derive(Clone, Debug, PartialEq)]
pub struct SavingsReport {
    /// How it was made.
    pub options: SavingsOptions,
    /// A scene each.
    pub scenes: Vec<SceneSavings>,
    /// Scenes that could not be studied, and why.
    pub failed: Vec<(String, String)>,
    /// Threads of the runs.
    pub threads: u64,
    /// What the processor time is.
    pub cpu_clock: String,
}
