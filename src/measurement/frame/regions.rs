//! Rectangles of a picture as readings: the mean over the pixels of a channel, with its budget.
//!
//! ```text
//! μ = Σ μ_i/n      u² = Σ u_i²/n²      ν = (Σ u_i²)² / Σ (u_i⁴/ν_i)       pixels are independent
//! ```

use super::scaled;
use crate::estimate::camera::{Area, Rendered, Sampling, render};
use crate::estimate::{Counters, EstimateError, Stop, Watch};
use crate::measurement::Reading;
use crate::metrology::budget::DEFAULT_COVERAGE_PROBABILITY;
use crate::metrology::{Budget, BudgetRow, CompensatedSum, Expanded};
use crate::plan::Plan;
use crate::quantity::Measurand;
use crate::scene::{Layout, PlacedCamera, Region, Scene};

/// Relative half-width within which double-precision arithmetic keeps a value.
const ARITHMETIC: f64 = 1e-12;
/// Confidence 95 %: of N independent trials that all missed, the chance to hit is below 3/N.
const RULE_OF_THREE: f64 = 3.0;
/// Most samples of a pixel of a region.
const MOST_SAMPLES: u64 = 1 << 14;

/// What the pixels of a region hold for one channel.
struct Sample {
    values: Vec<(f64, f64)>,
    /// The largest value of the whole picture.
    brightest: f64,
}

/// Reads the regions of a camera out of the picture of an area that holds them all.
pub(in crate::measurement) fn read_regions(
    scene: &Scene,
    plan: &Plan,
    camera: usize,
    picture: (&Rendered, Area),
    sampling: Sampling,
) -> Vec<Reading> {
    let placed = &scene.cameras[camera];
    placed.regions.iter().flat_map(|region| read_region(plan, camera, placed, region, picture, sampling)).collect()
}

/// Reads the regions of a camera without the rest of its picture.
///
/// # Errors
/// As those of [`super::expose`].
pub(in crate::measurement) fn measure_regions(
    scene: &Scene,
    plan: &Plan,
    camera: usize,
    stop: &Stop,
    seed: u64,
    watch: &Watch<'_>,
) -> Result<(Vec<Reading>, Counters), EstimateError> {
    let placed = &scene.cameras[camera];
    let start = (watch.now)();
    let mut counters = Counters::default();
    let mut readings: Vec<Vec<Reading>> = vec![Vec::new(); placed.regions.len()];
    let mut open: Vec<usize> = (0..placed.regions.len()).collect();
    let mut sampling = stop.samples.map_or(Sampling::default(), Sampling::of);
    let target = stop.target.filter(|_| stop.samples.is_none()).unwrap_or(f64::INFINITY);
    let met = |r: &Reading| r.expanded.expanded_uncertainty <= target * r.value.abs() || r.value == 0.0;
    while !open.is_empty() {
        let areas: Vec<Area> = open.iter().map(|&k| of_region(&placed.regions[k])).collect();
        let mut rendered = scaled(scene, camera, render(scene, plan, camera, &areas, sampling, seed, watch)?)?;
        counters.add(&rendered.counters);
        for (&k, area) in open.iter().zip(&areas) {
            let own = rendered.split_off_first(area.pixels());
            readings[k] = read_region(plan, camera, placed, &placed.regions[k], (&own, *area), sampling);
        }
        let last = sampling.samples() >= MOST_SAMPLES;
        open.retain(|&k| !last && !readings[k].iter().all(met));
        // Numbers of its own: what decided to go on is not reported.
        sampling = Sampling { points: sampling.points * 4, set: sampling.set + 1, ..sampling };
    }
    let mut readings: Vec<Reading> = readings.into_iter().flatten().collect();
    let seconds = ((watch.now)() - start) / placed.regions.len().max(1) as f64;
    for reading in &mut readings {
        reading.seconds = seconds;
        reading.target_met = met(reading);
        if !reading.target_met {
            reading.notes.push(format!("the target was not met within {MOST_SAMPLES} samples a pixel"));
        }
    }
    Ok((readings, counters))
}

fn of_region(region: &Region) -> Area {
    Area { x: region.x, y: region.y, width: region.width, height: region.height }
}

