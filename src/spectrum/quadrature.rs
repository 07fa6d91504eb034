//! Few wavelengths and positive weights for products of reflectances along paths:
//! `∫ L(λ) s(λ) P(λ) dλ ≈ Σₖ wₖ P(λₖ)`, with `wₖ = ∫ L s hatₖ dλ` and P any product of the scene's reflectances.
//!
//! * `hatₖ` is 1 at node k and falls linearly to 0 at its neighbours; the first and the last are held to the outside. The hats sum to 1,
//!   so `Σ wₖ = ∫ L s dλ` exactly: only P is interpolated. Lines are in the weights with their exact powers.
//! * Where a reflectance jumps, two neighbouring `f64` are nodes, one on either side.
//! * A scene whose reflectances are constant where sources and sensors overlap needs one node.
//!
//! `placement` chooses the nodes by trial on the products of `test_products`.

use super::placement::{Placement, Point};
use super::product_integral::points_and_weights;
use super::test_products::TestProducts;
use super::{Density, Factor, Outside, Table};

/// Nodes that a scene gets at most unless it asks for another number.
pub const DEFAULT_MAX_NODES: usize = 64;

/// Residual at which placing nodes stops unless another is asked for.
pub const DEFAULT_TARGET_RESIDUAL: f64 = 1e-5;

/// Gauss–Legendre nodes a segment for the test integrals: exact up to degree 7 between breakpoints.
const TEST_NODES: usize = 4;

/// The same for the residual that is stated: other points, and more of them.
const CHECK_NODES: usize = 9;

/// No segment between test points is longer than this part of the range of the reflectances' tables.
const SEGMENTS: f64 = 40.0;

/// Wavelengths at which paths carry the spectrum.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectralNodes {
    wavelengths_nm: Vec<f64>,
    residual: f64,
    path_residual: f64,
}

impl SpectralNodes {
    /// Chooses nodes for all `terms` (density of a source, responsivity of a channel) and all `reflectances` of a scene: at most
    /// `max_nodes` (at least 2 unless the scene is grey), fewer if the [`residual`](Self::residual) falls to `target_residual` before.
    /// No node at all if no term has a common wavelength.
    pub fn compile(terms: &[(&Density, &Factor)], reflectances: &[&Factor], max_nodes: usize, target_residual: f64) -> Self {
        let points = term_points(terms, reflectances, TEST_NODES);
        let Some(heaviest) = points.iter().max_by(|a, b| a.weight.total_cmp(&b.weight)) else {
            return Self { wavelengths_nm: Vec::new(), residual: 0.0, path_residual: 0.0 };
        };
        let coloured = coloured(terms, reflectances);
        if coloured.is_empty() {
            return Self { wavelengths_nm: vec![heaviest.nm], residual: 0.0, path_residual: 0.0 };
        }
        let tests = TestProducts::new(&coloured, points.iter().map(|point| point.nm).collect());
        let mut placement = Placement::new(&points, terms.len(), &tests);
        let candidates = candidates(terms, &coloured);
        for &nm in &jump_nodes(&coloured) {
            if placement.nodes() < max_nodes {
                placement.split_at(nm);
            }
        }
        while placement.nodes() < max_nodes && placement.residuals().0 > target_residual {
            if !placement.refine(&candidates) {
                break;
            }
        }
        let wavelengths_nm = placement.node_wavelengths_nm();
        // The figure that is stated comes from points that had no part in it.
        let points = term_points(terms, reflectances, CHECK_NODES);
        let tests = TestProducts::new(&coloured, points.iter().map(|point| point.nm).collect());
        let (residual, path_residual) = Placement::at_nodes(&points, terms.len(), &tests, &wavelengths_nm).residuals();
        Self { wavelengths_nm, residual, path_residual }
    }

    /// The nodes with the default limits.
    pub fn compile_default(terms: &[(&Density, &Factor)], reflectances: &[&Factor]) -> Self {
        Self::compile(terms, reflectances, DEFAULT_MAX_NODES, DEFAULT_TARGET_RESIDUAL)
    }

    /// The nodes, nm, strictly increasing.
    pub fn wavelengths_nm(&self) -> &[f64] {
        &self.wavelengths_nm
    }

    /// Largest error over the terms and the test products P of one to eight reflectances (of all powers where one is bright), as a share of the reading of whoever sees them:
    /// `|Σ wₖ P(λₖ) − ∫ L s P dλ| / ∫ L s ρ dλ` with the ρ in P that reflects least. A single reflection is so measured against its own
    /// light, and the brightness of the paints does not matter. Half of the products take no part in placing the nodes. It is found
    /// by trial on samples of products, so it is an estimate and not a bound.
    pub fn residual(&self) -> f64 {
        self.residual
    }

    /// The same errors relative to what the path itself can carry, `∫ L s dλ` times the largest value on the support of each
    /// reflectance in P: the figure for a sensor that sees nothing but light reflected many times.
    pub fn path_residual(&self) -> f64 {
        self.path_residual
    }

