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
//! Columns are separated by comma, semicolon, tab or blanks, one kind for the whole file; numbers have a decimal point. A byte order mark
//! and Windows line ends are accepted. Further `#` lines between rows are comments.

use super::table_row::{Field, Separator, split};

/// What a file may hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TextRules {
    /// Whether values below zero have a meaning.
    pub negative_values: bool,
    /// Largest number of rows.
    pub max_rows: usize,
    /// Largest number of columns, the wavelength included.
    pub max_columns: usize,
}

impl Default for TextRules {
    /// No negative values, at most a million rows and 1000 columns.
    fn default() -> Self {
        Self { negative_values: false, max_rows: 1_000_000, max_columns: 1000 }
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
}

impl TableText {
    /// The value of a header line, by its key in lower case.
    pub fn header_value(&self, key: &str) -> Option<&str> {
        self.header.iter().find(|(found, _)| found == key).map(|(_, value)| value.as_str())
    }
}

/// More problems than this are counted, not listed.
const MAX_PROBLEMS: usize = 100;

/// Reads the bytes of a curve file; text that is not UTF-8 is a problem as well. See [`parse`].
pub fn parse_bytes(bytes: &[u8], rules: &TextRules) -> Result<TableText, Vec<TextProblem>> {
    match std::str::from_utf8(bytes) {
        Ok(text) => parse(text, rules),
        Err(error) => {
            let before = &bytes[..error.valid_up_to()];
            let line_start = before.iter().rposition(|byte| *byte == b'\n').map_or(0, |position| position + 1);
            let column = String::from_utf8_lossy(&before[line_start..]).chars().count() + 1;
            let line = before.iter().filter(|byte| **byte == b'\n').count() + 1;
            let message = format!("the byte 0x{:02x} is not UTF-8 text", bytes[error.valid_up_to()]);
            let help = "save the file as plain text in UTF-8 (CSV)".to_owned();
            Err(vec![TextProblem { line, column, message, help }])
        }
    }
}

/// Reads the text of a curve file.
///
/// # Errors
/// Every problem found, each with its line and column; at most 100 are listed, the last then says how many more there are.
pub fn parse(text: &str, rules: &TextRules) -> Result<TableText, Vec<TextProblem>> {
    let mut reader = Reader::new(*rules);
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    for (index, line) in text.split('\n').enumerate() {
        reader.line = index + 1;
        if !reader.read_line(line.strip_suffix('\r').unwrap_or(line)) {
            break;
        }
    }
    reader.finish()
}

/// State while the lines go by.
struct Reader {
    rules: TextRules,
    line: usize,
    separator: Option<Separator>,
    width: Option<usize>,
    previous: Option<(f64, usize)>,
    rows_seen: usize,
    first_row_line: usize,
    table: TableText,
    problems: Vec<TextProblem>,
    problems_unlisted: usize,
}

impl Reader {
    fn new(rules: TextRules) -> Self {
        let table = TableText { header: vec![], column_names: vec![], wavelengths_nm: vec![], columns: vec![] };
        Self {
            rules,
            line: 1,
            separator: None,
            width: None,
            previous: None,
            rows_seen: 0,
            first_row_line: 1,
            table,
            problems: vec![],
            problems_unlisted: 0,
        }
    }

    fn problem(&mut self, column: usize, message: impl Into<String>, help: impl Into<String>) {
        if self.problems.len() < MAX_PROBLEMS {
            self.problems.push(TextProblem { line: self.line, column, message: message.into(), help: help.into() });
        } else {
            self.problems_unlisted += 1;
        }
    }

    /// False when reading must stop.
    fn read_line(&mut self, line: &str) -> bool {
        let trimmed = line.trim();
        if let Some(comment) = trimmed.strip_prefix('#') {
            if self.width.is_none() {
                self.read_header(comment);
            }
            return true;
        }
        if trimmed.is_empty() {
            return true;
        }
        let separator = *self.separator.get_or_insert_with(|| Separator::of(trimmed));
        let fields = split(line, separator);
        if self.width.is_none() && fields.first().is_some_and(|field| field.is_a_name()) {
            self.read_column_names(&fields);
            return true;
        }
        if self.rows_seen == self.rules.max_rows {
            let message = format!("the table has more than {} rows", self.rules.max_rows);
            self.problem(1, message, "thin the table, or integrate it into wider steps");
            return false;
        }
        if self.rows_seen == 0 {
            self.first_row_line = self.line;
        }
        self.rows_seen += 1;
        self.read_row(&fields);
        true
    }

    fn read_header(&mut self, comment: &str) {
        let Some((key, value)) = comment.split_once(':') else {
            return;
        };
        let (key, value) = (key.trim().to_lowercase(), value.trim().to_owned());
        if self.table.header.iter().any(|(known, _)| *known == key) {
            self.problem(1, format!("the header has `{key}` twice"), "keep one of them");
        }
        if key == "wavelength_unit" && !(value == "nm" || value.starts_with("nm ")) {
            self.problem(1, format!("the wavelength unit is `{value}`"), "convert the wavelengths to nm and write `# wavelength_unit: nm`");
        }
        self.table.header.push((key, value));
    }

