//! Many integrals of one density at once: `∫ φ fᵢ dλ` for a list of factors.
//!
//! A table times a table is cheap, but a black body or a Gaussian has to be evaluated often on every piece. Where all factors are linear on
//! the pieces between the union of their breakpoints, two integrals a piece serve all of them:
//!
//! ```text
//! ∫ₐᵇ φ f dλ = f(a⁺) ∫ₐᵇ φ (b − λ)/(b − a) dλ + f(b⁻) ∫ₐᵇ φ (λ − a)/(b − a) dλ
//! ```

use super::term::terms;
use super::{Density, Factor, Outside, SpectrumError, Table};

/// Values this small are about to lose their digits to the range of `f64`: Simpson's rule is enough for them, and no refinement could agree.
const NEXT_TO_NOTHING: f64 = 1e-280;

impl Density {
    /// [`Density::integral`] for each of `factors`: the same values, to rounding, for less work.
    pub fn integrals(&self, factors: &[&Factor]) -> Vec<f64> {
        let one_by_one = || factors.iter().map(|factor| self.integral(&[factor])).collect();
        let curved = terms(self, &[]).iter().any(|term| term.degree().is_none());
        if !curved || factors.len() < 3 {
            return one_by_one();
        }
        self.by_pieces(factors).unwrap_or_else(|_| one_by_one())
    }

    fn by_pieces(&self, factors: &[&Factor]) -> Result<Vec<f64>, SpectrumError> {
        let (scale, continuum, _) = self.parts();
        let (unscaled, lines) = (Self::new(continuum.clone(), &[])?, Self::lines_only(&self.lines())?);
        let is_linear: Vec<bool> = factors.iter().map(|factor| is_linear_between_breakpoints(factor)).collect();
        let linear = || factors.iter().zip(&is_linear).filter(|(_, linear)| **linear).map(|(factor, _)| *factor);
        let mut edges_nm: Vec<f64> = linear().flat_map(Factor::breakpoints).collect();
        edges_nm.sort_by(f64::total_cmp);
        edges_nm.dedup();
        let mut sums = vec![0.0; factors.len()];
        for pair in edges_nm.windows(2) {
            let (low, high) = (pair[0], pair[1]);
            let [first, middle, last] = [low, 0.5 * (low + high), high].map(|nm| continuum.at(nm));
            let part = |at_low: f64, at_high: f64| -> Result<f64, SpectrumError> {
                let ramp = Table::new(vec![low, high], vec![at_low, at_high], Outside::Zero)?;
                Ok(unscaled.integral(&[&Factor::Table(ramp)]))
            };
            let (falling, rising) = if first.max(middle).max(last) > NEXT_TO_NOTHING {
                (part(1.0, 0.0)?, part(0.0, 1.0)?)
            } else {
                let sixth = (high - low) / 6.0;
                (sixth * (first + 2.0 * middle), sixth * (2.0 * middle + last))
            };
            for (sum, factor) in sums.iter_mut().zip(factors) {
                // From inside: at an end itself a factor may jump.
                let (first, second) = (factor.at(low + 0.25 * (high - low)), factor.at(low + 0.75 * (high - low)));
                let half_step = 0.5 * (second - first);
                *sum += (first - half_step) * falling + (second + half_step) * rising;
            }
        }
        let value = |i: usize| match is_linear[i] {
            true => sums[i] * scale + lines.integral(&[factors[i]]),
            false => self.integral(&[factors[i]]),
        };
        Ok((0..factors.len()).map(value).collect())
    }
}

/// Whether a factor is linear on all pieces between its breakpoints and zero beyond them.
fn is_linear_between_breakpoints(factor: &Factor) -> bool {
    let breakpoints = factor.breakpoints();
    match (factor.support().hull(), breakpoints.first(), breakpoints.last()) {
        (Some((from_nm, to_nm)), Some(first), Some(last)) => {
            factor.degree().is_some_and(|degree| degree <= 1) && first <= &from_nm && &to_nm <= last
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::library;

    #[test]
    fn integrals_at_once_are_those_one_by_one() {
        let list = [
            library::v_lambda(),
            library::factor("CIE 1931 2 Degree Standard Observer z_bar").unwrap(),
            library::factor("V'(lambda)").unwrap(),
            Factor::ONE,
            Factor::Proportional(2.0),
            Factor::Band { from_nm: 0.0, to_nm: 380.0, value: 1.0 },
            Factor::Product(vec![Factor::Proportional(1e-3), Factor::Band { from_nm: 400.0, to_nm: 700.0, value: 1.0 }]),
            Factor::Gaussian { peak: 1.0, centre_nm: 500.0, sigma_nm: 10.0 },
        ];
        let factors: Vec<&Factor> = list.iter().collect();
        let densities = [
            Density::black_body(3000.0).unwrap(),
            Density::black_body(600.0).unwrap(),
            Density::illuminant_a(),
            Density::led(620.0, 20.0).unwrap().plus(&Density::line(380.0, 2.0).unwrap()),
            Density::gaussian(1e-290, 555.0, 1e-3).unwrap(),
            Density::gaussian(1.0, 950.0, 12.0).unwrap(),
            library::density("FL11").unwrap(),
            Density::line(555.0, 1.0).unwrap(),
            Density::zero(),
        ];
        for density in densities {
            for (factor, found) in factors.iter().zip(density.integrals(&factors)) {
                let expected = density.integral(&[factor]);
                assert!((found - expected).abs() <= 1e-11 * expected.abs(), "{density:?} {factor:?}: {found:e} {expected:e}");
            }
        }
    }
}
