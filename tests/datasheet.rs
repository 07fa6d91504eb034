//! Data sheets: both routes agree, ideal meters are perfect, headers of the shelf say what the sheets say, bad input is told.

#![allow(clippy::unwrap_used)]

mod disk;

use std::process::Command;

use disk::{Repository, files_in, root};
use etendue::characterization::Figure;
use etendue::characterization::class_limits::Class;
use etendue::characterization::sheet::{ChannelSheet, DataSheet, Index, Options, SheetError, data_sheet};
use etendue::characterization::spectral_mismatch::{Wavelengths, correction_factor, f1_prime};
use etendue::estimate::run::with_threads;
use etendue::estimate::{Stop, Watch};
use etendue::measurement::measure;
use etendue::plan::{Plan, PlanOptions};
use etendue::report::datasheet::{to_json, to_text};
use etendue::scene::{Device, MemoryFiles, device_from_file, read_scene, sensor_from_file};
use etendue::sensor::Sensor;
use etendue::spectrum::{Density, library};
use proptest::prelude::*;

/// Deviation that a rectangle of standard uncertainty u has at most is √3 u; the rest is for those that are normal.
const MOST_U: f64 = 3.0;

fn sensor(name: &str) -> Sensor {
    sensor_from_file(&format!("sensors/{name}"), &Repository, None).unwrap_or_else(|problems| panic!("{name}: {problems}"))
}

fn written(text: &str) -> Sensor {
    sensor_from_file("meter.ron", &MemoryFiles::new().with("meter.ron", text), None).unwrap_or_else(|problems| panic!("{problems}"))
}

fn sheet_of(sensor: Sensor) -> Result<DataSheet, SheetError> {
    let watch = Watch { now: &|| 0.0, progress: &|_| {} };
    data_sheet(&sensor, &Options::default(), &watch)
}

fn indices(sheet: &DataSheet) -> impl Iterator<Item = &Index> {
    sheet.directional.iter().chain(sheet.channels.iter().flat_map(|channel| &channel.indices))
}

fn named<'a>(sheet: &'a DataSheet, symbol: &str) -> &'a Index {
    indices(sheet).find(|index| index.symbol == symbol).unwrap_or_else(|| panic!("no {symbol}"))
}

/// Largest deviation of the two routes, in u, with what it is of.
fn worst(sheet: &DataSheet) -> (f64, String) {
    let of_indices =
        indices(sheet).map(|index| (index.deviation_u(), format!("{} {:?} {:?}", index.symbol, index.computed, index.measured)));
    let lamps = sheet.channels.iter().flat_map(|channel| &channel.lamps);
    let of_lamps =
        lamps.map(|lamp| (lamp.computed.deviation_u(&lamp.measured), format!("{} {:?} {:?}", lamp.name, lamp.computed, lamp.measured)));
    of_indices.chain(of_lamps).max_by(|a, b| a.0.total_cmp(&b.0)).unwrap()
}

#[test]
fn an_ideal_meter_has_a_sheet_of_zeros() {
    let sheet = sheet_of(sensor("ideal-illuminance-meter.ron")).unwrap();
    for index in indices(&sheet).filter(|index| index.unit == "%") {
        assert!(index.computed.value.abs() <= 2.0 * index.computed.standard_uncertainty, "{index:?}");
        assert!(index.measured.value.abs() <= 2.0 * index.measured.standard_uncertainty, "{index:?}");
    }
    for lamp in &sheet.channels[0].lamps {
        assert!((lamp.measured.value - 1.0).abs() <= 2.0 * lamp.measured.standard_uncertainty, "{lamp:?}");
    }
    assert_eq!(sheet.channels[0].lamps.len(), 24);
    let class = sheet.channels[0].class.unwrap();
    assert_eq!(class.class, Some(Class::L));
    assert!(class.probability > 0.999);
}

