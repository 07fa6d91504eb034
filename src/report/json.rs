//! A measurement as JSON.
//!
//! Schema 1: `{"schema", "scene", "seed", "wall_seconds", "readings": [...], "counters": {...}, "provenance": {...}}`. Everything but
//! the fields named `…seconds` is the same for any number of threads. Numbers that are not finite are `null`.

use serde::Serialize;

use crate::measurement::{Measurement, Reading};
use crate::scene::Layout;

#[derive(Serialize)]
struct Document<'a> {
    schema: u32,
    scene: &'a str,
    seed: u64,
    wall_seconds: f64,
    readings: Vec<Row<'a>>,
    counters: Counted,
    provenance: Origin<'a>,
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
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    notes: &'a [String],
}

#[derive(Serialize)]
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

#[derive(Serialize)]
struct Origin<'a> {
    version: &'a str,
    scene_hash: String,
    plan_hash: String,
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
        notes: &r.notes,
    }
}

/// The measurement as JSON text, ending in a line break.
#[must_use]
pub fn to_json(measurement: &Measurement) -> String {
    let c = &measurement.counters;
    let document = Document {
        schema: 1,
        scene: &measurement.scene,
        seed: measurement.seed,
        wall_seconds: measurement.wall_seconds,
        readings: measurement.readings.iter().map(row).collect(),
        counters: Counted {
            rays: c.rays,
            samples: c.samples,
            bvh_nodes: c.bvh_nodes,
            spectral_nodes: c.spectral_nodes,
            escaped_paths: c.escaped_paths,
        },
        provenance: Origin {
            version: measurement.provenance.version,
            scene_hash: format!("{:016x}", measurement.provenance.scene_hash),
            plan_hash: format!("{:016x}", measurement.provenance.plan_hash),
        },
    };
    // Strings and numbers only: there is nothing that could not be written.
    let mut text = serde_json::to_string_pretty(&document).unwrap_or_default();
    text.push('\n');
    text
}
