//! Uniform radiance in a cone of acceptance.
//!
//! ```text
//! Ω = 4π sin²(α/2)          solid angle
//! G = π sin²α               projected solid angle, axis = normal
//! G = π sin²α cos τ         axis tilted by τ, wholly above the horizon (cut by it: `sphere::cap`)
//! ```
//!
//! | parameter | meaning | unit, range |
//! |---|---|---|
//! | `half_angle_rad` | half angle of the cone | rad, 0 to π |
//! | `tilt_rad` | angle between the axis and the receiver's normal | rad, 0 to π |
//! | `boundary_normal` | the half space p·boundary_normal > 0 is bright | 1 |
//!
//! A half space of light inside the cone is the luminance meter that looks at an edge: the part of a circle of radius sin β on one
//! side of a half ellipse of semi-axes 1 and |cos γ|.

use super::fan::Acceptance;
use super::frame::Frame;
use super::quadrature::integrate_between;
use super::sphere;
use crate::math::DVec3;
use std::f64::consts::PI;

/// Solid angle of a cone, sr; half angles beyond 0..π are clamped.
pub fn solid_angle(half_angle_rad: f64) -> f64 {
    let half_sine = (0.5 * half_angle_rad.clamp(0.0, PI)).sin();
    4.0 * PI * half_sine * half_sine.max(0.0)
}

/// Projected solid angle, sr, of a cone about the normal; beyond a right angle the horizon cuts, and it stays π.
pub fn projected_solid_angle(half_angle_rad: f64) -> f64 {
    Acceptance::new(half_angle_rad).map_or(0.0, |acceptance| PI * acceptance.sin * acceptance.sin)
}

/// Projected solid angle, sr, of a cone whose axis is tilted by `tilt_rad` from the normal, cut by the horizon where it reaches it.
pub fn tilted_projected_solid_angle(half_angle_rad: f64, tilt_rad: f64) -> f64 {
    sphere::cap(half_angle_rad, tilt_rad)
}

/// Projected solid angle, sr, of the half space on the side of `boundary_normal` within a cone about `normal`: a straight bright edge whose
/// plane passes through the receiver.
pub fn half_space_in_cone(boundary_normal: DVec3, normal: DVec3, half_angle_rad: f64) -> f64 {
    let (Some(frame), Some(acceptance)) = (Frame::new(normal), Acceptance::new(half_angle_rad)) else {
        return 0.0;
    };
    super::frame::unit(boundary_normal).map_or(0.0, |m| half_space_about_axis(frame.to_local(m), acceptance))
}

/// The same in receiver coordinates, `m` a unit vector.
pub(super) fn half_space_about_axis(m: DVec3, acceptance: Acceptance) -> f64 {
    let Acceptance { cos, sin } = acceptance;
    let (across, along) = (m.x.hypot(m.y), m.z);
    let whole = PI * sin * sin;
    // The plane meets the cone where cos φ = −(m_z/m_⊥) cot β.
    let margin = across * sin - along.abs() * cos;
    if margin <= 0.0 {
        return if along > 0.0 || (along == 0.0 && across == 0.0) { whole } else { 0.0 };
    }
    let half_chord = (margin * (across * sin + along.abs() * cos)).sqrt();
    // The smaller part lies on the side of the plane away from the axis.
    let half_azimuth = half_chord.atan2(along.abs() * cos);
    let half_arc = half_chord.atan2(cos);
    let closed = sin * sin * half_azimuth - along.abs() * half_arc;
    let smaller = if closed > 1e-4 * sin * sin * half_azimuth {
        closed
    } else {
        // sin²β − sin²θ(φ) with tan θ(φ) = |m_z|/(m_⊥ cos φ), as a product.
        let strip = |phi: f64| {
            let theta_sin = along.abs();
            let theta_cos = across * phi.cos();
            let r_squared = theta_sin * theta_sin + theta_cos * theta_cos;
            (sin * theta_cos - cos * theta_sin).max(0.0) * (sin * theta_cos + cos * theta_sin) / r_squared
        };
        integrate_between(&[0.0, half_azimuth], &strip, 1e-13).value
    };
    if along > 0.0 { whole - smaller } else { smaller.max(0.0) }
}
