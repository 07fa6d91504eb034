//! Curves of few parameters: sums of bell curves, a filter before a detector, a visual pigment.
//!
//! ```text
//! SumOfGaussians     s = Σⱼ aⱼ exp(−½ ((λ − cⱼ)/σⱼ)²)                      aⱼ, cⱼ, FWHMⱼ = 2.355 σⱼ
//! FilterOnDetector   s = a · 2^(−|2 (λ − c)/w|^q) · d(λ)/max d               a, c, w, q
//! VisualPigment      s = a · (λ/λ_max) · (1 − 10^(−D S(λ))) / (1 − 10^(−D))     a, λ_max, and D on request
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | a | height | that of the curve |
//! | c, w | centre and full width at half maximum of a band | nm |
//! | q | steepness of its edges: 2 is a bell curve, ∞ a rectangle | 1 |
//! | d | responsivity of the detector behind the filter, relative | 1 |
//! | S | absorbance of the pigment by its template, 1 at λ_max ([`crate::observer::template`]) | 1 |
//! | D | peak optical density of the pigment, decadic; towards 0 the absorptance is S | 1 |
//!
//! λ/λ_max: a pigment counts photons, and a watt of red light has more of them.
//!
//! Every parameter has a broad normal prior, so that one which the readings do not determine keeps a finite uncertainty and can be named. Heights, widths,
//! steepness and density are sought as logarithms: they are above zero.

use crate::observer::template::govardovskii;
use crate::spectrum::Factor;

/// FWHM over standard deviation of a bell curve, 2 √(2 ln 2).
const FWHM_PER_SIGMA: f64 = 2.354_820_045_030_949_4;
/// Most bell curves of a sum.
pub const MOST_GAUSSIANS: usize = 8;
/// Spread of the prior of a height: a factor e^4 either way.
const HEIGHT_SPREAD: f64 = 4.0;
/// Spread of the prior of a width.
const WIDTH_SPREAD: f64 = 1.5;
/// Mean of the prior of a pigment's maximum and its spread, nm.
const PIGMENT_NM: (f64, f64) = (500.0, 100.0);
/// Of the prior of a peak optical density: human cones have 0.3 to 0.5.
const DENSITY: (f64, f64) = (0.4, 1.0);
/// Of the prior of the steepness of a filter.
const STEEPNESS: (f64, f64) = (3.0, 1.0);

/// Peak optical density of a pigment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum OpticalDensity {
    /// Towards zero: the absorptance has the shape of the absorbance.
    #[default]
    Dilute,
    /// Known, above zero.
    Known(f64),
    /// To be found.
    Fitted,
}

/// What the curve is.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Model {
    /// Any smooth curve.
    #[default]
    Smooth,
    /// A sum of this many bell curves, 1 to [`MOST_GAUSSIANS`].
    SumOfGaussians(usize),
    /// A band of transmittance before a detector of this responsivity, of any scale.
    FilterOnDetector(Factor),
    /// A visual pigment by the template of Govardovskii and others.
    VisualPigment(OpticalDensity),
}

/// What is known of a parameter before any reading.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Rule {
    pub(super) name: String,
    /// Its unit; empty for that of the curve.
    pub(super) unit: &'static str,
    /// Whether its logarithm is sought.
    pub(super) logarithm: bool,
    /// Mean of the prior, and its spread: of the logarithm if that is sought.
    pub(super) mean: f64,
    pub(super) spread: f64,
}

impl Rule {
    fn linear(name: &str, unit: &'static str, mean: f64, spread: f64) -> Rule {
        Rule { name: name.to_owned(), unit, logarithm: false, mean, spread }
    }

    fn logarithmic(name: &str, unit: &'static str, mean: f64, spread: f64) -> Rule {
        Rule { name: name.to_owned(), unit, logarithm: true, mean: mean.ln(), spread }
    }
}

/// A model on the nodes of a curve.
pub(super) struct OnNodes<'a> {
    pub(super) model: &'a Model,
    nodes_nm: &'a [f64],
    /// The detector at the nodes, 1 at its largest.
    detector: Vec<f64>,
}

