//! From means and variances to figures with their uncertainties.

use super::fit::{Point, Uncertain, line, through_origin};
use super::statistics::Spatial;
use super::{EmvaError, TransferPoint};
use crate::sensor::pixel::QUANTISATION_DN2;

/// Part of the signal at saturation up to which the slopes are fitted.
pub const FITTED_UP_TO: f64 = 0.7;
/// Parts of the signal at saturation between which the linearity is judged.
const LINEARITY: (f64, f64) = (0.05, 0.95);
/// Temporal variance in the dark below which rounding hides the noise, DN² (EMVA 1288, 2.3).
const HIDDEN_BY_ROUNDING_DN2: f64 = 0.24;

/// A figure of a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figure {
    /// Name for programs, with the unit.
    pub key: &'static str,
    /// Symbol of the standard.
    pub symbol: &'static str,
    /// What it is.
    pub name: &'static str,
    /// Unit; 1 for a number.
    pub unit: &'static str,
    /// Its value.
    pub value: f64,
    /// Standard uncertainty.
    pub standard_uncertainty: f64,
    /// What has to be known about this value.
    pub note: Option<&'static str>,
}

/// The figures of a camera, and what they were made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Figures {
    /// The figures, in the order of a data sheet.
    pub list: Vec<Figure>,
    /// The photon-transfer curve.
    pub points: Vec<TransferPoint>,
    /// Index of the point of saturation.
    pub saturation: usize,
    /// The stack in the dark.
    pub dark: Spatial,
    /// The bright stack.
    pub bright: Spatial,
}

impl Figures {
    /// A figure by its key.
    #[must_use]
    pub fn get(&self, key: &str) -> Option<&Figure> {
        self.list.iter().find(|figure| figure.key == key)
    }

    /// A point's signal above the dark, DN, and its temporal variance above the dark, DN².
    #[must_use]
    pub fn above_dark(point: &TransferPoint) -> (f64, f64) {
        (point.bright.mean_dn - point.dark.mean_dn, point.bright.variance_dn2 - point.dark.variance_dn2)
    }
}

/// √x of an uncertain variance; what is not above zero is zero within the root of its uncertainty.
fn root(x: Uncertain) -> Uncertain {
    let value = x.value.max(0.0).sqrt();
    let widest = x.u.sqrt();
    Uncertain { value, u: if value > 0.0 { (0.5 * x.u / value).min(widest) } else { widest } }
}

/// x/y of independent numbers.
fn quotient(x: Uncertain, y: Uncertain) -> Uncertain {
    let value = x.value / y.value;
    Uncertain { value, u: (x.u / y.value).hypot(value * y.u / y.value) }
}

fn product(x: Uncertain, y: Uncertain) -> Uncertain {
    Uncertain { value: x.value * y.value, u: (x.u * y.value).hypot(x.value * y.u) }
}

/// What a dark pair, shared or not, adds to the uncertainty of a slope through the origin.
fn of_darks(points: &[TransferPoint], places: &[f64], u_dark: impl Fn(&TransferPoint) -> f64) -> f64 {
    let whole: f64 = places.iter().map(|x| x * x).sum();
    let pairs = points.iter().map(|p| p.dark_number).max().map_or(0, |last| last + 1);
    let mut sums = vec![0.0; pairs];
    for (point, x) in points.iter().zip(places) {
        sums[point.dark_number] += x * u_dark(point);
    }
    sums.iter().map(|sum| (sum / whole).powi(2)).sum::<f64>().sqrt()
}

/// The point of largest variance, and the photons there with the uncertainty of reading them off.
fn saturation(points: &[TransferPoint]) -> Result<(usize, Uncertain), EmvaError> {
    let variance = |i: usize| points[i].bright.variance_dn2;
    let peak = (0..points.len()).max_by(|a, b| variance(*a).total_cmp(&variance(*b))).unwrap_or(0);
    if peak + 1 >= points.len() {
        let words = "the variance still rises at the last level, so the saturation is not reached: give more light or longer exposures";
        return Err(EmvaError::Frames(words.into()));
    }
    // Neighbours that the noise of the variances does not tell from the peak, and half a step to each side.
    let alike =
        |i: usize| variance(peak) - variance(i) <= 2.0 * points[i].bright.u_variance_dn2().hypot(points[peak].bright.u_variance_dn2());
    let first = (0..peak).rev().take_while(|i| alike(*i)).last().unwrap_or(peak);
    let last = (peak + 1..points.len()).take_while(|i| alike(*i)).last().unwrap_or(peak);
    let photons = |i: usize| points[i].level.photons;
    let below = if first > 0 { photons(first - 1) } else { 0.0 };
    let above = photons((last + 1).min(points.len() - 1));
    let reach = (photons(peak) - 0.5 * (photons(first) + below)).max(0.5 * (photons(last) + above) - photons(peak));
    Ok((peak, Uncertain { value: photons(peak), u: reach / 3f64.sqrt() }))
}

