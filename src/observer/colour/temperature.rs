//! Correlated colour temperature and Duv: the nearest point of the Planckian locus in CIE 1960 u, v.
//!
//! ```text
//! T_cp = argmin_T |p − q(T)|,    (p − q(β))·q′(β) = 0,    Duv = ±|p − q(T_cp)|, positive above the locus (greenish)
//! ```
//!
//! | range | |
//! |---|---|
//! | 1000 K to infinity | the nearest point is found by its condition, not by comparing distances, so all digits count |
//! | \|Duv\| ≤ 0.05 | beyond it a colour temperature has no meaning (CIE 015:2018, section 9.5): [`NoTemperature::TooFar`] |
//!
//! The locus is that of the same observer and the same integration as the chromaticity, with c₂ of the SI ([`PlanckianLocus`]). Under
//! another c₂ all temperatures scale: 1.4388e-2 m K, of the scale of 1968, gives 1.0000161 times the temperature.

use std::fmt;

use super::planckian::PlanckianPoint;
use super::{Chromaticity, PlanckianLocus};

/// The lowest correlated colour temperature that is stated, K.
pub const LEAST_CCT_K: f64 = 1000.0;
/// The largest distance from the locus at which a correlated colour temperature has a meaning.
pub const LARGEST_DUV: f64 = 0.05;
/// A black body of exactly [`LEAST_CCT_K`] may be found this much lower, and one of infinite temperature this far beyond the end, by
/// rounding.
const ROUNDING: f64 = 1e-9;

/// A correlated colour temperature and the distance from the locus.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CorrelatedTemperature {
    /// Correlated colour temperature, K; may be infinite.
    pub cct_k: f64,
    /// Distance from the Planckian locus in CIE 1960 u, v; positive above it.
    pub duv: f64,
}

/// Why a light has no correlated colour temperature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NoTemperature {
    /// Further from the locus than [`LARGEST_DUV`].
    TooFar {
        /// Distance from the locus; positive above it.
        duv: f64,
    },
    /// The nearest black body is colder than [`LEAST_CCT_K`].
    TooCold,
    /// Bluer than a black body of infinite temperature.
    BeyondInfinity,
    /// The chromaticity or the locus is not finite.
    NotFinite,
}

impl fmt::Display for NoTemperature {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooFar { duv } => {
                write!(f, "Duv = {duv:.4} is beyond ±{LARGEST_DUV}, where a correlated colour temperature has no meaning (CIE 015)")
            }
            Self::TooCold => write!(f, "the nearest black body is colder than {LEAST_CCT_K} K"),
            Self::BeyondInfinity => f.write_str("the light is bluer than a black body of infinite temperature"),
            Self::NotFinite => f.write_str("the chromaticity is not a finite number"),
        }
    }
}

impl std::error::Error for NoTemperature {}

/// The nearest point of `locus`. Errors if there is none with a meaning; see [`NoTemperature`].
pub fn correlated_temperature(chromaticity: Chromaticity, locus: &PlanckianLocus) -> Result<CorrelatedTemperature, NoTemperature> {
    let (u, v) = chromaticity.uv_1960();
    // Along the locus towards larger β, that is colder: positive while the foot of the perpendicular is still ahead.
    let ahead = |point: &PlanckianPoint| (u - point.uv[0]) * point.duv_dbeta[0] + (v - point.uv[1]) * point.duv_dbeta[1];
    let distance = |point: &PlanckianPoint| (u - point.uv[0]).hypot(v - point.uv[1]);
    let points = locus.coarse();
    if !points.iter().all(|(_, point)| distance(point).is_finite()) {
        return Err(NoTemperature::NotFinite);
    }
    let nearest = (0..points.len()).min_by(|&i, &j| distance(&points[i].1).total_cmp(&distance(&points[j].1)));
    let Some(nearest) = nearest else { return Err(NoTemperature::NotFinite) };
    let (beta, point) = points[nearest];
    let slope = ahead(&point);
    let found = if slope == 0.0 {
        beta
    } else {
        let other = if slope > 0.0 { nearest + 1 } else { nearest.wrapping_sub(1) };
        match points.get(other) {
            None if slope > 0.0 => return Err(NoTemperature::TooCold),
            // The end of the locus itself, up to rounding.
            None if slope >= -ROUNDING * point.duv_dbeta[0].hypot(point.duv_dbeta[1]) => 0.0,
            None => return Err(NoTemperature::BeyondInfinity),
            Some((next_beta, next)) => {
                let (here, there) = ((beta, slope), (*next_beta, ahead(next)));
                let (low, high) = if beta < *next_beta { (here, there) } else { (there, here) };
                root(low, high, |beta| ahead(&locus.point(beta)))
            }
        }
    };
    if found * LEAST_CCT_K > 1.0 + ROUNDING {
        return Err(NoTemperature::TooCold);
    }
    let foot = locus.point(found);
    let [du, dv] = foot.duv_dbeta;
    // The normal to the left of the direction of growing β points up, to larger v.
    let duv = (du * (v - foot.uv[1]) - dv * (u - foot.uv[0])) / du.hypot(dv);
    if duv.abs() > LARGEST_DUV {
        return Err(NoTemperature::TooFar { duv });
    }
    Ok(CorrelatedTemperature { cct_k: 1.0 / found, duv })
}

/// The root of `f` between two places of different sign, by the Anderson–Björck variant of regula falsi, halving when it stalls.
fn root(mut low: (f64, f64), mut high: (f64, f64), f: impl Fn(f64) -> f64) -> f64 {
    let mut last = f64::NAN;
    for step in 0..200 {
        if low.1 == 0.0 {
            return low.0;
        }
        if high.1 == 0.0 {
            return high.0;
        }
        let width = high.0 - low.0;
        let middle = if step % 4 == 3 { low.0 + 0.5 * width } else { low.0 + width * (low.1 / (low.1 - high.1)) };
        if !(low.0 < middle && middle < high.0) {
            return middle.clamp(low.0, high.0);
        }
        // Two steps at one place: what is left is rounding.
        if (middle - last).abs() <= 4.0 * f64::EPSILON * middle {
            return middle;
        }
        last = middle;
        let value = f(middle);
        // Each side keeps its sign; a value of the side that stays is weighted down so that it is not kept for ever.
        if (value > 0.0) == (low.1 > 0.0) {
            let kept = 1.0 - value / low.1;
            high.1 *= if kept > 0.0 { kept } else { 0.5 };
            low = (middle, value);
        } else {
            let kept = 1.0 - value / high.1;
            low.1 *= if kept > 0.0 { kept } else { 0.5 };
            high = (middle, value);
        }
    }
    0.5 * (low.0 + high.0)
}
