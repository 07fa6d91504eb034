//! How well a directional response follows the cosine: the index f2.
//!
//! ```text
//! f2 = ∫₀^ε_max |Y(ε) / (Y(0) cos ε) − 1| sin 2ε dε = ∫₀^ε_max |R(ε)/R(0) − 1| sin 2ε dε
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | ε | angle of incidence, from the normal | rad |
//! | Y(ε) | output for the same beam at ε | any |
//! | R(ε) = Y(ε)/cos ε | relative directional response, as sensors have it: 1 for an ideal cosine receptor | any |
//! | ε_max | upper angle, 80° or 85° in texts on the subject | rad |
//!
//! The upper angle could not be checked against the text of the standard, so it is an input. The index is that of one azimuth.
//!
//! Source: ISO/CIE 19476 and DIN 5032-6 as the literature quotes them.
//!
//! ```
//! use etendue::characterization::directional_mismatch::f2;
//! use etendue::sensor::Acceptance;
//!
//! assert_eq!(f2(&Acceptance::Cosine, 0.0, 80f64.to_radians())?, 0.0);
//! # Ok::<(), etendue::characterization::directional_mismatch::DirectionalError>(())
//! ```

use std::f64::consts::FRAC_PI_2;
use std::fmt;

use crate::sensor::Acceptance;

/// Relative tolerance of the quadrature of a smooth piece, of the whole index.
const REL_TOL: f64 = 1e-12;
/// Most halvings of a piece; a kink that nobody announced is closed in by them.
const MOST_HALVINGS: u32 = 40;
/// Pieces into which the range is cut at least, so that no bump falls between the points of the quadrature.
const PIECES: u32 = 32;

/// Why there is no index.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum DirectionalError {
    /// The upper angle is not above 0 and at most π/2.
    UpperAngle(f64),
    /// The response along the normal is not finite and above zero.
    NoResponse(f64),
    /// The response at an angle is not a finite number.
    NotFinite(f64),
    /// A head that sees all round is not meant to follow the cosine of an angle from its normal.
    SeesAllRound,
}

impl fmt::Display for DirectionalError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UpperAngle(angle) => write!(f, "the upper angle is {angle} rad; it must be above 0 and at most π/2"),
            Self::NoResponse(value) => write!(f, "the response along the normal is {value}; it must be finite and above 0"),
            Self::NotFinite(angle) => write!(f, "the response at {angle} rad is not a finite number"),
            Self::SeesAllRound => write!(f, "a head that sees all round does not follow the cosine; this index is that of plane receptors"),
        }
    }
}

impl std::error::Error for DirectionalError {}

/// f2 of a sensor's acceptance in the half plane of azimuth `azimuth_rad`, up to `upper_rad`; a pure number, 0.03 for 3 %.
///
/// # Errors
/// [`DirectionalError`].
pub fn f2(acceptance: &Acceptance, azimuth_rad: f64, upper_rad: f64) -> Result<f64, DirectionalError> {
    let kinks = match acceptance {
        _ if acceptance.head().is_some() => return Err(DirectionalError::SeesAllRound),
        Acceptance::Cone { half_angle_rad } => vec![*half_angle_rad],
        Acceptance::Directional(table) => table.rotationally_symmetric().map_or_else(Vec::new, |(theta, _)| theta.to_vec()),
        _ => Vec::new(),
    };
    let response = |angle_rad: f64| acceptance.at(angle_rad.cos(), angle_rad.sin(), azimuth_rad);
    f2_of_response(&response, &kinks, upper_rad)
}

