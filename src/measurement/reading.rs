//! Readings of all instruments of a scene.

use super::Provenance;
use super::coordinates::Coordinates;
use super::electronics::{DisplayReading, displayed};
use super::frame::measure_regions;
use super::ideal::IdealReading;
use super::own_uncertainty::OwnUncertainty;
use crate::estimate::journal::{Journal, Unrecorded};
use crate::estimate::{ChannelEstimate, Counters, EstimateError, PoseEstimate, Stop, Watch, estimate_with};
use crate::math::DVec3;
use crate::metrology::{Budget, BudgetRow, Expanded, Replicates};
use crate::plan::{Bound, Plan};
use crate::quantity::Measurand;
use crate::scene::{Instrument, Layout, Scene};
use crate::sensor::photodiode::Saturation;
use crate::sensor::{ResponsivityKind, ResponsivityUncertainty, Sensor};

/// Relative half-width within which double-precision arithmetic keeps a formula; the formulas are tested far below it.
pub(super) const ARITHMETIC: f64 = 1e-12;

/// What an instrument indicates in one pose and channel.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// Name of the instrument.
    pub instrument: String,
    /// How its poses are arranged.
    pub layout: Layout,
    /// Which pose.
    pub index: usize,
    /// Centre of the aperture, m.
    pub at: DVec3,
    /// Name of the channel.
    pub channel: String,
    /// What is read, with its unit.
    pub measurand: Measurand,
    /// The indication, in that unit.
    pub value: f64,
    /// Its uncertainty, by cause.
    pub budget: Budget,
    /// The part of u_c that is not the instrument's own: sampling, quadrature, what was left out.
    pub computed_uncertainty: f64,
    /// What the electronics made of it, if the sensor has a readout.
    pub readout: Option<DisplayReading>,
    /// What an ideal instrument would indicate, once it was asked for: see [`super::add_ideal`].
    pub ideal: Option<IdealReading>,
    /// Coverage factor and expanded uncertainty at 95 %.
    pub expanded: Expanded,
    /// Samples over all jobs and replicates; zero where formulas served.
    pub samples: u64,
    /// Seconds of the run that went into this pose.
    pub seconds: f64,
    /// Whether the target that was asked for is met. A saturated readout never meets one: its U is that of the indication, not of the light.
    pub target_met: bool,
    /// What a reader should know, such as why a reading is zero.
    pub notes: Vec<String>,
}

impl Reading {
    /// u_c, in the unit of the value.
    #[must_use]
    pub fn standard_uncertainty(&self) -> f64 {
        self.budget.combined_standard_uncertainty()
    }

    /// What the readout has cut off, if anything: of a whole reading the indication is a lower bound.
    #[must_use]
    pub fn saturation(&self) -> Option<Saturation> {
        self.readout.as_ref().and_then(|display| display.saturation)
    }
}

/// All readings of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    /// Title of the scene.
    pub scene: String,
    /// Instrument by instrument, pose by pose, channel by channel.
    pub readings: Vec<Reading>,
    /// What was really done.
    pub counters: Counters,
    /// Pieces of work that the samples were taken in.
    pub pieces: u64,
    /// Where it came from.
    pub provenance: Provenance,
    /// Seconds from start to end.
    pub wall_seconds: f64,
}

/// Reads every instrument of a scene, and the regions of its cameras, according to a plan.
///
/// # Errors
/// When light is never absorbed, so that a reading is not finite, or a reading is beyond the range of numbers.
pub fn measure(scene: &Scene, plan: &Plan, stop: &Stop, seed: u64, watch: &Watch<'_>) -> Result<Measurement, EstimateError> {
    measure_with(scene, plan, stop, seed, watch, &Unrecorded)
}

