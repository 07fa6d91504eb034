//! The Planckian locus: chromaticities of black bodies from 0 K to infinity, as a curve over the reciprocal temperature β = 1/T.
//!
//! ```text
//! X(β) ∝ ∫ x̄(λ) λ⁻⁴ g(c₂β/λ) dλ,    g(ξ) = ξ/(eξ − 1),    g′(ξ) = (g/ξ)(1 − ξ − g)
//! ```
//!
//! Divided by its own size at β, the integrand has the limit λ⁻⁴ at β = 0, an infinite temperature, and underflows nowhere.
//! c₂ = hc/k = 1.438776877…e-2 m K, the exact SI value; wavelengths are taken as they are in the tables of the observer.
//!
//! The wavelengths at which the integrand is known are chosen once: three Gauss–Legendre nodes on pieces of at most 1 nm of the observer's
//! tables (their product with Planck's law is then exact to about 1e-13 from 1000 K on), or the wavelengths of a sum.

use super::{Chromaticity, Tristimulus};
use crate::spectrum::Factor;
use crate::spectrum::black_body::SECOND_RADIATION_CONSTANT_NM_K;

/// Nodes and weights of Gauss and Legendre for three points on −1 … 1.
const GAUSS_LEGENDRE: [(f64, f64); 3] = [(-0.774_596_669_241_483_4, 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)];
/// Largest piece on which three nodes are enough.
const LARGEST_PIECE_NM: f64 = 1.0;
/// Below it the derivative of g is summed as a series, since its closed form cancels.
const SMALL: f64 = 1e-2;

/// The black bodies as an observer sees them.
#[derive(Debug, Clone)]
pub struct PlanckianLocus {
    nodes: Vec<Node>,
    longest_nm: f64,
    // Where the search for the nearest point begins: evenly in β, from infinity to [`COLDEST_K`].
    coarse: Vec<(f64, PlanckianPoint)>,
}

/// Where the search for the nearest point of the locus ends, K.
const COLDEST_K: f64 = 500.0;
/// Points of the first search: neighbours are closer than the locus is curved, so the nearest one has the minimum beside it.
const COARSE: usize = 80;

#[derive(Debug, Clone, Copy)]
struct Node {
    wavelength_nm: f64,
    // The three functions there, times the weight and λ⁻⁴ (λ in units of 560 nm, for the range of numbers).
    weights: [f64; 3],
}

/// A point of the locus in CIE 1960 u, v, and how it moves when β grows.
#[derive(Debug, Clone, Copy)]
pub(super) struct PlanckianPoint {
    pub(super) uv: [f64; 2],
    pub(super) duv_dbeta: [f64; 2],
}

impl PlanckianLocus {
    /// The locus of an observer by exact integration: the convention of [`Tristimulus::of`].
    pub fn new(matching: &[Factor; 3]) -> Self {
        let mut edges_nm: Vec<f64> = matching.iter().flat_map(Factor::breakpoints).collect();
        edges_nm.sort_by(f64::total_cmp);
        edges_nm.dedup();
        let mut nodes = Vec::new();
        for pair in edges_nm.windows(2) {
            let pieces = ((pair[1] - pair[0]) / LARGEST_PIECE_NM).ceil().max(1.0);
            let half_nm = 0.5 * (pair[1] - pair[0]) / pieces;
            for piece in 0..pieces as usize {
                let middle_nm = pair[0] + half_nm * (2 * piece + 1) as f64;
                for (t, weight) in GAUSS_LEGENDRE {
                    nodes.push(Node::at(middle_nm + half_nm * t, weight * half_nm, matching));
                }
            }
        }
        Self::of_nodes(nodes)
    }

    /// The locus of an observer by summation from `from_nm` to `to_nm` every `step_nm`: the convention of tables, for spectra
    /// whose tristimulus values are sums as well.
    pub fn summed(matching: &[Factor; 3], from_nm: f64, to_nm: f64, step_nm: f64) -> Self {
        let steps = ((to_nm - from_nm) / step_nm + 1e-9).floor();
        let steps = if steps.is_finite() && steps >= 0.0 { steps.min(1e6) as usize + 1 } else { 0 };
        Self::of_nodes((0..steps).map(|i| Node::at(from_nm + step_nm * i as f64, step_nm, matching)).collect())
    }

