//! How well a head over the full sphere follows its ideal: f2 of planar, spherical, hemispherical, cylindrical and semicylindrical heads.
//!
//! ```text
//! f2 = ∫ |y(ω)/y(ω₀) − w(ω)/w(ω₀)| dω / ∫ w(ω)/w(ω₀) dω
//! ```
//!
//! | head | polar axis, φ = 0 | w(θ, φ) | reference ω₀ | symbol |
//! |---|---|---|---|---|
//! | planar | normal | cos θ above the horizon | θ = 0 | f2 |
//! | spherical | any | 1/4 | θ = 0 | f2,0 |
//! | hemispherical | pole | (1 + cos θ)/4 | θ = 0 | f2,h |
//! | cylindrical | axis of the cylinder | sin θ / π | θ = 90°, φ = 0 | f2,z |
//! | semicylindrical | axis of the cylinder, front | sin θ (1 + cos φ) / π | θ = 90°, φ = 0 | f2,zh |
//!
//! y is the reading of the same beam from direction (θ, φ). For a planar head the fraction is `∫ |Y/(Y₀ cos ε) − 1| sin 2ε dε`, the mean over
//! azimuth of the index of ISO/CIE 19476; that the other heads are weighted in the same way, with their own ideal, follows CIE 69 as the
//! literature describes it and could not be checked against the texts, nor could a smaller range of angles: here it is the whole sphere.
//!
//! ```
//! use etendue::characterization::head_mismatch::{Head, f2_of_head};
//!
//! let ideal = f2_of_head(Head::Cylindrical, &|theta, _| 7.0 * theta.sin())?;
//! assert!(ideal.value < 1e-14);
//! // A planar receptor in place of a spherical one: |cos θ − 1| above and 1 below the horizon, over the sphere.
//! let planar = f2_of_head(Head::Spherical, &|theta, _| theta.cos().max(0.0))?;
//! assert!((planar.value - 0.75).abs() < 3.0 * planar.standard_uncertainty);
//! # Ok::<(), etendue::characterization::directional_mismatch::DirectionalError>(())
//! ```

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::Figure;
use super::directional_mismatch::DirectionalError;
use crate::sensor;

/// Cells in θ of the finer of the two sums; even, so that the horizon is an edge.
const CELLS_THETA: u32 = 360;
/// Cells in φ of the finer of the two sums; a multiple of four.
const CELLS_PHI: u32 = 240;

/// What a head is meant to weigh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Head {
    /// Planar irradiance.
    Planar,
    /// Spherical irradiance.
    Spherical,
    /// Hemispherical irradiance.
    Hemispherical,
    /// Cylindrical irradiance.
    Cylindrical,
    /// Semicylindrical irradiance.
    Semicylindrical,
}

impl Head {
    /// All heads.
    pub const ALL: [Self; 5] = [Self::Planar, Self::Spherical, Self::Hemispherical, Self::Cylindrical, Self::Semicylindrical];

    /// Ideal weight w(θ, φ), θ in rad from the polar axis of the head, φ in rad; see the table above.
    #[must_use]
    pub fn ideal(self, theta_rad: f64, phi_rad: f64) -> f64 {
        match self {
            Self::Planar => theta_rad.cos().max(0.0),
            Self::Spherical => 0.25,
            Self::Hemispherical => 0.25 * (1.0 + theta_rad.cos()),
            Self::Cylindrical => theta_rad.sin() / PI,
            Self::Semicylindrical => theta_rad.sin() * (1.0 + phi_rad.cos()) / PI,
        }
    }

    /// The direction of calibration, (θ, φ) in rad.
    #[must_use]
    pub fn reference_rad(self) -> (f64, f64) {
        match self {
            Self::Planar | Self::Spherical | Self::Hemispherical => (0.0, 0.0),
            Self::Cylindrical | Self::Semicylindrical => (FRAC_PI_2, 0.0),
        }
    }

    /// The head of a sensor.
    #[must_use]
    pub fn of(head: sensor::Head) -> Self {
        match head {
            sensor::Head::Spherical => Self::Spherical,
            sensor::Head::Hemispherical => Self::Hemispherical,
            sensor::Head::Cylindrical => Self::Cylindrical,
            sensor::Head::Semicylindrical => Self::Semicylindrical,
        }
    }

    /// The adjective: "cylindrical".
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Planar => "planar",
            Self::Spherical => "spherical",
            Self::Hemispherical => "hemispherical",
            Self::Cylindrical => "cylindrical",
            Self::Semicylindrical => "semicylindrical",
        }
    }

    /// Symbol of the index in [`super::class_limits`]; `None` where there are no limits.
    #[must_use]
    pub fn symbol(self) -> Option<&'static str> {
        match self {
            Self::Planar => Some("f2"),
            Self::Spherical => Some("f2_0"),
            Self::Hemispherical => None,
            Self::Cylindrical => Some("f2_z"),
            Self::Semicylindrical => Some("f2_zh"),
        }
    }
}

