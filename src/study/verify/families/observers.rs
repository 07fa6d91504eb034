//! Group g2, g to i: α-opic quantities, cones, visual pigments, mesopic luminance. One function a family.
//!
//! Cases whose numbers depend on more digits than the tables of the library have (five in CIE S 026 there, six here; daylight every 5 nm there,
//! every 1 nm here) are computed by the public functions from the tables that the cases name.

use super::{Families, Outcome};
use crate::observer::alpha_opic::efficacy_of_luminous_radiation;
use crate::observer::efficiency::sp_ratio_with;
use crate::observer::mesopic::mesopic;
use crate::observer::template::govardovskii;
use crate::observer::{Components, Cone, Cones, Efficiency, Individual};
use crate::spectrum::{Density, Factor};
use crate::study::verify::case::{Case, Fault};

pub(super) const FAMILIES: Families = &[
    ("g2g.edi-A", edi),
    ("g2g.edi-D65", edi),
    ("g2g.edi-E", edi),
    ("g2g.edi-LED1", edi),
    ("g2g.edi-LED2", edi),
    ("g2g.edi-RGB", edi),
    ("g2g.elr-D65", |c| Ok((1e3 * elr(c, &daylight(c)?)?).into())),
    ("g2h.cone-A", cone_excitation),
    ("g2h.cone-D65", cone_excitation),
    ("g2h.cone-E", cone_excitation),
    ("g2h.cone-LED1", cone_excitation),
    ("g2h.cone-LED2", cone_excitation),
    ("g2h.cone-RGB", cone_excitation),
    ("g2h.cie170", cie170),
    ("g2h.govardovskii", |c| Ok(govardovskii(c.number("lambda_max_nm")?, c.number("lambda_nm")?)?.into())),
    ("g2i.mes2", |c| Ok(mesopic(c.number("L_p")?, c.number("S_over_P")?)?.luminance_cd_m2.into())),
    ("g2i.sp", ratio_of_daylight),
];

/// D65 every 1 nm.
fn daylight(c: &Case) -> Result<Density, Fault> {
    Ok(Density::table(c.table("illuminant_d65_1nm.csv", 0)?)?)
}

/// The spectrum that a case names, relative.
///
/// # Errors
/// When the case names another, or its table was not supplied.
pub fn source(c: &Case) -> Result<Density, Fault> {
    if c.input("source")?.is_array() {
        return c.gaussians("source");
    }
    match c.text("source")? {
        "CIE illuminant A, formula 1.435e7/2848" => Ok(Density::illuminant_a()),
        "equal energy" => Ok(Density::flat(300.0, 900.0, 1.0)?),
        "illuminant_d65_1nm.csv" => daylight(c),
        other => Err(Fault::wrong(format!("no spectrum `{other}`"))),
    }
}

/// Efficacy of luminous radiation by the action spectrum of the case, summed from 380 nm to 780 nm, W/lm.
fn elr(c: &Case, density: &Density) -> Result<f64, Fault> {
    let action = c.text("action")?;
    let column = ["sc", "mc", "lc", "rh", "mel"].iter().position(|name| *name == action);
    let column = column.ok_or_else(|| Fault::wrong(format!("no action spectrum `{action}`; allowed: sc, mc, lc, rh, mel")))?;
    let action = Factor::Table(c.table("s026_alpha_1nm.csv", column)?);
    efficacy_of_luminous_radiation(&density.summed(380.0, 780.0, 1.0)?, &action).ok_or_else(|| Fault::wrong("the spectrum is dark"))
}

fn edi(c: &Case) -> Outcome {
    Ok((c.number("E_v_lx")? * elr(c, &source(c)?)? / elr(c, &daylight(c)?)?).into())
}

fn cone_excitation(c: &Case) -> Outcome {
    let density = source(c)?.summed(390.0, 830.0, 1.0)?;
    let scale = 100.0 / density.integral(&[&Efficiency::Photopic1924.curve()]);
    let excitations = Cones::StockmanSharpe2.excitations(&density.scaled(scale)?)?;
    let cone = Cone::ALL.iter().zip(excitations).find(|(cone, _)| c.id().ends_with(&format!("-{}", cone.name())));
    Ok(cone.ok_or_else(|| Fault::wrong("the id names no cone"))?.1.into())
}

fn cie170(c: &Case) -> Outcome {
    let individual = Individual { age_yr: c.number("age_yr")?, field_deg: c.number("field_deg")? };
    let name = c.text("cone")?;
    let cone = Cone::ALL.into_iter().find(|cone| cone.name() == name).ok_or_else(|| Fault::wrong(format!("no cone `{name}`")))?;
    Ok(Components::cie()?.quantal_sensitivity(individual, cone, c.number("lambda_nm")?)?.into())
}

fn ratio_of_daylight(c: &Case) -> Outcome {
    let factor = c.text("factor")?;
    let parts = factor.split_once('/').and_then(|(a, b)| Some((a.parse::<f64>().ok()?, b.parse::<f64>().ok()?)));
    let (numerator, denominator) = parts.ok_or_else(|| Fault::wrong(format!("`factor` is `{factor}`; allowed: NUMBER/NUMBER")))?;
    let ratio = sp_ratio_with(&daylight(c)?.summed(380.0, 780.0, 1.0)?, numerator / denominator);
    Ok(ratio.ok_or_else(|| Fault::wrong("the spectrum is dark"))?.into())
}
