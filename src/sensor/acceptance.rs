//! From which directions a sensor accepts light: the relative directional response `R(ω)`.
//!
//! The cosine of the angle of incidence is *not* part of `R`: it belongs to the measurement equation. An ideal
//! illuminance meter therefore has `R = 1` over its hemisphere, and a table gives the departure from the cosine.
//!
//! | acceptance | scene file | R(θ, φ) |
//! |---|---|---|
//! | cosine hemisphere | `Cosine` | 1 up to θ = 90° |
//! | cone | `Cone(half_angle_deg: 0.5)` | 1 up to the half-angle, 0 beyond |
//! | table | `Directional("directional.csv")` | piecewise linear in θ and φ, 1 at θ = 0 |
//! | spot | `Spot(field_deg: 1, focus_m: 1)` | 1 where a ray meets the field in the plane of focus, `spot.rs` |
//! | small heads at a point | `Spherical`, `Hemispherical`, `Cylindrical`, `Semicylindrical` | none: a weight w(ω) over all directions, `head.rs` |
//!
//! A fibre, `NumericalAperture(0.22)`, is a cone of half-angle asin(NA) in air. θ is counted from the sensor's normal, φ from its x axis towards its y axis.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::{Head, Spot};
use crate::math::DVec3;

/// The relative directional response of a sensor.
#[derive(Clone, Debug, PartialEq)]
pub enum Acceptance {
    /// Every direction above the sensor's horizon alike.
    Cosine,
    /// A cone about the normal.
    Cone {
        /// Half-angle, rad, 0 < α ≤ π/2.
        half_angle_rad: f64,
    },
    /// A table.
    Directional(DirectionalResponse),
    /// What a round pupil sees through a spot in its plane of focus.
    Spot(Spot),
    /// A small sphere: every direction alike.
    Spherical,
    /// A small hemisphere, its pole along the normal.
    Hemispherical,
    /// A small cylinder, its axis along the normal.
    Cylindrical,
    /// Half a small cylinder about the sensor's y axis, its front along the normal.
    Semicylindrical,
}

/// A tabulated directional response, bilinear between its nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectionalResponse {
    theta_rad: Vec<f64>,
    phi_rad: Vec<f64>,
    /// `values[i_phi][i_theta]`.
    values: Vec<Vec<f64>>,
}

impl DirectionalResponse {
    /// A response from its table: `values[i_phi][i_theta]`, the angles in rad.
    ///
    /// θ must start at 0, rise strictly and end at π/2 at most; the response is zero beyond the last θ. With one φ the
    /// response does not depend on φ; otherwise φ must start at 0, rise strictly and end below 2π, and the table is
    /// periodic. Values must be finite and not negative, at least one of them positive, and at θ = 0 the same for every φ. Returns what is wrong otherwise.
    pub fn new(theta_rad: Vec<f64>, phi_rad: Vec<f64>, values: Vec<Vec<f64>>) -> Result<Self, String> {
        let rises = |x: &[f64]| x.windows(2).all(|w| w[0] < w[1]);
        if theta_rad.len() < 2 || theta_rad[0] != 0.0 || !rises(&theta_rad) || theta_rad[theta_rad.len() - 1] > FRAC_PI_2 * (1.0 + 1e-12) {
            return Err("θ must start at 0°, rise strictly and end at 90° at most, with at least two rows".into());
        }
        if phi_rad.is_empty() || (phi_rad.len() > 1 && (phi_rad[0] != 0.0 || !rises(&phi_rad) || phi_rad[phi_rad.len() - 1] >= TAU)) {
            return Err("φ must start at 0°, rise strictly and end below 360°".into());
        }
        if values.len() != phi_rad.len() || values.iter().any(|row| row.len() != theta_rad.len()) {
            return Err(format!("{} × {} values are needed, one for each φ and θ", phi_rad.len(), theta_rad.len()));
        }
        if values.iter().flatten().any(|v| !v.is_finite() || *v < 0.0) {
            return Err("every value must be finite and not negative".into());
        }
        if let Some(row) = values.iter().position(|row| (row[0] - values[0][0]).abs() > 1e-6 * values[0][0].abs()) {
            return Err(format!(
                "θ = 0° is one direction: the response there must be the same for every φ, but it is {} at φ = 0° and {} at φ = {}°",
                values[0][0],
                values[row][0],
                phi_rad[row].to_degrees()
            ));
        }
        if values.iter().flatten().all(|v| *v == 0.0) {
            return Err("the response is zero in every direction".into());
        }
        Ok(Self { theta_rad, phi_rad, values })
    }

