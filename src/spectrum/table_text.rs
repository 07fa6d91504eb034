//! Text of a curve file to columns, or all its problems at once.
//!
//! ```text
//! # name: my photodiode            header lines: key, colon, value
//! # unit: A/W
//! wavelength_nm,responsivity       names of the columns, optional
//! 380,0.051                        wavelength in nm, then one value or more
//! 390,0.063
//! ```
//!
//! Columns are separated by comma, semicolon, tab or blanks, one kind for the whole file. Further `#` lines between rows are comments.
//! Accepted and told as a remark: a byte order mark, Windows line ends, semicolons, decimal commas that can be nothing else, wavelengths
//! in a unit that is stated (`# wavelength_unit: um`, or in the name of the column) and converted to nm.

use super::table_reader::Reader;
use super::table_units::{Per, WavelengthUnit};

/// What a file may hold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TextRules {
    /// Whether values below zero have a meaning.
    pub negative_values: bool,
    /// Largest number of rows.
    pub max_rows: usize,
    /// Largest number of columns, the wavelength included.
    pub max_columns: usize,
    /// Unit of the wavelengths, if whoever reads the file states it.
    pub wavelength_unit: Option<WavelengthUnit>,
    /// What the values are per, if whoever reads the file states it.
    pub per: Option<Per>,
    /// Whether whoever reads the file states that commas in numbers are decimal commas.
    pub decimal_comma: bool,
}

impl Default for TextRules {
    /// No negative values, at most a million rows and 1000 columns, nothing stated.
    fn default() -> Self {
        Self { negative_values: false, max_rows: 1_000_000, max_columns: 1000, wavelength_unit: None, per: None, decimal_comma: false }
    }
}

/// One problem of a curve file, and what to do about it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TextProblem {
    /// Line, counted from 1.
    pub line: usize,
    /// Column in characters, counted from 1.
    pub column: usize,
    /// What was found.
    pub message: String,
    /// What is allowed, or what to type instead.
    pub help: String,
}

/// A curve file whose every number is good.
#[derive(Debug, Clone, PartialEq)]
pub struct TableText {
    /// Header lines as (key, value), in their order; keys in lower case.
    pub header: Vec<(String, String)>,
    /// Names of the value columns; empty if the file names none.
    pub column_names: Vec<String>,
    /// Wavelengths, nm, strictly increasing, at least two.
    pub wavelengths_nm: Vec<f64>,
    /// The value columns, each as long as the wavelengths.
    pub columns: Vec<Vec<f64>>,
    /// Unit that the wavelengths had, if it was stated.
    pub wavelength_unit: Option<WavelengthUnit>,
    /// What the values are per, if it was stated: by the rules, `# per:`, `# unit:` or the name of a column. Values are as in the file.
    pub per: Option<Per>,
    /// What was accepted that not every program would, and how it was understood.
    pub remarks: Vec<String>,
}

impl TableText {
    /// The value of a header line, by its key in lower case.
    pub fn header_value(&self, key: &str) -> Option<&str> {
        self.header.iter().find(|(found, _)| found == key).map(|(_, value)| value.as_str())
    }
}

/// Reads the bytes of a curve file; text that is not UTF-8 is a problem as well. See [`parse`].
pub fn parse_bytes(bytes: &[u8], rules: &TextRules) -> Result<TableText, Vec<TextProblem>> {
    parse(utf8(bytes).map_err(|problem| vec![problem])?, rules)
}

/// Bytes as text, or the place of the first that is none.
pub(super) fn utf8(bytes: &[u8]) -> Result<&str, TextProblem> {
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) || bytes.iter().take(4).any(|byte| *byte == 0) {
        let message = "the file is text in UTF-16, or no text at all".to_owned();
        return Err(TextProblem { line: 1, column: 1, message, help: "save the file as plain text in UTF-8 (CSV)".to_owned() });
    }
    std::str::from_utf8(bytes).map_err(|error| {
        let before = &bytes[..error.valid_up_to()];
        let line_start = before.iter().rposition(|byte| *byte == b'\n').map_or(0, |position| position + 1);
        let column = String::from_utf8_lossy(&before[line_start..]).chars().count() + 1;
        let line = before.iter().filter(|byte| **byte == b'\n').count() + 1;
        let message = format!("the byte 0x{:02x} is not UTF-8 text", bytes[error.valid_up_to()]);
        TextProblem { line, column, message, help: "save the file as plain text in UTF-8 (CSV)".to_owned() }
    })
}

/// Reads the text of a curve file.
///
/// # Errors
/// Every problem found, each with its line and column; at most 100 are listed, the last then says how many more there are.
pub fn parse(text: &str, rules: &TextRules) -> Result<TableText, Vec<TextProblem>> {
    Reader::new(*rules, text).read()
}
