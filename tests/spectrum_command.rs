//! `etendue spectrum` as a user runs it: numbers, units, files as they come, messages, exit codes.

#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used)]

use std::path::PathBuf;
use std::process::{Command, Output};

use serde_json::Value;

fn spectrum(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_etendue")).arg("spectrum").args(arguments).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// The JSON of a spectrum that is read without a complaint.
fn json(arguments: &[&str]) -> Value {
    let output = spectrum(&[arguments, &["--format", "json"]].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn row<'a>(sheet: &'a Value, id: &str) -> &'a Value {
    sheet["quantities"].as_array().unwrap().iter().find(|row| row["id"] == id).unwrap_or_else(|| panic!("{id} in {sheet}"))
}

fn number(sheet: &Value, id: &str) -> f64 {
    row(sheet, id)["value"].as_f64().unwrap_or_else(|| panic!("{}", row(sheet, id)))
}

/// A file in a folder of its own.
fn file(name: &str, bytes: &[u8]) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("spectrum-command");
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join(name);
    std::fs::write(&path, bytes).unwrap();
    path
}

#[test]
fn a_line_of_one_watt_gives_the_lumens_of_v_lambda() {
    let sheet = json(&["Line(546.07)", "--quantity", "flux"]);
    let flux = number(&sheet, "luminous");
    assert!((flux / (683.002 * etendue::spectrum::library::v_lambda().at(546.07)) - 1.0).abs() < 1e-14, "{flux}");
    assert_eq!(row(&sheet, "luminous")["unit"], "lm");
}

#[test]
fn a_unit_in_the_name_of_a_column_counts_as_one_in_the_header() {
    for (name, head) in [
        ("header", "# unit: W/(m2 nm)\nwavelength_nm,value\n400,1\n500,1\n"),
        ("brackets", "wavelength_nm,irradiance (W/(m² nm))\n400,1\n500,1\n"),
        ("underscores", "wavelength_nm,irradiance_w_m2_nm\n400,1\n500,1\n"),
        ("strokes", "wavelength_nm,W/m2/µm\n400,1000\n500,1000\n"),
    ] {
        let sheet = json(&[file(&format!("{name}.csv"), head.as_bytes()).to_str().unwrap()]);
        assert!((number(&sheet, "radiant") / 100.0 - 1.0).abs() < 1e-12, "{name}: {sheet}");
    }
}

#[test]
fn the_page_has_a_unit_or_a_name_for_every_number() {
    let output = spectrum(&["D65"]);
    let page = text(&output.stdout);
    assert!(output.status.success() && page.contains("scaled to an illuminance of 1000 lx"));
    for words in ["illuminance", " lx", "W/m²", "µmol/(m² s)", "mW/lm", "EDI / lx", "T_cp", " K\n", "0.31273"] {
        assert!(page.contains(words), "{words}\n{page}");
    }
}

#[test]
fn a_spectrum_can_be_scaled() {
    let [a, b] = ["500", "1000"].map(|lx| json(&["LED-B3", "--illuminance", lx]));
    assert!((number(&a, "luminous") - 500.0).abs() < 1e-9);
    assert!((2.0 * number(&a, "mel_equivalent_daylight") / number(&b, "mel_equivalent_daylight") - 1.0).abs() < 1e-12);
    assert_eq!(number(&a, "cct"), number(&b, "cct"));
    let c = json(&["LED-B3", "--irradiance", "2"]);
    assert!((number(&c, "radiant") - 2.0).abs() < 1e-12);
}

#[test]
fn a_file_with_units_is_absolute_and_its_uncertainties_go_all_the_way() {
    let lamp = "# wavelength_unit: nm\n# per: nm\n# unit: W/(m² nm)\nwavelength_nm,irradiance,standard_uncertainty\n\
                400,0.01,0.0001\n500,0.02,0.0002\n600,0.03,0.0003\n700,0.01,0.0001\n";
    let path = file("lamp.csv", lamp.as_bytes());
    let [each, together] = [&[path.to_str().unwrap()][..], &[path.to_str().unwrap(), "--correlated"]].map(json);
    assert!((number(&each, "radiant") - 6.0).abs() < 1e-12);
    assert!(each["scale"].as_str().unwrap().contains("absolute"));
    // ∫ hⱼ dλ is 50, 100, 100, 50 nm.
    let parts = [50.0 * 1e-4, 100.0 * 2e-4, 100.0 * 3e-4, 50.0 * 1e-4];
    let u = |sheet: &Value, id: &str| row(sheet, id)["standard_uncertainty"].as_f64().unwrap();
    let quadratic = parts.iter().map(|p: &f64| p * p).sum::<f64>().sqrt();
    assert!((u(&each, "radiant") / quadratic - 1.0).abs() < 1e-9);
    assert!((u(&together, "radiant") / parts.iter().sum::<f64>() - 1.0).abs() < 1e-9);
    // One per cent in all rows together leaves colours alone.
    assert!(u(&together, "chromaticity_x_1931") < 1e-9 && u(&each, "chromaticity_x_1931") > 1e-5);
    assert!(each["remarks"].as_array().unwrap().iter().any(|remark| remark.as_str().unwrap().contains("400 nm to 700 nm")));
}

