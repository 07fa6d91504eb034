//! The physical products between the cells of the table and the extents, the same in every system.
//!
//! ```text
//! Φ = L G             flux through an étendue
//! E = Φ / A           flux density that arrives         M = Φ / A   flux density that leaves
//! I = Φ / Ω           mean intensity in a solid angle
//! E = I cos θ / r²    inverse square and cosine law of a small source
//! M = π L             Lambertian surface                E = π L     half space of uniform radiance
//! Q = Φ t             energy
//! ```
//!
//! What is not listed here is not physics and does not compile:
//!
//! ```compile_fail
//! use etendue::quantity::{Area, table::Luminance};
//! let nothing = Luminance::new(3.0) * Area::new(2.0);
//! ```
//!
//! Source: ISO 80000-7; CIE S 017 (ILV).

use super::extent::{Area, Distance, Duration, Etendue, SolidAngle};
use super::table::{Quantity, kind};
use std::f64::consts::PI;
use std::ops::{Div, Mul};

/// `Φ = L G`.
impl<S> Mul<Etendue> for Quantity<kind::Radiance, S> {
    type Output = Quantity<kind::Flux, S>;
    fn mul(self, etendue: Etendue) -> Self::Output {
        Quantity::new(self.value() * etendue.value())
    }
}

/// `Φ = E A`: the flux that arrives on a uniformly lit area.
impl<S> Mul<Area> for Quantity<kind::FluxDensityIn, S> {
    type Output = Quantity<kind::Flux, S>;
    fn mul(self, area: Area) -> Self::Output {
        Quantity::new(self.value() * area.value())
    }
}

/// `Φ = M A`: the flux that leaves a uniformly bright area.
impl<S> Mul<Area> for Quantity<kind::FluxDensityOut, S> {
    type Output = Quantity<kind::Flux, S>;
    fn mul(self, area: Area) -> Self::Output {
        Quantity::new(self.value() * area.value())
    }
}

/// `Φ = I Ω`: the flux of a uniform intensity within a solid angle.
impl<S> Mul<SolidAngle> for Quantity<kind::Intensity, S> {
    type Output = Quantity<kind::Flux, S>;
    fn mul(self, solid_angle: SolidAngle) -> Self::Output {
        Quantity::new(self.value() * solid_angle.value())
    }
}

/// `I = Φ / Ω`: the mean intensity within a solid angle.
impl<S> Div<SolidAngle> for Quantity<kind::Flux, S> {
    type Output = Quantity<kind::Intensity, S>;
    fn div(self, solid_angle: SolidAngle) -> Self::Output {
        Quantity::new(self.value() / solid_angle.value())
    }
}

/// `L = Φ / G`: the mean radiance within an étendue.
impl<S> Div<Etendue> for Quantity<kind::Flux, S> {
    type Output = Quantity<kind::Radiance, S>;
    fn div(self, etendue: Etendue) -> Self::Output {
        Quantity::new(self.value() / etendue.value())
    }
}

/// `Q = Φ t`.
impl<S> Mul<Duration> for Quantity<kind::Flux, S> {
    type Output = Quantity<kind::Energy, S>;
    fn mul(self, duration: Duration) -> Self::Output {
        Quantity::new(self.value() * duration.value())
    }
}

/// `Φ = Q / t`: the mean flux over a duration.
impl<S> Div<Duration> for Quantity<kind::Energy, S> {
    type Output = Quantity<kind::Flux, S>;
    fn div(self, duration: Duration) -> Self::Output {
        Quantity::new(self.value() / duration.value())
    }
}

impl<S> Quantity<kind::Flux, S> {
    /// Mean flux density of this flux arriving on `area`: `E = Φ / A`.
    ///
    /// ```
    /// use etendue::quantity::{Area, table::LuminousFlux};
    ///
    /// assert_eq!(LuminousFlux::new(6000.0).arriving_on(Area::new(12.0)).to_string(), "500 lx");
    /// ```
    pub fn arriving_on(self, area: Area) -> Quantity<kind::FluxDensityIn, S> {
        Quantity::new(self.value() / area.value())
    }

    /// Mean flux density of this flux leaving `area`: `M = Φ / A`.
    ///
    /// ```
    /// use etendue::quantity::{Area, table::RadiantFlux};
    ///
    /// assert_eq!(RadiantFlux::new(5.0).leaving(Area::new(0.25)).to_string(), "20 W/m²");
    /// ```
    pub fn leaving(self, area: Area) -> Quantity<kind::FluxDensityOut, S> {
        Quantity::new(self.value() / area.value())
    }
}

impl<S> Quantity<kind::Intensity, S> {
    /// Flux density on a surface at `distance` from a small source, whose normal makes an angle of cosine `cosine` with
    /// the direction to the source: `E = I cos θ / r²`. A source behind the surface (negative cosine) gives zero.
    ///
    /// ```
    /// use etendue::quantity::{Distance, table::LuminousIntensity};
    ///
    /// assert_eq!(LuminousIntensity::new(100.0).arriving_at(Distance::new(2.0), 0.5).to_string(), "12.5 lx");
    /// ```
    pub fn arriving_at(self, distance: Distance, cosine: f64) -> Quantity<kind::FluxDensityIn, S> {
        // Written as a comparison and not as a maximum, because a maximum would turn NaN into zero.
        let facing = if cosine < 0.0 { 0.0 } else { cosine };
        // Divided twice, because the square leaves the range of f64 before the result does.
        Quantity::new(self.value() / distance.value() / distance.value() * facing)
    }
}

