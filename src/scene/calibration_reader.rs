//! Calibration files → campaigns.
//!
//! ```ron
//! Calibration(
//!     title: "Lux-meter head on a monochromator bench",
//!     bench: "bench.ron",
//!     exposures: [Monochromator(from_nm: 380, to_nm: 780, step_nm: 5, fwhm_nm: 5)],
//!     noise: (relative: 0.002, absolute: 1e-4),
//!     curve: (from_nm: 380, to_nm: 780, step_nm: 1),
//! )
//! ```
//!
//! | key | meaning |
//! |---|---|
//! | `bench` | a scene file with one source and one instrument; that instrument's sensor is the truth when readings are simulated |
//! | `sensor` | a sensor file to stand in place of the bench's own |
//! | `test_surface` | the surface of the bench that takes the reflectances of a chart |
//! | `exposures`, `candidates` | what is put in front of the sensor, and what could be (`exposure_reader.rs`) |
//! | `noise` | `relative`, a share of the reading; `absolute` and `dark` in the unit of the reading |
//! | `repeats` | readings of each exposure, averaged; 1 |
//! | `scale_uncertainty` | relative standard uncertainty of the irradiance, common to all readings; 0 |
//! | `reference` | a detector of known responsivity that measures the light (`substitution_reader.rs`) |
//! | `curve` | nodes of the fitted curve |
//! | `model` | what the curve is taken to be (`curve_model_reader.rs`); any smooth curve |
//! | `lamps` | for which the reading with the fitted curve is propagated; `["A", "D65"]` |

use std::collections::BTreeSet;

use super::Scene;
use super::calibration::{Calibration, CurveModel, Exposure, Noise};
use super::curve_model_reader::read_curve_model;
use super::decode::{Fields, Value};
use super::diagnostic::{Diagnostic, Diagnostics};
use super::document::{Document, Kind};
use super::exposure_reader::{Bench, MOST_EXPOSURES, read_exposures};
use super::files::{Files, normalised, root_of, within};
use super::reader::read_scene_document;
use super::reading::Reading;
use super::sensor_reader::read_sensor;
use super::spectrum_reader::read_spectrum;
use super::substitution_reader::read_reference;
use crate::naming::suggestion;
use crate::spectrum::{Density, library};

const KEYS: [&str; 13] = [
    "title",
    "bench",
    "sensor",
    "test_surface",
    "exposures",
    "candidates",
    "noise",
    "repeats",
    "scale_uncertainty",
    "reference",
    "curve",
    "model",
    "lamps",
];
/// Most nodes of a curve: its covariance has the square of that, and a fit takes some of its cube; 801 nodes take several seconds.
const MOST_NODES: f64 = 801.0;

/// Reads a calibration file and all files that it mentions; `root` as for a scene.
///
/// # Errors
/// Every problem of every file, at least one.
pub fn read_calibration(path: &str, files: &dyn Files, root: Option<&str>) -> Result<Calibration, Diagnostics> {
    let path = normalised(path);
    let root = root.map_or_else(|| root_of(&path), normalised);
    if !within(&path, &root) {
        let help = "give the file and the root both as relative or both as absolute paths, the file inside the root".to_owned();
        return Err(Diagnostics(vec![Diagnostic::of_file(&path, format!("the file lies outside of the root `{root}`"), Some(help))]));
    }
    let mut reading = Reading::new(files, &path, root);
    let document = reading.first_document(&path, "calibration file");
    let found = document.and_then(|document| read_document(&document, &mut reading));
    match found {
        Some(found) if reading.problems.count() == 0 => Ok(found),
        _ => Err(reading.problems.finish()),
    }
}

