//! A Python with a package for tests that ask it: installed once into a virtual environment below the target folder.

use std::path::{Path, PathBuf};
use std::process::Command;

/// How long an installation may wait for an answer of the network, s.
const PATIENCE_S: &str = "15";

/// A Python that has a package, such as `colour-science==0.4.7`, which is imported as `module`; why there is none.
pub(crate) fn python_with(package: &str, module: &str) -> Result<PathBuf, String> {
    let home = Path::new(env!("CARGO_TARGET_TMPDIR")).join(package.replace("==", "-"));
    let (python, done) = (home.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" }), home.join("installed"));
    if done.exists() {
        return Ok(python);
    }
    run(Command::new("python3").args(["-m", "venv", "--clear"]).arg(&home))?;
    let options = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--prefer-binary", "--retries", "1", "--timeout"];
    run(Command::new(&python).args(options).args([PATIENCE_S, package]))?;
    run(Command::new(&python).args(["-c", &format!("import {module}")]))?;
    std::fs::write(&done, package).map_err(|error| error.to_string())?;
    Ok(python)
}

fn run(command: &mut Command) -> Result<(), String> {
    match command.output() {
        Ok(output) if output.status.success() => Ok(()),
        Ok(output) => Err(String::from_utf8_lossy(&output.stderr).trim().to_owned()),
        Err(error) => Err(format!("{}: {error}", command.get_program().to_string_lossy())),
    }
}
