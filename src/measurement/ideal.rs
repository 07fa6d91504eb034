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
//! Steps are sampled with common points and taken as ratios (`companion.rs`), so that they are known better than either reading. The ideal
//! value is S minus all parts: parts and whole agree by construction. What an instrument shares with its ideal costs nothing.

use super::companion::{Received, difference, estimated, ratio};
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
    /// Standard uncertainty of its share of the ideal reading, in which what both have in common cancels.
    pub share_uncertainty: f64,
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
    let factor = channel.temperature.map_or(1.0, |temperature| temperature.factor());
    let analogue = reading.readout.as_ref().map_or(reading.value, |readout| readout.analogue);
    let analogue_uncertainty = reading.computed_uncertainty;
    let mut walk = Walk { value: analogue / factor, uncertainty: analogue_uncertainty / factor, parts: Vec::new() };
    let mut at = received(0, sensor.channels.len() + c);
    if exchange.spectral {
        walk.step(Cause::Spectral, received(0, c)?, at?);
    }
    if factor != 1.0 {
        let (value, u) = (analogue - analogue / factor, analogue_uncertainty * (1.0 - 1.0 / factor).abs());
        walk.parts.push((Part { cause: Cause::Temperature, value, standard_uncertainty: u, share_uncertainty: 0.0 }, 0.0));
    }
    if exchange.directional {
        let next = received(1, c)?;
        walk.step(Cause::Directional, at?, next);
        at = Some(next);
    }
    if exchange.area {
        walk.step(Cause::Area, at?, received(2, c)?);
    }
    if let Some(readout) = reading.readout.as_ref().filter(|_| channel.ideal.is_some() || !walk.parts.is_empty()) {
        let (value, u) = (reading.value - readout.analogue, readout.standard_uncertainty);
        walk.parts.push((Part { cause: Cause::Electronics, value, standard_uncertainty: u, share_uncertainty: 0.0 }, u));
    }
    if walk.parts.is_empty() {
        return None;
    }
    walk.parts.sort_by_key(|(part, _)| part.cause);
    let parts: Vec<Part> = walk.parts.iter().map(|(part, own)| Part { share_uncertainty: own / walk.value.abs(), ..*part }).collect();
    let difference: f64 = parts.iter().map(|part| part.value).sum();
    Some(IdealReading { value: reading.value - difference, standard_uncertainty: walk.uncertainty, parts })
}

/// The way from the instrument to its ideal.
struct Walk {
    /// Where it is.
    value: f64,
    uncertainty: f64,
    /// Parts, each with what of its uncertainty is left when it is divided by the ideal reading, in the unit of the reading.
    parts: Vec<(Part, f64)>,
}

impl Walk {
    /// From `a` to `b`: by their ratio where there is one, because it is the same for all samples if only the spectrum counts; else by
    /// their difference.
    fn step(&mut self, cause: Cause, a: Received<'_>, b: Received<'_>) {
        let (value, own, share, next, uncertainty) = match ratio(a, b) {
            Some((ratio, u)) => {
                let own = self.value.abs() * u;
                (self.value * (1.0 - ratio), own, own / ratio.abs(), self.value * ratio, self.uncertainty * ratio.abs())
            }
            None => {
                let (difference, own) = difference(a, b);
                (difference, own, own, self.value - difference, self.uncertainty)
            }
        };
        let common = if self.value == 0.0 { 0.0 } else { (value / self.value).abs() * self.uncertainty };
        let part = Part { cause, value, standard_uncertainty: own.hypot(common), share_uncertainty: 0.0 };
        self.parts.push((part, if share.is_finite() { share } else { own }));
        self.value = next;
        self.uncertainty = uncertainty.hypot(own);
    }
}
