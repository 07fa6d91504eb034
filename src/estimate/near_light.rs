//! Directions towards a flat light that is near: the sample's weight stays bounded, however near it is.
//!
//! ```text
//! E = ∫ cosθ_r dω,   dω = h/r³ da db = dφ ds      φ = atan(a/h),   s = b/r,   r² = D² + b²,   D² = h² + a²
//! φ uniform over the light's range Δφ, then s uniform over its range Δs(φ):   weight = Δφ Δs cosθ_r ≤ 2π
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | h | height of the receiving point above the light's plane | m |
//! | a, b | place on the light along its two axes, from the foot of that height | m |
//! | Δφ | angle under which the light's extent along a is seen | rad |
//! | Δs | extent along b as a difference of sines | 1 |
//!
//! A place chosen with density 1/A has the weight A cosθ_r cosθ_s / r², which grows without bound towards an edge that receiver and light have
//! in common: its square has no integral, and the spread of a few replicates says nothing. Δφ Δs is the solid angle itself for a
//! strip, and within a small factor of it for every rectangle; a is the axis along which the light is farther away. Other figures are
//! sampled by the rectangle around them, and what misses the figure brings nothing.

use crate::math::DVec3;

/// A light counts as near within this many half diagonals of the rectangle around it.
const NEAR: f64 = 2.0;

/// The rectangle around a flat light.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    centre: DVec3,
    /// Unit vectors along its sides.
    axes: [DVec3; 2],
    /// Half of the sides, m.
    half: [f64; 2],
    /// Unit normal of the side that emits.
    normal: DVec3,
    /// Square of the distance within which it is near, m².
    near_m2: f64,
}

/// A place on a near light.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// From the receiving point, m.
    pub(super) to: DVec3,
    /// `weight · (n·to)` is the irradiance per unit of radiance.
    pub(super) weight: f64,
    /// From the centre of the frame, along its axes, m.
    pub(super) on: [f64; 2],
}

impl Frame {
    /// A rectangle by its centre and half sides `u`, `v`, which are perpendicular.
    pub(super) fn rectangle(centre: DVec3, u: DVec3, v: DVec3, normal: DVec3) -> Frame {
        let half = [u.length(), v.length()];
        Frame { centre, axes: [u / half[0], v / half[1]], half, normal, near_m2: NEAR * NEAR * (half[0] * half[0] + half[1] * half[1]) }
    }

    /// The square around a disc, whichever way it is turned.
    pub(super) fn disc(centre: DVec3, radius_m: f64, normal: DVec3) -> Frame {
        let (x, y) = crate::math::frame::tangents(normal);
        Frame::rectangle(centre, x * radius_m, y * radius_m, normal)
    }

    /// The rectangle around a polygon, along its longest side, and the corners from its centre along its axes.
    pub(super) fn around(corners: &[DVec3], normal: DVec3) -> (Frame, Outline) {
        let sides = (0..corners.len()).map(|i| corners[(i + 1) % corners.len()] - corners[i]);
        let longest =
            sides.fold(DVec3::ZERO, |longest, side| if side.length_squared() > longest.length_squared() { side } else { longest });
        let x = longest.normalize_or_zero();
        let y = normal.cross(x);
        let flat: Vec<[f64; 2]> = corners.iter().map(|&c| [x.dot(c - corners[0]), y.dot(c - corners[0])]).collect();
        let range = |axis: usize| flat.iter().fold((0.0_f64, 0.0_f64), |(low, high), p| (low.min(p[axis]), high.max(p[axis])));
        let ((left, right), (low, high)) = (range(0), range(1));
        let (a, b) = (0.5 * (left + right), 0.5 * (low + high));
        let frame = Frame::rectangle(corners[0] + x * a + y * b, x * (0.5 * (right - left)), y * (0.5 * (high - low)), normal);
        (frame, Outline(flat.into_iter().map(|p| [p[0] - a, p[1] - b]).collect()))
    }

    /// The same rectangle turned so that its first axis points away from `x`: for a square around a disc.
    #[inline(always)]
    fn turned(&self, x: DVec3) -> Frame {
        let to = self.centre - x;
        let along = to - self.normal * self.normal.dot(to);
        let Some(first) = along.try_normalize() else { return *self };
        Frame { axes: [first, self.normal.cross(first)], ..*self }
    }

