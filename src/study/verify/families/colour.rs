//! Group g2, chromaticities and efficacies: black bodies, illuminants, LEDs. One function a family.

use super::spectra::{black_body, by_convention};
use super::{Families, Outcome, stated, stated_number};
use crate::observer::Matching;
use crate::observer::colour::{Chromaticity, Tristimulus};
use crate::quantity::constants::K_M_LM_W;
use crate::spectrum::photometry::WavelengthsIn;
use crate::spectrum::{Density, Factor, library, photometry};
use crate::study::verify::case::{Case, Fault};

pub(super) const FAMILIES: Families = &[
    ("g2a.bb-x", |c| Ok(chromaticity(&temperature_radiator(c)?)?.x.into())),
    ("g2a.bb-y", |c| Ok(chromaticity(&temperature_radiator(c)?)?.y.into())),
    ("g2b.xy-A-x", |c| Ok(chromaticity(&illuminant(c)?)?.x.into())),
    ("g2b.xy-A-y", |c| Ok(chromaticity(&illuminant(c)?)?.y.into())),
    ("g2b.xy-D65-x", |c| Ok(chromaticity(&illuminant(c)?)?.x.into())),
    ("g2b.xy-D65-y", |c| Ok(chromaticity(&illuminant(c)?)?.y.into())),
    ("g2b.ler-A", |c| efficacy(c, &illuminant(c)?)),
    ("g2b.ler-D65", |c| efficacy(c, &illuminant(c)?)),
    ("g2e.led-x", |c| Ok(chromaticity(&led(c)?)?.x.into())),
    ("g2e.led-y", |c| Ok(chromaticity(&led(c)?)?.y.into())),
    ("g2e.led-ler", |c| efficacy(c, &led(c)?)),
    ("g2e.led-ppfd", photons),
];

fn chromaticity(density: &Density) -> Result<Chromaticity, Fault> {
    let seen = Tristimulus::of(density, &Matching::Cie1931.functions());
    seen.chromaticity().ok_or_else(|| Fault::wrong("the spectrum has no colour"))
}

fn efficacy(c: &Case, density: &Density) -> Outcome {
    stated_number(c, "Km", K_M_LM_W)?;
    let efficacy = photometry::luminous_efficacy_lm_w(density, &library::v_lambda());
    Ok(efficacy.ok_or_else(|| Fault::wrong("the spectrum has no power"))?.into())
}

fn temperature_radiator(c: &Case) -> Result<Density, Fault> {
    by_convention(&black_body(c)?, c.text("convention")?)
}

/// The spectrum that a case names: a formula of the library, or a table.
fn illuminant(c: &Case) -> Result<Density, Fault> {
    let whole = match c.text("spd")? {
        "CIE illuminant A, formula 1.435e7/2848" => Density::illuminant_a(),
        file => Density::table(c.table(file, 0)?)?,
    };
    by_convention(&whole, c.text("convention")?)
}

fn led(c: &Case) -> Result<Density, Fault> {
    by_convention(&c.gaussians("gaussians")?, c.text("convention")?)
}

/// Photons of 400 nm to 700 nm that come with an illuminance, µmol m⁻² s⁻¹.
fn photons(c: &Case) -> Outcome {
    stated(c, "convention", "sum1(400,700) photons, sum1(360,830) lux")?;
    let density = by_convention(&c.gaussians("gaussians")?, "sum1(360,830)")?;
    let lux = photometry::luminous(&density, &library::v_lambda());
    let band = Factor::band(400.0, 700.0, 1.0)?;
    let photons = photometry::photons_mol(&density.filtered(&band), WavelengthsIn::Vacuum);
    Ok((1e6 * photons * (c.number("E_lx")? / lux)).into())
}
