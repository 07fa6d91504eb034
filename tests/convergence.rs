//! Error against run time: slopes and claims that are known otherwise, and what the program makes of bad references.
//!
//! Clocks stand still here, so the ladders are the same on every machine: they end at a number of samples.

#![allow(clippy::unwrap_used)]

mod disk;

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

use disk::{Repository, root};
use etendue::estimate::closed_form::polygon::polygon_two_sided;
use etendue::math::DVec3;
use etendue::plan::{Plan, PlanOptions};
use etendue::report::convergence::{CampaignReport, campaign_to_csv, campaign_to_json, campaign_to_text};
use etendue::report::convergence::{
    ConvergenceReport, reference_from_csv, reference_from_json, reference_from_values, to_csv, to_json, to_text,
};
use etendue::scene::read_calibration;
use etendue::scene::{Scene, read_scene, scene_from_text};
use etendue::study::StudyWatch;
use etendue::study::converge::campaign::{CampaignConvergence, CampaignRung, LadderKind, converge_campaign};
use etendue::study::converge::{ConvergeError, ConvergeOptions, Convergence, PowerLaw, Reference, TimeTo, converge, places};

fn shelf(name: &str) -> Scene {
    read_scene(&format!("scenes/{name}.ron"), &Repository, None).unwrap_or_else(|problems| panic!("{problems}"))
}

fn planned(scene: &Scene) -> Plan {
    Plan::new(scene, &PlanOptions::default()).unwrap()
}

fn study(scene: &Scene, naive: bool, reference: Option<Reference>, seeds: u64, most_samples: u64) -> Result<Convergence, ConvergeError> {
    let plan = planned(scene);
    let all = Plan::new(scene, &PlanOptions { naive: true, without: Vec::new() }).unwrap();
    let plans = if naive { vec![("planned", &plan), ("naive", &all)] } else { vec![("planned", &plan)] };
    let options = ConvergeOptions { seeds, seed: 7, budget_seconds: f64::INFINITY, most_samples };
    converge(scene, &plans, reference, &options, &StudyWatch { now: &|| 0.0, cpu: &|| 0.0, progress: &|_| {} })
}

fn report(study: Convergence) -> ConvergenceReport {
    ConvergenceReport { study, scene_file: "scene.ron".to_owned(), threads: 1, cpu_clock: "stands still".to_owned() }
}

/// A blade with an oblique edge hides part of a panel from a point: the form factor of what is left.
fn penumbra() -> (Scene, f64) {
    // The edge x = 0.05 + y/2 at half height hides x > 0.1 + y/2 of the panel.
    let seen = [DVec3::new(-0.5, -0.3, 1.0), DVec3::new(-0.05, -0.3, 1.0), DVec3::new(0.25, 0.3, 1.0), DVec3::new(-0.5, 0.3, 1.0)];
    let text = r#"Scene(
        surfaces: { "black": Black },
        objects: [(name: "blade", shape: Quad(corner: (-1.95, -4, 0.5), u: (4, -2, 0), v: (4, 8, 0)), surface: "black")],
        sources: [(name: "panel", shape: Rectangle(1, 0.6), at: (0, 0, 1), facing: (0, 0, -1), strength: Radiance(10),
                   spectrum: Flat(from_nm: 400, to_nm: 700))],
        instruments: [(name: "m", at: (0, 0, 0), facing: (0, 0, 1), sensor: Sensor(title: "meter", aperture: Point, acceptance: Cosine,
                       channels: [(name: "E", responsivity: 1.0, reads: Irradiance)]))],
    )"#;
    (scene_from_text(text).unwrap_or_else(|problems| panic!("{problems}")), 10.0 * polygon_two_sided(&seen, DVec3::Z))
}

/// How the error falls with the samples.
fn slope(found: &Convergence) -> PowerLaw {
    found.plans[0].curves[0].error_by_samples.unwrap()
}

/// The uncertainty that is claimed is the true one within a factor 1.5, and the reference is good enough to tell.
fn is_claimed_as_it_is(found: &Convergence) {
    let all = &found.plans[0].curves[0];
    let ratio = all.ratio.unwrap();
    assert!((1.0 / 1.5..1.5).contains(&ratio), "claimed over true: {ratio}");
    for rung in &all.rungs {
        assert!(!rung.reference_limits && (1.0 / 1.5..1.5).contains(&rung.ratio()), "{rung:?}");
    }
}