fn read_region(
    plan: &Plan,
    camera: usize,
    placed: &PlacedCamera,
    region: &Region,
    (rendered, area): (&Rendered, Area),
    sampling: Sampling,
) -> Vec<Reading> {
    let model = &placed.camera;
    let pixels =
        || (region.y..region.y + region.height).flat_map(|row| (region.x..region.x + region.width).map(move |column| (column, row)));
    let index = |column: usize, row: usize| (row - area.y) * area.width + column - area.x;
    let brightest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
    let reading = |channel: &str, measurand: Measurand, sample: Sample| {
        let mut notes = Vec::new();
        let (value, budget) = mean(plan, camera, &sample, sampling, &mut notes);
        let expanded = budget.expanded().unwrap_or(Expanded {
            coverage_probability: DEFAULT_COVERAGE_PROBABILITY,
            coverage_factor: f64::INFINITY,
            expanded_uncertainty: f64::INFINITY,
            degrees_of_freedom: 0.0,
        });
        Reading {
            instrument: format!("{}: {}", placed.name, region.name),
            layout: Layout::Single,
            index: 0,
            at: placed.pose.at,
            channel: channel.to_owned(),
            measurand,
            value,
            computed_uncertainty: budget.combined_standard_uncertainty(),
            budget,
            readout: None,
            ideal: None,
            expanded,
            samples: sample.values.len() as u64 * sampling.samples(),
            seconds: 0.0,
            target_met: true,
            notes,
        }
    };
    let mut readings = Vec::new();
    for (c, channel) in model.channels.iter().enumerate() {
        let plane = if model.mosaic.is_some() { 0 } else { c };
        let mine = pixels().filter(|&(column, row)| model.channel_at(plane, column, row) == c);
        let value = |(column, row)| {
            let at = index(column, row);
            (rendered.planes[plane][at], rendered.plane_uncertainties[plane][at])
        };
        let sample = Sample { values: mine.map(value).collect(), brightest: brightest(&rendered.planes[plane]) };
        if !sample.values.is_empty() {
            let electrons = Measurand::Weighted { name: "expected electrons a pixel".into(), symbol: "μ_e".into(), unit: "e⁻".into() };
            readings.push(reading(&channel.name, electrons, sample));
        }
    }
    let values = pixels().map(|(column, row)| index(column, row)).map(|at| (rendered.luminance[at], rendered.luminance_uncertainty[at]));
    let sample = Sample { values: values.collect(), brightest: brightest(&rendered.luminance) };
    readings.push(reading("L_v", Measurand::Luminance, sample));
    readings
}

/// The mean of the pixels, and what its uncertainty consists of.
fn mean(plan: &Plan, camera: usize, sample: &Sample, sampling: Sampling, notes: &mut Vec<String>) -> (f64, Budget) {
    let n = sample.values.len() as f64;
    let (mut sum, mut squares, mut fourth) = (CompensatedSum::new(), 0.0, 0.0);
    let scale = sample.values.iter().map(|&(_, u)| u).fold(0.0, f64::max);
    for &(value, u) in &sample.values {
        sum.add(value);
        let share = if scale > 0.0 { u / scale } else { 0.0 };
        squares += share * share;
        fourth += share.powi(4);
    }
    let value = sum.value() / n;
    let of_pixel = (sampling.groups - 1) as f64;
    let freedom = if fourth > 0.0 { squares * squares / fourth * of_pixel } else { n * of_pixel };
    let mut budget = Budget::new();
    budget.push(BudgetRow::type_a("samples of the pixels", scale * squares.sqrt() / n, freedom));
    budget.push(BudgetRow::rectangular("double-precision arithmetic", ARITHMETIC * value.abs()));
    let plan = &plan.cameras[camera];
    if let (true, Some(spectral)) = (plan.needs_paths(), &plan.spectral) {
        if spectral.residual > 0.0 && value > 0.0 {
            budget.push(BudgetRow::rectangular("wavelengths between the nodes", spectral.residual * value));
        }
        let samples = n * sampling.samples() as f64;
        if squares == 0.0 {
            let (size, why) = if value == 0.0 { (sample.brightest, "no sample out of") } else { (value, "the same was found by all of") };
            budget.push(BudgetRow::one_sided(format!("{why} {samples} samples"), RULE_OF_THREE / samples * size));
        }
    }
    if value == 0.0 {
        notes.push("reads zero: nothing that sends light in the band of this channel is seen in this region".to_owned());
    }
    (value, budget)
}
