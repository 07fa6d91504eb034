//! References: values on the command line, or a file of readings that `measure` wrote.
//!
//! Every reading of the scene must have its value, in its unit; every problem is told.

use crate::report::json::from_json;
use crate::study::converge::{Place, Reference, ReferenceOrigin, ReferenceValue};

/// Problems that are told one by one.
const MOST_TOLD: usize = 8;

/// A reading as a file has it.
struct Given {
    place: String,
    unit: String,
    value: Option<f64>,
    standard_uncertainty: Option<f64>,
}

/// Values in the order of the readings, such as `6.2225`, or `6.2225±0.0005` (also `+-`) with a standard uncertainty.
///
/// # Errors
/// Everything that is no number, and a wrong count.
pub fn reference_from_values(text: &str, places: &[Place]) -> Result<Reference, String> {
    let mut values = Vec::new();
    let mut wrong = Vec::new();
    for (i, part) in text.split(',').enumerate() {
        let (value, u) = match part.split_once('±').or_else(|| part.split_once("+-")) {
            Some((value, u)) => (value, Some(u)),
            None => (part, None),
        };
        let number = |text: &str| text.trim().parse::<f64>().ok().filter(|x| x.is_finite());
        match (number(value), u.map(|u| number(u).filter(|u| *u >= 0.0))) {
            (Some(value), None) => values.push(ReferenceValue { value, standard_uncertainty: None }),
            (Some(value), Some(Some(u))) => values.push(ReferenceValue { value, standard_uncertainty: Some(u) }),
            _ => wrong.push(format!("value {} is `{}`, which is no number", i + 1, part.trim())),
        }
    }
    if wrong.is_empty() && values.len() != places.len() {
        wrong.push(format!("{}, and the scene has {}", counted(values.len(), "value"), counted(places.len(), "reading")));
        wrong.extend(places.iter().take(MOST_TOLD).map(|p| format!("  {} in {}", p.in_words(), p.unit)));
        if places.len() > MOST_TOLD {
            wrong.push(format!("  … and {} more; a file of readings names each", places.len() - MOST_TOLD));
        }
    }
    match wrong.is_empty() {
        true => Ok(Reference { origin: ReferenceOrigin::Given("values as given".to_owned()), values }),
        false => Err(told(&wrong)),
    }
}

/// The readings of a file that `measure --format json` wrote for the scene with this hash.
///
/// # Errors
/// When the file is not one, is of another scene, or lacks a reading.
pub fn reference_from_json(text: &str, name: &str, scene_hash: u64, places: &[Place]) -> Result<Reference, String> {
    let recorded = from_json(text)?;
    if recorded.provenance.scene_hash != scene_hash {
        return Err(format!(
            "it is of another scene: the hash of its files is {:016x}, that of this scene {scene_hash:016x}",
            recorded.provenance.scene_hash
        ));
    }
    let given = recorded.readings.iter().map(|r| Given {
        place: r.place(),
        unit: r.unit.clone(),
        value: r.value,
        standard_uncertainty: r.standard_uncertainty,
    });
    matched(given.collect(), name, places)
}

/// The readings of a file that `measure --format csv` wrote; needs the columns `instrument`, `channel`, `unit` and `value`, and takes
/// `index`, `column`, `row` and `standard_uncertainty` where they are.
///
/// # Errors
/// Everything that is wrong with the file, and readings that it lacks.
pub fn reference_from_csv(text: &str, name: &str, places: &[Place]) -> Result<Reference, String> {
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).comment(Some(b'#')).from_reader(text.as_bytes());
    let header = reader.headers().map_err(|e| e.to_string())?.clone();
    let column = |name: &str| header.iter().position(|h| h == name);
    let needed = ["instrument", "channel", "unit", "value"];
    let missing: Vec<&str> = needed.into_iter().filter(|name| column(name).is_none()).collect();
    if !missing.is_empty() {
        let found: Vec<&str> = header.iter().take(MOST_TOLD).collect();
        return Err(format!("it has no column {}; found are {}", missing.join(", "), found.join(", ")));
    }
    let known: std::collections::BTreeSet<String> = places.iter().map(Place::in_words).collect();
    let mut given = Vec::new();
    let mut wrong = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|e| e.to_string())?;
        let line = record.position().map_or(0, csv::Position::line);
        let field = |name: &str| column(name).and_then(|c| record.get(c)).unwrap_or_default();
        let number = |name: &str| match field(name) {
            "" => Ok(None),
            text => match text.parse::<f64>() {
                Ok(x) => Ok(Some(x).filter(|x| x.is_finite())),
                Err(_) => Err(format!("line {line}: `{name}` is `{text}`, which is no number")),
            },
        };
        let [value, u] = ["value", "standard_uncertainty"].map(number);
        wrong.extend([&value, &u].into_iter().filter_map(|x| x.as_ref().err().cloned()));
        // As a place says it; the index of a single pose, 0, is not written there.
        let (instrument, channel) = (field("instrument"), field("channel"));
        let place = match (field("column"), field("row"), field("index")) {
            ("", _, "") => format!("{instrument}, {channel}"),
            ("", _, index) => {
                let single = format!("{instrument}, {channel}");
                if known.contains(&single) { single } else { format!("{instrument} [{index}], {channel}") }
            }
            (column, row, _) => format!("{instrument} [{column}, {row}], {channel}"),
        };
        given.push(Given {
            place,
            unit: field("unit").to_owned(),
            value: value.unwrap_or_default(),
            standard_uncertainty: u.unwrap_or_default(),
        });
    }
    if !wrong.is_empty() {
        return Err(told(&wrong));
    }
    matched(given, name, places)
}

/// Puts readings into the order of the scene.
fn matched(given: Vec<Given>, name: &str, places: &[Place]) -> Result<Reference, String> {
    let mut by_place = std::collections::BTreeMap::new();
    let mut wrong = Vec::new();
    for reading in &given {
        if by_place.insert(reading.place.clone(), reading).is_some() {
            wrong.push(format!("`{}` stands in it twice", reading.place));
        }
    }
    let mut values = Vec::with_capacity(places.len());
    for place in places {
        let Some(found) = by_place.remove(&place.in_words()) else {
            wrong.push(format!("it has no reading of `{}`", place.in_words()));
            continue;
        };
        match found.value {
            _ if found.unit != place.unit => {
                wrong.push(format!("`{}` is in {} there, in {} here", place.in_words(), found.unit, place.unit));
            }
            None => wrong.push(format!("`{}` has no finite value", place.in_words())),
            Some(value) => values.push(ReferenceValue { value, standard_uncertainty: found.standard_uncertainty }),
        }
    }
    wrong.extend(by_place.keys().map(|place| format!("the scene has no reading `{place}`")));
    match wrong.is_empty() {
        true => Ok(Reference { origin: ReferenceOrigin::Given(name.to_owned()), values }),
        false => Err(told(&wrong)),
    }
}

fn counted(n: usize, what: &str) -> String {
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}

fn told(wrong: &[String]) -> String {
    let mut lines: Vec<String> = wrong.iter().take(2 * MOST_TOLD).cloned().collect();
    if wrong.len() > lines.len() {
        lines.push(format!("… and {} more", wrong.len() - lines.len()));
    }
    lines.join("\n  ")
}
