//! `etendue coverage`: its verdicts on constructed runs, its truths, its table in every form, and what it says of bad input.

#![allow(clippy::unwrap_used)]

use std::path::PathBuf;
use std::process::{Command, Output};

use etendue::estimate::run::with_threads;
use etendue::estimate::{Stop, Watch};
use etendue::measurement::measure;
use etendue::metrology::distribution::normal_quantile;
use etendue::plan::{Plan, PlanOptions};
use etendue::report::coverage::{StudiedScene, csv, json, to_markdown, to_text, wrong};
use etendue::scene::scene_from_text;
use etendue::study::StudyWatch;
use etendue::study::coverage::{
    CoverageOptions, CoverageRow, Run, SceneCoverage, Tally, Truth, TruthOrigin, Verdict, coverage, lowest_share,
};

fn etendue(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_etendue")).args(arguments).current_dir(env!("CARGO_MANIFEST_DIR")).output().unwrap()
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

const EXACTLY_ONE: Truth = Truth { value: 1.0, standard_uncertainty: 0.0, origin: TruthOrigin::ClosedForm };

/// Readings of a normal distribution about `mean` with standard deviation 0.01, at evenly spread probabilities, that claim `u`.
fn normal(mean: f64, u: f64, truth: Truth) -> CoverageRow {
    let mut tally = Tally::new(truth, 0.05);
    for i in 0..1000 {
        let z = normal_quantile((f64::from(i) + 0.5) / 1000.0).unwrap();
        let run =
            Run { value: mean + 0.01 * z, standard_uncertainty: u, expanded_uncertainty: 1.96 * u, samples: 256, target_met: u < 0.02 };
        tally.add(&run);
    }
    CoverageRow::of("meter, E".to_owned(), "lx".to_owned(), &[tally]).unwrap()
}

#[test]
fn an_uncertainty_that_is_right_holds() {
    let row = normal(1.0, 0.01, EXACTLY_ONE);
    assert_eq!((row.covered, row.runs, row.verdict), (950, 1000, Verdict::Holds));
    assert!((row.claimed_over_rms - 1.0).abs() < 0.01 && row.bias.abs() < 1e-9 && row.outside_target == 0.0, "{row:?}");
}

#[test]
fn an_uncertainty_that_is_too_small_is_called_too_low() {
    let row = normal(1.0, 0.008, EXACTLY_ONE);
    // P(|z| ≤ 1.96 · 0.8) = 0.88312: 441.56 of 500 on each side, and the points are the middles of their classes.
    assert_eq!((row.covered, row.verdict), (884, Verdict::TooLow));
    assert!((row.claimed_over_rms - 0.8).abs() < 0.01, "{row:?}");
}

#[test]
fn an_uncertainty_that_is_twice_too_large_holds_and_shows() {
    let row = normal(1.0, 0.02, EXACTLY_ONE);
    assert_eq!((row.verdict, row.target_unmet), (Verdict::Holds, 1.0));
    assert!((row.claimed_over_rms - 2.0).abs() < 0.02, "{row:?}");
}

#[test]
fn a_mean_that_is_off_is_called_biased_though_the_intervals_cover() {
    let row = normal(1.002, 0.0105, EXACTLY_ONE);
    assert_eq!(row.verdict, Verdict::Biased, "{row:?}");
    assert!((row.bias - 0.002 / (0.01 / 1000f64.sqrt())).abs() < 0.1, "{row:?}");
}

#[test]
fn the_uncertainty_of_the_truth_counts() {
    // The truth is off by as much as it admits: no fault of the runs.
    let near = Truth { value: 1.001, standard_uncertainty: 0.001, origin: TruthOrigin::LongRun { samples: 1 << 20 } };
    let row = normal(1.0, 0.01, near);
    assert_eq!(row.verdict, Verdict::Holds, "{row:?}");
    assert!((row.bias + 1.0).abs() < 0.1 && (row.truth_share - 0.1).abs() < 1e-12, "{row:?}");
    let coarse = Truth { value: 1.005, standard_uncertainty: 0.005, ..near };
    assert_eq!(normal(1.0, 0.008, coarse).verdict, Verdict::TruthTooCoarse);
}

#[test]
fn poses_are_pooled_by_reading() {
    let tally = |u: f64| {
        let mut tally = Tally::new(EXACTLY_ONE, 0.05);
        for value in [0.99, 1.01] {
            tally.add(&Run { value, standard_uncertainty: u, expanded_uncertainty: 2.0 * u, samples: 100, target_met: true });
        }
        tally
    };
    let row = CoverageRow::of("grid, E".to_owned(), "lx".to_owned(), &[tally(0.01), tally(0.001)]).unwrap();
    assert_eq!((row.poses, row.runs, row.covered, row.samples), (2, 4, 2, 100.0));
    assert_eq!(CoverageRow::of(String::new(), String::new(), &[]), None);
    assert_eq!(CoverageRow::of(String::new(), String::new(), &[Tally::new(EXACTLY_ONE, 0.05)]), None);
}

#[test]
fn the_limit_is_three_binomial_standard_deviations() {
    assert!((lowest_share(1000) - (0.95 - 3.0 * (0.95f64 * 0.05 / 1000.0).sqrt())).abs() < 1e-15);
    assert!(lowest_share(100) < lowest_share(1000) && lowest_share(u64::MAX) <= 0.95);
}

/// A panel half hidden by a blade, and a meter that only a formula serves.
const SCENE: &str = r#"Scene(
    title: "blade",
    surfaces: { "black": Black },
    objects: [(name: "blade", shape: Quad(corner: (0.05, -2, 0.5), u: (3, 0, 0), v: (0, 4, 0)), surface: "black")],
    sources: [(name: "panel", shape: Rectangle(1, 0.6), at: (0, 0, 1), facing: (0, 0, -1), strength: Radiance(10),
               spectrum: Flat(from_nm: 400, to_nm: 700))],
    instruments: [
        (name: "m", at: (0, 0, 0), facing: (0, 0, 1), sensor: Sensor(aperture: Point, acceptance: Cosine,
            channels: [(name: "E", responsivity: 1, reads: Irradiance)])),
        (name: "above", at: (0, 0, 0.6), facing: (0, 0, 1), sensor: Sensor(aperture: Point, acceptance: Cosine,
            channels: [(name: "E", responsivity: 1, reads: Irradiance)])),
    ],
)"#;

