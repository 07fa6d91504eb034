//! What a flux is spread over: distance, area, solid angle, projected solid angle, étendue and duration.
//!
//! ```text
//! Ω = 4π sin²(α/2)            cone of half angle α
//! G = A cos θ Ω               small étendue
//! G = π A sin²α               cone of half angle α about the normal of A
//! G = π A                     half space over A
//! ```
//!
//! The sine of half the angle replaces `1 − cos α`, which loses its digits for narrow cones.
//! Source: DIN 5031-1; Ross McCluney, *Introduction to Radiometry and Photometry*.

use std::f64::consts::PI;
use std::fmt;

macro_rules! extents {
    ($($(#[$doc:meta])* $name:ident, $unit:literal;)*) => {
        $(
            $(#[$doc])*
            #[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
            #[repr(transparent)]
            pub struct $name(f64);

            impl $name {
                #[doc = concat!("From a number in ", $unit, ". Any `f64` is accepted.")]
                pub const fn new(value: f64) -> Self {
                    Self(value)
                }

                #[doc = concat!("The number in ", $unit, ".")]
                pub const fn value(self) -> f64 {
                    self.0
                }
            }

            impl fmt::Display for $name {
                fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                    fmt::Display::fmt(&self.0, f)?;
                    f.write_str(concat!(" ", $unit))
                }
            }
        )*
    };
}

extents! {
    /// A distance, in metres.
    Distance, "m";
    /// An area, in square metres.
    Area, "m²";
    /// A solid angle, in steradians.
    SolidAngle, "sr";
    /// A projected solid angle, `∫ cos θ dω` about the normal of a surface, in steradians.
    ProjectedSolidAngle, "sr";
    /// An étendue: area times projected solid angle, in m² sr.
    Etendue, "m² sr";
    /// A duration, in seconds.
    Duration, "s";
}

impl Area {
    /// Area of a disc of radius `radius_m`.
    ///
    /// ```
    /// use etendue::quantity::Area;
    ///
    /// assert_eq!(Area::disc(2.0).value(), 4.0 * std::f64::consts::PI);
    /// ```
    pub fn disc(radius_m: f64) -> Self {
        Self(PI * radius_m * radius_m)
    }

    /// Area of a sphere's surface of radius `radius_m`.
    ///
    /// ```
    /// use etendue::quantity::Area;
    ///
    /// assert_eq!(Area::sphere(0.5).value(), std::f64::consts::PI);
    /// ```
    pub fn sphere(radius_m: f64) -> Self {
        Self(4.0 * PI * radius_m * radius_m)
    }
}

impl SolidAngle {
    /// All directions: 4π sr.
    pub const SPHERE: Self = Self(4.0 * PI);
    /// Half of all directions: 2π sr.
    pub const HEMISPHERE: Self = Self(2.0 * PI);

    /// A cone of half angle `half_angle_rad`, 0 to π: `4π sin²(α/2)`.
    ///
    /// ```
    /// use etendue::quantity::SolidAngle;
    ///
    /// // The sun, 0.533° across.
    /// assert!((SolidAngle::cone(0.2665_f64.to_radians()).value() / 6.797e-5 - 1.0).abs() < 1e-3);
    /// ```
    pub fn cone(half_angle_rad: f64) -> Self {
        let s = (0.5 * half_angle_rad).sin();
        Self(4.0 * PI * s * s)
    }
}

impl Etendue {
    /// A small area seen within a small solid angle, at an angle of cosine `cosine` to its normal: `A cos θ Ω`.
    ///
    /// ```
    /// use etendue::quantity::{Area, Etendue, SolidAngle};
    ///
    /// assert_eq!(Etendue::small(Area::new(2.0), 0.5, SolidAngle::new(0.25)).to_string(), "0.25 m² sr");
    /// ```
    pub fn small(area: Area, cosine: f64, solid_angle: SolidAngle) -> Self {
        Self(area.0 * cosine * solid_angle.0)
    }

    /// A cone of half angle `half_angle_rad`, 0 to π/2, about the normal of a flat area: `π A sin²α`.
    ///
    /// ```
    /// use etendue::quantity::{Area, Etendue};
    ///
    /// let wide_open = Etendue::cone(Area::new(1.0), std::f64::consts::FRAC_PI_2);
    /// assert_eq!(wide_open, Etendue::hemisphere(Area::new(1.0)));
    /// ```
    pub fn cone(area: Area, half_angle_rad: f64) -> Self {
        let s = half_angle_rad.sin();
        Self(PI * area.0 * s * s)
    }

    /// The half space over a flat area: `π A`.
    ///
    /// ```
    /// use etendue::quantity::{Area, Etendue};
    ///
    /// assert_eq!(Etendue::hemisphere(Area::new(1.0)).value(), std::f64::consts::PI);
    /// ```
    pub fn hemisphere(area: Area) -> Self {
        Self(PI * area.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn the_widest_cone_is_all_directions() {
        assert_eq!(SolidAngle::cone(PI), SolidAngle::SPHERE);
        let half = SolidAngle::cone(0.5 * PI).value() / SolidAngle::HEMISPHERE.value();
        assert!((half - 1.0).abs() < 1e-15);
    }

    #[test]
    fn an_extent_is_shown_with_its_unit() {
        assert_eq!(Etendue::new(2.5).to_string(), "2.5 m² sr");
    }

    proptest! {
        #[test]
        fn a_narrow_cone_is_a_small_etendue(angle in 1e-9..1e-5f64, area in 1e-9..1e9f64) {
            let area = Area::new(area);
            let exact = Etendue::cone(area, angle).value();
            let small = Etendue::small(area, 1.0, SolidAngle::cone(angle)).value();
            prop_assert!((small / exact - 1.0).abs() < angle * angle + 1e-15);
        }

        #[test]
        fn a_cone_and_its_complement_fill_the_sphere(angle in 0.0..PI) {
            let both = SolidAngle::cone(angle).value() + SolidAngle::cone(PI - angle).value();
            prop_assert!((both / (4.0 * PI) - 1.0).abs() < 1e-15);
        }
    }
}