    fn of_nodes(mut nodes: Vec<Node>) -> Self {
        nodes.retain(|node| node.weights != [0.0; 3]);
        let longest_nm = nodes.iter().fold(0.0, |longest: f64, node| longest.max(node.wavelength_nm));
        let mut locus = Self { nodes, longest_nm, coarse: Vec::new() };
        let beta = |i: usize| i as f64 / (COARSE as f64 * COLDEST_K);
        locus.coarse = (0..=COARSE).map(|i| (beta(i), locus.point(beta(i)))).collect();
        locus
    }

    /// Points evenly in β, K⁻¹, from an infinite temperature to far below what is searched for.
    pub(super) fn coarse(&self) -> &[(f64, PlanckianPoint)] {
        &self.coarse
    }

    /// The chromaticity at a temperature in K, infinity included. `None` for a temperature that is not above zero, and for functions that are zero.
    pub fn chromaticity(&self, temperature_k: f64) -> Option<Chromaticity> {
        if temperature_k.is_nan() || temperature_k <= 0.0 {
            return None;
        }
        Tristimulus::from(self.sums(1.0 / temperature_k).0).chromaticity()
    }

    /// X, Y, Z in a common unit that depends on β alone, and their derivatives to β in the same unit.
    fn sums(&self, beta_per_k: f64) -> ([f64; 3], [f64; 3]) {
        let exponent_nm = SECOND_RADIATION_CONSTANT_NM_K * beta_per_k;
        // The smallest exponent is taken out of all, so that cold bodies do not underflow. Its derivative moves all three alike, and
        // with them no chromaticity, so it is left out.
        let least = exponent_nm / self.longest_nm;
        let (mut sums, mut slopes) = ([0.0; 3], [0.0; 3]);
        for node in &self.nodes {
            let xi = exponent_nm / node.wavelength_nm;
            let (g, slope) = bose(xi, least);
            let slope = slope * SECOND_RADIATION_CONSTANT_NM_K / node.wavelength_nm;
            for i in 0..3 {
                sums[i] += node.weights[i] * g;
                slopes[i] += node.weights[i] * slope;
            }
        }
        (sums, slopes)
    }

    /// The point at β, K⁻¹.
    pub(super) fn point(&self, beta_per_k: f64) -> PlanckianPoint {
        let ([x, y, z], [dx, dy, dz]) = self.sums(beta_per_k);
        // u = 4X/d, v = 6Y/d, d = X + 15Y + 3Z.
        let (d, dd) = (x + 15.0 * y + 3.0 * z, dx + 15.0 * dy + 3.0 * dz);
        let quotient = |a: f64, da: f64| (a / d, (da - a / d * dd) / d);
        let ((u, du), (v, dv)) = (quotient(4.0 * x, 4.0 * dx), quotient(6.0 * y, 6.0 * dy));
        PlanckianPoint { uv: [u, v], duv_dbeta: [du, dv] }
    }
}

impl Node {
    fn at(wavelength_nm: f64, weight: f64, matching: &[Factor; 3]) -> Self {
        let scale = weight * (560.0 / wavelength_nm).powi(4);
        Self { wavelength_nm, weights: matching.each_ref().map(|function| function.at(wavelength_nm) * scale) }
    }
}

/// `g(ξ) e^least` and `g′(ξ) e^least`.
fn bose(xi: f64, least: f64) -> (f64, f64) {
    if xi < SMALL {
        // Bernoulli's numbers; the next terms are below 1e-16.
        let square = xi * xi;
        let g = 1.0 - xi / 2.0 + square / 12.0 - square * square / 720.0;
        let slope = -0.5 + xi / 6.0 - xi * square / 180.0 + xi * square * square / 5040.0;
        return (g * least.exp(), slope * least.exp());
    }
    let one_less = -(-xi).exp_m1();
    let g = xi * (least - xi).exp() / one_less;
    // 1 − ξ − g with the g that is not scaled.
    let bracket = 1.0 - xi - xi * (1.0 - one_less) / one_less;
    (g, g / xi * bracket)
}