#[test]
fn in_a_penumbra_the_error_falls_faster_than_chance_and_is_claimed_as_it_is() {
    let (scene, truth) = penumbra();
    let reference = reference_from_values(&truth.to_string(), &places(&scene)).unwrap();
    let found = study(&scene, false, Some(reference), 64, 1 << 16).unwrap();
    is_claimed_as_it_is(&found);
    let law = slope(&found);
    assert!(law.exponent + 2.0 * law.standard_uncertainty < -0.5, "{law:?}");
    assert_eq!(found.plans[0].curves[0].rungs.iter().map(|r| r.samples).collect::<Vec<_>>(), [256, 1024, 4096, 16384, 65536]);
    // No clock, no times.
    assert_eq!(found.plans[0].curves[0].error_by_time, None);
    assert_eq!(found.plans[0].curves[0].times, [TimeTo::Unknown; 3]);
}

#[test]
fn in_a_box_the_error_is_claimed_as_it_is_held_to_a_long_run_of_its_own() {
    let found = study(&shelf("cornell-box"), false, None, 64, 1 << 14).unwrap();
    is_claimed_as_it_is(&found);
    // Light that was reflected more than once has too many dimensions for quasi-random points to gain much: no slower than chance.
    let law = slope(&found);
    assert!(law.exponent - 2.0 * law.standard_uncertainty < -0.5, "{law:?}");
    let names: Vec<&str> = found.plans[0].curves.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(names, ["all readings", "penumbra, E_v", "penumbra, E_e", "in the open, E_v", "in the open, E_e"]);
    let again = study(&shelf("cornell-box"), false, Some(found.reference.clone()), 64, 1 << 14).unwrap();
    assert_eq!(again.plans[0].curves, found.plans[0].curves, "the same seeds give the same errors");
}

#[test]
fn what_formulas_give_is_exact_and_a_reference_for_the_naive_plan() {
    let scene = shelf("disc-source");
    let found = study(&scene, true, None, 16, 1 << 14).unwrap();
    let [plan, naive] = &found.plans[..] else { panic!("two plans") };
    assert!(plan.exact.as_ref().is_some_and(|e| e.claimed < 1e-9 && e.values.len() == 5) && plan.curves.is_empty());
    let all = &naive.curves[0];
    assert!(naive.exact.is_none() && all.readings == 5);
    assert!(all.error_by_samples.unwrap().exponent < -0.6 && all.rungs.iter().all(|r| r.error > 0.0 && r.ratio() > 1.0 / 1.5));
    let text = to_text(&report(found));
    assert!(text.contains("planned: exact") && text.contains("the closed form"), "{text}");

    // π L sin² of the header, and a value that is off by one in ten thousand.
    let exact = "1570.796327,628.3185307,31.10487838,868.3149,37.40528";
    let held = study(&scene, false, Some(reference_from_values(exact, &places(&scene)).unwrap()), 8, 256).unwrap();
    let (relative, _) = held.plans[0].exact.as_ref().unwrap().deviation.unwrap();
    assert!(relative < 1e-6, "{relative}");
    assert!(to_text(&report(held)).contains("deviation from the reference"));
}

#[test]
fn a_reference_that_is_too_rough_is_told() {
    let (scene, truth) = penumbra();
    let rough = format!("{truth}+-{}", 0.01 * truth);
    let found = study(&scene, false, Some(reference_from_values(&rough, &places(&scene)).unwrap()), 8, 1 << 14).unwrap();
    let all = &found.plans[0].curves[0];
    assert!(all.rungs.last().unwrap().reference_limits && (all.reference_uncertainty - 0.01).abs() < 1e-12);
    assert!(found.remarks.iter().any(|r| r.contains("reference limits")));
    assert!(to_text(&report(found)).contains("%*"));
    let zero = study(&scene, false, Some(reference_from_values("0", &places(&scene)).unwrap()), 8, 256);
    assert!(matches!(zero, Err(ConvergeError::Reference(what)) if what.contains("zero")));
}

#[test]
fn the_three_formats_say_the_same() {
    let found = report(study(&shelf("cornell-box"), true, None, 2, 1024).unwrap());
    let json: serde_json::Value = serde_json::from_str(&to_json(&found)).unwrap();
    let csv = to_csv(&found);
    assert_eq!(csv.lines().count(), 1 + 2 * 5 * 2, "{csv}");
    for (p, plan) in found.study.plans.iter().enumerate() {
        for (c, curve) in plan.curves.iter().enumerate() {
            for (r, rung) in curve.rungs.iter().enumerate() {
                let told = &json["plans"][p]["curves"][c]["rungs"][r];
                assert_eq!((told["error"].as_f64(), told["claimed"].as_f64()), (Some(rung.error), Some(rung.claimed)));
                assert!(csv.contains(&format!(",{},{},", rung.error, rung.claimed)), "{csv}");
            }
        }
    }
    assert_eq!(json["reference"]["origin"], "long run");
}

