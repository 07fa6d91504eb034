//! Group g5: responsivity curves fitted by the default settings, against true curves and the errors of other programs.
//!
//! ```text
//! rmse, eigenvectors   √ mean (s − s₀)² / max s₀, over that of another program: at most 1.10 times, and less than it
//! bands                share of the nodes with |s − s₀| > 2.58 u: at most 5 %
//! ```
//!
//! The reference of these cases is zero, error or share, and the tolerance is the bound: the limit says how much of it is used up.

mod data;
mod problem;

use super::{Families, Outcome};
use crate::calibration::{FitOptions, fit};
use crate::study::verify::case::{Case, Fault};
use problem::Problem;

pub(super) const FAMILIES: Families = &[
    ("g5a.rmse", rmse),
    ("g5a.bands", bands),
    ("g5b.rmse", rmse),
    ("g5b.bands", bands),
    ("g5c.rmse", rmse),
    ("g5c.bands", bands),
    ("g5c.eigenvectors", rmse),
];

/// Coverage factor of a band that holds 99 % of a normal distribution.
const BAND_99: f64 = 2.58;

/// How far a fit is off.
struct Judged {
    /// Root of the mean square error over the peak of the truth.
    rmse: f64,
    /// Share of the nodes outside of their bands.
    outside: f64,
}

fn judged(c: &Case) -> Result<Judged, Fault> {
    let problem = Problem::new(c.text("problem")?)?;
    let options = FitOptions { prior: problem.prior.clone(), ..FitOptions::default() };
    let fitted = fit(&problem.exposures, &problem.readings, &options)?;
    let peak = problem.truths.iter().flatten().fold(0.0f64, |most, s| most.max(*s));
    let (mut square, mut outside, mut count) = (0.0, 0.0, 0.0);
    for (curve, truth) in fitted.curves.iter().zip(&problem.truths) {
        let u = curve.standard_uncertainties();
        for (k, nm) in fitted.wavelengths_nm.iter().enumerate() {
            if problem.evaluated_nm.contains(nm) {
                let error = curve.values[k] - truth[k];
                square += error * error;
                outside += f64::from(error.abs() > BAND_99 * u[k]);
                count += 1.0;
            }
        }
    }
    Ok(Judged { rmse: (square / count).sqrt() / peak, outside: outside / count })
}

/// Error over that of another program.
fn rmse(c: &Case) -> Outcome {
    Ok((judged(c)?.rmse / c.number("rmse")?).into())
}

/// Nodes outside of their bands, %.
fn bands(c: &Case) -> Outcome {
    Ok((100.0 * judged(c)?.outside).into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_table_is_of_a_problem_and_every_problem_has_its_tables() {
        let mut folders: Vec<&str> = data::TABLES.iter().filter_map(|(path, _)| path.split('/').next()).collect();
        folders.dedup();
        assert_eq!(folders.len(), 15);
        for id in ["mono_vlux_bw5_step5", "broad_vlux_cond1e12_noise0.001", "camera_nikon_D65+A+FL2_noise0.0002"] {
            let problem = Problem::new(id).unwrap_or_else(|fault| panic!("{fault}"));
            assert!(problem.readings.iter().all(|r| r.values.len() == problem.exposures.len()), "{id}");
            assert!(problem.truths.iter().all(|t| t.len() == problem.exposures.wavelengths_nm().len()), "{id}");
        }
        assert!(matches!(Problem::new("mono_none"), Err(Fault::NoTable(name)) if name == "mono_none/truth.csv"));
    }
}
