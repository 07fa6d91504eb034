//! Channels of a sensor file: a responsivity and what the indication stands for.
//!
//! | `reads:` | unit | indication per `∫ s(λ) E(λ) dλ` |
//! |---|---|---|
//! | `Irradiance`, `RadiantFlux`, `Radiance` | W/m², W, W/(m² sr) | 1 |
//! | `Illuminance`, `LuminousFlux`, `Luminance` | lx, lm, cd/m² | K_m = 683.002 lm/W |
//! | `ScotopicIlluminance` | lx | K′_m = 1700.05 lm/W |
//! | … `(adjusted_with: "A")` | | `K ∫S V dλ / ∫S s dλ`: true for that spectrum |
//! | … `(efficacy_lm_w: 683)` | | as given |
//! | `EquivalentDaylightIlluminance("melanopic")` | lx | `1/K_α,v(D65)`, α-opic EDI of CIE S 026 |
//! | … `(receptor: "melanopic", adjusted_with: "D65")` | | true for that spectrum |
//! | `PhotonIrradiance` | µmol/(m² s) | `10⁶ / N_A`, and s(λ) is multiplied by n(λ) λ/(hc) |
//! | `Photocurrent` | A | 1; s(λ) is in A/W |
//! | `Weighted(name: "erythemal irradiance", symbol: "E_er", unit: "W/m²", per_watt: 1)` | as given | as given |
//! | `Weighted(…, of: Radiance)` | as given | as given, over `∫R cosθ dω` of the acceptance |
//! | `Signal(unit: "V", per_watt: 2)` | as given | as given |
//!
//! `ScotopicIlluminance` and `EquivalentDaylightIlluminance` need no `responsivity`: without one the channel has that of the observer. Photons
//! are counted at the wavelength in vacuum, n(λ) λ: files give wavelengths in air. Several channels at once:
//! `observer_reader.rs`.

use super::adjustment::{System, read_luminous_scale, read_optional_adjustment};
use super::decode::Value;
use super::document::{Body, Kind};
use super::factor_range::{LARGEST, is_zero, outside_of};
use super::reading::Reading;
use super::spectrum_reader::{read_factor, v_lambda};
use crate::naming::suggestion;
use crate::observer::{AlphaOpic, Efficiency};
use crate::quantity::constants::{AVOGADRO_PER_MOL, K_M_LM_W};
use crate::quantity::measurand::Measurand;
use crate::sensor::{Acceptance, Aperture, Channel};
use crate::spectrum::photometry::{WavelengthsIn, photons_per_joule};
use crate::spectrum::{Factor, Outside};

const READS: [&str; 12] = [
    "Irradiance",
    "Illuminance",
    "ScotopicIlluminance",
    "EquivalentDaylightIlluminance",
    "RadiantFlux",
    "LuminousFlux",
    "Radiance",
    "Luminance",
    "PhotonIrradiance",
    "Photocurrent",
    "Weighted",
    "Signal",
];

/// What a channel indicates, and by which scale; the observer's own curve if the file gives no responsivity.
struct Indication {
    reads: Measurand,
    scale: f64,
    own_curve: Option<Factor>,
}

/// Reads a channel. The aperture and the acceptance are those of its sensor, if they could be read.
pub(super) fn read_channel(
    value: &Value,
    aperture: Option<Aperture>,
    acceptance: Option<&Acceptance>,
    reading: &mut Reading,
) -> Option<Channel> {
    let fields = value.fields("a channel", &["name", "responsivity", "reads"], &mut reading.problems)?;
    let name = fields.require("name", "\"E_v\"", &mut reading.problems).and_then(|v| v.text(&mut reading.problems));
    let has_own_curve =
        fields.get("reads").is_some_and(|reads| matches!(reads.name(), "ScotopicIlluminance" | "EquivalentDaylightIlluminance"));
    let given = match fields.get("responsivity") {
        None if has_own_curve => None,
        _ => Some(fields.require("responsivity", "\"V\"", &mut reading.problems).and_then(|v| read_responsivity(&v, reading))),
    };
    let reads = fields.require("reads", "Illuminance", &mut reading.problems)?;
    let found = read_indication(&reads, given.as_ref().map(Option::as_ref), aperture, acceptance, reading)?;
    let (name, mut responsivity) = (name?, given.unwrap_or(found.own_curve)?);
    if reads.name() == "PhotonIrradiance" {
        responsivity = Factor::Product(vec![responsivity, photons_per_joule(WavelengthsIn::StandardAir)]);
    }
    Some(Channel::new(name, responsivity, found.reads, found.scale))
}

