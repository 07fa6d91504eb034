//! What an ideal instrument would indicate, and why a real one differs.
//!
//! ```text
//! S₀  the instrument without electronics, at the temperature of adjustment        S  what it indicates
//! S₁  S₀ with the weighting that its measurand defines      spectral mismatch     S₀ − S₁
//! S₂  S₁ with an ideal directional response                 directional response  S₁ − S₂
//! S₃  S₂ with a point for an aperture                       area averaging        S₂ − S₃
//! S − S₃ = (S − S_analogue) + (S_analogue − S₀) + (S₀ − S₁) + (S₁ − S₂) + (S₂ − S₃)
//! ```
//!
//! | cause | what is exchanged |
//! |---|---|
//! | spectral mismatch | s(λ) and its scale; 1/F* − 1 relative to S₁, F* the mismatch correction factor of the light that arrives |
//! | temperature | the factor 1 + c (T − T₀) |
//! | directional response | R(θ, φ) by the cosine receptor, or the same cone where a radiance is read |
//! | area averaging | the aperture by its centre; not where a flux through the area is read |
//! | electronics | the display by the photocurrent |
//!
//! Differences are sampled with common points (`companion.rs`), so that they are known better than either reading. The ideal value is
//! S minus all parts: parts and whole agree by construction. What an instrument shares with its ideal costs nothing.

use super::companion::{Received, difference, estimated};
use super::{Measurement, Reading};
use crate::estimate::{EstimateError, PoseEstimate, Watch};
use crate::metrology::EvaluationKind;
use crate::plan::Plan;
use crate::quantity::Measurand;
use crate::scene::Scene;
use crate::sensor::{Acceptance, Aperture, Channel, Sensor, Weighting};

/// Share of the samples of the measurement that each companion takes.
const SHARE: f64 = 0.25;
/// Fewest and most samples of a contribution and pose.
const SAMPLES: (f64, f64) = (256.0, 4_194_304.0);

/// Why an instrument indicates something else than an ideal one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Cause {
    /// Its responsivity is not the weighting function.
    Spectral,
    /// It is warmer or colder than where it was adjusted.
    Temperature,
    /// It weighs directions in another way.
    Directional,
    /// It averages over an area.
    Area,
    /// Dark current, non-linearity, ranges, steps of the display.
    Electronics,
}

impl Cause {
    /// All of them, in the order of reports.
    pub const ALL: [Cause; 5] = [Cause::Spectral, Cause::Temperature, Cause::Directional, Cause::Area, Cause::Electronics];

    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Cause::Spectral => "spectral mismatch",
            Cause::Temperature => "temperature",
            Cause::Directional => "directional response",
            Cause::Area => "area averaging",
            Cause::Electronics => "electronics",
        }
    }
}

/// A part of the difference to an ideal instrument.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    /// What it comes from.
    pub cause: Cause,
    /// Indicated more by this, in the unit of the reading.
    pub value: f64,
    /// Its standard uncertainty.
    pub standard_uncertainty: f64,
}

/// What an ideal instrument would indicate in the same place.
#[derive(Clone, Debug, PartialEq)]
pub struct IdealReading {
    /// Its indication, in the unit of the reading.
    pub value: f64,
    /// Standard uncertainty of that: what of the reading's is not the instrument's own, and that of the parts.
    pub standard_uncertainty: f64,
    /// Indication minus `value`, part by part.
    pub parts: Vec<Part>,
}

impl IdealReading {
    /// The sum of all parts.
    #[must_use]
    pub fn difference(&self) -> f64 {
        self.parts.iter().map(|part| part.value).sum()
    }
}

/// Whether a reading is a radiance, which is collected from a cone and not from the hemisphere.
fn is_radiance(measurand: &Measurand) -> bool {
    matches!(measurand, Measurand::Radiance | Measurand::Luminance | Measurand::PhotonRadiance)
        || measurand.unit().contains("sr")
        || measurand.unit() == "cd/m²"
}

