//! A measurement as JSON, and back as far as it takes to repeat it.
//!
//! Schema 1: `{"schema", "scene", "seed", "wall_seconds", "readings": [...], "counters": {...}, "provenance": {...}}`. Everything but
//! the fields named `seconds` and `wall_seconds` is the same for any number of threads. Numbers that are not finite are `null`.
//!
//! `provenance` has all that is needed to repeat the measurement: version, scene file as it was named, hashes of scene and plan, seed,
//! and the options. `rounds` is there when a budget of time may have ended the run: so many rounds of samples make the same readings.

use serde::{Deserialize, Serialize};

use crate::estimate::Stop;
use crate::measurement::{DisplayReading, IdealReading, Measurement, Part, Provenance, Reading};
use crate::scene::Layout;

#[derive(Serialize)]
struct Document<'a> {
    schema: u32,
    scene: &'a str,
    seed: u64,
    wall_seconds: f64,
    readings: Vec<Row<'a>>,
    counters: Counted,
    provenance: Origin,
}

#[derive(Serialize)]
struct Row<'a> {
    instrument: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    index: Option<Index>,
    at: [f64; 3],
    channel: &'a str,
    quantity: &'a str,
    unit: &'a str,
    value: f64,
    standard_uncertainty: f64,
    degrees_of_freedom: Option<f64>,
    coverage_probability: f64,
    coverage_factor: f64,
    expanded_uncertainty: f64,
    samples: u64,
    seconds: f64,
    target_met: bool,
    budget: Vec<Cause<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    readout: Option<Display<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    ideal: Option<Ideal>,
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    notes: &'a [String],
}

/// What the electronics made of it; in the unit of the reading where no other is named.
#[derive(Serialize)]
struct Display<'a> {
    analogue: f64,
    photocurrent_a: f64,
    feedback_ohm: f64,
    voltage_v: f64,
    code: Option<f64>,
    expected: f64,
    standard_deviation: f64,
    one_noisy_reading: f64,
    step: Option<f64>,
    deviations: Vec<Deviated<'a>>,
    saturated: bool,
}

#[derive(Serialize)]
struct Deviated<'a> {
    cause: &'a str,
    value: f64,
}

/// What an ideal instrument would indicate, and why this one differs.
#[derive(Serialize)]
struct Ideal {
    value: f64,
    standard_uncertainty: f64,
    difference: f64,
    parts: Vec<PartOfIt>,
}

#[derive(Serialize)]
struct PartOfIt {
    cause: &'static str,
    value: f64,
    u: f64,
    percent: Option<f64>,
    u_percent: Option<f64>,
}

fn display(d: &DisplayReading) -> Display<'_> {
    Display {
        analogue: d.analogue,
        photocurrent_a: d.photocurrent_a,
        feedback_ohm: d.feedback_ohm,
        voltage_v: d.voltage_v,
        code: d.code,
        expected: d.expected,
        standard_deviation: d.standard_deviation,
        one_noisy_reading: d.one,
        step: d.step,
        deviations: d.deviations.iter().map(|(cause, value)| Deviated { cause: cause.words(), value: *value }).collect(),
        saturated: d.saturation.is_some(),
    }
}

fn ideal(i: &IdealReading) -> Ideal {
    let percent = |x: f64| finite(100.0 * x / i.value);
    let part = |p: &Part| PartOfIt {
        cause: p.cause.words(),
        value: p.value,
        u: p.standard_uncertainty,
        percent: percent(p.value),
        u_percent: finite(100.0 * p.share_uncertainty),
    };
    Ideal {
        value: i.value,
        standard_uncertainty: i.standard_uncertainty,
        difference: i.difference(),
        parts: i.parts.iter().map(part).collect(),
    }
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
enum Index {
    List(usize),
    Grid([usize; 2]),
}

#[derive(Serialize)]
struct Cause<'a> {
    source: &'a str,
    r#type: &'static str,
    u: f64,
    degrees_of_freedom: Option<f64>,
}

#[derive(Serialize)]
struct Counted {
    rays: u64,
    samples: u64,
    bvh_nodes: u64,
    spectral_nodes: u64,
    escaped_paths: u64,
}

#[derive(Serialize, Deserialize)]
struct Origin {
    version: String,
    scene_file: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    root: Option<String>,
    scene_hash: String,
    plan_hash: String,
    options: Options,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    rounds: Vec<u32>,
}

#[derive(Serialize, Deserialize)]
struct Options {
    target: Option<f64>,
    budget_seconds: Option<f64>,
    samples: Option<u64>,
    naive: bool,
    without: Vec<String>,
}

/// Column and row of a pose in a grid.
pub(super) fn grid_index(reading: &Reading) -> Option<[usize; 2]> {
    match reading.layout {
        Layout::Grid { columns, .. } => Some([reading.index % columns, reading.index / columns]),
        Layout::Single | Layout::List => None,
    }
}

fn finite(x: f64) -> Option<f64> {
    x.is_finite().then_some(x)
}

fn row(r: &Reading) -> Row<'_> {
    Row {
        instrument: &r.instrument,
        index: match (r.layout, grid_index(r)) {
            (Layout::Single, _) => None,
            (_, Some(place)) => Some(Index::Grid(place)),
            (_, None) => Some(Index::List(r.index)),
        },
        at: r.at.to_array(),
        channel: &r.channel,
        quantity: r.measurand.name(),
        unit: r.measurand.unit(),
        value: r.value,
        standard_uncertainty: r.standard_uncertainty(),
        degrees_of_freedom: finite(r.expanded.degrees_of_freedom),
        coverage_probability: r.expanded.coverage_probability,
        coverage_factor: r.expanded.coverage_factor,
        expanded_uncertainty: r.expanded.expanded_uncertainty,
        samples: r.samples,
        seconds: r.seconds,
        target_met: r.target_met,
        budget: r
            .budget
            .rows
            .iter()
            .map(|b| Cause {
                source: &b.source,
                r#type: b.kind.letter(),
                u: b.standard_uncertainty,
                degrees_of_freedom: finite(b.degrees_of_freedom),
            })
            .collect(),
        readout: r.readout.as_ref().map(display),
        ideal: r.ideal.as_ref().map(ideal),
        notes: &r.notes,
    }
}

