//! Broken files and what is said about them.
//!
//! Each `scenes/NAME.ron` below `tests/diagnostics/` is read as a user would have it read, and the whole message is compared with
//! `scenes/NAME.expected`. With `ETENDUE_REWRITE_EXPECTED=1` the expectations are written anew; read each of them then as a stranger
//! would: what is wrong, where, what is allowed, what to type instead.

#![allow(clippy::unwrap_used)]

mod disk;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use disk::{Folder, files_in, root};
use etendue::scene::{Files, MemoryFiles, read_scene};
use proptest::prelude::*;

fn folder() -> PathBuf {
    root().join("tests/diagnostics")
}

/// Compares a message with its expectation, or writes the expectation. Gives what differs.
fn compare(expectation: &Path, message: &str) -> Option<String> {
    let message = format!("{message}\n");
    if std::env::var_os("ETENDUE_REWRITE_EXPECTED").is_some() {
        fs::write(expectation, &message).unwrap();
        return None;
    }
    let expected = fs::read_to_string(expectation).unwrap_or_default();
    (expected != message).then(|| format!("{}\nexpected:\n{expected}\nfound:\n{message}", expectation.display()))
}

fn message(path: &str, files: &dyn Files) -> String {
    match read_scene(path, files, None) {
        Ok(_) => format!("{path} was read without a problem"),
        Err(problems) => {
            assert!(!problems.0.is_empty() && problems.0.iter().all(|p| p.line >= 1 && p.column >= 1), "{path}");
            problems.to_string()
        }
    }
}

