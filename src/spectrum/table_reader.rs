//! Reads a curve file line by line; see `table_text` for what it may hold.

use super::decimal_comma::{Commas, decide};
use super::table_row::{Field, Separator, are_names, split};
use super::table_text::{TableText, TextProblem, TextRules};
use super::table_units::{Per, WavelengthUnit, other_abscissa, shifted};

/// More problems than this are counted, not listed.
const MAX_PROBLEMS: usize = 100;

/// Longest wavelength, nm: a kilometre.
const LONGEST_NM: f64 = 1e12;

/// A statement about the file: what, and where it was made, in words and by line.
type Statement<T> = (T, String, usize);

/// State while the lines go by.
pub(super) struct Reader<'t> {
    rules: TextRules,
    text: &'t str,
    /// Whether commas in numbers are decimal ones, once a number with one was met.
    decimal_comma: Option<bool>,
    wavelength_unit: Option<Statement<WavelengthUnit>>,
    per: Option<Statement<Per>>,
    /// Rows whose wavelength is below the one before, and the number of problems before the first of them.
    falling: usize,
    first_falling: usize,
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

impl<'t> Reader<'t> {
    pub(super) fn new(rules: TextRules, text: &'t str) -> Self {
        let table = TableText {
            header: vec![],
            column_names: vec![],
            wavelengths_nm: vec![],
            columns: vec![],
            wavelength_unit: None,
            per: None,
            remarks: vec![],
        };
        Self {
            rules,
            text,
            decimal_comma: rules.decimal_comma.then_some(true),
            wavelength_unit: rules.wavelength_unit.map(|unit| (unit, "the option".into(), 1)),
            per: rules.per.map(|per| (per, "the option".into(), 1)),
            falling: 0,
            first_falling: 0,
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

    /// The table, or every problem.
    pub(super) fn read(mut self) -> Result<TableText, Vec<TextProblem>> {
        if self.text.starts_with('\u{feff}') {
            self.remark("a byte order mark at the beginning is left out");
            self.text = self.text.trim_start_matches('\u{feff}');
        }
        if self.text.contains('\r') && !self.text.contains('\n') {
            self.problem(1, "the lines end in CR alone, as on a Macintosh before 2001", "save the file with line ends LF or CR LF");
            return Err(self.problems);
        }
        if self.text.contains("\r\n") {
            self.remark("the lines end as on Windows (CR LF)");
        }
        for (index, line) in self.text.split('\n').enumerate() {
            self.line = index + 1;
            if !self.read_line(line.strip_suffix('\r').unwrap_or(line)) {
                break;
            }
        }
        self.finish()
    }

    fn problem(&mut self, column: usize, message: impl Into<String>, help: impl Into<String>) {
        if self.problems.len() < MAX_PROBLEMS {
            self.problems.push(TextProblem { line: self.line, column, message: message.into(), help: help.into() });
        } else {
            self.problems_unlisted += 1;
        }
    }

    fn remark(&mut self, remark: impl Into<String>) {
        self.table.remarks.push(remark.into());
    }

    /// Takes a statement about the unit of the wavelengths; one that contradicts an earlier one is a problem.
    fn state_unit(&mut self, unit: WavelengthUnit, by: String) {
        let line = self.line;
        let (known, earlier, at) = self.wavelength_unit.get_or_insert_with(|| (unit, by.clone(), line)).clone();
        if known != unit {
            let message = format!("{by} says that wavelengths are in {}, but {earlier} says {}", unit.symbol(), known.symbol());
            self.problem(1, message, contradiction(at, line));
        }
    }

    /// The same for what the values are per.
    fn state_per(&mut self, per: Per, by: String) {
        let line = self.line;
        let (known, earlier, at) = self.per.get_or_insert_with(|| (per, by.clone(), line)).clone();
        if known != per {
            let message = format!("{by} says that values are {}, but {earlier} says {}", per.described(), known.described());
            self.problem(1, message, contradiction(at, line));
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
        if self.width.is_none() && are_names(&fields) {
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
        match key.as_str() {
            "wavelength_unit" => match value.split([' ', '(']).next().and_then(WavelengthUnit::parse) {
                Some(unit) => self.state_unit(unit, format!("`# wavelength_unit: {value}`")),
                None => self.problem(1, format!("the wavelength unit is `{value}`"), format!("allowed: {}", WavelengthUnit::ALLOWED)),
            },
            "per" => match Per::parse(&value) {
                Some(per) => self.state_per(per, format!("`# per: {value}`")),
                None => self.problem(1, format!("the values are per `{value}`"), format!("allowed: {}", Per::ALLOWED)),
            },
            "unit" => {
                if let Some(per) = Per::of_unit(&value) {
                    self.state_per(per, format!("`# unit: {value}`"));
                }
            }
            "decimal" => match value.as_str() {
                "comma" | "," => self.decimal_comma = Some(true),
                "point" | "." => {}
                _ => self.problem(1, format!("the decimal mark is `{value}`"), "allowed: comma, point"),
            },
            _ => {}
        }
        self.table.header.push((key, value));
    }

    fn read_column_names(&mut self, fields: &[Field<'_>]) {
        self.set_width(fields.len());
        if let Some((field, other)) = fields.first().and_then(|field| Some((field, other_abscissa(field.text)?))) {
            let help = format!("a curve is over wavelength, in {}; convert the rows, values per {other} too", WavelengthUnit::ALLOWED);
            self.problem(field.column, format!("the first column is `{}`, not a wavelength", field.text), help);
        }
        if let Some((name, unit)) = fields.first().and_then(|field| Some((field.text, WavelengthUnit::of_column(field.text)?))) {
            self.state_unit(unit, format!("the column `{name}`"));
        }
        for (name, per) in fields.iter().skip(1).filter_map(|field| Some((field.text, Per::of_unit(field.text)?))) {
            self.state_per(per, format!("the column `{name}`"));
        }
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
        let unit = self.wavelength_unit.as_ref().map_or(0, |(unit, ..)| unit.power_of_ten());
        let numbers: Vec<Option<f64>> =
            fields.iter().enumerate().map(|(index, field)| self.number(field, if index == 0 { unit } else { 0 })).collect();
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

    /// The number in a field times a power of ten.
    fn number(&mut self, field: &Field<'_>, power_of_ten: i32) -> Option<f64> {
        let comma = self.separator.filter(|separator| *separator != Separator::Comma && field.has_comma_number());
        if let Some(separator) = comma
            && self.decimal_comma.is_none()
        {
            let commas = decide(self.text, separator);
            self.decimal_comma = Some(commas == Commas::Decimal);
            if let Commas::Unclear(line, column, message, help) = commas {
                let here = std::mem::replace(&mut self.line, line);
                self.problem(column, message, help);
                self.line = here;
            }
        }
        if comma.is_some() && self.decimal_comma == Some(false) {
            // Told once for all numbers of the file.
            return None;
        }
        let pointed = if comma.is_some() { field.text.replacen(',', ".", 1) } else { field.text.to_owned() };
        let value =
            Field { text: &pointed, ..*field }.number().map_err(|(message, help)| self.problem(field.column, message, help)).ok()?;
        if power_of_ten == 0 { Some(value) } else { shifted(&pointed, power_of_ten) }
    }

    fn check_wavelength(&mut self, wavelength_nm: f64, field: &Field<'_>) {
        if wavelength_nm <= 0.0 {
            self.problem(field.column, format!("the wavelength {} nm is not above 0", field.text), "wavelengths are in nm");
        }
        if wavelength_nm > LONGEST_NM {
            self.problem(field.column, format!("the wavelength is {wavelength_nm:e} nm"), format!("allowed: up to {LONGEST_NM:e} nm"));
        }
        if let Some((previous_nm, previous_line)) = self.previous {
            if wavelength_nm == previous_nm {
                let message = format!("{wavelength_nm} nm is there twice, in lines {previous_line} and {}", self.line);
                self.problem(field.column, message, "keep one of the two rows");
            } else if wavelength_nm < previous_nm {
                let line = self.line;
                if self.falling == 0 {
                    self.first_falling = self.problems.len();
                }
                self.falling += 1;
                let message = format!("{wavelength_nm} nm in line {line} follows {previous_nm} nm in line {previous_line}");
                self.problem(field.column, message, "sort the rows by wavelength, rising");
            }
        }
        self.previous = Some((wavelength_nm, self.line));
    }

    fn finish(mut self) -> Result<TableText, Vec<TextProblem>> {
        let last_line = std::mem::replace(&mut self.line, self.first_row_line);
        self.check_longest();
        self.line = last_line;
        if self.falling > 1 && self.falling == self.problems.len() && self.falling + 1 == self.rows_seen.min(MAX_PROBLEMS + 1) {
            // One cause, one problem.
            self.problems.truncate(1);
            self.problems_unlisted = 0;
            "the wavelengths fall from row to row".clone_into(&mut self.problems[0].message);
            "sort the rows by wavelength, rising".clone_into(&mut self.problems[0].help);
        }
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
        if !self.problems.is_empty() {
            return Err(self.problems);
        }
        self.conclude();
        Ok(self.table)
    }

    /// Wavelengths all below 10 nm are in another unit, or of another trade.
    fn check_longest(&mut self) {
        let longest = self.table.wavelengths_nm.iter().copied().fold(0.0, f64::max);
        if !(longest > 0.0 && longest < 10.0) {
            return;
        }
        let message = format!("all wavelengths are below 10 nm (the longest is {longest})");
        match &self.wavelength_unit {
            Some((unit, by, _)) if *unit != WavelengthUnit::Nanometre => {
                let help = format!("{by} says that they are in {}; is that so?", unit.symbol());
                self.problem(1, message, help);
            }
            stated => {
                let (unit, word, by) = if longest < 1e-4 { ("m", "metres", "1e9") } else { ("um", "micrometres", "1000") };
                let end = match stated {
                    None => format!("write `# wavelength_unit: {unit}` above them, or multiply them by {by} to get nm"),
                    Some((_, by_whom, _)) => format!("{by_whom} says nm; correct that to {unit}, or multiply the wavelengths by {by}"),
                };
                self.problem(1, message, format!("these look like {word}: {end}"));
            }
        }
    }

    /// What is told of a good table.
    fn conclude(&mut self) {
        if self.separator == Some(Separator::Semicolon) {
            self.remark("columns are separated by semicolons");
        }
        if self.decimal_comma == Some(true) {
            self.remark("commas in numbers are read as decimal commas");
        }
        self.table.wavelength_unit = self.wavelength_unit.as_ref().map(|(unit, ..)| *unit);
        self.table.per = self.per.as_ref().map(|(per, ..)| *per);
        if let Some((unit, by, _)) = self.wavelength_unit.clone().filter(|(unit, ..)| *unit != WavelengthUnit::Nanometre) {
            let ends = (self.table.wavelengths_nm.first(), self.table.wavelengths_nm.last());
            if let (Some(from), Some(to)) = ends {
                self.remark(format!("wavelengths converted from {} to nm ({by}): {from} nm to {to} nm", unit.symbol()));
            }
        }
    }
}

/// What to do about two statements that contradict each other.
fn contradiction(earlier: usize, later: usize) -> String {
    format!("make lines {earlier} and {later} say the same")
}
