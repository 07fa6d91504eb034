//! A figure of a data sheet: a value with its standard uncertainty.

/// A value with its standard uncertainty, both in the unit that stands beside them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Figure {
    /// The value.
    pub value: f64,
    /// Standard uncertainty, zero or more.
    pub standard_uncertainty: f64,
}

/// Relative half-width within which double-precision arithmetic keeps an exact integral.
const ARITHMETIC: f64 = 1e-12;

impl Figure {
    /// A figure from exact integrals: uncertain by their arithmetic alone, on numbers of the size `scale`.
    #[must_use]
    pub fn exact(value: f64, scale: f64) -> Self {
        Self { value, standard_uncertainty: ARITHMETIC * scale.abs().max(value.abs()) / 3f64.sqrt() }
    }

    /// The figure in another unit.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        Self { value: factor * self.value, standard_uncertainty: (factor * self.standard_uncertainty).abs() }
    }

    /// |difference| over the joint standard uncertainty; zero for equal values.
    #[must_use]
    pub fn deviation_u(&self, other: &Self) -> f64 {
        let apart = (self.value - other.value).abs();
        if apart == 0.0 { 0.0 } else { apart / self.standard_uncertainty.hypot(other.standard_uncertainty) }
    }
}

/// `√Σ u²` over independent contributions.
pub(super) fn in_quadrature(contributions: &[f64]) -> f64 {
    contributions.iter().fold(0.0, |sum: f64, u| sum.hypot(*u))
}
