//! Group g2, f: quality indices of meters. One function a family.

use etendue::characterization::directional_mismatch::f2_of_response;
use etendue::characterization::spectral_mismatch::{Wavelengths, correction_factor, f1_prime};
use etendue::spectrum::table_text::{TextRules, parse};
use etendue::spectrum::{Density, Factor, Outside, Table, library};

use super::bench::{Case, Family};

pub(crate) const FAMILIES: &[(&str, Family)] = &[
    ("g2f.f1prime-shift+2", f1_prime_of),
    ("g2f.f1prime-shift-5", f1_prime_of),
    ("g2f.f1prime-gauss555-100", f1_prime_of),
    ("g2f.f1prime-leak", f1_prime_of),
    ("g2f.f1prime-tilt", f1_prime_of),
    ("g2f.f1prime-redbump", f1_prime_of),
    ("g2f.f1prime-scaledV", f1_prime_of),
    ("g2f.f1prime-cmos", f1_prime_of),
    ("g2f.ccf", correction),
    ("g2f.f2-1", f2_of),
    ("g2f.f2-2", f2_of),
    ("g2f.f2-3", f2_of),
];

/// Full width at half maximum → standard deviation.
fn bell(peak: f64, centre_nm: f64, fwhm_nm: f64) -> Factor {
    Factor::gaussian(peak, centre_nm, fwhm_nm / (8.0 * std::f64::consts::LN_2).sqrt()).unwrap()
}

/// The table of V(λ) along the axis.
fn shifted(by_nm: f64) -> Factor {
    let Factor::Table(v) = library::v_lambda() else { panic!("V(λ) is a table") };
    let rows: Vec<(f64, f64)> = v.rows().map(|(nm, value)| (nm + by_nm, value)).collect();
    Factor::Table(Table::from_rows(&rows, Outside::Zero).unwrap())
}

fn responsivity(c: &Case) -> Factor {
    let v = library::v_lambda();
    match c.text("responsivity") {
        "s(l)=V(l-2) (table shifted by +2 nm, zero outside)" => shifted(2.0),
        "s(l)=V(l+5)" => shifted(-5.0),
        "Gaussian 555 nm FWHM 100 nm" => bell(1.0, 555.0, 100.0),
        "G(560,90)+0.02 G(700,60)" => Factor::Sum(vec![bell(1.0, 560.0, 90.0), bell(0.02, 700.0, 60.0)]),
        "V+0.005 on 360..830" => Factor::Sum(vec![v, Factor::band(360.0, 830.0, 0.005).unwrap()]),
        "V*(1+0.001(l-555))" => Factor::Product(vec![v, Factor::Sum(vec![Factor::Constant(1.0 - 0.555), Factor::Proportional(0.001)])]),
        "3.7e-6*V (must give 0 for any scale)" => v.scaled(3.7e-6),
        "bare silicon-like l/830*(1-exp(-(l-330)/90))" => {
            let at = |nm: f64| (nm, nm / 830.0 * -(-(nm - 330.0) / 90.0).exp_m1());
            let rows: Vec<(f64, f64)> = (360..=830).map(|nm| at(f64::from(nm))).collect();
            Factor::Table(Table::from_rows(&rows, Outside::Zero).unwrap())
        }
        other => panic!("no responsivity {other}"),
    }
}

/// "sum(380,780) step 5 nm", "sum1(360,830)".
fn wavelengths(convention: &str) -> Wavelengths {
    let numbers: Vec<f64> = convention.split(|x: char| !x.is_ascii_digit()).filter_map(|x| x.parse().ok()).collect();
    match (numbers.as_slice(), convention.starts_with("sum1(")) {
        ([_, from, to], true) => Wavelengths::Sum { from_nm: *from, to_nm: *to, step_nm: 1.0 },
        ([from, to, step], false) => Wavelengths::Sum { from_nm: *from, to_nm: *to, step_nm: *step },
        _ => panic!("no convention {convention}"),
    }
}

fn f1_prime_of(c: &Case) -> f64 {
    f1_prime(&responsivity(c), wavelengths(c.text("convention"))).unwrap()
}

/// The spectrum of a case: a table of `tests/reference/data/`, or bells with their heights.
fn test_source(c: &Case) -> Density {
    if let Some(file) = c.value("test_source").as_str() {
        let path = format!("{}/tests/reference/data/{file}", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
        let mut curves = parse(&text, &TextRules::default()).unwrap();
        return Density::table(Table::new(curves.wavelengths_nm, curves.columns.remove(0), Outside::Zero).unwrap()).unwrap();
    }
    c.records("test_source").iter().fold(Density::zero(), |sum, bell| {
        let sigma_nm = bell["fwhm_nm"] / (8.0 * std::f64::consts::LN_2).sqrt();
        let power = bell["peak"] * sigma_nm * (2.0 * std::f64::consts::PI).sqrt();
        sum.plus(&Density::gaussian(power, bell["centre_nm"], sigma_nm).unwrap())
    })
}

fn correction(c: &Case) -> f64 {
    let over = wavelengths(c.text("convention"));
    let [test, calibration] = [test_source(c), Density::illuminant_a()].map(|spectrum| over.of(&spectrum).unwrap());
    correction_factor(&responsivity(c), &library::v_lambda(), &test, &calibration).unwrap()
}

fn f2_of(c: &Case) -> f64 {
    let response: fn(f64) -> f64 = match c.text("response") {
        "Y(e)=cos^1.1 e" => |e| e.cos().powf(0.1),
        "Y(e)=cos e * (1-0.05 sin^2 e)" => |e| 1.0 - 0.05 * e.sin().powi(2),
        "Y(e)=1 (flat detector)" => |e| 1.0 / e.cos(),
        other => panic!("no response {other}"),
    };
    f2_of_response(&response, &[], c.number("upper_deg").to_radians()).unwrap()
}
