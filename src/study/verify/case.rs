//! A reference case, as it stands in a file of `cases/`.
//!
//! ```text
//! |reading − reference| ≤ max(rel_tol · |reference|, abs_tol)
//! ```
//!
//! | field | |
//! |---|---|
//! | `id` | `g1c.disc-par-3`: group `g1`, part `g1c`, family `g1c.disc-par`, number of the case |
//! | `title`, `quantity`, `unit` | what is computed |
//! | `inputs` | numbers as decimal strings, lists and records of them, texts |
//! | `reference` | decimal string; a case without one states a `behaviour` |
//! | `rel_tol`, `abs_tol` | largest deviation that passes, relative and in the unit |

use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

use serde_json::Value;

use crate::measurement::Reading;
use crate::metrology::Expanded;
use crate::metrology::distribution::student_t_quantile;
use crate::spectrum::table_text::{TextRules, parse};
use crate::spectrum::{Density, Outside, Table};

/// Texts of tables that cases name, by file name. What is not here is not shipped with the library: see [`Fault::NoTable`].
pub type Tables = BTreeMap<String, String>;

/// Why a case could not be computed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The case needs a table that was not supplied.
    NoTable(String),
    /// Anything else: an input that is missing, a scene that cannot be read.
    Wrong(String),
}

impl Fault {
    /// A fault with its words.
    pub fn wrong(words: impl Into<String>) -> Fault {
        Fault::Wrong(words.into())
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Fault::NoTable(name) => write!(f, "needs the table {name}, which is not shipped"),
            Fault::Wrong(words) => f.write_str(words),
        }
    }
}

// `Fault` is no `std::error::Error` itself, so that every error becomes one with `?`.
impl<E: std::error::Error> From<E> for Fault {
    fn from(error: E) -> Self {
        Fault::Wrong(error.to_string())
    }
}

/// How often a correct program may fail the whole suite after a change of its random numbers.
pub const CHANCE: f64 = 0.01;

/// Sampled readings in the suite, at most. An interval of 95 % for each would fail one in twenty correct ones.
pub const COMPARISONS: f64 = 100.0;

/// What a family computes of a case, in the unit of the case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    /// The value.
    pub value: f64,
    /// Its standard uncertainty u, where it is a reading; `None` for the value of a function.
    pub standard_uncertainty: Option<f64>,
    /// Its expanded uncertainty U at 95 %, where it is a reading.
    pub expanded_uncertainty: Option<f64>,
    /// Degrees of freedom behind u.
    pub degrees_of_freedom: f64,
    /// Samples that went into it; zero where formulas served.
    pub samples: u64,
}

impl From<f64> for Found {
    fn from(value: f64) -> Self {
        Found { value, standard_uncertainty: None, expanded_uncertainty: None, degrees_of_freedom: f64::INFINITY, samples: 0 }
    }
}

impl From<&Reading> for Found {
    fn from(reading: &Reading) -> Self {
        let Expanded { expanded_uncertainty, degrees_of_freedom, .. } = reading.expanded;
        Found {
            value: reading.value,
            standard_uncertainty: Some(reading.standard_uncertainty()),
            expanded_uncertainty: Some(expanded_uncertainty),
            degrees_of_freedom,
            samples: reading.samples,
        }
    }
}

impl Found {
    /// The same times an exact number.
    #[must_use]
    pub fn times(self, factor: f64) -> Found {
        let scale = |u: Option<f64>| u.map(|u| u * factor.abs());
        Found {
            value: self.value * factor,
            standard_uncertainty: scale(self.standard_uncertainty),
            expanded_uncertainty: scale(self.expanded_uncertainty),
            degrees_of_freedom: self.degrees_of_freedom,
            samples: self.samples,
        }
    }

    /// The difference to an independent one.
    #[must_use]
    pub fn minus(self, other: Found) -> Found {
        let joint = |a: Option<f64>, b: Option<f64>| Some(a?.hypot(b?));
        Found {
            value: self.value - other.value,
            standard_uncertainty: joint(self.standard_uncertainty, other.standard_uncertainty),
            expanded_uncertainty: joint(self.expanded_uncertainty, other.expanded_uncertainty),
            degrees_of_freedom: self.degrees_of_freedom.min(other.degrees_of_freedom),
            samples: self.samples + other.samples,
        }
    }

