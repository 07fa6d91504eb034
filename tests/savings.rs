//! What the rules of the plan save: the study on tiny scenes, its reports, and the page that the command wrote.

#![allow(clippy::unwrap_used)]

mod disk;

use std::collections::BTreeMap;
use std::process::Command;

use disk::{Repository, root};
use etendue::estimate::{Stop, Watch};
use etendue::measurement::{Measurement, measure};
use etendue::plan::{Plan, PlanOptions, reading_rule_names};
use etendue::report::savings::{SavingsReport, to_csv, to_json, to_markdown, to_text};
use etendue::scene::{Scene, read_scene};
use etendue::study::StudyWatch;
use etendue::study::converge::ConvergeOptions;
use etendue::study::savings::{SavingsOptions, SceneSavings, Without, rule_sentences, savings, summary};

fn shelf(name: &str) -> Scene {
    read_scene(&format!("scenes/{name}.ron"), &Repository, None).unwrap_or_else(|problems| panic!("{problems}"))
}

/// A study whose ladder ends at a number of samples. Its clock ticks once a look, so that times are numbers; they are not looked at.
fn studied(name: &str) -> SceneSavings {
    let ticks = std::sync::atomic::AtomicU64::new(0);
    let cpu = || ticks.fetch_add(1, std::sync::atomic::Ordering::Relaxed) as f64;
    let ladder = ConvergeOptions { seeds: 4, seed: 3, budget_seconds: f64::INFINITY, most_samples: 16384 };
    let watch = StudyWatch { now: &|| 0.0, cpu: &cpu, progress: &|_| {} };
    savings(&format!("scenes/{name}.ron"), &shelf(name), &SavingsOptions { error: 0.01, ladder }, &watch).unwrap()
}

fn report() -> SavingsReport {
    SavingsReport {
        options: SavingsOptions::default(),
        scenes: ["photometric-bench", "penumbra", "stray-lamp"].map(studied).to_vec(),
        failed: vec![("dark.ron".to_owned(), "every reading is zero".to_owned())],
        threads: 1,
        cpu_clock: "ticks".to_owned(),
    }
}

fn read(scene: &Scene, without: &[&str], seed: u64) -> Measurement {
    let plan = Plan::new(scene, &PlanOptions { naive: false, without: without.iter().map(ToString::to_string).collect() }).unwrap();
    let stop = Stop { target: None, budget_seconds: None, samples: Some(4096) };
    measure(scene, &plan, &stop, seed, &Watch { now: &|| 0.0, progress: &|_| {} }).unwrap()
}

#[test]
fn a_rule_that_acts_alone_saves_rays_and_one_that_is_idle_is_not_measured() {
    for name in ["photometric-bench", "penumbra", "stray-lamp", "light-traps", "ideal-integrating-sphere"] {
        let found = studied(name);
        assert_eq!(found.rules.iter().map(|r| r.rule).collect::<Vec<_>>(), reading_rule_names(), "{name}");
        let planned = found.planned.rays.unwrap();
        // Not every naive plan comes to 1 % by so few samples.
        assert!(found.naive.rays.is_none_or(|rays| rays > planned), "{name}");
        for rule in &found.rules {
            let plan = Plan::new(&shelf(name), &PlanOptions::default()).unwrap();
            assert_eq!(rule.terms, plan.terms_by(rule.rule), "{name}");
            match &rule.without {
                Without::Idle => assert_eq!(rule.terms, 0, "{name}: {}", rule.rule),
                Without::SameWork => assert!(rule.terms > 0, "{name}: {}", rule.rule),
                Without::Costs(cost) => {
                    assert!(rule.terms > 0, "{name}: {}", rule.rule);
                    assert!(cost.rays.is_none_or(|rays| rays >= planned), "{name}: {} costs rays: {cost:?}", rule.rule);
                }
            }
        }
    }
    let rays = |name: &str, rule: &str| {
        let found = studied(name);
        match &found.rules.iter().find(|r| r.rule == rule).unwrap().without {
            Without::Costs(cost) => (found.planned.rays.unwrap(), cost.rays.unwrap()),
            other => panic!("{rule}: {other:?}"),
        }
    };
    for (name, rule) in [
        ("photometric-bench", "no_reflector_in_view"),
        ("penumbra", "no_reflector_in_view"),
        ("light-traps", "weak_reflections"),
        ("light-traps", "nothing_blocks"),
    ] {
        let (with, without) = rays(name, rule);
        assert!(without > with, "{name}: {rule} spares {without} - {with} rays");
    }
}

#[test]
fn readings_without_a_rule_are_those_with_it() {
    for name in ["penumbra", "stray-lamp", "light-traps", "disc-source", "laser-line", "cosine-law", "ideal-integrating-sphere"] {
        let scene = shelf(name);
        let all = read(&scene, &[], 1);
        for (seed, rule) in reading_rule_names().into_iter().enumerate() {
            for (with, without) in all.readings.iter().zip(&read(&scene, &[rule], 2 + seed as u64).readings) {
                let joint = with.standard_uncertainty().hypot(without.standard_uncertainty());
                // Some two hundred comparisons, 15 degrees of freedom at least: 5.5 u is missed once in 16 000.
                assert!(
                    (with.value - without.value).abs() <= 5.5 * joint,
                    "{name} without {rule}: {} and {}, u = {joint}",
                    with.value,
                    without.value
                );
            }
        }
    }
}

