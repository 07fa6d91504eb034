//! Which readings contradict the rest, and what becomes of them.
//!
//! ```text
//! left out:   y − ŷ₋ᵢ = rᵢ / (1 − hᵢ)        u²(ŷ₋ᵢ) = wᵢ² hᵢ / (1 − hᵢ)        tᵢ = (yᵢ − ŷ₋ᵢ) / √(uᵢ² + u²(ŷ₋ᵢ))
//! same light: t = (yᵢ/|aᵢ| − yⱼ/|aⱼ|) / √(uᵢ²/|aᵢ|² + uⱼ²/|aⱼ|²)     where aᵢ/|aᵢ| = aⱼ/|aⱼ|
//! weights:    ωᵢ = (ν + c) / (ν + Σ tᵢ²)      u → u/√ω,     ν = 4, sum over the c channels, until they stand still
//! ```
//!
//! | symbol | meaning |
//! |---|---|
//! | rᵢ | reading minus what the fitted curve reads |
//! | hᵢ | `aᵢ · G eᵢ`: what a reading of exposure i changes of its own fit, from 0 to 1 |
//! | wᵢ | what the fit divided the reading by: its uncertainty, or that of all channels |
//! | tᵢ | residual against the curve that all *other* readings give, over its uncertainty: studentised, in closed form |
//!
//! A reading is named if |t| is beyond what [`LEVEL`] of all campaigns without a wrong reading would show. Wrong readings hide each other, so the worst are
//! left out and the rest is fitted again until none is left; then each of them is held against the curve of the rest, with all of that curve's
//! uncertainty, and only what still contradicts is named. More than a [fifth](MOST) of the readings are no outliers: then the exposures, the
//! uncertainties or the model are wrong, and no reading is named.
//!
//! Source: Rasmussen, Williams, Gaussian Processes for Machine Learning (2006), 5.4.2; weights: Lange, Little, Taylor, J. Am. Stat. Assoc. 84 (1989) 881.

use nalgebra::DVector;

use super::error::CalibrationError;
use super::exposures::{Exposures, Readings};
use super::fit::{Fitted, FittedCurve};
use super::whitening::units;
use crate::metrology::distribution::normal_quantile;

/// Share of the campaigns without a wrong reading in which one is named all the same, if noise is normal and as stated.
pub const LEVEL: f64 = 0.01;
/// Share of the readings beyond which they are no outliers.
pub const MOST: f64 = 0.2;
/// Rounds of leaving out.
const ROUNDS: usize = 12;
/// Of the worst t: what is as bad as this share of it is left out together with it.
const TOGETHER: f64 = 0.5;
/// A reading of which less than this share is held by others has nothing that it could contradict.
const ALONE: f64 = 1e-6;
/// Relative difference below which two exposures shine the same light.
const SAME_LIGHT: f64 = 1e-6;
/// Degrees of freedom of the distribution that the weights belong to.
const NU: f64 = 4.0;
/// Weights stand still when none changes by more than this, relatively.
const STANDS: f64 = 0.02;
/// Rounds of weighing.
const WEIGHINGS: usize = 30;
/// Weight that a reading which contradicts the rest starts from.
const START: f64 = 1e-4;

/// What becomes of readings that contradict the rest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Outliers {
    /// They are named; the fit takes all readings as they are stated.
    #[default]
    Report,
    /// They are named and down-weighted: all readings are weighed as if their noise had the long tails of Student's t.
    DownWeight,
}

/// A reading that contradicts the rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Outlier {
    /// Which exposure.
    pub index: usize,
    /// Its name.
    pub label: String,
    /// What was read.
    pub reading: f64,
    /// What the curve of the other readings reads there.
    pub expected: f64,
    /// The difference over its standard uncertainty, that of the curve included.
    pub studentised: f64,
    /// The difference over the stated standard uncertainty of the reading alone.
    pub in_u: f64,
}

/// Two readings of the same light that contradict each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Contradiction {
    /// The exposures.
    pub labels: [String; 2],
    /// The readings.
    pub readings: [f64; 2],
    /// Their difference, per amount of light, over its standard uncertainty.
    pub in_u: f64,
}

