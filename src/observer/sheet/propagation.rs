//! From the uncertainty of the integrals to that of a row: `u² = Σ_kl J_k C_kl J_l`, J by central differences (GUM 5.2.2).
//!
//! A row says itself on which integrals it depends: those that it asks for. Its differences are taken over a hundredth of their
//! standard uncertainty, or 1e-5 of their size where that is more, so that rounding stays out of sight.

use std::cell::RefCell;

use super::functional::{Functional, Functionals, Spread};
use super::{Compute, SheetValue};

/// Share of a standard uncertainty over which differences are taken.
const STEP_IN_U: f64 = 1e-2;
/// Least step, as a share of the value.
const LEAST_STEP: f64 = 1e-5;

/// Standard uncertainty of a row; `None` if it is not differentiable here, such as at the edge of where it is defined.
pub(super) fn standard_uncertainty(functionals: &Functionals, integrals: &[f64], spread: &Spread, compute: &Compute) -> Option<f64> {
    let asked = RefCell::new(Vec::new());
    compute(&|wanted: Functional| {
        let place = functionals.place(wanted);
        if !asked.borrow().contains(&place) {
            asked.borrow_mut().push(place);
        }
        functionals.pick(integrals, wanted)
    });
    let mut gradient = Vec::new();
    for place in asked.into_inner() {
        let (value, u) = (*integrals.get(place)?, spread.standard_uncertainty(place)?);
        if u == 0.0 {
            continue;
        }
        let step = (STEP_IN_U * u).max(LEAST_STEP * value.abs());
        let moved = |by: f64| {
            let mut shifted = integrals.to_vec();
            shifted[place] = value + by;
            match compute(&|wanted: Functional| functionals.pick(&shifted, wanted)) {
                SheetValue::Number(number) if number.is_finite() => Some((number, shifted[place])),
                _ => None,
            }
        };
        let ((high, at_high), (low, at_low)) = (moved(step)?, moved(-step)?);
        gradient.push((place, (high - low) / (at_high - at_low)));
    }
    let variance_of =
        |spread: &[Vec<f64>]| gradient.iter().map(|(k, a)| gradient.iter().map(|(l, b)| a * b * spread[*k][*l]).sum::<f64>()).sum::<f64>();
    let u = match spread {
        // Rounding can leave a variance of nothing slightly below zero.
        Spread::Each(covariance) => variance_of(covariance).max(0.0).sqrt(),
        Spread::Together(moves) => gradient.iter().map(|(k, a)| a * moves[*k]).sum::<f64>().abs(),
    };
    u.is_finite().then_some(u)
}

impl Spread {
    fn standard_uncertainty(&self, place: usize) -> Option<f64> {
        match self {
            Self::Each(covariance) => covariance.get(place).and_then(|row| row.get(place)).map(|variance| variance.sqrt()),
            Self::Together(moves) => moves.get(place).map(|value| value.abs()),
        }
    }
}
