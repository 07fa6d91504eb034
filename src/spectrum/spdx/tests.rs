//! Spectra of IES TM-27: what is read, what is told, and what comes back.

use proptest::prelude::*;

use super::{Spdx, SpdxHeader, SpectralQuantity, read, write};

/// `tests/diagnostics/valid/sensors/lamp.spdx`.
const LAMP: &str = include_str!("../../../tests/diagnostics/valid/sensors/lamp.spdx");

fn any_spdx() -> impl Strategy<Value = Spdx> {
    let rows = prop::collection::vec((1e-3..50.0_f64, 0.0..1e300_f64), 2..30);
    (rows, 0..12_usize, "[ -~äµ&<>\"']{1,30}", prop::option::of(0.0..100.0_f64), prop::option::of(any::<bool>())).prop_map(
        |(rows, quantity, description, bandwidth_fwhm_nm, bandwidth_corrected)| {
            let mut nm = 200.0;
            let wavelengths_nm = rows
                .iter()
                .map(|(step, _)| {
                    nm += step;
                    nm
                })
                .collect();
            let description = Some(description.trim().to_owned()).filter(|text| !text.is_empty());
            Spdx {
                header: SpdxHeader { description, ..SpdxHeader::default() },
                quantity: SpectralQuantity::ALL[quantity],
                quantity_place: (9, 3),
                reflection_geometry: Some("d:d".into()),
                transmission_geometry: None,
                bandwidth_fwhm_nm,
                bandwidth_corrected,
                wavelengths_nm,
                values: rows.iter().map(|(_, value)| *value).collect(),
                remarks: Vec::new(),
            }
        },
    )
}

proptest! {
    #[test]
    fn what_is_written_is_read_back_bit_by_bit(spectrum in any_spdx()) {
        let found = read(write(&spectrum).as_bytes()).unwrap();
        prop_assert_eq!(Spdx { quantity_place: (9, 3), ..found }, spectrum);
    }

    #[test]
    fn damaged_documents_end_in_a_spectrum_or_in_problems(at in 0.0..1.0_f64, byte: u8, length in 0..60_usize, kind in 0..3_u8) {
        let mut bytes = LAMP.as_bytes().to_vec();
        let at = ((at * bytes.len() as f64) as usize).min(bytes.len() - 1);
        match kind {
            0 => bytes[at] = byte,
            1 => bytes.truncate(at),
            _ => drop(bytes.drain(at..(at + length).min(bytes.len()))),
        }
        if let Err(problems) = read(&bytes) {
            prop_assert!(!problems.is_empty() && problems.iter().all(|problem| problem.line >= 1 && problem.column >= 1));
        }
    }

    #[test]
    fn no_bytes_make_it_panic(bytes in prop::collection::vec(any::<u8>(), 0..300), text in "[<>/!?\\[\\]&;#a-zA-Z=\" \n-]{0,200}") {
        let _ = read(&bytes);
        let _ = read(text.as_bytes());
        let _ = read(format!("<IESTM2714>{text}</IESTM2714>").as_bytes());
    }
}

#[test]
fn a_file_with_everything_is_read() {
    let found = read(LAMP.as_bytes()).unwrap();
    assert_eq!(found.quantity, SpectralQuantity::Irradiance);
    assert_eq!(found.header.description.as_deref(), Some("Rectangular test distribution <not a lamp>"));
    assert_eq!(found.header.entries().len(), 11);
    assert_eq!((found.bandwidth_fwhm_nm, found.bandwidth_corrected), (Some(2.0), Some(true)));
    assert_eq!((found.wavelengths_nm[0], found.values[0]), (380.0, 0.0));
    assert_eq!(found.wavelengths_nm.len(), found.values.len());
    assert_eq!(found.remarks.len(), 0);
}

/// The messages of a file with these rows, each with its line and column.
fn told(quantity: &str, rows: &str) -> Vec<(usize, usize, String)> {
    let text = format!(
        "<?xml version=\"1.0\"?>\n<IESTM2714 xmlns=\"iestm2714\" version=\"1.0\">\n<SpectralDistribution>\n{quantity}\n{rows}\n</SpectralDistribution>\n</IESTM2714>"
    );
    let problems = read(text.as_bytes()).err().unwrap_or_default();
    problems.into_iter().map(|problem| (problem.line, problem.column, format!("{}; {}", problem.message, problem.help))).collect()
}

