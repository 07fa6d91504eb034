//! What is plausible before any reading: curves that are smooth over an unknown length, of unknown scale.
//!
//! ```text
//! cov s(λ), s(λ′) = a² k(|λ − λ′| / ℓ)        Matérn:  ν = 3/2, 5/2, 7/2, 9/2
//! camera:           a² (Σⱼ bⱼ(λ) bⱼ(λ′) + q² k(|λ − λ′| / ℓ))
//! envelope:         a² e(λ) e(λ′) k(|λ − λ′| / ℓ)
//! ```
//!
//! | symbol | meaning | how it is found |
//! |---|---|---|
//! | a | scale of the curve | from the readings (`evidence.rs`) |
//! | ℓ, ν | length over which the curve is smooth, nm, and how smooth | from the readings |
//! | bⱼ | the first component of measured camera sensitivities | a table with pedigree |
//! | q | share of a camera's curve that the components do not hold | from the readings, 0.1 at least |
//! | e(λ) | square root of a first fit over its peak: where a curve is small its ripples are, too | from a first fit |
//!
//! A Matérn curve of ν = p + 1/2 has p derivatives. Second differences, the smoothness of classic regularisation, are the integrated Wiener process;
//! over the reference problems the readings spoke against it each time, so it serves the classic rules only.
//!
//! Source: Rasmussen, Williams, Gaussian Processes for Machine Learning (2006), 4.2.

use nalgebra::DMatrix;

use super::low_rank;
use crate::spectrum::Factor;
use crate::spectrum::library::{self, LookupError};

/// Which family of curves is plausible.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum PriorKind {
    /// Smooth over an unknown length.
    #[default]
    Smooth,
    /// Like the sensitivities of a camera: `components[channel]` are the leading components on the nodes, each a curve; of several the first counts.
    Camera {
        /// `components[channel][component][node]`.
        components: Vec<Vec<Vec<f64>>>,
    },
}

impl PriorKind {
    /// Cameras with channels for red, green and blue, in this order: the components of the library on these nodes, nm. Beyond 400 nm and 700 nm, where
    /// the components end, they fall like a bell curve.
    ///
    /// # Errors
    /// If the table of components cannot be read, which the tests of the library exclude.
    pub fn camera(nodes_nm: &[f64]) -> Result<PriorKind, LookupError> {
        let of_channel = |channel: &str| {
            let of_component = |i: usize| {
                let curve = library::factor(&format!("Camera components {channel} {i}"))?;
                Ok(nodes_nm.iter().map(|nm| beyond_table(&curve, *nm)).collect())
            };
            (1..=CAMERA_COMPONENTS).map(of_component).collect::<Result<Vec<Vec<f64>>, LookupError>>()
        };
        Ok(PriorKind::Camera { components: ["red", "green", "blue"].into_iter().map(of_channel).collect::<Result<_, _>>()? })
    }
}

/// The value of a component, which ends in a bell curve at either side.
fn beyond_table(curve: &Factor, nm: f64) -> f64 {
    let (from, to) = COMPONENTS_NM;
    if nm < from {
        curve.at(from) * (-((from - nm) / FALLS_NM.0).powi(2)).exp()
    } else if nm > to {
        curve.at(to) * (-((nm - to) / FALLS_NM.1).powi(2)).exp()
    } else {
        curve.at(nm)
    }
}

/// How many derivatives a curve has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Smoothness {
    /// ν = 3/2: curves with corners.
    One,
    /// ν = 5/2.
    Two,
    /// ν = 7/2.
    Three,
    /// ν = 9/2.
    Four,
}

impl Smoothness {
    /// All of them.
    pub const ALL: [Smoothness; 4] = [Smoothness::Four, Smoothness::Three, Smoothness::Two, Smoothness::One];