/// How the readings of a channel go together.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Consistency {
    /// Residual of each reading against the curve of all others, over its standard uncertainty; `None` where no other reading tells.
    pub studentised: Vec<Option<f64>>,
    /// What |t| stays below in all but [`LEVEL`] of the campaigns.
    pub limit: f64,
    /// Readings that contradict the rest.
    pub outliers: Vec<Outlier>,
    /// Readings of the same light that contradict each other, the worst first.
    pub contradictions: Vec<Contradiction>,
}

type Fit<'a> = dyn Fn(&Exposures, &[Readings]) -> Result<Fitted, CalibrationError> + 'a;

/// The fit of all readings, examined, and down-weighted on request.
pub(super) fn examined(exposures: &Exposures, readings: &[Readings], wanted: Outliers, once: &Fit) -> Result<Fitted, CalibrationError> {
    let mut fitted = once(exposures, readings)?;
    let noiseless = readings.iter().flat_map(|r| &r.standard_uncertainties).any(|u| *u == 0.0);
    if noiseless {
        // Readings without noise are held to their rounding: any model contradicts them.
        return match wanted {
            Outliers::Report => Ok(fitted),
            Outliers::DownWeight => {
                let what = "readings with an uncertainty of 0 cannot be down-weighted; state the noise of every reading";
                Err(CalibrationError::Readings(what.to_owned()))
            }
        };
    }
    let limit = limit(exposures.len() * readings.len());
    let left_out = left_out(exposures, readings, &fitted, limit, once)?;
    let found: Vec<Consistency> = readings
        .iter()
        .enumerate()
        .map(|(c, r)| Consistency {
            studentised: left_one_out(exposures, readings, &fitted.curves[c], c, None),
            limit,
            outliers: left_out.iter().flat_map(|l| l.named(exposures, r, c, limit)).collect(),
            contradictions: contradictions(exposures, r),
        })
        .collect();
    if let Some(LeftOut { too_many: true, indices, .. }) = &left_out {
        let few: Vec<String> = indices.iter().take(3).map(|i| format!("\"{}\"", label(exposures, *i))).collect();
        fitted.remarks.push(format!(
            "{} of {} readings contradict the rest, {} among them: so many are no outliers, and none is named; the stated uncertainties, the exposures \
             or the model are wrong, or the curve has kinks that its priors do not expect",
            indices.len(),
            exposures.len(),
            few.join(", ")
        ));
    }
    if wanted == Outliers::DownWeight {
        let named: Vec<usize> = found.iter().flat_map(|c| &c.outliers).map(|o| o.index).collect();
        fitted = down_weighted(exposures, readings, &named, once, std::mem::take(&mut fitted.remarks))?;
    }
    for (curve, consistency) in fitted.curves.iter_mut().zip(found) {
        curve.consistency = consistency;
    }
    Ok(fitted)
}

/// What |t| of the worst of `count` readings stays below in all but [`LEVEL`] of the campaigns.
fn limit(count: usize) -> f64 {
    normal_quantile(1.0 - 0.5 * LEVEL / count.max(1) as f64).unwrap_or(f64::INFINITY)
}

fn label(exposures: &Exposures, i: usize) -> &str {
    exposures.labels().get(i).map_or("", |l| l)
}

/// t of each reading against the curve of all others; `weights` if the fit had any.
fn left_one_out(exposures: &Exposures, readings: &[Readings], curve: &FittedCurve, c: usize, weights: Option<&[f64]>) -> Vec<Option<f64>> {
    let r = &readings[c];
    let expected = exposures.expected(&curve.values);
    let units = units(readings);
    (0..exposures.len())
        .map(|i| {
            let h: f64 = exposures.matrix.row(i).iter().zip(curve.gain.column(i).iter()).map(|(a, g)| a * g).sum();
            let held = 1.0 - h;
            let unit = units[i] / weights.map_or(1.0, |w| w[i].sqrt());
            let variance = r.standard_uncertainties[i].powi(2) + unit * unit * h.max(0.0) / held;
            (held > ALONE).then(|| (r.values[i] - expected[i]) / held / variance.sqrt())
        })
        .collect()
}

/// Exposures that were left out, and the fit of the rest.
struct LeftOut {
    indices: Vec<usize>,
    rest: Fitted,
    too_many: bool,
}