/// f2 of a head from its directional response y(θ, φ), in any unit, with the cosine or whatever else belongs to the weight; a pure number.
/// Its uncertainty is that of the sum over cells, from the sum over cells of twice the width.
///
/// # Errors
/// [`DirectionalError`].
pub fn f2_of_head(head: Head, response: &dyn Fn(f64, f64) -> f64) -> Result<Figure, DirectionalError> {
    let (theta, phi) = head.reference_rad();
    let reference = response(theta, phi);
    if !(reference.is_finite() && reference > 0.0) {
        return Err(DirectionalError::NoResponse(reference));
    }
    let ideal = head.ideal(theta, phi);
    let deviation = |theta: f64, phi: f64| (response(theta, phi) / reference - head.ideal(theta, phi) / ideal).abs();
    let whole = mean(&|theta, phi| head.ideal(theta, phi) / ideal, 1)?;
    let (coarse, fine) = (mean(&deviation, 2)? / whole, mean(&deviation, 1)? / whole);
    Ok(Figure { value: fine, standard_uncertainty: (fine - coarse).abs() / 3f64.sqrt() + f64::EPSILON * fine })
}

/// Largest change of [`f2_of_head`] when the response changes by `error`, in the unit of the response, anywhere: its mean over the sphere
/// beside that of the ideal.
///
/// # Errors
/// [`DirectionalError`].
pub fn change_of_f2(head: Head, reference: f64, error: &dyn Fn(f64, f64) -> f64) -> Result<f64, DirectionalError> {
    let (theta, phi) = head.reference_rad();
    let ideal = head.ideal(theta, phi);
    Ok(mean(&|theta, phi| error(theta, phi).abs() / reference, 1)? / mean(&|theta, phi| head.ideal(theta, phi) / ideal, 1)?)
}

/// Mean over the sphere by the middles of cells of equal Δθ and Δφ, each with its exact share of the sphere.
fn mean(f: &dyn Fn(f64, f64) -> f64, coarser: u32) -> Result<f64, DirectionalError> {
    let (rows, columns) = (CELLS_THETA / coarser, CELLS_PHI / coarser);
    let (d_theta, d_phi) = (PI / f64::from(rows), TAU / f64::from(columns));
    let mut sum = 0.0;
    for row in 0..rows {
        let theta = (f64::from(row) + 0.5) * d_theta;
        let share = theta.sin() * (0.5 * d_theta).sin() / f64::from(columns);
        for column in 0..columns {
            let value = f(theta, (f64::from(column) + 0.5) * d_phi);
            if !value.is_finite() {
                return Err(DirectionalError::NotFinite(theta));
            }
            sum += share * value;
        }
    }
    Ok(sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn every_ideal_head_has_no_index_and_its_integral() {
        // ∫ w dω: planar π, spherical π, hemispherical π, cylindrical π, semicylindrical π: in a uniform radiance all read alike.
        for head in Head::ALL {
            let found = f2_of_head(head, &|theta, phi| 3.0 * head.ideal(theta, phi)).unwrap();
            assert!(found.value < 1e-14, "{head:?} {found:?}");
            let integral = 4.0 * PI * mean(&|theta, phi| head.ideal(theta, phi), 1).unwrap();
            assert!((integral / PI - 1.0).abs() < 1e-4, "{head:?} {integral}");
        }
    }

    #[test]
    fn heads_that_see_nothing_are_told() {
        assert!(matches!(f2_of_head(Head::Planar, &|_, _| 0.0), Err(DirectionalError::NoResponse(_))));
        let broken = |theta: f64, _: f64| if theta > 1.0 { f64::NAN } else { 1.0 };
        assert!(matches!(f2_of_head(Head::Planar, &broken), Err(DirectionalError::NotFinite(_))));
    }

    proptest! {
        #[test]
        fn a_planar_head_has_the_index_of_its_response(a in -0.3..0.3f64) {
            // R = 1 + a sin²ε: f2 = |a| ∫ sin²ε sin 2ε dε = |a|/2, by either route.
            let response = |theta: f64, _: f64| theta.cos().max(0.0) * (1.0 + a * theta.sin().powi(2));
            let found = f2_of_head(Head::Planar, &response).unwrap();
            prop_assert!((found.value - 0.5 * a.abs()).abs() < 1e-4, "{:?}", found);
            let planar = super::super::directional_mismatch::f2_of_response(&|e| 1.0 + a * e.sin().powi(2), &[], FRAC_PI_2).unwrap();
            prop_assert!((found.value - planar).abs() < 1e-4);
        }
    }
}