fn studied(options: &CoverageOptions) -> SceneCoverage {
    let watch = StudyWatch { now: &|| 0.0, cpu: &|| 0.0, progress: &|_| {} };
    coverage(&scene_from_text(SCENE).unwrap(), &PlanOptions::default(), options, &watch).unwrap()
}

#[test]
fn a_penumbra_is_held_to_a_long_run_and_a_formula_is_not_sampled() {
    let found = studied(&CoverageOptions { seeds: 100, ..CoverageOptions::default() });
    assert_eq!((found.exact, found.rows.len(), found.seeds), (1, 1, (100, 100)));
    let row = &found.rows[0];
    assert_eq!((row.reading.as_str(), row.runs, row.unit.as_str()), ("m, E", 100, "W/m²"));
    assert_eq!(row.verdict, Verdict::Holds, "{row:?}");
    assert!(matches!(row.origin, TruthOrigin::LongRun { samples } if samples > 10_000) && row.truth_share < 0.1, "{row:?}");
}

/// A radiance meter of 1° before a panel that fills a thousand times its acceptance, read by connections to the panel: few are accepted.
const FILLED: &str = r#"Scene(
    sources: [(name: "panel", shape: Rectangle(0.6, 0.34), at: (0, 0, 0.6), facing: (0, 0, -1), strength: Radiance(10), spectrum: Line(555))],
    instruments: [(name: "m", at: (0, 0, 0), facing: (0, 0, 1), sensor: Sensor(aperture: Disc(radius_mm: 1),
        acceptance: Cone(half_angle_deg: 0.5), channels: [(name: "L", responsivity: 1, reads: Radiance)]))],
)"#;

#[test]
fn what_no_connection_found_is_within_the_bound() {
    let scene = scene_from_text(FILLED).unwrap();
    let plan = Plan::new(&scene, &PlanOptions { naive: true, ..PlanOptions::default() }).unwrap();
    let watch = Watch { now: &|| 0.0, progress: &|_| {} };
    let mut zeros = 0;
    for seed in 0..20 {
        let few = Stop { target: None, budget_seconds: None, samples: Some(256) };
        let reading = measure(&scene, &plan, &few, seed, &watch).unwrap().readings.remove(0);
        if reading.value == 0.0 {
            zeros += 1;
            assert!(reading.expanded.expanded_uncertainty >= 10.0, "seed {seed}: 0 ± {}", reading.expanded.expanded_uncertainty);
        }
    }
    assert!(zeros > 0, "every seed found the light: the test says nothing");
}