/// The same with a journal: to resume a run, to put it together from its shares, or to repeat one that a clock ended.
///
/// # Errors
/// As [`measure`], and when the journal is one of another run or lacks pieces that it does not want sampled.
pub fn measure_with(
    scene: &Scene,
    plan: &Plan,
    stop: &Stop,
    seed: u64,
    watch: &Watch<'_>,
    journal: &dyn Journal,
) -> Result<Measurement, EstimateError> {
    let start = (watch.now)();
    let estimates = estimate_with(scene, plan, stop, seed, watch, journal)?;
    let mut readings = Vec::new();
    let curves = OwnUncertainty::of(scene, plan, seed, watch)?;
    let coordinates = Coordinates::of(scene);
    for (i, (instrument, poses)) in scene.instruments.iter().zip(&estimates.poses).enumerate() {
        let left_out: Vec<LeftOut> = (0..instrument.sensor.channels.len()).map(|c| LeftOut::of(plan, i, c)).collect();
        for (index, pose) in poses.iter().enumerate() {
            let coordinates = coordinates.share(scene, instrument.poses[index].at);
            for (c, channel) in pose.channels.iter().enumerate() {
                let from_file = curves.of_channel(i, index, c);
                let reading = read(instrument, (i, index, c), (pose, coordinates), channel, &left_out[c], from_file, seed);
                if !(reading.value.is_finite() && reading.expanded.expanded_uncertainty.is_finite()) {
                    return Err(EstimateError::OutOfRange { instrument: instrument.name.clone() });
                }
                readings.push(reading);
            }
        }
    }
    let mut counters = estimates.counters;
    for camera in 0..scene.cameras.len() {
        let (found, counted) = measure_regions(scene, plan, camera, stop, seed, watch)?;
        readings.extend(found);
        counters.add(&counted);
    }
    let mut provenance = Provenance::of(scene, plan, stop, seed);
    if stop.budget_seconds.is_some() {
        provenance.rounds = estimates.rounds;
    }
    Ok(Measurement {
        scene: scene.title.clone(),
        readings,
        counters,
        pieces: estimates.pieces,
        provenance,
        wall_seconds: (watch.now)() - start,
    })
}

