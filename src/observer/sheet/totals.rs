//! Rows of the sheet but for colour: where the spectrum lies, radiant, photon, luminous, α-opic totals, cone excitations.

use super::functional::{Field, Functional, VISIBLE_NM};
use super::{Definition, Digits, Group, Integrals, Scaling, SheetOptions, SheetRow, SheetValue};
use crate::observer::mesopic::{self, EFFICACY_RATIO, V_PRIME_AT_555_NM};
use crate::observer::{AlphaOpic, Cone, Efficiency, ObserverError};
use crate::quantity::constants::K_M_LM_W;
use crate::spectrum::Density;

/// A row of a list with five significant digits.
pub(super) fn row(id: &str, group: Group, name: &str, symbol: &str, unit: &str) -> SheetRow {
    SheetRow {
        id: id.into(),
        group,
        name: name.into(),
        column: String::new(),
        symbol: symbol.into(),
        value: SheetValue::Undefined(String::new()),
        unit: unit.into(),
        standard_uncertainty: None,
        digits: Digits::Significant(5),
    }
}

/// A definition whose value is a number.
pub(super) fn number(row: SheetRow, compute: impl Fn(&Integrals<'_>) -> f64 + 'static) -> Definition {
    Definition { row, compute: Box::new(move |get| SheetValue::Number(compute(get))) }
}

/// A quotient of two integrals; not defined where the lower one is zero.
fn quotient(get: &Integrals<'_>, over: Functional, under: Functional, why: &str) -> Result<f64, SheetValue> {
    let divisor = get(under);
    if divisor == 0.0 { Err(SheetValue::Undefined(why.into())) } else { Ok(get(over) / divisor) }
}

/// The value of a computation that may have none.
fn value(result: Result<f64, SheetValue>) -> SheetValue {
    result.map_or_else(|undefined| undefined, SheetValue::Number)
}

const DARK: &str = "nothing of the spectrum is visible";

pub(super) fn definitions(density: &Density, scaling: &Scaling, options: &SheetOptions) -> Result<Vec<Definition>, ObserverError> {
    let mut all = shape(density);
    all.extend(radiant(scaling));
    all.extend(photon(scaling));
    all.extend(luminous(scaling, options.adaptation_cd_m2)?);
    all.extend(AlphaOpic::ALL.into_iter().flat_map(|receptor| alpha_opic(receptor, scaling)));
    all.extend(cones(scaling));
    Ok(all)
}

/// Peak, half width, centroid.
fn shape(density: &Density) -> Vec<Definition> {
    let peak = density.peak();
    let of_peak = |id: &str, name: &str, symbol: &str, value: Option<f64>, why: &'static str| {
        let value = value.map_or(SheetValue::Undefined(why.into()), SheetValue::Number);
        Definition { row: row(id, Group::Shape, name, symbol, "nm"), compute: Box::new(move |_| value.clone()) }
    };
    let no_width = "the spectrum is cut off above half of its peak, has several parts above half, or has lines";
    vec![
        of_peak("peak_wavelength", "peak wavelength", "λ_p", peak.map(|peak| peak.wavelength_nm), "no peak"),
        of_peak("half_width", "full width at half maximum", "Δλ_0.5", peak.and_then(|peak| peak.fwhm_nm), no_width),
        number(row("centroid_wavelength", Group::Shape, "centroid wavelength", "λ_m", "nm"), |get| {
            get(Functional::FirstMoment) / get(Functional::Radiant)
        }),
    ]
}