    /// Largest deviation from the reference that passes: the tolerance, or, where samples were taken, the half-width k u of the interval that holds
    /// the measurand with the probability 1 − [`CHANCE`]/[`COMPARISONS`], if that is larger.
    #[must_use]
    pub fn limit(&self, tolerance: f64) -> f64 {
        let k = student_t_quantile(1.0 - 0.5 * CHANCE / COMPARISONS, self.degrees_of_freedom);
        match (self.samples, k, self.standard_uncertainty) {
            (0, ..) | (_, None, _) | (.., None) => tolerance,
            (_, Some(k), Some(u)) => tolerance.max(k * u),
        }
    }
}

/// A reference case.
#[derive(Clone, Debug)]
pub struct Case {
    id: String,
    title: String,
    quantity: String,
    unit: String,
    reference: Option<f64>,
    rel_tol: f64,
    abs_tol: f64,
    behaviour: Option<String>,
    inputs: Value,
    tables: Arc<Tables>,
}

/// A number that the files hold as a decimal string.
fn decimal(value: &Value, what: &str) -> Result<f64, Fault> {
    let number = value.as_str().and_then(|text| text.trim().parse::<f64>().ok());
    number
        .filter(|x| x.is_finite())
        .ok_or_else(|| Fault::Wrong(format!("`{what}` is {value}; allowed: a number as text, such as \"2.5e-3\"")))
}

fn list<'a>(value: &'a Value, what: &str) -> Result<&'a Vec<Value>, Fault> {
    value.as_array().ok_or_else(|| Fault::Wrong(format!("`{what}` is {value}; allowed: a list")))
}

fn vector(value: &Value, what: &str) -> Result<[f64; 3], Fault> {
    let parts: Vec<f64> = list(value, what)?.iter().map(|part| decimal(part, what)).collect::<Result<_, _>>()?;
    parts.try_into().map_err(|parts: Vec<f64>| Fault::Wrong(format!("`{what}` has {} numbers; allowed: 3", parts.len())))
}

impl Case {
    /// A case from its record. Says everything that is wrong with it.
    pub(super) fn new(record: &Value, tables: &Arc<Tables>) -> Result<Case, Vec<String>> {
        let mut problems = Vec::new();
        let mut text = |key: &str| match record.get(key).and_then(Value::as_str).filter(|text| !text.is_empty()) {
            Some(text) => text.to_owned(),
            None => {
                problems.push(format!("`{key}` is missing or no text"));
                String::new()
            }
        };
        let [id, quantity, unit] = ["id", "quantity", "unit"].map(&mut text);
        // Where the title says no more than the quantity, it may be left empty.
        let title = if record.get("title").and_then(Value::as_str) == Some("") { quantity.clone() } else { text("title") };
        let behaviour = record.get("behaviour").and_then(Value::as_str).map(str::to_owned);
        let reference = match record.get("reference") {
            Some(value) => decimal(value, "reference").map_err(|fault| problems.push(fault.to_string())).ok(),
            None => {
                if behaviour.is_none() {
                    problems.push("neither `reference` nor `behaviour` is there; give the reference as text, such as \"318.3\"".into());
                }
                None
            }
        };
        let mut tolerance = |key: &str| match record.get(key) {
            None => 0.0,
            Some(value) => value.as_f64().filter(|x| *x > 0.0 && x.is_finite()).unwrap_or_else(|| {
                problems.push(format!("`{key}` is {value}; allowed: a number above 0, such as 1e-9"));
                0.0
            }),
        };
        let [rel_tol, abs_tol] = ["rel_tol", "abs_tol"].map(&mut tolerance);
        if reference.is_some() && record.get("rel_tol").is_none() && record.get("abs_tol").is_none() {
            problems.push("neither `rel_tol` nor `abs_tol` is there; give one, such as \"rel_tol\": 1e-9".into());
        }
        let inputs = record.get("inputs").cloned().unwrap_or(Value::Null);
        if !inputs.is_object() {
            problems.push("`inputs` is missing or no record".into());
        }
        if !problems.is_empty() {
            return Err(problems);
        }
        Ok(Case { id, title, quantity, unit, reference, rel_tol, abs_tol, behaviour, inputs, tables: Arc::clone(tables) })
    }

    /// `g1c.disc-par-3`.
    pub fn id(&self) -> &str {
        &self.id
    }

    /// `g1c.disc-par`.
    pub fn family(&self) -> &str {
        self.id.rsplit_once('-').map_or(&self.id, |(family, _)| family)
    }

    /// `g1c`.
    pub fn part(&self) -> &str {
        self.id.split_once('.').map_or(&self.id, |(part, _)| part)
    }

    /// `g1`: the part without its last letter.
    pub fn group(&self) -> &str {
        self.part().trim_end_matches(|c: char| c.is_ascii_lowercase())
    }

