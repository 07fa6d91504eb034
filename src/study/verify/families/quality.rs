//! Group g2, f: quality indices of meters. One function a family.

use super::{Families, Outcome};
use crate::characterization::directional_mismatch::f2_of_response;
use crate::characterization::spectral_mismatch::{Wavelengths, correction_factor, f1_prime};
use crate::spectrum::{Density, Factor, Outside, Table, library};
use crate::study::verify::case::{Case, Fault};

pub(super) const FAMILIES: Families = &[
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
fn bell(peak: f64, centre_nm: f64, fwhm_nm: f64) -> Result<Factor, Fault> {
    Ok(Factor::gaussian(peak, centre_nm, fwhm_nm / (8.0 * std::f64::consts::LN_2).sqrt())?)
}

/// The table of V(λ) along the axis.
fn shifted(by_nm: f64) -> Result<Factor, Fault> {
    let Factor::Table(v) = library::v_lambda() else { return Err(Fault::wrong("V(λ) is no table")) };
    let rows: Vec<(f64, f64)> = v.rows().map(|(nm, value)| (nm + by_nm, value)).collect();
    Ok(Factor::Table(Table::from_rows(&rows, Outside::Zero)?))
}

fn responsivity(c: &Case) -> Result<Factor, Fault> {
    let v = library::v_lambda();
    Ok(match c.text("responsivity")? {
        "s(l)=V(l-2) (table shifted by +2 nm, zero outside)" => shifted(2.0)?,
        "s(l)=V(l+5)" => shifted(-5.0)?,
        "Gaussian 555 nm FWHM 100 nm" => bell(1.0, 555.0, 100.0)?,
        "G(560,90)+0.02 G(700,60)" => Factor::Sum(vec![bell(1.0, 560.0, 90.0)?, bell(0.02, 700.0, 60.0)?]),
        "V+0.005 on 360..830" => Factor::Sum(vec![v, Factor::band(360.0, 830.0, 0.005)?]),
        "V*(1+0.001(l-555))" => Factor::Product(vec![v, Factor::Sum(vec![Factor::Constant(1.0 - 0.555), Factor::Proportional(0.001)])]),
        "3.7e-6*V (must give 0 for any scale)" => v.scaled(3.7e-6),
        "bare silicon-like l/830*(1-exp(-(l-330)/90))" => {
            let at = |nm: f64| (nm, nm / 830.0 * -(-(nm - 330.0) / 90.0).exp_m1());
            let rows: Vec<(f64, f64)> = (360..=830).map(|nm| at(f64::from(nm))).collect();
            Factor::Table(Table::from_rows(&rows, Outside::Zero)?)
        }
        other => return Err(Fault::wrong(format!("no responsivity `{other}`"))),
    })
}

/// "sum(380,780) step 5 nm", "sum1(360,830)".
fn wavelengths(convention: &str) -> Result<Wavelengths, Fault> {
    let numbers: Vec<f64> = convention.split(|x: char| !x.is_ascii_digit()).filter_map(|x| x.parse().ok()).collect();
    Ok(match (numbers.as_slice(), convention.starts_with("sum1(")) {
        ([_, from, to], true) => Wavelengths::Sum { from_nm: *from, to_nm: *to, step_nm: 1.0 },
        ([from, to, step], false) => Wavelengths::Sum { from_nm: *from, to_nm: *to, step_nm: *step },
        _ => return Err(Fault::wrong(format!("no convention `{convention}`; allowed: sum1(FROM,TO), sum(FROM,TO) step N nm"))),
    })
}

fn f1_prime_of(c: &Case) -> Outcome {
    Ok(f1_prime(&responsivity(c)?, wavelengths(c.text("convention")?)?)?.into())
}

/// The spectrum of a case: a table by file name, or Gaussians.
fn test_source(c: &Case) -> Result<Density, Fault> {
    match c.input("test_source")?.as_str() {
        Some(file) => Ok(Density::table(c.table(file, 0)?)?),
        None => c.gaussians("test_source"),
    }
}

fn correction(c: &Case) -> Outcome {
    let over = wavelengths(c.text("convention")?)?;
    let (test, calibration) = (over.of(&test_source(c)?)?, over.of(&Density::illuminant_a())?);
    Ok(correction_factor(&responsivity(c)?, &library::v_lambda(), &test, &calibration)?.into())
}

fn f2_of(c: &Case) -> Outcome {
    let response: fn(f64) -> f64 = match c.text("response")? {
        "Y(e)=cos^1.1 e" => |e| e.cos().powf(0.1),
        "Y(e)=cos e * (1-0.05 sin^2 e)" => |e| 1.0 - 0.05 * e.sin().powi(2),
        "Y(e)=1 (flat detector)" => |e| 1.0 / e.cos(),
        other => return Err(Fault::wrong(format!("no response `{other}`"))),
    };
    Ok(f2_of_response(&response, &[], c.number("upper_deg")?.to_radians())?.into())
}
