//! Slopes, and the time to an error.
//!
//! ```text
//! ln y = ln c + b ln x      by least squares;    u(b) = s / √Σ (ln x − mean)²
//! ```
//!
//! `s` is the scatter of `ln y` about the line, or the one that an RMS over so few runs must have if that is larger.

/// `y = c x^b`, fitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerLaw {
    /// The slope `b` on logarithmic axes.
    pub exponent: f64,
    /// Its standard uncertainty.
    pub standard_uncertainty: f64,
    /// `ln c`.
    pub ln_factor: f64,
    /// Points that it was fitted to.
    pub points: usize,
    /// Least and largest x among them.
    pub range: (f64, f64),
}

/// The processor time to an error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TimeTo {
    /// The lowest rung is good enough, s.
    AtMost(f64),
    /// Between two rungs, s.
    Interpolated(f64),
    /// Beyond the highest rung by the fitted slope, s.
    Extrapolated(f64),
    /// No line to go by, or one that does not fall.
    Unknown,
}

impl TimeTo {
    /// Seconds, if there are any.
    #[must_use]
    pub fn seconds(&self) -> Option<f64> {
        match self {
            TimeTo::AtMost(s) | TimeTo::Interpolated(s) | TimeTo::Extrapolated(s) => Some(*s),
            TimeTo::Unknown => None,
        }
    }
}

/// The upper two thirds of a ladder, four rungs at least, if there are so many: the lowest rungs pay for the start of a run, and quasi-random points
/// have not yet filled their space.
pub(super) fn upper_part<T>(rungs: &[T]) -> &[T] {
    let count = (2 * rungs.len()).div_ceil(3).max(4).min(rungs.len());
    &rungs[rungs.len() - count..]
}

/// Fits a line to the logarithms. `scatter` is the standard deviation of `ln y` that is there in any case. `None` below two points, or when they have
/// no extent in x, or a coordinate is not positive.
#[must_use]
pub fn fit(points: &[(f64, f64)], scatter: f64) -> Option<PowerLaw> {
    let n = points.len() as f64;
    let logarithms: Vec<(f64, f64)> = points.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    if points.len() < 2 || logarithms.iter().any(|(x, y)| !(x.is_finite() && y.is_finite())) {
        return None;
    }
    let mean_x = logarithms.iter().map(|p| p.0).sum::<f64>() / n;
    let mean_y = logarithms.iter().map(|p| p.1).sum::<f64>() / n;
    let spread: f64 = logarithms.iter().map(|p| (p.0 - mean_x).powi(2)).sum();
    // Points that differ in rounding only have no slope.
    if spread.sqrt() <= 1e-9 * (1.0 + mean_x.abs()) {
        return None;
    }
    let exponent = logarithms.iter().map(|p| (p.0 - mean_x) * (p.1 - mean_y)).sum::<f64>() / spread;
    let residual: f64 = logarithms.iter().map(|p| (p.1 - mean_y - exponent * (p.0 - mean_x)).powi(2)).sum();
    let about_the_line = if points.len() > 2 { (residual / (n - 2.0)).sqrt() } else { 0.0 };
    let ends = points.iter().fold((f64::INFINITY, 0.0f64), |(low, high), (x, _)| (low.min(*x), high.max(*x)));
    Some(PowerLaw {
        exponent,
        standard_uncertainty: about_the_line.max(scatter) / spread.sqrt(),
        ln_factor: mean_y - exponent * mean_x,
        points: points.len(),
        range: ends,
    })
}

/// The time after which the error stays below a target: `rungs` are (seconds, error), from few samples to many.
#[must_use]
pub fn time_to(target: f64, rungs: &[(f64, f64)], law: Option<&PowerLaw>) -> TimeTo {
    let Some(&(first_seconds, _)) = rungs.first() else { return TimeTo::Unknown };
    let Some(above) = rungs.iter().rposition(|(_, error)| *error > target) else { return TimeTo::AtMost(first_seconds) };
    let (t0, e0) = rungs[above];
    match (rungs.get(above + 1), law) {
        (Some(&(t1, e1)), _) => {
            let share = (e0 / target).ln() / (e0 / e1).ln();
            TimeTo::Interpolated((t0.ln() + share * (t1.ln() - t0.ln())).exp())
        }
        // An error that does not clearly fall reaches nothing.
        (None, Some(law)) if law.exponent + 2.0 * law.standard_uncertainty < 0.0 => {
            TimeTo::Extrapolated(((target.ln() - law.ln_factor) / law.exponent).exp().max(t0))
        }
        _ => TimeTo::Unknown,
    }
}
