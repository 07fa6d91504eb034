//! `etendue list` as a user meets it: what is on stdout, what is on stderr, and the exit code.

#![allow(clippy::unwrap_used)]

use std::process::{Command, Output};

use etendue::spectrum::library::{self, Group, entries_in};

fn list(arguments: &[&str], folder: &str) -> Output {
    Command::new(env!("CARGO_BIN_EXE_etendue")).arg("list").args(arguments).current_dir(folder).output().unwrap()
}

fn here(arguments: &[&str]) -> String {
    let output = list(arguments, env!("CARGO_MANIFEST_DIR"));
    assert!(output.status.success() && output.stderr.is_empty(), "{arguments:?}");
    String::from_utf8(output.stdout).unwrap()
}

const GROUPS: [(&str, Group); 5] = [
    ("observers", Group::Observer),
    ("illuminants", Group::Illuminant),
    ("reflectances", Group::Reflectance),
    ("responsivities", Group::Responsivity),
    ("components", Group::Component),
];

#[test]
fn without_a_group_all_groups_are_counted() {
    let text = here(&[]);
    for (name, group) in GROUPS {
        let row = text.lines().find(|line| line.starts_with(name)).unwrap();
        assert_eq!(row.split_whitespace().nth(1).unwrap(), entries_in(group).count().to_string(), "{row}");
    }
    assert!(text.lines().any(|line| line.starts_with("sensors")));
}

#[test]
fn every_name_of_a_list_is_a_name_of_the_library() {
    for (name, group) in GROUPS {
        let json: serde_json::Value = serde_json::from_str(&here(&[name, "--format", "json"])).unwrap();
        let rows = json.as_array().unwrap();
        assert_eq!(rows.len(), entries_in(group).count());
        for row in rows {
            let entry = library::entry(row["name"].as_str().unwrap()).unwrap();
            assert_eq!(row["from_nm"].as_f64(), Some(entry.range_nm.0), "{}", entry.name);
            assert_eq!(row["unit"].as_str(), Some(entry.unit.as_str()));
            assert_eq!(row["aliases"].as_array().unwrap().len(), entry.aliases.len());
        }
        let text = here(&[name]);
        assert_eq!(text.lines().count(), rows.len() + 1, "a header and a line an entry");
        for (line, entry) in text.lines().skip(1).zip(entries_in(group)) {
            assert!(line.starts_with(&entry.name), "{line}");
        }
    }
}

#[test]
fn the_csv_list_is_a_table() {
    let text = here(&["illuminants", "--format", "csv"]);
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), entries_in(Group::Illuminant).count());
    assert!(rows.iter().any(|row| &row[0] == "FL11" && row[1].contains("TL84")));
}

#[test]
fn sensors_are_the_files_of_the_nearest_folder() {
    let text = here(&["sensors"]);
    let line = text.lines().find(|line| line.starts_with("sensors/ideal-illuminance-meter.ron")).unwrap();
    assert!(line.contains("Ideal illuminance meter"), "{line}");
    let inside = list(&["sensors"], &format!("{}/scenes", env!("CARGO_MANIFEST_DIR")));
    assert_eq!(String::from_utf8(inside.stdout).unwrap(), text, "the folder above is found");
    let nowhere = list(&["sensors"], "/");
    if !std::path::Path::new("/sensors").exists() {
        assert_eq!(nowhere.status.code(), Some(2));
        assert!(nowhere.stdout.is_empty() && String::from_utf8(nowhere.stderr).unwrap().contains("sensors"));
    }
}

#[test]
fn a_misspelt_group_is_told_the_nearest_one() {
    let output = list(&["observrs"], env!("CARGO_MANIFEST_DIR"));
    assert_eq!(output.status.code(), Some(2));
    assert!(output.stdout.is_empty());
    assert!(String::from_utf8(output.stderr).unwrap().contains("'observers'"));
}