impl<'a> OnNodes<'a> {
    pub(super) fn new(model: &'a Model, nodes_nm: &'a [f64]) -> OnNodes<'a> {
        let detector: Vec<f64> = match model {
            Model::FilterOnDetector(detector) => nodes_nm.iter().map(|nm| detector.at(*nm).max(0.0)).collect(),
            _ => Vec::new(),
        };
        let most = detector.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        OnNodes { model, nodes_nm, detector: detector.iter().map(|d| d / most).collect() }
    }

    /// In words.
    pub(super) fn name(&self) -> String {
        match self.model {
            Model::Smooth => "smooth curve".to_owned(),
            Model::SumOfGaussians(1) => "one Gaussian".to_owned(),
            Model::SumOfGaussians(n) => format!("sum of {n} Gaussians"),
            Model::FilterOnDetector(_) => "filter before a detector".to_owned(),
            Model::VisualPigment(OpticalDensity::Dilute) => "visual pigment, dilute".to_owned(),
            Model::VisualPigment(OpticalDensity::Known(d)) => format!("visual pigment, peak optical density {d}"),
            Model::VisualPigment(OpticalDensity::Fitted) => "visual pigment of unknown optical density".to_owned(),
        }
    }

    /// The parameters; `height` is about that of the curve.
    pub(super) fn rules(&self, height: f64) -> Vec<Rule> {
        let (first, last) = (self.nodes_nm[0], self.nodes_nm[self.nodes_nm.len() - 1]);
        let (middle, range) = (0.5 * (first + last), last - first);
        let band = |which: &str| {
            [
                Rule::logarithmic(&format!("height{which}"), "", height, HEIGHT_SPREAD),
                Rule::linear(&format!("centre{which}"), "nm", middle, range),
                Rule::logarithmic(&format!("FWHM{which}"), "nm", 0.2 * range, WIDTH_SPREAD),
            ]
        };
        match self.model {
            Model::Smooth => Vec::new(),
            Model::SumOfGaussians(1) => band("").to_vec(),
            Model::SumOfGaussians(n) => (1..=*n).flat_map(|j| band(&format!(" {j}"))).collect(),
            Model::FilterOnDetector(_) => {
                let mut rules = band("").to_vec();
                rules.push(Rule::logarithmic("steepness", "1", STEEPNESS.0, STEEPNESS.1));
                rules
            }
            Model::VisualPigment(density) => {
                let mut rules =
                    vec![Rule::logarithmic("height", "", height, HEIGHT_SPREAD), Rule::linear("λ_max", "nm", PIGMENT_NM.0, PIGMENT_NM.1)];
                if *density == OpticalDensity::Fitted {
                    rules.push(Rule::logarithmic("peak optical density", "1", DENSITY.0, DENSITY.1));
                }
                rules
            }
        }
    }

    /// The curve at the nodes; `None` where the model is not defined.
    pub(super) fn curve(&self, p: &[f64]) -> Option<Vec<f64>> {
        let curve: Vec<f64> = match self.model {
            Model::Smooth => return None,
            Model::SumOfGaussians(_) => {
                let bell = |j: &[f64], nm: f64| (j[0] - 0.5 * ((nm - j[1]) * FWHM_PER_SIGMA / j[2].exp()).powi(2)).exp();
                self.nodes_nm.iter().map(|nm| p.chunks_exact(3).map(|j| bell(j, *nm)).sum()).collect()
            }
            Model::FilterOnDetector(_) => {
                let (steepness, width) = (p[3].exp(), p[2].exp());
                let band = |nm: f64| (p[0] - std::f64::consts::LN_2 * (2.0 * (nm - p[1]) / width).abs().powf(steepness)).exp();
                self.nodes_nm.iter().zip(&self.detector).map(|(nm, d)| d * band(*nm)).collect()
            }
            Model::VisualPigment(density) => {
                let optical = match density {
                    OpticalDensity::Dilute => None,
                    OpticalDensity::Known(d) => Some(*d),
                    OpticalDensity::Fitted => Some(p[2].exp()),
                };
                let at = |nm: &f64| {
                    let absorbance = govardovskii(p[1], *nm).ok()?;
                    // 1 − 10^(−x) without cancellation.
                    let absorbed = |d: f64| -(-d * std::f64::consts::LN_10).exp_m1();
                    let absorptance = optical.map_or(absorbance, |d| absorbed(d * absorbance) / absorbed(d));
                    Some(p[0].exp() * nm / p[1] * absorptance)
                };
                self.nodes_nm.iter().map(at).collect::<Option<_>>()?
            }
        };
        curve.iter().all(|s| s.is_finite()).then_some(curve)
    }

    /// Where searches start: always the same for the same smooth fit.
    pub(super) fn starts(&self, smooth: &[f64]) -> Vec<Vec<f64>> {
        match self.model {
            Model::Smooth => Vec::new(),
            Model::SumOfGaussians(n) => self.gaussian_starts(*n, smooth),
            Model::FilterOnDetector(_) => {
                let seen: Vec<f64> = smooth.iter().zip(&self.detector).map(|(s, d)| if *d > 0.01 { s / d } else { 0.0 }).collect();
                let (peak, centre, sigma) = self.moments(&seen);
                let start = |steepness: f64| vec![peak.ln(), centre, (FWHM_PER_SIGMA * sigma).ln(), steepness.ln()];
                [1.5, 2.0, 4.0, 8.0].map(start).to_vec()
            }
            Model::VisualPigment(density) => {
                let peak = smooth.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
                let densities: &[f64] = if *density == OpticalDensity::Fitted { &[0.1, 0.5] } else { &[0.0] };
                let at = |nm: u32| {
                    densities.iter().map(move |d| {
                        let mut start = vec![peak.ln(), f64::from(nm)];
                        start.extend((*d > 0.0).then(|| d.ln()));
                        start
                    })
                };
                (360..=680).step_by(40).flat_map(at).collect()
            }
        }
    }

    /// Peak, mean and standard deviation of a curve over wavelength.
    fn moments(&self, curve: &[f64]) -> (f64, f64, f64) {
        let mean_of = |f: &dyn Fn(f64) -> f64| {
            let (mut sum, mut weight) = (0.0, 0.0);
            for (w, s) in self.nodes_nm.windows(2).zip(curve.windows(2)) {
                let area = 0.5 * (s[0] + s[1]).max(0.0) * (w[1] - w[0]);
                sum += area * f(0.5 * (w[0] + w[1]));
                weight += area;
            }
            if weight > 0.0 { sum / weight } else { f(0.5 * (self.nodes_nm[0] + self.nodes_nm[self.nodes_nm.len() - 1])) }
        };
        let centre = mean_of(&|nm| nm);
        let step = self.nodes_nm[1] - self.nodes_nm[0];
        let sigma = mean_of(&|nm| (nm - centre).powi(2)).sqrt().max(step);
        (curve.iter().copied().fold(f64::MIN_POSITIVE, f64::max), centre, sigma)
    }

    /// Shares of the area with narrow, middling and wide bells; the highest peaks one after the other; even distances.
    fn gaussian_starts(&self, n: usize, smooth: &[f64]) -> Vec<Vec<f64>> {
        let (peak, centre, sigma) = self.moments(smooth);
        let value_at = |nm: f64, curve: &[f64]| {
            let k = self.nodes_nm.partition_point(|node| *node < nm).min(curve.len() - 1);
            curve[k].max(1e-3 * peak)
        };
        let bells =
            |centres: &[f64], fwhm: f64| -> Vec<f64> { centres.iter().flat_map(|c| [value_at(*c, smooth).ln(), *c, fwhm.ln()]).collect() };
        let mut running = 0.0;
        let sums: Vec<f64> = smooth
            .iter()
            .map(|s| {
                running += s.max(0.0);
                running
            })
            .collect();
        let by_area: Vec<f64> = (0..n)
            .map(|j| {
                let wanted = running * (j as f64 + 0.5) / n as f64;
                self.nodes_nm[sums.partition_point(|s| *s < wanted).min(smooth.len() - 1)]
            })
            .collect();
        let even: Vec<f64> = (0..n).map(|j| centre + sigma * (2.0 * (j as f64 + 0.5) / n as f64 - 1.0) * 1.7).collect();
        let whole = FWHM_PER_SIGMA * sigma;
        let mut starts = vec![bells(&by_area, whole), bells(&by_area, whole / n as f64), bells(&by_area, 0.4 * whole / n as f64)];
        starts.push(bells(&even, whole / n as f64));
        let mut left = smooth.to_vec();
        let mut by_peaks = Vec::new();
        for _ in 0..n {
            let k = (0..left.len()).max_by(|a, b| left[*a].total_cmp(&left[*b])).unwrap_or(0);
            let (height, nm) = (left[k].max(1e-3 * peak), self.nodes_nm[k]);
            let fallen = |i: &usize| left[*i] < 0.5 * height;
            let ends = [(0..k).rev().find(fallen), (k + 1..left.len()).find(fallen)];
            let half: f64 = ends.into_iter().flatten().map(|i| (self.nodes_nm[i] - nm).abs()).fold(whole, f64::min);
            by_peaks.extend([height.ln(), nm, (2.0 * half).ln()]);
            for (s, node) in left.iter_mut().zip(self.nodes_nm) {
                *s -= height * (-std::f64::consts::LN_2 * ((node - nm) / half).powi(2)).exp();
            }
        }
        starts.push(by_peaks);
        starts
    }
}
