//! Where nothing can block, a formula gives the direct term: exactly, or by quadrature over the aperture or the response.

use super::Choice;
use crate::geometry::shape::Shape;
use crate::plan::{Method, Plan, Transport, Visibility};
use crate::scene::Scene;
use crate::sensor::{Acceptance, Aperture, Sensor};
use crate::source::{Emitter, Source};

pub(in crate::plan) const CHOICE: Choice =
    Choice { name: "closed_form", sentence: "the direct light of an unobstructed source has a formula", apply };

/// What is known about the direct light of an unobstructed source.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Formula {
    /// A closed form.
    Exact,
    /// A closed form for each point of the aperture or each angle of the response, summed by deterministic quadrature.
    Summed,
    /// None.
    Unknown,
}

/// What is known about the unobstructed direct light of a source at a sensor.
#[must_use]
pub fn formula(scene: &Scene, sensor: &Sensor, source: &Source) -> Formula {
    // Each point of a pupil sees the field from elsewhere; only what fills every field is known.
    if matches!(sensor.acceptance, Acceptance::Spot(_)) {
        return if matches!(source.emitter, Emitter::Environment) { Formula::Exact } else { Formula::Unknown };
    }
    let symmetric = match &sensor.acceptance {
        Acceptance::Directional(table) => table.rotationally_symmetric().is_some(),
        _ => true,
    };
    let from_point = match &source.emitter {
        Emitter::Environment | Emitter::Directional { .. } => return Formula::Exact,
        Emitter::Point { .. } => Formula::Exact,
        Emitter::Area { elements } => {
            // A large mesh is summed triangle by triangle; beyond some thousands sampling is cheaper.
            let known = elements.iter().all(|&(e, _)| match &scene.elements[e].shape {
                Shape::Mesh(m) => m.triangle_count() <= 4096,
                _ => true,
            });
            match (&sensor.acceptance, known && symmetric) {
                (_, false) => Formula::Unknown,
                (Acceptance::Directional(_) | Acceptance::Cylindrical | Acceptance::Semicylindrical, true) => Formula::Summed,
                (_, true) => Formula::Exact,
            }
        }
    };
    match (sensor.aperture, from_point) {
        (_, Formula::Unknown) => Formula::Unknown,
        (Aperture::Point, known) => known,
        // A table summed over an aperture would be a quadrature of quadratures.
        (_, Formula::Summed) => Formula::Unknown,
        (_, Formula::Exact) => Formula::Summed,
    }
}

fn apply(scene: &Scene, plan: &mut Plan) {
    for term in &mut plan.kept {
        if term.id.transport == Transport::Direct && term.visibility == Visibility::Clear {
            let sensor = &scene.instruments[term.id.instrument()].sensor;
            term.method = match formula(scene, sensor, &scene.sources[term.id.source()]) {
                Formula::Exact => Method::ClosedForm,
                Formula::Summed => Method::Quadrature,
                Formula::Unknown => term.method,
            };
        }
    }
}
