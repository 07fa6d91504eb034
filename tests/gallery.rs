//! The pictures of `docs/plots/` are what its commands draw.
#![cfg(feature = "plot")]

use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Words of a command line; quotes keep blanks together.
fn words(line: &str) -> Vec<String> {
    let quoted = line.split('"').enumerate();
    quoted
        .flat_map(|(i, part)| if i % 2 == 1 { vec![part.to_owned()] } else { part.split_whitespace().map(str::to_owned).collect() })
        .collect()
}

/// A picture as text without its numbers, and its numbers.
fn taken_apart(svg: &str) -> (String, Vec<f64>) {
    let (mut text, mut numbers) = (String::new(), Vec::new());
    let mut rest = svg;
    while let Some(at) = rest.find(|c: char| c.is_ascii_digit()) {
        text.push_str(&rest[..at]);
        let end = rest[at..].find(|c: char| !(c.is_ascii_digit() || c == '.')).map_or(rest.len(), |length| at + length);
        numbers.extend(rest[at..end].trim_end_matches('.').parse::<f64>().ok());
        rest = &rest[end..];
    }
    (text + rest, numbers)
}

#[test]
fn the_pictures_are_what_their_commands_draw() {
    let page = std::fs::read_to_string(root().join("docs/plots/README.md")).expect("docs/plots/README.md");
    let commands: Vec<&str> = page.lines().filter_map(|line| line.strip_prefix("    etendue ")).collect();
    assert!(commands.len() >= 20, "{} commands", commands.len());
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("gallery");
    std::fs::create_dir_all(&folder).expect("a folder");
    for command in commands {
        let mut arguments = words(command);
        let kept = arguments.pop().expect("a file");
        let drawn = folder.join(Path::new(&kept).file_name().expect("a name"));
        let output = Command::new(env!("CARGO_BIN_EXE_etendue")).current_dir(root()).args(&arguments).arg(&drawn).output().expect("runs");
        assert!(output.status.success(), "{command}: {}", String::from_utf8_lossy(&output.stderr));
        let [(kept_text, kept_numbers), (text, numbers)] =
            [root().join(&kept), drawn].map(|path| taken_apart(&std::fs::read_to_string(path).expect("a picture")));
        assert_eq!(kept_text, text, "{kept}: draw the pictures again by the commands of docs/plots/README.md");
        // Mathematical libraries differ in the last bit, and coordinates are rounded to a sixteenth of a pixel.
        let apart = kept_numbers.iter().zip(&numbers).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(kept_numbers.len() == numbers.len() && apart <= 1.0, "{kept}: numbers are {apart} apart");
        // Every picture of the page is shown on it.
        let name = Path::new(&kept).file_name().expect("a name").to_string_lossy().into_owned();
        assert!(page.contains(&format!("=\"{name}\"")), "{name} is not shown");
    }
}
