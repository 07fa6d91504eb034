//! What goes wrong at a bench: channels that see nothing, readings that are lost and stand as zero, readings that contradict each other.

use super::super::{Point, Sweep};
use super::design::{lux_meter, made, nodes, of, point, readings, sets, sources, two_bands};
use super::{Expected, FitProblem};
use crate::calibration::{Exposures, PriorKind, Readings};
use crate::spectrum::SpectrumError;

pub(in super::super) const ZEROS: Sweep = Sweep {
    name: "fit-zeros",
    parameter: "share of readings that are zero",
    unit: "1",
    law: "a curve that is zero there, or words",
    points: zeros,
};

pub(in super::super) const CONTRADICTIONS: Sweep = Sweep {
    name: "fit-contradictions",
    parameter: "what two readings of one exposure differ by, over the largest reading",
    unit: "1",
    law: "the true curve within its bands, or words",
    points: contradictions,
};

/// Noise of the readings, where there is any.
const NOISE: f64 = 1e-3;

fn bench() -> Result<(Vec<f64>, Exposures), SpectrumError> {
    let nodes = nodes(10.0);
    let exposures = sources(&nodes, 41, 20.0)?;
    Ok((nodes, exposures))
}

fn zeros() -> Vec<Point> {
    made(all_zeros())
}

fn all_zeros() -> Result<Vec<Point>, SpectrumError> {
    let (nodes, exposures) = bench()?;
    let mut points = Vec::new();
    // A true curve that ends: beyond it readings are zero, and rightly so.
    for share in [0.1, 0.3, 0.5, 0.7, 0.9] {
        let end_nm = 780.0 - 400.0 * share;
        let truth: Vec<f64> = nodes.iter().map(|&nm| ((end_nm - nm) / 40.0).clamp(0.0, 1.0)).collect();
        points.push(point("beyond the curve", share, exposures.clone(), sets(&exposures, &truth, NOISE, 6), truth));
    }
    // Readings that were lost, and stand as zero with the noise of the others.
    let truth = lux_meter(&nodes);
    for share in [0.03, 0.1, 0.3, 0.6, 1.0] {
        let lost = |mut set: Vec<Readings>| {
            let values = &mut set[0].values;
            let count = values.len() as f64;
            // From the middle outwards: there the true ones are far from zero.
            values
                .iter_mut()
                .enumerate()
                .filter(|(i, _)| (*i as f64 - 0.45 * count).abs() <= 0.5 * (share * count).max(1.0))
                .for_each(|(_, y)| *y = 0.0);
            if share == 1.0 {
                values.fill(0.0);
            }
            set
        };
        let sets = sets(&exposures, &truth, NOISE, 3).into_iter().map(lost).collect();
        points.push(of("lost readings", share, problem(&exposures, sets, Expected::Words(vec![truth.clone()]))));
    }
    // One channel of three sees nothing.
    let curves = [lux_meter(&nodes), two_bands(&nodes), vec![0.0; nodes.len()]];
    for (series, channel_noise) in [("a dead channel", 0.0), ("a dead channel, noisy", 1.0)] {
        let set = |seed: u64| {
            let channel = |(c, truth): (usize, &Vec<f64>)| Readings {
                channel: ["R", "G", "B"][c].to_owned(),
                ..readings(&exposures, truth, NOISE, 10 * seed + c as u64)
            };
            let mut set: Vec<Readings> = curves.iter().enumerate().map(channel).collect();
            let u = set[0].standard_uncertainties.clone();
            set[2] = Readings {
                values: set[0].values.iter().zip(exposures.expected(&curves[0])).map(|(y, exact)| channel_noise * (y - exact)).collect(),
                standard_uncertainties: u,
                ..set[2].clone()
            };
            set
        };
        points.push(of(series, 1.0 / 3.0, problem(&exposures, (1..=3).map(set).collect(), Expected::Words(curves.to_vec()))));
    }
    Ok(points)
}

fn problem(exposures: &Exposures, sets: Vec<Vec<Readings>>, expected: Expected) -> FitProblem {
    FitProblem { exposures: exposures.clone(), sets, prior: PriorKind::Smooth, expected }
}

fn contradictions() -> Vec<Point> {
    made(all_contradictions())
}

/// Which of the readings are changed.
type Which = fn(usize) -> bool;

fn all_contradictions() -> Result<Vec<Point>, SpectrumError> {
    let (nodes, once) = bench()?;
    let truth = lux_meter(&nodes);
    let exposures = once.subset(&(0..once.len()).flat_map(|i| [i, i]).collect::<Vec<_>>());
    let largest = exposures.expected(&truth).iter().fold(0.0f64, |most, y| most.max(*y));
    let mut points = Vec::new();
    let series: [(&'static str, f64, Which); 3] = [
        ("one exposure of 41, noise 0.1 %", NOISE, |i| i == 37),
        ("every exposure, noise 0.1 %", NOISE, |i| i % 2 == 1),
        ("every exposure, no noise", 0.0, |i| i % 2 == 1),
    ];
    for (name, noise, which) in series {
        for apart in [1e-4, 1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.5] {
            let torn = |mut set: Vec<Readings>| {
                set[0].values.iter_mut().enumerate().filter(|(i, _)| which(*i)).for_each(|(_, y)| *y += apart * largest);
                set
            };
            let sets = sets(&exposures, &truth, noise, 3).into_iter().map(torn).collect();
            // A difference of many uncertainties must be told; a smaller one may hide in the noise.
            let words = noise == 0.0 || apart > 25.0 * noise;
            let expected = if words { Expected::Words(vec![truth.clone()]) } else { Expected::Curves(vec![truth.clone()]) };
            points.push(of(name, apart, problem(&exposures, sets, expected)));
        }
    }
    Ok(points)
}