/// What the plan left out of a channel.
struct LeftOut {
    bounds: Vec<(&'static str, f64)>,
    reasons: Vec<String>,
}

impl LeftOut {
    fn of(plan: &Plan, instrument: usize, channel: usize) -> LeftOut {
        let mut found = LeftOut { bounds: Vec::new(), reasons: Vec::new() };
        for o in plan.omitted.iter().filter(|o| o.id.instrument() == instrument && o.id.channel() == channel) {
            if let Bound::AtMost(most) = o.bound {
                match found.bounds.iter_mut().find(|(rule, _)| *rule == o.rule) {
                    Some((_, sum)) => *sum += most,
                    None => found.bounds.push((o.rule, most)),
                }
            }
            if found.reasons.len() < 4 && !found.reasons.iter().any(|r| *r == o.reason) {
                found.reasons.push(o.reason.to_string());
            }
        }
        found
    }
}

fn read(
    instrument: &Instrument,
    (i, index, c): (usize, usize, usize),
    (pose, coordinates): (&PoseEstimate, f64),
    estimate: &ChannelEstimate,
    left_out: &LeftOut,
    from_file: Vec<f64>,
    seed: u64,
) -> Reading {
    let sensor = &instrument.sensor;
    let channel = &sensor.channels[c];
    // A validated sensor has an area where its measurand needs one.
    let scale = channel.indication_per_irradiance(&sensor.aperture, &sensor.acceptance).unwrap_or(f64::NAN);
    let mut value = scale * estimate.exact.value;
    let mut budget = Budget::new();
    let mut samples = 0;
    for sampled in &estimate.sampled {
        samples += sampled.samples;
        if let Some(found) = Replicates::evaluate(&sampled.replicates.map(|r| scale * r)) {
            value += found.mean;
            budget.push(BudgetRow::type_a(sampled.label.clone(), found.standard_uncertainty, found.degrees_of_freedom));
            if sampled.spectral_residual > 0.0 {
                budget.push(BudgetRow::rectangular("wavelengths between the nodes", sampled.spectral_residual * found.mean.abs()));
            }
        }
        if let Some((bound, why)) = &sampled.missed {
            budget.push(BudgetRow::one_sided(format!("{}: {why}", sampled.label), scale * bound));
        }
    }
    if estimate.exact.terms > 0 {
        if estimate.exact.quadrature_error > 0.0 {
            budget.push(BudgetRow::rectangular("quadrature", scale * estimate.exact.quadrature_error));
        }
        budget.push(BudgetRow::rectangular("double-precision arithmetic", ARITHMETIC * (scale * estimate.exact.value).abs()));
        if coordinates > ARITHMETIC {
            budget.push(BudgetRow::rectangular("rounding of coordinates", coordinates * (scale * estimate.exact.value).abs()));
        }
    }
    for &(rule, bound) in &left_out.bounds {
        budget.push(BudgetRow::one_sided(format!("left out: {rule}"), bound));
    }
    let mut notes = Vec::new();
    let computed_uncertainty = budget.combined_standard_uncertainty();
    if value == 0.0 {
        notes.push(format!("reads zero: {}", why_zero(sensor, computed_uncertainty, estimate, left_out)));
    }
    if !pose.target_met && value != 0.0 {
        notes.push("the target was not met within the samples or the time allowed".to_owned());
    }
    if channel.kind == ResponsivityKind::QuantumEfficiency {
        notes.push(format!("has a {} in the channel `{}`", channel.kind.words(), channel.name));
    }
    let shares = channel.responsivity_uncertainty.iter().filter_map(|u| match u {
        ResponsivityUncertainty::Relative(share) => Some(share * value.abs()),
        ResponsivityUncertainty::Curve(_) => None,
    });
    for u in shares.chain(from_file) {
        budget.push(BudgetRow::normal("responsivity, one cause for all wavelengths", u));
    }
    let electronics = sensor.readout.as_ref().zip(sensor.photocurrent_per_unit_a(channel));
    let readout = electronics.map(|(diode, a_per_unit)| {
        let path = [i as u64, index as u64, c as u64];
        let (shown, display) = displayed(diode, value, a_per_unit, (seed, &path), channel.reads.unit(), &mut budget, &mut notes);
        value = shown;
        display
    });
    let expanded = budget.expanded().unwrap_or(Expanded {
        coverage_probability: crate::metrology::budget::DEFAULT_COVERAGE_PROBABILITY,
        coverage_factor: f64::INFINITY,
        expanded_uncertainty: f64::INFINITY,
        degrees_of_freedom: 0.0,
    });
    Reading {
        instrument: instrument.name.clone(),
        layout: instrument.layout,
        index,
        at: instrument.poses[index].at,
        channel: channel.name.clone(),
        measurand: channel.reads.clone(),
        value,
        budget,
        computed_uncertainty,
        ideal: None,
        expanded,
        samples,
        seconds: pose.seconds,
        target_met: pose.target_met && readout.as_ref().is_none_or(|display| display.saturation.is_none()),
        readout,
        notes,
    }
}

/// Why a reading is zero.
fn why_zero(sensor: &Sensor, uncertainty: f64, estimate: &ChannelEstimate, left_out: &LeftOut) -> String {
    if uncertainty > 0.0 {
        return "no light was found; the uncertainty is the upper bound of what may have been missed".to_owned();
    }
    let mut reasons = left_out.reasons.clone();
    if estimate.exact.terms + estimate.sampled.len() > 0 {
        let from = if sensor.acceptance.has_horizon() { " from above its horizon, in its acceptance and" } else { "" };
        reasons.push(format!("in this pose nothing that is computed reaches the sensor{from} in its band"));
    } else if reasons.is_empty() {
        reasons.push("the scene has no source".to_owned());
    }
    reasons.join("; ")
}