fn radiant(scaling: &Scaling) -> Vec<Definition> {
    let (name, unit) = scaling.quantity.radiant();
    let (low, high) = VISIBLE_NM;
    let symbol = format!("{}_e", scaling.quantity.letter());
    let scale = scaling.clone();
    let total = number(row("radiant", Group::Radiant, name, &symbol, unit), move |get| scale.apply(get(Functional::Radiant), get));
    let share = |id: &str, name: String, part: Functional| {
        let row = SheetRow { digits: Digits::Decimals(3), ..row(id, Group::Radiant, &name, "", "%") };
        number(row, move |get| 100.0 * (get(part) / get(Functional::Radiant)))
    };
    vec![
        total,
        share("ultraviolet_share", format!("share below {low} nm"), Functional::Ultraviolet),
        share("visible_share", format!("share {low}–{high} nm"), Functional::Visible),
        share("infrared_share", format!("share above {high} nm"), Functional::Infrared),
    ]
}

fn photon(scaling: &Scaling) -> Vec<Definition> {
    let quantity = scaling.quantity;
    let (name, unit) = quantity.photon();
    let symbol = format!("{}_p", quantity.letter());
    let total = |functional: Functional| {
        let scale = scaling.clone();
        move |get: &Integrals<'_>| 1e6 * scale.apply(get(functional), get)
    };
    let per_joule = |get: &Integrals<'_>| 1e6 * (get(Functional::Photosynthetic) / get(Functional::Radiant));
    vec![
        number(row("photon", Group::Photon, name, &symbol, unit), total(Functional::Photon)),
        number(
            row(
                "photosynthetic_photon",
                Group::Photon,
                &format!("{}, 400–700 nm", quantity.photosynthetic()),
                &format!("{symbol},PAR"),
                unit,
            ),
            total(Functional::Photosynthetic),
        ),
        number(row("photosynthetic_photon_per_joule", Group::Photon, "photons 400–700 nm per radiant energy", "", "µmol/J"), per_joule),
        number(row("mean_photon_energy", Group::Photon, "mean photon energy", "", "eV"), |get| {
            // J/mol over C/mol, the Faraday constant, is J/C.
            let faraday_c_mol = crate::quantity::constants::AVOGADRO_PER_MOL * crate::quantity::constants::ELEMENTARY_CHARGE_C;
            get(Functional::Radiant) / get(Functional::Photon) / faraday_c_mol
        }),
    ]
}

fn luminous(scaling: &Scaling, adaptation_cd_m2: f64) -> Result<Vec<Definition>, ObserverError> {
    // Bad values are refused before anything is computed.
    mesopic::mesopic(adaptation_cd_m2, 1.0)?;
    let (name, unit) = scaling.quantity.luminous();
    let letter = scaling.quantity.letter();
    let efficacy = |efficiency: Efficiency| {
        let scale = scaling.clone();
        move |get: &Integrals<'_>| scale.apply(get(Functional::Luminous(efficiency)), get) * efficiency.max_efficacy_lm_w()
    };
    let total = |id: &str, name: &str, symbol: &str, efficiency: Efficiency| {
        number(row(id, Group::Luminous, name, &format!("{letter}_{symbol}"), unit), efficacy(efficiency))
    };
    let sp_ratio = |get: &Integrals<'_>, efficacy_ratio: f64| {
        quotient(get, Functional::SCOTOPIC, Functional::PHOTOPIC, DARK).map(|quotient| quotient * efficacy_ratio)
    };
    let adapted = move |get: &Integrals<'_>| {
        let state = mesopic::mesopic(adaptation_cd_m2, sp_ratio(get, EFFICACY_RATIO)?);
        state.map_err(|error| SheetValue::Undefined(error.to_string()))
    };
    let scale = scaling.clone();
    let k_prime_over_k = Efficiency::Scotopic1951.max_efficacy_lm_w() / Efficiency::Photopic1924.max_efficacy_lm_w();
    let mesopic_name = format!("mesopic {name}, adapted to {adaptation_cd_m2} cd/m²");
    Ok(vec![
        total("luminous", name, "v", Efficiency::Photopic1924),
        number(row("luminous_efficacy", Group::Luminous, "luminous efficacy of radiation", "K", "lm/W"), |get| {
            K_M_LM_W * (get(Functional::PHOTOPIC) / get(Functional::Radiant))
        }),
        total("luminous_2015_2_degree", &format!("{name} by V_F(λ), 2°"), "v,F", Efficiency::Physiological2),
        total("luminous_2015_10_degree", &format!("{name} by V_F(λ), 10°"), "v,F,10", Efficiency::Physiological10),
        total("scotopic", &format!("scotopic {name}"), "v′", Efficiency::Scotopic1951),
        Definition {
            row: row("sp_ratio", Group::Luminous, "scotopic over photopic", "S/P", "1"),
            compute: Box::new(move |get| value(sp_ratio(get, k_prime_over_k))),
        },
        Definition {
            row: row("mesopic", Group::Luminous, &mesopic_name, &format!("{letter}_mes"), unit),
            compute: Box::new(move |get| match adapted(get) {
                Err(undefined) => undefined,
                Ok(state) => {
                    let rods = (1.0 - state.adaptation) * V_PRIME_AT_555_NM;
                    let weighted = state.adaptation * get(Functional::PHOTOPIC) + (1.0 - state.adaptation) * get(Functional::SCOTOPIC);
                    SheetValue::Number(scale.apply(weighted, get) * K_M_LM_W / (state.adaptation + rods))
                }
            }),
        },
        Definition {
            row: row("mesopic_adaptation", Group::Luminous, "coefficient of adaptation (MES2)", "m", "1"),
            compute: Box::new(move |get| value(adapted(get).map(|state| state.adaptation))),
        },
    ])
}

