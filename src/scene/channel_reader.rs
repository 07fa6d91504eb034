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
//! | `Photocurrent` | A | 1; s(λ) must be in A/W, stated so or from a quantum efficiency (`responsivity_reader.rs`) |
//! | `Weighted(name: "erythemal irradiance", symbol: "E_er", unit: "W/m²", per_watt: 1)` | as given | as given |
//! | `Weighted(…, of: Radiance)` | as given | as given, over `∫R cosθ dω` of the acceptance |
//! | `Signal(unit: "V", per_watt: 2)` | as given | as given |
//!
//! `ScotopicIlluminance` and `EquivalentDaylightIlluminance` need no `responsivity`: without one the channel has that of the observer. Photons
//! are counted at the wavelength in vacuum, n(λ) λ: files give wavelengths in air. Several channels at once:
//! `observer_reader.rs`.
//!
//! | other keys | meaning |
//! |---|---|
//! | `uncertainty_percent: 1.5` | standard uncertainty of the responsivity, the same share at every wavelength |
//! | `temperature: (coefficient_percent_per_k: 0.1, adjusted_at_c: 25, used_at_c: 35)` | the indication is multiplied by 1 + c (T − T₀) |
//! | `ideal: Band(from_nm: 400, to_nm: 700)` | what an ideal channel weighs light with, where the quantity does not say it |

use super::acceptance_reader::words_of_head;
use super::adjustment::{System, read_luminous_scale, read_optional_adjustment};
use super::decode::{Fields, Value, readable};
use super::document::{Body, Kind};
use super::factor_range::{LARGEST, outside_of};
use super::reading::Reading;
use super::responsivity_reader::{Responsivity, read_responsivity};
use super::spectrum_reader::{read_factor, v_lambda};
use crate::naming::suggestion;
use crate::observer::{AlphaOpic, Efficiency};
use crate::quantity::constants::{AVOGADRO_PER_MOL, K_M_LM_W};
use crate::quantity::measurand::Measurand;
use crate::sensor::{Acceptance, Aperture, Channel, ResponsivityKind, ResponsivityUncertainty, TemperatureCoefficient, Weighting};
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

/// What a channel indicates, and by which scale; what an ideal channel weighs light with, where the quantity says it.
struct Indication {
    reads: Measurand,
    scale: f64,
    ideal: Option<Weighting>,
}

impl Indication {
    /// Of a quantity that leaves the weighting to the channel.
    fn new(reads: Measurand, scale: f64) -> Indication {
        Indication { reads, scale, ideal: None }
    }

    /// Of a quantity with a weighting of its own.
    fn of(reads: Measurand, scale: f64, system: System) -> Indication {
        Indication { reads, scale, ideal: Some(Weighting { curve: system.curve, scale: system.per_watt }) }
    }
}

const KEYS: [&str; 6] = ["name", "responsivity", "reads", "uncertainty_percent", "temperature", "ideal"];

