//! Whether twice the light reads twice as much: linearity f3 and range change f11.
//!
//! ```text
//! f3  = max over X of |Y(X) X₀ / (Y(X₀) X) − 1|
//! f11 = |Y_B(X) / Y_A(X) − 1|,  X at the top of range A
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | X | input, such as an illuminance | any |
//! | X₀ | input at which the meter is right | that of X |
//! | Y(X), Y_A, Y_B | output; in the lower and in the next higher range | any |
//!
//! The indices are those of a readout: a sensor without one is linear by its equation. Source: CIE 69 and DIN 5032-6 as the literature
//! quotes them; at which inputs the standard wants f3 and at which share of the range f11 could not be checked, so they are inputs.
//!
//! ```
//! use etendue::characterization::linearity::f3;
//!
//! // An output that saturates: Y = X / (1 + X/1000) is 0.9 % low at 10 beside what it is at 1.
//! let found = f3(&|x| x / (1.0 + x / 1000.0), &[0.1, 1.0, 10.0], 1.0)?;
//! assert!((found - (1.0 - 1.001 / 1.01)).abs() < 1e-15);
//! # Ok::<(), etendue::characterization::linearity::LinearityError>(())
//! ```

use std::fmt;

/// Why there is no index.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LinearityError {
    /// An input is not above zero and finite.
    Input(f64),
    /// The output at the input of reference is not above zero and finite.
    NoOutput(f64),
    /// The output at an input is no finite number.
    NotFinite(f64),
}

impl fmt::Display for LinearityError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Input(x) => write!(f, "an input is {x}; inputs must be above 0 and finite"),
            Self::NoOutput(y) => write!(f, "the output at the input of reference is {y}; it must be above 0 and finite"),
            Self::NotFinite(x) => write!(f, "the output at the input {x} is not a finite number"),
        }
    }
}

impl std::error::Error for LinearityError {}

/// Deviation from proportionality at one input: `Y(X) X₀ / (Y(X₀) X) − 1`.
///
/// # Errors
/// [`LinearityError`].
pub fn deviation(response: &dyn Fn(f64) -> f64, input: f64, reference: f64) -> Result<f64, LinearityError> {
    if let Some(wrong) = [input, reference].into_iter().find(|x| !(*x > 0.0 && x.is_finite())) {
        return Err(LinearityError::Input(wrong));
    }
    let right = response(reference);
    if !(right > 0.0 && right.is_finite()) {
        return Err(LinearityError::NoOutput(right));
    }
    let found = (response(input) / right) * (reference / input) - 1.0;
    if found.is_finite() { Ok(found) } else { Err(LinearityError::NotFinite(input)) }
}

/// f3, the largest deviation from proportionality over some inputs; a pure number, 0.01 for 1 %. Zero without inputs.
///
/// # Errors
/// [`LinearityError`].
pub fn f3(response: &dyn Fn(f64) -> f64, inputs: &[f64], reference: f64) -> Result<f64, LinearityError> {
    inputs.iter().try_fold(0.0, |most: f64, x| Ok(most.max(deviation(response, *x, reference)?.abs())))
}

/// f11, the jump of the output when the range is changed at an input; a pure number.
///
/// # Errors
/// [`LinearityError`].
pub fn f11(lower_range: &dyn Fn(f64) -> f64, higher_range: &dyn Fn(f64) -> f64, input: f64) -> Result<f64, LinearityError> {
    if !(input > 0.0 && input.is_finite()) {
        return Err(LinearityError::Input(input));
    }
    let before = lower_range(input);
    if !(before > 0.0 && before.is_finite()) {
        return Err(LinearityError::NoOutput(before));
    }
    let found = higher_range(input) / before - 1.0;
    if found.is_finite() { Ok(found.abs()) } else { Err(LinearityError::NotFinite(input)) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn ranges_of_different_gain_jump() {
        assert!((f11(&|x| x, &|x| 0.995 * x, 200.0).unwrap() - 0.005).abs() < 1e-15);
        assert_eq!(f11(&|x| x, &|x| x, 0.0), Err(LinearityError::Input(0.0)));
        assert_eq!(f11(&|_| 0.0, &|x| x, 1.0), Err(LinearityError::NoOutput(0.0)));
        assert!(f3(&|_| f64::NAN, &[1.0], 1.0).is_err());
        assert_eq!(f3(&|x| if x > 1.0 { f64::INFINITY } else { x }, &[2.0], 1.0), Err(LinearityError::NotFinite(2.0)));
    }

    proptest! {
        #[test]
        fn what_is_proportional_has_no_index(gain in 1e-9..1e9f64, decade in -6i32..9) {
            let inputs: Vec<f64> = (-3..6).map(|k| 10f64.powi(decade + k)).collect();
            prop_assert!(f3(&|x| gain * x, &inputs, 10f64.powi(decade)).unwrap() < 1e-14);
        }

        #[test]
        fn an_offset_shows_at_the_weakest_input(offset in 1e-6..0.1f64, weakest in 1e-3..0.5f64) {
            let found = f3(&|x| x + offset, &[weakest, 1.0], 1.0).unwrap();
            prop_assert!((found - ((1.0 + offset / weakest) / (1.0 + offset) - 1.0)).abs() < 1e-12);
        }
    }
}