/// Smallest and largest relative deviation from the line with weights 1/y², per 1.
fn linearity(points: &[TransferPoint], at_saturation_dn: f64) -> Option<(Uncertain, Uncertain)> {
    let chosen: Vec<Point> = points
        .iter()
        .map(|p| Point { x: p.level.photons, y: Figures::above_dark(p).0, u: p.bright.u_mean_dn().hypot(p.dark.u_mean_dn()) })
        .filter(|p| p.y >= LINEARITY.0 * at_saturation_dn && p.y <= LINEARITY.1 * at_saturation_dn)
        .collect();
    let (slope, intercept) = line(&chosen, |p| 1.0 / (p.y * p.y))?;
    let deviations = chosen.iter().map(|p| {
        let fitted = slope.value * p.x + intercept.value;
        Uncertain { value: (p.y - fitted) / fitted, u: p.u / fitted }
    });
    let by_value = |a: &Uncertain, b: &Uncertain| a.value.total_cmp(&b.value);
    Some((deviations.clone().min_by(by_value)?, deviations.max_by(by_value)?))
}

/// A list of figures that grows.
struct Sheet(Vec<Figure>);

impl Sheet {
    fn add(&mut self, key: &'static str, [symbol, name, unit]: [&'static str; 3], of: Uncertain, note: Option<&'static str>) {
        self.0.push(Figure { key, symbol, name, unit, value: of.value, standard_uncertainty: of.u, note });
    }
}

