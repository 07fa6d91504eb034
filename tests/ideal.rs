//! What an ideal instrument would indicate, electronics in readings, and responsivities with units: against laws and closed forms.

#![allow(clippy::unwrap_used)]

mod disk;

use disk::{Folder, root};
use etendue::characterization::spectral_mismatch::correction_factor;
use etendue::estimate::{Stop, Watch};
use etendue::measurement::{Cause, Measurement, Reading, add_ideal, measure};
use etendue::plan::{Plan, PlanOptions};
use etendue::quantity::air::wavelength_in_vacuum_nm;
use etendue::quantity::constants::{ELEMENTARY_CHARGE_C, PLANCK_J_S, SPEED_OF_LIGHT_M_S};
use etendue::scene::{Files, MemoryFiles, read_scene};
use etendue::sensor::photodiode::Saturation;
use etendue::spectrum::{Density, library};

fn measured(text: &str, files: &dyn Files, path: &str, stop: &Stop) -> Measurement {
    let scene = read_scene(path, files, None).unwrap_or_else(|problems| panic!("{problems}\n{text}"));
    let plan = Plan::new(&scene, &PlanOptions::default()).unwrap();
    let watch = Watch { now: &|| 0.0, progress: &|_| {} };
    let mut measurement = measure(&scene, &plan, stop, 0, &watch).unwrap();
    add_ideal(&mut measurement, &scene, &plan, &watch).unwrap();
    measurement
}

/// The readings of a scene of text, with the responsivity and the directional response of the class B meter beside it.
fn read(text: &str) -> Vec<Reading> {
    let disk = Folder(root().join("sensors/class-b"));
    let curve = |name: &str| String::from_utf8(disk.read(name, 1 << 20).unwrap()).unwrap();
    let files = MemoryFiles::new()
        .with("scene.ron", text)
        .with("s.csv", curve("responsivity.csv"))
        .with("r.csv", curve("directional.csv"))
        .with("u.csv", "# unit: A/W\nwavelength_nm,s,u\n400,0.2,0.01\n700,0.4,0.02\n");
    measured(text, &files, "scene.ron", &Stop::default()).readings
}

const LAMP: &str = r#"(name: "lamp", shape: Point, at: (0, 0, 2), strength: Candela(1000), spectrum: "LED-B3")"#;