#[test]
fn files_of_readings_are_references() {
    let scene = shelf("office");
    let places = places(&scene);
    let watch = etendue::estimate::Watch { now: &|| 0.0, progress: &|_| {} };
    let stop = etendue::estimate::Stop { target: None, budget_seconds: None, samples: Some(16) };
    let measured = etendue::measurement::measure(&scene, &planned(&scene), &stop, 3, &watch).unwrap();
    assert_eq!(places.len(), measured.readings.len());
    let json = reference_from_json(&etendue::report::json::to_json(&measured), "r.json", scene.hash, &places).unwrap();
    let csv = reference_from_csv(&etendue::report::csv::to_csv(&measured), "r.csv", &places).unwrap();
    assert_eq!(json.values, csv.values);
    for (value, reading) in json.values.iter().zip(&measured.readings) {
        assert_eq!((value.value, value.standard_uncertainty), (reading.value, Some(reading.standard_uncertainty())));
    }
}

fn etendue(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_etendue")).args(arguments).current_dir(root()).output().unwrap()
}

fn scratch(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("convergence");
    fs::create_dir_all(&folder).unwrap();
    folder.join(name)
}

#[test]
fn references_that_are_none_are_bad_input() {
    let written = |name: &str, text: &str| {
        let file = scratch(name);
        fs::write(&file, text).unwrap();
        file.to_str().unwrap().to_owned()
    };
    let measure = |scene: &str, format: &str| {
        let output = etendue(&["measure", scene, "--samples", "16", "--format", format]);
        String::from_utf8(output.stdout).unwrap()
    };
    let disc = "scenes/disc-source.ron";
    let other = written("other.json", &measure("scenes/cosine-law.ron", "json"));
    let none = written("none.json", "{}");
    let csv = measure(disc, "csv");
    let short = written("short.csv", csv.lines().take(4).collect::<Vec<_>>().join("\n").as_str());
    let twice = written("twice.csv", &format!("{csv}{}\n", csv.lines().last().unwrap()));
    let units = written("units.csv", &csv.replace(",lx,", ",fc,"));
    let columns = written("columns.csv", "a,b\n1,2\n");
    for (reference, expected) in [
        ("1,2", "2 values, and the scene has 5 readings"),
        ("1,2,x,4,nan", "value 3 is `x`"),
        ("1,2,3,4,5+--1", "value 5"),
        ("0,0,0,0,0", "zero"),
        ("nowhere.json", "there is no such file"),
        ("lux", "which is no number"),
        (&other, "another scene"),
        (&none, "missing field"),
        (&short, "it has no reading of `beside it [0], E_v`"),
        (&twice, "stands in it twice"),
        (&units, "is in fc there, in lx here"),
        (&columns, "it has no column instrument, channel, unit, value"),
    ] {
        let output = etendue(&["converge", disc, "--reference", reference]);
        let told = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{reference}: {told}");
        assert!(told.contains(expected), "{reference}: {told}");
        assert!(output.stdout.is_empty());
    }
}

#[test]
fn places_that_cannot_be_written_are_told_before_the_time_is_spent() {
    let disc = "scenes/disc-source.ron";
    for arguments in [["--plot", "picture.gif"], ["--plot", "no/folder/picture.svg"], ["--out", "no/folder/table.txt"], ["--out", "scenes"]]
    {
        let output = etendue(&["converge", disc, arguments[0], arguments[1]]);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    }
    let output = etendue(&["converge", disc, "--budget", "0s"]);
    assert_eq!(output.status.code(), Some(2));
    let output = etendue(&["converge", "scenes/office.ron", "--budget", "1ms"]);
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.code() == Some(2) && told.contains("too short"), "{told}");
}

#[test]
#[cfg(feature = "plot")]
fn a_picture_is_drawn_where_there_is_something_to_draw() {
    let picture = scratch("box.svg");
    let name = picture.to_str().unwrap();
    let _ = fs::remove_file(&picture);
    let exact = etendue(&["converge", "scenes/disc-source.ron", "--plot", name]);
    assert!(exact.status.success() && !picture.exists());
    assert!(String::from_utf8(exact.stderr).unwrap().contains("no picture was drawn"));
    let sampled = etendue(&["converge", "scenes/cornell-box.ron", "--seeds", "2", "--up-to", "4096", "--budget", "3s", "--plot", name]);
    assert!(sampled.status.success(), "{}", String::from_utf8(sampled.stderr).unwrap());
    let drawn = fs::read_to_string(&picture).unwrap();
    for text in ["slope −1/2", "slope −1", "true error", "claimed uncertainty", "Processor time"] {
        assert!(drawn.contains(text), "{text}");
    }
}

