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

/// The part of a ladder that slopes are taken over, as the index of its first rung: the upper two thirds, four rungs at least, and of
/// these the ones whose samples take the time.
///
/// `seconds` are the processor times of the rungs, each with `factor` times the samples of the one before: as long as time grows by
/// less than ¾ of that, the start of a run is still a good part of it. Three rungs stay in any case, if there are so many.
pub(super) fn upper_part(seconds: &[f64], factor: f64) -> usize {
    let count = seconds.len();
    let mut first = count - (2 * count).div_ceil(3).max(4).min(count);
    while count - first > 3 && seconds[first + 1] < 0.75 * factor * seconds[first] {
        first += 1;
    }
    first
}

/// Fits a line to the logarithms. `scatter` is the standard deviation of `ln y` that is there in any case.
///
/// `None` below three points, of which nothing would say how well they lie on a line; when they have no extent in x; or when a
/// coordinate is not positive.
#[must_use]
pub fn fit(points: &[(f64, f64)], scatter: f64) -> Option<PowerLaw> {
    let n = points.len() as f64;
    let logarithms: Vec<(f64, f64)> = points.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    if points.len() < 3 || logarithms.iter().any(|(x, y)| !(x.is_finite() && y.is_finite())) {
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
    let about_the_line = (residual / (n - 2.0)).sqrt();
    let ends = points.iter().fold((f64::INFINITY, 0.0f64), |(low, high), (x, _)| (low.min(*x), high.max(*x)));
    Some(PowerLaw {
        exponent,
        standard_uncertainty: about_the_line.max(scatter) / spread.sqrt(),
        ln_factor: mean_y - exponent * mean_x,
        points: points.len(),
        range: ends,
    })
}

/// The time after which the error stays below a target: `rungs` are (samples, seconds, error), from few samples to many; `law` is the
/// error against samples. Beyond the highest rung time grows with the samples.
#[must_use]
pub fn time_to(target: f64, rungs: &[(f64, f64, f64)], law: Option<&PowerLaw>) -> TimeTo {
    let Some(&(_, first_seconds, _)) = rungs.first() else { return TimeTo::Unknown };
    // A clock that stands, or one too coarse for the run.
    if !rungs.iter().all(|(_, seconds, _)| *seconds > 0.0) {
        return TimeTo::Unknown;
    }
    let Some(above) = rungs.iter().rposition(|(.., error)| *error > target) else { return TimeTo::AtMost(first_seconds) };
    let (n0, t0, e0) = rungs[above];
    match (rungs.get(above + 1), law) {
        (Some(&(_, t1, e1)), _) => {
            let share = (e0 / target).ln() / (e0 / e1).ln();
            TimeTo::Interpolated((t0.ln() + share * (t1.ln() - t0.ln())).exp())
        }
        // An error that does not clearly fall reaches nothing.
        (None, Some(law)) if law.exponent + 2.0 * law.standard_uncertainty < 0.0 => {
            let samples = ((target.ln() - law.ln_factor) / law.exponent).exp();
            TimeTo::Extrapolated(t0 * (samples / n0).max(1.0))
        }
        _ => TimeTo::Unknown,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// (samples, seconds, error) with a start of the run of one millisecond.
    fn ladder(exponent: f64, rungs: i32) -> Vec<(f64, f64, f64)> {
        let samples = (0..rungs).map(|k| 256.0 * 4f64.powi(k));
        samples.map(|n| (n, 1e-3 + 1e-6 * n, (n / 256.0).powf(exponent))).collect()
    }

    proptest! {
        #[test]
        fn the_slope_of_a_power_law_is_found(exponent in -2.0..-0.1_f64, factor in -200.0..200.0_f64, rungs in 3i32..12) {
            let points: Vec<(f64, f64)> = (0..rungs).map(|k| 4f64.powi(k)).map(|x| (x, (factor + exponent * x.ln()).exp())).collect();
            let law = fit(&points, 0.0).unwrap();
            prop_assert!((law.exponent - exponent).abs() < 1e-9 && (law.ln_factor - factor).abs() < 1e-9);
            prop_assert!(law.standard_uncertainty < 1e-9 && law.points == rungs as usize);
        }

        #[test]
        fn scatter_is_covered_by_the_uncertainty_of_the_slope(noise in proptest::collection::vec(-0.4..0.4_f64, 8)) {
            // Uniform within ±0.4: a standard deviation of 0.23.
            let points: Vec<(f64, f64)> =
                noise.iter().enumerate().map(|(k, n)| (4f64.powi(k as i32), (n - 0.5 * 4f64.powi(k as i32).ln()).exp())).collect();
            let law = fit(&points, 0.23).unwrap();
            prop_assert!((law.exponent + 0.5).abs() < 5.0 * law.standard_uncertainty, "{:?}", law);
        }

        #[test]
        fn times_are_those_of_the_law(exponent in -1.5..-0.4_f64, target in 1e-4..0.9_f64) {
            let rungs = ladder(exponent, 9);
            let law = fit(&rungs.iter().map(|r| (r.0, r.2)).collect::<Vec<_>>(), 1e-6).unwrap();
            let samples = 256.0 * target.powf(1.0 / exponent);
            let beyond = target < rungs[8].2;
            match time_to(target, &rungs, Some(&law)) {
                TimeTo::Interpolated(s) => {
                    prop_assert!(!beyond);
                    // Between rungs the time is taken as a power of the samples: a chord, which lies above 1 ms + 1 µs N.
                    prop_assert!((0.999..1.08).contains(&(s / (1e-3 + 1e-6 * samples))), "{} {}", s, samples);
                }
                TimeTo::Extrapolated(s) => {
                    prop_assert!(beyond);
                    prop_assert!((s / (1e-6 * samples) - 1.0).abs() < 0.01, "{} {}", s, samples);
                }
                other => prop_assert!(false, "{:?}", other),
            }
        }
    }

    #[test]
    fn what_does_not_fall_reaches_nothing() {
        let rungs = [(256.0, 1.0, 0.5), (1024.0, 4.0, 0.5), (4096.0, 16.0, 0.5)];
        let law = fit(&rungs.map(|r| (r.0, r.2)), 0.1).unwrap();
        assert_eq!(time_to(0.1, &rungs, Some(&law)), TimeTo::Unknown);
        assert_eq!(time_to(0.6, &rungs, Some(&law)), TimeTo::AtMost(1.0));
        assert_eq!(time_to(0.1, &[], None), TimeTo::Unknown);
        assert_eq!(time_to(0.1, &[(256.0, 0.0, 0.5), (1024.0, 0.0, 0.01)], None), TimeTo::Unknown);
        // Below the target once by luck is not yet below it.
        let lucky = [(256.0, 1.0, 0.5), (1024.0, 4.0, 0.05), (4096.0, 16.0, 0.2), (16384.0, 64.0, 0.05)];
        assert!(matches!(time_to(0.1, &lucky, None), TimeTo::Interpolated(s) if (16.0..64.0).contains(&s)));
    }

    #[test]
    fn too_few_points_and_points_without_extent_or_sign_have_no_slope() {
        for points in [
            vec![],
            vec![(1.0, 1.0), (4.0, 0.5)],
            vec![(1.0, 1.0), (1.0, 2.0), (1.0, 3.0)],
            vec![(1.0, 1.0), (2.0, 0.0), (3.0, 1.0)],
            vec![(-1.0, 1.0), (2.0, 1.0), (3.0, 1.0)],
        ] {
            assert_eq!(fit(&points, 0.1), None, "{points:?}");
        }
    }

    #[test]
    fn slopes_are_taken_where_samples_take_the_time() {
        let seconds: Vec<f64> = ladder(-0.5, 7).iter().map(|r| r.1).collect();
        // 1.3, 2.0, 5.1, 17, 67, 263, 1050 ms: from the fourth on each takes at least three times as long.
        assert_eq!(upper_part(&seconds, 4.0), 2);
        assert_eq!(upper_part(&[1.0, 1.0, 1.0, 1.0, 1.0], 4.0), 2);
        assert_eq!(upper_part(&[1.0, 4.0], 4.0), 0);
        assert_eq!(upper_part(&[], 4.0), 0);
    }
}
