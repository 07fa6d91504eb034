//! Bright spots that few paths can find: surfaces right beside a lamp.
//!
//! ```text
//! share of the paths that find it ≈ 9 d²/r², of n patches in a line 2 n d²/r²      what it adds ≤ 2 ρ I / (r² (1 − ρ))
//! ```
//!
//! | symbol | meaning |
//! |---|---|
//! | d | distance of the lamp from the surface, or its size if that is larger, m; a strip is as large as it is wide |
//! | r | distance of the lamp from the receiver, m |
//! | I | intensity per unit of density: 1 for a point, the projected area for a source with a radiance |
//!
//! Half the flux of a lamp that is close to a surface falls on a patch about three times as wide as the lamp is far from it. A sensor sees
//! the patch, of a strip a bright line, as a small source, but directions that do not know of it hit it by chance only: until enough of them have, their
//! spread says nothing of it, and the bound has to.

use std::f64::consts::PI;

use super::prepare::PathScene;
use crate::geometry::shape::{Shape, Side};
use crate::math::DVec3;
use crate::scene::Scene;
use crate::source::{Emitter, Source};

/// A lamp is close to a surface below this share of its distance from the receiver.
const CLOSE: f64 = 0.1;
/// Paths that have to find a spot before their spread speaks for it.
const ENOUGH: f64 = 100.0;
/// Largest gain by reflections to and fro that the bound allows for.
const MOST_GAIN: f64 = 10.0;

/// A lamp close to a reflecting surface, as one receiver sees it.
#[derive(Clone, Copy, Debug)]
pub(in crate::estimate) struct BrightSpot {
    pub(in crate::estimate) group: u32,
    share: f64,
    /// Irradiance per unit of the group's density, at most.
    pub(in crate::estimate) bound: f64,
}

impl BrightSpot {
    /// Whether so many paths may still not know of it.
    pub(in crate::estimate) fn is_unresolved(&self, samples: f64) -> bool {
        samples * self.share < ENOUGH
    }
}

/// A lamp with its distance to the nearest surface that reflects.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beside {
    group: u32,
    at: DVec3,
    reach_m: f64,
    intensity: f64,
    reflectance: f64,
    /// Patches like this one that the lamp as a whole makes: it is found by whoever finds any of them.
    patches: f64,
}

/// Most parts into which a strip is divided.
const MOST_PARTS: usize = 64;

/// A flat lamp as parts along its greatest length: their centres, their size, and how many pieces as long as wide it has.
fn parts(shape: &Shape) -> (Vec<DVec3>, f64, f64) {
    let (centre, radius) = shape.bounding_sphere();
    let long = 2.0 * radius;
    let width = shape.area_m2() / long;
    let pieces = (0.5 * long / width).ceil().max(1.0);
    let corners = shape.corners().unwrap_or_default();
    if pieces < 2.0 || corners.is_empty() {
        return (vec![centre], radius, 1.0);
    }
    let pairs = corners.iter().flat_map(|&a| corners.iter().map(move |&b| (a, b)));
    let (from, to) =
        pairs.fold(
            (centre, centre),
            |best, pair| {
                if (pair.1 - pair.0).length_squared() > (best.1 - best.0).length_squared() { pair } else { best }
            },
        );
    let count = (pieces as usize).min(MOST_PARTS);
    let places = (0..count).map(|i| from + (to - from) * ((i as f64 + 0.5) / count as f64)).collect();
    (places, radius.min(0.5 * width.hypot(long / pieces)), pieces)
}

impl Beside {
    /// The parts of a source that have a reflecting surface on the side to which they shine.
    pub(super) fn of(scene: &Scene, source: &Source, group: u32, survival: &[f64]) -> Vec<Beside> {
        let nearest = |own: Option<usize>, at: DVec3, lit: &dyn Fn(&Shape) -> bool| {
            let reflecting = scene.elements.iter().enumerate().filter(|(i, e)| Some(*i) != own && lit(&e.shape));
            reflecting
                .map(|(_, e)| (e.shape.distance_m(at), survival[e.front].max(survival[e.back])))
                .filter(|(_, reflectance)| *reflectance > 0.0)
                .min_by(|a, b| a.0.total_cmp(&b.0))
        };
        match &source.emitter {
            Emitter::Point { at } => nearest(None, *at, &|_| true)
                .map(|(reach_m, reflectance)| Beside { group, at: *at, reach_m, intensity: 1.0, reflectance, patches: 1.0 })
                .into_iter()
                .collect(),
            Emitter::Area { elements } => elements
                .iter()
                .flat_map(|&(e, side)| {
                    let shape = &scene.elements[e].shape;
                    match (shape, shape.plane()) {
                        (Shape::Sphere(s), _) if side == Side::Front => nearest(Some(e), s.centre, &|_| true)
                            .map(|(d, reflectance)| Beside {
                                group,
                                at: s.centre,
                                reach_m: (d - s.radius_m).max(s.radius_m),
                                intensity: PI * s.radius_m * s.radius_m,
                                reflectance,
                                patches: 1.0,
                            })
                            .into_iter()
                            .collect::<Vec<_>>(),
                        (Shape::Rectangle(_) | Shape::Disc(_) | Shape::Polygon(_), Some((on, normal))) => {
                            let ahead = |other: &Shape| other.extent_along(on, side.sign() * normal).1 > 0.0;
                            let (places, size_m, patches) = parts(shape);
                            let intensity = shape.area_m2() / places.len() as f64;
                            let found = places.into_iter().filter_map(|at| {
                                let (d, reflectance) = nearest(Some(e), at, &ahead)?;
                                Some(Beside { group, at, reach_m: d.max(size_m), intensity, reflectance, patches })
                            });
                            found.collect()
                        }
                        // From inside a sphere every point is lit alike, and a mesh does not tell its distance.
                        _ => Vec::new(),
                    }
                })
                .collect(),
            Emitter::Directional { .. } | Emitter::Environment => Vec::new(),
        }
    }
}

impl PathScene<'_> {
    /// The bright spots that a receiver at this place may overlook.
    pub(in crate::estimate) fn bright_spots(&self, receiver: DVec3) -> Vec<BrightSpot> {
        let spots = self.beside.iter().filter_map(|lamp| {
            let r2 = (lamp.at - receiver).length_squared();
            let gain = (1.0 / (1.0 - lamp.reflectance)).clamp(1.0, MOST_GAIN);
            let near = lamp.reach_m * lamp.reach_m / r2;
            (near < CLOSE * CLOSE).then(|| BrightSpot {
                group: lamp.group,
                share: (near * if lamp.patches > 1.0 { 2.0 * lamp.patches } else { 9.0 }).min(1.0),
                bound: 2.0 * lamp.reflectance * lamp.intensity * gain / r2,
            })
        });
        spots.collect()
    }
}
