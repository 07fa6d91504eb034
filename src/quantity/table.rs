//! The two-way table of quantity (row) and system (column) as types.
//!
//! | row | radiant (e) | luminous (v) | photon (p) |
//! |---|---|---|---|
//! | energy `Q` | J | lm s | 1 |
//! | flux `Φ = dQ/dt` | W | lm | 1/s |
//! | flux density in `E = dΦ/dA` | W/m² | lx | 1/(m² s) |
//! | flux density out `M = dΦ/dA` | W/m² | lm/m² | 1/(m² s) |
//! | radiance `L = d²Φ/(dA cos θ dω)` | W/(m² sr) | cd/m² | 1/(m² s sr) |
//! | intensity `I = dΦ/dω` | W/sr | cd | 1/(s sr) |
//!
//! Scotopic and mesopic quantities have the units of the luminous column, the five α-opic ones those of the radiant column;
//! [`cell`](super::cell) has the words of all of them.
//!
//! A cell is [`Quantity<K, S>`]. Values of one cell add, subtract, scale and divide; nothing else is defined here. The
//! products between cells are in [`relation`](super::relation). There is no conversion between systems: it needs a
//! spectrum.
//!
//! ```
//! use etendue::quantity::table::Illuminance;
//! let sum = Illuminance::new(300.0) + Illuminance::new(200.0);
//! assert_eq!(sum.to_string(), "500 lx");
//! ```
//!
//! Systems do not mix:
//!
//! ```compile_fail
//! use etendue::quantity::table::{Illuminance, Irradiance};
//! let sum = Illuminance::new(300.0) + Irradiance::new(200.0);
//! ```
//!
//! Rows do not mix either, not even with equal units:
//!
//! ```compile_fail
//! use etendue::quantity::table::{Irradiance, RadiantExitance};
//! let sum = Irradiance::new(300.0) + RadiantExitance::new(200.0);
//! ```
//!
//! nor are they compared:
//!
//! ```compile_fail
//! use etendue::quantity::table::{Luminance, Radiance};
//! let brighter = Luminance::new(3.0) < Radiance::new(2.0);
//! ```
//!
//! Names and units: CIE S 017 (ILV), ISO 80000-7.

use std::cmp::Ordering;
use std::fmt;
use std::iter::Sum;
use std::marker::PhantomData;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

pub use super::cell::*;

/// The rows of the table: markers without size.
pub mod kind {
    /// Energy `Q`.
    #[derive(Debug, Clone, Copy)]
    pub struct Energy;
    /// Flux `Φ`, energy per time.
    #[derive(Debug, Clone, Copy)]
    pub struct Flux;
    /// Flux density that arrives at a surface, `E`.
    #[derive(Debug, Clone, Copy)]
    pub struct FluxDensityIn;
    /// Flux density that leaves a surface, `M`.
    #[derive(Debug, Clone, Copy)]
    pub struct FluxDensityOut;
    /// Radiance `L`, flux per étendue.
    #[derive(Debug, Clone, Copy)]
    pub struct Radiance;
    /// Intensity `I`, flux per solid angle.
    #[derive(Debug, Clone, Copy)]
    pub struct Intensity;
}

/// The columns of the table: markers without size.
pub mod system {
    /// Energy in joules.
    #[derive(Debug, Clone, Copy)]
    pub struct Radiant;
    /// Weighted with V(λ) and K_m.
    #[derive(Debug, Clone, Copy)]
    pub struct Luminous;
    /// Number of photons.
    #[derive(Debug, Clone, Copy)]
    pub struct Photon;
    /// Weighted with V'(λ), the rods' luminous efficiency.
    #[derive(Debug, Clone, Copy)]
    pub struct Scotopic;
    /// Weighted with V_mes(λ) of one state of adaptation between photopic and scotopic vision.
    #[derive(Debug, Clone, Copy)]
    pub struct Mesopic;
    /// Weighted with the action spectrum of the S-cone-opic system.
    #[derive(Debug, Clone, Copy)]
    pub struct SConeOpic;
    /// Weighted with the action spectrum of the M-cone-opic system.
    #[derive(Debug, Clone, Copy)]
    pub struct MConeOpic;
    /// Weighted with the action spectrum of the L-cone-opic system.
    #[derive(Debug, Clone, Copy)]
    pub struct LConeOpic;
    /// Weighted with the action spectrum of the rhodopic system.
    #[derive(Debug, Clone, Copy)]
    pub struct Rhodopic;
    /// Weighted with the action spectrum of the melanopic system.
    #[derive(Debug, Clone, Copy)]
    pub struct Melanopic;
}

