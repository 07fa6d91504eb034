//! Solid angles and projected solid angles in closed form, without cancellation.
//!
//! ```text
//! Ω = A / r²                                                  patch A of a sphere of radius r; any small area that faces the viewer
//! Ω = 4π sin²(½ atan(R/d))                                    disc of radius R, on its axis at the distance d
//! Ω = 2 Δφ sin((θ₀+θ₁)/2) sin((θ₁−θ₀)/2)                      rectangle in polar angles, θ₀..θ₁ by Δφ
//! tan(Ω/2) = |a·(b×c)| / (abc + (a·b)c + (b·c)a + (c·a)b)     spherical triangle with the corners in the directions a, b, c
//! Ω_p = ∫ cos θ dω                                            projected solid angle: half space π, cone about the normal π sin²α
//! ```
//!
//! A triple product of nearly parallel directions cancels; it is taken from the edges b − a and c − a, which for close corners are exact.
//! A plane rectangle is cut at the feet of its perpendiculars into quadrants, in which every term of the triangles' formula is positive.
//!
//! Source: A. Van Oosterom and J. Strackee, IEEE Transactions on Biomedical Engineering 30 (1983) 125; DIN 5031-1.

use super::extent::{Area, Distance, Etendue, ProjectedSolidAngle, SolidAngle};
use super::table::{Quantity, kind};
use std::f64::consts::PI;
use std::ops::Mul;

type Vector = [f64; 3];

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn largest(a: Vector) -> f64 {
    a.iter().fold(0.0, |most: f64, x| most.max(x.abs()))
}

/// The vector times a power of two that brings it close to `reference`, exactly.
fn scaled(a: Vector, exponent: i32) -> Vector {
    // In two steps, because one power of two may leave the range of f64.
    let half = exponent / 2;
    a.map(|x| x * 2f64.powi(half) * 2f64.powi(exponent - half))
}

/// Power of two of a positive number, subnormal ones included.
fn exponent_of(x: f64) -> i32 {
    x.log2().floor() as i32
}

/// From the modulus of the triple product and the corners.
fn triangle_of(volume: f64, [a, b, c]: [Vector; 3]) -> f64 {
    let [ra, rb, rc] = [a, b, c].map(|v| dot(v, v).sqrt());
    2.0 * volume.atan2(ra * rb * rc + dot(a, b) * rc + dot(b, c) * ra + dot(c, a) * rb)
}

impl SolidAngle {
    /// A patch of `area` on a sphere of radius `distance` about the viewer: `A / r²`. Of a flat area that faces the viewer, the limit
    /// for small ones.
    ///
    /// ```
    /// use etendue::quantity::{Area, Distance, SolidAngle};
    /// assert_eq!(SolidAngle::patch(Area::new(0.02), Distance::new(2.0)).to_string(), "0.005 sr");
    /// ```
    pub fn patch(area: Area, distance: Distance) -> Self {
        Self::new(area.value() / distance.value() / distance.value())
    }

    /// A disc of `radius` that is seen from its axis, at `distance` from its plane.
    ///
    /// ```
    /// use etendue::quantity::{Distance, SolidAngle};
    /// let seen = SolidAngle::disc(Distance::new(1e6), Distance::new(1e-6));
    /// assert!((seen.value() / SolidAngle::HEMISPHERE.value() - 1.0).abs() < 1e-11);
    /// ```
    pub fn disc(radius: Distance, distance: Distance) -> Self {
        Self::cone(radius.value().atan2(distance.value()))
    }

    /// A rectangle in polar coordinates: polar angles from `theta_from_rad` to `theta_to_rad`, 0 to π, and an azimuth of `azimuth_rad`,
    /// 0 to 2π.
    ///
    /// ```
    /// use etendue::quantity::SolidAngle;
    /// use std::f64::consts::{FRAC_PI_2, PI};
    /// let octant = SolidAngle::polar_rectangle(0.0, FRAC_PI_2, FRAC_PI_2);
    /// assert!((octant.value() - 0.5 * PI).abs() < 1e-15);
    /// ```
    pub fn polar_rectangle(theta_from_rad: f64, theta_to_rad: f64, azimuth_rad: f64) -> Self {
        let (middle, half) = (0.5 * (theta_from_rad + theta_to_rad), 0.5 * (theta_to_rad - theta_from_rad));
        Self::new(2.0 * azimuth_rad * middle.sin() * half.sin().abs())
    }