    fn read_column_names(&mut self, fields: &[Field<'_>]) {
        self.set_width(fields.len());
        self.table.column_names = fields.iter().skip(1).map(|field| field.text.to_owned()).collect();
        // Names may be separated by commas and blanks in a file whose numbers are not: the rows decide for themselves.
        self.separator = self.separator.filter(|separator| *separator != Separator::Blank);
    }

    fn set_width(&mut self, width: usize) {
        if width < 2 {
            self.problem(1, "a row needs a wavelength and at least one value", "separate the columns by comma, semicolon, tab or blanks");
        }
        if width > self.rules.max_columns {
            let message = format!("the table has {width} columns, more than {}", self.rules.max_columns);
            self.problem(1, message, "split the table into several files");
        }
        self.width = Some(width);
        self.table.columns = vec![Vec::new(); width.saturating_sub(1).min(self.rules.max_columns)];
    }

    fn read_row(&mut self, fields: &[Field<'_>]) {
        if self.separator == Some(Separator::Comma)
            && let Some((field, at)) = fields.iter().find_map(|field| Some((field, field.text.find(';')?)))
        {
            let message = "a semicolon in a table whose columns are separated by commas";
            let help = "if the commas here are decimal commas, write decimal points; separate all columns alike, as in `400;1.5`";
            self.problem(field.column + field.text[..at].chars().count(), message, help);
            return;
        }
        if self.width.is_none() {
            self.set_width(fields.len());
        }
        let width = self.width.unwrap_or(fields.len());
        if fields.len() != width {
            let few_or_many = if fields.len() < width { "few" } else { "many" };
            let message = format!("too {few_or_many} columns: {} instead of {width}", fields.len());
            let help = if fields.len() == 2 * width && self.separator == Some(Separator::Comma) {
                "this looks like decimal commas; write decimal points, as in `380.5,0.12`"
            } else {
                "give every row as many columns as the first"
            };
            self.problem(fields.last().map_or(1, |field| field.column), message, help);
            return;
        }
        let numbers: Vec<Option<f64>> = fields.iter().map(|field| self.number(field)).collect();
        let Some(wavelength_nm) = numbers[0] else {
            return;
        };
        self.check_wavelength(wavelength_nm, &fields[0]);
        for (field, value) in fields.iter().zip(&numbers).skip(1) {
            if let Some(value) = value
                && *value < 0.0
                && !self.rules.negative_values
            {
                self.problem(field.column, format!("the value {} is negative", field.text), "values must be 0 or above here");
            }
        }
        self.table.wavelengths_nm.push(wavelength_nm);
        for (column, value) in self.table.columns.iter_mut().zip(numbers.into_iter().skip(1)) {
            // A column with a hole has a problem listed, so it never leaves this file.
            column.extend(value);
        }
    }

    fn number(&mut self, field: &Field<'_>) -> Option<f64> {
        field.number().map_err(|(message, help)| self.problem(field.column, message, help)).ok()
    }

    fn check_wavelength(&mut self, wavelength_nm: f64, field: &Field<'_>) {
        if wavelength_nm <= 0.0 {
            self.problem(field.column, format!("the wavelength {} nm is not above 0", field.text), "wavelengths are in nm");
        }
        if let Some((previous_nm, previous_line)) = self.previous {
            if wavelength_nm == previous_nm {
                let message = format!("{wavelength_nm} nm is there twice, in lines {previous_line} and {}", self.line);
                self.problem(field.column, message, "keep one of the two rows");
            } else if wavelength_nm < previous_nm {
                let line = self.line;
                let message = format!("{wavelength_nm} nm in line {line} follows {previous_nm} nm in line {previous_line}");
                self.problem(field.column, message, "sort the rows by wavelength, rising");
            }
        }
        self.previous = Some((wavelength_nm, self.line));
    }

    fn finish(mut self) -> Result<TableText, Vec<TextProblem>> {
        let last_line = std::mem::replace(&mut self.line, self.first_row_line);
        let longest = self.table.wavelengths_nm.iter().copied().fold(0.0, f64::max);
        if longest > 0.0 && longest < 10.0 {
            let (unit, by) = if longest < 1e-4 { ("metres", "1e9") } else { ("micrometres", "1000") };
            let message = format!("all wavelengths are below 10 nm (the longest is {longest})");
            self.problem(1, message, format!("these look like {unit}; multiply them by {by} to get nm"));
        }
        self.line = last_line;
        match self.rows_seen {
            0 => self.problem(1, "the table has no rows", "give at least two rows `wavelength_nm,value`"),
            1 => self.problem(1, "the table has one row", "a curve needs at least two rows; for a constant give the number itself"),
            _ => {}
        }
        if self.problems_unlisted > 0 {
            let message = format!("and {} more problems", self.problems_unlisted);
            let help = "correct the ones listed first".to_owned();
            self.problems.push(TextProblem { line: last_line, column: 1, message, help });
        }
        if self.problems.is_empty() { Ok(self.table) } else { Err(self.problems) }
    }
}
