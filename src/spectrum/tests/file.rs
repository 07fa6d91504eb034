//! Files of spectra and factors: units stated, asked for and contradicted; remarks; round trips.

use proptest::prelude::*;

use super::*;
use crate::spectrum::table_units::WavelengthUnit::{Metre, Micrometre, Nanometre};

fn good(text: &str) -> SpectrumFile {
    read(text.as_bytes(), &FileRules::default()).unwrap_or_else(|problems| panic!("{text:?}: {problems:?}"))
}

fn rows(text: &str) -> Vec<(f64, f64)> {
    good(text).curve.table.rows().collect()
}

/// The one problem, as (line, column, message and help).
fn refused(text: &str) -> (usize, usize, String) {
    refused_with(text, &FileRules::default())
}

fn refused_with(text: &str, rules: &FileRules) -> (usize, usize, String) {
    let mut problems = read(text.as_bytes(), rules).err().unwrap_or_else(|| panic!("{text:?} was read"));
    assert_eq!(problems.len(), 1, "{text:?}: {problems:?}");
    let problem = problems.remove(0);
    (problem.line, problem.column, format!("{}; {}", problem.message, problem.help))
}

fn remarks(text: &str) -> String {
    good(text).curve.remarks.join("\n")
}

#[test]
fn stated_units_are_converted_and_told() {
    let plain = [(400.0, 1.0), (500.5, 2.0)];
    for text in [
        "400,1\n500.5,2\n",
        "# wavelength_unit: um\n0.4,1\n0.5005,2\n",
        "# wavelength_unit: µm\n0.4,1\n0.5005,2\n",
        "# wavelength_unit: m\n4e-7,1\n500.5e-9,2\n",
        "# wavelength_unit: angstrom\n4000,1\n5005,2\n",
        "wavelength_um,power\n0.4,1\n0.5005,2\n",
        "Wavelength [µm];power\n0,4;1\n0,5005;2\n",
        "# per: um\n400,1000\n500.5,2000\n",
        "# per: m\n400,1e9\n500.5,2e9\n",
        "# per: band 5 nm\n400,5\n500.5,10\n",
        "# unit: W/(m2 um)\n400,1000\n500.5,2000\n",
        "nm,power per 2 nm\n400,2\n500.5,4\n",
    ] {
        assert_eq!(rows(text), plain, "{text}");
    }
    assert!(
        remarks("# wavelength_unit: um\n0.4,1\n0.5,2\n").contains("converted from µm to nm (`# wavelength_unit: um`): 400 nm to 500 nm")
    );
    assert!(remarks("# per: band 5 nm\n400,5\n500,10\n").contains("values per band of 5 nm divided by 5"));
    assert!(remarks("400,5\n500,10\n").contains("taken per nm"));
    assert!(remarks("400,5\n500,10\n").contains("taken in nm"));
    let all_said = remarks("# per: nm\nwavelength_nm,flux\n400,5\n500,10\n");
    assert_eq!(all_said, "zero outside 400 nm to 500 nm, the range of the file");
}

#[test]
fn what_the_caller_states_counts_as_if_it_stood_in_the_file() {
    let rules = FileRules { wavelength_unit: Some(Micrometre), per: Some(Per::Band { width_nm: 5.0 }), decimal_comma: false };
    let file = read(b"0.4,5\n0.5,10\n", &rules).unwrap();
    assert_eq!(file.curve.table.rows().collect::<Vec<_>>(), [(400.0, 1.0), (500.0, 2.0)]);
    assert!(file.curve.remarks.iter().any(|remark| remark.contains("the option")));
    let (line, _, words) = refused_with("# wavelength_unit: nm\n400,1\n500,1\n", &rules);
    assert!(line == 1 && words.contains("the option says µm"), "{words}");
    let commas = FileRules { decimal_comma: true, ..FileRules::default() };
    assert_eq!(read(b"400;1,234\n500;2,345\n", &commas).unwrap().curve.table.values(), [1.234, 2.345]);
    let metres = FileRules { wavelength_unit: Some(Metre), ..FileRules::default() };
    assert!(read(include_bytes!("../../../tests/diagnostics/valid/sensors/lamp.spdx"), &metres).is_err());
    assert!(
        read(
            include_bytes!("../../../tests/diagnostics/valid/sensors/lamp.spdx"),
            &FileRules { wavelength_unit: Some(Nanometre), ..metres }
        )
        .is_ok()
    );
}