/// f2 of a relative directional response `R(ε)`, ε in rad, without the cosine; `kinks_rad` are the angles at which its slope or its value
/// jumps (the nodes of a table), in any order.
///
/// # Errors
/// [`DirectionalError`].
///
/// ```
/// use etendue::characterization::directional_mismatch::f2_of_response;
///
/// // A bare detector, Y = 1: R = 1/cos ε, and f2 = (1 − cos ε_max)².
/// let f2 = f2_of_response(&|angle_rad| 1.0 / angle_rad.cos(), &[], 85f64.to_radians())?;
/// assert!((f2 - (1.0 - 85f64.to_radians().cos()).powi(2)).abs() < 1e-12);
/// # Ok::<(), etendue::characterization::directional_mismatch::DirectionalError>(())
/// ```
pub fn f2_of_response(response: &dyn Fn(f64) -> f64, kinks_rad: &[f64], upper_rad: f64) -> Result<f64, DirectionalError> {
    if !(upper_rad > 0.0 && upper_rad <= FRAC_PI_2) {
        return Err(DirectionalError::UpperAngle(upper_rad));
    }
    let along_normal = response(0.0);
    if !(along_normal.is_finite() && along_normal > 0.0) {
        return Err(DirectionalError::NoResponse(along_normal));
    }
    let deviation = |angle: f64| response(angle) / along_normal - 1.0;
    let mut ends: Vec<f64> = (0..=PIECES).map(|k| upper_rad * f64::from(k) / f64::from(PIECES)).collect();
    ends.extend(kinks_rad.iter().copied().filter(|kink| 0.0 < *kink && *kink < upper_rad));
    ends.sort_by(f64::total_cmp);
    if let Some(angle) = ends.iter().find(|angle| !deviation(**angle).is_finite()) {
        return Err(DirectionalError::NotFinite(*angle));
    }
    // Where the deviation changes its sign, its magnitude has a kink.
    let crossings: Vec<f64> = ends.windows(2).filter_map(|end| crossing(&deviation, end[0], end[1])).collect();
    ends.extend(crossings);
    ends.sort_by(f64::total_cmp);
    let integrand = |angle: f64| deviation(angle).abs() * (2.0 * angle).sin();
    let coarse: f64 = ends.windows(2).map(|end| (end[1] - end[0]) * integrand(0.5 * (end[0] + end[1]))).sum();
    let sum: f64 = ends.windows(2).map(|end| piece(&integrand, end[0], end[1], coarse)).sum();
    if sum.is_finite() { Ok(sum) } else { Err(DirectionalError::NotFinite(upper_rad)) }
}

/// Where a function that has different signs at two angles changes it, by halving.
fn crossing(f: &dyn Fn(f64) -> f64, mut low: f64, mut high: f64) -> Option<f64> {
    let rises = f(low) < 0.0;
    if f(low) * f(high) >= 0.0 {
        return None;
    }
    // 64 halvings bring any two angles to neighbouring numbers.
    for _ in 0..64 {
        let middle = 0.5 * (low + high);
        if (f(middle) < 0.0) == rises { low = middle } else { high = middle }
    }
    Some(0.5 * (low + high))
}

/// A piece between two angles, taken just inside them: the value at a jump belongs to one side only.
fn piece(f: &dyn Fn(f64) -> f64, low: f64, high: f64, whole: f64) -> f64 {
    let (low, high) = (low.next_up(), high.next_down());
    if low >= high {
        return 0.0;
    }
    let [at_low, at_middle, at_high] = [low, 0.5 * (low + high), high].map(f);
    let simpson = (high - low) / 6.0 * (at_low + 4.0 * at_middle + at_high);
    adaptive(f, [low, high], [at_low, at_middle, at_high], simpson, REL_TOL * whole, MOST_HALVINGS)
}