    /// Correlation at a distance of `d` lengths.
    #[must_use]
    pub fn correlation(self, d: f64) -> f64 {
        let (s, polynomial): (f64, fn(f64) -> f64) = match self {
            Smoothness::One => (3f64.sqrt() * d, |s| 1.0 + s),
            Smoothness::Two => (5f64.sqrt() * d, |s| 1.0 + s + s * s / 3.0),
            Smoothness::Three => (7f64.sqrt() * d, |s| 1.0 + s + 0.4 * s * s + s.powi(3) / 15.0),
            Smoothness::Four => (3.0 * d, |s| 1.0 + s + 3.0 * s * s / 7.0 + 2.0 * s.powi(3) / 21.0 + s.powi(4) / 105.0),
        };
        polynomial(s) * (-s).exp()
    }
}

/// A member of the family, up to its scale: `cov = a² L Lᵀ`.
#[derive(Clone, Debug)]
pub(super) struct Candidate {
    /// Its name in reports.
    pub(super) name: String,
    /// Length, nm.
    pub(super) length_nm: f64,
    /// `factors[channel]`, or one for all of them.
    pub(super) factors: Vec<DMatrix<f64>>,
    /// Variance at each node that the factors miss, in units of a².
    pub(super) missing: Vec<f64>,
}

impl Candidate {
    pub(super) fn factor(&self, channel: usize) -> &DMatrix<f64> {
        &self.factors[channel.min(self.factors.len() - 1)]
    }
}

/// Share of the trace that a factor may miss where readings have no noise: what is left then is the rounding of the covariance itself.
const LEFT_OUT: f64 = 1e-17;
/// And at most, however noisy the readings are.
const MOST_LEFT_OUT: f64 = 1e-9;
/// Components of a camera's curve. With one the reference problems of a camera came out best where readings have no noise, and with two by a tenth better where
/// they have; with more of them the bands were too narrow.
const CAMERA_COMPONENTS: usize = 1;
/// Where the components of cameras begin and end, nm.
const COMPONENTS_NM: (f64, f64) = (400.0, 700.0);
/// Distances beyond these ends at which they have fallen to 1/e, nm: ultraviolet and infrared filters are steep.
const FALLS_NM: (f64, f64) = (10.0, 15.0);
/// Shares of a camera's curve that its components do not hold.
const BEYOND_COMPONENTS: [f64; 4] = [0.1, 0.2, 0.4, 0.8];
/// Lengths of what they do not hold, nm.
const CAMERA_LENGTHS_NM: [f64; 5] = [20.0, 26.0, 34.0, 44.0, 57.0];

/// Lengths from two steps of the nodes to twice their range, `per_e` of them per factor e.
pub(super) fn lengths_nm(nodes_nm: &[f64], per_e: f64) -> Vec<f64> {
    let (Some(first), Some(last)) = (nodes_nm.first(), nodes_nm.last()) else { return Vec::new() };
    let step = nodes_nm.windows(2).map(|w| w[1] - w[0]).fold(f64::INFINITY, f64::min);
    let (low, high) = ((2.0 * step).ln(), (2.0 * (last - first)).ln());
    let count = ((high - low) * per_e).ceil().max(1.0) as usize;
    (0..=count).map(|i| (low + (high - low) * i as f64 / count as f64).exp()).collect()
}

/// Share of the trace that a factor may miss where readings have this relative uncertainty: a hundredth of the noise and less.
pub(super) fn left_out(relative_uncertainty: f64) -> f64 {
    (1e-5 * relative_uncertainty.powi(2)).clamp(LEFT_OUT, MOST_LEFT_OUT)
}

/// Curves of one smoothness and length; the factor may miss `left_out` of the trace.
pub(super) fn smooth(nodes_nm: &[f64], smoothness: Smoothness, length_nm: f64, left_out: f64) -> Candidate {
    let k = |i: usize, j: usize| smoothness.correlation((nodes_nm[i] - nodes_nm[j]).abs() / length_nm);
    let name = match smoothness {
        Smoothness::One => "Matérn 3/2",
        Smoothness::Two => "Matérn 5/2",
        Smoothness::Three => "Matérn 7/2",
        Smoothness::Four => "Matérn 9/2",
    };
    let low_rank::Factored { columns, missing } = low_rank::factor(nodes_nm.len(), &k, left_out);
    Candidate { name: name.to_owned(), length_nm, factors: vec![columns], missing }
}

