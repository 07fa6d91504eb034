//! `etendue verify`, as a user and as a program sees it.

#![allow(clippy::unwrap_used)]

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use std::process::{Command, Output};

use etendue::study::verify::{FILES, Selection, Suite, Tables, Verdict, WAITING};
use serde_json::Value;

fn run(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_etendue")).arg("verify").args(arguments).current_dir(env!("CARGO_MANIFEST_DIR")).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn scratch(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name)
}

/// The ids of the files, by group, read by another route than the library's.
fn ids() -> BTreeMap<String, Vec<String>> {
    let mut groups: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for (_, file) in FILES {
        let file: Value = serde_json::from_str(file).unwrap();
        assert_eq!(file["count"].as_u64().unwrap() as usize, file["cases"].as_array().unwrap().len());
        for case in file["cases"].as_array().unwrap() {
            let id = case["id"].as_str().unwrap().to_owned();
            groups.entry(id[..2].to_owned()).or_default().push(id);
        }
    }
    groups
}

#[test]
fn everything_agrees_and_the_counts_are_those_of_the_files() {
    let page = scratch("verify.html");
    let found = run(&["--format", "json", "--report", page.to_str().unwrap()]);
    assert!(found.status.success(), "{}", text(&found.stderr));
    let json: Value = serde_json::from_slice(&found.stdout).unwrap();
    assert_eq!(json["passed"], true);
    let ids = ids();
    let groups = json["groups"].as_array().unwrap();
    assert_eq!(groups.len(), ids.len());
    for group in groups {
        let of_file = &ids[group["name"].as_str().unwrap()];
        let count = |key: &str| group[key].as_u64().unwrap() as usize;
        assert_eq!(count("cases"), of_file.len(), "{group}");
        assert_eq!(count("fail"), 0, "{group}");
        assert_eq!(count("agree") + count("wait") + count("behaviours"), of_file.len(), "{group}");
        // In the sources every table is at hand: only what waits for a stated reason is not computed.
        let family = |id: &str| id.rsplit_once('-').unwrap().0.to_owned();
        let waits = of_file.iter().filter(|id| WAITING.iter().any(|(name, _)| *name == id.as_str() || *name == family(id))).count();
        assert_eq!(count("wait"), waits, "{group}");
    }
    let read: BTreeSet<&str> = json["cases"].as_array().unwrap().iter().map(|case| case["id"].as_str().unwrap()).collect();
    let all: BTreeSet<&str> = ids.values().flatten().map(String::as_str).collect();
    assert_eq!(read, all);
    the_page_has_every_case_and_loads_nothing(&std::fs::read_to_string(page).unwrap(), &all);
}

fn the_page_has_every_case_and_loads_nothing(page: &str, ids: &BTreeSet<&str>) {
    for id in ids {
        assert!(page.contains(&format!("<td>{id}</td>")), "{id}");
    }
    assert_eq!((page.matches("<svg").count(), page.matches("</svg>").count()), (4, 4));
    assert!(page.contains("prefers-color-scheme") && page.starts_with("<!DOCTYPE html>") && page.trim_end().ends_with("</html>"));
    // Names of vocabularies are the only addresses in it; nothing is fetched.
    let addresses = page.match_indices("http").filter(|(at, _)| !page[..*at].ends_with("xmlns=\"")).count();
    assert_eq!(addresses, 0);
    for outside in ["<script", "<link", "<img", "src=", "href=", "@import", "url(", "<iframe", "<?xml"] {
        assert!(!page.contains(outside), "{outside}");
    }
}

#[test]
fn a_case_of_ones_own_that_is_wrong_fails_and_is_told() {
    let case = |id: &str, reference: &str| {
        format!(
            "{{\"id\": \"{id}\", \"title\": \"<b>photon & energy</b>\", \"quantity\": \"Q\", \"unit\": \"J\", \"rel_tol\": 1e-9, \
             \"reference\": \"{reference}\", \"inputs\": {{\"lambda_vac_nm\": \"555\"}}}}"
        )
    };
    let right = case("g1a.photon-energy-1", "3.57918172459266e-19");
    let wrong = case("g1a.photon-energy-2", "3.57918173e-19");
    let file = scratch("own.json");
    let path = file.to_str().unwrap();
    std::fs::write(&file, format!("{{\"title\": \"own\", \"cases\": [{right}]}}")).unwrap();
    assert_eq!(run(&["--cases", path]).status.code(), Some(0));
    std::fs::write(&file, format!("{{\"title\": \"own\", \"cases\": [{right}, {wrong}]}}")).unwrap();
    let page = scratch("own.html");
    let found = run(&["--cases", path, "--report", page.to_str().unwrap()]);
    assert_eq!(found.status.code(), Some(1));
    assert!(text(&found.stderr).contains("g1a.photon-energy-2: 3.579"), "{}", text(&found.stderr));
    assert!(text(&found.stdout).contains("DEVIATES") && text(&found.stdout).contains("1 of 2 cases fail"));
    let page = std::fs::read_to_string(page).unwrap();
    assert!(page.contains("&lt;b&gt;photon &amp; energy&lt;/b&gt;") && !page.contains("<b>photon"));
    assert_eq!(run(&["--cases", path, "--case", "g1a.photon-energy-1"]).status.code(), Some(0));
}