impl LeftOut {
    /// The difference of reading `i` from the curve of the rest, over its uncertainty with all of that of the curve; and what the curve reads.
    fn apart(&self, exposures: &Exposures, r: &Readings, c: usize, i: usize) -> (f64, f64) {
        let (curve, a) = (&self.rest.curves[c], DVector::from_fn(exposures.matrix.ncols(), |k, _| exposures.matrix[(i, k)]));
        let expected: f64 = a.iter().zip(&curve.values).map(|(a, s)| a * s).sum();
        let of_curve = a.dot(&(curve.covariance() * &a)).max(0.0);
        ((r.values[i] - expected) / r.standard_uncertainties[i].hypot(of_curve.sqrt()), expected)
    }

    fn named(&self, exposures: &Exposures, r: &Readings, c: usize, limit: f64) -> Vec<Outlier> {
        if self.too_many {
            return Vec::new();
        }
        let of = |&i: &usize| {
            let (studentised, expected) = self.apart(exposures, r, c, i);
            let in_u = (r.values[i] - expected) / r.standard_uncertainties[i];
            (studentised.abs() > limit).then(|| Outlier {
                index: i,
                label: label(exposures, i).to_owned(),
                reading: r.values[i],
                expected,
                studentised,
                in_u,
            })
        };
        self.indices.iter().filter_map(of).collect()
    }
}

/// Leaves out the worst readings, round by round, until the rest holds together; then puts back what does not contradict the rest.
fn left_out(
    exposures: &Exposures,
    readings: &[Readings],
    all: &Fitted,
    limit: f64,
    once: &Fit,
) -> Result<Option<LeftOut>, CalibrationError> {
    let m = exposures.len();
    let most = (MOST * m as f64) as usize;
    let without = |out: &[usize]| {
        let kept: Vec<usize> = (0..m).filter(|i| !out.contains(i)).collect();
        let of = |r: &Readings| Readings {
            channel: r.channel.clone(),
            values: kept.iter().map(|i| r.values[*i]).collect(),
            standard_uncertainties: kept.iter().map(|i| r.standard_uncertainties[*i]).collect(),
        };
        (kept.clone(), exposures.subset(&kept), readings.iter().map(of).collect::<Vec<Readings>>())
    };
    let mut out: Vec<usize> = Vec::new();
    let mut rest = all.clone();
    for _ in 0..ROUNDS {
        let (kept, of_kept, readings_kept) = without(&out);
        let worst = |j: usize, t: &[Vec<Option<f64>>]| t.iter().filter_map(|t| t[j]).fold(0.0f64, |most, t| most.max(t.abs()));
        let t: Vec<Vec<Option<f64>>> =
            rest.curves.iter().enumerate().map(|(c, curve)| left_one_out(&of_kept, &readings_kept, curve, c, None)).collect();
        let each: Vec<f64> = (0..kept.len()).map(|j| worst(j, &t)).collect();
        let largest = each.iter().copied().fold(0.0, f64::max);
        if largest <= limit {
            break;
        }
        out.extend(kept.iter().zip(&each).filter(|(_, t)| **t > limit.max(TOGETHER * largest)).map(|(i, _)| *i));
        if out.len() > most {
            return Ok(Some(LeftOut { indices: out, rest, too_many: true }));
        }
        let (_, of_kept, readings_kept) = without(&out);
        rest = once(&of_kept, &readings_kept)?;
    }
    if out.is_empty() {
        return Ok(None);
    }
    let found = LeftOut { indices: out, rest, too_many: false };
    let contradicts = |i: &usize| readings.iter().enumerate().any(|(c, r)| found.apart(exposures, r, c, *i).0.abs() > limit);
    let mut indices: Vec<usize> = found.indices.iter().copied().filter(contradicts).collect();
    indices.sort_unstable();
    let (_, of_kept, readings_kept) = without(&indices);
    let rest = if indices.len() == found.indices.len() { found.rest } else { once(&of_kept, &readings_kept)? };
    Ok(Some(LeftOut { indices, rest, too_many: false }))
}

