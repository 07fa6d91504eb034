//! Chromaticity coordinates (CIE 015:2018, sections 7.3 and 8.1):
//!
//! ```text
//! x  = X/(X + Y + Z)               y  = Y/(X + Y + Z)
//! u′ = 4x/(3 − 2x + 12y)           v′ = 9y/(3 − 2x + 12y)          CIE 1976 UCS
//! u  = u′                          v  = ⅔ v′                       CIE 1960 UCS, in which colour temperature is defined
//! x  = 9u′/(6u′ − 16v′ + 12)       y  = 4v′/(6u′ − 16v′ + 12)
//! ```

use super::Tristimulus;

/// A point of the CIE x, y diagram.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Chromaticity {
    /// x.
    pub x: f64,
    /// y.
    pub y: f64,
}

impl Chromaticity {
    /// CIE 1976 u′ and v′. Infinite only where `3 − 2x + 12y` is zero, far from every light.
    pub fn uv_prime(&self) -> (f64, f64) {
        let denominator = 3.0 - 2.0 * self.x + 12.0 * self.y;
        (4.0 * self.x / denominator, 9.0 * self.y / denominator)
    }

    /// CIE 1960 u and v.
    pub fn uv_1960(&self) -> (f64, f64) {
        let denominator = 3.0 - 2.0 * self.x + 12.0 * self.y;
        (4.0 * self.x / denominator, 6.0 * self.y / denominator)
    }

    /// From CIE 1976 u′ and v′.
    pub fn from_uv_prime(u_prime: f64, v_prime: f64) -> Self {
        let denominator = 6.0 * u_prime - 16.0 * v_prime + 12.0;
        Self { x: 9.0 * u_prime / denominator, y: 4.0 * v_prime / denominator }
    }

    /// From CIE 1960 u and v.
    pub fn from_uv_1960(u: f64, v: f64) -> Self {
        Self::from_uv_prime(u, 1.5 * v)
    }

    /// The tristimulus values of this chromaticity with a given Y. `None` where y is zero, which no Y above 0 can have.
    pub fn with_luminance(&self, y: f64) -> Option<Tristimulus> {
        let scale = y / self.y;
        scale.is_finite().then_some(Tristimulus { x: self.x * scale, y, z: (1.0 - self.x - self.y) * scale })
    }

    /// Distance from another point in the x, y diagram.
    pub fn distance(&self, other: &Self) -> f64 {
        (self.x - other.x).hypot(self.y - other.y)
    }
}