#[test]
fn a_wrong_reference_fails_in_every_family_that_is_computed() {
    let suite = Suite::built_in(Tables::new()).unwrap();
    let found = suite.run(&Selection::group("g1"), &|| 0.0).unwrap();
    let mut told = 0;
    for check in found.checks.iter().filter(|check| check.found().is_some()) {
        let case = suite.cases().iter().find(|case| case.id() == check.id).unwrap();
        let wrong = suite.check(&case.with_reference(case.reference().unwrap() * 1.01 + 1e-3), &|| 0.0);
        assert!(wrong.fails(), "{}", check.id);
        told += 1;
    }
    assert!(told > 50);
}

/// Without the tables that are not shipped nothing fails and nothing is passed over in silence.
#[test]
fn cases_without_their_tables_wait_and_say_so() {
    let suite = Suite::built_in(Tables::new()).unwrap();
    let found = suite.run(&Selection::group("g2"), &|| 0.0).unwrap();
    assert!(found.passed());
    let waits: Vec<_> = found.checks.iter().filter(|check| matches!(check.verdict, Verdict::Waits(_))).collect();
    assert!((10..40).contains(&waits.len()), "{}", waits.len());
    assert!(waits.iter().all(|check| check.reason().unwrap().contains("_1nm.csv")));
}

#[test]
fn groups_parts_families_and_cases_are_chosen_by_name() {
    for (arguments, cases) in [
        (vec!["--group", "g1e"], 6),
        (vec!["--group", "g1e.sphere"], 6),
        (vec!["--group", "g2"], 171),
        (vec!["--case", "g1e.sphere-2"], 1),
        (vec!["--group", "g1e", "--case", "g1i.polygon-2"], 7),
    ] {
        let found = run(&[&arguments[..], &["--format", "csv"]].concat());
        assert!(found.status.success(), "{arguments:?}: {}", text(&found.stderr));
        let csv = text(&found.stdout);
        assert_eq!(csv.lines().count(), cases + 1, "{arguments:?}");
        assert!(csv.starts_with("id,group,title,quantity,unit,verdict,reference,reading,"));
    }
}

#[test]
fn what_there_is_not_is_told_with_what_there_is() {
    for (arguments, parts) in [
        (vec!["--group", "g2x", "--case", "g1e.sphere-99"], vec!["no group `g2x`", "g2a, g2b", "no case `g1e.sphere-99`", "g1e.sphere-12"]),
        (vec!["--cases", "no-such-file.json"], vec!["there is no file no-such-file.json"]),
        (vec!["--report", "no-such-folder/page.html"], vec!["there is no folder no-such-folder"]),
    ] {
        let found = run(&arguments);
        assert_eq!((found.status.code(), found.stdout.len()), (Some(2), 0), "{arguments:?}");
        for part in parts {
            assert!(text(&found.stderr).contains(part), "`{part}` is not in:\n{}", text(&found.stderr));
        }
    }
}

#[test]
fn every_problem_of_a_file_of_cases_is_told() {
    let problems = |text: &str| Suite::from_files(&[("own.json", text)], Tables::new()).unwrap_err().join("\n");
    assert!(problems("{\n  \"cases\": [,]\n}").contains("own.json:2:13: no JSON"), "{}", problems("{\n  \"cases\": [,]\n}"));
    assert!(problems("{}").contains("no cases"));
    let bad = problems(
        r#"{"cases": [
        {"id": "g1e.spere-1", "title": "t", "quantity": "E", "unit": "lx", "reference": "1", "rel_tol": 1e-9, "inputs": {}},
        {"id": "g1e.sphere-1", "title": "t", "quantity": "E", "unit": "lx", "reference": "1", "rel_tol": -1, "inputs": {}},
        {"id": "g1e.sphere-2", "title": "t", "unit": "lx", "reference": 5, "inputs": []},
        {"id": "g1e.sphere-3", "title": "t", "quantity": "E", "unit": "lx", "reference": "NaN", "abs_tol": 1, "inputs": {}},
        {"id": "g1e.sphere-5", "title": "t", "quantity": "E", "unit": "lx", "reference": "1", "inputs": {}},
        {"id": "g1e.sphere-4", "title": "t", "quantity": "E", "unit": "lx", "reference": "1", "abs_tol": 1, "inputs": {}},
        {"id": "g1e.sphere-4", "title": "t", "quantity": "E", "unit": "lx", "reference": "1", "abs_tol": 1, "inputs": {}}]}"#,
    );
    for part in [
        "no family `g1e.spere`; did you mean `g1e.sphere`?",
        "g1e.sphere-1: `rel_tol` is -1",
        "g1e.sphere-2: `quantity` is missing",
        "g1e.sphere-2: `reference` is 5",
        "g1e.sphere-5: neither `rel_tol` nor `abs_tol`",
        "`inputs` is missing or no record",
        "g1e.sphere-3: `reference` is \"NaN\"",
        "a case of this id is there already",
    ] {
        assert!(bad.contains(part), "`{part}` is not in:\n{bad}");
    }
    // An input that is missing is the failure of that case alone.
    let one =
        r#"{"cases": [{"id": "g1e.sphere-4", "title": "t", "quantity": "E", "unit": "lx", "reference": "1", "abs_tol": 1, "inputs": {}}]}"#;
    let suite = Suite::from_files(&[("own.json", one)], Tables::new()).unwrap();
    let check = suite.check(&suite.cases()[0], &|| 0.0);
    assert!(check.fails() && check.reason().unwrap().contains("has no input"), "{check:?}");
}