#[test]
fn wavelengths_below_10_are_asked_about() {
    let (line, _, words) = refused("# name: x\n0.4,1\n0.7,2\n");
    assert!(line == 2 && words.contains("write `# wavelength_unit: um`"), "{words}");
    assert!(refused("4e-7,1\n7e-7,2\n").2.contains("write `# wavelength_unit: m`"));
    assert!(refused("wavelength_nm,x\n0.4,1\n0.7,2\n").2.contains("the column `wavelength_nm` says nm; correct that to um"));
    assert!(refused("# wavelength_unit: um\n4e-7,1\n7e-7,2\n").2.contains("is that so?"));
}

#[test]
fn contradictions_name_both_statements() {
    let (line, _, words) = refused("# wavelength_unit: nm\nwavelength_um,power\n400,1\n500,2\n");
    assert!(line == 2 && words.contains("`wavelength_um`") && words.contains("`# wavelength_unit: nm` says nm"), "{words}");
    let (line, _, words) = refused("# per: nm\n# unit: W/m2/um\n400,1\n500,2\n");
    assert!(line == 2 && words.contains("per µm") && words.contains("lines 1 and 2"), "{words}");
    assert!(refused("# per: nm\nnm,power per 5 nm\n400,1\n500,2\n").2.contains("per band of 5 nm"));
    assert!(refused("# per: furlong\n400,1\n500,2\n").2.contains("band 5 nm"));
    assert!(refused("# wavelength_unit: inch\n400,1\n500,2\n").2.contains("angstrom"));
}

#[test]
fn decimal_commas_that_can_be_nothing_else_are_accepted_and_told() {
    for text in [
        "380,5;0,12\n381,5;0,13\n",
        "380,5\t0,12\n381,5\t0,13\n",
        "380,5 0,12\n381,5 0,13\n",
        "\u{feff}nm;W\r\n380,5;0,12\r\n381,5;0,13\r\n",
    ] {
        assert_eq!(rows(text), [(380.5, 0.12), (381.5, 0.13)], "{text:?}");
        assert!(remarks(text).contains("decimal commas"), "{text:?}");
    }
    assert_eq!(rows("# decimal: comma\n380;1,234\n390;2,345\n"), [(380.0, 1.234), (390.0, 2.345)]);
    let (line, column, words) = refused("380;1,234\n390;2,345\n");
    assert!((line, column) == (1, 5) && words.contains("1.234 or 1234"), "{words}");
    assert!(refused("380;0.5\n390;0,6\n").2.contains("a comma where"));
    assert!(refused("380;1,234.5\n390;2,345.6\n").2.contains("thousands"));
    assert!(refused("380,0,12\n390,0,13\n").2.contains("if commas here are decimal commas"));
    assert!(remarks("\u{feff}380,1\r\n390,2\r\n").contains("byte order mark"));
    assert!(remarks("380;1\r\n390;2\r\n").contains("Windows") && remarks("380;1\n390;2\n").contains("semicolons"));
}

#[test]
fn uncertainties_are_a_third_column_and_are_converted_with_the_values() {
    for name in ["u", "uncertainty", "standard_uncertainty", "Standard uncertainty"] {
        let file = good(&format!("# per: um\nnm,flux,{name}\n400,1000,10\n500,2000,20\n"));
        assert_eq!(file.curve.standard_uncertainty, Some(vec![0.01, 0.02]), "{name}");
    }
    assert!(refused("nm,flux,u\n400,1,0.1\n500,2,-0.1\n").2.contains("negative"));
    assert!(refused("nm,left,right\n400,1,2\n500,1,2\n").2.contains("standard_uncertainty"));
    assert!(good("# per: nm\nnm,flux\n400,1\n500,2\n").curve.standard_uncertainty.is_none());
}

#[test]
fn holes_and_rows_that_are_no_rows_are_told() {
    assert!(refused("400,1\n410,\n420,2\n").2.contains("too few columns"));
    assert!(refused("nm;x;u\n400;1;1\n410;;1\n420;2;1\n").2.contains("give a value, or leave the row out"));
    assert!(refused("400,1\n").2.contains("one row"));
    assert!(refused("400,1\n410,abc\n").2.contains("not a number"));
    assert!(refused("400,1\n410,nan\n").2.contains("finite"));
    assert!(refused("400,1\n410,-1\n").2.contains("negative"));
    let (line, _, words) = refused("420,1\n410,2\n400,3\n390,3\n");
    assert!(line == 2 && words.contains("fall from row to row"), "{words}");
    let gap: String = (0..20).filter(|i| !(7..12).contains(i)).map(|i| format!("{},1\n", 400 + 5 * i)).collect();
    assert!(remarks(&gap).contains("a gap: no row between 430 nm and 460 nm"), "{}", remarks(&gap));
    assert!(!remarks("400,1\n405,1\n410,1\n415,1\n420,1\n430,1\n").contains("gap"));
}