/// A responsivity that is nowhere negative and somewhere above zero.
fn read_responsivity(value: &Value, reading: &mut Reading) -> Option<Factor> {
    let factor = read_factor(value, Outside::Zero, reading)?;
    if let Some((nm, found)) = outside_of(&factor, 0.0, LARGEST) {
        let help = format!("allowed: 0 to {LARGEST:e} at every wavelength");
        value.problem(&mut reading.problems, format!("the responsivity is {found} at {nm} nm"), help);
        return None;
    }
    if is_zero(&factor) {
        value.problem(
            &mut reading.problems,
            "the responsivity is zero at every wavelength, so nothing can be read",
            "give a responsivity that is above zero somewhere",
        );
        return None;
    }
    Some(factor)
}

/// Reads the quantity. `given`: whether the file gives a responsivity, and if it could be read, which.
fn read_indication(
    reads: &Value,
    given: Option<Option<&Factor>>,
    aperture: Option<Aperture>,
    acceptance: Option<&Acceptance>,
    reading: &mut Reading,
) -> Option<Indication> {
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
    if matches!(quantity, "Radiance" | "Luminance") && !has_solid_angle(reads, acceptance, reading) {
        return None;
    }
    let unweighted = |reads: Measurand, scale: f64| Some(Indication { reads, scale, own_curve: None });
    match quantity {
        "Illuminance" | "LuminousFlux" | "Luminance" => {
            let system = System { curve: v_lambda(), per_watt: K_M_LM_W };
            let scale = read_luminous_scale(reads, &system, given.flatten(), reading)?;
            let measurand = match quantity {
                "Illuminance" => Measurand::Illuminance,
                "LuminousFlux" => Measurand::LuminousFlux,
                _ => Measurand::Luminance,
            };
            unweighted(measurand, scale)
        }
        "ScotopicIlluminance" => {
            let efficiency = Efficiency::Scotopic1951;
            let system = System { curve: efficiency.curve(), per_watt: efficiency.max_efficacy_lm_w() };
            let scale = read_luminous_scale(reads, &system, given.unwrap_or(Some(&system.curve)), reading)?;
            Some(Indication { reads: scotopic_illuminance(), scale, own_curve: Some(system.curve) })
        }
        "EquivalentDaylightIlluminance" => read_equivalent_daylight(reads, given, reading),
        "Weighted" => read_weighted(reads, acceptance, reading),
        "Signal" => {
            let problems = &mut reading.problems;
            let signal = reads.fields("`Signal`", &["unit", "per_watt"], problems)?;
            let unit = signal.require("unit", "\"V\"", problems).and_then(|v| v.text(problems));
            let per_watt =
                signal.require("per_watt", "2", problems).and_then(|v| v.number_in("`per_watt`", "above 0", |x| x > 0.0, problems));
            unweighted(Measurand::Signal { unit: unit?.into() }, per_watt?)
        }
        _ => {
            reads.without_brackets(&mut reading.problems)?;
            match quantity {
                "Irradiance" => unweighted(Measurand::Irradiance, 1.0),
                "RadiantFlux" => unweighted(Measurand::RadiantFlux, 1.0),
                "Radiance" => unweighted(Measurand::Radiance, 1.0),
                "Photocurrent" => unweighted(Measurand::Photocurrent, 1.0),
                _ => unweighted(weighted("photon irradiance", "E_p", "µmol/(m² s)"), 1e6 / AVOGADRO_PER_MOL),
            }
        }
    }
}

/// A measurand with its own words.
pub(super) fn weighted(name: &str, symbol: &str, unit: &str) -> Measurand {
    Measurand::Weighted { name: name.into(), symbol: symbol.into(), unit: unit.into() }
}

