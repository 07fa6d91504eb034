//! Uniform sphere, and the spherical cap it is seen as.
//!
//! ```text
//! sin α = R/d,  cos τ = n·c/d,  e = π/2 − τ
//! above the horizon (e ≥ α)    G = π sin²α cos τ
//! below (e ≤ −α)               G = 0
//! partly sunk                  G = π sin²α max(0, cos τ) + K
//!     K = ψ − cos α · Q − sin²α |cos τ| χ,   Q² = sin²α − cos²τ,   tan ψ = Q/cos α,   tan χ = Q/(cos α |cos τ|)
//! ```
//!
//! | parameter | meaning | unit, range |
//! |---|---|---|
//! | `centre`, `radius_m` | sphere, relative to the receiver | m |
//! | `half_angle_rad`, `tilt_rad` | cap; angle of its axis from the normal | rad, 0 to π |
//!
//! K is the part above the horizon of a cap whose centre is as far below it as the true one is above. The three terms cancel to fifth
//! order for a thin sliver; they are regrouped with B(x) = atan x − x + x³/3, which is small by itself. The unregrouped form: Howell,
//! A Catalog of Radiation Heat Transfer Configuration Factors (element to sphere, three cases).

use super::fan::Acceptance;
use super::frame::{Frame, dot, power_of_two_scale, unit};
use super::{cone, disc};
use crate::math::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};

/// Projected solid angle, sr, of a sphere of radius `radius_m` about `centre` (m, relative to the receiver) for a receiver of normal `normal`.
///
/// A receiver inside the sphere is enclosed by it: π. On its surface the limit from outside: a hemisphere about the centre's direction.
pub fn sphere(centre: DVec3, radius_m: f64, normal: DVec3) -> f64 {
    let Some((cap, n)) = SphericalCap::of_sphere(centre, radius_m, normal) else {
        return 0.0;
    };
    match cap {
        Seen::Enclosing => PI,
        Seen::Cap(cap) => cap.above_horizon(n),
    }
}

/// Projected solid angle, sr, of a sphere within a cone of half angle `half_angle_rad` about the receiver's normal. Limits as [`sphere()`].
pub fn sphere_in_cone(centre: DVec3, radius_m: f64, normal: DVec3, half_angle_rad: f64) -> f64 {
    let Some(acceptance) = Acceptance::new(half_angle_rad) else {
        return 0.0;
    };
    let Some((cap, n)) = SphericalCap::of_sphere(centre, radius_m, normal) else {
        return 0.0;
    };
    match cap {
        Seen::Enclosing => PI * acceptance.sin * acceptance.sin,
        Seen::Cap(cap) if acceptance.cos == 0.0 => cap.above_horizon(n),
        Seen::Cap(cap) => cap.in_cone(normal, acceptance),
    }
}

/// Projected solid angle, sr, of a spherical cap of half angle `half_angle_rad` whose centre is `tilt_rad` away from the receiver's normal.
/// Beyond a right angle the cap is the complement of the opposite one.
pub fn cap(half_angle_rad: f64, tilt_rad: f64) -> f64 {
    if half_angle_rad.is_nan() || half_angle_rad <= 0.0 || !tilt_rad.is_finite() {
        return 0.0;
    }
    if half_angle_rad >= PI {
        return PI;
    }
    let tilt = tilt_rad.abs().min(PI);
    if half_angle_rad > FRAC_PI_2 {
        return (PI - cap(PI - half_angle_rad, PI - tilt)).max(0.0);
    }
    // π/2 − τ, but from the cosine: the rounded right angle is not exact.
    let elevation = tilt.cos().atan2(tilt.sin());
    let excess = (half_angle_rad + elevation).sin() * (half_angle_rad - elevation).sin();
    let beyond = if elevation.abs() >= half_angle_rad { -1.0 } else { excess };
    projected_cap(half_angle_rad.sin(), half_angle_rad.cos(), tilt.cos(), beyond)
}

/// Projected solid angle, sr, of a cap of the sphere of directions within a cone; the same outline as a disc.
pub fn cap_in_cone(cap_half_angle_rad: f64, tilt_rad: f64, half_angle_rad: f64) -> f64 {
    let Some(acceptance) = Acceptance::new(half_angle_rad) else {
        return 0.0;
    };
    if acceptance.cos == 0.0 {
        return cap(cap_half_angle_rad, tilt_rad);
    }
    if cap_half_angle_rad.is_nan() || cap_half_angle_rad <= 0.0 || !tilt_rad.is_finite() {
        return 0.0;
    }
    let (sin, cos) = tilt_rad.sin_cos();
    let axis = DVec3::new(sin, 0.0, cos);
    let whole = PI * acceptance.sin * acceptance.sin;
    if cap_half_angle_rad >= PI {
        whole
    } else if cap_half_angle_rad > FRAC_PI_2 {
        (whole - cap_in_cone(PI - cap_half_angle_rad, PI - tilt_rad.abs(), half_angle_rad)).max(0.0)
    } else if cap_half_angle_rad == FRAC_PI_2 {
        cone::half_space_about_axis(axis, acceptance)
    } else {
        disc::disc_in_acceptance(axis * cap_half_angle_rad.cos(), axis, cap_half_angle_rad.sin(), DVec3::Z, acceptance)
    }
}

