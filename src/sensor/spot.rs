//! The measured field of a luminance meter: what an entrance pupil sees through a round spot in the plane of focus.
//!
//! ```text
//! L_read = ∫∫ R L cos θ dω dA / ∫∫ R cos θ dω dA
//! R: where the ray from a point of the pupil meets the plane of focus, at a distance r from the axis
//!    1 for r ≤ (1 − e/2) r₀,  0 for r ≥ (1 + e/2) r₀,  linear between;   r₀ = f tan(field/2)
//! ∫∫ cos θ dω dA = π²/2 (p − √(p² − 4 a² r²)),   p = a² + r² + f²           two coaxial discs
//! ```
//!
//! | symbol | field | meaning | unit, range |
//! |---|---|---|---|
//! | field/2 | `half_angle_rad` | half the measured field, from the centre of the pupil | rad, 0 to π/4 |
//! | f | `focus_m` | distance of the plane of focus from the pupil | m |
//! | e | `edge` | width of the edge as a share of r₀, half of it inside | 1, 0 to 1 |
//! | a | `pupil_radius_m` | radius of the entrance pupil: the aperture of the sensor | m |
//!
//! In the plane of focus the field has its edge alone; before and behind it the pupil blurs the field. With an edge, the étendue is the mean over
//! the radii of the edge.
//!
//! ```
//! use etendue::sensor::Spot;
//!
//! // A pupil that is small against the distance sees a cone.
//! let spot = Spot { half_angle_rad: 0.1, focus_m: 1.0, edge: 0.0, pupil_radius_m: 1e-6 };
//! let cone = std::f64::consts::PI * 0.1_f64.sin().powi(2);
//! assert!((spot.projected_solid_angle_sr() / cone - 1.0).abs() < 1e-11);
//! ```
//!
//! Étendue of coaxial discs: Howell, A Catalog of Radiation Heat Transfer Configuration Factors.

use std::f64::consts::PI;

/// The measured field of a luminance meter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Half the measured field, rad.
    pub half_angle_rad: f64,
    /// Distance of the plane of focus from the entrance pupil, m.
    pub focus_m: f64,
    /// Width of the edge as a share of the field's radius.
    pub edge: f64,
    /// Radius of the entrance pupil, m.
    pub pupil_radius_m: f64,
}

/// Nodes and weights of Gauss' rule with 5 points on (−1, 1).
const GAUSS: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];
/// Panels of the edge; the étendue is smooth in the radius.
const PANELS: u32 = 16;

impl Spot {
    /// r₀: radius of the field in the plane of focus, m.
    #[must_use]
    pub fn field_radius_m(&self) -> f64 {
        self.focus_m * self.half_angle_rad.tan()
    }

    /// Radius beyond which nothing is accepted, in the plane of focus, m.
    #[must_use]
    pub fn outer_radius_m(&self) -> f64 {
        (1.0 + 0.5 * self.edge) * self.field_radius_m()
    }

    /// R at a distance from the axis in the plane of focus, m.
    #[inline(always)]
    #[must_use]
    pub fn response(&self, radius_m: f64) -> f64 {
        let outer = self.outer_radius_m();
        let width = self.edge * self.field_radius_m();
        if width > 0.0 { ((outer - radius_m) / width).clamp(0.0, 1.0) } else { f64::from(radius_m <= outer) }
    }

    /// The largest angle between the axis and a ray that is accepted at any point of the pupil, rad.
    #[must_use]
    pub fn limit_rad(&self) -> f64 {
        (self.pupil_radius_m + self.outer_radius_m()).atan2(self.focus_m)
    }

    /// Radius of a circle about the axis that holds all accepted rays at a distance from the pupil, m.
    #[must_use]
    pub fn beam_radius_m(&self, distance_m: f64) -> f64 {
        let t = distance_m / self.focus_m;
        self.pupil_radius_m * (1.0 - t).abs() + self.outer_radius_m() * t
    }

    /// `∫∫ R cos θ dω dA` over the area of the pupil, sr: what a uniform radiance of one gives.
    #[must_use]
    pub fn projected_solid_angle_sr(&self) -> f64 {
        let (inner, outer) = ((1.0 - 0.5 * self.edge) * self.field_radius_m(), self.outer_radius_m());
        if inner >= outer {
            return self.of_disc_sr(outer);
        }
        let step = (outer - inner) / f64::from(PANELS);
        let panel = |k: u32| -> f64 {
            let middle = inner + (f64::from(k) + 0.5) * step;
            GAUSS.iter().map(|(x, w)| 0.5 * w * self.of_disc_sr(middle + 0.5 * x * step)).sum()
        };
        (0..PANELS).map(panel).sum::<f64>() / f64::from(PANELS)
    }

    /// Mean over the pupil of the projected solid angle of a disc of this radius in the plane of focus, sr; 2π r²/(p + √(p² − 4a²r²)).
    fn of_disc_sr(&self, radius_m: f64) -> f64 {
        // Relative to the distance of focus: no length overflows or vanishes.
        let (a, r) = (self.pupil_radius_m / self.focus_m, radius_m / self.focus_m);
        let p = a * a + r * r + 1.0;
        2.0 * PI * r * r / (p + 1.0_f64.hypot(a - r) * 1.0_f64.hypot(a + r))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_edge_falls_linearly_about_the_nominal_field() {
        let spot = Spot { half_angle_rad: 0.1, focus_m: 2.0, edge: 0.2, pupil_radius_m: 0.01 };
        let r0 = spot.field_radius_m();
        for (share, expected) in [(0.0, 1.0), (0.9, 1.0), (0.95, 0.75), (1.0, 0.5), (1.05, 0.25), (1.1, 0.0), (2.0, 0.0)] {
            assert!((spot.response(share * r0) - expected).abs() < 1e-12, "{share}");
        }
    }

    /// A thin edge is no edge; a wide one has the mean of the squares of its radii, for a narrow field.
    #[test]
    fn the_etendue_is_the_mean_over_the_edge() {
        let spot = |edge: f64| Spot { half_angle_rad: 1e-4, focus_m: 2.0, edge, pupil_radius_m: 0.01 }.projected_solid_angle_sr();
        assert!((spot(1e-9) / spot(0.0) - 1.0).abs() < 1e-12);
        // ⟨ρ²⟩ = r₀² (1 + e²/12); curvature is of the order of the square of the angle.
        assert!((spot(1.0) / spot(0.0) - (1.0 + 1.0 / 12.0)).abs() < 1e-7);
    }
}