/// What a channel with V′(λ) reads.
pub(super) fn scotopic_illuminance() -> Measurand {
    weighted("scotopic illuminance", "E′_v", "lx")
}

/// Notes a problem if the acceptance of a channel that reads a radiance has no solid angle.
pub(super) fn has_solid_angle(value: &Value, acceptance: Option<&Acceptance>, reading: &mut Reading) -> bool {
    if acceptance.is_none_or(|a| a.projected_solid_angle_sr() > 0.0) {
        return true;
    }
    value.problem_at(
        &value.name_span(),
        &mut reading.problems,
        format!("`{}` needs an acceptance with a solid angle", value.name()),
        "give a half-angle above 0°",
    );
    false
}

/// What a weighted irradiance is multiplied by: 1 for `of: Irradiance` or nothing, `1/∫R cosθ dω` for `of: Radiance`, with whether
/// it is a radiance.
pub(super) fn read_of(of: Option<Value>, acceptance: Option<&Acceptance>, reading: &mut Reading) -> Option<(f64, bool)> {
    let Some(of) = of else { return Some((1.0, false)) };
    let name = of.variant("a quantity that can be weighted", &["Irradiance", "Radiance"], &mut reading.problems)?;
    of.without_brackets(&mut reading.problems)?;
    if name == "Irradiance" {
        return Some((1.0, false));
    }
    if !has_solid_angle(&of, acceptance, reading) {
        return None;
    }
    Some((1.0 / acceptance?.projected_solid_angle_sr(), true))
}

fn read_weighted(reads: &Value, acceptance: Option<&Acceptance>, reading: &mut Reading) -> Option<Indication> {
    let fields = reads.fields("`Weighted`", &["name", "symbol", "unit", "per_watt", "of"], &mut reading.problems)?;
    let problems = &mut reading.problems;
    let mut text = |key: &str, example: &str| fields.require(key, example, problems).and_then(|v| v.text(problems));
    let (name, symbol, unit) = (text("name", "\"erythemal irradiance\""), text("symbol", "\"E_er\""), text("unit", "\"W/m²\""));
    let per_watt = fields.require("per_watt", "1", problems);
    let per_watt = per_watt.and_then(|v| v.number_in("`per_watt`", "above 0, up to 1e100", |x| x > 0.0 && x <= LARGEST, problems));
    let of = read_of(fields.get("of"), acceptance, reading);
    Some(Indication { reads: weighted(name?, symbol?, unit?), scale: per_watt? * of?.0, own_curve: None })
}

fn read_equivalent_daylight(reads: &Value, given: Option<Option<&Factor>>, reading: &mut Reading) -> Option<Indication> {
    let named = matches!(&reads.node.kind, Kind::Struct { body: Body::Named(_), .. });
    let fields = if named {
        Some(reads.fields("`EquivalentDaylightIlluminance`", &["receptor", "adjusted_with"], &mut reading.problems)?)
    } else {
        None
    };
    let receptor = match &fields {
        Some(fields) => fields.require("receptor", "\"melanopic\"", &mut reading.problems)?,
        None => {
            let form = "EquivalentDaylightIlluminance(\"melanopic\")";
            reads.positional(1, form, &mut reading.problems)?.into_iter().next()?
        }
    };
    let name = receptor.text(&mut reading.problems)?;
    let Ok(alpha) = AlphaOpic::named(name) else {
        let help = suggestion(name, &AlphaOpic::ALL.map(AlphaOpic::name));
        receptor.problem(&mut reading.problems, format!("there is no α-opic action spectrum called \"{name}\""), help);
        return None;
    };
    let system = System { curve: alpha.curve(), per_watt: 1.0 / alpha.elr_of_d65() };
    let responsivity = given.unwrap_or(Some(&system.curve));
    let scale = fields.map_or(Some(system.per_watt), |fields| read_optional_adjustment(&fields, &system, responsivity, reading))?;
    let words = format!("{} equivalent daylight (D65) illuminance", alpha.name());
    Some(Indication { reads: weighted(&words, &format!("E_v,{}^D65", alpha.index()), "lx"), scale, own_curve: Some(system.curve) })
}