    /// A plane rectangle at `distance`, above zero: `x_m` and `y_m` are where it begins and ends, in m from the foot of the
    /// perpendicular from the viewer, in any order. `None` if one of the numbers is not finite or the distance not above zero.
    ///
    /// ```
    /// use etendue::quantity::{Distance, SolidAngle};
    /// // One face of a cube, from its centre.
    /// let face = SolidAngle::rectangle([-1.0, 1.0], [-1.0, 1.0], Distance::new(1.0)).unwrap();
    /// assert!((6.0 * face.value() / SolidAngle::SPHERE.value() - 1.0).abs() < 1e-15);
    /// ```
    pub fn rectangle(x_m: [f64; 2], y_m: [f64; 2], distance: Distance) -> Option<Self> {
        let d = distance.value();
        if !x_m.iter().chain(&y_m).all(|x| x.is_finite()) || !d.is_finite() || d <= 0.0 {
            return None;
        }
        let most = x_m.iter().chain(&y_m).fold(d, |most, x| most.max(x.abs()));
        let [x0, x1, d] = scaled([x_m[0], x_m[1], d], -exponent_of(most));
        let [y0, y1, _] = scaled([y_m[0], y_m[1], 0.0], -exponent_of(most));
        Some(Self::new(quadrants(x0, x1).iter().flat_map(|&x| quadrants(y0, y1).map(|y| quadrant(x, y, d))).sum()))
    }

    /// A spherical triangle with its corners in the directions `a`, `b`, `c` of any length, or the plane triangle with the corners `a`,
    /// `b`, `c` relative to the viewer; 0 to 2π. `None` if a corner is at the viewer or not finite.
    ///
    /// ```
    /// use etendue::quantity::SolidAngle;
    /// let octant = SolidAngle::triangle([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]).unwrap();
    /// assert!((8.0 * octant.value() / SolidAngle::SPHERE.value() - 1.0).abs() < 1e-15);
    /// ```
    pub fn triangle(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> Option<Self> {
        let mut corners = [a, b, c];
        let sizes = corners.map(largest);
        if corners.iter().flatten().any(|x| !x.is_finite()) || sizes.contains(&0.0) {
            return None;
        }
        // The same power of two for all keeps close corners close; a corner far nearer than the others is no neighbour of theirs.
        let common = exponent_of(sizes.iter().fold(0.0, |most: f64, size| most.max(*size)));
        for (corner, size) in corners.iter_mut().zip(sizes) {
            let own = exponent_of(size);
            *corner = scaled(*corner, -if common - own > 64 { own } else { common });
        }
        let [a, b, c] = corners;
        let volume = dot(a, cross(minus(b, a), minus(c, a))).abs();
        Some(Self::new(triangle_of(volume, corners)))
    }
}

/// The parts of an interval on either side of zero, as distances from it, least first; an empty part has no width.
fn quadrants(from: f64, to: f64) -> [[f64; 2]; 2] {
    let (low, high) = (from.min(to), from.max(to));
    [[low.max(0.0), high.max(0.0)], [(-high).max(0.0), (-low).max(0.0)]]
}

/// A rectangle in one quadrant: two triangles, each with the triple product d Δx Δy and nothing negative in the denominator.
fn quadrant([x0, x1]: [f64; 2], [y0, y1]: [f64; 2], d: f64) -> f64 {
    let volume = d * (x1 - x0) * (y1 - y0);
    if volume == 0.0 {
        return 0.0;
    }
    let (near, far) = ([x0, y0, d], [x1, y1, d]);
    triangle_of(volume, [near, [x1, y0, d], far]) + triangle_of(volume, [near, far, [x0, y1, d]])
}

impl ProjectedSolidAngle {
    /// Half of all directions, weighted with the cosine: π sr, not 2π.
    pub const HEMISPHERE: Self = Self::new(PI);

    /// A cone of half angle `half_angle_rad`, 0 to π/2, about the normal: `π sin²α`.
    ///
    /// ```
    /// use etendue::quantity::{ProjectedSolidAngle, table::{Illuminance, Luminance}};
    /// let sky: Illuminance = Luminance::new(1.0) * ProjectedSolidAngle::HEMISPHERE;
    /// assert_eq!(sky.value(), std::f64::consts::PI);
    /// assert_eq!(ProjectedSolidAngle::cone(std::f64::consts::FRAC_PI_2), ProjectedSolidAngle::HEMISPHERE);
    /// ```
    pub fn cone(half_angle_rad: f64) -> Self {
        let s = half_angle_rad.sin();
        Self::new(PI * s * s)
    }