    /// A place on the rectangle for a receiving point in front of it that is near; `None` if it is not.
    #[inline(always)]
    pub(super) fn sample(&self, x: DVec3, u: [f64; 2]) -> Option<Place> {
        let away = self.centre - x;
        let height = -self.normal.dot(away);
        let foot = self.axes.map(|axis| axis.dot(away));
        let outside = [0, 1].map(|i| (foot[i].abs() - self.half[i]).max(0.0));
        if height <= 0.0 || height * height + outside[0] * outside[0] + outside[1] * outside[1] > self.near_m2 {
            return None;
        }
        let (first, second) = if outside[1] > outside[0] { (1, 0) } else { (0, 1) };
        let ends = |i: usize| [foot[i] - self.half[i], foot[i] + self.half[i]];
        let (a, range_rad) = between_angles(height, ends(first), u[0]);
        let (b, range) = between_sines(height.hypot(a), ends(second), u[1]);
        let to = self.axes[first] * a + self.axes[second] * b - self.normal * height;
        let mut on = [0.0; 2];
        (on[first], on[second]) = (a - foot[first], b - foot[second]);
        Some(Place { to, weight: range_rad * range / to.length(), on })
    }

    /// A place on the disc that fills the square.
    #[inline(always)]
    pub(super) fn sample_disc(&self, x: DVec3, u: [f64; 2]) -> Option<Place> {
        let mut place = self.turned(x).sample(x, u)?;
        let [a, b] = place.on;
        if a * a + b * b > self.half[0] * self.half[0] {
            place.weight = 0.0;
        }
        Some(place)
    }

    /// A place on the polygon that the rectangle is around.
    #[inline(always)]
    pub(super) fn sample_polygon(&self, outline: &Outline, x: DVec3, u: [f64; 2]) -> Option<Place> {
        let mut place = self.sample(x, u)?;
        if !outline.holds(place.on) {
            place.weight = 0.0;
        }
        Some(place)
    }
}

/// A place on a triangle, its weight per m² of area: the triangle was chosen in proportion to that.
#[inline(always)]
pub(super) fn on_triangle(corners: &[DVec3; 3], normal: DVec3, x: DVec3, u: [f64; 2]) -> Option<Place> {
    let [p, q, r] = *corners;
    // The first axis along the longest side, the apex opposite to it.
    let lengths = [q - p, r - q, p - r].map(|side| side.length_squared());
    let (from, to, apex) = if lengths[0] >= lengths[1] && lengths[0] >= lengths[2] {
        (p, q, r)
    } else if lengths[1] >= lengths[2] {
        (q, r, p)
    } else {
        (r, p, q)
    };
    let (side, up) = (to - from, apex - from);
    let length = side.length();
    let along = side / length;
    let foot = along.dot(up);
    let across = up - along * foot;
    let height = across.length();
    let frame = Frame::rectangle(from + 0.5 * (side + across), 0.5 * side, 0.5 * across, normal);
    let mut place = frame.sample(x, u)?;
    let (a, b) = (place.on[0] + 0.5 * length, (place.on[1] + 0.5 * height) / height);
    let inside = a >= foot * b && a <= length + (foot - length) * b;
    place.weight = if inside { place.weight / (0.5 * length * height) } else { 0.0 };
    Some(place)
}

/// A place between `low` and `high` with its angle φ = atan(a/h) uniform, and the range of φ.
#[inline(always)]
fn between_angles(height: f64, [low, high]: [f64; 2], u: f64) -> (f64, f64) {
    // Differences of angles by the tangent of the difference: what is seen under a small angle keeps its digits.
    let range_rad = (height * (high - low)).atan2(height * height + low * high);
    let tangent = (u * range_rad).tan();
    let a = height * (low + height * tangent) / (height - low * tangent);
    (a.clamp(low, high), range_rad)
}

/// A place between `low` and `high` with its sine s = b/√(D² + b²) uniform, and the range of s.
#[inline(always)]
fn between_sines(distance: f64, [low, high]: [f64; 2], u: f64) -> (f64, f64) {
    let (to_low, to_high) = (distance.hypot(low), distance.hypot(high));
    let (first, last) = (low / to_low, high / to_high);
    let range = if low * high > 0.0 {
        // s₁ − s₀ = (s₁² − s₀²)/(s₁ + s₀)
        (distance / to_low) * (distance / to_high) * ((high - low) / to_low) * ((high + low) / to_high) / (first + last)
    } else {
        last - first
    };
    let s = first + u * range;
    let b = distance * s / ((1.0 - s) * (1.0 + s)).max(0.0).sqrt();
    (if b.is_finite() { b.clamp(low, high) } else { high.copysign(s) }, range)
}

/// Corners of a flat figure, m.
#[derive(Clone, Debug)]
pub(super) struct Outline(Vec<[f64; 2]>);

