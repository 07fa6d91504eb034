//! The rules of the front page, read off the sources: imports point down, foreign crates come in through their doors, files stay
//! short, nothing is unsafe outside its one file, headers are complete.

use std::fs;
use std::path::{Path, PathBuf};

/// Most lines of a file.
const LONGEST: usize = 400;

const LAYERS: [(&str, usize); 19] = [
    ("quantity", 0),
    ("metrology", 0),
    ("math", 0),
    ("naming", 0),
    ("spectrum", 1),
    ("geometry", 1),
    ("source", 2),
    ("surface", 2),
    ("observer", 2),
    ("lecture", 7),
    ("sensor", 2),
    ("scene", 3),
    ("plan", 4),
    ("estimate", 5),
    ("measurement", 6),
    ("calibration", 7),
    ("characterization", 7),
    ("study", 8),
    ("report", 9),
];

/// Where a foreign crate may be named.
const DOORS: [(&str, &[&str]); 20] = [
    ("nalgebra", &["src/calibration/"]),
    ("clarabel", &["src/calibration/non_negative.rs"]),
    ("glam", &["src/math/mod.rs"]),
    ("obvhs", &["src/geometry/bvh/"]),
    ("statrs", &["src/metrology/distribution"]),
    ("rayon", &["src/estimate/run.rs"]),
    ("multiversion", &["src/estimate/", "src/spectrum/kernel.rs"]),
    (
        "serde",
        &[
            "src/report/json.rs",
            "src/report/emva/json.rs",
            "src/report/calibration/json.rs",
            "src/report/lecture/json.rs",
            "src/report/spectrum/json.rs",
            "src/report/verify/json.rs",
            "src/report/convergence/json.rs",
            "src/report/convergence/campaign_json.rs",
            "src/report/stability/json.rs",
            "src/report/coverage/json.rs",
            "src/report/savings/json.rs",
            "src/report/datasheet/json.rs",
        ],
    ),
    (
        "serde_json",
        &[
            "src/report/json.rs",
            "src/report/emva/json.rs",
            "src/report/calibration/json.rs",
            "src/report/lecture/json.rs",
            "src/report/spectrum/json.rs",
            "src/report/verify/json.rs",
            "src/report/convergence/json.rs",
            "src/report/convergence/campaign_json.rs",
            "src/report/stability/json.rs",
            "src/report/coverage/json.rs",
            "src/report/savings/json.rs",
            "src/report/datasheet/json.rs",
            "src/study/verify/",
        ],
    ),
    // Only the oracle of a test, and tests are no doors.
    ("ron", &["tests"]),
    (
        "csv",
        &[
            "src/report/csv.rs",
            "src/report/spectrum/",
            "src/report/verify/csv.rs",
            "src/report/convergence/",
            "src/report/stability/csv.rs",
            "src/report/coverage/csv.rs",
            "src/report/savings/csv.rs",
        ],
    ),
    (
        "thiserror",
        &[
            "src/spectrum/error.rs",
            "src/spectrum/library.rs",
            "src/observer/error.rs",
            "src/geometry/mesh/error.rs",
            "src/geometry/polygon/mod.rs",
            "src/scene/diagnostic.rs",
            "src/plan/check.rs",
            "src/estimate/mod.rs",
            "src/estimate/journal/recording.rs",
            "src/report/plot/error.rs",
            "src/report/image/error.rs",
            "src/characterization/emva/error.rs",
            "src/characterization/traced_field.rs",
        ],
    ),
    ("roxmltree", &["src/spectrum/spdx/"]),
    ("plotters", &["src/report/plot/"]),
    ("resvg", &["src/report/plot/"]),
    ("png", &["src/report/image/png.rs"]),
    ("tiff", &["src/report/image/tiff.rs"]),
    ("exr", &["src/report/image/exr.rs"]),
    ("clap", &["src/bin/etendue/"]),
    ("indicatif", &["src/bin/etendue/"]),
];

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn files_below(folder: &str, extension: &str) -> Vec<(String, String)> {
    fn walk(at: &Path, extension: &str, found: &mut Vec<PathBuf>) {
        let Ok(entries) = fs::read_dir(at) else { return };
        for path in entries.flatten().map(|e| e.path()) {
            if path.is_dir() {
                walk(&path, extension, found);
            } else if path.extension().is_some_and(|e| e == extension) {
                found.push(path);
            }
        }
    }
    let mut paths = Vec::new();
    walk(&root().join(folder), extension, &mut paths);
    paths.sort();
    assert!(!paths.is_empty(), "no .{extension} below {folder}");
    let name = |p: &Path| p.strip_prefix(root()).expect("below the root").to_string_lossy().replace('\\', "/");
    paths.iter().map(|p| (name(p), fs::read_to_string(p).expect("readable"))).collect()
}

