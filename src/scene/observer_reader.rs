//! Observers as channels of a sensor: `channels: Observer("CIE 1931")`, or as an item of the list of channels.
//!
//! ```ron
//! channels: Observer("cones 2 degree")
//! channels: Observer(name: "CIE 170-1", age_yr: 60, field_deg: 4)
//! channels: [Observer(name: "CIE 1931", of: Radiance), (name: "E_e", responsivity: 1, reads: Irradiance)]
//! ```
//!
//! | observer | channels | indication per `∫ s(λ) E(λ) dλ` | unit |
//! |---|---|---|---|
//! | `"CIE 1931"`, `"CIE 1964"`, `"CIE 2015 2 degree"`, `"CIE 2015 10 degree"` | X, Y, Z; X_10 …; X_F …; X_F,10 … | K of the luminous efficiency that ȳ is: 683.002, 683.599, 683.358, 683.144 lm/W | lx for Y, and so for X and Z |
//! | `"cones 2 degree"`, `"cones 10 degree"`, `"CIE 170-1"` | L, M, S | 1; the fundamentals are 1 at their maximum | W/m² |
//! | `"CIE S 026"` | sc, mc, lc, rh, mel | 1 | W/m² |
//! | `"photopic and scotopic"` | E_v, E′_v | K_m, K′_m | lx |
//! | `"V_M"`, `"V_F"`, `"V_F,10"`, `"V_10"` | E_v | K of that luminous efficiency | lx |
//! | `"mesopic"` with `adaptation: 0.5` | E_v | K of V_mes at that coefficient of adaptation, 0 to 1 (CIE 191) | lx |
//!
//! With `of: Radiance` all is divided by `∫R cosθ dω` of the acceptance: cd/m² and W/(m² sr). Aperture and acceptance are those of
//! the sensor. Sets of real primaries (r̄ ḡ b̄) are refused: they are negative somewhere, which no responsivity is, and what is
//! planned and estimated relies on; their values follow from X, Y, Z by a matrix.

use super::channel_reader::{read_of, scotopic_illuminance, weighted};
use super::decode::{Fields, Value};
use super::document::{Body, Kind};
use super::reading::Reading;
use crate::naming::{same, suggestion};
use crate::observer::{AlphaOpic, Cone, Cones, Efficiency, Individual, Matching, ObserverError, mesopic};
use crate::quantity::measurand::Measurand;
use crate::sensor::{Acceptance, Channel, Weighting};
use crate::spectrum::Factor;

const CONES_2: &str = "cones 2 degree";
const CONES_10: &str = "cones 10 degree";
const INDIVIDUAL: &str = "CIE 170-1";
const ALPHA_OPIC: &str = "CIE S 026";
const DAY_AND_NIGHT: &str = "photopic and scotopic";
const MESOPIC: &str = "mesopic";

const NAMES: [&str; 14] = [
    "CIE 1931",
    "CIE 1964",
    "CIE 2015 2 degree",
    "CIE 2015 10 degree",
    CONES_2,
    CONES_10,
    INDIVIDUAL,
    ALPHA_OPIC,
    DAY_AND_NIGHT,
    MESOPIC,
    "V_M",
    "V_F",
    "V_F,10",
    "V_10",
];

/// Whether a value is an observer rather than a channel or a list of channels.
pub(super) fn is_observer(value: &Value) -> bool {
    value.name() == "Observer"
}