/// Reads a channel. The aperture and the acceptance are those of its sensor, if they could be read.
pub(super) fn read_channel(
    value: &Value,
    aperture: Option<Aperture>,
    acceptance: Option<&Acceptance>,
    reading: &mut Reading,
) -> Option<Channel> {
    let fields = value.fields("a channel", &KEYS, &mut reading.problems)?;
    let name = fields.require("name", "\"E_v\"", &mut reading.problems).and_then(|v| v.text(&mut reading.problems));
    let has_own_curve =
        fields.get("reads").is_some_and(|reads| matches!(reads.name(), "ScotopicIlluminance" | "EquivalentDaylightIlluminance"));
    let given = match fields.get("responsivity") {
        None if has_own_curve => None,
        _ => Some(fields.require("responsivity", "\"V\"", &mut reading.problems).and_then(|v| read_responsivity(&v, reading))),
    };
    let stated = fields
        .get("uncertainty_percent")
        .map(|v| v.number_in("the uncertainty of the responsivity", "0 % to 100 %", |x| (0.0..=100.0).contains(&x), &mut reading.problems));
    let temperature = fields.get("temperature").map(|v| read_temperature(&v, reading));
    let reads = fields.require("reads", "Illuminance", &mut reading.problems)?;
    let curve = given.as_ref().map(|given| given.as_ref().map(|r| &r.curve));
    let found = read_indication(&reads, curve, aperture, acceptance, reading)?;
    let ideal = read_ideal(&fields, &found, reads.name(), reading);
    let given = match given {
        Some(given) => given?,
        None => Responsivity {
            curve: ideal.as_ref()?.curve.clone(),
            kind: ResponsivityKind::Relative,
            uncertainty: Vec::new(),
            other_unit: None,
        },
    };
    unit_serves(&reads, &given, &fields, reading)?;
    let mut channel = Channel::new(name?, given.curve, found.reads, found.scale);
    channel.kind = given.kind;
    channel.responsivity_uncertainty = given.uncertainty;
    channel.responsivity_uncertainty.extend(match stated {
        Some(percent) => Some(ResponsivityUncertainty::Relative(0.01 * percent?)),
        None => None,
    });
    channel.temperature = match temperature {
        Some(temperature) => Some(temperature?),
        None => None,
    };
    channel.ideal = ideal;
    if reads.name() == "PhotonIrradiance" {
        let counted = |curve: Factor| Factor::Product(vec![curve, photons_per_joule(WavelengthsIn::StandardAir)]);
        channel.responsivity = counted(channel.responsivity);
        channel.ideal = channel.ideal.map(|ideal| Weighting { curve: counted(ideal.curve), ..ideal });
        for u in &mut channel.responsivity_uncertainty {
            if let ResponsivityUncertainty::Curve(curve) = u {
                *curve = counted(curve.clone());
            }
        }
    }
    // What the file names itself keeps its name.
    if reads.name() != "Weighted" {
        channel.reads = words_of_head(&channel.reads, acceptance.and_then(Acceptance::head));
    }
    Some(channel)
}

/// Whether the unit of a responsivity goes with the quantity.
fn unit_serves(reads: &Value, given: &Responsivity, fields: &Fields, reading: &mut Reading) -> Option<()> {
    let quantity = reads.name();
    let unit = given.other_unit.as_deref().unwrap_or("A/W");
    let problem = match (given.kind.is_absolute() || given.other_unit.is_some(), quantity) {
        (true, "Photocurrent") if !given.kind.is_absolute() => Some((
            format!("a photocurrent needs a responsivity in A/W, and the file says that its values are in {unit}"),
            "correct `# unit:` in the file, or write `reads: Signal(unit: \"V\", per_watt: 1)` for another signal".to_owned(),
        )),
        (false, "Photocurrent") => Some((
            "a photocurrent needs a responsivity with a unit".to_owned(),
            "write `responsivity: AmperesPerWatt(…)`, or `QuantumEfficiency(…)` for electrons per photon; a curve file may say `# unit: A/W`"
                .to_owned(),
        )),
        (true, "Irradiance" | "RadiantFlux" | "Radiance" | "PhotonIrradiance") => Some((
            match &given.other_unit {
                None => format!("a responsivity in A/W gives a current, not what `{quantity}` is"),
                Some(unit) => format!("the file says that its values are in {unit}, which gives another signal than `{quantity}`"),
            },
            match &given.other_unit {
                None => "write `Relative(…)` if only its shape counts, `reads: Photocurrent`, or `reads: Signal(unit: \"V\", per_watt: 1)`".to_owned(),
                Some(_) => "write `Relative(…)` if only its shape counts, or `reads: Signal(unit: \"V\", per_watt: 1)`".to_owned(),
            },
        )),
        (true, _) if matches!(&reads.node.kind, Kind::Struct { body: Body::None, .. }) && quantity != "Photocurrent" => Some((
            format!("with a responsivity in {unit}, `{quantity}` needs an adjustment"),
            format!("write `{quantity}(adjusted_with: \"A\")`, or `Relative(…)` if only the shape of the curve counts"),
        )),
        _ => None,
    };
    let Some((message, help)) = problem else { return Some(()) };
    // The curve is what lacks the unit, where there is one.
    fields.get("responsivity").as_ref().unwrap_or(reads).problem(&mut reading.problems, message, help);
    None
}