/// Lines of code without comments.
fn code(text: &str) -> impl Iterator<Item = (usize, &str)> {
    text.lines().enumerate().map(|(i, l)| (i + 1, l.split("//").next().unwrap_or(""))).filter(|(_, l)| !l.trim().is_empty())
}

/// What would be a door out of the library: files, the environment, clocks, screens, state that all share.
const OUTSIDE: [&str; 8] = ["std::fs", "std::env", "Instant", "SystemTime", "println!", "eprintln!", "print!", "static mut"];

/// The first of [`OUTSIDE`] that a line of code names, also out of a list such as `use std::{env, fs};`.
fn reaches_outside(line: &str) -> Option<&'static str> {
    let part_of_name = |c: char| c.is_alphanumeric() || c == '_';
    let named = |what: &str, whole: &str| {
        whole.match_indices(what).any(|(at, _)| {
            !whole[..at].ends_with(part_of_name) && (what.ends_with('!') || !whole[at + what.len()..].starts_with(part_of_name))
        })
    };
    let listed = line.find("std::{").map_or("", |at| &line[at + 6..]);
    OUTSIDE.into_iter().find(|what| named(what, line) || what.strip_prefix("std::").is_some_and(|module| named(module, listed)))
}

fn layer_of(module: &str) -> Option<usize> {
    LAYERS.iter().find(|(name, _)| *name == module).map(|(_, layer)| *layer)
}

/// Words of a line, cut at everything that is not part of a name.
fn mentions(line: &str, path: &str) -> Vec<String> {
    line.match_indices(path)
        .filter(|(at, _)| !line[..*at].ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == ':'))
        .map(|(at, _)| line[at + path.len()..].chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect())
        .collect()
}

