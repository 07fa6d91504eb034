//! How many exposures there are, and how often each is taken.

use super::super::{Point, Sweep};
use super::design::{lux_meter, made, nodes, point, readings, sources};
use crate::calibration::Exposures;
use crate::spectrum::SpectrumError;

pub(in super::super) const EXPOSURES: Sweep = Sweep {
    name: "fit-exposures",
    parameter: "number of exposures",
    unit: "1",
    law: "the true curve, within bands of 99 % at 95 % of the nodes",
    points: exposures,
};

pub(in super::super) const DUPLICATES: Sweep = Sweep {
    name: "fit-duplicates",
    parameter: "times that each exposure is taken",
    unit: "1",
    law: "the true curve, within bands of 99 % at 95 % of the nodes",
    points: duplicates,
};

/// Sets of readings of a point; of many exposures one set.
fn seeds(count: usize) -> std::ops::RangeInclusive<u64> {
    1..=if count > 100 { 2 } else { 6 }
}

fn exposures() -> Vec<Point> {
    let nodes = nodes(4.0);
    let one = |(name, fwhm_nm, noise): (&'static str, f64, f64), count: usize| {
        let exposures = sources(&nodes, count, fwhm_nm)?;
        let truth = lux_meter(&nodes);
        let sets = seeds(count).map(|seed| vec![readings(&exposures, &truth, noise, seed)]).collect();
        Ok(point(name, count as f64, exposures, sets, truth))
    };
    let counts = [3, 4, 6, 10, 20, 40, 80, 160, 400];
    let series = [("10 nm wide, 1 %", 10.0, 1e-2), ("30 nm wide, 0.1 %", 30.0, 1e-3)];
    made(series.into_iter().flat_map(|s| counts.into_iter().map(move |count| (s, count))).map(|(s, count)| one(s, count)).collect())
}

/// Each exposure so many times.
fn repeated(exposures: &Exposures, times: usize) -> Exposures {
    exposures.subset(&(0..exposures.len()).flat_map(|i| std::iter::repeat_n(i, times)).collect::<Vec<_>>())
}

fn duplicates() -> Vec<Point> {
    let nodes = nodes(10.0);
    let one = |(name, noise): (&'static str, f64), times: usize| -> Result<Point, SpectrumError> {
        let exposures = repeated(&sources(&nodes, 21, 25.0)?, times);
        let truth = lux_meter(&nodes);
        let sets = seeds(exposures.len()).map(|seed| vec![readings(&exposures, &truth, noise, seed)]).collect();
        Ok(point(name, times as f64, exposures, sets, truth))
    };
    let series = [("no noise", 0.0), ("noise 1 %", 1e-2)];
    made(
        series
            .into_iter()
            .flat_map(|s| [1, 2, 4, 8, 16].into_iter().map(move |times| (s, times)))
            .map(|(s, times)| one(s, times))
            .collect(),
    )
}
