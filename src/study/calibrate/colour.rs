//! How far the colours of a calibrated camera are from those that a person sees, with uncertainty.
//!
//! ```text
//! d_pc = ∫ S ρ_p s_c dλ        M = argmin Σ_p |M d_p − XYZ_p|²        q = mean over p of ΔE*ab(M d_p, XYZ_p)
//! u²(q) = Σ_c Σ_j ((q(s_c + f_cj) − q(s_c − f_cj)) / 2)²               f_cj: columns of a root of the covariance of channel c
//! ```
//!
//! | symbol | meaning |
//! |---|---|
//! | S | spectrum of a lamp of the file |
//! | ρ_p | reflectances of the 24 patches of a ColorChecker |
//! | s_c | fitted curves of the three channels |
//! | M | the 3 × 3 matrix from signals to tristimulus values that suits the patches best |
//! | XYZ_p | tristimulus values for the CIE 1931 observer, beside a white that reflects everything |
//!
//! A camera whose curves are a mixture of the observer's has no error; others have one that no matrix removes. What all channels have in common, such as
//! the scale of the irradiance, cancels in M.

use super::CalibratedChannel;
use super::propagate::{DRAWS, Propagated};
use crate::calibration::{Exposures, propagation};
use crate::characterization::campaign::normal;
use crate::math::{DMat3, DVec3};
use crate::metrology::Moments;
use crate::observer::Matching;
use crate::observer::colour::{Lab, Tristimulus};
use crate::spectrum::{Density, SpectrumError, library};

/// The patches.
const CHART: &str = "ColorChecker";
/// Keeps the random numbers of these draws apart from others: the streams of channels begin here.
const DRAWS_STREAM: u64 = u64::MAX - 16;

/// A chart under a lamp.
struct Chart {
    /// Weights of the nodes, a patch each.
    rows: Vec<Vec<f64>>,
    seen: Vec<Tristimulus>,
    white: Tristimulus,
}

impl Chart {
    /// Under this lamp. `None` if an observer sees nothing of it.
    fn under(lamp: &Density, nodes_nm: &[f64]) -> Result<Option<Chart>, SpectrumError> {
        let matching = Matching::Cie1931.functions();
        let patches = library::set(CHART).unwrap_or_default();
        let mut spectra = Vec::with_capacity(patches.len());
        for patch in patches {
            if let Ok(reflectance) = library::factor(&patch.name) {
                spectra.push((patch.name.clone(), lamp.filtered(&reflectance)));
            }
        }
        let weights = Exposures::new(nodes_nm, &spectra)?;
        let white = Tristimulus::of(lamp, &matching);
        let seen = spectra.iter().map(|(_, light)| Tristimulus::of(light, &matching)).collect();
        let rows = (0..weights.len()).map(|i| weights.row(i)).collect();
        Ok((white.y > 0.0).then_some(Chart { rows, seen, white }))
    }

    /// Mean ΔE*ab of the patches for the curves of three channels. `None` if their signals are not three independent ones.
    fn error(&self, curves: [&[f64]; 3]) -> Option<f64> {
        let dot = |row: &[f64], s: &[f64]| row.iter().zip(s).map(|(w, s)| w * s).sum::<f64>();
        let signals: Vec<DVec3> = self.rows.iter().map(|row| DVec3::from_array(curves.map(|s| dot(row, s)))).collect();
        // Each channel in units of its own size, so that the sums are of one.
        let size = signals.iter().fold(DVec3::ZERO, |sum, d| sum + *d * *d);
        let unit = DVec3::ONE / DVec3::new(size.x.sqrt(), size.y.sqrt(), size.z.sqrt());
        let outer = |a: DVec3, b: DVec3| DMat3::from_cols(a * b.x, a * b.y, a * b.z);
        let (mut own, mut cross) = (DMat3::ZERO, DMat3::ZERO);
        for (d, seen) in signals.iter().zip(&self.seen) {
            own += outer(*d * unit, *d * unit);
            cross += outer(DVec3::from_array(seen.to_array()), *d * unit);
        }
        let matrix = cross * own.inverse();
        let mut sum = 0.0;
        for (d, seen) in signals.iter().zip(&self.seen) {
            let [x, y, z] = (matrix * (*d * unit)).to_array();
            sum += Lab::of(&Tristimulus { x, y, z }, &self.white)?.distance(&Lab::of(seen, &self.white)?);
        }
        let mean = sum / signals.len() as f64;
        mean.is_finite().then_some(mean)
    }
}

