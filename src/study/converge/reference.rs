//! What readings are held to: values that were given, closed forms, or a long run of the same plan.

use super::ladder::{Climbed, run};
use super::{ConvergeError, ConvergeOptions, REFERENCE_FACTORS};
use crate::plan::Plan;
use crate::scene::{Layout, Scene};
use crate::study::StudyWatch;

/// Where a reading stands among those of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// Name of the instrument.
    pub instrument: String,
    /// How its poses are arranged.
    pub layout: Layout,
    /// Which pose.
    pub index: usize,
    /// Name of the channel.
    pub channel: String,
    /// Unit of its readings.
    pub unit: String,
}

impl Place {
    /// Instrument, pose and channel, as a file of readings names them: "work plane [3, 0], E_v".
    #[must_use]
    pub fn in_words(&self) -> String {
        let index = match self.layout {
            Layout::Single => String::new(),
            Layout::List => format!(" [{}]", self.index),
            Layout::Grid { columns, .. } => format!(" [{}, {}]", self.index % columns, self.index / columns),
        };
        format!("{}{index}, {}", self.instrument, self.channel)
    }
}

/// The readings of a scene in their order: instrument by instrument, pose by pose, channel by channel.
#[must_use]
pub fn places(scene: &Scene) -> Vec<Place> {
    let mut places = Vec::new();
    for instrument in &scene.instruments {
        for index in 0..instrument.poses.len() {
            places.extend(instrument.sensor.channels.iter().map(|channel| Place {
                instrument: instrument.name.clone(),
                layout: instrument.layout,
                index,
                channel: channel.name.clone(),
                unit: channel.reads.unit().to_owned(),
            }));
        }
    }
    places
}

/// What a reading is held to, in its unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReferenceValue {
    /// The value.
    pub value: f64,
    /// Its standard uncertainty; `None` if none was stated, and the value is taken as exact.
    pub standard_uncertainty: Option<f64>,
}

/// Where a reference is from.
#[derive(Clone, Debug, PartialEq)]
pub enum ReferenceOrigin {
    /// Given, and how it was named.
    Given(String),
    /// Formulas give every reading.
    ClosedForm,
    /// A long run of the first plan.
    LongRun {
        /// Its seed.
        seed: u64,
        /// Samples a sampled contribution and pose.
        samples: u64,
        /// Processor time, s.
        cpu_seconds: f64,
        /// Wall time, s.
        wall_seconds: f64,
    },
}

/// What the readings of a scene are held to.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// Where it is from.
    pub origin: ReferenceOrigin,
    /// A reading each, in their order.
    pub values: Vec<ReferenceValue>,
}

impl Reference {
    /// Whether there is a finite value for every reading.
    pub(super) fn fits(&self, places: &[Place]) -> Result<(), ConvergeError> {
        let wrong = |what: String| Err(ConvergeError::Reference(what));
        if self.values.len() != places.len() {
            return wrong(format!("the reference has {} values, the scene {} readings", self.values.len(), places.len()));
        }
        for (value, place) in self.values.iter().zip(places) {
            let sound = value.value.is_finite() && value.standard_uncertainty.is_none_or(|u| u >= 0.0 && u.is_finite());
            if !sound {
                return wrong(format!("the reference of {} is not finite, or its uncertainty is negative", place.in_words()));
            }
        }
        if self.values.iter().all(|v| v.value == 0.0) {
            return wrong("every value of the reference is zero: there is no relative error".to_owned());
        }
        Ok(())
    }
}

/// The reference that the first plan gives: its closed forms, or a run as long as what is left of the budget allows.
pub(super) fn own(
    scene: &Scene,
    plan: &Plan,
    first: &Climbed,
    options: &ConvergeOptions,
    start: f64,
    watch: &StudyWatch<'_>,
) -> Result<Reference, ConvergeError> {
    if let Some(exact) = &first.exact {
        let both = exact.values.iter().zip(&exact.standard_uncertainties);
        let values = both.map(|(&value, &u)| ReferenceValue { value, standard_uncertainty: Some(u) }).collect();
        return Ok(Reference { origin: ReferenceOrigin::ClosedForm, values });
    }
    let Some(top) = first.rungs.last() else { return Err(ConvergeError::Reference("there is no rung".to_owned())) };
    let (least, most) = REFERENCE_FACTORS;
    let left = start + options.budget_seconds - (watch.now)();
    let mut factor = most;
    while factor > least && factor as f64 * top.wall_seconds > left {
        factor /= 2;
    }
    let samples = top.samples.saturating_mul(factor).min(1 << 32);
    let (wall, cpu) = ((watch.now)(), (watch.cpu)());
    let measured = run(scene, plan, (samples, options.seed), (start, options.budget_seconds), watch)?;
    let values = measured.readings.iter().map(|r| ReferenceValue { value: r.value, standard_uncertainty: Some(r.standard_uncertainty()) });
    let origin =
        ReferenceOrigin::LongRun { seed: options.seed, samples, cpu_seconds: (watch.cpu)() - cpu, wall_seconds: (watch.now)() - wall };
    Ok(Reference { origin, values: values.collect() })
}