impl<S> Quantity<kind::Radiance, S> {
    /// Exitance of a Lambertian surface of this radiance: `M = π L`.
    ///
    /// ```
    /// use etendue::quantity::table::Luminance;
    ///
    /// assert_eq!(Luminance::new(1.0).lambertian_exitance().value(), std::f64::consts::PI);
    /// ```
    pub fn lambertian_exitance(self) -> Quantity<kind::FluxDensityOut, S> {
        Quantity::new(PI * self.value())
    }

    /// Flux density on a flat surface under a half space of this uniform radiance: `E = π L`.
    ///
    /// ```
    /// use etendue::quantity::table::Luminance;
    ///
    /// let overcast = Luminance::new(3000.0).under_uniform_hemisphere();
    /// assert_eq!(format!("{overcast:.0}"), "9425 lx");
    /// ```
    pub fn under_uniform_hemisphere(self) -> Quantity<kind::FluxDensityIn, S> {
        Quantity::new(PI * self.value())
    }
}

impl<S> Quantity<kind::FluxDensityOut, S> {
    /// Radiance of a Lambertian surface of this exitance: `L = M / π`.
    ///
    /// ```
    /// use etendue::quantity::table::LuminousExitance;
    ///
    /// assert_eq!(format!("{:.2}", LuminousExitance::new(1000.0).lambertian_radiance()), "318.31 cd/m²");
    /// ```
    pub fn lambertian_radiance(self) -> Quantity<kind::Radiance, S> {
        Quantity::new(self.value() / PI)
    }
}

#[cfg(test)]
mod tests {
    use super::super::table::{Illuminance, Luminance, LuminousFlux, LuminousIntensity, Radiance, RadiantFlux};
    use super::*;
    use proptest::prelude::*;

    fn close(a: f64, b: f64) -> bool {
        (a - b).abs() <= 1e-14 * a.abs().max(b.abs())
    }

    #[test]
    fn a_hundred_candela_at_two_metres_give_twenty_five_lux() {
        let e = LuminousIntensity::new(100.0).arriving_at(Distance::new(2.0), 1.0);
        assert_eq!(e, Illuminance::new(25.0));
    }

    #[test]
    fn a_source_behind_the_surface_gives_nothing_and_nan_stays_nan() {
        let lamp = LuminousIntensity::new(100.0);
        assert_eq!(lamp.arriving_at(Distance::new(2.0), -0.5), Illuminance::ZERO);
        assert!(lamp.arriving_at(Distance::new(2.0), f64::NAN).value().is_nan());
    }

    #[test]
    fn a_uniform_dome_of_any_radiance_gives_pi_l_a() {
        // Reference cases g4e.radiance-2 and g4e.radiance-4.
        for (l, flux) in [(1e-300, 3.141_592_653_589_793e-304), (1e300, 3.141_592_653_589_793e296)] {
            let found: RadiantFlux = Radiance::new(l) * Etendue::hemisphere(Area::new(1e-4));
            assert!((found.value() / flux - 1.0).abs() < 1e-12);
        }
    }

    proptest! {
        #[test]
        fn illuminance_falls_with_the_square_of_distance(i in 1e-9..1e9f64, r in 1e-9..1e9f64, k in 1e-3..1e3f64) {
            let lamp = LuminousIntensity::new(i);
            let near = lamp.arriving_at(Distance::new(r), 1.0);
            let far = lamp.arriving_at(Distance::new(k * r), 1.0);
            prop_assert!(close(near / far, k * k));
        }

        #[test]
        fn an_isotropic_source_keeps_its_flux_on_every_sphere(phi in 1e-9..1e9f64, r in 1e-9..1e9f64) {
            let flux = LuminousFlux::new(phi);
            let on_sphere = (flux / SolidAngle::SPHERE).arriving_at(Distance::new(r), 1.0) * Area::sphere(r);
            prop_assert!(close(on_sphere / flux, 1.0));
        }

        #[test]
        fn a_lambertian_surface_emits_its_exitance_into_the_half_space(l in 1e-9..1e9f64, a in 1e-9..1e9f64) {
            let (luminance, area) = (Luminance::new(l), Area::new(a));
            let by_etendue = luminance * Etendue::hemisphere(area);
            let by_exitance = luminance.lambertian_exitance() * area;
            prop_assert!(close(by_etendue / by_exitance, 1.0));
            prop_assert!(close(luminance.lambertian_exitance().lambertian_radiance() / luminance, 1.0));
            let arriving = luminance.under_uniform_hemisphere() * area;
            prop_assert!(close(arriving / by_etendue, 1.0));
        }

        #[test]
        fn every_quotient_undoes_its_product(v in -1e9..1e9f64, x in 1e-9..1e9f64) {
            let flux = RadiantFlux::new(v);
            prop_assert!(close((flux.arriving_on(Area::new(x)) * Area::new(x)).value(), v));
            prop_assert!(close((flux.leaving(Area::new(x)) * Area::new(x)).value(), v));
            prop_assert!(close((flux / SolidAngle::new(x) * SolidAngle::new(x)).value(), v));
            prop_assert!(close((flux / Etendue::new(x) * Etendue::new(x)).value(), v));
            prop_assert!(close((flux * Duration::new(x) / Duration::new(x)).value(), v));
        }
    }
}
