//! The tables that come with the library: headers, sums, names, and the reference cases of photometry.

use std::collections::BTreeSet;

use crate::spectrum::library::{self, FILES, LookupError, entries};
use crate::spectrum::table_text::{TextRules, parse};
use crate::spectrum::{Density, Factor, black_body, photometry};

fn close(value: f64, reference: f64, relative: f64) -> bool {
    (value - reference).abs() <= relative * reference.abs()
}

#[test]
fn every_header_is_complete_and_every_sum_is_right() {
    let keys = [
        "name",
        "aliases",
        "group",
        "kind",
        "quantity",
        "unit",
        "wavelength_unit",
        "range",
        "step",
        "interpolation",
        "outside",
        "source",
        "licence",
        "prepared_by",
        "sum",
        "sha256",
    ];
    let mut columns = 2;
    for file in FILES {
        let table = parse(file, &TextRules { negative_values: true, ..TextRules::default() }).unwrap();
        for key in keys {
            assert!(table.header_value(key).is_some_and(|value| !value.is_empty()), "{key} of {:?}", table.header[0]);
        }
        let sum: f64 = table.columns.iter().flatten().sum();
        assert!(close(sum, table.header_value("sum").unwrap().parse().unwrap(), 1e-13), "{:?}", table.header[0]);
        let range = format!("{}-{}", table.wavelengths_nm[0], table.wavelengths_nm.last().unwrap());
        assert_eq!(table.header_value("range"), Some(range.as_str()));
        assert_eq!(table.header_value("interpolation"), Some("linear"));
        assert_eq!(table.header_value("sha256").unwrap().len(), 64);
        columns += table.columns.len();
    }
    assert_eq!(entries().len(), columns, "a file or a column did not become an entry");
}

#[test]
fn no_two_entries_share_a_name() {
    let mut seen = BTreeSet::new();
    for entry in entries() {
        let names: BTreeSet<String> = std::iter::once(&entry.name).chain(&entry.aliases).map(|name| library::key(name)).collect();
        for name in names {
            assert!(!name.is_empty() && seen.insert(name.clone()), "{name} of {}", entry.name);
        }
    }
}

#[test]
fn names_are_found_without_case_and_separators() {
    for name in ["V", "V(λ)", "v-lambda", "photopic", "xbar", "x̄", "ȳ", "CIE 1931 z_bar", "ColorChecker Dark-Skin"] {
        assert!(library::factor(name).is_ok(), "{name}");
    }
    for name in ["A", "led b3", "LED-B3", "CIE illuminant D65", "f11", "equal energy", "hp1"] {
        assert!(library::density(name).is_ok(), "{name}");
    }
}

#[test]
fn a_miss_answers_with_the_nearest_names() {
    let LookupError::Unknown { nearest, .. } = library::density("LED-B33").unwrap_err() else { panic!() };
    assert_eq!(nearest[0], "LED-B3");
    let LookupError::Unknown { nearest, .. } = library::factor("photopik").unwrap_err() else { panic!() };
    assert_eq!(nearest[0], "photopic");
    assert_ne!(library::factor("V'").unwrap(), library::factor("V").unwrap(), "V prime is not V");
    assert!(matches!(library::factor("D65"), Err(LookupError::OtherKind { .. })));
    assert!(matches!(library::density("V"), Err(LookupError::OtherKind { .. })));
    assert!(library::density("").is_err());
}

#[test]
fn v_lambda_sums_to_its_checksum_and_equals_y_bar() {
    let v = library::v_lambda();
    let y = library::factor("ybar").unwrap();
    let sum: f64 = (360..=830).map(|nm| v.at(f64::from(nm))).sum();
    assert!(close(sum, 106.856917, 1e-8), "{sum}");
    assert!((360..=830).map(f64::from).all(|nm| (v.at(nm) - y.at(nm)).abs() < 1e-12));
    assert_eq!([v.at(555.0), v.at(359.0), v.at(831.0)], [1.0, 0.0, 0.0]);
}

