//! Tristimulus values to sRGB (IEC 61966-2-1), and the R, G, B of a lecture.
//!
//! ```text
//! (R, G, B) = M⁻¹ (X, Y, Z)          linear; M from the primaries and the white D65 (0.3127, 0.3290), not rounded
//! C′ = 12.92 C                       C ≤ 0.0031308
//! C′ = 1.055 C^(1/2.4) − 0.055       else; 8 bit: round(255 C′)
//! ```
//!
//! | primary | x | y |
//! |---|---|---|
//! | red | 0.64 | 0.33 |
//! | green | 0.30 | 0.60 |
//! | blue | 0.15 | 0.06 |
//!
//! The standard prints M⁻¹ with four decimals; the matrix here is what those are rounded from (they agree to 4e-4 in R, G, B).
//! A light outside the gamut has a component below 0 or above 1; [`Gamut`] says what is done, and [`Srgb::outside_gamut`] that it was.
//!
//! The lecture's `R = ∫ C r̄ dλ`, `G = ∫ C ḡ dλ`, `B = ∫ C b̄ dλ` are [`Tristimulus::of`] with r̄, ḡ, b̄ in place of x̄, ȳ, z̄.
//! [`xyz_of_wright_guild`] takes them to X, Y, Z by the transformation of CIE 1931.

use super::Tristimulus;

/// What is done with a component outside 0 … 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Gamut {
    /// Each component is cut to 0 … 1 on its own. The hue may change.
    Clip,
    /// The grey of the same luminance (at most white) is mixed in until all components fit. Luminance and, in linear light, hue stay.
    Desaturate,
}

/// An sRGB colour.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Srgb {
    /// Linear components 0 … 1, after the handling of the gamut.
    pub linear: [f64; 3],
    /// Encoded components 0 … 1.
    pub encoded: [f64; 3],
    /// Encoded components as bytes.
    pub bytes: [u8; 3],
    /// Whether a component lay outside 0 … 1 by more than rounding (1e-9), so that the gamut handling acted.
    pub outside_gamut: bool,
}

/// Chromaticities of the red, green and blue primary and of the white.
const PRIMARIES_XY: [[f64; 2]; 3] = [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]];
const WHITE_XY: [f64; 2] = [0.3127, 0.3290];
/// What of a component outside 0 … 1 is rounding.
const ROUNDING: f64 = 1e-9;

/// Transformation of CIE 1931 from the R, G, B of Wright and Guild (unit luminances 1 : 4.5907 : 0.0601) to X, Y, Z.
const WRIGHT_GUILD_TO_XYZ: [[f64; 3]; 3] = [[0.490_00, 0.310_00, 0.200_00], [0.176_97, 0.812_40, 0.010_63], [0.000_00, 0.010_00, 0.990_00]];

/// X, Y, Z of R, G, B that were found with r̄, ḡ, b̄ of Wright and Guild: `(X, Y, Z) = A (R, G, B)/0.17697` (CIE 1931; Fairman, Brill
/// and Hemmendinger 1997). The tables of x̄, ȳ, z̄ were smoothed after the transformation, so they agree to about 1e-3 only.
pub fn xyz_of_wright_guild(rgb: &Tristimulus) -> Tristimulus {
    Tristimulus::from(times(&WRIGHT_GUILD_TO_XYZ, rgb.to_array()).map(|value| value / WRIGHT_GUILD_TO_XYZ[1][0]))
}

/// Linear sRGB of X, Y, Z, where white has Y = 1. Not limited to 0 … 1.
pub fn linear_srgb_of(xyz: &Tristimulus) -> [f64; 3] {
    solve(&srgb_matrix(), xyz.to_array())
}

/// X, Y, Z, where white has Y = 1, of linear sRGB.
pub fn tristimulus_of_linear_srgb(rgb: [f64; 3]) -> Tristimulus {
    Tristimulus::from(times(&srgb_matrix(), rgb))
}