pub(super) fn figures(points: Vec<TransferPoint>, dark: Spatial, bright: Spatial, u_photons: f64) -> Result<Figures, EmvaError> {
    let few = || EmvaError::Frames("too few levels below 70 % of saturation: give more levels, or less light".into());
    let (peak, saturation_photons) = saturation(&points)?;
    let at_saturation_dn = Figures::above_dark(&points[peak]).0;
    let fitted: Vec<TransferPoint> =
        points.iter().filter(|p| Figures::above_dark(p).0 <= FITTED_UP_TO * at_saturation_dn).copied().collect();
    if fitted.len() < 3 || at_saturation_dn <= 0.0 {
        return Err(few());
    }
    let pixels = dark.pixels as f64;

    // K: variance over mean. R: mean over photons.
    let transfer: Vec<Point> =
        fitted.iter().map(|p| (p, Figures::above_dark(p))).map(|(p, (x, y))| Point { x, y, u: p.bright.u_variance_dn2() }).collect();
    let mut gain = through_origin(&transfer).ok_or_else(few)?;
    let signals: Vec<f64> = transfer.iter().map(|p| p.x).collect();
    let of_means: Vec<Point> = transfer.iter().zip(&fitted).map(|(p, at)| Point { u: gain.value * at.bright.u_mean_dn(), ..*p }).collect();
    gain.u = gain
        .u
        .hypot(of_darks(&fitted, &signals, |p| p.dark.u_variance_dn2()))
        .hypot(through_origin(&of_means).map_or(0.0, |slope| slope.u));
    let response: Vec<Point> =
        transfer.iter().zip(&fitted).map(|(p, at)| Point { x: at.level.photons, y: p.x, u: at.bright.u_mean_dn() }).collect();
    let mut responsivity = through_origin(&response).ok_or_else(few)?;
    let photons: Vec<f64> = response.iter().map(|p| p.x).collect();
    responsivity.u = responsivity.u.hypot(of_darks(&fitted, &photons, |p| p.dark.u_mean_dn()));

    // Fixed pattern.
    let spatial = |s: &Spatial| Uncertain { value: s.variance_dn2, u: s.u_variance_dn2() };
    let pattern_dn = root(spatial(&dark));
    let dsnu = quotient(pattern_dn, gain);
    let light_dn2 = Uncertain { value: bright.variance_dn2 - dark.variance_dn2, u: bright.u_variance_dn2().hypot(dark.u_variance_dn2()) };
    let signal_dn = bright.mean_dn - dark.mean_dn;
    let prnu = quotient(root(light_dn2), Uncertain { value: signal_dn, u: 0.0 });
    // The pixels are a sample of those that the camera could have had; the photons are known as well as they are.
    let of_sample = prnu.value / pixels.sqrt();
    responsivity.u = responsivity.u.hypot(responsivity.value * of_sample.hypot(u_photons));
    let efficiency = quotient(responsivity, gain);

    // The dark, over the exposure time where there are three times, else as it is.
    let mut darks: Vec<&TransferPoint> = Vec::new();
    for point in &points {
        if darks.iter().all(|known| known.dark_number != point.dark_number) {
            darks.push(point);
        }
    }
    let over_time = |value: fn(&TransferPoint) -> (f64, f64)| -> Vec<Point> {
        let point = |p: &&TransferPoint| (p.level.exposure_s, value(p));
        darks.iter().map(point).map(|(x, (y, u))| Point { x, y, u }).collect()
    };
    let variances = over_time(|p| (p.dark.variance_dn2, p.dark.u_variance_dn2()));
    let means = over_time(|p| (p.dark.mean_dn, p.dark.u_mean_dn()));
    let timed = darks.len() > 2;
    let dark_variance = match line(&variances, |_| 1.0).filter(|_| timed) {
        Some((_, intercept)) => intercept,
        None => Uncertain { value: variances[0].y, u: variances[0].u },
    };
    let hidden_by_rounding = dark_variance.value < HIDDEN_BY_ROUNDING_DN2;
    // What rounding hides is anywhere below the limit, however well the frames agree.
    let dark_variance = match hidden_by_rounding {
        true => Uncertain { u: dark_variance.u.hypot(HIDDEN_BY_ROUNDING_DN2 / 3f64.sqrt()), ..dark_variance },
        false => dark_variance,
    };
    let hidden = hidden_by_rounding.then_some("rounding hides noise below 0.24 DN²: an estimate, not a measurement");
    let dark_noise_dn = root(dark_variance);
    let dark_noise = quotient(root(Uncertain { value: dark_variance.value - QUANTISATION_DN2, ..dark_variance }), gain);

    // Saturation, threshold and what is between. η and K come from the same frames; their quotients are taken as independent.
    let relative_photons = Uncertain { value: 1.0, u: u_photons };
    let saturation_e = product(efficiency, saturation_photons);
    let largest_snr = root(saturation_e);
    let noise_e = quotient(dark_noise_dn, gain);
    let below_root = (noise_e.value * noise_e.value + 0.25).sqrt();
    // To first order a noise of zero would move nothing; the step by its whole uncertainty does.
    let step = (noise_e.value + noise_e.u).hypot(0.5) - below_root;
    let threshold_e = Uncertain { value: 0.5 + below_root, u: step.max(noise_e.u * noise_e.value / below_root) };
    let threshold_photons = quotient(threshold_e, efficiency);
    let range = quotient(saturation_e, threshold_e);
    let (lowest, highest) = linearity(&points, at_saturation_dn).ok_or_else(few)?;

    let mut sheet = Sheet(Vec::new());
    sheet.add("quantum_efficiency", ["η", "quantum efficiency", "1"], efficiency, None);
    sheet.add("gain_dn_per_e", ["K", "system gain", "DN/e⁻"], gain, None);
    sheet.add("responsivity_dn_per_photon", ["R", "responsivity", "DN/photon"], responsivity, None);
    sheet.add("dark_noise_dn", ["σ_y.dark", "temporal dark noise", "DN"], dark_noise_dn, hidden);
    sheet.add("dark_noise_e", ["σ_d", "temporal dark noise", "e⁻"], dark_noise, hidden);
    if let Some(((by_mean, _), (by_variance, _))) = line(&means, |_| 1.0).zip(line(&variances, |_| 1.0)).filter(|_| timed) {
        sheet.add("dark_current_e_s", ["μ_I", "dark current, from the mean", "e⁻/s"], quotient(by_mean, gain), None);
        let by_variance = quotient(quotient(by_variance, gain), gain);
        sheet.add("dark_current_by_variance_e_s", ["μ_I.var", "dark current, from the variance", "e⁻/s"], by_variance, None);
    }
    sheet.add("threshold_photons", ["μ_p.min", "absolute threshold, exact", "photons"], threshold_photons, hidden);
    sheet.add("threshold_e", ["μ_e.min", "absolute threshold, exact", "e⁻"], threshold_e, hidden);
    sheet.add("saturation_photons", ["μ_p.sat", "saturation capacity", "photons"], product(saturation_photons, relative_photons), None);
    sheet.add("saturation_e", ["μ_e.sat", "saturation capacity", "e⁻"], saturation_e, None);
    sheet.add("largest_snr", ["SNR_max", "largest signal-to-noise ratio", "1"], largest_snr, None);
    sheet.add("dynamic_range", ["DR", "dynamic range", "1"], range, hidden);
    sheet.add("dsnu_e", ["DSNU", "dark signal non-uniformity", "e⁻"], dsnu, None);
    sheet.add("prnu", ["PRNU", "photo response non-uniformity", "1"], prnu, None);
    let extreme = Some("the extreme of a number of levels: noise alone moves it by two to three u");
    sheet.add("linearity_error_min", ["LE_min", "linearity error, lowest", "1"], lowest, extreme);
    sheet.add("linearity_error_max", ["LE_max", "linearity error, highest", "1"], highest, extreme);
    Ok(Figures { list: sheet.0, points, saturation: peak, dark, bright })
}