    /// `wₖ = ∫ density · factor · hatₖ dλ`, lines included, one a node; their sum is the integral of the density times the factor.
    /// None is negative if the factor is not. Empty if there are no nodes.
    pub fn weights(&self, density: &Density, factor: &Factor) -> Vec<f64> {
        let nodes = &self.wavelengths_nm;
        if nodes.len() == 1 {
            return vec![density.integral(&[factor])];
        }
        (0..nodes.len()).map(|k| density.integral(&[factor, &hat(nodes, k)])).collect()
    }

    /// The values of a reflectance at the nodes.
    pub fn sample(&self, factor: &Factor) -> Vec<f64> {
        self.wavelengths_nm.iter().map(|nm| factor.at(*nm)).collect()
    }
}

/// The hat function of node `k` of at least two.
fn hat(nodes: &[f64], k: usize) -> Factor {
    let from = k.saturating_sub(1);
    let to = (k + 1).min(nodes.len() - 1);
    let values = (from..=to).map(|i| if i == k { 1.0 } else { 0.0 }).collect();
    // Held outside: an inner hat holds its zeros, the first and the last hold their one.
    Factor::Table(Table::from_valid(nodes[from..=to].to_vec(), values, Outside::Hold))
}

/// All terms as points, `nodes` a segment, each term's weights summing to 1, rising in wavelength.
fn term_points(terms: &[(&Density, &Factor)], reflectances: &[&Factor], nodes: usize) -> Vec<Point> {
    let mut cuts_nm = Vec::new();
    for reflectance in reflectances {
        reflectance.push_breakpoints(0.0, f64::INFINITY, &mut cuts_nm);
    }
    cuts_nm.sort_by(f64::total_cmp);
    cuts_nm.dedup();
    subdivide(&mut cuts_nm);
    let mut points = Vec::new();
    for (term, (density, factor)) in terms.iter().enumerate() {
        let first = points.len();
        let continuum = points_and_weights(density, &[factor], &cuts_nm, nodes);
        points.extend(continuum.into_iter().map(|(nm, weight)| Point { nm, weight, term }));
        let lines = density.lines().into_iter();
        points.extend(lines.map(|line| {
            let weight = line.power * factor.at(line.wavelength_nm);
            Point { nm: line.wavelength_nm, weight, term }
        }));
        let total: f64 = points[first..].iter().map(|point| point.weight.abs()).sum();
        // A term without a common wavelength has no points and needs no node.
        points[first..].iter_mut().for_each(|point| point.weight /= total);
    }
    points.retain(|point| point.weight.is_finite() && point.weight != 0.0);
    points.sort_by(|a, b| a.nm.total_cmp(&b.nm));
    points
}

/// Cuts long segments: on the few points of one long segment nodes could be placed that err everywhere else.
fn subdivide(cuts_nm: &mut Vec<f64>) {
    let (Some(first), Some(last)) = (cuts_nm.first(), cuts_nm.last()) else { return };
    let longest = (last - first) / SEGMENTS;
    let gaps: Vec<(f64, f64)> = cuts_nm.windows(2).map(|w| (w[0], w[1])).collect();
    for (from, to) in gaps {
        let parts = ((to - from) / longest).ceil().min(SEGMENTS);
        cuts_nm.extend((1..parts as usize).map(|k| from + (to - from) * k as f64 / parts));
    }
    cuts_nm.sort_by(f64::total_cmp);
}

/// The reflectances that are not constant over the joint support of the terms, without repetitions.
fn coloured<'a>(terms: &[(&Density, &Factor)], reflectances: &[&'a Factor]) -> Vec<&'a Factor> {
    let supports: Vec<_> = terms.iter().map(|(density, factor)| density.joint_support(&[factor])).collect();
    let intervals = || supports.iter().flat_map(|support| support.intervals());
    let is_grey = |reflectance: &Factor| {
        let mut values = intervals().map(|(from_nm, to_nm)| reflectance.is_constant_over(*from_nm, *to_nm));
        let first = values.next().flatten();
        first.is_some() && values.all(|value| value == first)
    };
    let mut coloured: Vec<&Factor> = Vec::new();
    for reflectance in reflectances {
        if !coloured.contains(reflectance) && !is_grey(reflectance) {
            coloured.push(reflectance);
        }
    }
    coloured
}

/// Wavelengths where a node is likely to help: breakpoints of the reflectances and lines, rising.
fn candidates(terms: &[(&Density, &Factor)], reflectances: &[&Factor]) -> Vec<f64> {
    let mut candidates: Vec<f64> = reflectances.iter().flat_map(|reflectance| reflectance.breakpoints()).collect();
    candidates.extend(terms.iter().flat_map(|(density, _)| density.lines()).map(|line| line.wavelength_nm));
    candidates.sort_by(f64::total_cmp);
    candidates.dedup();
    candidates
}

/// Both sides of every jump of the reflectances.
fn jump_nodes(reflectances: &[&Factor]) -> Vec<f64> {
    let mut nodes = Vec::new();
    for reflectance in reflectances {
        for nm in reflectance.discontinuities() {
            if reflectance.at(nm.next_down()) != reflectance.at(nm) {
                nodes.extend([nm.next_down(), nm]);
            }
            if reflectance.at(nm.next_up()) != reflectance.at(nm) {
                nodes.extend([nm, nm.next_up()]);
            }
        }
    }
    nodes
}
