//! The three forms of a sheet.

use super::*;
use crate::observer::sheet::{RowUncertainty, Scale, SheetOptions, SpectralQuantity};
use crate::spectrum::{Density, Outside, Table};

fn report(density: &Density, options: &SheetOptions) -> SpectrumReport {
    let sheet = SpectrumSheet::new(density, options).unwrap();
    SpectrumReport { spectrum: "a lamp, \"warm\"".into(), sheet, remarks: vec!["commas are decimal commas".into()] }
}

#[test]
fn the_page_states_its_scale_and_every_group() {
    let text = to_text(&report(&Density::illuminant_a(), &SheetOptions::default()));
    assert!(text.starts_with("a lamp, \"warm\"\n  relative, scaled to an illuminance of 1000 lx\n"));
    for words in ["Luminous", "α-opic", "T_cp", " K\n", "melanopic", "S cone", "#"] {
        assert!(text.contains(words), "{words}\n{text}");
    }
    assert!(text.lines().all(|line| line.chars().count() <= 100 && line.trim_end() == line), "{text}");
    assert!(!text.contains("NaN") && !text.contains("inf "));
}

#[test]
fn decimal_points_of_a_list_stand_one_under_the_other() {
    let text = to_text(&report(&Density::illuminant_a(), &SheetOptions::default()));
    let places: Vec<usize> =
        text.lines().filter(|line| line.contains(" E_v")).map(|line| line.chars().position(|c| c == '.').unwrap()).collect();
    assert!(places.len() >= 4 && places.iter().all(|place| *place == places[0]), "{places:?}\n{text}");
}

#[test]
fn json_holds_every_row_and_every_remark() {
    let report = report(&Density::line(546.07, 1.0).unwrap(), &SheetOptions::default());
    let json: serde_json::Value = serde_json::from_str(&to_json(&report)).unwrap();
    assert_eq!((json["schema"].as_u64(), json["spectrum"].as_str()), (Some(1), Some("a lamp, \"warm\"")));
    assert_eq!(json["remarks"][0], "commas are decimal commas");
    let quantities = json["quantities"].as_array().unwrap();
    assert_eq!(quantities.len(), report.sheet.rows.len());
    let of = |id: &str| quantities.iter().find(|row| row["id"] == id).unwrap();
    assert_eq!(of("peak_wavelength")["value"], 546.07);
    assert!(of("cct")["value"].is_null() && of("cct")["undefined"].as_str().unwrap().contains("Duv"));
}

#[test]
fn csv_has_a_row_a_quantity_and_keeps_all_digits() {
    let report = report(&Density::illuminant_a(), &SheetOptions::default());
    let text = to_csv(&report);
    let mut reader = ::csv::Reader::from_reader(text.as_bytes());
    let rows: Vec<::csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), report.sheet.rows.len());
    let cct = rows.iter().find(|row| &row[2] == "cct").unwrap();
    assert_eq!(cct[7].parse::<f64>().ok(), report.sheet.number("cct"));
}

#[test]
fn an_uncertainty_stands_beside_its_value() {
    let table = Table::from_rows(&[(500.0, 1.0), (510.0, 1.0)], Outside::Zero).unwrap();
    let uncertainty = RowUncertainty { wavelengths_nm: vec![500.0, 510.0], standard_uncertainty: vec![0.1, 0.1], correlated: true };
    let scale = Scale::Absolute(SpectralQuantity::Irradiance);
    let report =
        report(&Density::table(table).unwrap(), &SheetOptions { scale, uncertainty: Some(uncertainty), ..SheetOptions::default() });
    let text = to_text(&report);
    assert!(text.lines().any(|line| line.contains("10.0 ± 1.0 ") && line.ends_with("W/m²")), "{text}");
    assert!(text.contains("± standard uncertainty"));
}