fn alpha_opic(receptor: AlphaOpic, scaling: &Scaling) -> Vec<Definition> {
    let index = receptor.index();
    let (_, unit) = scaling.quantity.radiant();
    let letter = scaling.quantity.letter();
    let elr_of_d65 = receptor.elr_of_d65();
    let cell = |id: &str, column: &str, symbol: String, unit: &str| SheetRow {
        column: column.into(),
        ..row(&format!("{index}_{id}"), Group::AlphaOpic, receptor.name(), &symbol, unit)
    };
    let functional = Functional::AlphaOpic(receptor);
    let (scale, daylight_scale) = (scaling.clone(), scaling.clone());
    let per_lumen = move |get: &Integrals<'_>, unit: f64| {
        value(quotient(get, functional, Functional::PHOTOPIC, DARK).map(|quotient| unit * quotient / K_M_LM_W))
    };
    let mut rows = vec![number(cell("radiant", scaling.quantity.radiant().0, format!("{letter}_e,{index}"), unit), move |get| {
        scale.apply(get(functional), get)
    })];
    if let Some((name, symbol, unit)) = scaling.quantity.equivalent_daylight() {
        let row = cell("equivalent_daylight", name, symbol.replace('α', index), unit);
        rows.push(number(row, move |get| daylight_scale.apply(get(functional), get) / elr_of_d65));
    }
    rows.push(Definition {
        row: cell("luminous_efficacy", "ELR", format!("K_{index},v"), "mW/lm"),
        compute: Box::new(move |get| per_lumen(get, 1e3)),
    });
    rows.push(Definition {
        row: cell("daylight_ratio", "DER", format!("γ_{index},v^D65"), "1"),
        compute: Box::new(move |get| per_lumen(get, 1.0 / elr_of_d65)),
    });
    rows
}

fn cones(scaling: &Scaling) -> Vec<Definition> {
    let (_, unit) = scaling.quantity.radiant();
    let columns = [(Field::TwoDegrees, "2_degree", "2°"), (Field::TenDegrees, "10_degree", "10°")];
    let cells = Cone::ALL.into_iter().flat_map(|cone| {
        columns.map(|(field, id, column)| {
            let scale = scaling.clone();
            let id = format!("{}_cone_{id}", cone.name().to_lowercase());
            let row = SheetRow { column: column.into(), ..row(&id, Group::Cones, &format!("{} cone", cone.name()), cone.name(), unit) };
            number(row, move |get| scale.apply(get(Functional::Cone(field, cone)), get))
        })
    });
    cells.collect()
}
