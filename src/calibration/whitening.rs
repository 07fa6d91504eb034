//! Readings in units of their standard uncertainties, after checks.

use nalgebra::{DMatrix, DVector};

use super::error::CalibrationError;
use super::evidence::Whitened;
use super::exposures::{Exposures, Readings};
use super::prior;

/// Readings have at least the rounding of double precision, as a share of the largest.
const ROUNDING: f64 = 2.0 * f64::EPSILON;
/// Largest reading and uncertainty that can be fitted: squares of what is beyond leave the range of numbers.
pub const LARGEST: f64 = 1e100;

/// Checks readings and divides them, and the weights of their exposures, by their uncertainties.
pub(super) fn whitened(exposures: &Exposures, readings: &[Readings]) -> Result<Whitened, CalibrationError> {
    let m = exposures.len();
    let unusable = |what: String| Err(CalibrationError::Readings(what));
    if m == 0 || readings.is_empty() {
        return unusable("there are no readings".to_owned());
    }
    for r in readings {
        if r.values.len() != m || r.standard_uncertainties.len() != m {
            return unusable(format!(
                "channel `{}` has {} readings with {} uncertainties for {m} exposures; give one of each for every exposure",
                r.channel,
                r.values.len(),
                r.standard_uncertainties.len()
            ));
        }
        for (i, (y, u)) in r.values.iter().zip(&r.standard_uncertainties).enumerate() {
            let which = format!("channel `{}`, exposure {} (`{}`)", r.channel, i + 1, exposures.labels().get(i).map_or("", |l| l));
            // Squares of what is beyond leave the range of numbers.
            if y.abs() > LARGEST || *u > LARGEST {
                return unusable(format!("{which}: {y:e} ± {u:e} is beyond what can be fitted; allowed: up to {LARGEST:e}"));
            }
            if !y.is_finite() {
                return unusable(format!("{which}: the reading is {y}; leave the exposure out or give a number"));
            }
            if !(u.is_finite() && *u >= 0.0) {
                return unusable(format!("{which}: the standard uncertainty is {u}; allowed: 0 or more"));
            }
        }
    }
    let largest = readings.iter().flat_map(|r| &r.values).fold(0.0f64, |most, y| most.max(y.abs()));
    let sees = (0..m).map(|i| exposures.matrix.row(i).iter().map(|a| a.abs()).sum::<f64>()).fold(0.0, f64::max);
    if sees == 0.0 || !sees.is_finite() {
        return Err(CalibrationError::NothingSeen);
    }
    if largest == 0.0 {
        return unusable("every reading is zero: the sensor saw nothing, and no curve has a scale".to_owned());
    }
    let units = units(readings);
    let matrix = DMatrix::from_fn(m, exposures.matrix.ncols(), |i, k| exposures.matrix[(i, k)] / units[i]);
    let readings = readings.iter().map(|r| DVector::from_fn(m, |i, _| r.values[i] / units[i])).collect();
    let left_out = prior::left_out(units.iter().copied().fold(f64::INFINITY, f64::min) / largest);
    Ok(Whitened { matrix, readings, units, scale: largest / sees, left_out })
}

/// What the readings of each exposure are divided by. Exposures are shared by the channels, so is the unit of each: the channels' noise is, on every
/// instrument known here, of one size.
pub(super) fn units(readings: &[Readings]) -> Vec<f64> {
    let largest = readings.iter().flat_map(|r| &r.values).fold(0.0f64, |most, y| most.max(y.abs()));
    let exposures = readings.iter().map(|r| r.standard_uncertainties.len()).min().unwrap_or(0);
    (0..exposures)
        .map(|i| {
            let square = readings.iter().map(|r| r.standard_uncertainties[i].powi(2)).sum::<f64>() / readings.len() as f64;
            square.sqrt().hypot(ROUNDING * largest)
        })
        .collect()
}
