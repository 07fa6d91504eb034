//! `etendue expose` as a person runs it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::camera;

/// A folder of its own for a test, gone when the test is.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Folder {
        let path = std::env::temp_dir().join(format!("etendue-expose-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).unwrap();
        Folder(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

const PIXEL: &str = "pixel: Pixel(gain_dn_per_e: 0.25, full_well_e: 14000, bits: 12, black_dn: 64, read_noise_e: 4, dark_current_e_s: 0, dsnu_e: 1, prnu: 0.01),";

fn colour() -> String {
    let channels =
        "[(name: \"R\", quantum_efficiency: 0.3), (name: \"G\", quantum_efficiency: 0.5), (name: \"B\", quantum_efficiency: 0.2)]";
    camera("Thin(focal_length_mm: 8, f_number: 4, focus_m: 1)", [32, 20])
        .replace("[(name: \"grey\", quantum_efficiency: 1)]", channels)
        .replace("pitch_um", "mosaic: Bayer(\"RGGB\"), pitch_um")
        .replace("exposure_ms", &format!("{PIXEL} exposure_ms"))
}

fn scene(model: &str, regions: &str) -> String {
    format!(
        "Scene(sources: [(name: \"panel\", shape: Rectangle(4, 4), at: (0, 1, 0), facing: (0, -1, 0), strength: Luminance(100), spectrum: \"D65\")],
        cameras: [(name: \"cam 1\", camera: {model}, at: (0, 0, 0), facing: (0, 1, 0), regions: {{{regions}}})])"
    )
}

fn run(folder: &Path, scene: &str, arguments: &[&str]) -> Output {
    fs::write(folder.join("s.ron"), scene).unwrap();
    Command::new(env!("CARGO_BIN_EXE_etendue")).current_dir(folder).args(arguments).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn a_picture_is_written_with_all_its_files() {
    let folder = Folder::new("files");
    let text_of_scene = scene(&colour(), "\"middle\": (x: 8, y: 4, width: 8, height: 8)");
    let done = run(&folder.0, &text_of_scene, &["expose", "s.ron", "--out", "pictures", "--frames", "3", "--threads", "2"]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    let out = text(&done.stdout);
    assert!(out.contains("cam 1: middle") && out.contains("e⁻") && out.contains("cd/m²") && out.contains("±"), "{out}");
    let mut names: Vec<String> =
        fs::read_dir(folder.0.join("pictures")).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    let frames = (0..3).map(|n| format!("cam_1-frame-{n:04}.png"));
    let mut expected: Vec<String> =
        ["-expected_e.npy", "-luminance.png", "-luminance_cd_m2.npy", "-preview.png", "-regions.csv", "-uncertainty_e.npy", ".exr"]
            .iter()
            .map(|e| format!("cam_1{e}"))
            .chain(frames)
            .collect();
    expected.sort();
    assert_eq!(names, expected);
    let npy = fs::read(folder.0.join("pictures/cam_1-expected_e.npy")).unwrap();
    assert!(text(&npy[..128]).contains("'shape': (20, 32") && npy.len() == 128 + 8 * 640, "{}", npy.len());
    let read = |name: &str| fs::read(folder.0.join(name)).unwrap();
    assert_ne!(read("pictures/cam_1-frame-0000.png"), read("pictures/cam_1-frame-0001.png"));
    let again = run(&folder.0, &text_of_scene, &["expose", "s.ron", "--out", "again", "--frames", "1", "--threads", "1", "--tiff"]);
    assert!(again.status.success(), "{}", text(&again.stderr));
    assert_eq!(read("again/cam_1-expected_e.npy"), npy);
    assert!(folder.0.join("again/cam_1-frame-0000.tiff").exists());
    // Uniform light: the three channels go as their efficiencies.
    let value = |k: usize| f64::from_le_bytes(npy[128 + 8 * k..136 + 8 * k].try_into().unwrap());
    let (r, g, b) = (value(10 * 32 + 16), value(10 * 32 + 17), value(11 * 32 + 17));
    assert!((r / g - 0.6).abs() < 1e-2 && (b / g - 0.4).abs() < 1e-2, "{r} {g} {b}");
}

#[test]
fn what_cannot_be_exposed_says_what_to_do() {
    let folder = Folder::new("wrong");
    let plain = scene(&camera("Pinhole(distance_mm: 4, diameter_mm: 0.1)", [8, 8]), "");
    let meter = "Scene(instruments: [(name: \"m\", at: (0, 0, 0), facing: (0, 0, 1), sensor: Sensor(aperture: Point, acceptance: Cosine,
        channels: [(name: \"E\", responsivity: 1, reads: Irradiance)]))])";
    let cases: [(&str, &[&str], &str); 5] = [
        (&plain, &["expose", "s.ron", "--out", "o", "--frames", "2"], "has no electronics"),
        (&plain, &["expose", "s.ron", "--out", "o", "--camera", "cam"], "cameras of this scene: `cam 1`"),
        (meter, &["expose", "s.ron", "--out", "o"], "the scene has no camera"),
        (&plain, &["measure", "s.ron"], "`etendue expose s.ron --out DIR` takes the picture"),
        (&plain, &["expose", "s.ron", "--out", "s.ron"], "--out takes a folder"),
    ];
    for (scene, arguments, words) in cases {
        let done = run(&folder.0, scene, arguments);
        assert_eq!(done.status.code(), Some(2), "{arguments:?}: {}", text(&done.stderr));
        assert!(text(&done.stderr).contains(words), "{arguments:?}: {}", text(&done.stderr));
        assert!(!folder.0.join("o").exists(), "{arguments:?}");
    }
    for command in ["check", "explain"] {
        let done = run(&folder.0, &plain, &[command, "s.ron"]);
        assert!(done.status.success() && text(&done.stdout).contains("camera"), "{}", text(&done.stdout));
    }
}
