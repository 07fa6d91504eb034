//! Does every reference case come out, on this machine?
//!
//! ```text
//! a value or a reading of formulas   |y − y₀| ≤ max(rel_tol · |y₀|, abs_tol)
//! a reading of samples               |y − y₀| ≤ max(k u, tolerance)
//! ```
//!
//! | symbol | |
//! |---|---|
//! | y | what the family of the case computes of its inputs |
//! | y₀ | the reference of the case: a closed form or a quadrature, by two routes outside this program |
//! | u | standard uncertainty that the reading states of itself |
//! | k | coverage factor by Student's t at the level 1 − 0.01/100: a correct program fails the suite after one change of its random numbers in a hundred |
//!
//! # How to add cases
//!
//! * Of a family that exists: a record in a file of `cases/`, or a file of one's own on the command line (`etendue verify --cases FILE`). No code.
//! * A new family: a function in a file of `families/` and its name in the table `FAMILIES` of that file.
//! * A new part of the project: a file in `cases/`, named in [`FILES`]; a file in `families/`, named in `families/mod.rs`.
//!
//! A case of no family is an error unless it is in [`WAITING`], with the reason. A case that states a behaviour and no number is listed; the
//! tests hold it.
//!
//! ```
//! use etendue::study::verify::{Selection, Suite, Tables};
//!
//! let suite = Suite::built_in(Tables::new()).map_err(|problems| problems.join("\n"))?;
//! let found = suite.run(&Selection::group("g1e"), &|| 0.0).map_err(|problems| problems.join("\n"))?;
//! assert!(found.passed() && found.checks.len() == 6);
//! # Ok::<(), String>(())
//! ```

pub mod bench;
pub mod case;
pub mod families;
mod outcome;

use std::collections::BTreeMap;
use std::sync::Arc;

use serde_json::Value;

pub use case::{Case, Fault, Found, Tables};
pub use outcome::{Check, Summary, Verdict, Verification};

use crate::naming::nearest;
use families::Family;

/// The files of cases that come with the library.
pub const FILES: [(&str, &str); 6] = [
    ("g1_radiometry.json", include_str!("cases/g1_radiometry.json")),
    ("g2_spectral.json", include_str!("cases/g2_spectral.json")),
    ("g3_transport.json", include_str!("cases/g3_transport.json")),
    ("g4_extreme.json", include_str!("cases/g4_extreme.json")),
    ("g5_calibration.json", include_str!("cases/g5_calibration.json")),
    ("g6_emva1288.json", include_str!("cases/g6_emva1288.json")),
];

/// Families and single cases that cannot be computed yet, each with the reason.
pub const WAITING: &[(&str, &str)] = &[
    ("g3a.sphere-spot", "a beam of limited width is no source of a scene yet"),
    ("g3a.cavity", "surfaces that emit by their temperature and emissivity are not in scenes yet"),
    ("g3b.plates-E1", "plates without end are no shape of a scene"),
    ("g3b.plates-mid", "plates without end are no shape of a scene"),
    ("g3d.duct-bottom_mean", "a duct without end is no shape of a scene"),
    ("g3d.duct-top_mean", "a duct without end is no shape of a scene"),
    ("g3d.duct-side_mean", "a duct without end is no shape of a scene"),
    ("g3d.duct-bottom_mid", "a duct without end is no shape of a scene"),
    ("g3d.duct-top_mid", "a duct without end is no shape of a scene"),
    ("g3d.duct-side_mid", "a duct without end is no shape of a scene"),
    ("g3d.duct-side_quarter", "a duct without end is no shape of a scene"),
    ("g3g.facade-DF", "the overcast sky through an opening of a black room has no scene yet"),
    ("g3g.cie-sky-L", "the general sky of CIE S 011 is not in scenes yet"),
    ("g3g.cie-sky-Eh", "the general sky of CIE S 011 is not in scenes yet"),
    ("g4f.sphere-stiff", "1e6 reflections at a tolerance of 1e-6 need a deterministic solution of the enclosure with its port"),
];

/// Why a case waits, if it does.
fn waiting(case: &Case) -> Option<&'static str> {
    WAITING.iter().find(|(name, _)| *name == case.id() || *name == case.family()).map(|(_, why)| *why)
}

/// Which cases are computed: all if both lists are empty, else those of any of the groups and those named.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Selection {
    /// Groups (`g2`), parts (`g2a`) or families (`g2a.bb-x`).
    pub groups: Vec<String>,
    /// Cases by id.
    pub cases: Vec<String>,
}

impl Selection {
    /// One group, part or family.
    #[must_use]
    pub fn group(name: &str) -> Selection {
        Selection { groups: vec![name.to_owned()], cases: Vec::new() }
    }

    fn takes(&self, case: &Case) -> bool {
        let all = self.groups.is_empty() && self.cases.is_empty();
        let groups = [case.group(), case.part(), case.family()];
        all || self.groups.iter().any(|name| groups.contains(&name.as_str())) || self.cases.iter().any(|id| id == case.id())
    }
}

/// Cases with the functions that compute them.
#[derive(Debug)]
pub struct Suite {
    cases: Vec<Case>,
    titles: BTreeMap<String, String>,
    families: BTreeMap<&'static str, Family>,
}

impl Suite {
    /// The cases that come with the library. `tables` are those that the cases name, as far as they are at hand.
    ///
    /// # Errors
    /// With every problem of the files.
    pub fn built_in(tables: Tables) -> Result<Suite, Vec<String>> {
        Self::from_files(&FILES, tables)
    }

