//! Group g2, g to i: α-opic quantities, cones, visual pigments, mesopic luminance. One function a family.
//!
//! Cases whose numbers depend on more digits than the tables of the library have (five in CIE S 026 there, six here; daylight every 5 nm there,
//! every 1 nm here) are computed by the public functions from the tables of the case, `data/*.csv`; the tables of the library are held to
//! them in the tests below.

use std::path::Path;

use etendue::observer::alpha_opic::efficacy_of_luminous_radiation;
use etendue::observer::efficiency::sp_ratio_with;
use etendue::observer::mesopic::mesopic;
use etendue::observer::template::govardovskii;
use etendue::observer::{AlphaOpic, Components, Cone, Cones, Efficiency, Individual};
use etendue::spectrum::{Density, Factor, Outside, Table};

use crate::bench::{Case, Family};

pub(crate) const FAMILIES: &[(&str, Family)] = &[
    ("g2g.edi-A", edi),
    ("g2g.edi-D65", edi),
    ("g2g.edi-E", edi),
    ("g2g.edi-LED1", edi),
    ("g2g.edi-LED2", edi),
    ("g2g.edi-RGB", edi),
    ("g2g.elr-D65", |c| 1e3 * elr(&daylight(), c.text("action"))),
    ("g2h.cone-A", cone_excitation),
    ("g2h.cone-D65", cone_excitation),
    ("g2h.cone-E", cone_excitation),
    ("g2h.cone-LED1", cone_excitation),
    ("g2h.cone-LED2", cone_excitation),
    ("g2h.cone-RGB", cone_excitation),
    ("g2h.cie170", |c| cie170(c, &oracle())),
    ("g2h.govardovskii", |c| govardovskii(c.number("lambda_max_nm"), c.number("lambda_nm")).unwrap()),
    ("g2i.mes2", |c| mesopic(c.number("L_p"), c.number("S_over_P")).unwrap().luminance_cd_m2),
    ("g2i.sp", |c| {
        let (numerator, denominator) = c.text("factor").split_once('/').unwrap();
        let ratio = numerator.parse::<f64>().unwrap() / denominator.parse::<f64>().unwrap();
        sp_ratio_with(&daylight().summed(380.0, 780.0, 1.0).unwrap(), ratio).unwrap()
    }),
];

/// Columns of a table of `tests/reference/data/`: wavelengths first.
fn columns(file: &str) -> Vec<Vec<f64>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/data").join(file);
    let text = std::fs::read_to_string(&path).unwrap();
    let rows: Vec<Vec<f64>> = text.lines().skip(1).map(|row| row.split(',').map(|cell| cell.parse().unwrap()).collect()).collect();
    (0..rows[0].len()).map(|column| rows.iter().map(|row| row[column]).collect()).collect()
}

fn table(file: &str, column: usize) -> Table {
    let mut all = columns(file);
    let values = all.swap_remove(column);
    Table::new(all.swap_remove(0), values, Outside::Zero).unwrap()
}

/// D65 every 1 nm.
fn daylight() -> Density {
    Density::table(table("illuminant_d65_1nm.csv", 1)).unwrap()
}

/// The spectrum of a case, relative.
fn source(c: &Case) -> Density {
    if !c.value("source").is_array() {
        return match c.text("source") {
            "CIE illuminant A, formula 1.435e7/2848" => Density::illuminant_a(),
            "equal energy" => Density::flat(300.0, 900.0, 1.0).unwrap(),
            "illuminant_d65_1nm.csv" => daylight(),
            other => panic!("no spectrum `{other}`"),
        };
    }
    c.records("source").iter().fold(Density::zero(), |sum, part| {
        let sigma = part["fwhm_nm"] / (8.0 * std::f64::consts::LN_2).sqrt();
        let area = part["peak"] * sigma * (2.0 * std::f64::consts::PI).sqrt();
        sum.plus(&Density::gaussian(area, part["centre_nm"], sigma).unwrap())
    })
}

/// Efficacy of luminous radiation by the action spectra of the case's tables, summed from 380 nm to 780 nm, W/lm.
fn elr(density: &Density, action: &str) -> f64 {
    let column = ["sc", "mc", "lc", "rh", "mel"].iter().position(|name| *name == action).unwrap();
    let action = Factor::Table(table("s026_alpha_1nm.csv", column + 1));
    efficacy_of_luminous_radiation(&density.summed(380.0, 780.0, 1.0).unwrap(), &action).unwrap()
}

fn edi(c: &Case) -> f64 {
    let action = c.text("action");
    c.number("E_v_lx") * elr(&source(c), action) / elr(&daylight(), action)
}

fn cone_excitation(c: &Case) -> f64 {
    let density = source(c).summed(390.0, 830.0, 1.0).unwrap();
    let scale = 100.0 / density.integral(&[&Efficiency::Photopic1924.curve()]);
    let excitations = Cones::StockmanSharpe2.excitations(&density.scaled(scale).unwrap()).unwrap();
    excitations[Cone::ALL.iter().position(|cone| c.id().ends_with(&format!("-{}", cone.name()))).unwrap()]
}

/// The components of the case's own table.
fn oracle() -> Components {
    let mut all = columns("cie170_components_5nm.csv").into_iter();
    let mut next = || all.next().unwrap();
    let nm = next();
    let absorbance = [next(), next(), next()].map(|log| log.into_iter().map(|x| if x < -90.0 { 0.0 } else { 10f64.powf(x) }).collect());
    Components::new(nm, absorbance, next(), [next(), next()]).unwrap()
}

fn cie170(c: &Case, components: &Components) -> f64 {
    let individual = Individual { age_yr: c.number("age_yr"), field_deg: c.number("field_deg") };
    let cone = Cone::ALL.into_iter().find(|cone| cone.name() == c.text("cone")).unwrap();
    components.quantal_sensitivity(individual, cone, c.number("lambda_nm")).unwrap()
}

/// The components that come with the library have the digits of the reference: same cases, same tolerance.
#[test]
fn the_components_of_the_library_agree_with_the_reference() {
    let mut read = 0;
    for case in crate::bench::cases("g2_spectral").iter().filter(|case| case.id().starts_with("g2h.cie170")) {
        let value = cie170(case, Components::cie().unwrap());
        assert!(case.deviation_in_tolerances(value) < 0.1, "{}: {value:e} instead of {:e}", case.id(), case.reference());
        read += 1;
    }
    assert!(read >= 42);
}

/// Five digits against six, integrals against sums, and a rod curve that one of the two rounds to three decimals at some wavelengths: equivalent
/// daylight illuminance agrees to 5e-5.
#[test]
fn the_action_spectra_of_the_library_agree_with_the_reference() {
    let mut read = 0;
    for case in crate::bench::cases("g2_spectral").iter().filter(|case| case.id().starts_with("g2g.edi")) {
        let alpha = AlphaOpic::named(case.text("action")).unwrap();
        let value = case.number("E_v_lx") * alpha.daylight_efficacy_ratio(&source(case)).unwrap();
        assert!((value / case.reference() - 1.0).abs() < 5e-5, "{}: {value:e} instead of {:e}", case.id(), case.reference());
        read += 1;
    }
    assert!(read >= 9);
}