    /// R at a direction; θ in rad from the normal, φ in rad, any value.
    #[must_use]
    pub fn at(&self, theta_rad: f64, phi_rad: f64) -> f64 {
        let n = self.phi_rad.len();
        if n == 1 {
            return self.along(0, theta_rad);
        }
        let phi = phi_rad.rem_euclid(TAU);
        let upper = self.phi_rad.partition_point(|&x| x <= phi);
        let lower = upper - 1;
        let (next, next_phi) = if upper == n { (0, TAU) } else { (upper, self.phi_rad[upper]) };
        let share = (phi - self.phi_rad[lower]) / (next_phi - self.phi_rad[lower]);
        (1.0 - share) * self.along(lower, theta_rad) + share * self.along(next, theta_rad)
    }

    fn along(&self, row: usize, theta_rad: f64) -> f64 {
        let last = self.theta_rad.len() - 1;
        if theta_rad > self.theta_rad[last] {
            return 0.0;
        }
        let upper = self.theta_rad.partition_point(|&x| x <= theta_rad).clamp(1, last);
        let (a, b) = (self.theta_rad[upper - 1], self.theta_rad[upper]);
        let share = (theta_rad - a) / (b - a);
        (1.0 - share) * self.values[row][upper - 1] + share * self.values[row][upper]
    }

    /// The table: θ in rad, φ in rad, and `values[i_phi][i_theta]`.
    #[must_use]
    pub fn table(&self) -> (&[f64], &[f64], &[Vec<f64>]) {
        (&self.theta_rad, &self.phi_rad, &self.values)
    }

    /// The largest value of the table.
    #[must_use]
    pub fn max(&self) -> f64 {
        self.values.iter().flatten().fold(0.0, |m, &v| m.max(v))
    }

    /// θ nodes in rad and the values there, when the response does not depend on φ.
    #[must_use]
    pub fn rotationally_symmetric(&self) -> Option<(&[f64], &[f64])> {
        (self.phi_rad.len() == 1).then(|| (self.theta_rad.as_slice(), self.values[0].as_slice()))
    }
}

impl Acceptance {
    /// The head, where light from all round is weighed rather than a plane lit.
    #[must_use]
    pub fn head(&self) -> Option<Head> {
        match self {
            Acceptance::Cosine | Acceptance::Cone { .. } | Acceptance::Directional(_) | Acceptance::Spot(_) => None,
            Acceptance::Spherical => Some(Head::Spherical),
            Acceptance::Hemispherical => Some(Head::Hemispherical),
            Acceptance::Cylindrical => Some(Head::Cylindrical),
            Acceptance::Semicylindrical => Some(Head::Semicylindrical),
        }
    }

    /// Whether nothing is accepted from below the plane of the aperture. Heads see all round.
    #[must_use]
    pub fn has_horizon(&self) -> bool {
        self.head().is_none()
    }

    /// What a radiance from `to_local` counts, per steradian: `R cos θ` of a plane receptor, `w` of a head. `to_local`, of any length but zero,
    /// points to where the light comes from, in the sensor's frame x, y, normal.
    #[must_use]
    pub fn weight(&self, to_local: DVec3) -> f64 {
        if let Some(head) = self.head() {
            return head.weight(to_local);
        }
        let DVec3 { x, y, z } = to_local;
        let length = to_local.length();
        if z > 0.0 { self.at(z, x.hypot(y), y.atan2(x)) * z / length } else { 0.0 }
    }

