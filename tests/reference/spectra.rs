//! Group g2, a to d: black bodies, illuminants, the daylight series, lines and Gaussians. One function a family.

use etendue::quantity::constants::K_M_LM_W;
use etendue::spectrum::{Density, Factor, black_body, daylight, library, photometry};

use super::bench::{Case, Family};

pub(crate) const FAMILIES: &[(&str, Family)] = &[
    ("g2a.bb-ler-pl", black_body_efficacy),
    ("g2a.bb-ler-sum", black_body_efficacy),
    ("g2a.bb-lum", |c| photometry::luminous(&black_body(c), &library::v_lambda())),
    ("g2a.bb-band", |c| {
        let band = Factor::band(c.number("a_nm"), c.number("b_nm"), 1.0).unwrap();
        black_body(c).mean_of(&band).unwrap()
    }),
    ("g2b.illA", |c| Density::illuminant_a().continuum_at(c.number("lambda_nm"))),
    ("g2b.dser-xD", |c| daylight::chromaticity(c.number("T_K")).unwrap().0),
    ("g2b.dser-yD", |c| daylight::chromaticity(c.number("T_K")).unwrap().1),
    ("g2b.dser-M1", |c| daylight_coefficients(c).0),
    ("g2b.dser-M2", |c| daylight_coefficients(c).1),
    ("g2c.line", |c| {
        let line = Density::line(c.number("lambda_nm"), c.number("flux_W")).unwrap();
        photometry::luminous(&line, &library::v_lambda())
    }),
    ("g2d.gauss", |c| {
        let sigma_nm = c.number("fwhm_nm") / (8.0 * std::f64::consts::LN_2).sqrt();
        let line = Density::gaussian(c.number("flux_W"), c.number("centre_nm"), sigma_nm).unwrap();
        photometry::luminous(&line, &library::v_lambda())
    }),
];

fn black_body(c: &Case) -> Density {
    Density::black_body(c.number("T_K")).unwrap()
}

/// The continuum as it is ("pl": products of piecewise-linear tables, exactly) or its sum over steps ("sum1(360,830)").
pub(crate) fn by_convention(density: &Density, convention: &str) -> Density {
    if convention == "pl" {
        return density.clone();
    }
    let inside = convention.split(['(', ')']).nth(1).unwrap_or_else(|| panic!("unknown convention {convention}"));
    let (from, to) = inside.split_once(',').unwrap_or_else(|| panic!("unknown convention {convention}"));
    assert!(convention.starts_with("sum1("), "unknown convention {convention}");
    density.summed(from.trim().parse().unwrap(), to.trim().parse().unwrap(), 1.0).unwrap()
}

/// Luminous radiance by the convention over the radiance of all wavelengths.
fn black_body_efficacy(c: &Case) -> f64 {
    assert_eq!(c.number("Km"), K_M_LM_W);
    let luminous = photometry::luminous(&by_convention(&black_body(c), c.text("convention")), &library::v_lambda());
    luminous / black_body::radiance_w_m2_sr(c.number("T_K"))
}

fn daylight_coefficients(c: &Case) -> (f64, f64) {
    let (x, y) = daylight::chromaticity(c.number("T_K")).unwrap();
    daylight::coefficients(x, y)
}