#[test]
fn all_problems_come_at_once_with_their_places() {
    let rows = "<SpectralData wavelength=\"400\">1</SpectralData>\n<SpectralData wavelength=\"390\">x</SpectralData>\n <SpectralData wavelength=\"390\">-1</SpectralData>\n<SpectralData>1</SpectralData>\n<SpectralData wavelength=\"inf\">1</SpectralData>";
    let list = told("<SpectralQuantity>fluks</SpectralQuantity>", rows);
    let places: Vec<(usize, usize)> = list.iter().map(|(line, column, _)| (*line, *column)).collect();
    assert_eq!(places, [(4, 1), (6, 1), (7, 2), (7, 2), (8, 1), (9, 1)], "{list:#?}");
    assert!(list[0].2.contains("`fluks`") && list[0].2.contains("flux"), "{list:?}");
    assert!(told("", "")[0].2.contains("no `SpectralQuantity`"));
    let quantity = "<SpectralQuantity>flux</SpectralQuantity>";
    assert!(told(quantity, "<SpectralData wavelength=\"400\">1</SpectralData>")[0].2.contains("1 rows"));
    let micrometres = "<SpectralData wavelength=\"0.4\">1</SpectralData><SpectralData wavelength=\"0.5\">1</SpectralData>";
    assert!(told(quantity, micrometres)[0].2.contains("in nm"));
    assert!(read(b"<spectrum/>").unwrap_err()[0].help.contains("IESTM2714"));
    assert!(read(b"<IESTM2714><a></IESTM2714>").unwrap_err()[0].message.contains("broken"));
}

#[test]
fn hostile_documents_are_refused() {
    let bomb = "<!DOCTYPE x [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;\">]><IESTM2714>&b;</IESTM2714>";
    assert!(read(bomb.as_bytes()).unwrap_err()[0].help.contains("type definition"));
    let deep = format!("<IESTM2714>{}{}</IESTM2714>", "<a>".repeat(1_000_000), "</a>".repeat(1_000_000));
    assert!(read(deep.as_bytes()).unwrap_err()[0].message.contains("deeper"));
    let unclosed = "<IESTM2714>\n".repeat(100_000);
    assert!(read(unclosed.as_bytes()).unwrap_err()[0].message.contains("deeper"));
    let split = "<a\n>".repeat(100_000);
    assert!(read(split.as_bytes()).is_err());
}

#[test]
fn unknown_elements_are_left_out_and_told() {
    let text = "<IESTM2714><Header><Colour>red</Colour></Header><SpectralDistribution><SpectralQuantity>Relative</SpectralQuantity>\
        <SpectralData wavelength=\"400\">1</SpectralData><SpectralData wavelength=\"500\">1</SpectralData></SpectralDistribution></IESTM2714>";
    let found = read(text.as_bytes()).unwrap();
    assert_eq!(found.quantity, SpectralQuantity::Relative);
    assert!(found.remarks[0].contains("`Colour`"), "{:?}", found.remarks);
}

#[test]
fn files_of_other_programs_are_read() {
    // As the package colour-science writes them: another namespace, `None` where nothing is known.
    let text = "<?xml version=\"1.0\" ?>\n<IESTM2714 xmlns=\"http://www.ies.org/iestm2714\" version=\"1.0\">\n\t<Header>\n\t\t<Description>d</Description>\n\t\t\
        <DocumentCreator>c</DocumentCreator>\n\t</Header>\n\t<SpectralDistribution>\n\t\t<SpectralQuantity>flux</SpectralQuantity>\n\t\t\
        <ReflectionGeometry>None</ReflectionGeometry>\n\t\t<BandwidthFWHM>None</BandwidthFWHM>\n\t\t<BandwidthCorrected>false</BandwidthCorrected>\n\t\t\
        <SpectralData wavelength=\"380.0\">0.5</SpectralData>\n\t\t<SpectralData wavelength=\"400.0\">1.0</SpectralData>\n\t</SpectralDistribution>\n</IESTM2714>\n";
    let found = read(text.as_bytes()).unwrap();
    assert_eq!((found.wavelengths_nm, found.values), (vec![380.0, 400.0], vec![0.5, 1.0]));
    assert_eq!((found.reflection_geometry, found.bandwidth_fwhm_nm, found.bandwidth_corrected), (None, None, Some(false)));
    assert!(found.remarks.is_empty());
}

#[test]
fn what_is_there_twice_is_not_dropped() {
    let document = |inner: &str| {
        let rows = r#"<SpectralData wavelength="400">1</SpectralData><SpectralData wavelength="500">2</SpectralData>"#;
        format!(
            "<IESTM2714><SpectralDistribution><SpectralQuantity>flux</SpectralQuantity>{inner}{rows}</SpectralDistribution></IESTM2714>"
        )
    };
    assert!(read(document("").as_bytes()).is_ok());
    let message = |inner: &str| read(document(inner).as_bytes()).unwrap_err()[0].message.clone();
    assert_eq!(message("<SpectralQuantity>radiance</SpectralQuantity>"), "there is a second `SpectralQuantity`");
    assert_eq!(message(r#"<SpectralData wavelength="390">1<b>2</b></SpectralData>"#), "an element `b` within a row");
}
