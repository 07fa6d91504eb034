//! Calibrations from end to end: an absolute scale by substitution, tables as instruments write them, a published camera.

#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod disk;

use disk::Repository;
use etendue::characterization::readings_table::readings_from_csv;
use etendue::estimate::{Stop, Watch};
use etendue::measurement::measure;
use etendue::plan::{Plan, PlanOptions};
use etendue::report::calibration::{curve_to_csv, directional_to_csv, readings_to_csv, to_json, to_sensor_file, to_text};
use etendue::scene::{Beam, Calibration, Files, MemoryFiles, read_calibration, read_scene};
use etendue::sensor::Acceptance;
use etendue::study::calibrate::{CalibrateOptions, Calibrated, calibrate};

fn text_of(path: &str) -> String {
    String::from_utf8(Repository.read(path, 1 << 20).unwrap()).unwrap()
}

fn campaign_of(file: &str) -> Calibration {
    read_calibration(&format!("scenes/calibration/{file}"), &Repository, None).unwrap_or_else(|problems| panic!("{problems}"))
}

fn run(calibration: &Calibration, options: &CalibrateOptions) -> Calibrated {
    let watch = Watch { now: &|| 0.0, progress: &|_| {} };
    calibrate(calibration, options, &watch).unwrap_or_else(|e| panic!("{e}"))
}

fn seeded(seed: u64) -> CalibrateOptions {
    CalibrateOptions { seed, ..CalibrateOptions::default() }
}

#[test]
fn substitution_finds_the_absolute_scale_within_its_uncertainty() {
    let calibration = campaign_of("substitution.ron");
    let (mut square, mut inside, mut nodes_inside, mut nodes) = (0.0, 0, 0, 0);
    let seeds = 40;
    for seed in 0..seeds {
        let calibrated = run(&calibration, &seeded(seed));
        let channel = &calibrated.channels[0];
        let q = channel.uses.iter().find(|q| q.name == "s_v for LED-B3").unwrap();
        let apart = (q.value - q.truth.unwrap()) / q.standard_uncertainty;
        // 0.05 % of the reference, 0.05 % of its place.
        let relative = q.standard_uncertainty / q.value;
        assert!(relative > 0.0007 && relative < 0.0012, "{relative}");
        square += apart * apart / seeds as f64;
        inside += usize::from(apart.abs() <= 2.0);
        for ((s, t), u) in channel.curve.values.iter().zip(channel.truth.as_ref().unwrap()).zip(&channel.standard_uncertainties) {
            nodes += 1;
            nodes_inside += usize::from((s - t).abs() <= 2.0 * u);
        }
    }
    println!("RMS {:.2} u, {inside} of {seeds} within U, {nodes_inside} of {nodes} nodes", square.sqrt());
    // χ² of 40 is below 66.8 with 99.5 %; of 40 draws 34 or more lie within 95 % with 99.9 %.
    assert!(square < 66.8 / 40.0 && square > 20.7 / 40.0, "{square}");
    assert!(inside >= 34 && nodes_inside as f64 >= 0.93 * f64::from(nodes), "{inside}, {nodes_inside} of {nodes}");
}

/// Readings of both detectors in a beam of any power give the same curve.
#[test]
fn the_power_of_the_beam_cancels() {
    let mut calibration = campaign_of("substitution.ron");
    calibration.noise.absolute = 0.0;
    let reference = calibration.reference.as_mut().unwrap();
    reference.noise.absolute = 0.0;
    let mut with = |beam: Beam| {
        calibration.reference.as_mut().unwrap().beam = beam;
        run(&calibration, &seeded(5))
    };
    let nominal = with(Beam { factor: 1.0, drift: 0.0 });
    for beam in [Beam { factor: 0.31, drift: 0.0 }, Beam { factor: 7.0, drift: 1.5 }, Beam { factor: 1.0, drift: -0.6 }] {
        let found = with(beam);
        let (curve, same) = (&found.channels[0].curve.values, &nominal.channels[0].curve.values);
        let u = &nominal.channels[0].standard_uncertainties;
        let most = curve.iter().zip(same).zip(u).fold(0.0f64, |most, ((a, b), u)| most.max((a - b).abs() / u));
        println!("{beam:?}: apart by up to {most:.1e} u");
        // The grid of scales that the evidence is summed over is laid about the brightest exposure, which a drift may change.
        assert!(most < 0.05, "{beam:?}: {most} u");
        let powers = &found.beam.as_ref().unwrap().powers;
        assert!((powers[0] / beam.factor - 1.0).abs() < 0.005, "{beam:?}: {}", powers[0]);
        assert!((powers[powers.len() - 1] / (beam.factor * (1.0 + beam.drift)) - 1.0).abs() < 0.005, "{beam:?}");
    }
    // Without the reference the power is believed.
    let (weak, reference) = (calibration.reference.as_ref().unwrap().beam, calibration.reference.take());
    assert!(reference.is_some() && weak.drift < 0.0);
}

