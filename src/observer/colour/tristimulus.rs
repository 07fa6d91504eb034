//! Tristimulus values: `X = k ∫ φ x̄ dλ`, `Y = k ∫ φ ȳ dλ`, `Z = k ∫ φ z̄ dλ` (CIE 015:2018, section 7).
//!
//! | k | result |
//! |---|---|
//! | 1 | in the unit of the density times nm ([`Tristimulus::of`]) |
//! | K_m = 683.002 lm W⁻¹ | Y is the luminance, illuminance, … of a density in W ([`Tristimulus::absolute`]) |
//! | 100/Y_w | relative to a white that has Y = 100 ([`Tristimulus::relative_to`]) |
//!
//! The same integrals with r̄, ḡ, b̄ are the R, G, B of a lecture, and with cone fundamentals the excitations of the cones.

use super::Chromaticity;
use crate::quantity::constants::K_M_LM_W;
use crate::spectrum::{Density, Factor};

/// Three integrals of a density over three functions of wavelength.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tristimulus {
    /// X, or the first of the three.
    pub x: f64,
    /// Y, or the second of the three.
    pub y: f64,
    /// Z, or the third of the three.
    pub z: f64,
}

impl Tristimulus {
    /// `∫ φ x̄ dλ` and so on, in the unit of the density times nm; exact between breakpoints, lines count with their power.
    pub fn of(density: &Density, matching: &[Factor; 3]) -> Self {
        let [x, y, z] = matching.each_ref().map(|function| density.integral(&[function]));
        Self { x, y, z }
    }

    /// With K_m = 683.002 lm W⁻¹: for a density in W m⁻² sr⁻¹ nm⁻¹, Y is the luminance in cd m⁻²; in W m⁻² nm⁻¹, the illuminance in lx.
    pub fn absolute(density: &Density, matching: &[Factor; 3]) -> Self {
        let [x, y, z] = matching.each_ref().map(|function| density.integral(&[function, &Factor::Constant(K_M_LM_W)]));
        Self { x, y, z }
    }

    /// Multiplied so that `white` has Y = 100. `None` if the white has no Y.
    pub fn relative_to(&self, white: &Self) -> Option<Self> {
        let scale = 100.0 / white.y;
        (scale.is_finite() && scale > 0.0).then(|| self.scaled(scale))
    }

    /// All three times `scale`.
    pub fn scaled(&self, scale: f64) -> Self {
        Self { x: self.x * scale, y: self.y * scale, z: self.z * scale }
    }

    /// The sum of two lights.
    pub fn plus(&self, other: &Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }

    /// X, Y, Z.
    pub fn to_array(self) -> [f64; 3] {
        [self.x, self.y, self.z]
    }

    /// x and y. `None` if X + Y + Z is zero or a value is not finite: what is dark has no colour.
    pub fn chromaticity(&self) -> Option<Chromaticity> {
        let size = self.to_array().into_iter().fold(0.0, |size: f64, value| size.max(value.abs()));
        if size == 0.0 || !self.to_array().into_iter().all(f64::is_finite) {
            return None;
        }
        // Divided by the largest first, so that neither the sum nor the quotients leave the range of f64.
        let [x, y, z] = self.to_array().map(|value| value / size);
        let sum = x + y + z;
        (sum != 0.0).then(|| Chromaticity { x: x / sum, y: y / sum })
    }
}

impl From<[f64; 3]> for Tristimulus {
    fn from([x, y, z]: [f64; 3]) -> Self {
        Self { x, y, z }
    }
}