#[test]
fn both_routes_agree_for_every_sensor_of_the_shelf() {
    let files = files_in("sensors", &[".ron"]);
    // Cameras have sheets of their own.
    let meter = |file: &String| match device_from_file(&format!("sensors/{file}"), &Repository, None) {
        Ok(Device::Camera(_)) => None,
        Ok(Device::Sensor(sensor)) => Some((file.clone(), *sensor)),
        Err(problems) => panic!("{file}: {problems}"),
    };
    let meters: Vec<(String, Sensor)> = files.iter().filter_map(meter).collect();
    assert!(meters.len() >= 17, "{files:?}");
    for (file, sensor) in meters {
        let sheet = sheet_of(sensor).unwrap_or_else(|error| panic!("{file}: {error}"));
        let (deviation, what) = worst(&sheet);
        println!("{file}: {deviation:.2} u, {what}");
        assert!(deviation <= MOST_U, "{file}: {deviation} u, {what}");
        assert!(to_text(&sheet).lines().all(|line| line.chars().count() <= 100), "{file}: {}", to_text(&sheet));
        assert!(!to_json(&sheet).contains("null,\n      \"standard_uncertainty\""), "{file}");
    }
}

/// The number that follows `symbol = ` in a header, in percent.
fn stated(header: &str, symbol: &str) -> f64 {
    let rest = header.split_once(&format!("{symbol} = ")).unwrap_or_else(|| panic!("the header has no {symbol}:\n{header}")).1;
    rest.split_whitespace().next().and_then(|number| number.parse().ok()).unwrap_or_else(|| panic!("{symbol}: {rest}"))
}

#[test]
fn headers_of_lux_meters_state_what_their_sheets_say() {
    let meters = [
        "class-l-lux-meter.ron",
        "class-a-lux-meter.ron",
        "class-b-lux-meter.ron",
        "class-c-lux-meter.ron",
        "silicon-photodiode-meter.ron",
    ];
    for (file, class) in meters.into_iter().zip([Some(Class::L), Some(Class::A), Some(Class::B), Some(Class::C), None]) {
        let text = std::fs::read_to_string(root().join("sensors").join(file)).unwrap();
        let header: String = text.lines().take_while(|line| line.starts_with("//")).collect();
        let sheet = sheet_of(sensor(file)).unwrap();
        for (word, symbol) in [("f1'", "f1′"), ("u", "u"), ("r", "r"), ("f2", "f2")] {
            let found = named(&sheet, symbol);
            assert!((stated(&header, word) - found.computed.value).abs() <= 0.00501, "{file}: {word} is {:.3} %", found.computed.value);
        }
        let found = sheet.channels[0].class.unwrap();
        assert_eq!(found.class, class, "{file}");
        let words = class.map_or("no class".to_owned(), |class| format!("class {class}"));
        assert!(header.contains(&words), "{file}: {words}");
    }
}

