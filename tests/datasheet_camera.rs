//! Data sheets of cameras: both routes agree for the shelf, over seeds and pixels; JSON, pictures, bad input.

#![allow(clippy::unwrap_used)]

mod disk;

use disk::Repository;
use etendue::characterization::sheet::SheetError;
use etendue::characterization::sheet::camera::{CameraSheet, Options, camera_sheet};
use etendue::estimate::Watch;
use etendue::report::emva::{sheet_to_json, sheet_to_text};
use etendue::scene::{Device, MemoryFiles, device_from_file};
use etendue::sensor::camera::Camera;

/// Figures that agree deviate by less, in joint standard uncertainties.
const MOST_U: f64 = 4.0;
const SHELF: [(&str, &[&str]); 2] = [("mono-camera.ron", &["grey"]), ("rgb-camera.ron", &["R", "G", "B"])];

fn camera(name: &str) -> Camera {
    match device_from_file(&format!("sensors/{name}"), &Repository, None) {
        Ok(Device::Camera(camera)) => *camera,
        other => panic!("{name}: {other:?}"),
    }
}

fn written(text: &str) -> Camera {
    match device_from_file("camera.ron", &MemoryFiles::new().with("camera.ron", text), None) {
        Ok(Device::Camera(camera)) => *camera,
        other => panic!("{other:?}"),
    }
}

fn sheet_of(camera: &Camera, options: &Options) -> Result<CameraSheet, SheetError> {
    camera_sheet(camera, options, &Watch { now: &|| 0.0, progress: &|_| {} })
}

fn assert_agree(sheet: &CameraSheet) {
    for channel in &sheet.channels {
        for figure in &channel.comparisons {
            let deviation = figure.deviation_u();
            assert!(deviation < MOST_U, "{}, {}: {} deviates by {deviation} u: {figure:?}", sheet.title, channel.name, figure.symbol);
        }
    }
}

#[test]
fn every_figure_of_the_shelf_agrees() {
    for (file, channels) in SHELF {
        let sheet = sheet_of(&camera(file), &Options::default()).unwrap();
        assert_eq!(sheet.channels.iter().map(|channel| channel.name.as_str()).collect::<Vec<_>>(), channels);
        assert!(sheet.channels.iter().all(|channel| channel.comparisons.len() == 17));
        assert_agree(&sheet);
        let text = sheet_to_text(&sheet);
        assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
        for part in ["quantum efficiency", "DSNU", "PRNU", "SNR_max", "linearity error", "computed", "measured", "in u"] {
            assert!(text.contains(part), "`{part}` is not in:\n{text}");
        }
        let json: serde_json::Value = serde_json::from_str(&sheet_to_json(&sheet)).unwrap();
        for (index, channel) in sheet.channels.iter().enumerate() {
            let found = &json["channels"][index];
            assert_eq!(found["name"], channel.name.as_str());
            let gain = &found["figures"]["gain_dn_per_e"];
            assert!(gain["computed"]["value"].is_f64() && gain["measured"]["standard_uncertainty"].is_f64(), "{gain}");
            assert_eq!(found["photon_transfer"].as_array().map(Vec::len), Some(50));
        }
    }
}

