//! An independent judge: the Python package emva1288 reads frames that `etendue photon-transfer` wrote and finds what was put in.
//!
//! The package is installed once into a virtual environment below the target folder. Where there is no Python, or the package cannot be had,
//! the test says so and is skipped.

#![cfg(all(feature = "cli", feature = "image"))]
#![allow(clippy::unwrap_used, clippy::print_stderr)]

mod disk;
mod python;

use std::path::Path;
use std::process::Command;

use etendue::scene::{MemoryFiles, pixel_from_file, read_scene};
use etendue::sensor::Pixel;
use etendue::spectrum::photometry::{WavelengthsIn, photons_per_joule};
use serde_json::{Value, json};

/// The version that the comparison was written for.
const PACKAGE: &str = "emva1288==1.0.2";
const PIXEL: &str = "sensors/pixels/monochrome-12-bit.ron";
const CAMERA: &str = "scenes/flat-field-of-a-camera.ron";

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The command with a flat field and a pixel, in the folder of the project.
fn photon_transfer(arguments: &[&str]) -> std::process::Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_etendue"));
    command.args(["photon-transfer", PIXEL, "--scene", "scenes/flat-field.ron", "--pitch-um", "5"]);
    command.args(arguments).current_dir(root()).output().unwrap()
}

/// What was put in, as the script reads it.
fn truth(pixel: &Pixel, efficiency: f64, temperature_c: f64, figures: &Value) -> Value {
    let at = figures["saturation_index"].as_u64().unwrap() as usize;
    let exposure_s = figures["photon_transfer"][at]["exposure_s"].as_f64().unwrap();
    json!({
        "gain_dn_per_e": pixel.gain_dn_per_e, "quantum_efficiency": efficiency, "read_noise_e": pixel.read_noise_e, "dsnu_e": pixel.dsnu_e,
        "prnu": pixel.prnu, "dark_current_e_s": pixel.dark_current_at(temperature_c),
        "saturation_e": pixel.linear(exposure_s, temperature_c).saturation_e(),
    })
}

/// Our own figures: each of them within four of its standard uncertainties.
fn assert_found(figures: &Value, truth: &Value) {
    for (key, expected) in truth.as_object().unwrap() {
        let name = match key.as_str() {
            "read_noise_e" => "dark_noise_e",
            other => other,
        };
        let of = |field: &str| figures["figures"][name][field].as_f64().unwrap();
        let deviation = (of("value") - expected.as_f64().unwrap()) / of("standard_uncertainty");
        assert!(deviation.abs() < 4.0, "{name}: {deviation} u");
    }
}

fn etendue(arguments: &[&str]) -> std::process::Output {
    Command::new(env!("CARGO_BIN_EXE_etendue")).args(arguments).current_dir(root()).output().unwrap()
}

/// The camera of the scene writes frames of the light that rays bring it; the package, which knows neither, finds what the camera was made of.
#[test]
fn the_package_finds_what_the_camera_was_made_of() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("emva1288-frames");
    let _ = std::fs::remove_dir_all(&folder);
    let output = etendue(&["photon-transfer", CAMERA, "--format", "json", "--out", folder.to_str().unwrap()]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    // Traced, in two pictures of four samples a pixel at the least; and flat.
    let rays: u64 = said.split_once(" rays;").and_then(|(before, _)| before.rsplit(' ').next()).and_then(|n| n.parse().ok()).unwrap();
    assert!(rays >= 2 * 4 * 128 * 128 && !said.contains("found as part of the PRNU"), "{said}");
    let figures: Value = serde_json::from_slice(&output.stdout).unwrap();

    let scene = read_scene(CAMERA, &disk::Repository, None).unwrap_or_else(|problems| panic!("{problems}"));
    let camera = &scene.cameras[0].camera;
    let efficiency = camera.fill_factor * camera.channels[0].quantum_efficiency.at(525.0);
    let truth = truth(&camera.pixel.unwrap(), efficiency, camera.temperature_c, &figures);
    assert_found(&figures, &truth);
    // The photons are those of the closed form: E = π L/(1 + 4 N²) on a pixel; the fall-off over the frame is 1e-5.
    let (photons, time) = (&figures["photon_transfer"][9]["photons"], &figures["photon_transfer"][9]["exposure_s"]);
    let per_joule = photons_per_joule(WavelengthsIn::StandardAir).at(525.0);
    let expected = std::f64::consts::PI * 3.0 / 257.0 * camera.pitch_m.powi(2) * per_joule;
    let found = photons.as_f64().unwrap() / time.as_f64().unwrap();
    assert!((found / expected - 1.0).abs() < 3e-5, "{found} against {expected}");

    let python = match python::python_with(PACKAGE, "emva1288") {
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

/// A bare pixel in the light that an instrument reads; traced, where by default the plan would have it by its formula.
#[test]
fn a_bare_pixel_shows_what_was_put_in() {
    let output = photon_transfer(&["--naive", "--quantum-efficiency", "0.6", "--format", "json"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let figures: Value = serde_json::from_slice(&output.stdout).unwrap();
    let text = std::fs::read_to_string(root().join(PIXEL)).unwrap();
    let pixel = pixel_from_file("pixel.ron", &MemoryFiles::new().with("pixel.ron", text)).unwrap();
    assert_found(&figures, &truth(&pixel, 0.6, pixel.reference_temperature_c, &figures));
}

/// A filter of a mosaic is before all pixels; small frames, other samples and other seeds.
#[test]
fn each_channel_of_a_camera_is_measured() {
    let text = std::fs::read_to_string(root().join("scenes/colour-chart.ron")).unwrap();
    assert!(text.contains("rgb-camera.ron"));
    let words = |arguments: &[&str]| {
        let output = etendue(&[&["photon-transfer", "scenes/colour-chart.ron"], arguments].concat());
        assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{arguments:?}");
        String::from_utf8(output.stderr).unwrap()
    };
    assert!(words(&[]).contains("choose with --channel: R, G, B"));
    assert!(words(&["--channel", "g"]).contains("did you mean `G`?"));
    assert!(words(&["--camera", "cam", "--channel", "G"]).contains("cameras of this scene: `camera`"));
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
    let words = said(&["--quantum-efficiency", "0.6", "--temperature", "500"], flat);
    assert!(words.contains("at 500 °C the dark current") && words.contains("lower temperature"), "{words}");
    let output = etendue(&["photon-transfer", PIXEL]);
    let words = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.code() == Some(2) && words.contains("a pixel alone sees no light") && words.contains("--scene"), "{words}");
}
