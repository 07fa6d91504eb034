//! In a closed sphere with a uniform wall every reflection falls evenly on the wall, so all reflections can be summed.
//!
//! ```text
//! E_reflected = E₁ q / (1 − q)        E₁ = Φ / (4π R²),   q = ρ
//! with a ball of radius a at the centre                   q = ρ (1 − (1 − ρ_ball) a²/R²)
//! ```
//!
//! Two points of a sphere see each other under the same form factor whatever their distance, so the first reflection is already
//! uniform, wherever a point source stands, as long as all its flux reaches the wall. A ball at the centre takes the share a²/R²
//! of what the wall sends out (reciprocity), the same from every point of the wall, and returns ρ_ball of it evenly.
//! Holds for a cosine receptor at a point of the wall that faces the centre.

use std::f64::consts::PI;

use super::Choice;
use crate::geometry::shape::{Shape, Side, Sphere};
use crate::plan::{Method, Plan, Transport};
use crate::scene::Scene;
use crate::sensor::{Acceptance, Aperture};
use crate::source::{Emitter, Source};

pub(in crate::plan) const CHOICE: Choice =
    Choice { name: "closed_sphere", sentence: "all reflections of a closed uniform sphere have a sum", apply };

/// Lengths that are the same to this share: to the rounding of the coordinates that were written down.
const SAME: f64 = 1e-9;

/// A closed sphere that holds everything.
#[derive(Clone, Copy, Debug)]
pub struct ClosedSphere {
    wall: Sphere,
    /// Index into `Scene::surfaces` of its inside.
    inside: usize,
    /// A ball at the centre: its share of the wall's area, and what covers it.
    ball: Option<(f64, usize)>,
}

impl ClosedSphere {
    /// The sphere, if the scene is nothing but one with point sources inside, or with an emitting ball at its centre.
    #[must_use]
    pub fn of(scene: &Scene) -> Option<ClosedSphere> {
        let balls: Vec<(usize, Sphere)> = scene
            .elements
            .iter()
            .enumerate()
            .map(|(i, e)| if let Shape::Sphere(s) = e.shape { Some((i, s)) } else { None })
            .collect::<Option<_>>()?;
        let (outer, wall) = *balls.iter().max_by(|a, b| a.1.radius_m.total_cmp(&b.1.radius_m))?;
        let ball = match balls.as_slice() {
            [_] => None,
            [a, b] => {
                let (inner, ball) = if a.0 == outer { *b } else { *a };
                let concentric = (ball.centre - wall.centre).length() <= SAME * ball.radius_m && ball.radius_m < wall.radius_m;
                let share = (ball.radius_m / wall.radius_m).powi(2);
                Some(concentric.then_some((inner, share))?)
            }
            _ => return None,
        };
        let fits = scene.sources.iter().all(|s| match (&s.emitter, ball) {
            (Emitter::Point { at }, None) => (*at - wall.centre).length() < wall.radius_m,
            (Emitter::Area { elements }, Some((inner, _))) => elements.as_slice() == [(inner, Side::Front)],
            _ => false,
        });
        fits.then(|| ClosedSphere {
            wall,
            inside: scene.elements[outer].back,
            ball: ball.map(|(inner, share)| (share, scene.elements[inner].front)),
        })
    }

    /// Reflected irradiance at the wall per unit of the source's density. `None` where a reflectance is not one number over the
    /// wavelengths of the source, for which the sum is not a number either, or nothing is lost.
    #[must_use]
    pub fn reflected(&self, scene: &Scene, source: &Source) -> Option<f64> {
        let (low, high) = source.density.support().hull()?;
        let grey = |surface: usize| scene.surfaces[surface].reflectance.is_constant_over(low, high);
        let (lost, flux_per_density) = match self.ball {
            None => (0.0, 4.0 * PI),
            Some((share, surface)) => ((1.0 - grey(surface)?) * share, 4.0 * PI * PI * share * self.wall.radius_m.powi(2)),
        };
        let q = grey(self.inside)? * (1.0 - lost);
        // 1 − q = (1 − ρ) + ρ lost, without the cancellation of a reflectance close to one.
        let rest = (1.0 - grey(self.inside)?) + grey(self.inside)? * lost;
        (rest > 0.0).then(|| q / rest * flux_per_density / (4.0 * PI * self.wall.radius_m.powi(2)))
    }
}

fn apply(scene: &Scene, plan: &mut Plan) {
    let Some(sphere) = ClosedSphere::of(scene) else { return };
    let wall = sphere.wall;
    let on_the_wall: Vec<bool> = scene
        .instruments
        .iter()
        .map(|i| {
            i.sensor.aperture == Aperture::Point
                && i.sensor.acceptance == Acceptance::Cosine
                && i.poses.iter().all(|p| (p.at + wall.radius_m * p.normal - wall.centre).length() <= SAME * wall.radius_m)
        })
        .collect();
    for term in &mut plan.kept {
        let summed = || sphere.reflected(scene, &scene.sources[term.id.source()]).is_some();
        if term.id.transport == Transport::Reflected && on_the_wall[term.id.instrument()] && summed() {
            term.method = Method::ClosedSphere;
        }
    }
}