fn origin(p: &Provenance) -> Origin {
    Origin {
        version: p.version.clone(),
        scene_file: p.scene_file.clone(),
        root: p.root.clone(),
        scene_hash: format!("{:016x}", p.scene_hash),
        plan_hash: format!("{:016x}", p.plan_hash),
        options: Options {
            target: p.stop.target,
            budget_seconds: p.stop.budget_seconds,
            samples: p.stop.samples,
            naive: p.naive,
            without: p.without.clone(),
        },
        rounds: p.rounds.clone(),
    }
}

/// The measurement as JSON text, ending in a line break.
#[must_use]
pub fn to_json(measurement: &Measurement) -> String {
    let c = &measurement.counters;
    let document = Document {
        schema: 1,
        scene: &measurement.scene,
        seed: measurement.provenance.seed,
        wall_seconds: measurement.wall_seconds,
        readings: measurement.readings.iter().map(row).collect(),
        counters: Counted {
            rays: c.rays,
            samples: c.samples,
            bvh_nodes: c.bvh_nodes,
            spectral_nodes: c.spectral_nodes,
            escaped_paths: c.escaped_paths,
        },
        provenance: origin(&measurement.provenance),
    };
    // Strings and numbers only: there is nothing that could not be written.
    let mut text = serde_json::to_string_pretty(&document).unwrap_or_default();
    text.push('\n');
    text
}

/// What a file of readings says of them and of how they came about.
#[derive(Clone, Debug, PartialEq)]
pub struct Recorded {
    /// What is needed to repeat the measurement.
    pub provenance: Provenance,
    /// Its readings, in the order of the file.
    pub readings: Vec<RecordedReading>,
}

/// A reading as it stands in a file; numbers that are not finite are `None`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct RecordedReading {
    /// Name of the instrument.
    pub instrument: String,
    /// Which of its poses; column and row in a grid.
    #[serde(default)]
    index: Option<Index>,
    /// Name of the channel.
    pub channel: String,
    /// Unit of the value.
    pub unit: String,
    /// The indication.
    pub value: Option<f64>,
    /// u_c.
    pub standard_uncertainty: Option<f64>,
    /// U at 95 %.
    pub expanded_uncertainty: Option<f64>,
    /// Samples over all jobs and replicates.
    pub samples: u64,
}

#[derive(Deserialize)]
struct ReadDocument {
    schema: u32,
    seed: u64,
    readings: Vec<RecordedReading>,
    provenance: Origin,
}

/// Reads a measurement back as far as it takes to repeat it.
///
/// # Errors
/// What is wrong with the text, with line and column where there are any.
pub fn from_json(text: &str) -> Result<Recorded, String> {
    let document: ReadDocument = serde_json::from_str(text).map_err(|e| e.to_string())?;
    if document.schema != 1 {
        return Err(format!("its schema is {}; this program knows schema 1", document.schema));
    }
    let o = document.provenance;
    let hash = |what: &str, digits: &str| {
        u64::from_str_radix(digits, 16)
            .map_err(|_| format!("`{what}` is `{}`; it should be 16 hexadecimal digits", digits.escape_default()))
    };
    let stop = Stop { target: o.options.target, budget_seconds: o.options.budget_seconds, samples: o.options.samples };
    if stop.budget_seconds.is_some() && o.rounds.is_empty() {
        return Err("a budget of time ended the run, and `rounds` does not say when".to_owned());
    }
    if stop == (Stop { target: None, budget_seconds: None, samples: None }) {
        return Err("`options` has no target, no budget and no samples: nothing would end the run".to_owned());
    }
    if ![stop.target, stop.budget_seconds].into_iter().flatten().all(|x| x > 0.0) || stop.samples == Some(0) {
        return Err("a target, a budget or a number of samples in `options` is not positive".to_owned());
    }
    let provenance = Provenance {
        version: o.version,
        scene_file: o.scene_file,
        root: o.root,
        scene_hash: hash("scene_hash", &o.scene_hash)?,
        plan_hash: hash("plan_hash", &o.plan_hash)?,
        naive: o.options.naive,
        without: o.options.without,
        seed: document.seed,
        stop,
        rounds: o.rounds,
    };
    Ok(Recorded { provenance, readings: document.readings })
}

impl RecordedReading {
    /// Instrument, pose and channel.
    #[must_use]
    pub fn place(&self) -> String {
        let index = match &self.index {
            None => String::new(),
            Some(Index::List(i)) => format!(" [{i}]"),
            Some(Index::Grid([column, row])) => format!(" [{column}, {row}]"),
        };
        format!("{}{index}, {}", self.instrument, self.channel)
    }

    /// Whether it is the same reading with the same bits: value, u and U.
    #[must_use]
    pub fn has_the_bits_of(&self, other: &RecordedReading) -> bool {
        let bits = |r: &RecordedReading| [r.value, r.standard_uncertainty, r.expanded_uncertainty].map(|x| x.map(f64::to_bits));
        (&self.instrument, &self.index, &self.channel, &self.unit) == (&other.instrument, &other.index, &other.channel, &other.unit)
            && bits(self) == bits(other)
    }
}
