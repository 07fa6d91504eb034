//! Instruments of the same scene with other sensors, and differences and ratios of what two of them receive.
//!
//! ```text
//! Δ = a Σ x − b Σ y       exact parts subtract; sampled ones replicate by replicate, u(Δ) from the spread of the differences
//! ρ = b Σ y / (a Σ x)     u(ρ) = u(b Σ y − ρ a Σ x) / (a Σ x)
//! ```
//!
//! Companions that stand at the same index and are sampled with the same seed take the same points, so what they have in common cancels in
//! each replicate, and u(Δ) is that of the difference alone.

use std::sync::Arc;

use super::reading::ARITHMETIC;
use crate::estimate::{ChannelEstimate, EstimateError, PoseEstimate, REPLICATES, Sampled, Stop, Watch, estimate};
use crate::metrology::{Budget, BudgetRow, Replicates};
use crate::plan::{Plan, PlanOptions};
use crate::scene::{Instrument, Scene};
use crate::sensor::Sensor;

/// So many u above zero a number may be divided by: the bias of a ratio is then below a percent of its distance from one.
const WELL_ABOVE: f64 = 10.0;

/// Estimates instruments of a scene with other sensors; `replaced` has the indices of the instruments and their sensors.
pub(super) fn estimated(
    scene: &Scene,
    plan: &Plan,
    replaced: Vec<(usize, Sensor)>,
    samples: u64,
    seed: u64,
    watch: &Watch<'_>,
) -> Result<Vec<Vec<PoseEstimate>>, EstimateError> {
    let instruments =
        replaced.into_iter().map(|(i, sensor)| Instrument { sensor: Arc::new(sensor), ..scene.instruments[i].clone() }).collect();
    let companion = Scene { instruments, ..scene.clone() };
    let options = PlanOptions { naive: plan.naive, without: plan.without.clone() };
    let plan = Plan::new(&companion, &options).map_err(|e| EstimateError::Companion { why: e.to_string() })?;
    let stop = Stop { target: None, budget_seconds: None, samples: Some(samples) };
    let quiet = Watch { now: watch.now, progress: &|_| {} };
    Ok(estimate(&companion, &plan, &stop, seed, &quiet)?.poses)
}

/// What a channel receives and what it makes of it.
#[derive(Clone, Copy)]
pub(super) struct Received<'e> {
    pub(super) estimate: &'e ChannelEstimate,
    /// Indication per unit of the estimate.
    pub(super) scale: f64,
}

impl Received<'_> {
    fn exact(&self) -> f64 {
        self.scale * self.estimate.exact.value
    }

    fn sampled(&self, label: &str) -> Option<&Sampled> {
        self.estimate.sampled.iter().find(|s| s.label == label)
    }

    fn replicates(&self, label: &str) -> [f64; REPLICATES] {
        self.sampled(label).map_or([0.0; REPLICATES], |s| s.replicates.map(|r| self.scale * r))
    }

    /// What may have been missed, and what lies between the wavelengths.
    fn bounds(&self, label: &str) -> [f64; 2] {
        let Some(sampled) = self.sampled(label) else { return [0.0; 2] };
        let mean = sampled.replicates.iter().sum::<f64>() / REPLICATES as f64;
        [self.scale * sampled.missed.as_ref().map_or(0.0, |m| m.0), self.scale * sampled.spectral_residual * mean]
    }
}

/// `a − b` with its standard uncertainty.
pub(super) fn difference(a: Received<'_>, b: Received<'_>) -> (f64, f64) {
    let mut value = a.exact() - b.exact();
    let mut budget = Budget::new();
    let quadratures = (a.scale * a.estimate.exact.quadrature_error, b.scale * b.estimate.exact.quadrature_error);
    budget.push(BudgetRow::rectangular("quadrature", quadratures.0.max(quadratures.1)));
    budget.push(BudgetRow::rectangular("arithmetic", ARITHMETIC * a.exact().abs().max(b.exact().abs())));
    let mut labels: Vec<&str> = a.estimate.sampled.iter().chain(&b.estimate.sampled).map(|s| s.label.as_str()).collect();
    labels.sort_unstable();
    labels.dedup();
    for label in labels {
        let (x, y) = (a.replicates(label), b.replicates(label));
        let differences: [f64; REPLICATES] = std::array::from_fn(|r| x[r] - y[r]);
        if let Some(found) = Replicates::evaluate(&differences) {
            value += found.mean;
            budget.push(BudgetRow::type_a(label, found.standard_uncertainty, found.degrees_of_freedom));
        }
        // What both may have missed is missing in both.
        let (x, y) = (a.bounds(label), b.bounds(label));
        budget.push(BudgetRow::one_sided("missed", (x[0] - y[0]).abs()));
        budget.push(BudgetRow::rectangular("wavelengths between the nodes", (x[1] - y[1]).abs()));
    }
    (value, budget.combined_standard_uncertainty())
}

/// `b / a` with its standard uncertainty; `None` where `a` is not well above zero.
pub(super) fn ratio(a: Received<'_>, b: Received<'_>) -> Option<(f64, f64)> {
    let (below, u) = indication(a);
    let ratio = indication(b).0 / below;
    if !(below.abs() > WELL_ABOVE * u && ratio.is_finite()) {
        return None;
    }
    let scaled = Received { scale: a.scale * ratio, ..a };
    Some((ratio, difference(b, scaled).1 / below.abs()))
}

/// The indication with its standard uncertainty.
pub(super) fn indication(received: Received<'_>) -> (f64, f64) {
    difference(received, Received { estimate: &ChannelEstimate::default(), scale: 0.0 })
}
