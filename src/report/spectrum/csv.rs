//! The sheet of a spectrum as CSV: a header row, then a row a quantity.
//!
//! | columns | |
//! |---|---|
//! | `spectrum`, `scale` | what it is of, and how its numbers were read; the same in each row |
//! | `id`, `group`, `name`, `column`, `symbol` | what the quantity is |
//! | `value`, `unit`, `standard_uncertainty` | the number with all its digits; empty where there is none |
//! | `undefined` | why there is no value |

use super::SpectrumReport;
use crate::observer::sheet::SheetValue;

const COLUMNS: [&str; 11] =
    ["spectrum", "scale", "id", "group", "name", "column", "symbol", "value", "unit", "standard_uncertainty", "undefined"];

/// The report as CSV text.
#[must_use]
pub fn to_csv(report: &SpectrumReport) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut rows: Vec<Vec<String>> = vec![COLUMNS.map(str::to_owned).to_vec()];
    rows.extend(report.sheet.rows.iter().map(|row| {
        let (value, undefined) = match &row.value {
            SheetValue::Number(number) => (number.to_string(), String::new()),
            SheetValue::Text(text) => (text.clone(), String::new()),
            SheetValue::Undefined(why) => (String::new(), why.clone()),
        };
        let words = [&report.spectrum, &report.sheet.scale, &row.id, row.group.title(), &row.name, &row.column, &row.symbol];
        let uncertainty = row.standard_uncertainty.map_or(String::new(), |u| u.to_string());
        words.map(str::to_owned).into_iter().chain([value, row.unit.clone(), uncertainty, undefined]).collect()
    }));
    for row in rows {
        // A vector takes whatever is written to it.
        let _ = writer.write_record(&row);
    }
    writer.into_inner().ok().and_then(|bytes| String::from_utf8(bytes).ok()).unwrap_or_default()
}
