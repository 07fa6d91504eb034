//! What a lamp emits, in the relations of the lecture.
//!
//! ```text
//! P = V C                   electrical power: voltage times current (the lecture writes C for the current)
//! Φ = ε P = ε V C           radiant flux: the efficiency ε of the lamp times its power
//! I = Φ / 4π                isotropic emitter
//! I(θ) = I₀ cosⁿ θ          emitter that is brightest along its axis, θ ≤ 90°
//! Φ = 2π I₀ / (n + 1)       its flux; n = 1 is the Lambertian element with Φ = π I₀
//! Φ = π L A                 Lambertian surface, to one side
//! ```
//!
//! | parameter | meaning | unit, range |
//! |---|---|---|
//! | `efficiency` ε | radiant flux per electrical power | 1, 0 to 1 |
//! | `voltage_v`, `current_a` | V, C | V, A |
//! | `exponent` n | how narrow the emitter is | 1, above −1 |
//!
//! The homogeneous emitter (I = Φ/Ω, M = Φ/A) and B = M = πL are in [`relation`](super::relation).
//! Source: CIE S 017 (ILV); the flux of a power of the cosine by integration over the hemisphere.

use super::extent::{Area, SolidAngle};
use super::table::{Quantity, RadiantFlux, kind};
use std::f64::consts::PI;

/// Electrical power, in W, of a voltage in V and a current in A: `P = V C`.
///
/// ```
/// assert_eq!(etendue::quantity::emission::electrical_power_w(12.0, 0.5), 6.0);
/// ```
pub fn electrical_power_w(voltage_v: f64, current_a: f64) -> f64 {
    voltage_v * current_a
}

impl RadiantFlux {
    /// The radiant flux of a lamp of the electrical power `power_w`, in W, and the efficiency `efficiency`, 0 to 1: `Φ = ε P`.
    ///
    /// ```
    /// use etendue::quantity::table::RadiantFlux;
    /// assert_eq!(RadiantFlux::from_electrical_power(0.25, 60.0), RadiantFlux::new(15.0));
    /// ```
    pub fn from_electrical_power(efficiency: f64, power_w: f64) -> Self {
        Self::new(efficiency * power_w)
    }

    /// The radiant flux of a lamp that is run at `voltage_v`, in V, and `current_a`, in A: `Φ = ε V C`.
    ///
    /// ```
    /// use etendue::quantity::table::RadiantFlux;
    /// assert_eq!(RadiantFlux::from_voltage_and_current(0.5, 12.0, 2.0).to_string(), "12 W");
    /// ```
    pub fn from_voltage_and_current(efficiency: f64, voltage_v: f64, current_a: f64) -> Self {
        Self::from_electrical_power(efficiency, electrical_power_w(voltage_v, current_a))
    }
}

impl<S> Quantity<kind::Flux, S> {
    /// Intensity of an isotropic emitter of this flux: `I = Φ / 4π`.
    ///
    /// ```
    /// use etendue::quantity::table::LuminousFlux;
    /// let lamp = LuminousFlux::new(4.0 * std::f64::consts::PI).isotropic_intensity();
    /// assert_eq!(lamp.to_string(), "1 cd");
    /// ```
    pub fn isotropic_intensity(self) -> Quantity<kind::Intensity, S> {
        self / SolidAngle::SPHERE
    }
}

impl<S> Quantity<kind::Intensity, S> {
    /// Flux of an isotropic emitter of this intensity: `Φ = 4π I`.
    ///
    /// ```
    /// use etendue::quantity::table::LuminousIntensity;
    /// assert_eq!(format!("{:.4}", LuminousIntensity::new(1.0).isotropic_flux()), "12.5664 lm");
    /// ```
    pub fn isotropic_flux(self) -> Quantity<kind::Flux, S> {
        self * SolidAngle::SPHERE
    }

    /// Intensity at `angle_rad`, 0 to π, from the axis of an emitter of this intensity on the axis: `I = I₀ cosⁿ θ`; zero beyond 90°.
    ///
    /// ```
    /// use etendue::quantity::table::LuminousIntensity;
    /// let at_60_degrees = LuminousIntensity::new(100.0).at_angle(std::f64::consts::FRAC_PI_3, 2.0);
    /// assert_eq!(format!("{at_60_degrees:.9}"), "25.000000000 cd");
    /// ```
    pub fn at_angle(self, angle_rad: f64, exponent: f64) -> Self {
        let cosine = angle_rad.cos();
        // Written as a comparison and not as a maximum, because a maximum would turn NaN into zero.
        let share = if cosine < 0.0 { 0.0 } else { cosine.powf(exponent) };
        self * share
    }