/// What a meter of the shelf reads of 1000 lx along its normal, over 1000 lx.
fn read_over_truth(file: &str, lamp: &str) -> f64 {
    let text = format!(
        "Scene(sources: [(name: \"beam\", shape: Directional, facing: (0, 0, -1), strength: Lux(1000), spectrum: \"{lamp}\")],
               instruments: [(name: \"m\", sensor: \"../sensors/{file}\", at: (0, 0, 0), facing: (0, 0, 1))])"
    );
    struct With(String);
    impl etendue::scene::Files for With {
        fn read(&self, path: &str, most_bytes: u64) -> Result<Vec<u8>, etendue::scene::FileProblem> {
            if path == "scenes/beam.ron" { Ok(self.0.clone().into_bytes()) } else { Repository.read(path, most_bytes) }
        }
    }
    let scene = read_scene("scenes/beam.ron", &With(text), None).unwrap_or_else(|problems| panic!("{problems}"));
    let plan = Plan::new(&scene, &PlanOptions::default()).unwrap();
    let watch = Watch { now: &|| 0.0, progress: &|_| {} };
    measure(&scene, &plan, &Stop::default(), 0, &watch).unwrap().readings[0].value / 1000.0
}

#[test]
fn bare_silicon_reads_as_its_mismatch_says() {
    let file = "silicon-photodiode-meter.ron";
    let meter = sensor(file);
    let (silicon, v, a) = (&meter.channels[0].responsivity, library::v_lambda(), Density::illuminant_a());
    let sheet = sheet_of(meter.clone()).unwrap();
    for lamp in ["A", "D65", "LED-B3"] {
        let f = correction_factor(silicon, &v, &library::density(lamp).unwrap(), &a).unwrap();
        let reading = read_over_truth(file, lamp);
        assert!((reading * f - 1.0).abs() < 1e-10, "{lamp}: reads {reading}, F = {f}");
        let listed = sheet.channels[0].lamps.iter().find(|one| one.name == lamp).unwrap();
        assert!((listed.measured.value / f - 1.0).abs() < 1e-10, "{listed:?}");
    }
    // Most of its reading of A is infrared that the LED lacks.
    assert!(read_over_truth(file, "LED-B3") < 0.6);
    let f1 = named(&sheet, "f1′");
    assert!((f1.computed.value - 100.0 * f1_prime(silicon, Wavelengths::VISIBLE).unwrap()).abs() < 1e-9);
    assert_eq!(sheet.channels[0].class.unwrap().class, None);
}

#[test]
fn the_class_is_as_sure_as_the_index() {
    // f1′ of the class B meter is 5.45 %: with a curve known to 3 % of its peak the class is open.
    let mut meter = sensor("class-b-lux-meter.ron");
    let exact = sheet_of(meter.clone()).unwrap();
    assert!(exact.channels[0].class.unwrap().probability > 0.999);
    let u = etendue::spectrum::Factor::band(600.0, 700.0, 0.02).unwrap();
    meter.channels[0].responsivity_uncertainty = vec![etendue::sensor::ResponsivityUncertainty::Curve(u)];
    let open = sheet_of(meter).unwrap();
    let (f1, class) = (named(&open, "f1′"), open.channels[0].class.unwrap());
    assert!(f1.stated_u > 0.1 && class.probability < 0.99, "{f1:?} {class:?}");
    let z = (6.0 - f1.measured.value) / f1.standard_uncertainty();
    let p = etendue::metrology::distribution::normal_cumulative(z);
    assert!((class.probability / p - 1.0).abs() < 1e-6);
}

#[test]
fn a_spot_meter_has_a_field_and_no_f2() {
    let sheet = sheet_of(sensor("cone-radiometer.ron")).unwrap();
    assert!(sheet.absent.iter().any(|one| one.symbol == "f2" && one.why.contains("0.500°")), "{:?}", sheet.absent);
    assert!((named(&sheet, "α₅₀").measured.value - 0.5).abs() < 1e-4);
    assert!(sheet.goniogram.is_none() && sheet.channels.iter().all(|channel| channel.class.is_none()));
}

#[test]
fn electronics_show_in_linearity_and_range_change() {
    let meter = written(
        r#"Sensor(title: "t", aperture: Point, acceptance: Cosine,
            channels: [(name: "E_v", responsivity: "V", reads: Illuminance)],
            readout: Photodiode(ranges: [(feedback_ohm: 1e7, error_percent: 0.0), (feedback_ohm: 1e5, error_percent: 0.4)], bandwidth_hz: 1,
                saturation_v: 2, current_a_per_unit: 1e-9))"#,
    );
    let sheet = sheet_of(meter).unwrap();
    let (f3, f11) = (named(&sheet, "f3"), named(&sheet, "f11"));
    // The ranges differ by 0.4 %; the strongest light is read in the one that is off.
    assert!((f11.computed.value - 0.4).abs() < 1e-6 && f11.deviation_u() < MOST_U, "{f11:?}");
    assert!((f3.computed.value - (100.0 - 100.0 / 1.004)).abs() < 1e-6 && f3.deviation_u() < MOST_U, "{f3:?}");
    assert_eq!(f11.classified().unwrap().class, Some(Class::A));
}

#[test]
fn a_class_without_all_indices_is_said_to_be_the_best_that_is_possible() {
    // The readout ends at 0.2 lx, below the weakest light of the bench.
    let meter = written(
        r#"Sensor(title: "t", aperture: Point, acceptance: Cosine, channels: [(name: "E_v", responsivity: "V", reads: Illuminance)],
            readout: Photodiode(feedback_ohm: 1e10, bandwidth_hz: 1, saturation_v: 2, current_a_per_unit: 1e-9))"#,
    );
    let sheet = sheet_of(meter).unwrap();
    let channel = &sheet.channels[0];
    assert_eq!((channel.unknown.as_slice(), channel.class.unwrap().class), (["f3"].as_slice(), Some(Class::L)));
    let text = to_text(&sheet);
    for part in ["class L at best, p", "f3 is not known", "total at least", "f3, f4, f5"] {
        assert!(text.contains(part), "`{part}` is not in:\n{text}");
    }
    assert!(to_json(&sheet).contains("\"not_known\": [\n        \"f3\""));
    // Nothing is missing where there are no ranges to change.
    let ideal = written(r#"Sensor(aperture: Point, acceptance: Cosine, channels: [(name: "E_v", responsivity: "V", reads: Illuminance)])"#);
    assert!(sheet_of(ideal).unwrap().channels[0].unknown.is_empty());
}

#[test]
fn a_uv_index_is_erythemal_irradiance_in_another_unit() {
    let sheet = sheet_of(sensor("uv-index-sensor.ron")).unwrap();
    let [irradiance, index] = [0, 1].map(|k| sheet.channels[k].indices.iter().find(|index| index.symbol == "f1′").unwrap());
    assert!((irradiance.computed.value - index.computed.value).abs() < 1e-12);
    let text = to_text(&sheet);
    assert!(text.contains("UVI: UV index, a number") && !text.contains(" in \n"), "{text}");
}

#[test]
fn heads_have_an_index_of_their_own_and_ideal_ones_have_none() {
    for (file, symbol) in [
        ("spherical-illuminance-meter.ron", "f2,0"),
        ("hemispherical-illuminance-meter.ron", "f2,h"),
        ("cylindrical-illuminance-meter.ron", "f2,z"),
        ("semicylindrical-illuminance-meter.ron", "f2,zh"),
    ] {
        let sheet = sheet_of(sensor(file)).unwrap();
        let f2 = named(&sheet, symbol);
        assert!(f2.computed.value < 1e-9 && f2.deviation_u() < MOST_U && f2.measured.value < 0.2, "{file}: {f2:?}");
        assert_eq!(f2.limits.is_some(), symbol != "f2,h", "{file}");
        assert!(named(&sheet, "f1′").measured.value < 0.1 && sheet.channels[0].class.unwrap().class == Some(Class::L), "{file}");
    }
}

#[test]
fn the_same_seed_gives_the_same_bits_on_any_number_of_threads() {
    let on = |threads| with_threads(Some(threads), || sheet_of(sensor("class-b-lux-meter.ron")).unwrap());
    let (one, three) = (on(1), on(3));
    assert_eq!(to_json(&one), to_json(&three));
}

#[test]
fn what_has_no_sheet_is_told() {
    let files = MemoryFiles::new().with("dark.csv", "theta_deg,R\n0,0\n45,1\n90,0\n").with(
        "meter.ron",
        r#"Sensor(title: "t", aperture: Point, acceptance: Directional("dark.csv"),
            channels: [(name: "E_v", responsivity: "V", reads: Illuminance)])"#,
    );
    let error = sheet_of(sensor_from_file("meter.ron", &files, None).unwrap()).unwrap_err();
    assert!(error.to_string().contains("`E_v` reads nothing of a beam along its normal"), "{error}");
    let infrared = written(
        r#"Sensor(title: "t", aperture: Point, acceptance: Cosine,
            channels: [(name: "E_v", responsivity: Band(from_nm: 900, to_nm: 950), reads: Illuminance)])"#,
    );
    let error = sheet_of(infrared).unwrap_err();
    assert!(error.to_string().contains("`E_v`") && error.to_string().contains("sees nothing"), "{error}");
    let watch = Watch { now: &|| 0.0, progress: &|_| {} };
    let options = Options { step_nm: 0.0, ..Options::default() };
    let error = data_sheet(&sensor("ideal-illuminance-meter.ron"), &options, &watch).unwrap_err();
    assert!(error.to_string().contains("0.1 nm to 20 nm"), "{error}");
}