/// The mean colour error of a camera of three channels under each lamp; nothing of other sensors.
///
/// # Errors
/// Spectra that leave the range of numbers.
pub fn colour_errors(
    nodes_nm: &[f64],
    channels: &[CalibratedChannel],
    lamps: &[(String, Density)],
    seed: u64,
) -> Result<Vec<Propagated>, SpectrumError> {
    let [red, green, blue] = channels else { return Ok(Vec::new()) };
    let of = [red, green, blue];
    let samplers = of.map(|channel| propagation::Sampler::new(&channel.curve, 0.0));
    let fitted = of.map(|channel| channel.curve.values.as_slice());
    let mut found = Vec::new();
    for (name, lamp) in lamps {
        let Some(chart) = Chart::under(lamp, nodes_nm)? else { continue };
        let Some(value) = chart.error(fitted) else { continue };
        let mut variance = 0.0;
        for (c, sampler) in samplers.iter().enumerate() {
            for j in 0..sampler.numbers() - 1 {
                let moved = |by: f64| {
                    let mut normals = vec![0.0; j + 1];
                    normals[j] = by;
                    let curve = sampler.curve(&normals);
                    let mut curves = fitted;
                    curves[c] = &curve;
                    chart.error(curves).unwrap_or(value)
                };
                variance += (0.5 * (moved(1.0) - moved(-1.0))).powi(2);
            }
        }
        let draws: Vec<f64> = (0..DRAWS as u64)
            .filter_map(|draw| {
                let curves: [Vec<f64>; 3] = [0, 1, 2].map(|c| {
                    let stream = DRAWS_STREAM + c as u64;
                    let normals: Vec<f64> = (0..samplers[c].numbers() as u64).map(|j| normal(seed, &[stream, draw, j])).collect();
                    samplers[c].curve(&normals)
                });
                chart.error([&curves[0], &curves[1], &curves[2]])
            })
            .collect();
        let moments: Moments = draws.iter().copied().collect();
        let truth = match of.map(|channel| channel.truth.as_deref()) {
            [Some(r), Some(g), Some(b)] => chart.error([r, g, b]),
            _ => None,
        };
        found.push(Propagated {
            name: format!("mean ΔE*ab under {name}"),
            unit: "1".to_owned(),
            value,
            standard_uncertainty: variance.sqrt(),
            monte_carlo: moments.standard_deviation().unwrap_or(0.0),
            monte_carlo_mean: moments.mean().unwrap_or(value),
            truth,
            gradient: Vec::new(),
        });
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_observer_as_camera_has_no_error_and_a_mixture_of_its_curves_neither() {
        let nodes: Vec<f64> = (0..=90).map(|k| 380.0 + 5.0 * f64::from(k)).collect();
        let chart = Chart::under(&library::density("D65").unwrap(), &nodes).unwrap().unwrap();
        assert_eq!(chart.rows.len(), 24);
        let curves = Matching::Cie1931.functions().map(|f| nodes.iter().map(|nm| f.at(*nm)).collect::<Vec<f64>>());
        let [x, y, z] = &curves;
        // What 5 nm of the nodes and the ends of the band leave.
        assert!(chart.error([x, y, z]).unwrap() < 0.02);
        let mixed = |a: f64, b: f64, c: f64| (0..nodes.len()).map(|k| a * x[k] + b * y[k] + c * z[k]).collect::<Vec<f64>>();
        let (r, g, b) = (mixed(3.0, -1.0, -0.5), mixed(-1.0, 2.0, 0.04), mixed(0.06, -0.2, 1e3));
        assert!(chart.error([&r, &g, &b]).unwrap() < 0.02);
        // Curves that a person does not have: V in place of x̄ leaves two independent ones.
        assert!(chart.error([y, y, z]).is_none_or(|e| e > 5.0));
        let shifted: Vec<f64> = (0..nodes.len()).map(|k| x[(k + 4).min(nodes.len() - 1)]).collect();
        assert!(chart.error([&shifted, y, z]).unwrap() > 1.0);
    }
}
