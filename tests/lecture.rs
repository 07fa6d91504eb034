//! The lecture: the table of `scenes/lecture/README.md` is run row by row, scenes and commands alike.
//!
//! | what | how |
//! |---|---|
//! | expected | the result rounds to the number that the table prints |
//! | closed form | evaluated here from its text; the result agrees to 1e-9 |
//! | completeness | every scene of the folder and every equation of the library has a row |
//! | naive plans | agree with the planned reading within six joint standard uncertainties |

#![allow(clippy::unwrap_used)]

#[path = "lecture/closed_form.rs"]
mod closed_form;
mod disk;

use std::collections::BTreeMap;
use std::process::Command;

use closed_form::evaluate;
use disk::{Repository, files_in, root};
use etendue::estimate::{Stop, Watch};
use etendue::lecture;
use etendue::measurement::{Measurement, measure};
use etendue::plan::{Plan, PlanOptions};
use etendue::scene::read_scene;

const CLOSED_FORM: f64 = 1e-9;
const NAIVE_SAMPLES: u64 = 4096;
const JOINT_UNCERTAINTIES: f64 = 6.0;

struct Row {
    run: String,
    reading: String,
    closed_form: String,
    expected: String,
    unit: String,
}

fn unquoted(cell: &str) -> Option<&str> {
    cell.strip_prefix('`')?.strip_suffix('`')
}

fn rows() -> Vec<Row> {
    let text = std::fs::read_to_string(root().join("scenes/lecture/README.md")).unwrap();
    let table = text.lines().skip_while(|line| !line.starts_with("|---")).skip(1).take_while(|line| line.starts_with('|'));
    let rows: Vec<Row> = table
        .map(|line| {
            // A bar within a formula is written `\|`.
            let line = line.replace("\\|", "∣");
            let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
            let [_, run, reading, closed_form, expected, unit] = cells[..] else { panic!("six columns: {line}") };
            let [run, reading, closed_form, expected, unit] = [run, reading, closed_form, expected, unit].map(str::to_owned);
            Row { run: unquoted(&run).unwrap_or_else(|| panic!("{run} is not in quotes")).to_owned(), reading, closed_form, expected, unit }
        })
        .collect();
    assert!(rows.len() >= 50, "{}", rows.len());
    rows
}

fn planned(file: &str, naive: bool, stop: &Stop, seed: u64) -> Measurement {
    let scene = read_scene(&format!("scenes/lecture/{file}"), &Repository, None).unwrap_or_else(|problems| panic!("{problems}"));
    let plan = Plan::new(&scene, &PlanOptions { naive, without: Vec::new() }).unwrap();
    measure(&scene, &plan, stop, seed, &Watch { now: &|| 0.0, progress: &|_| {} }).unwrap()
}

/// Value and unit of "meter [1] E_v" or "sum of face Φ_e".
fn of_scene(measured: &Measurement, reading: &str) -> (f64, String) {
    let (instrument, channel) = reading.rsplit_once(' ').unwrap();
    let (name, index) = match instrument.strip_prefix("sum of ") {
        Some(name) => (name, None),
        None => {
            let (name, index) = instrument.strip_suffix(']').and_then(|i| i.split_once(" [")).unwrap_or_else(|| panic!("{reading}"));
            (name, Some(index.parse::<usize>().unwrap()))
        }
    };
    let chosen = |r: &&etendue::measurement::Reading| r.instrument == name && r.channel == channel && index.is_none_or(|i| r.index == i);
    let found: Vec<_> = measured.readings.iter().filter(chosen).collect();
    assert!(!found.is_empty() && (index.is_none() || found.len() == 1), "{} readings of {reading}", found.len());
    (found.iter().map(|r| r.value).sum(), found[0].measurand.unit().to_owned())
}

/// Value and unit of what the program prints.
fn of_command(run: &str) -> (f64, String) {
    let mut words = run.split_whitespace();
    assert_eq!(words.next(), Some("etendue"));
    let output = Command::new(env!("CARGO_BIN_EXE_etendue")).args(words).args(["--format", "json"]).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{run}: {}", String::from_utf8_lossy(&output.stderr));
    assert!(output.stderr.is_empty(), "{run}");
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    (json["result"]["value"].as_f64().unwrap(), json["result"]["unit"].as_str().unwrap().to_owned())
}

/// Half a unit in the last place of a printed number.
fn half_a_digit(printed: &str) -> f64 {
    let (mantissa, exponent) = printed.split_once('e').map_or((printed, 0), |(m, e)| (m, e.parse().unwrap()));
    let decimals = mantissa.split_once('.').map_or(0, |(_, d)| d.len() as i32);
    0.5 * 10f64.powi(exponent - decimals)
}

