//! An independent judge: the Python package emva1288 reads frames that `etendue photon-transfer` wrote and finds what was put in.
//!
//! The package is installed once into a virtual environment below the target folder. Where there is no Python, or the package cannot be had,
//! the test says so and is skipped.

#![cfg(all(feature = "cli", feature = "image"))]
#![allow(clippy::unwrap_used, clippy::print_stderr)]

use std::path::{Path, PathBuf};
use std::process::Command;

use etendue::scene::{MemoryFiles, pixel_from_file};
use serde_json::{Value, json};

/// The version that the comparison was written for.
const PACKAGE: &str = "emva1288==1.0.2";
/// How long an installation may wait for an answer of the network, s.
const PATIENCE_S: &str = "15";
const PIXEL: &str = "sensors/pixels/monochrome-12-bit.ron";
const EFFICIENCY: f64 = 0.6;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A Python that has the package; why there is none.
fn python() -> Result<PathBuf, String> {
    let home = Path::new(env!("CARGO_TARGET_TMPDIR")).join("emva1288-1.0.2");
    let (python, done) = (home.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" }), home.join("installed"));
    if done.exists() {
        return Ok(python);
    }
    run(Command::new("python3").args(["-m", "venv", "--clear"]).arg(&home))?;
    let options = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--prefer-binary", "--retries", "1", "--timeout"];
    run(Command::new(&python).args(options).args([PATIENCE_S, PACKAGE]))?;
    run(Command::new(&python).args(["-c", "import emva1288"]))?;
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

/// The command with a flat field and a pixel, in the folder of the project.
fn photon_transfer(arguments: &[&str]) -> std::process::Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_etendue"));
    command.args(["photon-transfer", PIXEL, "--scene", "scenes/flat-field.ron", "--pitch-um", "5"]);
    command.args(arguments).current_dir(root()).output().unwrap()
}

/// The flat field is traced: by default the plan would have it by its formula.
#[test]
fn the_package_finds_what_was_put_in() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("emva1288-frames");
    let _ = std::fs::remove_dir_all(&folder);
    let efficiency = EFFICIENCY.to_string();
    let output = photon_transfer(&["--naive", "--quantum-efficiency", &efficiency, "--format", "json", "--out", folder.to_str().unwrap()]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let figures: Value = serde_json::from_slice(&output.stdout).unwrap();

    let text = std::fs::read_to_string(root().join(PIXEL)).unwrap();
    let pixel = pixel_from_file("pixel.ron", &MemoryFiles::new().with("pixel.ron", text)).unwrap();
    let at = figures["saturation_index"].as_u64().unwrap() as usize;
    let exposure_s = figures["photon_transfer"][at]["exposure_s"].as_f64().unwrap();
    let truth = json!({
        "gain_dn_per_e": pixel.gain_dn_per_e, "quantum_efficiency": EFFICIENCY, "read_noise_e": pixel.read_noise_e, "dsnu_e": pixel.dsnu_e,
        "prnu": pixel.prnu, "dark_current_e_s": pixel.dark_current_e_s,
        "saturation_e": pixel.linear(exposure_s, pixel.reference_temperature_c).saturation_e(),
    });
    // Our own figures first: each of them within four of its standard uncertainties.
    for (key, expected) in truth.as_object().unwrap() {
        let name = match key.as_str() {
            "read_noise_e" => "dark_noise_e",
            other => other,
        };
        let of = |field: &str| figures["figures"][name][field].as_f64().unwrap();
        let deviation = (of("value") - expected.as_f64().unwrap()) / of("standard_uncertainty");
        assert!(deviation.abs() < 4.0, "{name}: {deviation} u");
    }

    let python = match python() {
        Ok(python) => python,
        Err(why) => {
            eprintln!("skipped: {PACKAGE} cannot be had here:\n{why}");
            return;
        }
    };
    let [figures_file, truth_file] = ["figures.json", "truth.json"].map(|name| folder.join(name));
    std::fs::write(&figures_file, &output.stdout).unwrap();
    std::fs::write(&truth_file, truth.to_string()).unwrap();
    let judged = Command::new(python)
        .arg(root().join("tests/judged_by_emva1288.py"))
        .args([folder.join("emva1288.txt"), figures_file, truth_file])
        .output()
        .unwrap();
    let words = String::from_utf8_lossy(&judged.stdout);
    eprintln!("{}", words.trim_end());
    assert!(judged.status.success(), "{words}\n{}", String::from_utf8_lossy(&judged.stderr));
    let count: usize = words.lines().last().and_then(|line| line.split(' ').next()).and_then(|word| word.parse().ok()).unwrap();
    assert!(count >= 18, "{words}");
}

#[test]
fn the_table_shows_every_figure_with_its_uncertainty() {
    let small = ["--quantum-efficiency", "0.6", "--size", "32", "--levels", "30", "--stack", "8"];
    let output = photon_transfer(&small);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    for part in ["quantum efficiency", "K", "DN/e⁻", "DSNU", "PRNU", "μ_e.sat", "U (k = 2)", "not checked against the text of the standard"]
    {
        assert!(text.contains(part), "`{part}` is not in:\n{text}");
    }
    // The same seed gives the same bits, another one others.
    assert_eq!(photon_transfer(&[&small[..], &["--threads", "1"]].concat()).stdout, text.as_bytes());
    assert_ne!(photon_transfer(&[&small[..], &["--seed", "1"]].concat()).stdout, text.as_bytes());
}

#[test]
fn what_cannot_be_done_is_told() {
    let said = |arguments: &[&str], scene: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_etendue"));
        command.args(["photon-transfer", PIXEL, "--scene", scene, "--pitch-um", "5"]).args(arguments).current_dir(root());
        let output = command.output().unwrap();
        assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{arguments:?}");
        String::from_utf8(output.stderr).unwrap()
    };
    let flat = "scenes/flat-field.ron";
    assert!(said(&["--quantum-efficiency", "60"], flat).contains("above 0 to 1, such as 0.6"));
    assert!(said(&["--quantum-efficiency", "0.6", "--instrument", "pixle"], flat).contains("allowed: `pixel`"));
    let words = said(&["--quantum-efficiency", "0.6"], "scenes/photometric-bench.ron");
    assert!(words.contains("no instrument of the scene counts photons") && words.contains("reads: PhotonIrradiance"), "{words}");
    assert!(said(&["--quantum-efficiency", "0.6", "--out", "Cargo.toml"], flat).contains("--out takes a folder"));
}
