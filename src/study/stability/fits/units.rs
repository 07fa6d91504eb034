//! Units of the readings and of the light: a curve has the unit of one over the other, and nothing else changes.

use super::super::{Point, Sweep, decades};
use super::design::{lux_meter, made, nodes, of, readings, sources};
use super::{Expected, FitProblem};
use crate::calibration::{Exposures, PriorKind, Readings};
use crate::spectrum::SpectrumError;

pub(in super::super) const SWEEP: Sweep =
    Sweep { name: "fit-units", parameter: "unit of readings or light", unit: "1", law: "the same curve in that unit", points };

fn points() -> Vec<Point> {
    made(all())
}

fn all() -> Result<Vec<Point>, SpectrumError> {
    let nodes = nodes(10.0);
    let truth = lux_meter(&nodes);
    let exposures = sources(&nodes, 41, 20.0)?;
    let base = readings(&exposures, &truth, 1e-3, 1);
    let problem = |exposures: Exposures, readings: Readings, expected: Expected| FitProblem {
        exposures,
        sets: vec![vec![readings]],
        prior: PriorKind::Smooth,
        expected,
    };
    let in_units = |unit: f64| Readings {
        values: base.values.iter().map(|y| y * unit).collect(),
        standard_uncertainties: base.standard_uncertainties.iter().map(|u| u * unit).collect(),
        ..base.clone()
    };
    let brighter = |unit: f64| {
        let rows: Vec<Vec<f64>> = (0..exposures.len()).map(|i| exposures.row(i).iter().map(|a| a * unit).collect()).collect();
        let rows: Vec<&[f64]> = rows.iter().map(Vec::as_slice).collect();
        Exposures::from_weights(&nodes, exposures.labels().to_vec(), &rows)
    };
    let law = |factor: f64| {
        let base = problem(exposures.clone(), base.clone(), Expected::Curves(vec![truth.clone()]));
        Expected::Law { base: Box::new(base), factor }
    };
    let mut points = Vec::new();
    for unit in decades(-30, 30, 10) {
        points.push(of("readings", unit, problem(exposures.clone(), in_units(unit), law(unit))));
    }
    for unit in decades(-30, 30, 10) {
        points.push(of("light", unit, problem(brighter(unit), base.clone(), law(1.0 / unit))));
    }
    for unit in decades(-30, 30, 10) {
        points.push(of("both", unit, problem(brighter(unit), in_units(unit), law(1.0))));
    }
    Ok(points)
}