#[test]
fn luminance_and_efficacy_of_black_bodies_agree_with_the_reference_cases() {
    // /reference/g2_spectral.json, g2a.bb-lum-* and g2a.bb-ler-pl-*: T, cd/m², lm/W.
    let v = library::v_lambda();
    for (kelvin, luminance, efficacy) in [
        (2000.0, 463768.828566648, 1.60590447504179),
        (2856.0, 19749799.6656380, 16.4462928149886),
        (5000.0, 918109836.493675, 81.3865725059308),
        (10000.0, 1.32605038798430e10, 73.4679908100418),
    ] {
        let black_body = Density::black_body(kelvin).unwrap();
        assert!(close(photometry::luminous(&black_body, &v), luminance, 1e-11));
        assert!(close(photometry::luminous_efficacy_lm_w(&black_body, &v).unwrap(), efficacy, 1e-11));
    }
}

#[test]
fn lines_and_narrow_peaks_agree_with_the_reference_cases() {
    // g2c.line-*: 1 W at nm -> lm.
    let v = library::v_lambda();
    for (nm, lumens) in [
        (555.0, 683.002),
        (555.1712, 682.985243939254),
        (546.074, 672.305170460618),
        (507.5, 309.981823704),
        (360.0, 0.002675318834),
        (830.001, 0.0),
    ] {
        assert!(close(photometry::luminous(&Density::line(nm, 1.0).unwrap(), &v), lumens, 1e-12), "{nm}");
    }
    // g2d.gauss-*: centre, full width at half maximum, lm.
    let sigma_per_width = 1.0 / (8.0 * std::f64::consts::LN_2).sqrt();
    for (centre, width, lumens) in [
        (555.3, 0.1, 682.972637744020),
        (555.3, 5.0, 682.358680909062),
        (555.3, 50.0, 618.448217313350),
        (450.25, 0.1, 26.2693958258357),
        (632.8, 5.0, 162.478309920997),
        (632.8, 50.0, 190.750155145953),
    ] {
        let peak = Density::gaussian(1.0, centre, width * sigma_per_width).unwrap();
        assert!(close(photometry::luminous(&peak, &v), lumens, 1e-11), "{centre} {width}");
    }
}

#[test]
fn illuminant_a_has_its_luminous_efficacy() {
    // g2b.ler-A-2, convention sum over 380..780 at 1 nm: lines at the nodes are that sum.
    let v = library::v_lambda();
    let sum = |factor: &dyn Fn(f64) -> f64| -> f64 { (380..=780).map(|nm| factor(f64::from(nm))).sum() };
    let a = Density::illuminant_a();
    let efficacy = 683.002 * sum(&|nm| a.continuum_at(nm) * v.at(nm)) / sum(&|nm| a.continuum_at(nm));
    assert!(close(efficacy, 155.781107753051, 1e-11), "{efficacy}");
    let band = Factor::band(380.0, 780.0, 1.0).unwrap();
    let exact = photometry::luminous_efficacy_lm_w(&a.filtered(&band), &v).unwrap();
    // The sum counts half a node too much at either end, mostly in the red.
    assert!(close(exact, efficacy, 5e-3) && exact > efficacy, "{exact}");
}

#[test]
fn infrared_leaks_agree_with_the_reference_cases() {
    // g4i.ir-leak-*: sums at 1 nm of a black body, leak k on 781..1100 nm over V on 360..830 nm.
    let v = library::v_lambda();
    for (kelvin, leak, reference) in
        [(2856.0, 1e-6, 8.26753971577427e-6), (800.0, 1e-6, 0.0403469747136221), (3000.0, 1e-3, 0.00700967092809926)]
    {
        let radiance = |nm: u32| black_body::spectral_radiance(f64::from(nm), kelvin);
        let through_leak: f64 = (781..=1100).map(|nm| leak * radiance(nm)).sum();
        let through_v: f64 = (360..=830).map(|nm| v.at(f64::from(nm)) * radiance(nm)).sum();
        assert!(close(through_leak / through_v, reference, 1e-11), "{}", through_leak / through_v);
    }
    // g4i.laser-leak-2: 10 W/m² at 808.5 nm on V plus a flat leak of 1e-6.
    let meter = Factor::Sum(vec![v, Factor::band(781.0, 1100.0, 1e-6).unwrap()]);
    let laser = Density::line(808.5, 10.0).unwrap();
    assert!(close(photometry::luminous(&laser, &meter), 0.0207733555695600, 1e-12));
}
