//! What a ray from the pupil sees at its first surface, as every channel weighs it.
//!
//! ```text
//! emitted    ∫ L_s s_c dλ              reflected   E_g/π ∫ φ_g s_c ρ dλ            sky   ∫ L s_c dλ
//! ```
//!
//! φ_g is the density that the sources of a group share, E_g their irradiance per unit of it. The integrals over the wavelength are exact;
//! nodes are needed for more than one reflection only.

use std::f64::consts::PI;

use super::lambert::Irradiance;
use crate::math::DVec3;
use crate::plan::camera::{CameraPlan, FirstReflection};
use crate::scene::Scene;
use crate::source::Emitter;

/// Emission and first reflections of a scene.
pub(super) struct Shades<'a> {
    channels: usize,
    /// Per element and side: the surface, and the row of `emitted` if it emits.
    sides: Vec<[(u32, Option<u32>); 2]>,
    emitted: Vec<Vec<f64>>,
    /// What the environments give where nothing is met.
    pub(super) sky: Vec<f64>,
    /// Formulas by group.
    groups: Vec<Vec<Irradiance<'a>>>,
    /// Per surface: none if it is black to every group, else channels for each group in turn.
    reflected: Vec<Option<Vec<f64>>>,
    /// Per source: ∫ density · responsivity dλ.
    pub(super) weights: Vec<Vec<f64>>,
}

impl<'a> Shades<'a> {
    /// `traced`: sources whose own light is traced to the sensor.
    pub(super) fn new(scene: &'a Scene, plan: &CameraPlan, traced: &[bool]) -> Shades<'a> {
        let channels = plan.responsivities.len();
        let mut weights: Vec<Vec<f64>> = Vec::new();
        for (s, source) in scene.sources.iter().enumerate() {
            let same = (0..s).find(|&earlier| scene.sources[earlier].density == source.density);
            weights.push(match same {
                Some(earlier) => weights[earlier].clone(),
                None => plan.responsivities.iter().map(|r| source.density.integral(&[r])).collect(),
            });
        }
        let mut sides: Vec<[(u32, Option<u32>); 2]> =
            scene.elements.iter().map(|e| [(e.front as u32, None), (e.back as u32, None)]).collect();
        let mut emitted: Vec<Vec<f64>> = Vec::new();
        let mut sky = vec![0.0; channels];
        for ((source, weights), _) in scene.sources.iter().zip(&weights).zip(traced).filter(|(_, traced)| !**traced) {
            let add = |row: &mut Vec<f64>| row.iter_mut().zip(weights).for_each(|(sum, w)| *sum += w);
            match &source.emitter {
                Emitter::Environment => add(&mut sky),
                Emitter::Area { elements } => {
                    for &(element, side) in elements {
                        let slot = &mut sides[element][side as usize].1;
                        let row = *slot.get_or_insert_with(|| {
                            emitted.push(vec![0.0; channels]);
                            emitted.len() as u32 - 1
                        });
                        add(&mut emitted[row as usize]);
                    }
                }
                Emitter::Point { .. } | Emitter::Directional { .. } => {}
            }
        }
        let by_formula = |&s: &usize| plan.first[s] == FirstReflection::Formula;
        let members = plan.spectral.iter().flat_map(|spectral| &spectral.groups);
        let members: Vec<Vec<usize>> =
            members.map(|g| g.iter().copied().filter(by_formula).collect()).filter(|g: &Vec<_>| !g.is_empty()).collect();
        let groups = members.iter().map(|g| g.iter().map(|&s| Irradiance::of(scene, &scene.sources[s])).collect()).collect();
        let reflected = scene.surfaces.iter().map(|surface| {
            let rows = members.iter().flat_map(|g| {
                let density = &scene.sources[g[0]].density;
                plan.responsivities.iter().map(move |r| density.integral(&[r, &surface.reflectance]) / PI)
            });
            let rows: Vec<f64> = rows.collect();
            rows.iter().any(|&x| x > 0.0).then_some(rows)
        });
        Shades { channels, sides, emitted, sky, groups, reflected: reflected.collect(), weights }
    }

    /// Adds `weight` times the radiance of a surface, as the channels of `wanted` see it, to `sums`.
    #[inline(always)]
    pub(super) fn add(&self, (element, front): (u32, bool), point: DVec3, normal: DVec3, weight: f64, wanted: &[usize], sums: &mut [f64]) {
        let (surface, emits) = self.sides[element as usize][usize::from(!front)];
        if let Some(row) = emits {
            self.add_row(&self.emitted[row as usize], weight, wanted, sums);
        }
        if let Some(rows) = &self.reflected[surface as usize] {
            for (group, row) in self.groups.iter().zip(rows.chunks_exact(self.channels)) {
                let irradiance: f64 = group.iter().map(|source| source.at(point, normal)).sum();
                self.add_row(row, weight * irradiance, wanted, sums);
            }
        }
    }

    #[inline(always)]
    pub(super) fn add_row(&self, row: &[f64], weight: f64, wanted: &[usize], sums: &mut [f64]) {
        for (sum, &channel) in sums.iter_mut().zip(wanted) {
            *sum += weight * row[channel];
        }
    }
}