/// Cameras: components and what they do not hold.
pub(super) fn cameras(nodes_nm: &[f64], components: &[Vec<Vec<f64>>], left_out: f64) -> Vec<Candidate> {
    let mut found = Vec::new();
    for length_nm in CAMERA_LENGTHS_NM {
        let rest = smooth(nodes_nm, Smoothness::Two, length_nm, left_out);
        for beyond in BEYOND_COMPONENTS {
            let factors = components
                .iter()
                .map(|of_channel| {
                    let of_channel = &of_channel[..of_channel.len().min(CAMERA_COMPONENTS)];
                    let strength = |k: usize| of_channel.iter().map(|b| b[k] * b[k]).sum::<f64>();
                    let peak = (0..nodes_nm.len()).map(strength).fold(0.0, f64::max).sqrt();
                    let columns = of_channel.len();
                    let residual = rest.factor(0);
                    DMatrix::from_fn(nodes_nm.len(), columns + residual.ncols(), |k, j| {
                        if j < columns { of_channel[j][k] / peak } else { beyond * residual[(k, j - columns)] }
                    })
                })
                .collect();
            let missing = rest.missing.iter().map(|m| beyond * beyond * m).collect();
            found.push(Candidate { name: format!("camera components, {beyond} beyond them"), length_nm, factors, missing });
        }
    }
    found
}

/// Curves whose ripples follow an envelope; the first `untouched` columns, components of a camera, do not.
pub(super) fn enveloped(candidate: &Candidate, envelopes: &[Vec<f64>], untouched: usize) -> Candidate {
    let factors = envelopes
        .iter()
        .enumerate()
        .map(|(channel, envelope)| {
            let plain = candidate.factor(channel);
            DMatrix::from_fn(plain.nrows(), plain.ncols(), |k, j| if j < untouched { plain[(k, j)] } else { envelope[k] * plain[(k, j)] })
        })
        .collect();
    // The envelope is one at most, or hardly more: what is missing stays within what it was.
    Candidate { name: candidate.name.clone(), length_nm: candidate.length_nm, factors, missing: candidate.missing.clone() }
}

/// How many leading columns of a family's factors are components.
pub(super) fn components_of(kind: &PriorKind) -> usize {
    match kind {
        PriorKind::Smooth => 0,
        PriorKind::Camera { components } => components.first().map_or(0, |c| c.len().min(CAMERA_COMPONENTS)),
    }
}

/// Second differences as a prior: the integrated Wiener process from either end, and a straight line as large as it.
pub(super) fn second_differences(nodes_nm: &[f64]) -> Candidate {
    let (first, last) = (nodes_nm[0], nodes_nm[nodes_nm.len() - 1]);
    let at = |i: usize| (nodes_nm[i] - first) / (last - first);
    let wiener = |x: f64, y: f64| {
        let (low, high) = (x.min(y), x.max(y));
        low.powi(3) / 3.0 + low * low * (high - low) / 2.0
    };
    let k = |i: usize, j: usize| {
        let (x, y) = (at(i), at(j));
        // A line a thousand times as large as what bends: nearly free, as in the classic penalty.
        wiener(x, y) + wiener(1.0 - x, 1.0 - y) + 1e3 * (1.0 + (2.0 * x - 1.0) * (2.0 * y - 1.0))
    };
    let low_rank::Factored { columns, missing } = low_rank::factor(nodes_nm.len(), &k, LEFT_OUT);
    Candidate { name: "second differences".to_owned(), length_nm: last - first, factors: vec![columns], missing }
}