/// Pairs of readings of the same light that contradict each other.
fn contradictions(exposures: &Exposures, r: &Readings) -> Vec<Contradiction> {
    let norms: Vec<f64> = exposures.matrix.row_iter().map(|row| row.norm()).collect();
    // A number that the same light shares: exposures with equal ones are neighbours when sorted.
    let mark = |i: usize| exposures.matrix.row(i).iter().enumerate().map(|(k, a)| a / norms[i] * (k as f64 + 1.0).sqrt()).sum::<f64>();
    let mut order: Vec<(f64, usize)> = (0..exposures.len()).filter(|i| norms[*i] > 0.0).map(|i| (mark(i), i)).collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let same = |i: usize, j: usize| {
        let (a, b) = (exposures.matrix.row(i), exposures.matrix.row(j));
        let square: f64 = a.iter().zip(b.iter()).map(|(a, b)| (a / norms[i] - b / norms[j]).powi(2)).sum();
        square.sqrt() < SAME_LIGHT
    };
    let pairs: Vec<(usize, usize)> =
        order.windows(2).map(|w| (w[0].1.min(w[1].1), w[0].1.max(w[1].1))).filter(|&(i, j)| same(i, j)).collect();
    let limit = limit(pairs.len());
    let of = |&(i, j): &(usize, usize)| {
        let apart = r.values[i] / norms[i] - r.values[j] / norms[j];
        let in_u = apart / (r.standard_uncertainties[i] / norms[i]).hypot(r.standard_uncertainties[j] / norms[j]);
        (in_u.abs() > limit).then(|| Contradiction {
            labels: [label(exposures, i).to_owned(), label(exposures, j).to_owned()],
            readings: [r.values[i], r.values[j]],
            in_u,
        })
    };
    let mut found: Vec<Contradiction> = pairs.iter().filter_map(of).collect();
    found.sort_by(|a, b| b.in_u.abs().total_cmp(&a.in_u.abs()));
    found
}

/// Weighs the readings until the weights stand still. A weight belongs to an exposure: its channels share it.
fn down_weighted(
    exposures: &Exposures,
    readings: &[Readings],
    named: &[usize],
    once: &Fit,
    remarks: Vec<String>,
) -> Result<Fitted, CalibrationError> {
    let m = exposures.len();
    let widened = |weights: &[f64]| -> Vec<Readings> {
        let of = |r: &Readings| Readings {
            channel: r.channel.clone(),
            values: r.values.clone(),
            standard_uncertainties: r.standard_uncertainties.iter().zip(weights).map(|(u, w)| u / w.sqrt()).collect(),
        };
        readings.iter().map(of).collect()
    };
    let mut weights: Vec<f64> = (0..m).map(|i| if named.contains(&i) { START } else { 1.0 }).collect();
    let mut fitted = once(exposures, &widened(&weights))?;
    let mut stands = false;
    for _ in 0..WEIGHINGS {
        let t: Vec<Vec<Option<f64>>> =
            fitted.curves.iter().enumerate().map(|(c, curve)| left_one_out(exposures, readings, curve, c, Some(&weights))).collect();
        let square = |i: usize| t.iter().filter_map(|t| t[i]).map(|t| t * t).sum::<f64>();
        let channels = readings.len() as f64;
        // Where no other reading tells, nothing speaks against the stated uncertainty.
        let told = |i: usize| t.iter().any(|t| t[i].is_some());
        let next: Vec<f64> = (0..m).map(|i| if told(i) { (NU + channels) / (NU + square(i)) } else { 1.0 }).collect();
        stands = next.iter().zip(&weights).all(|(a, b)| (a / b).ln().abs() < STANDS);
        if stands {
            break;
        }
        weights = next;
        fitted = once(exposures, &widened(&weights))?;
    }
    let mut told = remarks;
    told.append(&mut fitted.remarks);
    if !stands {
        told.push(format!(
            "the weights of the readings still change after {WEIGHINGS} rounds: the curve depends on which of them are believed"
        ));
    }
    fitted.remarks = told;
    for curve in &mut fitted.curves {
        for (residual, w) in curve.residuals.iter_mut().zip(&weights) {
            *residual /= w.sqrt();
        }
        curve.weights.clone_from(&weights);
    }
    Ok(fitted)
}
