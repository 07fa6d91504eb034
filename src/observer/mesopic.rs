//! Mesopic vision between 0.005 cd/m² and 5 cd/m²: the system MES2.
//!
//! ```text
//! L_mes = (m L_p + (1 − m) L_s v) / (m + (1 − m) v)          v = V′(λ₀) = 683/1699
//! m     = 0.7670 + 0.3334 log₁₀ L_mes,  at least 0, at most 1
//! V_mes = (m V + (1 − m) V′) / M(m),    maximum 1
//! ```
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | L_p, L_s | photopic and scotopic luminance; L_s = (S/P) L_p | cd/m² | not negative |
//! | m | coefficient of adaptation: 0 for rods alone, 1 for cones alone | 1 | 0 to 1 |
//! | M(m) | what makes the maximum of V_mes one | 1 | |
//! | λ₀ | 555 nm | | |
//!
//! # Solution
//!
//! The publication iterates from m = 0.5. Written as `h(m) = m − (0.7670 + 0.3334 log₁₀ L_mes(m))`, the root is bracketed instead:
//! * S/P ≥ 1: L_mes falls with m, so h rises and has one root, or none within 0 to 1, which then ends at the nearer bound.
//! * S/P < 1: L_mes rises with m, so the iteration moves one way only; h is convex (the slope of ln L_mes is a constant over the product of
//!   two rising functions), so it has at most two roots, and the one that the iteration ends at is bracketed by the minimum
//!   of h. Two roots exist only for light that rods hardly see (S/P below 0.27).
//!
//! The quotient K′_m/K_m of this system is 1699/683: with S/P = 1699/683 ∫V′/∫V, L_mes is the integral with V_mes and
//! [`max_efficacy_lm_w`]. Source: CIE 191:2010.

use super::error::within;
use super::{Efficiency, ObserverError};
use crate::quantity::constants::K_M_LM_W;
use crate::spectrum::Factor;

/// V′(λ₀) of the system.
pub const V_PRIME_AT_555_NM: f64 = 683.0 / 1699.0;
/// K′_m/K_m of the system.
pub const EFFICACY_RATIO: f64 = 1699.0 / 683.0;
const A: f64 = 0.7670;
const B: f64 = 0.3334;
/// Halvings of an interval of length one: below the spacing of `f64` at 10⁻³.
const HALVINGS: usize = 64;

/// The state of an eye that looks at a luminance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mesopic {
    /// Coefficient of adaptation m, 0 (scotopic) to 1 (photopic).
    pub adaptation: f64,
    /// Mesopic luminance L_mes, cd/m².
    pub luminance_cd_m2: f64,
}

/// Mesopic luminance of a field with the photopic luminance `photopic_cd_m2`, in cd/m², and the quotient `sp_ratio` of its scotopic and
/// photopic luminance, to which the eye is adapted.
///
/// Errors if the luminance is not within 0 to 1e300 cd/m² or the quotient not within 0 to 1e6.
///
/// ```
/// use etendue::observer::mesopic::mesopic;
///
/// // White LEDs (S/P = 2) look brighter at night than sodium lamps (S/P = 0.5) of the same photopic luminance.
/// let (led, sodium) = (mesopic(0.1, 2.0)?, mesopic(0.1, 0.5)?);
/// assert!(led.luminance_cd_m2 > 0.1 && sodium.luminance_cd_m2 < 0.1);
/// # Ok::<(), etendue::observer::ObserverError>(())
/// ```
pub fn mesopic(photopic_cd_m2: f64, sp_ratio: f64) -> Result<Mesopic, ObserverError> {
    let photopic = within("the photopic luminance", photopic_cd_m2, 0.0, 1e300, "cd/m²")?;
    let ratio = within("the S/P ratio", sp_ratio, 0.0, 1e6, "")?;
    let adaptation = adaptation(photopic, ratio);
    Ok(Mesopic { adaptation, luminance_cd_m2: photopic * relative_luminance(adaptation, ratio) })
}

