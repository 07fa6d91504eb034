//! What a fitted curve is worth in use: f1′, mismatch correction factors, luminous responsivities.
//!
//! ```text
//! f1′ = ∫|c s − V| dλ / ∫V dλ        ∂f1′/∂sₖ = ∫ sgn(c s − V) (c hatₖ + s ∂c/∂sₖ) dλ / ∫V dλ        c = ∫S_A V / ∫S_A s
//! F*  = ∫S_A s ∫S_Z V / (∫S_A V ∫S_Z s)                       ∂F*/∂sₖ = F* (aₖ / ∫S_A s − zₖ / ∫S_Z s)
//! s_v = ∫S_Z s / (K_m ∫S_Z V)                                 ∂s_v/∂sₖ = zₖ / (K_m ∫S_Z V)
//! ```
//!
//! aₖ, zₖ: weights of the nodes under illuminant A and under the lamp. Each is propagated linearly and checked by [`DRAWS`] draws of the curve. f1′
//! is taken over the nodes of the curve within 360 nm to 830 nm; noise can only make it larger, which the mean of the draws shows.

use crate::calibration::{Exposures, FittedCurve, propagation};
use crate::characterization::campaign::normal;
use crate::characterization::spectral_mismatch::{Wavelengths, correction_factor, mismatch_index};
use crate::quantity::constants::K_M_LM_W;
use crate::spectrum::{Density, Factor, SpectrumError, library};

/// Draws of the Monte Carlo check.
pub const DRAWS: usize = 1000;
/// Name of the light that meters are adjusted with.
const A: &str = "A";
/// Share of a lamp's reading from beyond the nodes that is told.
const TOLD_BEYOND: f64 = 1e-4;
/// Step of the sums that stand for the integral of |c s − V| in draws and derivatives, nm.
const STEP_NM: f64 = 0.25;
/// Keeps the random numbers of the draws apart from those of the readings, whose streams begin with the number of a channel.
const DRAWS_STREAM: u64 = u64::MAX;

/// A quantity that follows from the curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Propagated {
    /// What it is: "f1′", "F* for D65".
    pub name: String,
    /// Its unit per unit of the curve's; `1` for a number.
    pub unit: String,
    /// Its value.
    pub value: f64,
    /// Standard uncertainty by linear propagation.
    pub standard_uncertainty: f64,
    /// Standard deviation of the draws.
    pub monte_carlo: f64,
    /// Mean of the draws.
    pub monte_carlo_mean: f64,
    /// The value of the true curve, if it is known.
    pub truth: Option<f64>,
    /// Its derivative with respect to the curve at each node.
    pub gradient: Vec<f64>,
}

/// A quantity as a function of the curve at its nodes.
type OfNodes<'a> = Box<dyn Fn(&[f64]) -> f64 + 'a>;

/// A quantity to be propagated: of a curve as nodes, and its derivative there.
struct Quantity<'a> {
    name: String,
    of_nodes: OfNodes<'a>,
    gradient: Vec<f64>,
    value: f64,
    truth: Option<f64>,
}

/// f1′, and for each lamp F* and the luminous responsivity; those that the curve does not define (it sees nothing of a lamp) are left out.
///
/// # Errors
/// Spectra that leave the range of numbers.
pub fn uses(
    nodes_nm: &[f64],
    curve: &FittedCurve,
    truth: Option<&Factor>,
    lamps: &[(String, Density)],
    scale: f64,
    seed: u64,
) -> Result<Vec<Propagated>, SpectrumError> {
    let fitted = super::factor(nodes_nm, &curve.values)?;
    let v = library::v_lambda();
    let a = Density::illuminant_a();
    let mut spectra = vec![(A.to_owned(), a.clone())];
    spectra.extend(lamps.iter().cloned());
    let weights = Exposures::new(nodes_nm, &spectra)?;
    let rows: Vec<Vec<f64>> = (0..weights.len()).map(|i| weights.row(i)).collect();
    let dot = |w: &[f64], s: &[f64]| w.iter().zip(s).map(|(w, s)| w * s).sum::<f64>();
    let (from_nm, to_nm) = (nodes_nm[0].max(360.0), nodes_nm[nodes_nm.len() - 1].min(830.0));
    let over = Wavelengths::Integral { from_nm, to_nm };
    let grid = Grid::new(nodes_nm, &rows[0], &a, &v, over);
    let index_of = |s: &Factor| mismatch_index(s, &v, &a, over).ok();
    let mut quantities = Vec::new();
    if let (Some(grid), Some(value)) = (&grid, index_of(&fitted)) {
        quantities.push(Quantity {
            name: "f1′".to_owned(),
            of_nodes: Box::new(|s| grid.index(s)),
            gradient: grid.gradient(&curve.values),
            value,
            truth: truth.and_then(index_of),
        });
    }
    for ((name, lamp), z) in spectra.iter().zip(&rows).skip(1) {
        let (by_a, by_z) = (dot(&rows[0], &curve.values), dot(z, &curve.values));
        // For the light that the meter is adjusted with the factor is 1, whatever the curve.
        if let (Ok(value), true) = (correction_factor(&fitted, &v, lamp, &a), z != &rows[0]) {
            let ratio = lamp.integral(&[&v]) / a.integral(&[&v]);
            let row_a = &rows[0];
            quantities.push(Quantity {
                name: format!("F* for {name}"),
                of_nodes: Box::new(move |s| ratio * dot(row_a, s) / dot(z, s)),
                gradient: row_a.iter().zip(z).map(|(a, z)| value * (a / by_a - z / by_z)).collect(),
                value,
                truth: truth.and_then(|t| correction_factor(t, &v, lamp, &a).ok()),
            });
        }
        let lumens = K_M_LM_W * lamp.integral(&[&v]);
        if lumens > 0.0 && lumens.is_finite() {
            quantities.push(Quantity {
                name: format!("s_v for {name}"),
                of_nodes: Box::new(move |s| dot(z, s) / lumens),
                gradient: z.iter().map(|z| z / lumens).collect(),
                value: by_z / lumens,
                truth: truth.map(|t| lamp.integral(&[t]) / lumens),
            });
        }
    }
    Ok(drawn(curve, quantities, scale, seed))
}

