//! Channels of a sensor file: a responsivity and what the indication stands for.
//!
//! | `reads:` | unit | indication per `∫ s(λ) E(λ) dλ` |
//! |---|---|---|
//! | `Irradiance`, `RadiantFlux`, `Radiance` | W/m², W, W/(m² sr) | 1 |
//! | `Illuminance`, `LuminousFlux`, `Luminance` | lx, lm, cd/m² | K_m = 683.002 lm/W |
//! | … `(adjusted_with: "A")` | | `K_m ∫S V dλ / ∫S s dλ`: true for that spectrum |
//! | … `(efficacy_lm_w: 683)` | | as given |
//! | `PhotonIrradiance` | µmol/(m² s) | `10⁶ / (N_A h c)`, and s(λ) is multiplied by n(λ) λ |
//! | `Photocurrent` | A | 1; s(λ) is in A/W |
//! | `Signal(unit: "V", per_watt: 2)` | as given | as given |
//!
//! Photons are counted at the wavelength in vacuum, n(λ) λ: files give wavelengths in air.

use super::decode::Value;
use super::factor_range::{LARGEST, is_zero, outside_of};
use super::reading::Reading;
use super::spectrum_reader::{read_factor, read_spectrum, v_lambda};
use crate::quantity::air::wavelength_in_vacuum_nm;
use crate::quantity::constants::{AVOGADRO_PER_MOL, K_M_LM_W, PLANCK_J_S, SPEED_OF_LIGHT_M_S};
use crate::quantity::measurand::Measurand;
use crate::sensor::{Acceptance, Aperture, Channel};
use crate::spectrum::{Factor, Outside, Table};

const READS: [&str; 9] =
    ["Irradiance", "Illuminance", "RadiantFlux", "LuminousFlux", "Radiance", "Luminance", "PhotonIrradiance", "Photocurrent", "Signal"];

/// Reads a channel. The aperture and the acceptance are those of its sensor, if they could be read.
pub(super) fn read_channel(
    value: &Value,
    aperture: Option<Aperture>,
    acceptance: Option<&Acceptance>,
    reading: &mut Reading,
) -> Option<Channel> {
    let fields = value.fields("a channel", &["name", "responsivity", "reads"], &mut reading.problems)?;
    let name = fields.require("name", "\"E_v\"", &mut reading.problems).and_then(|v| v.text(&mut reading.problems));
    let responsivity = fields.require("responsivity", "\"V\"", &mut reading.problems).and_then(|v| {
        let factor = read_factor(&v, Outside::Zero, reading)?;
        if let Some((nm, found)) = outside_of(&factor, 0.0, LARGEST) {
            let help = format!("allowed: 0 to {LARGEST:e} at every wavelength");
            v.problem(&mut reading.problems, format!("the responsivity is {found} at {nm} nm"), help);
            return None;
        }
        if is_zero(&factor) {
            v.problem(
                &mut reading.problems,
                "the responsivity is zero at every wavelength, so nothing can be read",
                "give a responsivity that is above zero somewhere",
            );
            return None;
        }
        Some(factor)
    });
    let reads = fields.require("reads", "Illuminance", &mut reading.problems)?;
    let quantity = reads.variant("a quantity that a channel can read", &READS, &mut reading.problems)?;
    if matches!(quantity, "RadiantFlux" | "LuminousFlux" | "Photocurrent") && aperture == Some(Aperture::Point) {
        reads.problem_at(
            &reads.name_span(),
            &mut reading.problems,
            format!("`{quantity}` is collected by an area, but the aperture is a point"),
            "give the aperture a size, such as `aperture: Disc(radius_mm: 5)`",
        );
        return None;
    }
    if matches!(quantity, "Radiance" | "Luminance") && acceptance.is_some_and(|a| a.projected_solid_angle_sr() <= 0.0) {
        reads.problem_at(
            &reads.name_span(),
            &mut reading.problems,
            format!("`{quantity}` needs an acceptance with a solid angle"),
            "give a half-angle above 0°",
        );
        return None;
    }
    let luminous = matches!(quantity, "Illuminance" | "LuminousFlux" | "Luminance");
    let scale = match quantity {
        "Signal" => None,
        _ if luminous => Some(read_luminous_scale(&reads, responsivity.as_ref(), reading)?),
        _ => {
            reads.without_brackets(&mut reading.problems)?;
            Some(1.0)
        }
    };
    let (measurand, scale) = match (quantity, scale) {
        ("Signal", _) => {
            let problems = &mut reading.problems;
            let signal = reads.fields("`Signal`", &["unit", "per_watt"], problems)?;
            let unit = signal.require("unit", "\"V\"", problems).and_then(|v| v.text(problems));
            let per_watt =
                signal.require("per_watt", "2", problems).and_then(|v| v.number_in("`per_watt`", "above 0", |x| x > 0.0, problems));
            (Measurand::Signal { unit: unit?.into() }, per_watt?)
        }
        ("PhotonIrradiance", _) => {
            let words = Measurand::Weighted { name: "photon irradiance".into(), symbol: "E_p".into(), unit: "µmol/(m² s)".into() };
            (words, 1e6 / (AVOGADRO_PER_MOL * PLANCK_J_S * SPEED_OF_LIGHT_M_S))
        }
        (other, scale) => {
            let measurand = match other {
                "Irradiance" => Measurand::Irradiance,
                "Illuminance" => Measurand::Illuminance,
                "RadiantFlux" => Measurand::RadiantFlux,
                "LuminousFlux" => Measurand::LuminousFlux,
                "Radiance" => Measurand::Radiance,
                "Luminance" => Measurand::Luminance,
                _ => Measurand::Photocurrent,
            };
            (measurand, scale?)
        }
    };
    let (name, mut responsivity) = (name?, responsivity?);
    if quantity == "PhotonIrradiance" {
        responsivity = Factor::Product(vec![responsivity, Factor::Proportional(1e-9), refractive_index()?]);
    }
    Some(Channel { name: name.into(), responsivity, reads: measurand, scale })
}

