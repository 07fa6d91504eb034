//! Group g2, chromaticities and efficacies: black bodies, illuminants, LEDs. One function a family.

use etendue::observer::Matching;
use etendue::observer::colour::{Chromaticity, Tristimulus};
use etendue::quantity::constants::K_M_LM_W;
use etendue::spectrum::photometry::WavelengthsIn;
use etendue::spectrum::table_text::{TextRules, parse};
use etendue::spectrum::{Density, Factor, Outside, Table, library, photometry};

use super::bench::{Case, Family};
use super::spectra::by_convention;

pub(crate) const FAMILIES: &[(&str, Family)] = &[
    ("g2a.bb-x", |c| chromaticity(&black_body(c)).x),
    ("g2a.bb-y", |c| chromaticity(&black_body(c)).y),
    ("g2b.xy-A-x", |c| chromaticity(&illuminant(c)).x),
    ("g2b.xy-A-y", |c| chromaticity(&illuminant(c)).y),
    ("g2b.xy-D65-x", |c| chromaticity(&illuminant(c)).x),
    ("g2b.xy-D65-y", |c| chromaticity(&illuminant(c)).y),
    ("g2b.ler-A", |c| efficacy(c, &illuminant(c))),
    ("g2b.ler-D65", |c| efficacy(c, &illuminant(c))),
    ("g2e.led-x", |c| chromaticity(&led(c)).x),
    ("g2e.led-y", |c| chromaticity(&led(c)).y),
    ("g2e.led-ler", |c| efficacy(c, &led(c))),
    ("g2e.led-ppfd", photons),
];

fn chromaticity(density: &Density) -> Chromaticity {
    Tristimulus::of(density, &Matching::Cie1931.functions()).chromaticity().unwrap()
}

fn efficacy(c: &Case, density: &Density) -> f64 {
    assert_eq!(c.number("Km"), K_M_LM_W);
    photometry::luminous_efficacy_lm_w(density, &library::v_lambda()).unwrap()
}

fn black_body(c: &Case) -> Density {
    by_convention(&Density::black_body(c.number("T_K")).unwrap(), c.text("convention"))
}

/// The spectrum that a case names: a formula of the library, or a table of `tests/reference/data/`.
fn illuminant(c: &Case) -> Density {
    let whole = match c.text("spd") {
        "CIE illuminant A, formula 1.435e7/2848" => Density::illuminant_a(),
        file => {
            let path = format!("{}/tests/reference/data/{file}", env!("CARGO_MANIFEST_DIR"));
            let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
            let mut curves = parse(&text, &TextRules::default()).unwrap();
            Density::table(Table::new(curves.wavelengths_nm, curves.columns.remove(0), Outside::Zero).unwrap()).unwrap()
        }
    };
    by_convention(&whole, c.text("convention"))
}

/// Gaussians by their height and full width at half maximum.
fn bells(c: &Case) -> Density {
    c.records("gaussians").iter().fold(Density::zero(), |sum, bell| {
        let sigma_nm = bell["fwhm_nm"] / (8.0 * std::f64::consts::LN_2).sqrt();
        let power = bell["peak"] * sigma_nm * (2.0 * std::f64::consts::PI).sqrt();
        sum.plus(&Density::gaussian(power, bell["centre_nm"], sigma_nm).unwrap())
    })
}

fn led(c: &Case) -> Density {
    by_convention(&bells(c), c.text("convention"))
}

/// Photons of 400 nm to 700 nm that come with an illuminance, µmol m⁻² s⁻¹.
fn photons(c: &Case) -> f64 {
    assert_eq!(c.text("convention"), "sum1(400,700) photons, sum1(360,830) lux");
    let density = bells(c);
    let lux = photometry::luminous(&by_convention(&density, "sum1(360,830)"), &library::v_lambda());
    let band = Factor::band(400.0, 700.0, 1.0).unwrap();
    let photons = photometry::photons_mol(&by_convention(&density, "sum1(360,830)").filtered(&band), WavelengthsIn::Vacuum);
    1e6 * photons * (c.number("E_lx") / lux)
}