#[test]
fn a_run_with_a_target_goes_on_until_it_finds_light() {
    let scene = scene_from_text(FILLED).unwrap();
    let watch = StudyWatch { now: &|| 0.0, cpu: &|| 0.0, progress: &|_| {} };
    let options = CoverageOptions { seeds: 40, target: 0.2, ..CoverageOptions::default() };
    let found = coverage(&scene, &PlanOptions { naive: true, ..PlanOptions::default() }, &options, &watch).unwrap();
    assert_eq!((found.rows[0].verdict, found.rows[0].origin), (Verdict::Holds, TruthOrigin::ClosedForm), "{:?}", found.rows);
    assert_eq!(found.rows[0].outside_target, 0.0, "{:?}", found.rows);
}

#[test]
fn rows_do_not_depend_on_the_number_of_threads() {
    let options = CoverageOptions { seeds: 20, ..CoverageOptions::default() };
    let rows = |threads| with_threads(Some(threads), || studied(&options).rows);
    assert_eq!(rows(1), rows(3));
}

#[test]
fn every_form_has_every_row_and_names_what_is_wrong() {
    let mut found = studied(&CoverageOptions { seeds: 4, ..CoverageOptions::default() });
    found.rows.push(normal(1.0, 0.008, EXACTLY_ONE));
    let scenes = [StudiedScene { file: "scenes/blade.ron".to_owned(), target: 0.05, found }];
    assert_eq!(wrong(&scenes), 1);
    assert_eq!(csv::to_csv(&scenes).lines().count(), 3);
    let parsed: serde_json::Value = serde_json::from_str(&json::to_json(&scenes)).unwrap();
    assert_eq!(parsed["scenes"][0]["rows"][1]["verdict"], "TOO LOW");
    assert_eq!(parsed["scenes"][0]["rows"].as_array().unwrap().len(), 2);
    for text in [to_text(&scenes), to_markdown(&scenes, "etendue coverage")] {
        for part in ["88.4 % of 1000", "92.9 %", "TOO LOW", "m, E", "1 readings are exact", "2 rows: 1 hold, 1 too low", "100.0 % of 4"] {
            assert!(text.contains(part), "no `{part}` in {text}");
        }
    }
}

#[test]
fn the_command_writes_its_table_and_holds() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("coverage");
    std::fs::create_dir_all(&folder).unwrap();
    let file = folder.join("coverage.md");
    let output = etendue(&[
        "coverage",
        "scenes/overcast-sky.ron",
        "scenes/photometric-bench.ron",
        "--seeds",
        "40",
        "--target",
        "20%",
        "--markdown",
        file.to_str().unwrap(),
    ]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let markdown = std::fs::read_to_string(&file).unwrap();
    for text in [stdout(&output), markdown] {
        for part in
            ["ground [0], E_v", "6228.02 lx", "closed form", "of 40", "holds", "scenes/photometric-bench.ron: exact, nothing sampled"]
        {
            assert!(text.contains(part), "no `{part}` in {text}");
        }
    }
}

#[test]
fn every_problem_is_told_before_anything_is_run() {
    let output = etendue(&["coverage", "scenes/ofice.ron", "scenes/overcast.ron"]);
    assert_eq!(output.status.code(), Some(2));
    let told = stderr(&output);
    assert!(told.contains("scenes/ofice.ron") && told.contains("scenes/overcast.ron"), "{told}");
    assert!(told.contains("office.ron"), "what to type instead: {told}");
    let output = etendue(&["coverage", "scenes/office.ron", "--out", "nowhere/a.txt", "--markdown", "scenes"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("no folder `nowhere`") && stderr(&output).contains("it is a folder"), "{}", stderr(&output));
    for (arguments, part) in [
        (["--seeds", "1"], "a whole number, 2 to"),
        (["--target", "5"], "write 5%"),
        (["--budget-per-scene", "20"], "with its unit"),
        (["--poses", "0"], "a whole number, 1 to"),
        (["--without", "no_such_rule"], "no_such_rule"),
    ] {
        let output = etendue(&["coverage", "scenes/overcast-sky.ron", arguments[0], arguments[1]]);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(stderr(&output).contains(part), "no `{part}` in {}", stderr(&output));
    }
}