fn scene(sources: &str, sensor: &str) -> String {
    format!(r#"Scene(sources: [{sources}], instruments: [(name: "m", at: (0, 0, 0), facing: (0, 0, 1), sensor: {sensor})])"#)
}

fn part(reading: &Reading, cause: Cause) -> f64 {
    reading.ideal.as_ref().unwrap().parts.iter().find(|p| p.cause == cause).unwrap().value
}

fn responsivity(name: &str) -> etendue::spectrum::Factor {
    let files = Folder(root().join("sensors/class-b"));
    etendue::scene::factor_from_text(name, etendue::spectrum::Outside::Zero, &files).unwrap().factor
}

#[test]
fn the_spectral_part_is_the_mismatch_correction_factor() {
    let sensor = r#"Sensor(aperture: Point, acceptance: Cosine, channels: [(name: "E", responsivity: "s.csv", reads: Illuminance(adjusted_with: "A"))])"#;
    let reading = &read(&scene(LAMP, sensor))[0];
    let (v, led, a) = (library::v_lambda(), library::density("LED-B3").unwrap(), Density::illuminant_a());
    let factor = correction_factor(&responsivity("responsivity.csv"), &v, &led, &a).unwrap();
    let ideal = reading.ideal.as_ref().unwrap();
    assert!((ideal.value / 250.0 - 1.0).abs() < 1e-9, "{}", ideal.value);
    assert!((reading.value * factor / 250.0 - 1.0).abs() < 1e-9);
    assert!((part(reading, Cause::Spectral) - 250.0 * (1.0 / factor - 1.0)).abs() < 1e-9);
    assert_eq!(ideal.parts.len(), 1);
}

#[test]
fn the_directional_part_is_the_response_in_the_direction_of_the_lamp() {
    // 60° from the normal; R there from the table.
    let lamp = r#"(name: "lamp", shape: Point, at: (1.7320508075688772, 0, 1), strength: Candela(1000), spectrum: "A")"#;
    let sensor =
        r#"Sensor(aperture: Point, acceptance: Directional("r.csv"), channels: [(name: "E", responsivity: "V", reads: Illuminance)])"#;
    let reading = &read(&scene(lamp, sensor))[0];
    let ideal = reading.ideal.as_ref().unwrap();
    assert!((ideal.value / 125.0 - 1.0).abs() < 1e-9, "{}", ideal.value);
    assert!((part(reading, Cause::Directional) - (reading.value - 125.0)).abs() < 1e-9);
    assert!(part(reading, Cause::Directional).abs() > 0.1);
}

#[test]
fn the_parts_add_up_to_the_whole_in_a_room() {
    let scene = std::fs::read_to_string(root().join("scenes/ten-instruments.ron")).unwrap();
    let stop = Stop { target: None, budget_seconds: None, samples: Some(1 << 13) };
    let m = measured(&scene, &Folder(root()), "scenes/ten-instruments.ron", &stop);
    assert_eq!(m.readings.len(), 10);
    let with_ideal: Vec<&Reading> = m.readings.iter().filter(|r| r.ideal.is_some()).collect();
    assert_eq!(with_ideal.len(), 9, "all but the ideal meter");
    for r in with_ideal {
        let ideal = r.ideal.as_ref().unwrap();
        let whole = r.value - ideal.value;
        assert!((whole - ideal.difference()).abs() <= 1e-12 * r.value.abs(), "{}: {whole} and {}", r.instrument, ideal.difference());
        assert!(ideal.parts.iter().all(|p| p.standard_uncertainty.is_finite() && p.share_uncertainty.is_finite()), "{}", r.instrument);
    }
}

#[test]
fn an_ideal_meter_beside_a_real_one_indicates_what_it_should() {
    let disk = Folder(root());
    let text = std::fs::read_to_string(root().join("scenes/ten-instruments.ron")).unwrap();
    // The class B meter and the ideal one in the same place.
    let text = text.replace("at: (2.6, 2.1, 0.75)", "at: (2.8, 2.1, 0.75)");
    struct Changed<'a>(&'a Folder, String);
    impl Files for Changed<'_> {
        fn read(&self, path: &str, most_bytes: u64) -> Result<Vec<u8>, etendue::scene::FileProblem> {
            if path == "scenes/changed.ron" { Ok(self.1.clone().into_bytes()) } else { self.0.read(path, most_bytes) }
        }
    }
    let stop = Stop { target: None, budget_seconds: None, samples: Some(1 << 14) };
    let m = measured(&text, &Changed(&disk, text.clone()), "scenes/changed.ron", &stop);
    let (ideal_meter, class_b) = (&m.readings[0], &m.readings[1]);
    assert!(ideal_meter.ideal.is_none());
    let ideal = class_b.ideal.as_ref().unwrap();
    let u = ideal.standard_uncertainty.hypot(ideal_meter.standard_uncertainty());
    assert!((ideal.value - ideal_meter.value).abs() < 3.5 * u, "{} and {} with u = {u}", ideal.value, ideal_meter.value);
    // The arriving light is known better than either reading.
    let shared = ideal.parts.iter().map(|p| p.share_uncertainty).fold(0.0, f64::hypot);
    assert!(shared < 0.5 * class_b.standard_uncertainty() / class_b.value, "{shared}");
}

#[test]
fn a_quantum_efficiency_makes_electrons_of_photons() {
    // 1 W/m² of 600 nm onto 1 cm², 0.8 electrons a photon.
    let text = scene(
        r#"(name: "beam", shape: Directional, facing: (0, 0, -1), strength: WattsPerSquareMetre(1), spectrum: Line(600))"#,
        r#"Sensor(aperture: Rectangle(width_mm: 10, height_mm: 10), acceptance: Cosine, channels: [
            (name: "I", responsivity: QuantumEfficiency(0.8), reads: Photocurrent),
            (name: "J", responsivity: Chain(filter: 0.5, window: 0.9, detector: QuantumEfficiency(0.8)), reads: Photocurrent),
            (name: "T", responsivity: QuantumEfficiency(0.8), temperature: (coefficient_percent_per_k: 0.1, adjusted_at_c: 25, used_at_c: 35), reads: Photocurrent),
        ])"#,
    );
    let found = read(&text);
    let photons_per_s = 1e-4 * wavelength_in_vacuum_nm(600.0) * 1e-9 / (PLANCK_J_S * SPEED_OF_LIGHT_M_S);
    let expected = 0.8 * ELEMENTARY_CHARGE_C * photons_per_s;
    for (reading, factor) in found.iter().zip([1.0, 0.45, 1.01]) {
        assert!((reading.value / (factor * expected) - 1.0).abs() < 1e-7, "{}: {} and {expected}", reading.channel, reading.value);
    }
}