fn is_flux(measurand: &Measurand) -> bool {
    matches!(measurand, Measurand::RadiantFlux | Measurand::LuminousFlux | Measurand::PhotonFlux | Measurand::Photocurrent)
}

/// What is exchanged for a channel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Exchange {
    spectral: bool,
    directional: bool,
    area: bool,
}

impl Exchange {
    fn of(sensor: &Sensor, channel: &Channel) -> Exchange {
        // What a current or a voltage should be, only its own curve says.
        let free = matches!(channel.reads, Measurand::Photocurrent | Measurand::Signal { .. });
        if free && channel.ideal.is_none() {
            return Exchange::default();
        }
        let same = |w: &Weighting| w.scale == channel.scale && w.curve == channel.responsivity;
        let table = matches!(sensor.acceptance, Acceptance::Directional(_) | Acceptance::Cone { .. });
        Exchange {
            spectral: channel.ideal.as_ref().is_some_and(|ideal| !same(ideal)),
            directional: table && !free && !is_radiance(&channel.reads),
            area: sensor.aperture != Aperture::Point && !is_flux(&channel.reads),
        }
    }
}

/// The channel with its ideal weighting, at the temperature of its adjustment.
fn weighted(channel: &Channel) -> Channel {
    let cool = Channel { temperature: None, ..channel.clone() };
    match &channel.ideal {
        Some(ideal) => Channel { responsivity: ideal.curve.clone(), scale: ideal.scale, ..cool },
        None => cool,
    }
}

/// Sensors that lead from an instrument to its ideal, step by step; steps that change nothing are left out.
struct Steps {
    exchange: Vec<Exchange>,
    /// S₀ in the first half of the channels, S₁ in the second.
    spectral: Option<Sensor>,
    /// S₁ alone, where a later step needs it without the first.
    directional: Option<Sensor>,
    area: Option<Sensor>,
}

impl Steps {
    fn of(sensor: &Sensor) -> Steps {
        let exchange: Vec<Exchange> = sensor.channels.iter().map(|channel| Exchange::of(sensor, channel)).collect();
        let any = |f: fn(&Exchange) -> bool| exchange.iter().any(f);
        let bare: Vec<Channel> = sensor.channels.iter().map(|c| Channel { temperature: None, ..c.clone() }).collect();
        let ideal: Vec<Channel> = sensor.channels.iter().map(weighted).collect();
        let needed = any(|e| *e != Exchange::default());
        let with = |aperture: &Aperture, acceptance: &Acceptance, channels: Vec<Channel>| {
            Sensor::new(sensor.title.clone(), *aperture, acceptance.clone(), channels)
        };
        let open = if any(|e| e.directional) { Acceptance::Cosine } else { sensor.acceptance.clone() };
        Steps {
            spectral: needed.then(|| with(&sensor.aperture, &sensor.acceptance, [bare, ideal.clone()].concat())),
            directional: any(|e| e.directional).then(|| with(&sensor.aperture, &open, ideal.clone())),
            area: any(|e| e.area).then(|| with(&Aperture::Point, &open, ideal)),
            exchange,
        }
    }
}