/// An uncertainty of the reference that grows with wavelength, from one cause, is that of the curve: correlation 1, each node by its share.
#[test]
fn an_uncertainty_over_wavelength_is_handed_on() {
    let bench = text_of("scenes/calibration/monochromator-bench.ron").replace(
        "sensor: \"../../sensors/class-b-lux-meter.ron\"",
        "sensor: Sensor(aperture: Disc(radius_mm: 5), acceptance: Cosine, channels: [(name: \"I\", responsivity: AmperesPerWatt(0.3), reads: Photocurrent)])",
    );
    let table = "# unit: A/W\nwavelength_nm,s,u\n400,0.25,0.0005\n700,0.55,0.0110\n";
    let trap = "Sensor(aperture: Disc(radius_mm: 4), acceptance: Cosine, channels: [(name: \"I\", responsivity: \"trap.csv\", reads: Photocurrent)])";
    let campaign = "Calibration(bench: \"bench.ron\", noise: (relative: 1e-5), curve: (from_nm: 400, to_nm: 700, step_nm: 10),
        exposures: [Monochromator(from_nm: 410, to_nm: 690, step_nm: 10, fwhm_nm: 10)],
        reference: Substitution(sensor: \"trap.ron\", noise: (relative: 1e-5)))";
    let files = MemoryFiles::new().with("bench.ron", bench).with("trap.csv", table).with("trap.ron", trap).with("c.ron", campaign);
    let calibration = read_calibration("c.ron", &files, None).unwrap_or_else(|problems| panic!("{problems}"));
    let (mut square, seeds) = (0.0, 30);
    for seed in 0..seeds {
        let calibrated = run(&calibration, &seeded(seed));
        let channel = &calibrated.channels[0];
        let share = |k: usize| {
            let nm = calibrated.nodes_nm[k];
            (0.0005 + (nm - 400.0) / 300.0 * 0.0105) / (0.25 + (nm - 400.0) / 300.0 * 0.3)
        };
        let covariance = channel.curve.covariance();
        for (i, j) in [(5, 5), (15, 15), (25, 25), (5, 25)] {
            let expected = share(i) * share(j) * channel.curve.values[i] * channel.curve.values[j];
            assert!((covariance[(i, j)] / expected - 1.0).abs() < 0.02, "{i} {j}: {} and {expected}", covariance[(i, j)]);
        }
        square += ((channel.curve.values[25] - 0.3) / channel.standard_uncertainties[25]).powi(2) / seeds as f64;
    }
    // χ² of 30 lies between 13.8 and 53.7 with 99 %.
    assert!(square > 13.8 / 30.0 && square < 53.7 / 30.0, "{square}");
}

#[test]
fn readings_of_the_reference_are_written_and_read() {
    let calibration = campaign_of("substitution.ron");
    let calibrated = run(&calibration, &seeded(1));
    let written = readings_to_csv(&calibrated);
    assert!(written.starts_with("exposure,I (A),u(I) (A),reference (A),u(reference) (A)\n"), "{}", &written[..80]);
    let data = readings_from_csv("r.csv", &written, &calibration).unwrap_or_else(|problems| panic!("{problems}"));
    let again = run(&calibration, &CalibrateOptions { data: Some(data), ..seeded(1) });
    assert_eq!(again.channels[0].curve.values, calibrated.channels[0].curve.values);
    assert_eq!(again.beam, calibrated.beam);
    let text = to_text(&calibrated);
    assert!(text.contains("light measured by substitution: trap detector") && text.contains("beam at 0.7"), "{text}");
    let json: serde_json::Value = serde_json::from_str(&to_json(&calibrated)).unwrap();
    assert_eq!(json["reference"]["beam_over_nominal"].as_array().unwrap().len(), calibration.exposures.len());
    let missing = written.replace("u(reference)", "u(Reference)");
    let said = readings_from_csv("r.csv", &missing, &calibration).unwrap_err().to_string();
    assert!(said.contains("did you mean `u(reference) (A)`"), "{said}");
}

#[test]
fn a_reference_that_gives_no_scale_is_told() {
    let text = text_of("scenes/calibration/substitution.ron");
    let read = |text: &str| {
        let mut files = MemoryFiles::new().with("scenes/calibration/c.ron", text);
        for path in [
            "scenes/calibration/monochromator-bench.ron",
            "sensors/class-b-lux-meter.ron",
            "sensors/class-b/responsivity.csv",
            "sensors/class-b/directional.csv",
            "sensors/silicon/responsivity.csv",
            "sensors/silicon-photodiode-meter.ron",
            "sensors/trap/responsivity.csv",
            "sensors/rgb-camera.ron",
            "sensors/trap-detector.ron",
            "sensors/two-channel-meter.ron",
        ] {
            files = files.with(path, text_of(path));
        }
        read_calibration("scenes/calibration/c.ron", &files, None)
    };
    assert!(read(&text).is_ok(), "{}", read(&text).unwrap_err());
    for (from, to, words) in [
        ("trap-detector.ron\"", "class-b-lux-meter.ron\"", "is relative, and gives no scale"),
        ("trap-detector.ron\"", "two-channel-meter.ron\"", "the reference has 2 channels"),
        ("noise: (relative: 3e-4, absolute: 5e-13, dark: 1e-12),", "", "has no `noise`"),
        ("alignment: 5e-4", "alignment: 5", "allowed: 0 to 1, a share"),
        ("alignment: 5e-4", "alinement: 5e-4", "did you mean `alignment`"),
        ("drift: -0.1", "drift: -1", "power is left at the end"),
        ("Substitution(", "Comparison(", "Substitution"),
        ("curve: (from_nm", "scale_uncertainty: 0.01, curve: (from_nm", "its scale is stated as well"),
    ] {
        assert!(text.contains(from), "{from}");
        let problems = read(&text.replace(from, to)).err().unwrap_or_else(|| panic!("{to}: read without a problem"));
        assert!(problems.to_string().contains(words) && problems.0.len() == 1, "{to}:\n{problems}");
    }
    let mut dim = campaign_of("substitution.ron");
    dim.reference.as_mut().unwrap().beam.factor = 1e-6;
    let watch = Watch { now: &|| 0.0, progress: &|_| {} };
    let said = calibrate(&dim, &seeded(0), &watch).unwrap_err().to_string();
    assert!(said.contains("the reference reads") && said.contains("allowed: above ten times its uncertainty"), "{said}");
}

/// A bench whose campaign the files of `tests/calibration/instruments` belong to.
fn scanned() -> Calibration {
    let bench =
        "Scene(sources: [(name: \"lamp\", shape: Point, at: (0, 0, 1), strength: Irradiance(watts_per_m2: 0.1, at_m: 1), spectrum: \"A\")],
        instruments: [(name: \"head\", at: (0, 0, 0), facing: (0, 0, 1), sensor: Sensor(aperture: Point, acceptance: Cosine,
            channels: [(name: \"E_v\", responsivity: \"V\", reads: Illuminance)]))])";
    let campaign = "Calibration(bench: \"bench.ron\", noise: (relative: 0.01), curve: (from_nm: 380, to_nm: 720, step_nm: 5),
        exposures: [Monochromator(from_nm: 400, to_nm: 700, step_nm: 20, fwhm_nm: 20)])";
    let files = MemoryFiles::new().with("bench.ron", bench).with("c.ron", campaign);
    read_calibration("c.ron", &files, None).unwrap_or_else(|problems| panic!("{problems}"))
}

/// What the readings in both files follow: 68.3 lx at 556 nm, a bell of 42 nm.
fn bell_lx(nm: f64) -> f64 {
    68.3 * (-0.5 * ((nm - 556.0) / 42.0).powi(2)).exp()
}

#[test]
fn tables_as_instruments_write_them_are_read() {
    let calibration = scanned();
    let german = text_of("tests/calibration/instruments/picoammeter.csv");
    assert!(german.starts_with('\u{feff}') && german.contains("\r\n") && german.contains("23,1;"));
    let tabbed = text_of("tests/calibration/instruments/bench.tsv");
    for (name, text) in [("picoammeter.csv", &german), ("bench.tsv", &tabbed)] {
        let read = readings_from_csv(name, text, &calibration).unwrap_or_else(|problems| panic!("{problems}"));
        assert_eq!((read.len(), read[0].values.len()), (1, 16), "{name}");
        for (i, (y, u)) in read[0].values.iter().zip(&read[0].standard_uncertainties).enumerate() {
            let expected = bell_lx(400.0 + 20.0 * i as f64);
            assert!((y - expected).abs() < 6e-5 + 6e-6 * expected, "{name}, {i}: {y} and {expected}");
            assert!((u / (0.002 * expected + 0.001) - 1.0).abs() < 0.01, "{name}, {i}: {u}");
        }
        let fitted = run(&calibration, &CalibrateOptions { data: Some(read), ..seeded(0) });
        let curve = &fitted.channels[0].curve;
        let peak = fitted.nodes_nm.iter().zip(&curve.values).max_by(|a, b| a.1.total_cmp(b.1)).unwrap();
        assert!((peak.0 - 556.0).abs() <= 5.0 && (peak.1 / 683.0 - 1.0).abs() < 0.1, "{name}: {peak:?}");
    }
    // Without a mark, with points, by the names of the exposures.
    let plain = german.trim_start_matches('\u{feff}').replace("Wavelength [nm]", "exposure").replace(",00;", " nm;");
    assert!(readings_from_csv("r.csv", &plain, &calibration).is_ok());
    let slashed = german.replace("E_v [lx]", "E_v / lx").replace("u(E_v) [lx]", "u(E_v) in lx");
    assert!(readings_from_csv("r.csv", &slashed, &calibration).is_ok());
}

#[test]
fn what_cannot_be_read_of_an_instrument_is_told_with_its_place() {
    let calibration = scanned();
    let good = text_of("tests/calibration/instruments/picoammeter.csv");
    for (from, to, line, words) in [
        ("Wavelength [nm]", "Wavelength [Å]", 6, "the unit of the wavelengths is Å | allowed: nm"),
        ("Wavelength [nm]", "Wavelength", 6, "the wavelengths state no unit"),
        ("u(E_v) [lx]", "E_v [lx]", 6, "there are two columns for `E_v`"),
        ("u(E_v) [lx]", "Std [lx]", 6, "there is no column `u(E_v) (lx)`"),
        ("E_v [lx];u", "EV [lx];u", 6, "did you mean `E_v (lx)`"),
        (";400,00;", ";401,50;", 7, "there is no exposure at 401.5 nm | the nearest is \"400 nm\""),
        (";400,00;", ";420,00;", 8, "the exposure \"420 nm\" has two rows"),
        (";400,00;", ";OVER;", 7, "the wavelength is no number: `OVER`"),
        (";400,00;", ";-400,00;", 7, "the wavelength is -400 | allowed: above 0 nm"),
        (";23,1;\r\n", ";23,1;7;\r\n", 7, "6 cells where the head has 5"),
    ] {
        assert!(good.contains(from), "{from}");
        let problems =
            readings_from_csv("lab.csv", &good.replacen(from, to, 1), &calibration).err().unwrap_or_else(|| panic!("{to}: read"));
        let said: Vec<String> =
            problems.0.iter().map(|p| format!("{}: {} | {}", p.line, p.message, p.help.clone().unwrap_or_default())).collect();
        assert!(said.iter().any(|said| said.starts_with(&format!("{line}: ")) && said.contains(words)), "{to}:\n{said:#?}");
    }
    // A comma that may be a separator of thousands is asked about.
    let unclear = "wavelength (nm);E_v (lx);u(E_v) (lx)\n400;1,234;2,000\n";
    let said = readings_from_csv("lab.csv", unclear, &calibration).unwrap_err().to_string();
    assert!(said.contains("may be 1.234 or 1234"), "{said}");
    let leds = campaign_of("three-leds.ron");
    let said = readings_from_csv("lab.csv", "wavelength (nm),E_v (lx),u(E_v) (lx)\n450,1,0.1\n", &leds).unwrap_err().to_string();
    assert!(said.contains("no settings of one wavelength") && said.contains("blue, green, red"), "{said}");
}

/// The office of the spine with one meter on desk 6, under another lamp.
fn office(sensor: &str, lamp: &str) -> String {
    let text = text_of("scenes/office.ron").replace("LED-B3", lamp).replace("../sensors/class-b-lux-meter.ron", sensor);
    let first = text.find("        (name: \"ideal meter on desk 6\"").unwrap();
    format!("{}    ],\n)\n", &text[..first])
}

/// Calibrate, write the sensor file, measure the office with it: for five lamps it reads what the true sensor reads, within the uncertainty
/// that its file carries.
#[test]
fn the_fitted_sensor_measures_the_office_as_the_true_one() {
    let calibration = campaign_of("monochromator.ron");
    let sensor = &calibration.bench.instruments[0].sensor;
    let Acceptance::Directional(response) = &sensor.acceptance else { panic!("a table") };
    let lamps = ["LED-B3", "A", "D65", "LED-RGB1", "FL11"];
    let (mut square, seeds) = (0.0, 4);
    for seed in 0..seeds {
        let calibrated = run(&calibration, &seeded(seed));
        let mut files = MemoryFiles::new()
            .with("scenes/fitted.csv", curve_to_csv(&calibrated, &calibrated.channels[0]).unwrap())
            .with("scenes/directional.csv", directional_to_csv(response))
            .with("scenes/fitted.ron", to_sensor_file(&calibrated, sensor, &["fitted.csv".to_owned()], "directional.csv"));
        for path in ["sensors/class-b-lux-meter.ron", "sensors/class-b/responsivity.csv", "sensors/class-b/directional.csv"] {
            files = files.with(path, text_of(path));
        }
        for lamp in lamps {
            let read = |sensor: &str| {
                let files = files.clone().with("scenes/office.ron", office(sensor, lamp));
                let scene = read_scene("scenes/office.ron", &files, None).unwrap_or_else(|problems| panic!("{problems}"));
                let plan = Plan::new(&scene, &PlanOptions::default()).unwrap();
                let watch = Watch { now: &|| 0.0, progress: &|_| {} };
                let stop = Stop { target: None, samples: Some(1 << 10), ..Stop::default() };
                let reading = measure(&scene, &plan, &stop, 7, &watch).unwrap().readings.remove(0);
                (reading.value, reading.standard_uncertainty())
            };
            // The same seed: both see the same rays, and only the curves differ.
            let (fitted, u_fitted) = read("fitted.ron");
            let (truth, u_truth) = read("../sensors/class-b-lux-meter.ron");
            let u = (u_fitted * u_fitted - u_truth * u_truth).max(0.0).sqrt();
            let apart = (fitted - truth) / u;
            println!("seed {seed}, {lamp}: true {truth:.2} lx, fitted {fitted:.2} lx ± {u:.2} lx from the curve, apart {apart:+.1} u");
            assert!(apart.abs() < 3.0 && u / fitted > 0.004 && u / fitted < 0.02, "{lamp}: {fitted} and {truth}, u {u}");
            square += apart * apart / f64::from(seeds as u32 * 5);
        }
    }
    // One scale for all lamps of a seed: four independent numbers, χ² of 4 below 14.9 with 99.5 %.
    assert!(square < 14.9 / 4.0, "{square}");
}

/// The published curves of a camera that is not among those of the prior are found on a monochromator bench.
#[test]
fn a_published_camera_is_recovered() {
    let calibration = campaign_of("published-camera.ron");
    let calibrated = run(&calibration, &seeded(0));
    for channel in &calibrated.channels {
        let truth = channel.truth.as_ref().unwrap();
        let peak = truth.iter().fold(0.0f64, |most, s| most.max(*s));
        let all = || channel.curve.values.iter().zip(truth).zip(&channel.standard_uncertainties);
        let inside = all().filter(|((s, t), u)| (*s - *t).abs() <= 2.58 * **u).count();
        let square: f64 = all().map(|((s, t), _)| (s - t).powi(2)).sum::<f64>() / truth.len() as f64;
        println!(
            "{}: RMS {:.2e} of the peak, {inside} of {} within 99 % bands",
            channel.readings.channel,
            square.sqrt() / peak,
            truth.len()
        );
        assert!(square.sqrt() < 0.02 * peak && inside as f64 >= 0.95 * truth.len() as f64, "{}", channel.readings.channel);
    }
}
