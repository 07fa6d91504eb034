//! Small heads that weigh light from all round: any combination of three integrals over a uniform source.
//!
//! ```text
//! ∫ w dω = a Ω + b n·V + c C        Ω = ∫ dω,   n·V = ∫ ω·n dω = G(n) − G(−n),   C = ∫ sin ε dω
//! tan(Ω/2) = a·(b×c) / (abc + (a·b)c + (b·c)a + (c·a)b)        of a triangle; a fan of them makes a polygon
//! sphere   Ω = 4π sin²(α/2),   n·V = π sin²α cos τ
//! ```
//!
//! | symbol | meaning | unit, range |
//! |---|---|---|
//! | a, b, c | `weights`: of a sphere 1, 0, 0; hemisphere ¼, ¼, 0; cylinder 0, 0, 1/π; semicylinder 0, 1/π, 1/π | 1 |
//! | n, axis | direction of the head, axis from which ε is counted, any length | 1 |
//! | G | projected solid angle of a plane receptor | sr |
//! | C | `across_axis.rs` | sr |
//!
//! Positions are relative to the head. On a luminous face the result is 0: the head sees it edge-on.
//!
//! Triangle: van Oosterom and Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125.

use super::across_axis;
use super::aperture::Bounded;
use super::frame::{dot, power_of_two_scale, triple, unit};
use super::{cone, disc as projected_disc, point, polygon as projected_polygon};
use crate::math::DVec3;
use crate::sensor::HeadWeights;
use std::f64::consts::PI;

/// A head: its weights and the two directions that they refer to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oriented {
    /// The three coefficients of w.
    pub weights: HeadWeights,
    /// n, unit length.
    pub normal: DVec3,
    /// Where ε is counted from, unit length.
    pub axis: DVec3,
}

impl Oriented {
    /// Sums the three integrals; those that do not count are not taken.
    fn sum(&self, solid_angle: impl Fn() -> f64, projected: impl Fn(DVec3) -> f64, across: impl Fn(DVec3) -> Bounded) -> Bounded {
        let HeadWeights { uniform, along, across: sideways } = self.weights;
        let mut terms: Vec<Bounded> = Vec::with_capacity(4);
        let exact = |value: f64| Bounded { value, error: 2.0 * f64::EPSILON * value.abs() };
        if uniform != 0.0 {
            terms.push(exact(uniform * solid_angle()));
        }
        if along != 0.0 {
            terms.push(exact(along * projected(self.normal)));
            terms.push(exact(-along * projected(-self.normal)));
        }
        if sideways != 0.0 {
            let found = across(self.axis);
            terms.push(Bounded { value: sideways * found.value, error: sideways.abs() * found.error });
        }
        let value: f64 = terms.iter().map(|t| t.value).sum();
        let error: f64 = terms.iter().map(|t| t.error).sum();
        Bounded { value: value.max(0.0), error }
    }

    /// ∫ w dω of a plane polygon, `vertices` counter-clockwise about its emitting side; 0 from behind.
    #[must_use]
    pub fn polygon(&self, vertices: &[DVec3]) -> Bounded {
        if !projected_polygon::receiver_in_front(vertices) {
            return Bounded { value: 0.0, error: 0.0 };
        }
        self.sum(
            || polygon_solid_angle(vertices),
            |n| projected_polygon::polygon_two_sided(vertices, n),
            |axis| across_axis::polygon(vertices, axis),
        )
    }

    /// ∫ w dω of a disc that emits to the side of `facing`; 0 from behind.
    #[must_use]
    pub fn disc(&self, centre: DVec3, facing: DVec3, radius_m: f64) -> Bounded {
        let (Some(m), true) = (unit(facing), projected_disc::receiver_in_front(centre, facing)) else {
            return Bounded { value: 0.0, error: 0.0 };
        };
        self.sum(
            || point::disc_solid_angle(radius_m, dot(m, centre), m.cross(centre).length()),
            |n| projected_disc::disc_two_sided(centre, facing, radius_m, n),
            |axis| across_axis::disc(centre, facing, radius_m, axis),
        )
    }

    /// ∫ w dω of a sphere seen from outside; on its surface the half space on its side.
    #[must_use]
    pub fn sphere(&self, centre: DVec3, radius_m: f64) -> Bounded {
        let (Some(direction), Some(scale)) = (unit(centre), power_of_two_scale(centre.abs().max_element().max(radius_m))) else {
            return Bounded { value: 0.0, error: 0.0 };
        };
        let (distance, radius) = ((centre * scale).length(), radius_m * scale);
        let sin = (radius / distance).min(1.0);
        let cos = ((distance - radius).max(0.0) * (distance + radius)).sqrt() / distance;
        self.sum(
            || cone::solid_angle(sin.atan2(cos)),
            |n| PI * sin * sin * dot(n, direction).max(0.0),
            |axis| across_axis::cap(direction, sin, cos, axis),
        )
    }

    /// ∫ w dω of the half space on the side of `direction`.
    #[must_use]
    pub fn half_space(&self, direction: DVec3) -> Bounded {
        let Some(direction) = unit(direction) else { return Bounded { value: 0.0, error: 0.0 } };
        self.sum(|| 2.0 * PI, |n| PI * dot(n, direction).max(0.0), |_| Bounded { value: across_axis::HALF_SPACE, error: 0.0 })
    }

    /// ∫ w dω of everything.
    #[must_use]
    pub fn everything(&self) -> Bounded {
        self.sum(|| 4.0 * PI, |_| 0.0, |_| Bounded { value: across_axis::EVERYTHING, error: 0.0 })
    }
}

/// Solid angle, sr, of a plane polygon (two-sided); 0 in its plane.
pub fn polygon_solid_angle(vertices: &[DVec3]) -> f64 {
    let size = vertices.iter().fold(0.0_f64, |size, v| size.max(v.abs().max_element()));
    let Some(scale) = power_of_two_scale(size).filter(|_| vertices.iter().all(|v| v.is_finite())) else {
        return 0.0;
    };
    let at = |i: usize| vertices[i] * scale;
    let triangle = |p: DVec3, q: DVec3, r: DVec3| {
        let (lp, lq, lr) = (p.length(), q.length(), r.length());
        2.0 * triple(p, q, r).atan2(lp * lq * lr + p.dot(q) * lr + q.dot(r) * lp + r.dot(p) * lq)
    };
    (1..vertices.len().saturating_sub(1)).map(|i| triangle(at(0), at(i), at(i + 1))).sum::<f64>().abs()
}
