//! Small heads at a point that weigh light from all round, instead of a plane that meets it under a cosine.
//!
//! ```text
//! E_head = ∫ w(ω) L(ω) dω  over the whole sphere of directions
//! w = a + b ω·n + c sin ε(ω)
//! ```
//!
//! | head | w(ω) | point source | ∫ w dω | symbol |
//! |---|---|---|---|---|
//! | spherical | 1 | I/r² | 4π | E_o |
//! | hemispherical | (1 + cos γ)/4 | I (1 + cos γ)/(4 r²) | π | E_hs |
//! | cylindrical | sin ε/π | I sin ε/(π r²) | π | E_z |
//! | semicylindrical | sin ε (1 + cos α)/π | I sin ε (1 + cos α)/(π r²) | π | E_sz |
//!
//! γ is counted from the normal n (the pole of the hemisphere, the front of the semicylinder), ε from the axis, α about the axis from the front,
//! so that sin ε cos α = ω·n. The axis of a cylinder is n, that of a semicylinder the sensor's y axis (`up`). The spherical illuminance is
//! that of the ILV, ∫ L dω; the mean over the surface of a small sphere (scalar illuminance, EN 12665) is a quarter of it.
//!
//! ```
//! use etendue::math::DVec3;
//! use etendue::sensor::Head;
//!
//! // Light from the side, along x: all of it for a sphere, half of what comes from the front for a semicylinder.
//! assert_eq!(Head::Spherical.weight(DVec3::X), 1.0);
//! assert_eq!(Head::Semicylindrical.weight(DVec3::X), 0.5 * Head::Semicylindrical.weight(DVec3::Z));
//! ```
//!
//! Source: CIE S 017 (ILV); EN 12665.

use std::f64::consts::{FRAC_1_PI, PI};

use crate::math::DVec3;

/// A small head at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Head {
    /// Every direction alike.
    Spherical,
    /// The curved side of a hemisphere whose pole is the normal.
    Hemispherical,
    /// The curved side of a cylinder whose axis is the normal.
    Cylindrical,
    /// The curved side of half a cylinder about the y axis, its front along the normal.
    Semicylindrical,
}

/// `w = uniform + along ω·n + across sin ε`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeadWeights {
    /// a.
    pub uniform: f64,
    /// b.
    pub along: f64,
    /// c.
    pub across: f64,
}

impl Head {
    /// The adjective: "cylindrical".
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Head::Spherical => "spherical",
            Head::Hemispherical => "hemispherical",
            Head::Cylindrical => "cylindrical",
            Head::Semicylindrical => "semicylindrical",
        }
    }

    /// The index of the symbol: `z` in E_v,z.
    #[must_use]
    pub fn index(self) -> &'static str {
        match self {
            Head::Spherical => "o",
            Head::Hemispherical => "hs",
            Head::Cylindrical => "z",
            Head::Semicylindrical => "sz",
        }
    }

    /// The three coefficients of w.
    #[must_use]
    pub fn weights(self) -> HeadWeights {
        let [uniform, along, across] = match self {
            Head::Spherical => [1.0, 0.0, 0.0],
            Head::Hemispherical => [0.25, 0.25, 0.0],
            Head::Cylindrical => [0.0, 0.0, FRAC_1_PI],
            Head::Semicylindrical => [0.0, FRAC_1_PI, FRAC_1_PI],
        };
        HeadWeights { uniform, along, across }
    }

    /// Whether ε is counted from the sensor's y axis and not from its normal.
    #[must_use]
    pub fn axis_is_up(self) -> bool {
        self == Head::Semicylindrical
    }

    /// w(ω) for light that comes from `to_local`, of any length but zero, in the sensor's frame x, y, normal.
    #[must_use]
    pub fn weight(self, to_local: DVec3) -> f64 {
        let length = to_local.length();
        if length > 0.0 { self.weight_times_length(to_local) / length } else { 0.0 }
    }

    /// w(ω) times the length of `to_local`; without cancellation where w goes to zero behind the head.
    #[inline(always)]
    #[must_use]
    pub fn weight_times_length(self, to_local: DVec3) -> f64 {
        let DVec3 { x, y, z } = to_local;
        // r + z, where r² = z² + beside²
        let beyond = |r: f64, beside: f64| {
            if z >= 0.0 { r + z } else { beside * (beside / (r - z)) }
        };
        match self {
            Head::Spherical => to_local.length(),
            Head::Hemispherical => 0.25 * beyond(to_local.length(), x.hypot(y)),
            Head::Cylindrical => FRAC_1_PI * x.hypot(y),
            Head::Semicylindrical => {
                let r = x.hypot(z);
                if r > 0.0 { FRAC_1_PI * beyond(r, x) } else { 0.0 }
            }
        }
    }

    /// `∫ w dω` over all directions, sr: what a uniform radiance of one gives.
    #[must_use]
    pub fn total_sr(self) -> f64 {
        if self == Head::Spherical { 4.0 * PI } else { PI }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const ALL: [Head; 4] = [Head::Spherical, Head::Hemispherical, Head::Cylindrical, Head::Semicylindrical];

    /// A regular grid in cos θ and φ, whose midpoint rule is exact to its square.
    #[test]
    fn the_weight_integrates_to_its_total() {
        let n = 400;
        for head in ALL {
            let mut sum = 0.0;
            for i in 0..n {
                for j in 0..n {
                    let z = -1.0 + (2 * i + 1) as f64 / f64::from(n);
                    let (sin, cos) = (PI * f64::from(2 * j + 1) / f64::from(n)).sin_cos();
                    let s = (1.0 - z * z).sqrt();
                    sum += head.weight(DVec3::new(s * cos, s * sin, z));
                }
            }
            let found = sum * 4.0 * PI / f64::from(n * n);
            assert!((found / head.total_sr() - 1.0).abs() < 1e-4, "{head:?} {found}");
        }
    }

    proptest! {
        #[test]
        fn the_weight_is_the_combination_of_its_three_parts(x in -1.0..1.0f64, y in -1.0..1.0f64, z in -1.0..1.0f64) {
            let to = DVec3::new(x, y, z);
            prop_assume!(to.length() > 1e-3);
            let unit = to.normalize();
            for head in ALL {
                let HeadWeights { uniform, along, across } = head.weights();
                let axis = if head.axis_is_up() { DVec3::Y } else { DVec3::Z };
                let expected = uniform + along * unit.z + across * unit.cross(axis).length();
                prop_assert!((head.weight(to) - expected).abs() < 1e-15, "{head:?}");
                prop_assert!(head.weight(to) >= 0.0);
            }
        }
    }
}
