//! The wavelengths of reflected light: which nodes the paths carry, and how each channel weighs them.
//!
//! ```text
//! S_c = Σ_g Σ_k w_{c,g,k} ⟨Π ρ(λ_k)⟩_g       w_{c,g,k} = ∫ L_g(λ) s_c(λ) hat_k(λ) dλ
//! ```
//!
//! Sources with the same density form a group `g`; paths keep one sum a group and a node. The product of source and responsivity
//! is integrated exactly against the hat functions of the nodes; only the product of reflectances is interpolated.

use super::{Method, Plan, Transport};
use crate::scene::Scene;
use crate::spectrum::quadrature::SpectralNodes;
use crate::spectrum::{Density, Factor};

/// Most nodes that paths carry.
const MAX_NODES: usize = 64;
/// The residual at which refinement stops.
const TARGET_RESIDUAL: f64 = 1e-5;

/// The wavelengths of the reflected terms of one instrument.
#[derive(Clone, Debug)]
pub struct SpectralPlan {
    /// Nodes, nm, rising.
    pub wavelengths_nm: Vec<f64>,
    /// Per group: indices of its sources.
    pub groups: Vec<Vec<usize>>,
    /// `weights[channel][group][node]`, in W m⁻² of irradiance and the like per unit of the geometric sum. Zero for terms that
    /// are left out.
    pub weights: Vec<Vec<Vec<f64>>>,
    /// `reflectances[surface][node]`.
    pub reflectances: Vec<Vec<f64>>,
    /// How far products of reflectances may be off between the nodes, as a share of the reflected reading.
    pub residual: f64,
}

/// Chooses nodes and weights for every instrument that sees reflected light.
#[must_use]
pub fn plan_wavelengths(scene: &Scene, plan: &Plan) -> Vec<Option<SpectralPlan>> {
    (0..scene.instruments.len()).map(|instrument| plan_instrument(scene, plan, instrument)).collect()
}

fn plan_instrument(scene: &Scene, plan: &Plan, instrument: usize) -> Option<SpectralPlan> {
    let kept: Vec<(usize, usize)> = // What another method sums up exactly is not carried by the paths as well.
        plan.terms_of(instrument, Transport::Reflected).filter(|t| t.method == Method::Paths).map(|t| (t.id.channel(), t.id.source())).collect();
    if kept.is_empty() {
        return None;
    }
    let responsivities: Vec<&Factor> = scene.instruments[instrument].sensor.channels.iter().map(|c| &c.responsivity).collect();
    Some(wavelengths_of(scene, &responsivities, &kept, plan.naive))
}

/// Nodes, groups and weights for the pairs of channel and source whose reflected light is `kept`, at least one.
pub(super) fn wavelengths_of(scene: &Scene, responsivities: &[&Factor], kept: &[(usize, usize)], naive: bool) -> SpectralPlan {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    let mut sources: Vec<usize> = kept.iter().map(|&(_, s)| s).collect();
    sources.sort_unstable();
    sources.dedup();
    for s in sources {
        match groups.iter_mut().find(|g| scene.sources[g[0]].density == scene.sources[s].density) {
            Some(group) => group.push(s),
            None => groups.push(vec![s]),
        }
    }
    let has = |channel: usize, group: &[usize]| kept.iter().any(|&(c, s)| c == channel && s == group[0]);
    let everywhere = Factor::Constant(1.0);
    let mut terms: Vec<(&Density, &Factor)> = Vec::new();
    for group in &groups {
        for (c, responsivity) in responsivities.iter().enumerate() {
            if has(c, group) {
                // The naive plan carries every wavelength of the source, seen or not, unless there is no end to them.
                let density = &scene.sources[group[0]].density;
                let bounded = density.support().hull().is_some_and(|(_, high)| high.is_finite());
                terms.push((density, if naive && bounded { &everywhere } else { responsivity }));
            }
        }
    }
    let reflectances: Vec<&Factor> = scene.surfaces.iter().map(|s| &s.reflectance).collect();
    // Paints that cover nothing need no nodes.
    let mut used: Vec<usize> = scene.elements.iter().flat_map(|e| [e.front, e.back]).collect();
    used.sort_unstable();
    used.dedup();
    let in_use: Vec<&Factor> = used.iter().map(|&s| reflectances[s]).collect();
    let nodes = SpectralNodes::compile(&terms, &in_use, MAX_NODES, TARGET_RESIDUAL);
    let weights = responsivities
        .iter()
        .enumerate()
        .map(|(c, responsivity)| {
            groups
                .iter()
                .map(|group| {
                    if has(c, group) {
                        nodes.weights(&scene.sources[group[0]].density, responsivity)
                    } else {
                        vec![0.0; nodes.wavelengths_nm().len()]
                    }
                })
                .collect()
        })
        .collect();
    SpectralPlan {
        wavelengths_nm: nodes.wavelengths_nm().to_vec(),
        groups,
        weights,
        reflectances: reflectances.iter().map(|r| nodes.sample(r)).collect(),
        residual: nodes.residual(),
    }
}