#[test]
fn the_reports_hold_every_scene_and_rule() {
    let report = report();
    let (text, page, csv) = (to_text(&report), to_markdown(&report), to_csv(&report));
    let json: serde_json::Value = serde_json::from_str(&to_json(&report)).unwrap();
    for rule in reading_rule_names() {
        assert!(text.contains(rule) && page.contains(&format!("| `{rule}` |")), "{rule}");
        assert_eq!(csv.lines().filter(|line| line.contains(&format!(",{rule},"))).count(), report.scenes.len(), "{rule}");
    }
    for written in [&text, &page] {
        assert!(written.contains("dark.ron") && written.contains("every reading is zero"));
        assert!(written.contains("Not the expanded uncertainty"));
    }
    assert_eq!(csv.lines().count(), 1 + report.scenes.len() * (3 + reading_rule_names().len()));
    assert_eq!(json["scenes"].as_array().unwrap().len(), 3);
    assert_eq!(json["rules"].as_array().unwrap().len(), reading_rule_names().len());
    assert_eq!(json["scenes"][0]["planned"]["rays"], 0.0);
    assert_eq!(json["not_studied"][0]["scene"], "dark.ron");
}

#[test]
fn the_summary_counts_what_the_scenes_say() {
    let report = report();
    let summary = summary(&report.scenes);
    for (rule, sum) in reading_rule_names().into_iter().zip(&summary.rules) {
        let cells: Vec<_> = report.scenes.iter().flat_map(|s| s.rules.iter().filter(|r| r.rule == rule)).collect();
        assert_eq!(sum.acts, cells.iter().filter(|r| r.terms > 0).count(), "{rule}");
        assert_eq!(sum.alone, cells.iter().filter(|r| matches!(r.without, Without::Costs(_))).count(), "{rule}");
        assert!(sum.alone <= sum.acts);
        if let Some(rays) = &sum.rays {
            assert!(rays.least <= rays.median && rays.median <= rays.largest && rays.largest <= 1.0, "{rule}: {rays:?}");
        }
    }
    let of = |rule: &str| summary.rules.iter().find(|r| r.rule == rule).unwrap();
    assert!(of("emits_elsewhere").acts == 1 && of("outside_acceptance").acts == 1 && of("no_reflector_in_view").acts == 3);
    assert_eq!(of("weak_reflections").times, None);
    // All of the bench is known by formulas.
    assert_eq!(summary.naive_rays.unwrap().largest, 1.0);
}

/// The page is written anew by `etendue rules --markdown docs/rules.md`.
#[test]
fn the_page_names_the_rules_that_there_are() {
    let page = std::fs::read_to_string(root().join("docs/rules.md")).unwrap();
    let listed = page.split("## Rules\n").nth(1).unwrap().split("\n## ").next().unwrap();
    let rows: Vec<(&str, &str)> = listed
        .lines()
        .filter_map(|line| line.strip_prefix("| `")?.split_once("` | "))
        .map(|(name, sentence)| (name, sentence.trim_end_matches(" |")))
        .collect();
    assert_eq!(rows, rule_sentences());
    assert_eq!(rows.iter().map(|row| row.0).collect::<Vec<_>>(), reading_rule_names());
    let head = page.lines().find(|line| line.starts_with("| scene | readings |")).unwrap();
    assert!(head.ends_with(&format!("{} |", reading_rule_names().join(" | "))), "{head}");
    // Every rule acts somewhere on the shelf, and every scene of the shelf is in the table.
    let saved = page.split("## What each saves").nth(1).unwrap();
    let acts: BTreeMap<&str, u32> = saved
        .lines()
        .filter_map(|line| {
            let cells: Vec<&str> = line.split(" | ").collect();
            Some((cells.first()?.strip_prefix("| ")?, cells.get(1)?.parse().ok()?))
        })
        .collect();
    assert!(reading_rule_names().iter().all(|rule| acts[rule] > 0), "{acts:?}");
    for (folder, prefix) in [("scenes", ""), ("scenes/lecture", "lecture/")] {
        for file in disk::files_in(folder, &[".ron"]) {
            // Pictures have rules of their own, which `tests/plans/` shows.
            if !std::fs::read_to_string(root().join(folder).join(&file)).unwrap().contains("instruments:") {
                continue;
            }
            let row = format!("\n| {prefix}{} | ", file.trim_end_matches(".ron"));
            assert!(page.contains(&row), "docs/rules.md lacks {file}");
        }
    }
}

#[test]
fn the_command_studies_scenes_and_tells_what_is_wrong_with_others() {
    let etendue = |arguments: &[&str]| Command::new(env!("CARGO_BIN_EXE_etendue")).args(arguments).current_dir(root()).output().unwrap();
    let found = etendue(&["rules", "scenes/cosine-law.ron", "--budget-per-scene", "200ms", "--format", "csv"]);
    assert!(found.status.success(), "{}", String::from_utf8_lossy(&found.stderr));
    assert!(String::from_utf8_lossy(&found.stdout).lines().any(|l| l.starts_with("scenes/cosine-law.ron,behind_horizon,yes,")));
    let wrong = etendue(&["rules", "scenes/no-such.ron", "scenes/neither.ron"]);
    let told = String::from_utf8_lossy(&wrong.stderr);
    assert_eq!(wrong.status.code(), Some(2));
    assert!(told.contains("no-such.ron") && told.contains("neither.ron"), "{told}");
    let nowhere = etendue(&["rules", "scenes/cosine-law.ron", "--markdown", "no-such-folder/page.md"]);
    assert_eq!(nowhere.status.code(), Some(2));
}