    /// R in the direction of (cos θ, φ); zero below the horizon. A spot answers for the centre of its pupil. A head has no R and no horizon: this is its weight w.
    #[must_use]
    pub fn at(&self, cos_theta: f64, sin_theta: f64, phi_rad: f64) -> f64 {
        if let Some(head) = self.head() {
            let (sin, cos) = phi_rad.sin_cos();
            return head.weight(DVec3::new(sin_theta * cos, sin_theta * sin, cos_theta));
        }
        if cos_theta <= 0.0 {
            return 0.0;
        }
        match self {
            Acceptance::Cone { half_angle_rad } => f64::from(sin_theta.atan2(cos_theta) <= *half_angle_rad),
            Acceptance::Directional(table) => table.at(sin_theta.atan2(cos_theta), phi_rad),
            Acceptance::Spot(spot) => spot.response(spot.focus_m * sin_theta / cos_theta),
            _ => 1.0,
        }
    }

    /// The angle from the normal beyond which nothing is accepted, rad.
    #[must_use]
    pub fn limit_rad(&self) -> f64 {
        match self {
            Acceptance::Cosine => FRAC_PI_2,
            Acceptance::Cone { half_angle_rad } => *half_angle_rad,
            Acceptance::Directional(table) => table.theta_rad[table.theta_rad.len() - 1].min(FRAC_PI_2),
            Acceptance::Spot(spot) => spot.limit_rad(),
            Acceptance::Spherical | Acceptance::Hemispherical | Acceptance::Cylindrical | Acceptance::Semicylindrical => PI,
        }
    }

    /// `∫ R cosθ dω` over the hemisphere, for a head `∫ w dω` over all directions, sr: what a uniform radiance of one gives.
    #[must_use]
    pub fn projected_solid_angle_sr(&self) -> f64 {
        match self {
            Acceptance::Spherical => Head::Spherical.total_sr(),
            Acceptance::Cosine | Acceptance::Hemispherical | Acceptance::Cylindrical | Acceptance::Semicylindrical => PI,
            Acceptance::Cone { half_angle_rad } => PI * half_angle_rad.sin().powi(2),
            Acceptance::Directional(table) => table.projected_solid_angle_sr(),
            // The mean over its pupil.
            Acceptance::Spot(spot) => spot.projected_solid_angle_sr(),
        }
    }
}

impl DirectionalResponse {
    /// `∫ R sinθ cosθ dθ dφ`, exact for the bilinear table.
    ///
    /// `∫ (a + bθ) sin 2θ /2 dθ = −(a + bθ) cos 2θ /4 + b sin 2θ /8`; trapezoids in φ are exact for a linear table.
    #[must_use]
    pub fn projected_solid_angle_sr(&self) -> f64 {
        let row = |values: &[f64]| -> f64 {
            (1..values.len())
                .map(|i| {
                    let (t0, t1) = (self.theta_rad[i - 1], self.theta_rad[i]);
                    let b = (values[i] - values[i - 1]) / (t1 - t0);
                    let primitive = |t: f64, v: f64| -v * (2.0 * t).cos() / 4.0 + b * (2.0 * t).sin() / 8.0;
                    primitive(t1, values[i]) - primitive(t0, values[i - 1])
                })
                .sum()
        };
        let n = self.phi_rad.len();
        if n == 1 {
            return TAU * row(&self.values[0]);
        }
        (0..n)
            .map(|i| {
                let next_phi = if i + 1 == n { TAU } else { self.phi_rad[i + 1] };
                0.5 * (next_phi - self.phi_rad[i]) * (row(&self.values[i]) + row(&self.values[(i + 1) % n]))
            })
            .sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_normal_is_one_direction() {
        let table = |at_normal: [f64; 2]| {
            let rows = at_normal.map(|r| vec![r, 0.5]).to_vec();
            DirectionalResponse::new(vec![0.0, 1.0], vec![0.0, PI], rows)
        };
        assert!(table([1.0, 1.0]).is_ok());
        assert!(table([1.0, 2.0]).is_err_and(|why| why.contains("φ = 180°")));
    }
}