/// What an ideal channel weighs light with: as the quantity says, or as the file does.
fn read_ideal(fields: &Fields, found: &Indication, quantity: &str, reading: &mut Reading) -> Option<Weighting> {
    let Some(given) = fields.get("ideal") else { return found.ideal.clone() };
    if found.ideal.is_some() {
        fields.refuse(&["ideal"], &format!("`{quantity}` says itself how light is weighted"), &mut reading.problems);
        return None;
    }
    let curve = read_factor(&given, Outside::Zero, reading)?;
    if let Some((nm, value)) = outside_of(&curve, 0.0, LARGEST) {
        given.problem(
            &mut reading.problems,
            format!("the weighting is {} at {nm} nm", readable(value)),
            "allowed: 0 and above at every wavelength",
        );
        return None;
    }
    Some(Weighting { curve, scale: found.scale })
}

fn read_temperature(value: &Value, reading: &mut Reading) -> Option<TemperatureCoefficient> {
    let problems = &mut reading.problems;
    let fields = value.fields("`temperature`", &["coefficient_percent_per_k", "adjusted_at_c", "used_at_c"], problems)?;
    let mut number = |key: &str, example: &str| fields.require(key, example, problems).and_then(|v| v.number(problems));
    let percent = number("coefficient_percent_per_k", "0.1");
    let (adjusted_at_c, used_at_c) = (number("adjusted_at_c", "25"), number("used_at_c", "35"));
    let found = TemperatureCoefficient { per_k: 0.01 * percent?, adjusted_at_c: adjusted_at_c?, used_at_c: used_at_c? };
    let factor = found.factor();
    if factor > 0.0 && factor.is_finite() {
        return Some(found);
    }
    let message = format!("at {} °C the indication would be multiplied by {factor}", found.used_at_c);
    value.problem(problems, message, "allowed: coefficients and temperatures that leave the factor 1 + c (T − T₀) above 0");
    None
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
    let unweighted = |reads: Measurand, scale: f64| Some(Indication::new(reads, scale));
    match quantity {
        "Illuminance" | "LuminousFlux" | "Luminance" => {
            let system = System { curve: v_lambda(), per_watt: K_M_LM_W };
            let scale = read_luminous_scale(reads, &system, given.flatten(), reading)?;
            let measurand = match quantity {
                "Illuminance" => Measurand::Illuminance,
                "LuminousFlux" => Measurand::LuminousFlux,
                _ => Measurand::Luminance,
            };
            Some(Indication::of(measurand, scale, system))
        }
        "ScotopicIlluminance" => {
            let efficiency = Efficiency::Scotopic1951;
            let system = System { curve: efficiency.curve(), per_watt: efficiency.max_efficacy_lm_w() };
            let scale = read_luminous_scale(reads, &system, given.unwrap_or(Some(&system.curve)), reading)?;
            Some(Indication::of(scotopic_illuminance(), scale, system))
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
    if let Some(head) = acceptance.and_then(Acceptance::head) {
        value.problem_at(
            &value.name_span(),
            &mut reading.problems,
            format!("`{}` is seen in a direction, but a {} receptor sees all round", value.name(), head.name()),
            "read `Illuminance` or `Irradiance`, or give an acceptance with a direction, such as `Cone(half_angle_deg: 0.5)`",
        );
        return false;
    }
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
    Some(Indication::new(weighted(name?, symbol?, unit?), per_watt? * of?.0))
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
    Some(Indication::of(weighted(&words, &format!("E_v,{}^D65", alpha.index()), "lx"), scale, system))
}