/// The channels of an observer. The acceptance is that of its sensor, if it could be read.
pub(super) fn read_observer(value: &Value, acceptance: Option<&Acceptance>, reading: &mut Reading) -> Option<Vec<Channel>> {
    let (name_value, fields) = match &value.node.kind {
        Kind::Struct { body: Body::Named(_), .. } => {
            let fields = value.fields("`Observer`", &["name", "age_yr", "field_deg", "adaptation", "of"], &mut reading.problems)?;
            (fields.require("name", "\"CIE 1931\"", &mut reading.problems)?, Some(fields))
        }
        _ => (value.positional(1, "Observer(\"CIE 1931\")", &mut reading.problems)?.into_iter().next()?, None),
    };
    let written = name_value.text(&mut reading.problems)?;
    let name = NAMES.into_iter().find(|known| same(known, written)).unwrap_or(written);
    let of = read_of(fields.as_ref().and_then(|fields| fields.get("of")), acceptance, reading);
    if name != INDIVIDUAL
        && let Some(fields) = &fields
    {
        let why = format!("only \"{INDIVIDUAL}\" has an age and a field of one's choice");
        fields.refuse(&["age_yr", "field_deg"], &why, &mut reading.problems);
    }
    if name != MESOPIC
        && let Some(fields) = &fields
    {
        fields.refuse(&["adaptation"], &format!("only \"{MESOPIC}\" has a coefficient of adaptation"), &mut reading.problems);
    }
    let cones = match name {
        CONES_2 => Some(Cones::StockmanSharpe2),
        CONES_10 => Some(Cones::StockmanSharpe10),
        INDIVIDUAL => Some(Cones::Individual(read_individual(value, fields.as_ref(), reading)?)),
        _ => None,
    };
    if let Some(cones) = cones {
        let (per_irradiance, is_radiance) = of?;
        let fundamentals = cones.fundamentals().map_err(|error| noted(value, &error, reading)).ok()?;
        let words = |cone: Cone| quantity(&format!("{}-cone-weighted", cone.name()), cone.name(), is_radiance);
        let channels = Cone::ALL.into_iter().zip(fundamentals);
        return Some(channels.map(|(cone, curve)| channel(cone.name(), curve, words(cone), per_irradiance)).collect());
    }
    match name {
        ALPHA_OPIC => {
            let (per_irradiance, is_radiance) = of?;
            let words = |alpha: AlphaOpic| quantity(alpha.name(), alpha.index(), is_radiance);
            Some(AlphaOpic::ALL.map(|alpha| channel(alpha.index(), alpha.curve(), words(alpha), per_irradiance)).to_vec())
        }
        DAY_AND_NIGHT => {
            let (per_irradiance, is_radiance) = of?;
            let (photopic, scotopic) = (Efficiency::Photopic1924, Efficiency::Scotopic1951);
            let words = if is_radiance {
                [("L_v", Measurand::Luminance), ("L′_v", weighted("scotopic luminance", "L′_v", "cd/m²"))]
            } else {
                [("E_v", Measurand::Illuminance), ("E′_v", scotopic_illuminance())]
            };
            // A luminance is divided by the solid angle by its measurand, what has its own words by its scale.
            let per = |reads: &Measurand| if *reads == Measurand::Luminance { 1.0 } else { per_irradiance };
            let channels = words.into_iter().zip([photopic, scotopic]);
            Some(
                channels
                    .map(|((name, reads), v)| {
                        let scale = v.max_efficacy_lm_w() * per(&reads);
                        channel(name, v.curve(), reads, scale)
                    })
                    .collect(),
            )
        }
        MESOPIC => {
            let adaptation = read_adaptation(value, fields.as_ref(), reading);
            let (per_irradiance, is_radiance) = of?;
            let adaptation = adaptation?;
            let curve = mesopic::curve(adaptation).map_err(|error| noted(value, &error, reading)).ok()?;
            let efficacy_lm_w = mesopic::max_efficacy_lm_w(adaptation).map_err(|error| noted(value, &error, reading)).ok()?;
            Some(vec![luminous(curve, efficacy_lm_w * per_irradiance, "mesopic", "mes", is_radiance)])
        }
        _ => match Efficiency::named(name) {
            Ok(efficiency) if Matching::named(name).is_err() => {
                let (per_irradiance, is_radiance) = of?;
                let by = format!("{}-weighted", efficiency.symbol());
                let index = efficiency.symbol().trim_end_matches("(λ)").replacen('V', "v", 1);
                Some(vec![luminous(efficiency.curve(), efficiency.max_efficacy_lm_w() * per_irradiance, &by, &index, is_radiance)])
            }
            _ => read_tristimulus(&name_value, name, of, reading),
        },
    }
}

