//! An independent route: `tests/colour_science.py` compares `etendue spectrum` with the Python package colour-science.
//!
//! The package is installed once into a virtual environment below the target folder. Where there is no Python, or the package cannot be had,
//! the test says so and is skipped.

#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, clippy::print_stderr)]

mod python;

use std::path::Path;
use std::process::Command;

/// The version that the tolerances were stated for.
const PACKAGE: &str = "colour-science==0.4.7";
#[test]
fn spectra_agree_with_colour_science() {
    let python = match python::python_with(PACKAGE, "colour") {
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