#[test]
fn a_factor_is_not_per_anything() {
    let factor = |text: &str| read_curve(text.as_bytes(), Meaning::Factor, &FileRules::default());
    let file = factor("# unit: A/W\nnm,responsivity\n400,0.1\n500,0.2\n").unwrap();
    assert!(!file.remarks.iter().any(|remark| remark.contains("per nm")), "{:?}", file.remarks);
    assert!(factor("# per: nm\n400,0.1\n500,0.2\n").unwrap_err()[0].message.contains("a factor is needed"));
}

#[test]
fn spdx_says_what_it_is() {
    let text = include_str!("../../../tests/diagnostics/valid/sensors/lamp.spdx");
    let file = good(text);
    assert_eq!(file.curve.unit.as_deref(), Some("W m⁻² nm⁻¹"));
    assert_eq!(file.density.total(), 320.0);
    let problems = read_curve(text.as_bytes(), Meaning::Factor, &FileRules::default()).unwrap_err();
    assert!(problems[0].line == 18 && problems[0].help.contains("reflectance"), "{problems:?}");
    let reflectance = text.replace("irradiance", "reflectance");
    assert!(read_curve(reflectance.as_bytes(), Meaning::Factor, &FileRules::default()).is_ok());
    assert!(refused(&reflectance).2.contains("a spectral distribution is needed"));
    let written = write_spdx(&file.curve.table, spdx::SpectralQuantity::Flux, &spdx::SpdxHeader::default());
    assert_eq!(good(&written).density, file.density);
}

proptest! {
    #[test]
    fn what_is_written_is_read_back_bit_by_bit(list in prop::collection::vec((1e-3..50.0_f64, 0.0..1e300_f64, 0.0..1e300_f64), 2..30), with: bool) {
        let mut nm = 200.0;
        let wavelengths: Vec<f64> = list.iter().map(|(step, ..)| { nm += step; nm }).collect();
        let table = Table::new(wavelengths, list.iter().map(|row| row.1).collect(), Outside::Zero).unwrap();
        let uncertainties: Vec<f64> = list.iter().map(|row| row.2).collect();
        let header = [("name", "a: b\nc"), ("unit", "W/um"), ("per", "um"), ("Name", "again")].map(|(k, v)| (k.to_owned(), v.to_owned()));
        let text = write_csv(&table, with.then_some(&uncertainties), Meaning::Density, &header).unwrap();
        let file = read(text.as_bytes(), &FileRules::default()).unwrap();
        prop_assert_eq!(&file.curve.table, &table);
        prop_assert_eq!(file.curve.standard_uncertainty, with.then_some(uncertainties));
        prop_assert_eq!(file.curve.name.as_deref(), Some("a: b c"));
        prop_assert!(file.curve.remarks.iter().all(|remark| !remark.contains("taken")));
    }

    #[test]
    fn no_bytes_make_it_panic(bytes in prop::collection::vec(any::<u8>(), 0..300), text in "[0-9eE.,;#:\\-+ \t\n\ra-cnumpµ/\"]{0,200}") {
        for input in [&bytes[..], text.as_bytes()] {
            for meaning in [Meaning::Density, Meaning::Factor] {
                if let Err(problems) = read_curve(input, meaning, &FileRules::default()) {
                    prop_assert!(!problems.is_empty());
                }
            }
        }
    }
}

#[test]
fn numbers_of_photons_are_no_spectrum_of_power() {
    for unit in ["photons/(s m2 nm)", "µmol/(m² s nm)", "umol m-2 s-1 nm-1"] {
        let problems = read(format!("# unit: {unit}\n400,1\n500,2\n").as_bytes(), &FileRules::default()).unwrap_err();
        assert!(problems[0].message.contains("counts photons") && problems[0].help.contains("hc/λ"), "{problems:?}");
    }
}