#[test]
fn uncertainties_of_a_responsivity_add_up_over_wavelengths() {
    let text = scene(
        r#"(name: "beam", shape: Directional, facing: (0, 0, -1), strength: WattsPerSquareMetre(2), spectrum: Lines([(450, 0.25), (650, 0.75)]))"#,
        r#"Sensor(aperture: Rectangle(width_mm: 10, height_mm: 10), acceptance: Cosine, channels: [
            (name: "I", responsivity: "u.csv", reads: Photocurrent),
            (name: "J", responsivity: AmperesPerWatt(0.3), uncertainty_percent: 1.5, reads: Photocurrent),
        ])"#,
    );
    let found = read(&text);
    let u = |nm: f64| 0.01 + 0.01 * (nm - 400.0) / 300.0;
    let expected = 1e-4 * (0.5 * u(450.0) + 1.5 * u(650.0));
    assert!((found[0].standard_uncertainty() / expected - 1.0).abs() < 1e-9, "{}", found[0].standard_uncertainty());
    assert!((found[1].standard_uncertainty() / found[1].value - 0.015).abs() < 1e-9);
    assert!(found.iter().all(|r| r.budget.rows.iter().any(|row| row.source.contains("responsivity"))));
}

#[test]
fn a_bandpass_takes_its_area_from_a_flat_spectrum() {
    for (shape, area_nm) in [("Triangle", 5.0), ("Rectangle", 5.0), ("Gaussian", 5.0 * (std::f64::consts::PI / (4.0 * 2f64.ln())).sqrt())] {
        let text = scene(
            r#"(name: "beam", shape: Directional, facing: (0, 0, -1), strength: WattsPerSquareMetre(400), spectrum: Flat(from_nm: 380, to_nm: 780))"#,
            &format!(
                r#"Sensor(aperture: Point, acceptance: Cosine, channels: [(name: "E", responsivity: Bandpass(centre_nm: 550, fwhm_nm: 5, shape: {shape}), reads: Irradiance)])"#
            ),
        );
        let found = &read(&text)[0];
        assert!((found.value / area_nm - 1.0).abs() < 1e-9, "{shape}: {}", found.value);
    }
}

#[test]
fn a_display_shows_what_its_electronics_make_of_the_light() {
    // 250 lx at 1 nA/lx: 250 nA over 1 MΩ are 0.25 V of 2 V; 3 digits of up to 2000 lx show steps of 10 lx.
    let sensor = |ranges: &str| {
        format!(
            r#"Sensor(aperture: Point, acceptance: Cosine, channels: [(name: "E", responsivity: "V", reads: Illuminance)],
            readout: Photodiode({ranges}, integration_s: 0.1, saturation_v: 2, display_digits: 3, current_a_per_unit: 1e-9))"#
        )
    };
    let found = &read(&scene(LAMP, &sensor("feedback_ohm: 1e6")))[0];
    let display = found.readout.as_ref().unwrap();
    assert_eq!((found.value, display.step, display.saturation), (250.0, Some(10.0), None));
    assert!((display.voltage_v - 0.25).abs() < 1e-9 && (display.analogue - 250.0).abs() < 1e-6);
    assert!((found.standard_uncertainty() - 5.0 / 3f64.sqrt()).abs() < 1e-3);
    for words in ["shot noise", "Johnson noise", "last digit"] {
        assert!(found.budget.rows.iter().any(|row| row.source.contains(words)), "{words}");
    }
    assert_eq!(found.ideal.as_ref().unwrap().parts.len(), 1);
    let over = &read(&scene(LAMP, &sensor("feedback_ohm: 1e7")))[0];
    assert_eq!(over.readout.as_ref().unwrap().saturation, Some(Saturation::Whole));
    assert!(
        (over.value - 200.0).abs() < 1e-9 && over.notes.iter().any(|note| note.contains("saturated")),
        "{} {:?}",
        over.value,
        over.notes
    );
    // One side of it is known, and no target can be met.
    assert!(!over.target_met && over.notes.iter().any(|note| note.contains("lower bound")), "{:?}", over.notes);
    let switched = &read(&scene(LAMP, &sensor("ranges: [(feedback_ohm: 1e7), (feedback_ohm: 1e5)]")))[0];
    assert!(switched.readout.as_ref().unwrap().saturation.is_none() && (switched.value - 200.0).abs() < 101.0);
}