/// Adds to each reading what an ideal instrument would indicate; readings of ideal instruments, and of quantities of which none is known,
/// stay as they are.
///
/// Takes a quarter of the samples of the measurement for each step, with the same seed; instruments that are ideal cost nothing.
///
/// # Errors
/// As [`super::measure`].
pub fn add_ideal(measurement: &mut Measurement, scene: &Scene, plan: &Plan, watch: &Watch<'_>) -> Result<(), EstimateError> {
    let start = (watch.now)();
    let seed = measurement.provenance.seed;
    let mut first = 0;
    for (i, instrument) in scene.instruments.iter().enumerate() {
        let sensor = &instrument.sensor;
        let count = instrument.poses.len() * sensor.channels.len();
        let Some(readings) = measurement.readings.get_mut(first..first + count) else { break };
        first += count;
        let steps = Steps::of(sensor);
        let samples = samples_of(readings);
        // Each alone, so that all stand at the same index and share their points.
        let run = |sensor: &Option<Sensor>| -> Result<Option<Vec<PoseEstimate>>, EstimateError> {
            let Some(sensor) = sensor else { return Ok(None) };
            Ok(estimated(scene, plan, vec![(i, sensor.clone())], samples, seed, watch)?.into_iter().next())
        };
        let (spectral, directional, area) = (run(&steps.spectral)?, run(&steps.directional)?, run(&steps.area)?);
        let stages = [(&steps.spectral, &spectral), (&steps.directional, &directional), (&steps.area, &area)];
        for (k, reading) in readings.iter_mut().enumerate() {
            let (pose, c) = (k / sensor.channels.len(), k % sensor.channels.len());
            let received = |stage: usize, channel: usize| -> Option<Received<'_>> {
                let (sensor, poses) = (stages[stage].0.as_ref()?, stages[stage].1.as_ref()?);
                let scale = sensor.channels.get(channel)?.indication_per_irradiance(&sensor.aperture, &sensor.acceptance)?;
                Some(Received { estimate: poses.get(pose)?.channels.get(channel)?, scale })
            };
            reading.ideal = of_reading(reading, sensor, c, steps.exchange[c], &received);
        }
    }
    measurement.wall_seconds += (watch.now)() - start;
    Ok(())
}

/// Samples for each contribution and pose of a companion.
fn samples_of(readings: &[Reading]) -> u64 {
    let sampled = |r: &Reading| r.budget.rows.iter().filter(|row| row.kind == EvaluationKind::A).count() as f64;
    let (samples, parts) = readings.iter().fold((0.0, 0.0), |(n, p), r| (n + r.samples as f64, p + sampled(r)));
    if parts > 0.0 { (SHARE * samples / parts).clamp(SAMPLES.0, SAMPLES.1) as u64 } else { SAMPLES.0 as u64 }
}

fn of_reading<'e>(
    reading: &Reading,
    sensor: &Sensor,
    c: usize,
    exchange: Exchange,
    received: &dyn Fn(usize, usize) -> Option<Received<'e>>,
) -> Option<IdealReading> {
    let channel = &sensor.channels[c];
    let mut parts = Vec::new();
    let mut add = |cause: Cause, (value, standard_uncertainty): (f64, f64)| parts.push(Part { cause, value, standard_uncertainty });
    let count = sensor.channels.len();
    if exchange.spectral {
        add(Cause::Spectral, difference(received(0, c)?, received(0, count + c)?));
    }
    let analogue = reading.readout.as_ref().map_or(reading.value, |readout| readout.analogue);
    if let Some(temperature) = channel.temperature.filter(|t| t.factor() != 1.0) {
        // The reading without it follows without another sample.
        let share = 1.0 - 1.0 / temperature.factor();
        add(Cause::Temperature, (analogue * share, reading.computed_uncertainty * share.abs()));
    }
    let mut last = received(0, count + c);
    if exchange.directional {
        let next = received(1, c)?;
        add(Cause::Directional, difference(last?, next));
        last = Some(next);
    }
    if exchange.area {
        add(Cause::Area, difference(last?, received(2, c)?));
    }
    if let Some(readout) = &reading.readout {
        add(Cause::Electronics, (reading.value - readout.analogue, readout.standard_uncertainty));
    }
    if parts.is_empty() || (parts.iter().all(|p| p.cause == Cause::Electronics) && channel.ideal.is_none()) {
        return None;
    }
    parts.sort_by_key(|part| part.cause);
    let traced = parts.iter().filter(|p| !matches!(p.cause, Cause::Electronics | Cause::Temperature)).map(|p| p.standard_uncertainty);
    let standard_uncertainty = traced.fold(reading.computed_uncertainty, f64::hypot);
    let difference: f64 = parts.iter().map(|part| part.value).sum();
    Some(IdealReading { value: reading.value - difference, standard_uncertainty, parts })
}