fn read_document(document: &Document, reading: &mut Reading) -> Option<Calibration> {
    let root = Value::root(document);
    if root.name() != "Calibration" {
        let found = root.described();
        root.problem_at(
            &root.name_span(),
            &mut reading.problems,
            format!("a calibration file holds `Calibration(…)`, not {found}"),
            "write `Calibration(bench: \"bench.ron\", exposures: […], noise: (…), curve: (…))`; scenes are read by `etendue measure`",
        );
        return None;
    }
    let fields = root.fields("`Calibration`", &KEYS, &mut reading.problems)?;
    let file = document.file.rsplit('/').next().unwrap_or_default();
    let title = fields.get("title").map_or(Some(file), |title| title.text(&mut reading.problems));
    let bench = fields.require("bench", "\"bench.ron\"", &mut reading.problems).and_then(|v| read_bench(&v, &fields, reading));
    let noise = fields.require("noise", "(relative: 0.002)", &mut reading.problems).and_then(|v| read_noise(&v, reading));
    let nodes = fields.require("curve", "(from_nm: 380, to_nm: 780, step_nm: 5)", &mut reading.problems);
    let nodes_nm = nodes.as_ref().and_then(|v| read_nodes(v, reading));
    let range_nm = nodes_nm.as_ref().map_or((0.0, f64::INFINITY), |nodes| (nodes[0], nodes[nodes.len() - 1]));
    let model = fields.get("model").map_or(Some(CurveModel::Smooth), |v| read_curve_model(&v, range_nm, reading));
    let number = |key: &str, otherwise: f64, allowed: &str, holds: fn(f64) -> bool, reading: &mut Reading| match fields.get(key) {
        None => Some(otherwise),
        Some(given) => given.number_in(&format!("`{key}`"), allowed, holds, &mut reading.problems),
    };
    let repeats = number("repeats", 1.0, "whole numbers, 1 to 1e6", |x| x.fract() == 0.0 && (1.0..=1e6).contains(&x), reading);
    let scale = number("scale_uncertainty", 0.0, "0 to 1, a share", |x| (0.0..=1.0).contains(&x), reading);
    let lamps = read_lamps(fields.get("lamps"), reading);
    let reference = read_reference(&fields, reading);
    let (bench, test_surface) = bench?;
    let offer =
        Bench { power: bench.sources[0].density.total(), poses: bench.instruments[0].poses.len(), test_surface: test_surface.is_some() };
    let exposures = read_list(&fields, "exposures", &offer, reading);
    let candidates = match fields.get("candidates") {
        None => Some(Vec::new()),
        Some(_) => read_list(&fields, "candidates", &offer, reading),
    };
    let (exposures, nodes_nm) = (exposures?, nodes_nm?);
    check_overlap(&fields, &exposures, &nodes_nm, reading);
    Some(Calibration {
        title: title?.to_owned(),
        remarks: bench.remarks.clone(),
        bench,
        test_surface,
        exposures,
        candidates: candidates?,
        noise: noise?,
        repeats: repeats? as u32,
        scale_uncertainty: scale?,
        reference: reference?,
        model: model?,
        nodes_nm,
        lamps: lamps?,
        hash: reading.hash,
    })
}

/// The bench, with the sensor that is to stand in it, and the index of its test surface.
fn read_bench(value: &Value, fields: &Fields, reading: &mut Reading) -> Option<(Scene, Option<usize>)> {
    let name = value.text(&mut reading.problems)?;
    let path = reading.path(value, name)?;
    let document = reading.document(value, &path, "scene file")?;
    let before = reading.problems.count();
    let mut scene = read_scene_document(&document, reading)?;
    if reading.problems.count() > before {
        return None;
    }
    if let Some(sensor) = fields.get("sensor") {
        let sensor = read_sensor(&sensor, reading)?;
        scene.instruments.iter_mut().for_each(|instrument| instrument.sensor = sensor.clone());
    }
    let mut one = |count: usize, what: &str| {
        if count != 1 {
            let message = format!("a bench has one {what}, and `{path}` has {count}");
            value.problem(&mut reading.problems, message, format!("keep one {what} in that scene: its spectrum or sensor is exchanged"));
        }
        count == 1
    };
    if !(one(scene.sources.len(), "source") & one(scene.instruments.len(), "instrument")) {
        return None;
    }
    let test_surface = match fields.get("test_surface") {
        None => None,
        Some(given) => {
            let name = given.text(&mut reading.problems)?;
            let found = scene.surfaces.iter().position(|surface| surface.name == name);
            if found.is_none() {
                let names: Vec<&str> = scene.surfaces.iter().skip(1).map(|s| s.name.as_str()).collect();
                given.problem(&mut reading.problems, format!("the bench has no surface called \"{name}\""), suggestion(name, &names));
                return None;
            }
            found
        }
    };
    if let (Some(test), Some(other)) =
        (test_surface, scene.surfaces.iter().enumerate().find(|(i, s)| Some(*i) != test_surface && !s.is_black()))
    {
        let message = format!("besides the test surface \"{}\" the bench reflects: \"{}\"", scene.surfaces[test].name, other.1.name);
        let help = "make every other surface of the bench black: a chart is measured by the light of the lamp alone";
        value.problem(&mut reading.problems, message, help);
        return None;
    }
    Some((scene, test_surface))
}

fn read_list(fields: &Fields, key: &str, bench: &Bench, reading: &mut Reading) -> Option<Vec<Exposure>> {
    let example = "[Monochromator(from_nm: 380, to_nm: 780, step_nm: 5, fwhm_nm: 5)]";
    let value = fields.require(key, example, &mut reading.problems)?;
    let items = value.list(&format!("`{key}`"), &mut reading.problems)?;
    let found: Vec<Option<Vec<Exposure>>> = items.iter().map(|item| read_exposures(item, bench, reading)).collect();
    let found = found.into_iter().collect::<Option<Vec<Vec<Exposure>>>>()?;
    check_labels(&items, &found, reading)?;
    let found: Vec<Exposure> = found.into_iter().flatten().collect();
    if found.is_empty() || found.len() > MOST_EXPOSURES {
        let message = format!("`{key}` holds {} exposures", found.len());
        value.problem(&mut reading.problems, message, format!("allowed: 1 to {MOST_EXPOSURES}; for example `{key}: {example}`"));
        return None;
    }
    Some(found)
}