    /// Cases of files, each as (name, text).
    ///
    /// # Errors
    /// With every problem of the files: no JSON, no case in it, a field that is missing or of another kind, an id that stands twice, a family
    /// that is unknown.
    pub fn from_files(files: &[(&str, &str)], tables: Tables) -> Result<Suite, Vec<String>> {
        let tables = Arc::new(tables);
        let mut suite = Suite { cases: Vec::new(), titles: BTreeMap::new(), families: families::all().collect() };
        let mut problems = Vec::new();
        for (name, text) in files {
            suite.add(name, text, &tables, &mut problems);
        }
        if problems.is_empty() { Ok(suite) } else { Err(problems) }
    }

    fn add(&mut self, name: &str, text: &str, tables: &Arc<Tables>, problems: &mut Vec<String>) {
        let file: Value = match serde_json::from_str(text.trim_start_matches('\u{feff}')) {
            Ok(file) => file,
            Err(error) => {
                let what = error.to_string();
                let what = what.rsplit_once(" at line").map_or(what.as_str(), |(what, _)| what);
                problems.push(format!("{name}:{}:{}: no JSON: {what}", error.line(), error.column()));
                return;
            }
        };
        let Some(records) = file.get("cases").and_then(Value::as_array).filter(|records| !records.is_empty()) else {
            problems.push(format!("{name}: no cases; write {{\"title\": \"…\", \"cases\": [{{\"id\": \"g1e.sphere-101\", …}}]}}"));
            return;
        };
        for (index, record) in records.iter().enumerate() {
            let id = record.get("id").and_then(Value::as_str).map_or_else(|| format!("case {}", index + 1), str::to_owned);
            let case = match Case::new(record, tables) {
                Ok(case) => case,
                Err(of_case) => {
                    problems.extend(of_case.into_iter().map(|problem| format!("{name}: {id}: {problem}")));
                    continue;
                }
            };
            if self.cases.iter().any(|other| other.id() == id) {
                problems.push(format!("{name}: {id}: a case of this id is there already; give it another number"));
            }
            if !self.families.contains_key(case.family()) && case.reference().is_some() && waiting(&case).is_none() {
                let near = nearest(case.family(), self.families.keys().copied());
                let near = near.map_or_else(|| "etendue verify lists them".to_owned(), |near| format!("did you mean `{near}`?"));
                problems.push(format!("{name}: {id}: no family `{}`; {near}", case.family()));
            }
            if let Some(title) = file.get("title").and_then(Value::as_str) {
                self.titles.entry(case.group().to_owned()).or_insert_with(|| title.to_owned());
            }
            self.cases.push(case);
        }
    }

    /// All cases, in the order of the files.
    pub fn cases(&self) -> &[Case] {
        &self.cases
    }

    /// What a group is about.
    pub fn title(&self, group: &str) -> &str {
        self.titles.get(group).map_or("", String::as_str)
    }

    /// Computes a case. `now` gives seconds since any moment.
    pub fn check(&self, case: &Case, now: &dyn Fn() -> f64) -> Check {
        let start = now();
        let verdict = match (waiting(case), case.reference(), self.families.get(case.family())) {
            (Some(why), ..) => Verdict::Waits(why.to_owned()),
            (None, None, _) => Verdict::Behaviour(case.behaviour().unwrap_or_default().to_owned()),
            (None, Some(_), None) => Verdict::Failed(format!("no family `{}`", case.family())),
            (None, Some(reference), Some(family)) => match family(case) {
                Ok(found) => Verdict::of(case, reference, found),
                Err(fault @ Fault::NoTable(_)) => Verdict::Waits(fault.to_string()),
                Err(Fault::Wrong(words)) => Verdict::Failed(words),
            },
        };
        Check::new(case, verdict, now() - start)
    }

    /// Computes the cases of a selection, in the order of the files. `now` gives seconds since any moment.
    ///
    /// # Errors
    /// With every group and case that there is not, and what was probably meant.
    pub fn run(&self, selection: &Selection, now: &dyn Fn() -> f64) -> Result<Verification, Vec<String>> {
        let start = now();
        let mut problems = Vec::new();
        for name in &selection.groups {
            let known = || self.cases.iter().flat_map(|case| [case.group(), case.part(), case.family()]);
            if !known().any(|group| group == name) {
                problems.push(unknown("group", name, known(), self.cases.iter().map(Case::part)));
            }
        }
        for id in &selection.cases {
            if !self.cases.iter().any(|case| case.id() == id) {
                let family = id.rsplit_once('-').map_or(id.as_str(), |(family, _)| family);
                let of_family = self.cases.iter().filter(|case| case.family() == family).map(Case::id);
                problems.push(unknown("case", id, self.cases.iter().map(Case::id), of_family));
            }
        }
        if !problems.is_empty() {
            return Err(problems);
        }
        let checks: Vec<Check> = self.cases.iter().filter(|case| selection.takes(case)).map(|case| self.check(case, now)).collect();
        let titles = self.titles.clone();
        Ok(Verification { checks, titles, seconds: now() - start })
    }
}

/// What is not there, and what is.
fn unknown<'a>(kind: &str, name: &str, names: impl Iterator<Item = &'a str>, offered: impl Iterator<Item = &'a str>) -> String {
    let mut offered: Vec<&str> = offered.collect();
    offered.dedup();
    let near = nearest(name, names).map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
    let known = if offered.is_empty() { String::new() } else { format!("; there are: {}", offered.join(", ")) };
    format!("there is no {kind} `{}`{near}{known}", name.chars().take(60).collect::<String>().escape_debug())
}
