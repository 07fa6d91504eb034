//! In a closed sphere with a uniform wall every reflection falls evenly on the wall, so all reflections can be summed.
//!
//! ```text
//! E_reflected = ρ Φ / (A (1 − ρ)),   A = 4π R²
//! ```
//!
//! Two points of a sphere see each other under the same form factor whatever their distance, so the first reflection is already
//! uniform, wherever the source stands and however it shines, as long as all its flux reaches the wall.
//! Holds for a cosine receptor at a point of the wall that faces the centre, and sources without extent within the sphere.

use super::Choice;
use crate::geometry::shape::{Shape, Sphere};
use crate::plan::{Method, Plan, Transport};
use crate::scene::Scene;
use crate::sensor::{Acceptance, Aperture};
use crate::source::Emitter;

pub(super) const CHOICE: Choice = Choice {
    name: "closed_sphere",
    sentence: "all reflections of a closed uniform sphere have a sum",
    apply,
};

/// A closed sphere that holds everything.
#[derive(Clone, Copy, Debug)]
pub struct ClosedSphere {
    /// Where.
    pub sphere: Sphere,
    /// Index into `Scene::surfaces` of its inside.
    pub surface: usize,
}

/// The sphere, if the scene is nothing but one with point sources inside.
#[must_use]
pub fn closed_sphere(scene: &Scene) -> Option<ClosedSphere> {
    let [element] = scene.elements.as_slice() else { return None };
    let Shape::Sphere(sphere) = element.shape else { return None };
    let inside = scene.sources.iter().all(|s| match s.emitter {
        Emitter::Point { at } => (at - sphere.centre).length() < sphere.radius_m,
        _ => false,
    });
    inside.then_some(ClosedSphere { sphere, surface: element.back })
}

fn apply(scene: &Scene, plan: &mut Plan) {
    let Some(ClosedSphere { sphere, surface }) = closed_sphere(scene) else { return };
    let on_the_wall: Vec<bool> = scene
        .instruments
        .iter()
        .map(|i| {
            i.sensor.aperture == Aperture::Point
                && i.sensor.acceptance == Acceptance::Cosine
                && i.poses.iter().all(|p| {
                    // To the rounding of the coordinates that were written down.
                    let from_wall = (p.at + sphere.radius_m * p.normal - sphere.centre).length();
                    from_wall <= 1e-9 * sphere.radius_m
                })
        })
        .collect();
    for term in &mut plan.kept {
        // ρ/(1 − ρ) is a number only where ρ is one.
        let reflectance = &scene.surfaces[surface].reflectance;
        let band = scene.sources[term.id.source()].density.support().hull();
        let grey = band.and_then(|(low, high)| reflectance.is_constant_over(low, high)).is_some_and(|rho| rho < 1.0);
        if grey && term.id.transport == Transport::Reflected && on_the_wall[term.id.instrument()] {
            term.method = Method::ClosedSphere;
        }
    }
}
