//! Curve files: what is accepted, every problem with its place, and no panic on anything.

use proptest::prelude::*;

use crate::spectrum::table_text::{TextProblem, TextRules, parse, parse_bytes};

fn problems(text: &str) -> Vec<TextProblem> {
    parse(text, &TextRules::default()).unwrap_err()
}

/// The one problem of a text, as (line, column, message, help).
fn only_problem(text: &str) -> (usize, usize, String, String) {
    let mut list = problems(text);
    assert_eq!(list.len(), 1, "{list:?}");
    let problem = list.remove(0);
    (problem.line, problem.column, problem.message, problem.help)
}

#[test]
fn header_names_and_columns_are_read() {
    let text =
        "\u{feff}# Name: my diode\r\n# a remark\r\n# unit: A/W\r\nwavelength_nm,red,green\r\n380,0.1,0.2\r\n\r\n# note\r\n390,0.3,4e-1\r\n";
    let table = parse(text, &TextRules::default()).unwrap();
    assert_eq!(table.header_value("name"), Some("my diode"));
    assert_eq!(table.header.len(), 2);
    assert_eq!(table.column_names, ["red", "green"]);
    assert_eq!(table.wavelengths_nm, [380.0, 390.0]);
    assert_eq!(table.columns, [[0.1, 0.3], [0.2, 0.4]]);
}

#[test]
fn separators_may_be_comma_semicolon_tab_or_blanks() {
    for separator in [",", ", ", ";", "\t", "  "] {
        for names in ["", "nm{}value\n"] {
            let text = format!("{names}380{{}}0.5\n390{{}}0.6").replace("{}", separator);
            assert_eq!(parse(&text, &TextRules::default()).unwrap().columns, [[0.5, 0.6]], "{text:?}");
        }
    }
}

#[test]
fn all_problems_come_at_once() {
    let list = problems("380,0.1\n390,abc\n385,nan\n385\n400,-1\n400,2\n");
    let lines: Vec<usize> = list.iter().map(|problem| problem.line).collect();
    assert_eq!(lines, [2, 3, 3, 4, 5, 6], "{list:#?}");
}

#[test]
fn a_first_row_with_a_mistake_is_not_dropped_as_a_name() {
    assert_eq!(only_problem("4OO,0.1\n410,0.2\n420,0.3\n").2, "`4OO` is not a number");
    assert_eq!(only_problem("O400,0.1\n410,0.2\n420,0.3\n").2, "`O400` is not a number");
    assert_eq!(problems("４００,１\n410,0.2\n420,0.3\n")[0].line, 1);
    let twice = parse("\u{feff}\u{feff}400,0.1\n410,0.2\n", &TextRules::default()).unwrap();
    assert_eq!(twice.wavelengths_nm, [400.0, 410.0]);
}

#[test]
fn what_is_not_over_wavelength_is_no_curve() {
    for name in ["frequency_THz", "wavenumber_cm-1", "wavenumber (1/cm)", "photon energy [eV]", "eV"] {
        let (line, column, message, help) = only_problem(&format!("{name},value\n400,1\n500,2\n"));
        assert_eq!((line, column), (1, 1), "{name}");
        assert!(message.contains(name) && help.contains("nm"), "{message}: {help}");
    }
    assert!(only_problem("# per: -5 nm\n400,1\n405,2\n").2.contains("`-5 nm`"));
}

#[test]
fn other_encodings_and_line_ends_are_named() {
    let utf16: Vec<u8> = "400,1\n500,2\n".encode_utf16().flat_map(u16::to_be_bytes).collect();
    assert!(parse_bytes(&utf16, &TextRules::default()).unwrap_err()[0].message.contains("UTF-16"));
    assert!(only_problem("400,1\r500,2\r").2.contains("CR alone"));
}

#[test]
fn each_problem_says_where_and_what_to_do() {
    let (line, column, message, help) = only_problem("380,0.1\n390,o.2\n");
    assert_eq!((line, column, message.as_str()), (2, 5, "`o.2` is not a number"));
    assert!(help.contains("0.42"));
    assert!(only_problem("380,0.1\n390,1e999\n").2.contains("not a finite number"));
    assert_eq!(only_problem("380,0.1\n390,0.2\n390,0.3\n").2, "390 nm is there twice, in lines 2 and 3");
    assert_eq!(only_problem("380,0.1\n400,0.2\n390,0.3\n").2, "390 nm in line 3 follows 400 nm in line 2");
    assert_eq!(only_problem("380,0.1\n390\n").2, "too few columns: 1 instead of 2");
    assert_eq!(only_problem("380,0.1\n390,-0.1\n").2, "the value -0.1 is negative");
    assert!(only_problem("-380,0.1\n390,0.1\n").2.contains("not above 0"));
    assert!(only_problem("# wavelength_unit: inch\n380,0.1\n390,0.1\n").3.contains("nm"));
    assert!(only_problem("# unit: 1\n# unit: 2\n380,0.1\n390,0.1\n").2.contains("twice"));
    assert!(only_problem("").2.contains("no rows"));
    assert!(only_problem("380,0.1").2.contains("one row"));
    assert!(problems("380\n390\n")[0].message.contains("at least one value"));
}

