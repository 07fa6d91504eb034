//! What paths need to know of a scene.

use std::f64::consts::PI;

use super::bright_spot::Beside;
use crate::estimate::light::Lights;
use crate::geometry::world::World;
use crate::plan::spectral::SpectralPlan;
use crate::scene::Scene;
use crate::source::{Emitter, Source};

/// Rows of nodes are padded to a multiple of this, with reflectance zero.
const PAD: usize = 8;

/// A scene as paths see it.
pub(in crate::estimate) struct PathScene<'a> {
    pub(super) world: &'a World,
    pub(super) lights: Lights,
    /// The group of each environment; several may share one.
    pub(super) skies: Vec<u32>,
    /// Surface of the front and of the back of each element.
    pub(super) surfaces: Vec<[u32; 2]>,
    /// Reflectances at the nodes, a padded row a surface.
    pub(super) reflectance: Vec<f64>,
    /// The largest reflectance of each surface at the nodes.
    pub(in crate::estimate) survival: Vec<f64>,
    /// Length of a padded row.
    pub(super) row: usize,
    /// Groups of sources.
    pub(super) groups: usize,
    /// Lamps that stand close to a reflecting surface.
    pub(super) beside: Vec<Beside>,
    /// The lights that the first surface is connected to, where they are not all.
    pub(super) first_lights: Option<Lights>,
    /// Reflections up to which the light of the environment comes from elsewhere.
    pub(super) sky_known_to: u32,
    /// Reflections after which a path ends.
    pub(super) most_reflections: u32,
}

impl<'a> PathScene<'a> {
    pub(in crate::estimate) fn new(scene: &'a Scene, world: &'a World, spectral: &SpectralPlan) -> PathScene<'a> {
        let nodes = spectral.wavelengths_nm.len();
        let row = if nodes == 1 { 1 } else { nodes.div_ceil(PAD) * PAD };
        let mut reflectance = vec![0.0; row * spectral.reflectances.len()];
        for (target, values) in reflectance.chunks_exact_mut(row).zip(&spectral.reflectances) {
            target[..nodes].copy_from_slice(values);
        }
        let survival: Vec<f64> = spectral.reflectances.iter().map(|r| r.iter().copied().fold(0.0, f64::max)).collect();
        let mut lit = Vec::new();
        let mut skies = Vec::new();
        let mut beside = Vec::new();
        for (group, sources) in spectral.groups.iter().enumerate() {
            // Each channel counts alike, however bright it is: a share of its own total.
            let of_channel = |channel: &Vec<Vec<f64>>| {
                let total: f64 = channel.iter().flatten().sum();
                if total > 0.0 { channel[group].iter().sum::<f64>() / total } else { 0.0 }
            };
            let brightness: f64 = spectral.weights.iter().map(of_channel).sum();
            for &s in sources {
                let source = &scene.sources[s];
                beside.extend(Beside::of(scene, source, group as u32, &survival));
                match source.emitter {
                    Emitter::Environment => skies.push(group as u32),
                    _ => lit.push((source, group as u32, brightness * extent(scene, source))),
                }
            }
        }
        PathScene {
            world,
            lights: Lights::new(scene, lit),
            skies,
            surfaces: scene.elements.iter().map(|e| [e.front as u32, e.back as u32]).collect(),
            reflectance,
            survival,
            row,
            groups: spectral.groups.len(),
            beside,
            first_lights: None,
            sky_known_to: 0,
            most_reflections: u32::MAX,
        }
    }

    /// The same for paths whose first reflection is known of all sources but those that are `sampled`, and that end there unless light goes on.
    pub(in crate::estimate) fn after_first(
        mut self,
        scene: &'a Scene,
        spectral: &SpectralPlan,
        sampled: &dyn Fn(usize) -> bool,
        goes_on: bool,
    ) -> Self {
        let mut lit = Vec::new();
        for (group, sources) in spectral.groups.iter().enumerate() {
            for &s in sources.iter().filter(|&&s| sampled(s)) {
                let source = &scene.sources[s];
                lit.push((source, group as u32, extent(scene, source)));
            }
        }
        let sky = lit.iter().any(|(source, _, _)| matches!(source.emitter, Emitter::Environment));
        self.first_lights = Some(Lights::new(scene, lit));
        self.sky_known_to = u32::from(!sky);
        if !goes_on {
            self.most_reflections = 1;
            if !sky {
                self.skies.clear();
            }
        }
        self
    }

    /// Numbers that a replicate adds up: groups × nodes of a padded row.
    pub(in crate::estimate) fn width(&self) -> usize {
        self.groups * self.row
    }

    /// The sums of a group at the nodes, from the sums of a replicate.
    pub(in crate::estimate) fn group<'s>(&self, sums: &'s [f64], group: usize) -> &'s [f64] {
        &sums[group * self.row..(group + 1) * self.row]
    }
}

/// Flux per unit of density, m² sr and the like: the share of the lights' choice.
fn extent(scene: &Scene, source: &Source) -> f64 {
    match &source.emitter {
        Emitter::Point { .. } => 4.0 * PI,
        Emitter::Area { elements } => elements.iter().map(|&(e, _)| PI * scene.elements[e].shape.area_m2()).sum(),
        Emitter::Directional { .. } | Emitter::Environment => {
            // Through the cross-section of everything there is.
            let spheres = scene.elements.iter().map(|e| e.shape.bounding_sphere());
            let (low, high) = spheres.fold((crate::math::DVec3::INFINITY, crate::math::DVec3::NEG_INFINITY), |(low, high), (c, r)| {
                (low.min(c - r), high.max(c + r))
            });
            0.25 * PI * (high - low).length_squared()
        }
    }
}