/// Projected solid angle of a cap: sine and cosine of its half angle (at most a right angle), cosine of the tilt, and
/// sin²α − cos²τ (not positive where the cap is wholly above or wholly below the horizon).
fn projected_cap(sin: f64, cos: f64, tilt_cos: f64, excess: f64) -> f64 {
    let whole = PI * sin * sin * tilt_cos.max(0.0);
    if excess <= 0.0 {
        return whole;
    }
    if cos <= 0.0 {
        return FRAC_PI_2 * (1.0 + tilt_cos).max(0.0);
    }
    (whole + sunk_part(sin, cos, tilt_cos.abs(), excess.sqrt())).max(0.0)
}

/// K of the header; `s` = |cos τ|, `q` = Q.
fn sunk_part(sin: f64, cos: f64, s: f64, q: f64) -> f64 {
    let tau = q / cos;
    if tau < 0.7 * s {
        let common = tau * tau * tau * tau * tau * (1.0 - s * s) / (3.0 * s * s * (1.0 + tau * tau));
        return atan_beyond_third(tau) + common - sin * sin * s * atan_beyond_third(tau / s);
    }
    let chi = q.atan2(cos * s);
    if tau < 0.5 {
        // τ − atan τ = τ³/3 − B(τ)
        return sin * sin * (tau - s * chi) - (tau * tau * tau / 3.0 - atan_beyond_third(tau));
    }
    tau.atan() - cos * q - sin * sin * s * chi
}

/// B(x) = atan x − x + x³/3 = x⁵/5 − x⁷/7 + …
fn atan_beyond_third(x: f64) -> f64 {
    if x > 0.7 {
        return x.atan() - x + x * x * x / 3.0;
    }
    let square = x * x;
    let mut power = square * square * x;
    let mut sum = 0.0;
    let mut order = 5.0;
    while power.abs() > 1e-18 * sum {
        sum += power / order;
        power *= -square;
        order += 2.0;
        if power == 0.0 {
            break;
        }
    }
    sum
}

/// What a receiver sees of a sphere.
enum Seen {
    /// The receiver is inside.
    Enclosing,
    Cap(SphericalCap),
}

/// A cap by the sine and cosine of its half angle (at most a right angle) and its axis.
struct SphericalCap {
    sin: f64,
    cos: f64,
    axis: DVec3,
}

impl SphericalCap {
    /// The cap as which a sphere is seen, and the unit normal of the receiver.
    fn of_sphere(centre: DVec3, radius_m: f64, normal: DVec3) -> Option<(Seen, DVec3)> {
        let n = unit(normal)?;
        if radius_m.is_nan() || radius_m <= 0.0 || !centre.is_finite() {
            return None;
        }
        let scale = power_of_two_scale(centre.abs().max_element().max(radius_m))?;
        let (c, radius) = (centre * scale, radius_m * scale);
        let distance = dot(c, c).sqrt();
        if distance < radius {
            return Some((Seen::Enclosing, n));
        }
        let cos = ((distance - radius) * (distance + radius)).sqrt() / distance;
        Some((Seen::Cap(SphericalCap { sin: radius / distance, cos, axis: unit(c)? }), n))
    }

    fn above_horizon(&self, n: DVec3) -> f64 {
        let tilt_cos = dot(n, self.axis);
        projected_cap(self.sin, self.cos, tilt_cos, (self.sin - tilt_cos.abs()) * (self.sin + tilt_cos.abs()))
    }

    /// Two circles on the sphere of directions; the cap has the outline of a disc at distance cos α of radius sin α.
    fn in_cone(&self, normal: DVec3, acceptance: Acceptance) -> f64 {
        if self.cos > 0.0 {
            disc::disc_in_acceptance(self.axis * self.cos, self.axis, self.sin, normal, acceptance)
        } else {
            Frame::new(normal).map_or(0.0, |frame| cone::half_space_about_axis(frame.to_local(self.axis), acceptance))
        }
    }
}