fn etendue(arguments: &[&str]) -> std::process::Output {
    Command::new(env!("CARGO_BIN_EXE_etendue")).args(arguments).current_dir(root()).output().unwrap()
}

#[test]
fn the_command_writes_text_json_and_pictures() {
    let text = etendue(&["datasheet", "sensors/class-b-lux-meter.ron"]);
    let text = String::from_utf8(text.stdout).unwrap();
    assert!(text.contains("f1′") && text.contains("class B, p = 1.000") && text.contains("LED-B3"), "{text}");
    let json = etendue(&["datasheet", "sensors/class-b-lux-meter.ron", "--format", "json"]);
    let json: serde_json::Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!(json["channels"][0]["indices"][0]["class"], "B");
    let missing = etendue(&["datasheet", "sensors/nothing.ron"]);
    assert_eq!(missing.status.code(), Some(2));
    assert!(String::from_utf8(missing.stderr).unwrap().contains("nothing.ron"));
    let folder = std::env::temp_dir().join(format!("etendue-datasheet-{}", std::process::id()));
    let out = etendue(&["datasheet", "sensors/melanopic-meter.ron", "--out", folder.to_str().unwrap()]);
    assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
    let mut names: Vec<String> = std::fs::read_dir(&folder).unwrap().flatten().map(|e| e.file_name().into_string().unwrap()).collect();
    names.sort();
    std::fs::remove_dir_all(&folder).unwrap();
    for name in ["sheet.txt", "sheet.json"] {
        assert!(names.iter().any(|found| found == name), "{names:?}");
    }
    if cfg!(feature = "plot") {
        for name in ["directional.svg", "lamps-EDI_mel.png", "responsivity-E_v.svg"] {
            assert!(names.iter().any(|found| found == name), "{names:?}");
        }
    }
}

