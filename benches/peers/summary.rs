//! From repeated runs to the figures of the table: how large the error is, whether it is a bias, and what time it costs.
//!
//! ```text
//! e = (value − reference) / reference          rms over runs and sensors
//! z = mean e / √(s²/K + u_ref²)                per sensor; s: spread of the K runs, or their own u where K is small
//! t(0.1 %): log-log interpolation of time over rms between the two rows on either side, else t (rms / 0.1 %)² from the nearest row
//! ```

use serde::Deserialize;

/// The error whose cost is quoted.
pub(crate) const TARGET: f64 = 1e-3;

/// Runs from which the spread says more than the stated uncertainties.
const MANY_RUNS: usize = 16;

/// Sensors from which only their mean is tested: few samples each leave tails that no tabulated distribution describes.
pub(crate) const MANY_SENSORS: usize = 100;

/// What `references.json` says of a scene.
#[derive(Clone, Debug, Deserialize)]
pub(crate) struct Reference {
    /// A value a sensor.
    pub(crate) values: Vec<f64>,
    /// Standard uncertainties; one may stand for all sensors.
    pub(crate) se: Vec<f64>,
}

impl Reference {
    fn relative_se(&self, sensor: usize) -> f64 {
        self.se.get(sensor).or(self.se.first()).copied().unwrap_or(0.0) / self.values[sensor]
    }
}

/// K independent runs with the same number of samples.
#[derive(Clone, Debug, Default)]
pub(crate) struct Row {
    /// Samples a sensor and sampled contribution.
    pub(crate) samples: u64,
    pub(crate) wall_s: Vec<f64>,
    pub(crate) cpu_s: Vec<f64>,
    /// `values[run][sensor]`
    pub(crate) values: Vec<Vec<f64>>,
    /// Standard uncertainties that the readings state.
    pub(crate) uncertainties: Vec<Vec<f64>>,
    /// Their expanded uncertainties at 95 %.
    pub(crate) expanded: Vec<Vec<f64>>,
    pub(crate) rays: u64,
}

/// The figures of a row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Figures {
    /// Median over the runs, s.
    pub(crate) cpu_s: f64,
    pub(crate) wall_s: f64,
    /// Relative.
    pub(crate) rms: f64,
    /// Mean over runs and sensors, relative.
    pub(crate) mean: f64,
    /// The largest |z| of a sensor, with its sign; of the mean of all sensors where there are more than [`MANY_SENSORS`].
    pub(crate) z: f64,
    /// Root mean square of the stated u over `rms`.
    pub(crate) u_over_rms: f64,
    /// Share of the readings whose 95 % interval (joined with the reference's) holds the reference.
    pub(crate) coverage: f64,
}

impl Row {
    pub(crate) fn figures(&self, reference: &Reference) -> Figures {
        let runs = self.values.len() as f64;
        let sensors = reference.values.len();
        let (mut square, mut sum, mut sum_variance, mut u_square, mut covered, mut z) = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0f64);
        for s in 0..sensors {
            let expected = reference.values[s];
            let errors: Vec<f64> = self.values.iter().map(|v| (v[s] - expected) / expected).collect();
            let mean = errors.iter().sum::<f64>() / runs;
            let own: f64 = self.uncertainties.iter().map(|u| (u[s] / expected).powi(2)).sum();
            let variance =
                if errors.len() >= MANY_RUNS { errors.iter().map(|e| (e - mean).powi(2)).sum::<f64>() / (runs - 1.0) } else { own / runs };
            let z_here = mean / (variance / runs).sqrt().hypot(reference.relative_se(s));
            z = if z_here.abs() > z.abs() { z_here } else { z };
            sum += mean;
            sum_variance += variance / runs;
            square += errors.iter().map(|e| e * e).sum::<f64>();
            u_square += own;
            let slack = 2.0 * reference.relative_se(s);
            covered +=
                errors.iter().zip(&self.expanded).filter(|(e, expanded)| e.abs() <= (expanded[s] / expected).hypot(slack)).count() as f64;
        }
        if sensors > MANY_SENSORS {
            let mean_relative_se = (0..sensors).map(|s| reference.relative_se(s)).sum::<f64>() / sensors as f64;
            // The reference's error is common to all sensors at worst.
            z = sum / sum_variance.sqrt().hypot(sensors as f64 * mean_relative_se);
        }
        let all = runs * sensors as f64;
        let rms = (square / all).sqrt();
        Figures {
            cpu_s: median(&self.cpu_s),
            wall_s: median(&self.wall_s),
            rms,
            mean: sum / sensors as f64,
            z,
            u_over_rms: (u_square / all).sqrt() / rms,
            coverage: covered / all,
        }
    }
}

/// The |z| that the worst of so many sensors exceeds as rarely as one sensor exceeds 3.
pub(crate) fn largest_plausible_z(sensors: usize) -> f64 {
    let sensors = if sensors > MANY_SENSORS { 1 } else { sensors };
    (9.0 + 2.0 * (sensors as f64).ln()).sqrt()
}

/// Processor seconds to the target, and whether the rows lie on both sides of it.
pub(crate) fn seconds_to_target(rows: &[Figures]) -> Option<(f64, bool)> {
    for pair in rows.windows(2) {
        let (a, b) = (&pair[0], &pair[1]);
        if a.rms >= TARGET && b.rms < TARGET {
            let share = (a.rms / TARGET).ln() / (a.rms / b.rms).ln();
            return Some((a.cpu_s * (b.cpu_s / a.cpu_s).powf(share), true));
        }
    }
    let nearest = rows.iter().min_by(|a, b| (a.rms / TARGET).ln().abs().total_cmp(&(b.rms / TARGET).ln().abs()))?;
    Some((nearest.cpu_s * (nearest.rms / TARGET).powi(2), false))
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    match sorted.len() {
        0 => f64::NAN,
        n if n % 2 == 1 => sorted[n / 2],
        n => 0.5 * (sorted[n / 2 - 1] + sorted[n / 2]),
    }
}