impl Outline {
    /// Whether a point is within it (even–odd rule).
    #[inline(always)]
    fn holds(&self, [x, y]: [f64; 2]) -> bool {
        let corners = &self.0;
        let mut inside = false;
        let mut before = corners[corners.len() - 1];
        for &corner in corners {
            let ([ax, ay], [bx, by]) = (before, corner);
            let side = (bx - ax) * (y - ay) - (by - ay) * (x - ax);
            inside ^= (ay > y) != (by > y) && (side > 0.0) == (by > ay);
            before = corner;
        }
        inside
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimate::closed_form::{disc::disc, polygon::polygon};
    use crate::math::random::Stream;
    use proptest::prelude::*;

    const POINTS: u32 = 1 << 14;

    /// Mean irradiance and the largest one of a sample.
    fn mean(normal: DVec3, sample: impl Fn([f64; 2]) -> Option<Place>) -> (f64, f64) {
        let (mut sum, mut largest) = (0.0, 0.0_f64);
        for i in 0..POINTS {
            let [a, b, ..] = Stream::new(5, &[]).four(i, 0);
            let place = sample([a, b]).unwrap();
            let e = place.weight * normal.dot(place.to).max(0.0);
            sum += e;
            largest = largest.max(e);
        }
        (sum / f64::from(POINTS), largest)
    }

    /// Corners of a triangle beside the origin whose first side runs along x.
    fn triangle(aspect: f64, skew: f64) -> [DVec3; 3] {
        [DVec3::ZERO, DVec3::X, DVec3::new(skew, 1.0 / aspect, 0.0)]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]

        #[test]
        fn a_rectangle_brings_its_closed_form_from_any_distance(
            power in -9.0..0.0_f64, aspect in 0.0..4.0_f64, along in -0.7..0.7_f64, edge in prop::sample::select(vec![-1.0, -0.3, 0.9]),
            tilt in -1.5..1.5_f64,
        ) {
            let (half, gap) = (0.5 / 10f64.powf(aspect), 10f64.powf(power));
            let (u, v) = (0.5 * DVec3::X, half * DVec3::Y);
            let x = DVec3::new(along, edge * half - gap * f64::from(edge == -1.0), gap);
            let normal = DVec3::new(0.0, tilt.cos(), -tilt.sin());
            let frame = Frame::rectangle(DVec3::ZERO, u, v, DVec3::Z);
            let closed = polygon(&[-u - v - x, u - v - x, u + v - x, v - u - x], normal);
            prop_assume!(closed > 0.0);
            let (found, largest) = mean(normal, |u| frame.sample(x, u));
            prop_assert!((found - closed).abs() < 3e-3 * closed.max(0.01), "{found} {closed}");
            prop_assert!(largest <= std::f64::consts::TAU);
        }

        #[test]
        fn a_triangle_brings_its_closed_form(power in -6.0..-1.0_f64, aspect in 0.0..3.0_f64, skew in -0.5..1.5_f64, tilt in 0.0..1.5_f64) {
            let gap = 10f64.powf(power);
            let corners = triangle(10f64.powf(aspect), skew);
            let x = DVec3::new(0.4, -gap, gap);
            let normal = DVec3::new(0.0, tilt.cos(), -tilt.sin());
            let (frame, outline) = Frame::around(&corners, DVec3::Z);
            let closed = polygon(&corners.map(|c| c - x), normal);
            let (found, _) = mean(normal, |u| frame.sample_polygon(&outline, x, u));
            prop_assert!((found - closed).abs() < 1e-2 * closed.max(0.03), "{found} {closed}");
            let area = 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]).length();
            let (found, _) = mean(normal, |u| on_triangle(&corners, DVec3::Z, x, u));
            prop_assert!((found * area - closed).abs() < 1e-2 * closed.max(0.03), "{found} {closed}");
        }

        #[test]
        fn a_disc_brings_its_closed_form_at_its_rim(power in -6.0..0.0_f64, turn in 0.0..6.0_f64, tilt in 0.0..1.5_f64) {
            let gap = 10f64.powf(power);
            let out = DVec3::new(turn.cos(), turn.sin(), 0.0);
            let x = out * (1.0 + gap) + gap * DVec3::Z;
            let normal = -out * tilt.cos() - DVec3::Z * tilt.sin();
            let frame = Frame::disc(DVec3::ZERO, 1.0, DVec3::Z);
            let closed = disc(-x, DVec3::Z, 1.0, normal);
            let (found, _) = mean(normal, |u| frame.sample_disc(x, u));
            prop_assert!((found - closed).abs() < 1e-2 * closed.max(0.03), "{found} {closed}");
        }
    }

    #[test]
    fn what_is_far_or_behind_is_left_to_the_area() {
        let frame = Frame::rectangle(DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z);
        assert!(frame.sample(DVec3::new(0.0, 0.0, 3.0), [0.5; 2]).is_none());
        assert!(frame.sample(DVec3::new(0.0, 0.0, -0.1), [0.5; 2]).is_none());
        assert!(frame.sample(DVec3::new(0.0, 0.0, 2.5), [0.5; 2]).is_some());
    }
}
