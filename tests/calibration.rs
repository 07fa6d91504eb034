//! Responsivity curves fitted to the problems of `tests/calibration/`: monochromator scans, broad sources up to a condition of 1e12, a
//! camera before a chart. Truths, readings and baselines come from another program; `baselines.json` says how they were made.

#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod disk;

use std::fs;
use std::path::PathBuf;

use disk::root;
use etendue::calibration::{Exposures, FitOptions, Fitted, PriorKind, Readings, fit};
use etendue::spectrum::{Density, Outside, Table};

/// Rows of a CSV file, with its head.
fn rows(path: &str) -> (Vec<String>, Vec<Vec<String>>) {
    let text = fs::read_to_string(root().join("tests/calibration").join(path)).unwrap();
    let mut lines = text.lines().map(|l| l.split(',').map(str::to_owned).collect::<Vec<_>>());
    (lines.next().unwrap(), lines.collect())
}

fn numbers(path: &str) -> (Vec<String>, Vec<Vec<f64>>) {
    let (head, rows) = rows(path);
    (head, rows.into_iter().map(|r| r.iter().map(|x| x.parse().unwrap()).collect()).collect())
}

fn column(rows: &[Vec<f64>], k: usize) -> Vec<f64> {
    rows.iter().map(|r| r[k]).collect()
}

struct Problem {
    exposures: Exposures,
    readings: Vec<Readings>,
    truths: Vec<Vec<f64>>,
    evaluated: Vec<bool>,
    prior: PriorKind,
}

fn triangle(centre_nm: f64, fwhm_nm: f64) -> Density {
    let rows = [(centre_nm - fwhm_nm, 0.0), (centre_nm, 1.0 / fwhm_nm), (centre_nm + fwhm_nm, 0.0)];
    Density::table(Table::from_rows(&rows, Outside::Zero).unwrap()).unwrap()
}

fn problem(id: &str) -> Problem {
    if id.starts_with("mono") {
        let (_, truth) = numbers(&format!("{id}/truth.csv"));
        let (_, measured) = numbers(&format!("{id}/measurements.csv"));
        let nodes = column(&truth, 0);
        let spectra: Vec<(String, Density)> = measured.iter().map(|r| (format!("{} nm", r[0]), triangle(r[0], r[1]))).collect();
        return Problem {
            exposures: Exposures::new(&nodes, &spectra).unwrap(),
            readings: vec![Readings { channel: "R".into(), values: column(&measured, 2), standard_uncertainties: column(&measured, 3) }],
            truths: vec![column(&truth, 1)],
            evaluated: nodes.iter().map(|nm| (390.0..=770.0).contains(nm)).collect(),
            prior: PriorKind::Smooth,
        };
    }
    if let Some((folder, noise)) = id.strip_prefix("broad").and_then(|_| id.rsplit_once("_noise")) {
        let (_, truth) = numbers(&format!("{folder}/truth.csv"));
        let (_, matrix) = numbers(&format!("{folder}/matrix.csv"));
        let (_, readings) = numbers(&format!("{folder}/readings_noise{noise}.csv"));
        let nodes = column(&truth, 0);
        let labels = matrix.iter().map(|r| format!("source at {} nm", r[0])).collect();
        let weights: Vec<&[f64]> = matrix.iter().map(|r| &r[1..]).collect();
        return Problem {
            exposures: Exposures::from_weights(&nodes, labels, &weights),
            readings: vec![Readings { channel: "R".into(), values: column(&readings, 0), standard_uncertainties: column(&readings, 1) }],
            truths: vec![column(&truth, 1)],
            evaluated: vec![true; nodes.len()],
            prior: PriorKind::Smooth,
        };
    }
    let of = id.strip_prefix("camera_nikon_").unwrap();
    let (names, illuminants) = numbers("camera_nikon/illuminants.csv");
    let (_, reflectances) = numbers("camera_nikon/reflectances.csv");
    let (_, truth) = numbers("camera_nikon/truth.csv");
    let (_, measured) = rows(&format!("camera_nikon/readings_{of}.csv"));
    let nodes = column(&truth, 0);
    let weights: Vec<Vec<f64>> = measured
        .iter()
        .map(|r| {
            let (lamp, patch) = (names.iter().position(|n| *n == r[0]).unwrap(), r[1].parse::<usize>().unwrap());
            (0..nodes.len()).map(|k| 5.0 * illuminants[k][lamp] * reflectances[k][patch]).collect()
        })
        .collect();
    let weights: Vec<&[f64]> = weights.iter().map(Vec::as_slice).collect();
    let number = |r: &[String], k: usize| r[k].parse::<f64>().unwrap();
    Problem {
        exposures: Exposures::from_weights(&nodes, measured.iter().map(|r| format!("patch {} under {}", r[1], r[0])).collect(), &weights),
        readings: (0..3)
            .map(|c| Readings {
                channel: ["R", "G", "B"][c].into(),
                values: measured.iter().map(|r| number(r, 2 + c)).collect(),
                standard_uncertainties: measured.iter().map(|r| number(r, 5)).collect(),
            })
            .collect(),
        truths: (0..3).map(|c| column(&truth, 1 + c)).collect(),
        evaluated: vec![true; nodes.len()],
        prior: PriorKind::camera(&nodes).unwrap(),
    }
}