/// Lamps under which the true curve of a channel reads something from beyond the nodes, in words: F* and s_v do not hold that, nor does their
/// uncertainty. The light of A counts for the F* of every lamp.
///
/// # Errors
/// Nodes that are no band.
pub fn beyond_nodes(channel: &str, nodes_nm: &[f64], truth: &Factor, lamps: &[(String, Density)]) -> Result<Vec<String>, SpectrumError> {
    let (from, to) = (nodes_nm[0], nodes_nm[nodes_nm.len() - 1]);
    let within = Factor::band(from, to, 1.0)?;
    let share = |lamp: &Density| 1.0 - lamp.integral(&[truth, &within]) / lamp.integral(&[truth]);
    let of = |(name, lamp): &(String, Density)| {
        let share = share(lamp);
        (share > TOLD_BEYOND).then(|| {
            format!(
                "{channel}: {:.2} % of the reading under {name} comes from outside of {from} nm to {to} nm, which {} and their uncertainties leave out; widen `curve`",
                100.0 * share,
                if name == A { "the F* of all lamps" } else { "its F* and s_v" }
            )
        })
    };
    let adjusted_with = (A.to_owned(), Density::illuminant_a());
    let others = lamps.iter().filter(|(name, _)| name != A);
    Ok(others.chain((!lamps.is_empty()).then_some(&adjusted_with)).filter_map(of).collect())
}

/// Linear propagation and draws of all quantities.
fn drawn(curve: &FittedCurve, quantities: Vec<Quantity>, scale: f64, seed: u64) -> Vec<Propagated> {
    let sampler = propagation::Sampler::new(curve, scale);
    let mut sums = vec![(0.0, 0.0); quantities.len()];
    for draw in 0..DRAWS as u64 {
        let normals: Vec<f64> = (0..sampler.numbers() as u64).map(|j| normal(seed, &[DRAWS_STREAM, draw, j])).collect();
        let s = sampler.curve(&normals);
        for (q, sum) in quantities.iter().zip(&mut sums) {
            // About the value itself, so that nothing cancels.
            let apart = (q.of_nodes)(&s) - q.value;
            sum.0 += apart;
            sum.1 += apart * apart;
        }
    }
    let n = DRAWS as f64;
    quantities
        .into_iter()
        .zip(sums)
        .map(|(q, (sum, square))| Propagated {
            unit: if q.name.starts_with("s_v") { "per lux".to_owned() } else { "1".to_owned() },
            standard_uncertainty: propagation::standard_uncertainty(curve, &q.gradient, scale),
            monte_carlo: ((square - sum * sum / n) / (n - 1.0)).max(0.0).sqrt(),
            monte_carlo_mean: q.value + sum / n,
            name: q.name,
            value: q.value,
            truth: q.truth,
            gradient: q.gradient,
        })
        .collect()
}

/// f1′ by sums over a fine grid.
struct Grid {
    /// For each point: the node below, the share of the node above, V.
    points: Vec<(usize, f64, f64)>,
    adjusting: Vec<f64>,
    target: f64,
    area: f64,
}

impl Grid {
    fn new(nodes: &[f64], weights_a: &[f64], a: &Density, v: &Factor, over: Wavelengths) -> Option<Grid> {
        let Wavelengths::Integral { from_nm, to_nm } = over else { return None };
        if from_nm >= to_nm {
            return None;
        }
        let target = over.of(a).ok()?.integral(&[v]);
        let count = ((to_nm - from_nm) / STEP_NM).floor() as usize;
        let points: Vec<(usize, f64, f64)> = (0..count)
            .map(|i| {
                let nm = from_nm + STEP_NM * (i as f64 + 0.5);
                let below = nodes.partition_point(|node| *node <= nm).clamp(1, nodes.len() - 1) - 1;
                (below, (nm - nodes[below]) / (nodes[below + 1] - nodes[below]), v.at(nm))
            })
            .collect();
        let area = points.iter().map(|p| p.2).sum();
        (area > 0.0 && target > 0.0).then(|| Grid { points, adjusting: weights_a.to_vec(), target, area })
    }

    fn adjustment(&self, s: &[f64]) -> f64 {
        self.target / self.adjusting.iter().zip(s).map(|(a, s)| a * s).sum::<f64>()
    }

    fn index(&self, s: &[f64]) -> f64 {
        let c = self.adjustment(s);
        self.points.iter().map(|&(k, share, v)| (c * ((1.0 - share) * s[k] + share * s[k + 1]) - v).abs()).sum::<f64>() / self.area
    }

    fn gradient(&self, s: &[f64]) -> Vec<f64> {
        let c = self.adjustment(s);
        let mut direct = vec![0.0; s.len()];
        let mut through_scale = 0.0;
        for &(k, share, v) in &self.points {
            let at = (1.0 - share) * s[k] + share * s[k + 1];
            let sign = (c * at - v).signum();
            direct[k] += sign * c * (1.0 - share);
            direct[k + 1] += sign * c * share;
            through_scale += sign * at;
        }
        let d_c = -c * c / self.target;
        direct.iter().zip(&self.adjusting).map(|(d, a)| (d + through_scale * d_c * a) / self.area).collect()
    }
}