/// What a luminous channel indicates per unit of weighted irradiance, lm/W.
fn read_luminous_scale(reads: &Value, responsivity: Option<&Factor>, reading: &mut Reading) -> Option<f64> {
    use super::document::{Body, Kind};
    if matches!(&reads.node.kind, Kind::Struct { body: Body::None, .. }) {
        return Some(K_M_LM_W);
    }
    let quantity = reads.name();
    let fields = reads.fields(&format!("`{quantity}`"), &["adjusted_with", "efficacy_lm_w"], &mut reading.problems)?;
    match (fields.get("adjusted_with"), fields.get("efficacy_lm_w")) {
        (Some(spectrum), None) => {
            let density = read_spectrum(&spectrum, reading)?;
            let (true_lm, seen) = (density.integral(&[&v_lambda()]), density.integral(&[responsivity?]));
            if seen > 0.0 && true_lm > 0.0 {
                return Some(K_M_LM_W * (true_lm / seen));
            }
            let blind = if seen > 0.0 { "the eye" } else { "this responsivity" };
            spectrum.problem(
                &mut reading.problems,
                format!("a meter cannot be adjusted with a spectrum that {blind} does not see"),
                "adjust with a spectrum such as \"A\", or give `efficacy_lm_w`",
            );
            None
        }
        (None, Some(efficacy)) => efficacy.number_in("the efficacy", "above 0 lm/W", |x| x > 0.0, &mut reading.problems),
        (Some(_), Some(_)) => {
            reads.problem_at(
                &fields.key_span("efficacy_lm_w"),
                &mut reading.problems,
                "both `adjusted_with` and `efficacy_lm_w` are given",
                "keep one of them: each says what the meter indicates",
            );
            None
        }
        (None, None) => {
            reads.problem(
                &mut reading.problems,
                format!("`{quantity}()` says nothing about the adjustment"),
                format!("write `{quantity}`, `{quantity}(adjusted_with: \"A\")` or `{quantity}(efficacy_lm_w: 683)`"),
            );
            None
        }
    }
}

/// Refractive index of air at a wavelength in air, every 5 nm from 200 nm to 2500 nm and held outside; between the nodes it is straight
/// to 1e-8.
fn refractive_index() -> Option<Factor> {
    let rows: Vec<(f64, f64)> = (40..=500).map(|i| 5.0 * f64::from(i)).map(|nm| (nm, wavelength_in_vacuum_nm(nm) / nm)).collect();
    Table::from_rows(&rows, Outside::Hold).ok().map(Factor::Table)
}