#[test]
fn it_is_the_camera_that_is_measured() {
    let text = |response: &str, fill: f64| {
        format!(
            "Camera(lens: Pinhole(distance_mm: 16, diameter_mm: 0.2), columns: 8, rows: 8, pitch_um: 5, fill_factor: {fill}, exposure_ms: 20,
                {response} channels: [(name: \"n\", quantum_efficiency: Gaussian(peak: 0.8, centre_nm: 600, fwhm_nm: 200))],
                pixel: Pixel(gain_dn_per_e: 0.5, full_well_e: 7000, bits: 12, black_dn: 100, read_noise_e: 6, dark_current_e_s: 0,
                    dsnu_e: 3, prnu: 0.01))"
        )
    };
    let files = MemoryFiles::new()
        .with("camera.ron", text("angular_response: Directional(\"lens.csv\"),", 0.5))
        .with("lens.csv", "theta_deg,R\n0,1\n2,0.8\n4,0.4\n60,0\n");
    let Ok(Device::Camera(lenses)) = device_from_file("camera.ron", &files, None) else { panic!("no camera") };
    let plain = sheet_of(&written(&text("", 0.5)), &Options { wavelength_nm: Some(700.0), seed: 3 }).unwrap();
    assert_agree(&plain);
    // Half of the pixel, at half of the peak.
    let efficiency = plain.channels[0].comparisons[0];
    assert_eq!((efficiency.key, plain.channels[0].wavelength_nm), ("quantum_efficiency", 700.0));
    assert!((efficiency.computed.value - 0.2).abs() < 1e-12, "{efficiency:?}");
    // Micro-lenses that take less of the light at the edge of the port: ∫ R d sin²θ by hand is near 0.78.
    let lenses = sheet_of(&lenses, &Options { wavelength_nm: Some(700.0), seed: 3 }).unwrap();
    assert_agree(&lenses);
    let ratio = lenses.channels[0].comparisons[0].computed.value / efficiency.computed.value;
    assert!((0.6..0.9).contains(&ratio), "{ratio}");
}

#[test]
fn what_cannot_be_measured_is_told() {
    let mono = camera("mono-camera.ron");
    let error = sheet_of(&Camera { pixel: None, ..mono.clone() }, &Options::default()).unwrap_err();
    assert!(error.to_string().contains("has no `pixel`") && error.to_string().contains("add `pixel: Pixel(gain_dn_per_e:"), "{error}");
    let error = sheet_of(&mono, &Options { wavelength_nm: Some(1200.0), seed: 0 }).unwrap_err();
    assert!(error.to_string().contains("`grey` has no quantum efficiency at 1200 nm"), "{error}");
}

#[cfg(feature = "plot")]
#[test]
fn the_photon_transfer_plot_is_drawn() {
    use etendue::report::emva::chart::charts;
    use etendue::report::plot::{Size, Style, Theme, svg};
    let sheet = sheet_of(&camera("mono-camera.ron"), &Options::default()).unwrap();
    let charts = charts(&sheet);
    assert_eq!(charts.iter().map(|(stem, _)| stem.as_str()).collect::<Vec<_>>(), ["photon-transfer"]);
    let drawn = svg(&charts[0].1, &Style { theme: Theme::Light, size: Size::Paper }).unwrap();
    assert!(drawn.contains("saturation") && drawn.contains("K = "), "{drawn}");
}

#[cfg(feature = "cli")]
#[test]
fn the_command_takes_cameras() {
    let etendue = |arguments: &[&str]| {
        std::process::Command::new(env!("CARGO_BIN_EXE_etendue")).args(arguments).current_dir(disk::root()).output().unwrap()
    };
    let folder = std::env::temp_dir().join(format!("etendue-datasheet-camera-{}", std::process::id()));
    let output = etendue(&["datasheet", "sensors/mono-camera.ron", "--out", folder.to_str().unwrap()]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let mut wanted = vec!["sheet.txt", "sheet.json"];
    if cfg!(feature = "plot") {
        wanted.extend(["photon-transfer.svg", "photon-transfer.png"]);
    }
    assert!(wanted.iter().all(|name| folder.join(name).exists()), "{wanted:?}");
    let camera = std::fs::read_to_string(disk::root().join("sensors/mono-camera.ron")).unwrap();
    let without = folder.join("without.ron");
    std::fs::write(&without, format!("{})", camera.split("    pixel:").next().unwrap())).unwrap();
    let output = etendue(&["datasheet", without.to_str().unwrap()]);
    let words = String::from_utf8(output.stderr).unwrap();
    std::fs::remove_dir_all(&folder).unwrap();
    assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0));
    assert!(words.contains("without.ron:5:1") && words.contains("add `pixel: Pixel("), "{words}");
    let output = etendue(&["datasheet", "sensors/mono-camera.ron", "--wavelength", "0"]);
    assert!(String::from_utf8_lossy(&output.stderr).contains("such as 525"));
    let output = etendue(&["datasheet", "sensors/pixels/monochrome-12-bit.ron"]);
    let words = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.code() == Some(2) && words.contains("`Sensor(…)` or `Camera(…)`, not `Pixel(…)`"), "{words}");
    assert_eq!(etendue(&["datasheet", "sensors/class-b-lux-meter.ron", "--wavelength", "550"]).status.code(), Some(2));
}
