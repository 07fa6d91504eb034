//! The lecture as JSON.
//!
//! ```text
//! equations  {"schema", "equations": [{"name", "group", "formula", "about", "inputs": [{"keys": [{"key", "unit"}], "symbol", "meaning", "allowed"}], …}]}
//! answer     {"schema", "equation", "formula", "about", "inputs": [{"key", "symbol", "value", "unit", "meaning"}], "result": {…}, "also": […], "source"}
//! table      {"schema", "quantities": [{"row", "definition", "system", "name", "symbol", "unit", "unit_name", "other_units": […]}]}
//! ```
//!
//! Numbers keep all their digits.

use serde::Serialize;

use crate::lecture::{Answer, Domain, equations};
use crate::quantity::cell::CELLS;

#[derive(Serialize)]
struct Key {
    key: String,
    unit: &'static str,
}

#[derive(Serialize)]
struct InputWords {
    keys: Vec<Key>,
    symbol: &'static str,
    meaning: &'static str,
    allowed: String,
}

#[derive(Serialize)]
struct EquationWords {
    name: &'static str,
    group: &'static str,
    formula: &'static str,
    about: &'static str,
    inputs: Vec<InputWords>,
    result: &'static str,
    source: &'static str,
}

#[derive(Serialize)]
struct List {
    schema: u32,
    equations: Vec<EquationWords>,
}

#[derive(Serialize)]
#[serde(untagged)]
enum Value<'a> {
    Number(f64),
    Text(&'a str),
}

#[derive(Serialize)]
struct GivenWords<'a> {
    key: &'a str,
    symbol: &'a str,
    value: Value<'a>,
    unit: &'a str,
    meaning: &'a str,
}

#[derive(Serialize)]
struct Outcome<'a> {
    name: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    symbol: Option<&'a str>,
    value: f64,
    unit: &'a str,
}

#[derive(Serialize)]
struct Document<'a> {
    schema: u32,
    equation: &'a str,
    formula: &'a str,
    about: &'a str,
    inputs: Vec<GivenWords<'a>>,
    result: Outcome<'a>,
    also: Vec<Outcome<'a>>,
    source: &'a str,
}

#[derive(Serialize)]
struct Other {
    unit: &'static str,
    name: &'static str,
    size: f64,
}

#[derive(Serialize)]
struct Cell {
    row: &'static str,
    definition: &'static str,
    system: &'static str,
    name: &'static str,
    symbol: &'static str,
    unit: &'static str,
    unit_name: &'static str,
    other_units: Vec<Other>,
}

#[derive(Serialize)]
struct Table {
    schema: u32,
    quantities: Vec<Cell>,
}

fn written(document: &impl Serialize) -> String {
    // Strings and finite numbers only: there is nothing that could not be written.
    let mut text = serde_json::to_string_pretty(document).unwrap_or_default();
    text.push('\n');
    text
}

/// All equations.
#[must_use]
pub fn list() -> String {
    let equations = equations().map(|equation| EquationWords {
        name: equation.name,
        group: equation.group.title(),
        formula: equation.formula,
        about: equation.about,
        inputs: equation
            .inputs
            .iter()
            .map(|input| InputWords {
                keys: input.keys().into_iter().map(|(key, unit, _)| Key { key, unit }).collect(),
                symbol: input.symbol,
                meaning: input.meaning,
                allowed: Domain::words(input.domain),
            })
            .collect(),
        result: equation.outcome.words("radiant")[0],
        source: equation.source,
    });
    written(&List { schema: 1, equations: equations.collect() })
}

/// One answer.
#[must_use]
pub fn answer(answer: &Answer) -> String {
    let equation = answer.equation;
    written(&Document {
        schema: 1,
        equation: equation.name,
        formula: equation.formula,
        about: equation.about,
        inputs: answer
            .inputs
            .iter()
            .map(|input| GivenWords {
                key: &input.key,
                symbol: input.symbol,
                value: input.number.map_or(Value::Text(&input.value), Value::Number),
                unit: input.unit,
                meaning: input.meaning,
            })
            .collect(),
        result: Outcome { name: answer.name, symbol: Some(answer.symbol), value: answer.value, unit: answer.unit },
        also: answer.also.iter().map(|form| Outcome { name: form.what, symbol: None, value: form.value, unit: form.unit }).collect(),
        source: equation.source,
    })
}

/// The table of quantities and systems.
#[must_use]
pub fn table() -> String {
    let cell = |words: &crate::quantity::cell::Words| Cell {
        row: words.row.name(),
        definition: words.row.definition(),
        system: words.system,
        name: words.name,
        symbol: words.symbol,
        unit: words.unit,
        unit_name: words.unit_name,
        other_units: words.row.other_units(words.system).iter().map(|o| Other { unit: o.unit, name: o.name, size: o.size }).collect(),
    };
    written(&Table { schema: 1, quantities: CELLS.iter().map(cell).collect() })
}
