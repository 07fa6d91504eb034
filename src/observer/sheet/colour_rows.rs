//! Rows of the sheet on colour: tristimulus values and chromaticities of four observers; colour temperature, dominant wavelength, sRGB.

use super::functional::{Functional, OBSERVERS};
use super::totals::row;
use super::{Definition, Digits, Group, Integrals, SheetRow, SheetValue};
use crate::observer::Matching;
use crate::observer::colour::{
    Chromaticity, CorrelatedTemperature, DominantWavelength, Gamut, Hue, LARGEST_DUV, NoTemperature, PlanckianLocus, SpectralLocus, Srgb,
    Tristimulus, correlated_temperature,
};
use std::rc::Rc;

const DARK: &str = "nothing of the spectrum is visible";

/// Heading and identifier of an observer.
fn heading(observer: Matching) -> (&'static str, &'static str) {
    match observer {
        Matching::Cie1931 => ("1931 2°", "1931"),
        Matching::Cie1964 => ("1964 10°", "1964"),
        Matching::Cie2015TwoDegree => ("2015 2°", "2015_2_degree"),
        _ => ("2015 10°", "2015_10_degree"),
    }
}

fn tristimulus(get: &Integrals<'_>, observer: Matching) -> Tristimulus {
    Tristimulus::from([0, 1, 2].map(|i| get(Functional::Matching(observer, i))))
}

fn chromaticity(get: &Integrals<'_>, observer: Matching) -> Option<Chromaticity> {
    tristimulus(get, observer).chromaticity()
}

/// All rows, in the order of the page: a line of the table after the other, then the list.
pub(super) fn definitions(white: Chromaticity, white_name: &str) -> Vec<Definition> {
    let lines: [(&str, &str, usize); 3] = [("tristimulus_x", "X", 0), ("tristimulus_y", "Y", 1), ("tristimulus_z", "Z", 2)];
    let mut all = Vec::new();
    for (id, name, i) in lines {
        all.extend(OBSERVERS.map(|observer| {
            let cell = SheetRow { digits: Digits::Decimals(3), ..cell(id, name, observer) };
            let compute = move |get: &Integrals<'_>| {
                let values = tristimulus(get, observer).to_array();
                // Y over itself is 1, also where a difference is taken.
                if values[1] > 0.0 { SheetValue::Number(100.0 * (values[i] / values[1])) } else { SheetValue::Undefined(DARK.into()) }
            };
            Definition { row: cell, compute: Box::new(compute) }
        }));
    }
    type Coordinate = fn(Chromaticity) -> f64;
    let coordinates: [(&str, &str, Coordinate); 4] = [
        ("chromaticity_x", "x", |p| p.x),
        ("chromaticity_y", "y", |p| p.y),
        ("chromaticity_u_prime", "u′", |p| p.uv_prime().0),
        ("chromaticity_v_prime", "v′", |p| p.uv_prime().1),
    ];
    for (id, name, coordinate) in coordinates {
        all.extend(OBSERVERS.map(|observer| {
            let compute = move |get: &Integrals<'_>| match chromaticity(get, observer) {
                Some(p) => SheetValue::Number(coordinate(p)),
                None => SheetValue::Undefined(DARK.into()),
            };
            Definition { row: SheetRow { digits: Digits::Decimals(5), ..cell(id, name, observer) }, compute: Box::new(compute) }
        }));
    }
    all.extend(temperature());
    all.extend(dominant(white, white_name));
    all.push(Definition {
        row: row("srgb", Group::Colour, "sRGB, largest component 1, desaturated into the gamut", "", ""),
        compute: Box::new(|get| match Srgb::brightest(&tristimulus(get, Matching::Cie1931), Gamut::Desaturate) {
            Some(colour) => SheetValue::Text(format!("{}{}", colour.hex(), if colour.outside_gamut { " (outside the gamut)" } else { "" })),
            None => SheetValue::Undefined(DARK.into()),
        }),
    });
    all
}