fn campaign(file: &str, options: &ConvergeOptions) -> CampaignConvergence {
    let calibration = read_calibration(file, &Repository, None).unwrap_or_else(|problems| panic!("{problems}"));
    converge_campaign(&calibration, options, &StudyWatch { now: &|| 0.0, cpu: &|| 0.0, progress: &|_| {} })
        .unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn the_error_of_a_curve_falls_with_exposures_and_with_noise_and_is_claimed() {
    let study =
        campaign("scenes/calibration/monochromator.ron", &ConvergeOptions { seeds: 2, most_samples: 4096, ..ConvergeOptions::default() });
    let [exposures, noise] = [LadderKind::Exposures, LadderKind::Noise].map(|kind| study.ladder(kind).unwrap());
    assert_eq!(study.ladder(LadderKind::Samples).map(|l| l.rungs.len()), Some(3));
    let counts: Vec<usize> = exposures.rungs.iter().map(|r| r.exposures).collect();
    assert_eq!(counts, [3, 6, 12, 24, 48, 81]);
    let falls = |rungs: &[CampaignRung]| rungs.last().unwrap().error < 0.1 * rungs[0].error;
    assert!(falls(&exposures.rungs) && falls(&noise.rungs), "{study:#?}");
    // Half the noise, hardly half the error: fewer readings go into each node of a smoother curve.
    let exponent = (noise.rungs[0].error / noise.rungs[2].error).ln() / (noise.rungs[0].parameter / noise.rungs[2].parameter).ln();
    assert!((0.6..1.1).contains(&exponent), "{exponent}");
    // Errors are claimed, or the fit says that more than noise is uncertain: far below the noise of the file it is the curve between its nodes that errs.
    for rung in exposures.rungs.iter().chain(&noise.rungs) {
        assert!(rung.told == rung.seeds || (rung.within_95 > 0.85 && rung.claimed > 0.7 * rung.error), "{rung:?}");
    }
    for rung in &noise.rungs[..3] {
        assert_eq!(rung.told, 0, "{rung:?}");
    }
}

#[test]
fn a_campaign_by_substitution_is_held_to_the_beam_that_it_has() {
    let study =
        campaign("scenes/calibration/substitution.ron", &ConvergeOptions { seeds: 2, most_samples: 4096, ..ConvergeOptions::default() });
    let last = study.ladder(LadderKind::Exposures).and_then(|ladder| ladder.rungs.last()).unwrap();
    assert!(last.within_95 > 0.85 && last.claimed > 0.5 * last.error, "{last:?}");
    assert!(study.remarks.iter().any(|r| r.contains("the beam is taken as known")), "{:?}", study.remarks);
}

#[test]
fn every_form_has_every_rung_of_a_campaign() {
    let study =
        campaign("scenes/calibration/three-leds.ron", &ConvergeOptions { seeds: 2, most_samples: 4096, ..ConvergeOptions::default() });
    let rungs: usize = study.ladders.iter().map(|l| l.rungs.len()).sum();
    assert!(rungs >= 8, "{rungs}");
    let report = CampaignReport { study, file: "three-leds.ron".to_owned(), threads: 1, cpu_clock: "no clock".to_owned() };
    assert_eq!(campaign_to_csv(&report).lines().count(), rungs + 1);
    let json: serde_json::Value = serde_json::from_str(&campaign_to_json(&report)).unwrap();
    let counted: usize = json["ladders"].as_array().unwrap().iter().map(|l| l["rungs"].as_array().unwrap().len()).sum();
    assert_eq!(counted, rungs);
    let text = campaign_to_text(&report);
    assert!(text.contains("exposures: nested") && text.contains("claimed/true") && text.contains("samples: readings of a bench"), "{text}");
}

#[test]
fn what_is_for_scenes_is_refused_for_a_calibration() {
    let file = "scenes/calibration/three-leds.ron";
    for option in [&["--compare-naive"][..], &["--naive"], &["--reference", "1"]] {
        let output = etendue(&[&["converge", file], option].concat());
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.code() == Some(2) && said.contains("is for scenes"), "{said}");
    }
    let output = etendue(&["converge", file, "--budget", "1ms"]);
    assert!(output.status.code() == Some(2) && String::from_utf8_lossy(&output.stderr).contains("give at least"), "{output:?}");
}