#[cfg(feature = "plot")]
#[test]
fn every_chart_of_the_shelf_can_be_drawn() {
    use etendue::report::datasheet::chart::charts;
    use etendue::report::plot::{Size, Style, Theme, svg};
    for file in ["class-b-lux-meter.ron", "directional-phi-meter.ron", "spectral-sensor-10-channels.ron", "silicon-photodiode-meter.ron"] {
        let sheet = sheet_of(sensor(file)).unwrap();
        for (stem, chart) in charts(&sheet) {
            let drawn = svg(&chart, &Style { theme: Theme::Light, size: Size::Paper });
            assert!(drawn.is_ok_and(|picture| picture.contains("<svg")), "{file} {stem}");
        }
    }
}

fn spread(channel: &ChannelSheet) -> Option<&Figure> {
    channel.indices.iter().find(|index| index.symbol == "f1′").map(|index| &index.measured)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_meters_are_measured_as_their_curves_are(
        shift in -6.0..6.0f64, wide in 0.94..1.08f64, leak in 0.0..0.02f64, leak_nm in 400.0..500.0f64, a in -0.05..0.05f64, b in 0.0..0.4f64,
    ) {
        let v = library::v_lambda();
        let s = |nm: f64| v.at(600.0 + (nm - 600.0 - shift) / wide) + leak * (-((nm - leak_nm) / 15.0).powi(2)).exp();
        let curve: String = (76..=160).map(|k| 5.0 * f64::from(k) - 20.0).map(|nm| format!("{nm},{:e}\n", s(nm))).collect();
        let r = |deg: f64| 1.0 + a * (2.0 * deg.to_radians()).sin().powi(2) - b * (deg / 90.0).powi(6);
        let response: String = (0..=30).map(|k| 3.0 * f64::from(k)).map(|deg| format!("{deg},{:e}\n", r(deg))).collect();
        let files = MemoryFiles::new()
            .with("s.csv", format!("wavelength_nm,s\n{curve}"))
            .with("r.csv", format!("theta_deg,R\n{response}"))
            .with("meter.ron", r#"Sensor(title: "t", aperture: Disc(radius_mm: 5), acceptance: Directional("r.csv"),
                channels: [(name: "E_v", responsivity: "s.csv", reads: Illuminance(adjusted_with: "A"))])"#);
        let sheet = sheet_of(sensor_from_file("meter.ron", &files, None).unwrap()).unwrap();
        let (deviation, what) = worst(&sheet);
        prop_assert!(deviation <= 4.0, "{} u, {}", deviation, what);
        // The bench is no excuse: it knows the index to a tenth of the finest limit.
        prop_assert!(spread(&sheet.channels[0]).is_some_and(|f| f.standard_uncertainty < 0.15));
    }
}