impl Srgb {
    /// The colour of X, Y, Z, where white has Y = 1. `None` if a value is not finite.
    pub fn of(xyz: &Tristimulus, gamut: Gamut) -> Option<Self> {
        let linear = linear_srgb_of(xyz);
        Self::of_linear(linear, xyz.y, gamut)
    }

    /// The colour of the light as bright as sRGB can show it: after the gamut handling the largest component is 1. `None` for a dark one.
    pub fn brightest(xyz: &Tristimulus, gamut: Gamut) -> Option<Self> {
        let size = xyz.to_array().into_iter().fold(0.0, |size: f64, value| size.max(value.abs()));
        let xyz = Tristimulus::from(xyz.to_array().map(|value| value / size));
        let mut linear = linear_srgb_of(&xyz);
        let largest = linear.into_iter().fold(0.0, f64::max);
        let least = linear.into_iter().fold(f64::INFINITY, f64::min);
        if !(largest > 0.0 && largest.is_finite() && xyz.y > 0.0) {
            return None;
        }
        let outside = least < -ROUNDING * largest;
        if gamut == Gamut::Desaturate && least < 0.0 {
            // Mixed with the grey of the same luminance until the least component is zero.
            let share = -least / (xyz.y - least);
            linear = linear.map(|component| component + share * (xyz.y - component));
        }
        let linear = linear.map(|component| component.max(0.0));
        let largest = linear.into_iter().fold(0.0, f64::max);
        let shown = Self::of_linear(linear.map(|component| component / largest), 0.5, Gamut::Clip)?;
        Some(Self { outside_gamut: outside, ..shown })
    }

    fn of_linear(linear: [f64; 3], luminance: f64, gamut: Gamut) -> Option<Self> {
        if !linear.into_iter().all(f64::is_finite) || !luminance.is_finite() {
            return None;
        }
        let outside_gamut = linear.into_iter().any(|component| !(-ROUNDING..=1.0 + ROUNDING).contains(&component));
        let grey = luminance.clamp(0.0, 1.0);
        let share = match gamut {
            Gamut::Clip => 0.0,
            // The smallest share of grey with which every component lies in 0 … 1.
            Gamut::Desaturate => linear.into_iter().fold(0.0, |share: f64, component| {
                let needed = if component < 0.0 {
                    component / (component - grey)
                } else if component > 1.0 {
                    (component - 1.0) / (component - grey)
                } else {
                    0.0
                };
                share.max(needed)
            }),
        };
        let linear = linear.map(|component| (component + share * (grey - component)).clamp(0.0, 1.0));
        let encoded = linear.map(encode);
        Some(Self { linear, encoded, bytes: encoded.map(|component| (255.0 * component).round() as u8), outside_gamut })
    }

    /// `#rrggbb`.
    pub fn hex(&self) -> String {
        let [r, g, b] = self.bytes;
        format!("#{r:02x}{g:02x}{b:02x}")
    }
}

/// The transfer function of sRGB for a linear component 0 … 1.
fn encode(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// Columns are X, Y, Z of the primaries, scaled so that their sum is the white.
fn srgb_matrix() -> [[f64; 3]; 3] {
    let column = |[x, y]: [f64; 2]| [x / y, 1.0, (1.0 - x - y) / y];
    let columns = PRIMARIES_XY.map(column);
    let rows: [[f64; 3]; 3] = std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i]));
    let scales = solve(&rows, column(WHITE_XY));
    std::array::from_fn(|i| std::array::from_fn(|j| rows[i][j] * scales[j]))
}

fn times(m: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    m.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// Cramer's rule.
fn solve(m: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    let determinant = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| {
        a[0] * (b[1] * c[2] - b[2] * c[1]) - b[0] * (a[1] * c[2] - a[2] * c[1]) + c[0] * (a[1] * b[2] - a[2] * b[1])
    };
    let [a, b, c]: [[f64; 3]; 3] = std::array::from_fn(|j| std::array::from_fn(|i| m[i][j]));
    let whole = determinant(a, b, c);
    [determinant(v, b, c) / whole, determinant(a, v, c) / whole, determinant(a, b, v) / whole]
}