#[test]
fn every_row_of_the_table_is_true() {
    let mut measured: BTreeMap<String, Measurement> = BTreeMap::new();
    let mut wrong = Vec::new();
    for row in rows() {
        let (value, unit) = if row.run.ends_with(".ron") {
            let stop = Stop { target: None, budget_seconds: None, samples: Some(1024) };
            let m = measured.entry(row.run.clone()).or_insert_with(|| planned(&row.run, false, &stop, 7));
            of_scene(m, &row.reading)
        } else {
            of_command(&row.run)
        };
        let expected: f64 = row.expected.parse().unwrap_or_else(|_| panic!("{} is no number", row.expected));
        if (value - expected).abs() > 1.001 * half_a_digit(&row.expected) || unit != row.unit {
            wrong.push(format!("{} {}: {value} {unit} instead of {} {}", row.run, row.reading, row.expected, row.unit));
        }
        if let Some(text) = unquoted(&row.closed_form) {
            let closed = evaluate(text).unwrap_or_else(|why| panic!("{text}: {why}"));
            if (value / closed - 1.0).abs() > CLOSED_FORM {
                wrong.push(format!("{} {}: {value} instead of {closed} = {text}", row.run, row.reading));
            }
        }
    }
    for (file, m) in &measured {
        assert_eq!(m.counters.samples, 0, "{file}: a lesson with a closed form is measured by it");
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_scene_and_every_equation_has_a_row() {
    let rows = rows();
    for file in files_in("scenes/lecture", &[".ron"]) {
        assert!(rows.iter().any(|row| row.run == file), "{file} is not in the table");
        let text = std::fs::read_to_string(root().join("scenes/lecture").join(&file)).unwrap();
        let run = format!("Run: etendue measure scenes/lecture/{file}");
        for part in ["What it shows:", "Closed form", "Expected:", run.as_str()] {
            assert!(text.contains(part), "{file}: the header has no `{part}`");
        }
    }
    for equation in lecture::equations() {
        let called = |row: &Row| row.run.split_whitespace().skip(1).take(2).eq(["equation", equation.name]);
        assert!(rows.iter().any(called), "{} is not in the table", equation.name);
    }
}

#[test]
fn naive_plans_agree_with_the_closed_forms() {
    let mut wrong = Vec::new();
    for file in files_in("scenes/lecture", &[".ron"]) {
        let stop = Stop { target: None, budget_seconds: None, samples: Some(NAIVE_SAMPLES) };
        let (exact, naive) = (planned(&file, false, &stop, 1), planned(&file, true, &stop, 2));
        assert_eq!(exact.readings.len(), naive.readings.len());
        for (e, n) in exact.readings.iter().zip(&naive.readings) {
            let u = e.standard_uncertainty().hypot(n.standard_uncertainty());
            if (e.value - n.value).abs() > JOINT_UNCERTAINTIES * u {
                wrong.push(format!("{file}: {} [{}] {}: {} planned, {} ± {u} naive", e.instrument, e.index, e.channel, e.value, n.value));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

fn etendue(arguments: &[&str]) -> (i32, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_etendue")).args(arguments).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

#[test]
fn the_command_lists_computes_and_refuses() {
    let (code, list, _) = etendue(&["equation"]);
    assert_eq!(code, 0);
    for equation in lecture::equations() {
        assert!(list.contains(equation.name) && list.contains(equation.formula), "{}", equation.name);
    }
    let (code, table, _) = etendue(&["equation", "--table"]);
    assert_eq!(code, 0);
    for words in ["talbot", "melanopic irradiance", "E_mel", "scotopic luminous flux", "µmol/(m² s)", "candela per square metre"] {
        assert!(table.contains(words), "no `{words}` in\n{table}");
    }
    let (code, text, _) = etendue(&["equation", "photon-energy", "wavelength_nm=555"]);
    assert_eq!(code, 0);
    for words in ["Q = h c / λ", "555 nm", "3.579181725e-19 J", "2.233949", "eV"] {
        assert!(text.contains(words), "no `{words}` in\n{text}");
    }
    for (arguments, said) in [
        (&["equation", "foton-energy"][..], "did you mean `photon-energy`"),
        (&["equation", "photon-energy"], "`wavelength_nm` is missing"),
        (&["equation", "photon-energy", "wavelenght_nm=555"], "did you mean `wavelength_nm`"),
        (&["equation", "photon-energy", "555"], "KEY=VALUE"),
        (&["equation", "photon-energy", "wavelength_nm=-555"], "allowed: finite and above 0"),
        (&["equation", "photon-energy", "wavelength_nm=NaN"], "allowed: finite and above 0"),
        (&["equation", "photon-energy", "wavelength_nm=555", "wavelength_nm=556"], "given twice"),
        (&["equation", "flux-from-power", "efficiency=1.1", "power_w=60"], "allowed: 0 to 1"),
        (&["equation", "radiance-to-luminance", "radiance_w_m2_sr=1", "spectrum=D56"], "D5"),
    ] {
        let (code, out, err) = etendue(arguments);
        assert_eq!((code, out.as_str()), (2, ""), "{arguments:?}: {err}");
        assert!(err.contains(said), "{arguments:?}: no `{said}` in\n{err}");
    }
}