fn read_tristimulus(value: &Value, name: &str, of: Option<(f64, bool)>, reading: &mut Reading) -> Option<Vec<Channel>> {
    let Ok(set) = Matching::named(name) else {
        value.problem(&mut reading.problems, format!("there is no observer called \"{name}\""), suggestion(name, &NAMES));
        return None;
    };
    let Some(efficiency) = set.efficiency() else {
        value.problem(
            &mut reading.problems,
            format!("the functions of \"{name}\" are negative at some wavelengths, which no sensor is"),
            "write \"CIE 1931\" or \"CIE 1964\" and turn X, Y, Z into R, G, B by the matrix of the primaries",
        );
        return None;
    };
    let (per_irradiance, is_radiance) = of?;
    let unit = if is_radiance { "cd/m²" } else { "lx" };
    let scale = efficiency.max_efficacy_lm_w() * per_irradiance;
    let words = |symbol: &str| weighted(&format!("tristimulus value {symbol}, {}", set.short_title()), symbol, unit);
    let functions = set.values().into_iter().zip(set.functions());
    Some(functions.map(|(symbol, curve)| channel(symbol, curve, words(symbol), scale)).collect())
}

/// A channel of a luminous quantity by another luminous efficiency than V(λ).
fn luminous(curve: Factor, scale: f64, adjective: &str, index: &str, is_radiance: bool) -> Channel {
    let reads = if is_radiance {
        weighted(&format!("{adjective} luminance"), &format!("L_{index}"), "cd/m²")
    } else {
        weighted(&format!("{adjective} illuminance"), &format!("E_{index}"), "lx")
    };
    channel(if is_radiance { "L_v" } else { "E_v" }, curve, reads, scale)
}

fn read_adaptation(value: &Value, fields: Option<&Fields>, reading: &mut Reading) -> Option<f64> {
    let Some(fields) = fields else {
        let help = format!("write `Observer(name: \"{MESOPIC}\", adaptation: 0.5)`");
        value.problem(&mut reading.problems, format!("\"{MESOPIC}\" needs a coefficient of adaptation"), help);
        return None;
    };
    fields.require("adaptation", "0.5", &mut reading.problems).and_then(|v| {
        v.number_in(
            "the coefficient of adaptation",
            "0 (rods alone) to 1 (cones alone)",
            |m| (0.0..=1.0).contains(&m),
            &mut reading.problems,
        )
    })
}

fn read_individual(value: &Value, fields: Option<&Fields>, reading: &mut Reading) -> Option<Individual> {
    let Some(fields) = fields else {
        value.problem(
            &mut reading.problems,
            format!("\"{INDIVIDUAL}\" needs an age and a field"),
            format!("write `Observer(name: \"{INDIVIDUAL}\", age_yr: 32, field_deg: 2)`"),
        );
        return None;
    };
    let mut number = |key: &str, example: &str, what: &str, (least, most): (f64, f64), unit: &str| {
        fields.require(key, example, &mut reading.problems).and_then(|v| {
            let allowed = format!("{least}{unit} to {most}{unit}");
            v.number_in(what, &allowed, |x| (least..=most).contains(&x), &mut reading.problems)
        })
    };
    let age_yr = number("age_yr", "32", "the age", Individual::AGES_YR, " years");
    let field_deg = number("field_deg", "2", "the field", Individual::FIELDS_DEG, "°");
    Some(Individual { age_yr: age_yr?, field_deg: field_deg? })
}

fn noted(value: &Value, error: &ObserverError, reading: &mut Reading) {
    value.problem(&mut reading.problems, error.to_string(), "");
}

/// A weighted irradiance or radiance.
fn quantity(adjective: &str, index: &str, is_radiance: bool) -> Measurand {
    if is_radiance {
        weighted(&format!("{adjective} radiance"), &format!("L_{index}"), "W/(m² sr)")
    } else {
        weighted(&format!("{adjective} irradiance"), &format!("E_{index}"), "W/m²")
    }
}

fn channel(name: &str, responsivity: Factor, reads: Measurand, scale: f64) -> Channel {
    let ideal = Weighting { curve: responsivity.clone(), scale };
    Channel::new(name, responsivity, reads, scale).with_ideal(ideal)
}