#[test]
fn decimal_commas_are_recognised() {
    for text in ["380,5;0,12\n381,5;0,13\n", "380,5\t0,12\n381,5\t0,13\n", "380,5 0,12\n381,5 0,13\n"] {
        let table = parse(text, &TextRules::default()).unwrap();
        assert_eq!((table.wavelengths_nm, table.columns), (vec![380.5, 381.5], vec![vec![0.12, 0.13]]), "{text}");
        assert!(table.remarks.iter().any(|remark| remark.contains("decimal commas")), "{text}");
    }
    assert!(only_problem("380;1,234\n381;2,345\n").3.contains("`1.234` or `1234`"));
    let list = problems("nm,value\n380,5,0,12\n381,5,0,13\n");
    assert!(list[0].help.contains("decimal commas"), "{list:?}");
}

#[test]
fn wavelengths_in_other_units_are_recognised() {
    assert!(only_problem("0.38,1\n0.78,1\n").3.contains("micrometres: write `# wavelength_unit: um` above them, or multiply them by 1000"));
    assert!(only_problem("380e-9,1\n780e-9,1\n").3.contains("metres: write `# wavelength_unit: m` above them, or multiply them by 1e9"));
    assert_eq!(parse("# wavelength_unit: um\n0.38,1\n0.5461,1\n", &TextRules::default()).unwrap().wavelengths_nm, [380.0, 546.1]);
}

#[test]
fn sizes_are_limited() {
    let rules = TextRules { max_rows: 2, max_columns: 3, ..TextRules::default() };
    assert!(parse("1,1\n20,1\n", &rules).is_ok());
    assert!(parse("1,1\n20,1\n30,1\n", &rules).unwrap_err()[0].message.contains("more than 2 rows"));
    assert!(parse("1,1,1,1\n20,1,1,1\n", &rules).unwrap_err()[0].message.contains("4 columns"));
    let many: String = (0..1000).map(|i| format!("{},x\n", 300 + i)).collect();
    let list = problems(&many);
    assert_eq!(list.len(), 101);
    assert_eq!(list[100].message, "and 900 more problems");
}

#[test]
fn negative_values_pass_where_they_are_allowed() {
    let rules = TextRules { negative_values: true, ..TextRules::default() };
    assert_eq!(parse("380,-0.1\n390,0.2\n", &rules).unwrap().columns, [[-0.1, 0.2]]);
}

#[test]
fn text_that_is_not_utf8_is_a_problem_with_a_place() {
    let list = parse_bytes(b"380,0.1\n39\xff,1\n", &TextRules::default()).unwrap_err();
    assert_eq!((list[0].line, list[0].column), (2, 3));
}

proptest! {
    #[test]
    fn no_bytes_make_it_panic(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let _ = parse_bytes(&bytes, &TextRules::default());
    }

    #[test]
    fn what_is_accepted_is_a_valid_table(text in "[0-9eE.,;#:\\-+ \t\n\ra-cλ\"]{0,200}") {
        if let Ok(table) = parse(&text, &TextRules::default()) {
            prop_assert!(table.wavelengths_nm.len() >= 2 && table.wavelengths_nm[0] > 0.0);
            prop_assert!(table.wavelengths_nm.windows(2).all(|pair| pair[0] < pair[1]));
            for column in &table.columns {
                prop_assert_eq!(column.len(), table.wavelengths_nm.len());
                prop_assert!(column.iter().all(|value| value.is_finite() && *value >= 0.0));
            }
        }
    }

    #[test]
    fn what_is_written_is_read_back(rows in prop::collection::vec((1.0..9.0_f64, 0.0..1.0_f64), 2..50)) {
        let mut nm = 300.0;
        let rows: Vec<(f64, f64)> = rows.into_iter().map(|(step, value)| { nm += step; (nm, value) }).collect();
        let text: String = rows.iter().map(|(nm, value)| format!("{nm},{value}\n")).collect();
        let table = parse(&text, &TextRules::default()).unwrap();
        let (wavelengths, values): (Vec<f64>, Vec<f64>) = rows.into_iter().unzip();
        prop_assert_eq!(table.wavelengths_nm, wavelengths);
        prop_assert_eq!(&table.columns[0], &values);
    }
}