/// L_mes/L_p. The weights are written so that m = 0 and m = 1 give the S/P ratio and 1 exactly.
fn relative_luminance(m: f64, ratio: f64) -> f64 {
    let rods = (1.0 - m) * V_PRIME_AT_555_NM;
    if m == 0.0 { ratio } else { (m + rods * ratio) / (m + rods) }
}

/// The limit of the iteration from m = 0.5; see the head of this file.
fn adaptation(photopic: f64, ratio: f64) -> f64 {
    // A luminance of zero has the logarithm −∞, so that rods alone remain.
    let h = |m: f64| m - (A + B * (photopic.log10() + relative_luminance(m, ratio).log10()));
    if ratio >= 1.0 {
        return root(&h, 0.0, 1.0);
    }
    if h(0.5) <= 0.0 {
        return root(&h, 0.5, 1.0);
    }
    // The minimum of h, where the slope of B log₁₀ L_mes is one; the slope falls as m rises.
    let v = V_PRIME_AT_555_NM;
    let slope = |m: f64| B / std::f64::consts::LN_10 * v * (1.0 - ratio) / ((m + (1.0 - m) * v * ratio) * (m + (1.0 - m) * v));
    let minimum = root(&|m| 1.0 - slope(m), 0.0, 0.5);
    if h(minimum) > 0.0 { 0.0 } else { root(&h, minimum, 0.5) }
}

/// Where `f`, which rises from `low` to `high`, is zero; the nearer bound if it is nowhere.
fn root(f: &dyn Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    if f(low) >= 0.0 {
        return low;
    }
    if f(high) <= 0.0 {
        return high;
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if f(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// V_mes(λ) for the coefficient of adaptation `m`, 1 at its maximum: V(λ) for 1, V′(λ) for 0. Errors if `m` is not within 0 to 1.
///
/// ```
/// use etendue::observer::mesopic::curve;
///
/// let half_way = curve(0.5)?;
/// assert!(half_way.at(520.0) > 0.9 && half_way.at(520.0) <= 1.0);
/// # Ok::<(), etendue::observer::ObserverError>(())
/// ```
pub fn curve(m: f64) -> Result<Factor, ObserverError> {
    let m = within("the coefficient of adaptation", m, 0.0, 1.0, "")?;
    Ok(weighted(m).scaled(1.0 / maximum(m)))
}

/// Maximum luminous efficacy `K_m / V_mes(λ₀)` for the coefficient of adaptation `m`, lm/W: 683.002 for 1, 1699.005 for 0.
/// Errors if `m` is not within 0 to 1.
///
/// ```
/// use etendue::observer::mesopic::max_efficacy_lm_w;
///
/// assert_eq!(max_efficacy_lm_w(1.0)?, 683.002);
/// assert!((max_efficacy_lm_w(0.0)? - 1699.005).abs() < 1e-3);
/// # Ok::<(), etendue::observer::ObserverError>(())
/// ```
pub fn max_efficacy_lm_w(m: f64) -> Result<f64, ObserverError> {
    let m = within("the coefficient of adaptation", m, 0.0, 1.0, "")?;
    Ok(K_M_LM_W * maximum(m) / (m + (1.0 - m) * V_PRIME_AT_555_NM))
}

/// m V + (1 − m) V′.
fn weighted(m: f64) -> Factor {
    let part = |weight: f64, efficiency: Efficiency| efficiency.curve().scaled(weight);
    Factor::Sum(vec![part(m, Efficiency::Photopic1924), part(1.0 - m, Efficiency::Scotopic1951)])
}

/// M(m): a piecewise-linear function has its maximum at a node.
fn maximum(m: f64) -> f64 {
    let sum = weighted(m);
    sum.breakpoints().into_iter().map(|nm| sum.at(nm)).fold(0.0, f64::max)
}