#[test]
fn every_broken_file_gets_its_message() {
    let files = Folder(folder());
    let names = files_in("tests/diagnostics/scenes", &[".ron"]);
    assert!(names.len() >= 45, "only {} broken files", names.len());
    let wrong: Vec<String> = names
        .iter()
        .filter_map(|name| {
            let found = message(&format!("scenes/{name}"), &files);
            compare(&folder().join("scenes").join(name).with_extension("expected"), &found)
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

/// Sensor files that a text names, such as `sensors/x.ron`.
fn sensors_named(text: &str) -> BTreeSet<String> {
    let after = text.match_indices("sensors/").map(|(at, _)| &text[at..]);
    let names = after.filter_map(|rest| Some(rest[..rest.find(['"', '`', ' ', '\\', '\n'])?].to_owned()));
    names.filter(|name| name.ends_with(".ron")).collect()
}

#[test]
fn every_sensor_that_a_help_names_exists() {
    let expected = files_in("tests/diagnostics/scenes", &[".expected"]);
    let helps = expected.iter().flat_map(|name| {
        let text = fs::read_to_string(folder().join("scenes").join(name)).unwrap();
        text.lines().filter(|line| line.starts_with("  = help:")).map(|line| format!("{line}\n")).collect::<Vec<_>>()
    });
    let readers = files_in("src/scene", &["reader.rs"]);
    let sources = readers.iter().map(|name| fs::read_to_string(root().join("src/scene").join(name)).unwrap());
    let named: BTreeSet<String> = helps.chain(sources).flat_map(|text| sensors_named(&text)).collect();
    assert!(!named.is_empty(), "no help names a sensor");
    let missing: Vec<&String> = named.iter().filter(|name| !root().join(name).is_file()).collect();
    assert!(missing.is_empty(), "named in a help, but not there: {missing:?}");
}

#[test]
fn files_that_are_too_long_too_deep_or_no_text_get_their_message() {
    let deep = format!("Scene(sources: {}{})", "[".repeat(100_000), "]".repeat(100_000));
    let made: [(&str, Vec<u8>); 4] = [
        ("too-long", vec![b' '; 17 << 20]),
        ("too-deep", deep.into_bytes()),
        ("not-utf8", b"Scene(\n    title: \"caf\xe9\",\n)\n".to_vec()),
        ("too-deep-without-an-end", "(".repeat(100_000).into_bytes()),
    ];
    let wrong: Vec<String> = made
        .into_iter()
        .filter_map(|(name, bytes)| {
            let path = format!("scenes/{name}.ron");
            let found = message(&path, &MemoryFiles::new().with(&path, bytes));
            compare(&folder().join("made").join(name).with_extension("expected"), &found)
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

#[test]
fn hostile_files_are_answered_with_a_bounded_number_of_problems() {
    let all_on_one_line = |item: &str| format!("Scene(sources: [{}], instruments: [])", item.repeat(200_000 / item.len()));
    for item in [
        "5,",
        "(x:1,),",
        "(name:\"a\",shape:Sphere(1),strength:Watts(1),spectrum:\"A\"),",
        "(name:\"a\",surface:\"b\",shape:Point,at:(0,0,0)),",
    ] {
        let problems = read_scene("x.ron", &MemoryFiles::new().with("x.ron", all_on_one_line(item)), None).unwrap_err();
        assert!((200..=201).contains(&problems.0.len()), "{item} {}", problems.0.len());
        assert!(problems.to_string().ends_with("read the scene again"));
    }
    let long = format!("Scene(sources: [(name: \"{}\", {}: 1)])", "n".repeat(100_000), "k".repeat(100_000));
    let problems = read_scene("x.ron", &MemoryFiles::new().with("x.ron", long), None).unwrap_err();
    assert!(problems.to_string().len() < 10_000);
}

#[test]
fn a_scene_that_is_missing_or_outside_of_its_root_is_told() {
    let nothing = MemoryFiles::new().with("scenes/bench.ron", "");
    assert!(message("scenes/bnech.ron", &nothing).contains("did you mean `bench.ron`"));
    let outside = read_scene("../bench.ron", &nothing, Some("lab")).unwrap_err().to_string();
    assert!(outside.contains("outside of the root `lab`"), "{outside}");
}

/// Files without a problem; what is done to them must never end in a panic.
fn valid_files() -> Vec<(String, Vec<u8>)> {
    let read = |name: &str| (name.to_string(), fs::read(folder().join("valid").join(name)).unwrap());
    [
        "scenes/room.ron",
        "sensors/meter.ron",
        "sensors/lamp.csv",
        "sensors/lamp.spdx",
        "sensors/directional.csv",
        "scenes/tetrahedron.obj",
        "scenes/tetrahedron.ply",
    ]
    .map(read)
    .to_vec()
}

fn result_of(files: Vec<(String, Vec<u8>)>) -> Result<(), String> {
    let files = MemoryFiles(files.into_iter().collect());
    match read_scene("scenes/room.ron", &files, None) {
        Ok(scene) if scene.instruments.is_empty() => Err("a scene without instruments".into()),
        Ok(_) => Ok(()),
        Err(problems) if problems.0.is_empty() => Err("no scene and no problem".into()),
        Err(problems) => {
            let _ = problems.to_string();
            let misplaced = problems.0.iter().find(|p| p.line < 1 || p.column < 1 || p.end_column < p.column || p.message.is_empty());
            misplaced.map_or(Ok(()), |problem| Err(format!("{problem:?}")))
        }
    }
}

#[test]
fn the_valid_files_are_valid() {
    let files = MemoryFiles(valid_files().into_iter().collect());
    if let Err(problems) = read_scene("scenes/room.ron", &files, None) {
        panic!("{problems}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn damaged_files_end_in_a_scene_or_in_problems_with_a_place(
        which in 0..7usize, kind in 0..4u8, at in 0.0..1.0_f64, length in 1..200usize, to in 0.0..1.0_f64, byte: u8,
    ) {
        let mut files = valid_files();
        let bytes = &mut files[which].1;
        let place = |share: f64| ((share * bytes.len() as f64) as usize).min(bytes.len() - 1);
        let (at, to) = (place(at), place(to));
        match kind {
            0 => bytes[at] ^= byte.max(1),
            1 => bytes.truncate(at),
            2 => {
                let slice = bytes[at..(at + length).min(bytes.len())].to_vec();
                bytes.splice(to..to, slice);
            }
            _ => drop(bytes.drain(at..(at + length).min(bytes.len()))),
        }
        prop_assert_eq!(result_of(files), Ok(()));
    }

    #[test]
    fn characters_of_the_notation_in_any_order_are_never_too_much(text in "[()\\[\\]{}:,\"a-zA-Z0-9 .#/*\\\\'_\n-]{0,200}") {
        let scene = format!("Scene({text}");
        let files = vec![("scenes/room.ron".to_string(), scene.into_bytes())];
        prop_assert_eq!(result_of(files), Ok(()));
    }
}
