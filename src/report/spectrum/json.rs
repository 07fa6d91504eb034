//! The sheet of a spectrum as JSON.
//!
//! Schema 1: `{"schema", "spectrum", "scale", "quantities": [{"id", "group", "name", "column", "symbol", "unit", "value",
//! "standard_uncertainty", "undefined"}], "remarks": [...]}`. A value is a number, a text, or `null` with the reason in `undefined`.
//! `column`, `standard_uncertainty` and `undefined` are left out where there is none.

use serde::Serialize;

use super::SpectrumReport;
use crate::observer::sheet::{SheetRow, SheetValue};

#[derive(Serialize)]
struct Document<'a> {
    schema: u32,
    spectrum: &'a str,
    scale: &'a str,
    quantities: Vec<Row<'a>>,
    remarks: Vec<&'a str>,
}

#[derive(Serialize)]
struct Row<'a> {
    id: &'a str,
    group: &'static str,
    name: &'a str,
    #[serde(skip_serializing_if = "str::is_empty")]
    column: &'a str,
    symbol: &'a str,
    unit: &'a str,
    value: Value<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    standard_uncertainty: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    undefined: Option<&'a str>,
}

#[derive(Serialize)]
#[serde(untagged)]
enum Value<'a> {
    Number(f64),
    Text(&'a str),
    None,
}

fn row(row: &SheetRow) -> Row<'_> {
    let (value, undefined) = match &row.value {
        SheetValue::Number(number) => (Value::Number(*number), None),
        SheetValue::Text(text) => (Value::Text(text), None),
        SheetValue::Undefined(why) => (Value::None, Some(why.as_str())),
    };
    Row {
        id: &row.id,
        group: row.group.title(),
        name: &row.name,
        column: &row.column,
        symbol: &row.symbol,
        unit: &row.unit,
        value,
        standard_uncertainty: row.standard_uncertainty,
        undefined,
    }
}

/// The report as JSON text, indented, with a line end.
#[must_use]
pub fn to_json(report: &SpectrumReport) -> String {
    let document = Document {
        schema: 1,
        spectrum: &report.spectrum,
        scale: &report.sheet.scale,
        quantities: report.sheet.rows.iter().map(row).collect(),
        remarks: report.all_remarks().collect(),
    };
    // Structures of texts and finite numbers always have a JSON form.
    let mut text = serde_json::to_string_pretty(&document).unwrap_or_default();
    text.push('\n');
    text
}
