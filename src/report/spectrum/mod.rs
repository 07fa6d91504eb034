//! The sheet of a spectrum as text, JSON and CSV.
//!
//! | file | what |
//! |---|---|
//! | `text.rs` | a page for a person |
//! | `json.rs` | everything, for programs; numbers keep all their digits |
//! | `csv.rs` | a row a quantity, for spreadsheets |

mod csv;
mod json;
mod text;

pub use csv::to_csv;
pub use json::to_json;
pub use text::to_text;

use crate::observer::sheet::SpectrumSheet;

/// A sheet with the name of its spectrum and all that is to be known about how it was read.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectrumReport {
    /// What the spectrum is called: a name of the library, a file, a form.
    pub spectrum: String,
    /// Its quantities.
    pub sheet: SpectrumSheet,
    /// How the input was understood, before the sheet's own remarks.
    pub remarks: Vec<String>,
}

impl SpectrumReport {
    /// All remarks: on the input, then on the quantities.
    pub fn all_remarks(&self) -> impl Iterator<Item = &str> {
        self.remarks.iter().chain(&self.sheet.remarks).map(String::as_str)
    }
}

#[cfg(test)]
mod tests;