/// Readings are found by the labels of their exposures, so each has one of its own.
fn check_labels(items: &[Value], found: &[Vec<Exposure>], reading: &mut Reading) -> Option<()> {
    let mut seen: BTreeSet<&str> = BTreeSet::new();
    let mut all_differ = Some(());
    for (item, exposures) in items.iter().zip(found) {
        let again: Vec<&str> = exposures.iter().map(|e| e.label.as_str()).filter(|label| !seen.insert(label)).collect();
        if let [first, ..] = again.as_slice() {
            let more = if again.len() > 1 { format!(" and {} others are", again.len() - 1) } else { " is".to_owned() };
            let message = format!("the exposure \"{first}\"{more} there twice");
            let help = "give each a name of its own: `labels: [\"first\", \"second\"]`; for readings that are averaged write `repeats`";
            item.problem_at(&item.name_span(), &mut reading.problems, message, help);
            all_differ = None;
        }
    }
    all_differ
}

pub(super) fn read_noise(value: &Value, reading: &mut Reading) -> Option<Noise> {
    let before = reading.problems.count();
    let fields = value.fields("the noise", &["relative", "absolute", "dark"], &mut reading.problems)?;
    let problems = &mut reading.problems;
    let mut number = |key: &str, allowed: &str, most: f64| match fields.get(key) {
        None => Some(None),
        Some(given) => given.number_in(&format!("`{key}`"), allowed, |x| (0.0..=most).contains(&x), problems).map(Some),
    };
    let (relative, absolute) = (number("relative", "0 to 1, a share of the reading", 1.0), number("absolute", "0 and above", f64::MAX));
    let dark = match fields.get("dark") {
        None => Some(None),
        Some(given) => given.number(&mut reading.problems).map(Some),
    };
    let (relative, absolute) = (relative?, absolute?);
    // A key that is misspelt is told already.
    if reading.problems.count() > before {
        return None;
    }
    if relative.is_none() && absolute.is_none() {
        value.problem(
            &mut reading.problems,
            "the noise is not stated",
            "write `(relative: 0.002, absolute: 1e-6)`; 0 for readings without noise",
        );
        return None;
    }
    Some(Noise { relative: relative.unwrap_or(0.0), absolute: absolute.unwrap_or(0.0), dark: dark? })
}

fn read_nodes(value: &Value, reading: &mut Reading) -> Option<Vec<f64>> {
    let fields = value.fields("the curve", &["from_nm", "to_nm", "step_nm"], &mut reading.problems)?;
    let mut number = |key: &str, example: &str| {
        let given = fields.require(key, example, &mut reading.problems)?;
        given.number_in(&format!("`{key}`"), "above 0, in nm", |x| x > 0.0, &mut reading.problems)
    };
    let (from, to, step) = (number("from_nm", "380"), number("to_nm", "780"), number("step_nm", "5"));
    let (from, to, step) = (from?, to?, step?);
    let count = ((to - from) / step + 1e-9).floor() + 1.0;
    if !(2.0..=MOST_NODES).contains(&count) {
        value.problem(
            &mut reading.problems,
            format!("the curve has {} nodes: {from} nm to {to} nm in steps of {step} nm", count.max(0.0)),
            format!("allowed: 2 to {MOST_NODES} nodes, `from_nm` below `to_nm`"),
        );
        return None;
    }
    Some((0..count as usize).map(|i| from + step * i as f64).collect())
}

fn read_lamps(value: Option<Value>, reading: &mut Reading) -> Option<Vec<(String, Density)>> {
    let Some(value) = value else {
        return ["A", "D65"].into_iter().map(|name| Some((name.to_owned(), library::density(name).ok()?))).collect();
    };
    let items = value.list("lamps", &mut reading.problems)?;
    let found: Vec<Option<(String, Density)>> = items
        .iter()
        .map(|item| {
            let density = read_spectrum(item, reading)?;
            let name = match &item.node.kind {
                Kind::Text(name) => name.clone(),
                _ => item.document.slice(&item.node.span).to_owned(),
            };
            Some((name, density))
        })
        .collect();
    found.into_iter().collect()
}

/// Exposures that have no light where the curve is sought say nothing about it.
fn check_overlap(fields: &Fields, exposures: &[Exposure], nodes_nm: &[f64], reading: &mut Reading) {
    let (Some(&from), Some(&to), Some(value)) = (nodes_nm.first(), nodes_nm.last(), fields.get("exposures")) else { return };
    let sees = |exposure: &Exposure| {
        exposure.emitted.support().intervals().iter().any(|&(low, high)| low <= to && high >= from)
            && exposure.patch.as_ref().is_none_or(|patch| patch.support().intervals().iter().any(|&(low, high)| low <= to && high >= from))
    };
    let blind: Vec<&str> = exposures.iter().filter(|e| !sees(e)).map(|e| e.label.as_str()).collect();
    if let [first, ..] = blind.as_slice() {
        let more = if blind.len() > 1 { format!(" and {} more", blind.len() - 1) } else { String::new() };
        value.problem(
            &mut reading.problems,
            format!("the exposure \"{first}\"{more} has no light within the curve, {from} nm to {to} nm"),
            "widen `curve`, or leave the exposure out",
        );
    }
}