#[test]
fn decimal_commas_are_accepted_and_said() {
    let path = file("commas.csv", "\u{feff}# per: nm\r\n# wavelength_unit: nm\r\n400;1,5\r\n500;2,5\r\n600;0,5\r\n".as_bytes());
    let output = spectrum(&[path.to_str().unwrap(), "--format", "json"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let sheet: Value = serde_json::from_slice(&output.stdout).unwrap();
    let said = |remark: &str| remark.to_lowercase().contains("decimal comma");
    assert!(sheet["remarks"].as_array().unwrap().iter().any(|remark| said(remark.as_str().unwrap())), "{sheet}");
    assert!(text(&output.stderr).lines().any(|line| line.starts_with("remark: ") && said(line)));
}

#[test]
fn an_unknown_unit_is_not_guessed() {
    let path = file("milliwatt.csv", b"# wavelength_unit: nm\n# per: nm\n# unit: mW/(m2 nm)\n400,1\n500,2\n600,1\n");
    let output = spectrum(&[path.to_str().unwrap()]);
    assert!(output.status.success());
    assert!(text(&output.stdout).contains("relative"));
    assert!(text(&output.stderr).contains("--quantity"));
}

#[test]
fn a_spectrum_is_written_again_and_reads_back() {
    for (format, extension) in [("csv", "csv"), ("spdx", "spdx")] {
        let path = file(&format!("again.{extension}"), b"");
        let output = spectrum(&["LED-B3", "--resample", "380:780:1", "--as", format, "--out", path.to_str().unwrap()]);
        assert!(output.status.success(), "{}", text(&output.stderr));
        assert!(text(&output.stderr).contains("remark: "));
        let [again, before] = [json(&[path.to_str().unwrap()]), json(&["LED-B3"])];
        assert!((number(&again, "cct") / number(&before, "cct") - 1.0).abs() < 1e-3, "{format}");
    }
    let output = spectrum(&["BlackBody(3000)", "--as", "csv"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("--resample"));
}

#[test]
fn resampling_says_what_it_costs() {
    let output = spectrum(&["FL11", "--resample", "380:780:10", "--format", "json"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let sheet: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(!sheet["remarks"].as_array().unwrap().is_empty());
    assert_eq!(spectrum(&["FL11", "--resample", "780:380:5"]).status.code(), Some(2));
}

#[test]
fn csv_reads_back() {
    let output = spectrum(&["A", "--format", "csv"]);
    let page = text(&output.stdout);
    let header: Vec<&str> = page.lines().next().unwrap().split(',').collect();
    assert!(header.contains(&"id") && header.contains(&"unit") && header.contains(&"value"));
    let line = page.lines().find(|line| line.contains(",cct,")).unwrap();
    assert!(line.contains(",K,"), "{line}");
}

#[test]
fn a_file_can_take_the_sheet_and_a_bad_place_is_told() {
    let path = file("taken.json", b"");
    let target = path.with_file_name("sheet.json");
    let _ = std::fs::remove_file(&target);
    let output = spectrum(&["D50", "--format", "json", "--out", target.to_str().unwrap()]);
    assert!(output.status.success() && output.stdout.is_empty());
    let sheet: Value = serde_json::from_slice(&std::fs::read(&target).unwrap()).unwrap();
    assert_eq!(sheet["schema"], 1);
    let output = spectrum(&["D50", "--out", "no/such/folder/sheet.txt"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("no/such/folder/sheet.txt"));
}

#[test]
fn mistakes_end_with_code_2_and_say_what_to_type() {
    let empty = file("empty.csv", b"");
    let broken = file("broken.csv", b"# per: nm\n# wavelength_unit: nm\n400,1\n390,2\n500,x\n600,-1\n");
    let (empty, broken) = (empty.to_str().unwrap(), broken.to_str().unwrap());
    for (arguments, words) in [
        (&["D66"][..], &["D65"][..]),
        (&["V"], &["spectral distribution"]),
        (&["BlackBody(-3)"], &["1e-12 K to 1e9 K"]),
        (&["no-such-file.csv"], &["no-such-file.csv"]),
        (&[empty], &["empty.csv"]),
        (&[broken], &["broken.csv:4", "broken.csv:5", "broken.csv:6"]),
        (&["A", "--illuminance", "-5"], &["above 0"]),
        (&["A", "--illuminance", "5", "--irradiance", "3"], &["--irradiance"]),
        (&["A", "--white", "D66"], &["D65"]),
        (&["Line(10000)", "--illuminance", "5"], &["irradiance"]),
        (&["A", "--quantity", "lux"], &["irradiance"]),
    ] {
        let output = spectrum(arguments);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
        assert!(output.stdout.is_empty(), "{arguments:?}");
        for word in words {
            assert!(message.contains(word), "{arguments:?}: {word} in\n{message}");
        }
    }
}

#[test]
fn a_unit_and_a_quantity_that_contradict_each_other_are_told() {
    let rows = "400,1\n500,2\n600,1\n";
    let of = |name: &str, header: &str, more: &[&str]| {
        let path = file(name, format!("# wavelength_unit: nm\n{header}{rows}").as_bytes());
        let output = spectrum(&[&[path.to_str().unwrap()], more].concat());
        (output.status.code(), text(&output.stdout), text(&output.stderr))
    };
    let (code, _, told) = of("contradiction.csv", "# unit: W/(m2 nm)\n# quantity: spectral radiance\n", &[]);
    assert!(code == Some(2) && told.contains("that of a spectral irradiance") && told.contains("`spectral radiance`"), "{told}");
    let (code, page, _) = of("exitance.csv", "# unit: W/(m2 nm)\n# quantity: spectral radiant exitance\n", &[]);
    assert!(code == Some(0) && page.contains("absolute: spectral radiant exitance"), "{page}");
    let (code, _, told) = of("multiple.csv", "# unit: mW/(m2 nm)\n", &["--quantity", "irradiance"]);
    assert!(code == Some(0) && told.contains("no number is converted"), "{told}");
}

#[test]
fn what_is_out_of_the_range_of_numbers_is_said() {
    let huge = file("huge.csv", b"# wavelength_unit: nm\n# per: nm\n400,1e308\n500,1e308\n600,1e308\n");
    let output = spectrum(&[huge.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("1.8e308"));
    let cold = spectrum(&["BlackBody(1)", "--quantity", "radiance"]);
    assert!(cold.status.success() && text(&cold.stderr).contains("below 1e-308"), "{}", text(&cold.stderr));
}

#[cfg(unix)]
#[test]
fn what_is_no_file_is_written_to_and_not_replaced() {
    use std::os::unix::fs::FileTypeExt;
    let pipe = file("pipe", b"");
    std::fs::remove_file(&pipe).unwrap();
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let mut reader = Command::new("cat").arg(&pipe).stdout(std::process::Stdio::piped()).spawn().unwrap();
    let output = spectrum(&["D65", "--out", pipe.to_str().unwrap()]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let still_a_pipe = std::fs::metadata(&pipe).unwrap().file_type().is_fifo();
    if !still_a_pipe {
        reader.kill().unwrap();
    }
    let read = text(&reader.wait_with_output().unwrap().stdout);
    assert!(still_a_pipe && read.contains("illuminance"), "{read}");
    std::fs::remove_file(&pipe).unwrap();
}

#[cfg(feature = "plot")]
#[test]
fn numbers_that_were_converted_to_per_nm_bear_that_unit() {
    let folder = std::env::temp_dir().join(format!("etendue-plot-unit-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("lamp.csv"), "# wavelength_unit: nm\n# unit: W/(m2 um)\n400,1000\n500,2000\n").unwrap();
    let arguments = ["plot", "spectrum", "lamp.csv", "--relative-to", "nothing", "--csv", "lamp-drawn.csv"];
    let output = Command::new(env!("CARGO_BIN_EXE_etendue")).current_dir(&folder).args(arguments).output().unwrap();
    let message = text(&output.stderr);
    assert!(output.status.success() && message.contains("divided by 1000"), "{message}");
    let drawn = std::fs::read_to_string(folder.join("lamp-drawn.csv")).unwrap();
    assert!(drawn.contains("W/(m² nm)") && drawn.contains(",400,1,"), "{drawn}");
    std::fs::remove_dir_all(&folder).unwrap();
}
