//! A file of readings carries all that is needed to repeat it.

use std::fs;
use std::path::{Path, PathBuf};

use crate::program::{BOX, done, etendue, name, refused, scratch, stderr, stdout};

fn measured(folder: &Path, options: &[&str]) -> PathBuf {
    let file = folder.join("readings.json");
    fs::write(&file, done(&[&["measure", "--format", "json"], options].concat())).unwrap();
    file
}

#[test]
fn readings_repeat_bit_for_bit() {
    let folder = scratch("repeat");
    for options in [
        &[BOX, "--samples", "4096"][..],
        &[BOX, "--target", "2%", "--seed", "18446744073709551615", "--threads", "1"],
        &[BOX, "--target", "5%", "--naive"],
        &[BOX, "--samples", "1000", "--without", "behind_horizon", "--without", "nothing_blocks"],
        &["scenes/photometric-bench.ron"],
        // Ended by the clock, on whatever machine this is.
        &[BOX, "--budget", "150ms"],
        &["scenes/office.ron", "--budget", "300ms", "--target", "0.5%"],
    ] {
        let file = measured(&folder, options);
        let said = done(&["repeat", name(&file), "--threads", "2"]);
        assert!(said.contains("readings agree, bit for bit"), "{options:?}: {said}");
    }
}

#[test]
fn an_edited_reading_is_told() {
    let folder = scratch("repeat-edited");
    let file = measured(&folder, &[BOX, "--samples", "1024"]);
    let text = fs::read_to_string(&file).unwrap();
    for key in ["value", "standard_uncertainty", "expanded_uncertainty"] {
        let at = text.find(&format!("\"{key}\": ")).unwrap() + key.len() + 4;
        let end = at + text[at..].find(',').unwrap();
        // The last bit.
        let number: f64 = text[at..end].parse().unwrap();
        fs::write(&file, format!("{}{:?}{}", &text[..at], number.next_up(), &text[end..])).unwrap();
        let output = etendue(&["repeat", name(&file)]);
        assert_eq!(output.status.code(), Some(1), "{key}");
        assert!(stdout(&output).contains("1 of 4 readings differ"), "{}", stdout(&output));
        assert!(stdout(&output).contains(" then, ") && stderr(&output).contains("the file was edited"), "{}", stderr(&output));
    }
}

#[test]
fn another_scene_or_version_is_told() {
    let folder = scratch("repeat-other");
    let file = measured(&folder, &["scenes/photometric-bench.ron"]);
    let text = fs::read_to_string(&file).unwrap();
    let version = format!("\"version\": \"{}\"", env!("CARGO_PKG_VERSION"));
    assert!(text.contains(&version));
    fs::write(&file, text.replace(&version, "\"version\": \"0.0.1\"")).unwrap();
    let output = etendue(&["repeat", name(&file)]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(stderr(&output).contains("warning: version: ") && stderr(&output).contains("0.0.1 in the file"), "{}", stderr(&output));
    // The file names the bench; what lies elsewhere is another scene.
    fs::write(&file, text).unwrap();
    let output = etendue(&["repeat", name(&file), "--scene", "scenes/cosine-law.ron"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(stderr(&output).contains("warning: scene (a hash of all its files)"), "{}", stderr(&output));
}

#[test]
fn files_that_cannot_be_repeated_are_told() {
    let folder = scratch("repeat-bad");
    let file = measured(&folder, &[BOX, "--budget", "50ms"]);
    let text = fs::read_to_string(&file).unwrap();
    let without_rounds = {
        let at = text.find("\"rounds\"").unwrap();
        let comma = text[..at].rfind(',').unwrap();
        let end = at + text[at..].find(']').unwrap() + 1;
        format!("{}{}", &text[..comma], &text[end..])
    };
    for (content, words) in [
        ("", "line 1"),
        ("{}", "missing field"),
        ("Scene()", "line 1"),
        (&text[..text.len() / 2], "line"),
        (&text.replace("\"schema\": 1", "\"schema\": 99"), "schema is 99"),
        (&without_rounds, "`rounds` does not say when"),
        (&text.replace("\"budget_seconds\": 0.05", "\"budget_seconds\": null"), "nothing would end the run"),
        (&text.replace("\"budget_seconds\": 0.05", "\"budget_seconds\": -1.0"), "not positive"),
        (&text.replace("\"scene_hash\": \"", "\"scene_hash\": \"x"), "16 hexadecimal digits"),
        (&text.replace(BOX, "scenes/not-there.ron"), "--scene FILE"),
        (&text.replace("\"without\": []", "\"without\": [\"all of them\"]"), "all of them"),
    ] {
        fs::write(&file, content).unwrap();
        let message = refused(&["repeat", name(&file)]);
        assert!(message.contains(words), "no `{words}` in\n{message}");
        assert_eq!(fs::read_to_string(&file).unwrap(), content);
    }
    assert!(refused(&["repeat", name(&folder)]).contains("it is not a file"));
    assert!(refused(&["repeat", name(&folder.join("missing"))]).contains("missing"));
}