/// Root mean square error over the peak of the truth, and the share of nodes within 2.58 u.
fn judged(problem: &Problem, fitted: &Fitted) -> (f64, f64) {
    let peak = problem.truths.iter().flatten().fold(0.0f64, |m, t| m.max(*t));
    let (mut square, mut inside, mut count) = (0.0, 0.0, 0.0);
    for (curve, truth) in fitted.curves.iter().zip(&problem.truths) {
        let u = curve.standard_uncertainties();
        for k in (0..truth.len()).filter(|k| problem.evaluated[*k]) {
            let error = curve.values[k] - truth[k];
            square += error * error;
            inside += f64::from(error.abs() <= 2.58 * u[k]);
            count += 1.0;
        }
    }
    ((square / count).sqrt() / peak, inside / count)
}

fn baselines() -> serde_json::Value {
    let path: PathBuf = root().join("tests/calibration/baselines.json");
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

/// What another program's recovery of camera sensitivities by eigenvectors (Jiang and others 2013) reaches, where it was run.
fn recovered_by_eigenvectors(figures: &serde_json::Value) -> Option<f64> {
    figures.as_object()?.iter().find(|(name, _)| name.contains("jiang")).and_then(|(_, x)| x.as_f64())
}

/// The table of `docs/calibration.md`, between its marks.
fn write_table(rows: &str) {
    let path = root().join("docs/calibration.md");
    let text = fs::read_to_string(&path).unwrap();
    let (before, rest) = text.split_once("<!-- table -->\n").unwrap();
    let (_, after) = rest.split_once("<!-- end of table -->").unwrap();
    fs::write(path, format!("{before}<!-- table -->\n{rows}<!-- end of table -->{after}")).unwrap();
}

#[test]
fn every_problem_is_fitted_within_a_tenth_of_the_baseline_and_its_bands_hold() {
    let baselines = baselines();
    let mut wrong = Vec::new();
    let mut table =
        "| problem | ours | discrepancy | oracle | eigenvectors | ours / discrepancy | ours / oracle | nodes within 99 % bands | prior |\n\
                     |---|---|---|---|---|---|---|---|---|\n"
            .to_owned();
    for (id, case) in baselines["cases"].as_object().unwrap() {
        let problem = problem(id);
        let options = FitOptions { prior: problem.prior.clone(), ..FitOptions::default() };
        let fitted = fit(&problem.exposures, &problem.readings, &options).unwrap();
        let (rmse, inside) = judged(&problem, &fitted);
        let figures = if case["rmse"].is_object() { &case["rmse"] } else { &case["rmse_relative_to_peak"] };
        let figure = |name: &str| figures[name].as_f64().unwrap();
        let (baseline, oracle) = (figure("tikhonov2_nn_discrepancy"), figure("tikhonov2_nn_oracle_lambda"));
        let eigenvectors = recovered_by_eigenvectors(figures);
        table += &format!(
            "| {id} | {rmse:.2e} | {baseline:.2e} | {oracle:.2e} | {} | {:.2} | {:.2} | {:.1} % | {}, {:.0} nm |\n",
            eigenvectors.map_or("–".to_owned(), |x| format!("{x:.2e}")),
            rmse / baseline,
            rmse / oracle,
            100.0 * inside,
            fitted.prior,
            fitted.length_nm
        );
        if rmse > 1.10 * baseline || inside < 0.95 || eigenvectors.is_some_and(|limit| rmse >= limit) {
            wrong.push(format!("{id}: rmse {rmse:.4}, {:.3} of the baseline, {inside:.3} within the bands", rmse / baseline));
        }
    }
    println!("{table}");
    if std::env::var_os("ETENDUE_REWRITE_EXPECTED").is_some() {
        write_table(&table);
    }
    let written = fs::read_to_string(root().join("docs/calibration.md")).unwrap();
    for id in baselines["cases"].as_object().unwrap().keys() {
        assert!(written.contains(&format!("| {id} |")), "docs/calibration.md has no row for {id}: set ETENDUE_REWRITE_EXPECTED=1");
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