    /// Small solid angles at an angle of cosine `cosine`, 0 to 1, from the normal: `Ω cos θ`.
    ///
    /// ```
    /// use etendue::quantity::{ProjectedSolidAngle, SolidAngle};
    /// assert_eq!(ProjectedSolidAngle::small(SolidAngle::new(0.02), 0.5).to_string(), "0.01 sr");
    /// ```
    pub fn small(solid_angle: SolidAngle, cosine: f64) -> Self {
        Self::new(solid_angle.value() * cosine)
    }
}

/// `E = L Ω_p`: what a uniform radiance gives on the area whose normal the solid angle is projected on.
impl<S> Mul<ProjectedSolidAngle> for Quantity<kind::Radiance, S> {
    type Output = Quantity<kind::FluxDensityIn, S>;
    fn mul(self, projected: ProjectedSolidAngle) -> Self::Output {
        Quantity::new(self.value() * projected.value())
    }
}

/// `G = A Ω_p`.
impl Mul<ProjectedSolidAngle> for Area {
    type Output = Etendue;
    fn mul(self, projected: ProjectedSolidAngle) -> Etendue {
        Etendue::new(self.value() * projected.value())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn triangle(a: Vector, b: Vector, c: Vector) -> f64 {
        SolidAngle::triangle(a, b, c).unwrap().value()
    }

    fn vector() -> impl Strategy<Value = Vector> {
        [-1.0..1.0f64, -1.0..1.0f64, -1.0..1.0f64].prop_filter("a direction", |v| dot(*v, *v) > 1e-4)
    }

    #[test]
    fn octants_fill_the_sphere() {
        let mut sum = 0.0;
        for x in [-2.0, 1.0] {
            for y in [-1e-9, 1e9] {
                for z in [-1e-200, 1e200] {
                    let octant = triangle([x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]);
                    assert!((octant / (0.5 * PI) - 1.0).abs() < 1e-15, "{octant}");
                    sum += octant;
                }
            }
        }
        assert!((sum / SolidAngle::SPHERE.value() - 1.0).abs() < 1e-15);
    }

    #[test]
    fn the_faces_of_a_tetrahedron_fill_the_sphere() {
        let corners = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
        let sum: f64 = (0..4).map(|i| triangle(corners[i], corners[(i + 1) % 4], corners[(i + 2) % 4])).sum();
        assert!((sum / SolidAngle::SPHERE.value() - 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_corner_at_the_viewer_or_at_no_place_has_no_answer() {
        let good = [0.0, 1.0, 0.0];
        assert_eq!(SolidAngle::triangle([0.0; 3], good, [1.0, 0.0, 0.0]), None);
        assert_eq!(SolidAngle::triangle(good, [f64::NAN, 0.0, 1.0], [1.0, 0.0, 0.0]), None);
        assert_eq!(SolidAngle::triangle(good, [f64::INFINITY, 0.0, 1.0], [1.0, 0.0, 0.0]), None);
        for (x, d) in [(f64::NAN, 1.0), (f64::INFINITY, 1.0), (1.0, f64::NAN), (1.0, 0.0), (1.0, -1.0)] {
            assert_eq!(SolidAngle::rectangle([0.0, x], [0.0, 1.0], Distance::new(d)), None);
        }
    }

    #[test]
    fn a_rectangle_that_nearly_is_the_half_space_keeps_its_digits() {
        // Half space less what is beyond the edges at ±1: to first order in d, ∫ d/ρ³ over the outside of a square = 4√2 d.
        for d in [1e-6, 1e-9, 1e-12] {
            let seen = SolidAngle::rectangle([-1.0, 1.0], [-1.0, 1.0], Distance::new(d)).unwrap().value();
            assert!((seen - (2.0 * PI - 4.0 * 2f64.sqrt() * d)).abs() < 3.0 * d * d + 4e-15, "{d}: {seen}");
        }
    }

    proptest! {
        #[test]
        fn a_triangle_is_the_sum_of_its_halves(a in vector(), b in vector(), c in vector(), t in 0.01..0.99f64) {
            prop_assume!(triangle(a, b, c) < 6.0);
            let between = [0, 1, 2].map(|i| (1.0 - t) * a[i] + t * b[i]);
            prop_assume!(dot(between, between) > 1e-6);
            let (whole, parts) = (triangle(a, b, c), triangle(a, between, c) + triangle(between, b, c));
            prop_assert!((whole - parts).abs() < 1e-12, "{} {}", whole, parts);
        }

        #[test]
        fn a_rectangle_is_the_sum_of_its_parts(x in [-3.0..3.0f64, -3.0..3.0f64], y in [-3.0..3.0f64, -3.0..3.0f64], t in 0.0..1.0f64, ln_d in -20.0..5.0f64) {
            let d = Distance::new(ln_d.exp());
            let cut = (1.0 - t) * x[0] + t * x[1];
            let part = |x: [f64; 2]| SolidAngle::rectangle(x, y, d).unwrap().value();
            let whole = part(x);
            // The cut is rounded; of a sliver, the rounded width is all that there is.
            prop_assert!((part([x[0], cut]) + part([cut, x[1]]) - whole).abs() <= 1e-13 * whole.max(1e-300));
        }

        #[test]
        fn a_rectangle_is_two_triangles(x in [-3.0..3.0f64, -3.0..3.0f64], y in [-3.0..3.0f64, -3.0..3.0f64], d in 0.1..5.0f64) {
            let corner = |i: usize, j: usize| [x[i], y[j], d];
            let triangles = triangle(corner(0, 0), corner(1, 0), corner(1, 1)) + triangle(corner(0, 0), corner(1, 1), corner(0, 1));
            let rectangle = SolidAngle::rectangle(x, y, Distance::new(d)).unwrap().value();
            prop_assert!((rectangle - triangles).abs() < 1e-13);
        }

        #[test]
        fn a_rectangle_with_a_corner_on_the_perpendicular_has_its_own_formula(a in 1e-6..1e6f64, b in 1e-6..1e6f64, d in 1e-6..1e6f64) {
            let found = SolidAngle::rectangle([0.0, a], [b, 0.0], Distance::new(d)).unwrap().value();
            let expected = (a / d * (b / (a * a + b * b + d * d).sqrt())).atan();
            prop_assert!((found / expected - 1.0).abs() < 1e-14, "{} {}", found, expected);
        }

        #[test]
        fn small_things_have_their_area_over_the_square_of_the_distance(ln_size in -300.0..-16.0f64, at in vector(), turn in vector(), ln_scale in -300.0..300.0f64) {
            // Two edges at right angles to the direction, exact because the corners are differences from a corner with few digits.
            let size = ln_size.exp().max(1e-7);
            let at = at.map(|x| (x * 64.0).round() / 64.0 + 0.015625);
            let u = cross(at, turn);
            let u = u.map(|x| x / dot(u, u).sqrt());
            let v = cross(at, u);
            let v = v.map(|x| x / dot(v, v).sqrt());
            let corner = |e: Vector| [0, 1, 2].map(|i| at[i] + size * e[i]);
            let (b, c) = (corner(u), corner(v));
            // What the rounded corners really span.
            let n = cross(minus(b, at), minus(c, at));
            let scale = ln_scale.exp();
            let found = triangle(at.map(|x| x * scale), b.map(|x| x * scale), c.map(|x| x * scale));
            let r2 = dot(at, at);
            let expected = 0.5 * dot(n, at).abs() / (r2 * r2.sqrt());
            // The scale rounds every coordinate by half a unit in its last place.
            let rounding = 1e-15 * r2.sqrt() / size;
            prop_assert!((found / expected - 1.0).abs() < 4.0 * size / r2.sqrt() + rounding, "{:e} {:e}", found, expected);
            let exact = triangle(at, b, c);
            prop_assert!((exact / expected - 1.0).abs() < 4.0 * size / r2.sqrt() + 1e-14, "{:e} {:e}", exact, expected);
        }

        #[test]
        fn small_rectangles_and_discs_are_patches(ln_distance in -300.0..300.0f64, angle in 1e-9..1e-7f64) {
            let distance = ln_distance.exp();
            let side = angle * distance;
            let d = Distance::new(distance);
            let square = SolidAngle::rectangle([0.0, side], [0.0, side], d).unwrap().value();
            prop_assert!((square / (angle * angle) - 1.0).abs() < 1e-12);
            prop_assert!((SolidAngle::disc(Distance::new(side), d).value() / (PI * angle * angle) - 1.0).abs() < 1e-12);
            prop_assert!((SolidAngle::polar_rectangle(1.0, 1.0 + angle, angle).value() / (1f64.sin() * angle * angle) - 1.0).abs() < 1e-6);
        }

        #[test]
        fn zones_fill_the_sphere(cut in 0.0..PI, azimuth in 0.0..6.28f64) {
            let zones = SolidAngle::polar_rectangle(0.0, cut, azimuth).value() + SolidAngle::polar_rectangle(cut, PI, azimuth).value();
            prop_assert!((zones - 2.0 * azimuth).abs() < 1e-14);
            let cap = SolidAngle::polar_rectangle(0.0, cut, 2.0 * PI).value();
            prop_assert!((cap - SolidAngle::cone(cut).value()).abs() < 1e-14);
        }

        #[test]
        fn a_projected_solid_angle_is_an_etendue_per_area(half_angle in 1e-9..1.57f64, a in 1e-9..1e9f64) {
            let area = Area::new(a);
            let by_area = area * ProjectedSolidAngle::cone(half_angle);
            prop_assert!((by_area.value() / Etendue::cone(area, half_angle).value() - 1.0).abs() < 1e-15);
            let small = ProjectedSolidAngle::small(SolidAngle::cone(half_angle), 1.0).value();
            prop_assert!(ProjectedSolidAngle::cone(half_angle).value() <= small * (1.0 + 1e-15));
        }
    }
}