/// A number in the unit of one cell of the table: row `K`, column `S`.
#[repr(transparent)]
pub struct Quantity<K, S> {
    value: f64,
    cell: PhantomData<(K, S)>,
}

impl<K, S> Quantity<K, S> {
    /// Zero in the unit of the cell.
    pub const ZERO: Self = Self::new(0.0);

    /// The quantity whose number is `value` in the unit of its cell. Any `f64` is accepted.
    pub const fn new(value: f64) -> Self {
        Self { value, cell: PhantomData }
    }

    /// The number in the unit of the cell.
    pub const fn value(self) -> f64 {
        self.value
    }

    /// The magnitude, in the same cell.
    pub const fn abs(self) -> Self {
        Self::new(self.value.abs())
    }
}

impl<K, S> Clone for Quantity<K, S> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<K, S> Copy for Quantity<K, S> {}

impl<K, S> Default for Quantity<K, S> {
    fn default() -> Self {
        Self::ZERO
    }
}

impl<K, S> PartialEq for Quantity<K, S> {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl<K, S> PartialOrd for Quantity<K, S> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl<K, S> Add for Quantity<K, S> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.value + other.value)
    }
}

impl<K, S> AddAssign for Quantity<K, S> {
    fn add_assign(&mut self, other: Self) {
        self.value += other.value;
    }
}

impl<K, S> Sub for Quantity<K, S> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.value - other.value)
    }
}

impl<K, S> SubAssign for Quantity<K, S> {
    fn sub_assign(&mut self, other: Self) {
        self.value -= other.value;
    }
}

impl<K, S> Neg for Quantity<K, S> {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.value)
    }
}

impl<K, S> Mul<f64> for Quantity<K, S> {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self::new(self.value * factor)
    }
}

impl<K, S> Mul<Quantity<K, S>> for f64 {
    type Output = Quantity<K, S>;
    fn mul(self, quantity: Quantity<K, S>) -> Quantity<K, S> {
        quantity * self
    }
}

impl<K, S> Div<f64> for Quantity<K, S> {
    type Output = Self;
    fn div(self, divisor: f64) -> Self {
        Self::new(self.value / divisor)
    }
}

/// The ratio of two values of one cell is a pure number.
impl<K, S> Div for Quantity<K, S> {
    type Output = f64;
    fn div(self, other: Self) -> f64 {
        self.value / other.value
    }
}

impl<K, S> Sum for Quantity<K, S> {
    fn sum<I: Iterator<Item = Self>>(items: I) -> Self {
        items.fold(Self::ZERO, Add::add)
    }
}

/// The number and its unit; a precision such as `{:.2}` applies to the number. The unit one is not written.
impl<K, S> fmt::Display for Quantity<K, S>
where
    Self: Cell,
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = match f.precision() {
            Some(decimals) => format!("{:.decimals$}", self.value),
            None => self.value.to_string(),
        };
        if Self::UNIT == "1" { f.write_str(&number) } else { write!(f, "{number} {}", Self::UNIT) }
    }
}

impl<K, S> fmt::Debug for Quantity<K, S>
where
    Self: Cell,
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} = {:?} {}", Self::SYMBOL, self.value, Self::UNIT)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_quantity_is_as_large_as_its_number() {
        assert_eq!(size_of::<Luminance>(), size_of::<f64>());
    }

    #[test]
    fn a_quantity_is_shown_with_its_unit() {
        assert_eq!(Illuminance::new(512.336).to_string(), "512.336 lx");
        assert_eq!(format!("{:.1}", Luminance::new(512.336)), "512.3 cd/m²");
        assert_eq!(PhotonNumber::new(12.0).to_string(), "12");
        assert_eq!(format!("{:?}", Irradiance::new(2.0)), "E_e = 2.0 W/m²");
    }

    proptest! {
        #[test]
        fn a_cell_is_a_vector_space(a in -1e9..1e9f64, b in -1e9..1e9f64, s in -1e3..1e3f64) {
            let (x, y) = (RadiantFlux::new(a), RadiantFlux::new(b));
            prop_assert_eq!(x + y, y + x);
            prop_assert_eq!(x - y, -(y - x));
            prop_assert_eq!(s * x, x * s);
            prop_assert_eq!(x + RadiantFlux::ZERO, x);
            prop_assert_eq!([x, y].into_iter().sum::<RadiantFlux>(), x + y);
            prop_assume!(a != 0.0);
            prop_assert_eq!(x / x, 1.0);
            prop_assert_eq!(x < y, a < b);
        }
    }
}
