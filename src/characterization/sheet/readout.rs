//! Indices of the readout, by both routes.
//!
//! | index | computed | measured |
//! |---|---|---|
//! | f3 | the equation of the electronics; 0 without any | one lamp over decades of strength |
//! | f11 | one range after the other in the same equation | one lamp before the same sensor with one range and the next |
//!
//! Without electronics the indication is proportional to the light. With them light is given from [`WEAKEST`] units of the indication up to
//! where they saturate; reference is the strongest. The range is changed at [`FULL`] of the more sensitive one.

use super::{Absent, Index, SheetError};
use crate::characterization::bench::Bench;
use crate::characterization::{Figure, linearity};
use crate::sensor::{Photodiode, Sensor};
use crate::spectrum::Density;

/// Weakest light, in units of the indication.
const WEAKEST: f64 = 1.0;
/// Decades of light.
const DECADES: i32 = 7;
/// Share of the largest current of a range at which the next one takes over.
const FULL: f64 = 0.9;
const PERCENT: f64 = 100.0;

/// f3, and f11 where there are ranges. The bench holds the sensor without its readout, `full` has it.
pub(super) fn characterise(
    bench: &Bench<'_>,
    full: &Sensor,
    index: usize,
    spectrum: &Density,
) -> Result<(Vec<Index>, Vec<Absent>), SheetError> {
    let own = bench.along_normal(index, spectrum)?;
    let per_unit_a = full.photocurrent_per_unit_a(&full.channels[index]);
    let electronics = full.readout.as_ref().zip(per_unit_a);
    let lights: Vec<f64> = (0..=DECADES)
        .map(|k| WEAKEST * 10f64.powi(k))
        .filter(|x| electronics.is_none_or(|(diode, a)| diode.readout(x * a).saturation.is_none()))
        .collect();
    let Some(reference) = lights.last().copied().filter(|_| own.value > 0.0) else {
        let why = format!("the readout saturates below {WEAKEST} of the indication");
        return Ok((Vec::new(), vec![Absent { symbol: "f3", why }]));
    };
    let indicated = |x: f64| electronics.map_or(x, |(diode, a)| diode.readout(x * a).indicated_a / a);
    let computed = linearity::f3(&indicated, &lights, reference).unwrap_or(f64::INFINITY);
    let other = bench.with(full.clone());
    let strengths: Vec<f64> = lights.iter().map(|x| x / own.value).collect();
    let read = other.attenuated(index, spectrum, &strengths)?;
    bench.count(&other);
    let words = match electronics {
        None => format!("no readout; a lamp over {DECADES} decades of strength"),
        Some(_) => format!("readings of {WEAKEST} to {reference:e}, against the strongest"),
    };
    let f3 = index_of("f3", "linearity", Figure::exact(computed, 1.0), most_apart(&lights, &read), words);
    let Some((diode, a)) = electronics.filter(|(diode, _)| diode.ranges.len() > 1 && diode.limit_v().is_finite()) else {
        let why = "the sensor has no readout with ranges that end".to_owned();
        return Ok((vec![f3], vec![Absent { symbol: "f11", why }]));
    };
    let mut worst = (Figure::exact(0.0, 1.0), Figure::exact(0.0, 1.0));
    let mut ranges = diode.ranges.clone();
    ranges.sort_by(|one, other| other.feedback_ohm.total_cmp(&one.feedback_ohm));
    for pair in ranges.windows(2) {
        let [low, high] = [pair[0], pair[1]].map(|range| Photodiode { ranges: vec![range], ..diode.clone() });
        let light = FULL * diode.limit_v() / pair[0].feedback_ohm / a;
        let of = |one: &Photodiode, x: f64| one.readout(x * a).indicated_a / a;
        let Ok(computed) = linearity::f11(&|x| of(&low, x), &|x| of(&high, x), light) else { continue };
        let spectrum = spectrum.scaled(light / own.value)?;
        let mut read = Vec::with_capacity(2);
        for one in [low.clone(), high.clone()] {
            let other = bench.with(Sensor { readout: Some(one), ..full.clone() });
            read.push(other.along_normal(index, &spectrum)?);
            bench.count(&other);
        }
        let (before, after) = (read[0], read[1]);
        let value = (after.value / before.value - 1.0).abs();
        let u = before.standard_uncertainty.hypot(after.standard_uncertainty) / before.value;
        if computed >= worst.0.value {
            worst = (Figure::exact(computed, 1.0), Figure { value, standard_uncertainty: u });
        }
    }
    let words = format!("at {FULL} of the more sensitive of two ranges, the worst pair");
    Ok((vec![f3, index_of("f11", "range change", worst.0, worst.1, words)], Vec::new()))
}

/// The largest deviation from proportionality to the last light, with the uncertainty that it has there.
fn most_apart(lights: &[f64], read: &[Figure]) -> Figure {
    let (Some(top), Some(at)) = (read.last(), lights.last()) else { return Figure::exact(0.0, 1.0) };
    let mut most = Figure { value: 0.0, standard_uncertainty: 0.0 };
    for (x, figure) in lights.iter().zip(read) {
        let (relative, share) = (figure.value / top.value, x / at);
        let value = (relative / share - 1.0).abs();
        let of = |f: &Figure| f.standard_uncertainty / top.value;
        let u = (of(figure) / share).hypot(of(top) * relative / share);
        if value >= most.value || most.standard_uncertainty == 0.0 {
            most = Figure { value, standard_uncertainty: u };
        }
    }
    most
}

fn index_of(symbol: &'static str, name: &'static str, computed: Figure, measured: Figure, conditions: String) -> Index {
    let (computed, measured) = (computed.scaled(PERCENT), measured.scaled(PERCENT));
    Index { symbol, name, unit: "%", computed, measured, stated_u: 0.0, limits: None, conditions }
}