#[test]
fn imports_point_down() {
    let mut wrong = Vec::new();
    for (file, text) in files_below("src", "rs") {
        let Some(own) = file.strip_prefix("src/").and_then(|f| f.split('/').next()).map(|f| f.trim_end_matches(".rs")) else { continue };
        let Some(own_layer) = layer_of(own) else { continue };
        for (line, content) in code(&text) {
            for module in mentions(content, "crate::") {
                let Some(layer) = layer_of(&module) else { continue };
                if module != own && layer >= own_layer {
                    wrong.push(format!("{file}:{line}: `{own}` (layer {own_layer}) names `{module}` (layer {layer})"));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "imports that do not point down:\n{}", wrong.join("\n"));
}

#[test]
fn every_module_has_a_layer() {
    let front = fs::read_to_string(root().join("src/lib.rs")).expect("readable");
    for module in front.lines().filter_map(|l| l.strip_prefix("pub mod ")).map(|l| l.trim_end_matches(';')) {
        assert!(layer_of(module).is_some(), "`{module}` has no layer here");
        assert!(front.contains(&format!("[`{module}`]")), "`{module}` is not in the table of the front page");
    }
}

#[test]
fn foreign_crates_come_in_through_their_doors() {
    let mut wrong = Vec::new();
    for (file, text) in files_below("src", "rs") {
        for (line, content) in code(&text) {
            for (name, doors) in DOORS {
                let used = !mentions(content, &format!("{name}::")).is_empty() || content.trim_start().starts_with(&format!("use {name};"));
                // `serde_json` in tests that read reference cases is no door: tests are not shipped.
                let test = file.ends_with("tests.rs") || file.contains("/tests/");
                // A module of ours may bear the name of a crate.
                let ours = content.contains(&format!("::{name}::"))
                    || file.starts_with("src/bin/") && name == "csv"
                    || content.contains("use super::");
                if used && !test && !ours && !doors.iter().any(|door| file.starts_with(door)) {
                    wrong.push(format!("{file}:{line}: `{name}` belongs to {}", doors.join(", ")));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "foreign crates outside their doors:\n{}", wrong.join("\n"));
}

#[test]
fn files_stay_short() {
    let long: Vec<String> = files_below("src", "rs")
        .iter()
        .map(|(file, text)| (file, text.lines().count()))
        .filter(|(_, lines)| *lines > LONGEST)
        .map(|(file, lines)| format!("{file}: {lines} lines"))
        .collect();
    assert!(long.is_empty(), "longer than {LONGEST} lines:\n{}", long.join("\n"));
}

#[test]
fn nothing_is_unsafe_outside_one_file() {
    let words = |line: &str| line.split(|c: char| !(c.is_alphanumeric() || c == '_')).any(|w| w == "unsafe");
    let found: Vec<String> =
        files_below("src", "rs").iter().filter(|(_, text)| code(text).any(|(_, l)| words(l))).map(|(file, _)| file.clone()).collect();
    assert_eq!(found, ["src/geometry/bvh/avx2.rs"]);
}

#[test]
fn the_library_reaches_nothing_outside() {
    let examples = [
        "use std::fs;",
        "let t = Instant::now();",
        "use std::{collections::BTreeMap, env};",
        "static mut COUNT: u32 = 0;",
        "    eprintln!();",
    ];
    for line in examples {
        assert!(reaches_outside(line).is_some(), "{line}");
    }
    for line in ["let instant = Instantaneous;", "env!(\"CARGO_PKG_VERSION\")", "use std::fmt;", "let offset = std::f64::consts::PI;"] {
        assert_eq!(reaches_outside(line), None, "{line}");
    }
    let mut wrong = Vec::new();
    for (file, text) in files_below("src", "rs") {
        let test = file.ends_with("tests.rs") || file.contains("/tests/");
        if test || file.starts_with("src/bin/") {
            continue;
        }
        // Tests stand at the end of their file.
        let shipped = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
        let found = code(shipped).filter_map(|(line, content)| Some(format!("{file}:{line}: {}", reaches_outside(content)?)));
        wrong.extend(found);
    }
    assert!(wrong.is_empty(), "the library opens no file, reads no clock and prints nothing:\n{}", wrong.join("\n"));
}

#[test]
fn every_source_file_says_what_it_is() {
    for (file, text) in files_below("src", "rs") {
        assert!(text.starts_with("//!"), "{file} does not open with a description");
    }
}

#[test]
fn every_sensor_and_scene_has_a_header() {
    for folder in ["sensors", "scenes"] {
        for (file, text) in files_below(folder, "ron") {
            let header: Vec<&str> = text.lines().take_while(|l| l.starts_with("//")).collect();
            assert!(header.len() >= 3, "{file}: a header says what it is, what it shows and what to expect");
            assert!(header.join(" ").contains("What it shows:"), "{file}: the header has no line `What it shows:`");
        }
    }
    for (file, text) in files_below("sensors", "csv") {
        let header = text.lines().take_while(|l| l.starts_with('#')).collect::<Vec<_>>().join("\n");
        for key in ["name:", "source:", "licence:"] {
            assert!(header.contains(key), "{file}: the header has no `{key}`");
        }
    }
}

#[test]
fn every_table_has_its_pedigree() {
    for (file, text) in files_below("data", "csv") {
        let header = text.lines().take_while(|l| l.starts_with('#')).collect::<Vec<_>>().join("\n");
        for key in ["name:", "quantity:", "unit:", "range:", "step:", "interpolation:", "source:", "licence:", "prepared_by:", "sha256:"] {
            assert!(header.contains(key), "{file}: the header has no `{key}`");
        }
    }
}