fn cell(id: &str, name: &str, observer: Matching) -> SheetRow {
    let (column, suffix) = heading(observer);
    SheetRow { column: column.into(), ..row(&format!("{id}_{suffix}"), Group::Tristimulus, name, name, "1") }
}

fn temperature() -> Vec<Definition> {
    let locus = Rc::new(PlanckianLocus::new(&Matching::Cie1931.functions()));
    let of = |take: fn(Result<CorrelatedTemperature, NoTemperature>) -> SheetValue| {
        let locus = Rc::clone(&locus);
        move |get: &Integrals<'_>| match chromaticity(get, Matching::Cie1931) {
            None => SheetValue::Undefined(DARK.into()),
            Some(p) => take(correlated_temperature(p, &locus)),
        }
    };
    let cct_k = |found: Result<CorrelatedTemperature, NoTemperature>| match found {
        Ok(found) => SheetValue::Number(found.cct_k),
        Err(why) => SheetValue::Undefined(why.to_string()),
    };
    // The distance keeps its meaning where the temperature has lost it.
    let distance = |found: Result<CorrelatedTemperature, NoTemperature>| match found {
        Ok(CorrelatedTemperature { duv, .. }) | Err(NoTemperature::TooFar { duv }) => SheetValue::Number(duv),
        Err(why) => SheetValue::Undefined(why.to_string()),
    };
    let duv = SheetRow {
        digits: Digits::Decimals(5),
        ..row("duv", Group::Colour, "distance from the Planckian locus, CIE 1960 u, v", "Duv", "1")
    };
    let cct = row("cct", Group::Colour, &format!("correlated colour temperature (|Duv| ≤ {LARGEST_DUV})"), "T_cp", "K");
    vec![Definition { row: cct, compute: Box::new(of(cct_k)) }, Definition { row: duv, compute: Box::new(of(distance)) }]
}

fn dominant(white: Chromaticity, white_name: &str) -> Vec<Definition> {
    let locus = Rc::new(SpectralLocus::new(&Matching::Cie1931.functions()));
    let of = |take: fn(DominantWavelength) -> SheetValue| {
        let locus = Rc::clone(&locus);
        move |get: &Integrals<'_>| {
            let Some(p) = chromaticity(get, Matching::Cie1931) else { return SheetValue::Undefined(DARK.into()) };
            locus.dominant_wavelength(p, white).map_or_else(|| SheetValue::Undefined("the light is the white itself".into()), take)
        }
    };
    let against = |name: &str| format!("{name}, against white {white_name}");
    let purity = |id: &str, name: &str, symbol: &str| SheetRow {
        digits: Digits::Decimals(2),
        ..row(id, Group::Colour, &against(name), symbol, "%")
    };
    vec![
        Definition {
            row: row("dominant_wavelength", Group::Colour, &against("dominant wavelength"), "λ_d", "nm"),
            compute: Box::new(of(|found| match found.hue {
                Hue::Spectral(nm) => SheetValue::Number(nm),
                Hue::Purple(_) => SheetValue::Undefined("a purple; see the complementary wavelength".into()),
            })),
        },
        Definition {
            row: row("complementary_wavelength", Group::Colour, &against("complementary wavelength"), "λ_c", "nm"),
            compute: Box::new(of(|found| match found.hue {
                Hue::Purple(nm) => SheetValue::Number(nm),
                Hue::Spectral(_) => SheetValue::Undefined("stated for purples only".into()),
            })),
        },
        Definition {
            row: purity("excitation_purity", "excitation purity", "p_e"),
            compute: Box::new(of(|found| SheetValue::Number(100.0 * found.excitation_purity))),
        },
        Definition {
            row: purity("colorimetric_purity", "colorimetric purity", "p_c"),
            compute: Box::new(of(|found| SheetValue::Number(100.0 * found.colorimetric_purity))),
        },
    ]
}
