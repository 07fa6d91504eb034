//! Exposures, true curves and noisy readings of the sweeps.

use super::super::{Point, Reference};
use super::{Expected, FitProblem};
use crate::calibration::{Exposures, PriorKind, Readings};
use crate::characterization::campaign::normal;
use crate::spectrum::{Density, SpectrumError};

/// Where curves are sought, nm.
pub(super) const FROM_TO_NM: (f64, f64) = (380.0, 780.0);
/// σ of a Gaussian over its full width at half maximum.
const SIGMA_PER_FWHM: f64 = 0.424_660_900_144_009_5;

/// Nodes from 380 nm to 780 nm.
pub(super) fn nodes(step_nm: f64) -> Vec<f64> {
    let count = ((FROM_TO_NM.1 - FROM_TO_NM.0) / step_nm).round() as u32;
    (0..=count).map(|k| FROM_TO_NM.0 + step_nm * f64::from(k)).collect()
}

fn bell(nm: f64, centre_nm: f64, fwhm_nm: f64) -> f64 {
    (-0.5 * ((nm - centre_nm) / (SIGMA_PER_FWHM * fwhm_nm)).powi(2)).exp()
}

/// A meter's head: like V(λ), with a shoulder and a foot in the red, 0.28 A/W at its peak.
pub(super) fn lux_meter(nodes: &[f64]) -> Vec<f64> {
    nodes.iter().map(|&nm| 0.28 * (0.92 * bell(nm, 556.0, 104.0) + 0.06 * bell(nm, 610.0, 40.0) + 0.008 * bell(nm, 720.0, 80.0))).collect()
}

/// Two bands of a filter with nothing between and beside them.
pub(super) fn two_bands(nodes: &[f64]) -> Vec<f64> {
    nodes.iter().map(|&nm| 0.2 * bell(nm, 480.0, 50.0) + 0.35 * bell(nm, 620.0, 60.0)).collect()
}

/// `count` Gaussian spectra of unit power with these widths, evenly from 380 nm to 780 nm.
pub(super) fn sources(nodes: &[f64], count: usize, fwhm_nm: f64) -> Result<Exposures, SpectrumError> {
    let spacing_nm = (FROM_TO_NM.1 - FROM_TO_NM.0) / (count.max(2) - 1) as f64;
    let spectra = (0..count).map(|i| {
        let nm = FROM_TO_NM.0 + spacing_nm * i as f64;
        Ok((format!("{nm:.1} nm"), Density::gaussian(1.0, nm, SIGMA_PER_FWHM * fwhm_nm)?))
    });
    Exposures::new(nodes, &spectra.collect::<Result<Vec<_>, SpectrumError>>()?)
}

/// Readings of a curve with noise that is this share of the largest.
pub(super) fn readings(exposures: &Exposures, truth: &[f64], noise: f64, seed: u64) -> Readings {
    let exact = exposures.expected(truth);
    let u = noise * exact.iter().fold(0.0f64, |most, y| most.max(y.abs()));
    let values = exact.iter().enumerate().map(|(i, y)| y + u * normal(seed, &[i as u64])).collect();
    Readings { channel: "R".to_owned(), values, standard_uncertainties: vec![u; exact.len()] }
}

/// Sets of readings of one channel; without noise one set says all.
pub(super) fn sets(exposures: &Exposures, truth: &[f64], noise: f64, count: u64) -> Vec<Vec<Readings>> {
    let count = if noise == 0.0 { 1 } else { count };
    (1..=count).map(|seed| vec![readings(exposures, truth, noise, seed)]).collect()
}

/// A point of one channel that must find this curve.
pub(super) fn point(series: &'static str, parameter: f64, exposures: Exposures, sets: Vec<Vec<Readings>>, truth: Vec<f64>) -> Point {
    of(series, parameter, FitProblem { exposures, sets, prior: PriorKind::Smooth, expected: Expected::Curves(vec![truth]) })
}

/// A point of any problem.
pub(super) fn of(series: &'static str, parameter: f64, problem: FitProblem) -> Point {
    Point::new(series, parameter, String::new(), Reference::Fit(Box::new(problem)))
}

/// The points; spectra that cannot be made leave a point without readings, which is wrong, so that it is seen.
pub(super) fn made(points: Result<Vec<Point>, SpectrumError>) -> Vec<Point> {
    points.unwrap_or_else(|_| {
        let expected = Expected::Curves(Vec::new());
        let none =
            FitProblem { exposures: Exposures::from_weights(&[], Vec::new(), &[]), sets: Vec::new(), prior: PriorKind::Smooth, expected };
        vec![of("spectra that cannot be made", f64::NAN, none)]
    })
}