    /// Flux into the half space before an emitter of this intensity on its axis that falls as the power `exponent`, above −1, of the
    /// cosine: `Φ = 2π I₀ / (n + 1)`.
    ///
    /// ```
    /// use etendue::quantity::table::LuminousIntensity;
    /// let lambertian = LuminousIntensity::new(100.0).cosine_power_flux(1.0);
    /// assert_eq!(format!("{lambertian:.4}"), "314.1593 lm");
    /// ```
    pub fn cosine_power_flux(self, exponent: f64) -> Quantity<kind::Flux, S> {
        Quantity::new(2.0 * PI * self.value() / (exponent + 1.0))
    }
}

impl<S> Quantity<kind::Radiance, S> {
    /// Flux of a Lambertian surface of this radiance and one side of `area`: `Φ = π L A`.
    ///
    /// ```
    /// use etendue::quantity::{Area, table::Luminance};
    /// let panel = Luminance::new(1000.0).lambertian_flux(Area::new(0.36));
    /// assert_eq!(format!("{panel:.3}"), "1130.973 lm");
    /// ```
    pub fn lambertian_flux(self, area: Area) -> Quantity<kind::Flux, S> {
        self.lambertian_exitance() * area
    }
}

#[cfg(test)]
mod tests {
    use super::super::extent::Etendue;
    use super::super::table::{LuminousFlux, LuminousIntensity, Radiance};
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn fluxes_of_powers_of_the_cosine_agree_with_the_references() {
        // g1a.emitter-flux-2, -4.
        for (i0, exponent, flux) in [(100.0, 1.0, 314.159_265_358_979_3), (1.0, 80.0, 0.077_570_188_977_525_75)] {
            let found = LuminousIntensity::new(i0).cosine_power_flux(exponent).value();
            assert!((found / flux - 1.0).abs() < 1e-15, "{found}");
        }
    }

    #[test]
    fn nothing_is_emitted_backwards_and_nan_stays_nan() {
        let lamp = LuminousIntensity::new(1.0);
        assert_eq!(lamp.at_angle(2.0, 3.0), LuminousIntensity::ZERO);
        assert!(lamp.at_angle(f64::NAN, 3.0).value().is_nan());
    }

    proptest! {
        #[test]
        fn the_flux_of_a_power_of_the_cosine_is_the_integral_of_its_intensity(i0 in 1e-3..1e3f64, exponent in 1u32..12) {
            // Midpoints in μ = cos θ: dΩ = 2π dμ. The error of n midpoints is below p²/(24 n²) relative.
            let (n, power) = (20_000u32, f64::from(exponent));
            let sum: f64 = (0..n)
                .map(|k| LuminousIntensity::new(i0).at_angle(((f64::from(k) + 0.5) / f64::from(n)).acos(), power).value())
                .sum();
            let integral = 2.0 * PI * sum / f64::from(n);
            prop_assert!((integral / LuminousIntensity::new(i0).cosine_power_flux(power).value() - 1.0).abs() < 1e-7);
        }

        #[test]
        fn an_isotropic_lamp_has_its_flux_back(phi in 1e-300..1e300f64) {
            let flux = LuminousFlux::new(phi);
            prop_assert!((flux.isotropic_intensity().isotropic_flux() / flux - 1.0).abs() < 1e-15);
            // An exponent of zero on both sides of the lamp is the same lamp.
            let both = 2.0 * flux.isotropic_intensity().cosine_power_flux(0.0);
            prop_assert!((both / flux - 1.0).abs() < 1e-15);
        }

        #[test]
        fn a_lambertian_surface_has_the_flux_of_its_etendue(l in 1e-150..1e150f64, a in 1e-150..1e150f64) {
            let (radiance, area) = (Radiance::new(l), Area::new(a));
            prop_assert!((radiance.lambertian_flux(area) / (radiance * Etendue::hemisphere(area)) - 1.0).abs() < 1e-15);
        }

        #[test]
        fn power_is_split_into_light_and_heat(volts in 1e-6..1e6f64, amperes in 1e-6..1e6f64, efficiency in 0.0..1.0f64) {
            let light = RadiantFlux::from_voltage_and_current(efficiency, volts, amperes);
            let heat = RadiantFlux::from_voltage_and_current(1.0 - efficiency, volts, amperes);
            prop_assert!(((light + heat).value() / electrical_power_w(volts, amperes) - 1.0).abs() < 1e-14);
        }
    }
}
