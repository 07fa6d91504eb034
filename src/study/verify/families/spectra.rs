//! Group g2, a to d: black bodies, illuminants, the daylight series, lines and Gaussians. One function a family.

use super::{Families, Outcome, stated_number};
use crate::quantity::constants::K_M_LM_W;
use crate::spectrum::{Density, Factor, black_body, daylight, library, photometry};
use crate::study::verify::case::{Case, Fault};

pub(super) const FAMILIES: Families = &[
    ("g2a.bb-ler-pl", black_body_efficacy),
    ("g2a.bb-ler-sum", black_body_efficacy),
    ("g2a.bb-lum", |c| Ok(photometry::luminous(&black_body(c)?, &library::v_lambda()).into())),
    ("g2a.bb-band", |c| {
        let band = Factor::band(c.number("a_nm")?, c.number("b_nm")?, 1.0)?;
        let mean = black_body(c)?.mean_of(&band);
        Ok(mean.ok_or_else(|| Fault::wrong("the black body has no power"))?.into())
    }),
    ("g2b.illA", |c| Ok(Density::illuminant_a().continuum_at(c.number("lambda_nm")?).into())),
    ("g2b.dser-xD", |c| Ok(daylight::chromaticity(c.number("T_K")?)?.0.into())),
    ("g2b.dser-yD", |c| Ok(daylight::chromaticity(c.number("T_K")?)?.1.into())),
    ("g2b.dser-M1", |c| Ok(daylight_coefficients(c)?.0.into())),
    ("g2b.dser-M2", |c| Ok(daylight_coefficients(c)?.1.into())),
    ("g2c.line", |c| {
        let line = Density::line(c.number("lambda_nm")?, c.number("flux_W")?)?;
        Ok(photometry::luminous(&line, &library::v_lambda()).into())
    }),
    ("g2d.gauss", |c| {
        let sigma_nm = c.number("fwhm_nm")? / (8.0 * std::f64::consts::LN_2).sqrt();
        let line = Density::gaussian(c.number("flux_W")?, c.number("centre_nm")?, sigma_nm)?;
        Ok(photometry::luminous(&line, &library::v_lambda()).into())
    }),
];

pub(super) fn black_body(c: &Case) -> Result<Density, Fault> {
    Ok(Density::black_body(c.number("T_K")?)?)
}

/// The continuum as it is ("pl": products of piecewise-linear tables, exactly) or its sum over steps ("sum1(360,830)").
pub(super) fn by_convention(density: &Density, convention: &str) -> Result<Density, Fault> {
    if convention == "pl" {
        return Ok(density.clone());
    }
    let unknown = || Fault::wrong(format!("no convention `{convention}`; allowed: pl, sum1(FROM, TO) with whole nanometres"));
    let inside = convention.strip_prefix("sum1(").and_then(|rest| rest.strip_suffix(')')).ok_or_else(unknown)?;
    let (from, to) = inside.split_once(',').ok_or_else(unknown)?;
    let nm = |text: &str| text.trim().parse::<f64>().map_err(|_| unknown());
    Ok(density.summed(nm(from)?, nm(to)?, 1.0)?)
}

/// Luminous radiance by the convention over the radiance of all wavelengths.
fn black_body_efficacy(c: &Case) -> Outcome {
    stated_number(c, "Km", K_M_LM_W)?;
    let luminous = photometry::luminous(&by_convention(&black_body(c)?, c.text("convention")?)?, &library::v_lambda());
    Ok((luminous / black_body::radiance_w_m2_sr(c.number("T_K")?)).into())
}

fn daylight_coefficients(c: &Case) -> Result<(f64, f64), Fault> {
    let (x, y) = daylight::chromaticity(c.number("T_K")?)?;
    Ok(daylight::coefficients(x, y))
}