    /// What is computed, in a sentence.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// Symbol of the quantity.
    pub fn quantity(&self) -> &str {
        &self.quantity
    }

    /// Unit of reference and reading; `1` for a number.
    pub fn unit(&self) -> &str {
        &self.unit
    }

    /// The reference value; `None` for a case that states a behaviour.
    pub fn reference(&self) -> Option<f64> {
        self.reference
    }

    /// What has to happen where there is no number to compare with.
    pub fn behaviour(&self) -> Option<&str> {
        self.behaviour.as_deref()
    }

    /// Largest deviation that passes, in the unit of the case.
    pub fn tolerance(&self) -> f64 {
        (self.rel_tol * self.reference.unwrap_or(0.0).abs()).max(self.abs_tol)
    }

    /// The same case with another reference.
    #[must_use]
    pub fn with_reference(&self, reference: f64) -> Case {
        Case { reference: Some(reference), ..self.clone() }
    }

    /// |value − reference| over the tolerance; NaN for what is no number.
    pub fn deviation_in_tolerances(&self, value: f64) -> f64 {
        let deviation = (value - self.reference.unwrap_or(f64::NAN)).abs();
        if deviation == 0.0 { 0.0 } else { deviation / self.tolerance() }
    }

    /// An input as it is in the file.
    ///
    /// # Errors
    /// When the case has no such input; so do all that follow, and when it is of another kind.
    pub fn input(&self, key: &str) -> Result<&Value, Fault> {
        self.inputs.get(key).ok_or_else(|| Fault::Wrong(format!("the case has no input `{key}`")))
    }

    /// An input that is text.
    pub fn text(&self, key: &str) -> Result<&str, Fault> {
        let value = self.input(key)?;
        value.as_str().ok_or_else(|| Fault::Wrong(format!("`{key}` is {value}; allowed: text")))
    }

    /// An input that is a number.
    pub fn number(&self, key: &str) -> Result<f64, Fault> {
        decimal(self.input(key)?, key)
    }

    /// An input that is a list of numbers.
    pub fn numbers(&self, key: &str) -> Result<Vec<f64>, Fault> {
        list(self.input(key)?, key)?.iter().map(|value| decimal(value, key)).collect()
    }

    /// An input of three numbers.
    pub fn vector(&self, key: &str) -> Result<[f64; 3], Fault> {
        vector(self.input(key)?, key)
    }

    /// A list of vectors.
    pub fn vectors(&self, key: &str) -> Result<Vec<[f64; 3]>, Fault> {
        list(self.input(key)?, key)?.iter().map(|value| vector(value, key)).collect()
    }

    /// A list of pairs of numbers with texts as keys: one number of each record, in the order of the list.
    pub fn column(&self, key: &str, field: &str) -> Result<Vec<f64>, Fault> {
        list(self.input(key)?, key)?.iter().map(|record| decimal(record.get(field).unwrap_or(&Value::Null), field)).collect()
    }

    /// Sum of Gaussians, given by `peak`, `centre_nm` and `fwhm_nm` (full width at half maximum).
    pub fn gaussians(&self, key: &str) -> Result<Density, Fault> {
        let [peaks, centres, widths] = [self.column(key, "peak")?, self.column(key, "centre_nm")?, self.column(key, "fwhm_nm")?];
        let mut sum = Density::zero();
        for ((peak, centre_nm), fwhm_nm) in peaks.iter().zip(centres).zip(widths) {
            let sigma_nm = fwhm_nm / (8.0 * std::f64::consts::LN_2).sqrt();
            let power = peak * sigma_nm * (2.0 * std::f64::consts::PI).sqrt();
            sum = sum.plus(&Density::gaussian(power, centre_nm, sigma_nm)?);
        }
        Ok(sum)
    }

    /// A column of a table by file name; columns are counted from 0 without that of the wavelengths.
    ///
    /// # Errors
    /// [`Fault::NoTable`] when it was not supplied.
    pub fn table(&self, file: &str, column: usize) -> Result<Table, Fault> {
        let text = self.tables.get(file).ok_or_else(|| Fault::NoTable(file.to_owned()))?;
        let mut curves = parse(text, &TextRules::default()).map_err(|problems| {
            Fault::Wrong(format!("{file}: {}", problems.first().map_or_else(String::new, |p| format!("line {}: {}", p.line, p.message))))
        })?;
        if column >= curves.columns.len() {
            return Err(Fault::Wrong(format!("{file} has {} columns", curves.columns.len())));
        }
        Ok(Table::new(curves.wavelengths_nm, curves.columns.swap_remove(column), Outside::Zero)?)
    }
}