/// Simpson's rule, halved until both halves agree with the whole (with Richardson's correction).
fn adaptive(f: &dyn Fn(f64) -> f64, [low, high]: [f64; 2], [a, m, b]: [f64; 3], whole: f64, tolerance: f64, halvings: u32) -> f64 {
    let middle = 0.5 * (low + high);
    let [left_middle, right_middle] = [0.5 * (low + middle), 0.5 * (middle + high)].map(f);
    let third = (middle - low) / 6.0;
    let (left, right) = (third * (a + 4.0 * left_middle + m), third * (m + 4.0 * right_middle + b));
    let error = (left + right - whole) / 15.0;
    if halvings == 0 || error.is_nan() || error.abs() <= tolerance {
        return left + right + error;
    }
    let half = |ends, values, sum| adaptive(f, ends, values, sum, 0.5 * tolerance, halvings - 1);
    half([low, middle], [a, left_middle, m], left) + half([middle, high], [m, right_middle, b], right)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sensor::acceptance::DirectionalResponse;
    use proptest::prelude::*;

    #[test]
    fn a_cone_misses_all_that_is_beyond_it() {
        // |0 − 1| sin 2ε from α to the upper angle.
        let (half_angle_rad, upper) = (0.5, 1.4);
        let found = f2(&Acceptance::Cone { half_angle_rad }, 0.0, upper).unwrap();
        assert!((found - 0.5 * ((2.0 * half_angle_rad).cos() - (2.0 * upper).cos())).abs() < 1e-12, "{found}");
    }

    #[test]
    fn what_has_no_index_is_refused() {
        let one = |_: f64| 1.0;
        for upper in [0.0, -1.0, f64::NAN, 1.6] {
            assert!(matches!(f2_of_response(&one, &[], upper), Err(DirectionalError::UpperAngle(_))), "{upper}");
        }
        for normal in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(f2_of_response(&|_| normal, &[], 1.0), Err(DirectionalError::NoResponse(_))), "{normal}");
        }
        let broken = |angle: f64| if angle > 0.5 { f64::NAN } else { 1.0 };
        assert!(matches!(f2_of_response(&broken, &[], 1.0), Err(DirectionalError::NotFinite(_))));
    }

    proptest! {
        #[test]
        fn a_table_has_the_integral_of_its_straight_lines(a in 0.7..1.3f64, b in 0.7..1.3f64, knee in 0.3..1.2f64) {
            let table = DirectionalResponse::new(vec![0.0, knee, FRAC_PI_2], vec![0.0], vec![vec![1.0, a, b]]).unwrap();
            let found = f2(&Acceptance::Directional(table), 0.0, FRAC_PI_2).unwrap();
            // ∫ (p + qε) sin 2ε dε = −(p + qε) cos 2ε / 2 + q sin 2ε / 4, between the changes of sign.
            let stretch = |from: f64, to: f64, at_from: f64, at_to: f64| {
                let q = (at_to - at_from) / (to - from);
                let primitive = |e: f64| -(at_from + q * (e - from)) * (2.0 * e).cos() / 2.0 + q * (2.0 * e).sin() / 4.0;
                (primitive(to) - primitive(from)).abs()
            };
            let (first, x, y) = (stretch(0.0, knee, 0.0, a - 1.0), a - 1.0, b - 1.0);
            let second = if x * y < 0.0 {
                let zero = knee + (FRAC_PI_2 - knee) * x / (x - y);
                stretch(knee, zero, x, 0.0) + stretch(zero, FRAC_PI_2, 0.0, y)
            } else {
                stretch(knee, FRAC_PI_2, x, y)
            };
            prop_assert!((found - first - second).abs() < 1e-10, "{} {}", found, first + second);
        }

        #[test]
        fn the_index_forgets_the_scale_and_grows_with_the_angle(scale in 1e-250..1e250f64, upper in 0.3..1.4f64) {
            let r = |angle: f64| scale * (1.0 - 0.05 * angle.sin().powi(2));
            let found = f2_of_response(&r, &[], upper).unwrap();
            // 0.05 ∫ sin² ε sin 2ε dε = 0.05 sin⁴ ε_max / 2.
            prop_assert!((found / (0.025 * upper.sin().powi(4)) - 1.0).abs() < 1e-10);
            prop_assert!(f2_of_response(&r, &[], upper + 0.1).unwrap() > found);
        }
    }
}
