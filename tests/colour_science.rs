//! An independent route: `tests/colour_science.py` compares `etendue spectrum` with the Python package colour-science.
//!
//! The package is installed once into a virtual environment below the target folder. Where there is no Python, or the package cannot be had,
//! the test says so and is skipped.

#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, clippy::print_stderr)]

use std::path::{Path, PathBuf};
use std::process::Command;

/// The version that the tolerances were stated for.
const PACKAGE: &str = "colour-science==0.4.7";
/// How long an installation may wait for an answer of the network, s.
const PATIENCE_S: &str = "15";

/// A Python that has the package; why there is none.
fn python() -> Result<PathBuf, String> {
    let home = Path::new(env!("CARGO_TARGET_TMPDIR")).join("colour-science-0.4.7");
    let (python, done) = (home.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" }), home.join("installed"));
    if done.exists() {
        return Ok(python);
    }
    run(Command::new("python3").args(["-m", "venv", "--clear"]).arg(&home))?;
    let options = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--prefer-binary", "--retries", "1", "--timeout"];
    run(Command::new(&python).args(options).args([PATIENCE_S, PACKAGE]))?;
    run(Command::new(&python).args(["-c", "import colour"]))?;
    std::fs::write(&done, PACKAGE).map_err(|error| error.to_string())?;
    Ok(python)
}

fn run(command: &mut Command) -> Result<(), String> {
    match command.output() {
        Ok(output) if output.status.success() => Ok(()),
        Ok(output) => Err(String::from_utf8_lossy(&output.stderr).trim().to_owned()),
        Err(error) => Err(format!("{}: {error}", command.get_program().to_string_lossy())),
    }
}

#[test]
fn spectra_agree_with_colour_science() {
    let python = match python() {
        Ok(python) => python,
        Err(why) => {
            eprintln!("skipped: {PACKAGE} cannot be had here:\n{why}");
            return;
        }
    };
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/colour_science.py");
    let output = Command::new(python).arg(script).arg(env!("CARGO_BIN_EXE_etendue")).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    eprintln!("{}", text.trim_end());
    assert!(output.status.success(), "{text}\n{}", String::from_utf8_lossy(&output.stderr));
    // The script compares what it says: at least the sixty quantities that it is for.
    let count: usize = text.lines().last().and_then(|line| line.split(' ').next()).and_then(|word| word.parse().ok()).unwrap();
    assert!(count >= 60, "{text}");
}
