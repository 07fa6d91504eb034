//! Plane polygons: simple (no two edges meet but at their common corner), convex or not, with corners in double precision.
//!
//! ```text
//! n A = ½ Σ (pᵢ − p₀) × (pᵢ₊₁ − p₀)      n: the front, from which the corners run counter-clockwise
//! ```
//!
//! A mesh rounds its vertices to single precision relative to its size; a polygon keeps them as they were written.
//! Its triangles (`triangulate.rs`) serve sampling: a triangle is chosen by its area, a point in it uniformly.

mod triangulate;

use std::sync::Arc;

use crate::math::DVec3;
use crate::math::frame::tangents;
use crate::math::sample::sample_triangle;

/// Most corners of a polygon.
pub const MOST_CORNERS: usize = 1000;

/// How far a corner may be from the plane of the others, as a share of the polygon's size.
const PLANE: f64 = 1e-9;

/// Roundings of a coordinate that are forgiven.
const ROUNDINGS: f64 = 8.0;

/// A plane polygon.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    corners: Arc<[DVec3]>,
    normal: DVec3,
    area_m2: f64,
    triangles: Arc<[[u16; 3]]>,
    /// Areas of triangles 0..=i over the whole area.
    cumulative: Arc<[f64]>,
}

/// Why corners make no polygon.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PolygonError {
    /// Fewer than three corners, or too many.
    #[error("a polygon has 3 to {MOST_CORNERS} corners, not {0}")]
    CornerCount(usize),
    /// A coordinate is not a finite number, or squares of the extent would not be.
    #[error("corner {0} is not at a finite place between 1e-140 m and 1e140 m")]
    NotFinite(usize),
    /// The corners lie on one line, or in one point.
    #[error("the corners lie on one line, so the polygon has no area")]
    NoArea,
    /// The corners are not in one plane.
    #[error("corner {corner} is {distance_m:.3e} m off the plane of the others")]
    NotPlane {
        /// Which, from 0.
        corner: usize,
        /// How far, m.
        distance_m: f64,
    },
    /// Two edges meet.
    #[error("the edges after corner {0} and after corner {1} meet, so inside and outside are not defined")]
    EdgesMeet(usize, usize),
}

impl Polygon {
    /// The polygon with these corners (m, in order; counter-clockwise as seen from the front).
    ///
    /// # Errors
    /// [`PolygonError`]: what is wrong with the corners.
    pub fn new(corners: &[DVec3]) -> Result<Polygon, PolygonError> {
        let n = corners.len();
        if !(3..=MOST_CORNERS).contains(&n) {
            return Err(PolygonError::CornerCount(n));
        }
        if let Some(corner) = corners.iter().position(|c| !c.is_finite() || c.abs().max_element() > 1e140) {
            return Err(PolygonError::NotFinite(corner));
        }
        let first = corners[0];
        let size = corners.iter().map(|&c| (c - first).abs().max_element()).fold(0.0, f64::max);
        if size < 1e-140 {
            return Err(PolygonError::NoArea);
        }
        let local: Vec<DVec3> = corners.iter().map(|&c| (c - first) / size).collect();
        let vector_area: DVec3 = local.windows(2).map(|pair| 0.5 * pair[0].cross(pair[1])).sum();
        let farthest = corners.iter().map(|c| c.abs().max_element()).fold(0.0, f64::max);
        // What the rounding of the coordinates alone may make of corners on one line.
        let rounding = ROUNDINGS * f64::EPSILON * (1.0 + farthest / size);
        let share = vector_area.length();
        if share.is_nan() || share <= rounding.min(1e-3 * f64::EPSILON.sqrt()) {
            // A figure of eight has no area in sum.
            let crosses = local.windows(2).map(|pair| pair[0].cross(pair[1]));
            let widest = crosses.max_by(|a, b| a.length().total_cmp(&b.length())).unwrap_or_default();
            let outline = |normal: DVec3| flattened(&local, normal);
            let meeting = if widest.length() > 4.0 * share { triangulate::edges_that_meet(&outline(widest.normalize())) } else { None };
            return Err(meeting.map_or(PolygonError::NoArea, |(i, j)| PolygonError::EdgesMeet(i, j)));
        }
        let normal = vector_area / share;
        let off = |v: DVec3| normal.dot(v).abs();
        if let Some(corner) = local.iter().position(|&v| off(v) > PLANE + rounding / share.min(1.0)) {
            return Err(PolygonError::NotPlane { corner, distance_m: off(local[corner]) * size });
        }
        let flat = flattened(&local, normal);
        if let Some((i, j)) = triangulate::edges_that_meet(&flat) {
            return Err(PolygonError::EdgesMeet(i, j));
        }
        let triangles = triangulate::triangles(&flat);
        let mut sum = 0.0;
        let mut cumulative: Vec<f64> = triangles
            .iter()
            .map(|t| {
                let [a, b, c] = t.map(|i| local[i as usize]);
                sum += (b - a).cross(c - a).length();
                sum
            })
            .collect();
        cumulative.iter_mut().for_each(|c| *c /= sum);
        Ok(Polygon {
            corners: corners.into(),
            normal,
            area_m2: share * size * size,
            triangles: triangles.into(),
            cumulative: cumulative.into(),
        })
    }

    /// The corners in order, counter-clockwise as seen from the front, m.
    #[must_use]
    pub fn corners(&self) -> &[DVec3] {
        &self.corners
    }

    /// Unit normal of the front.
    #[must_use]
    pub fn normal(&self) -> DVec3 {
        self.normal
    }

    /// Area of one side, m².
    #[must_use]
    pub fn area_m2(&self) -> f64 {
        self.area_m2
    }

    /// Triangles that make up the polygon, m; counter-clockwise as the polygon.
    pub fn triangles(&self) -> impl Iterator<Item = [DVec3; 3]> + '_ {
        self.triangles.iter().map(|t| t.map(|i| self.corners[i as usize]))
    }

    /// A point of the polygon, relative to its first corner, with density 1/A over the area. The first number chooses the triangle; its
    /// place within the stretch that chooses this triangle is uniform again.
    #[inline]
    #[must_use]
    pub fn sample_by_area(&self, u: [f64; 2]) -> DVec3 {
        let last = self.triangles.len() - 1;
        let chosen = self.cumulative.partition_point(|&c| c <= u[0]).min(last);
        let before = if chosen == 0 { 0.0 } else { self.cumulative[chosen - 1] };
        let stretch = self.cumulative[chosen] - before;
        let rest = if stretch > 0.0 { ((u[0] - before) / stretch).clamp(0.0, 1.0) } else { 0.5 };
        let b = sample_triangle([rest, u[1]]);
        let first = self.corners[0];
        let [p, q, r] = self.triangles[chosen].map(|i| self.corners[i as usize] - first);
        p * b[0] + q * b[1] + r * b[2]
    }

    /// The density of [`Polygon::sample_by_area`], 1/m²: the same everywhere on the polygon.
    #[must_use]
    pub fn pdf_by_area(&self) -> f64 {
        1.0 / self.area_m2
    }

    /// Centre of the smallest box along the axes that holds the polygon, and the largest distance of a corner from it, m.
    #[must_use]
    pub fn bounding_sphere(&self) -> (DVec3, f64) {
        let low = self.corners.iter().fold(DVec3::INFINITY, |low, c| low.min(*c));
        let high = self.corners.iter().fold(DVec3::NEG_INFINITY, |high, c| high.max(*c));
        let centre = low + 0.5 * (high - low);
        (centre, self.corners.iter().map(|c| (*c - centre).length()).fold(0.0, f64::max))
    }

    /// The point of the polygon that is closest to a point, m.
    #[must_use]
    pub fn nearest_point(&self, point: DVec3) -> DVec3 {
        let to = point - self.corners[0];
        let foot = to - self.normal * self.normal.dot(to);
        let (x, y) = tangents(self.normal);
        let flat = |v: DVec3| [x.dot(v), y.dot(v)];
        let outline: Vec<[f64; 2]> = self.corners.iter().map(|&c| flat(c - self.corners[0])).collect();
        if is_inside(&outline, flat(foot)) {
            return self.corners[0] + foot;
        }
        let on_edge = |i: usize| {
            let (a, b) = (self.corners[i], self.corners[(i + 1) % self.corners.len()]);
            let edge = b - a;
            a + edge * ((point - a).dot(edge) / edge.length_squared()).clamp(0.0, 1.0)
        };
        let distance = |p: &DVec3| (*p - point).length_squared();
        (0..self.corners.len()).map(on_edge).min_by(|p, q| distance(p).total_cmp(&distance(q))).unwrap_or(self.corners[0])
    }
}

/// Coordinates in the plane of a normal.
fn flattened(points: &[DVec3], normal: DVec3) -> Vec<[f64; 2]> {
    let (x, y) = tangents(normal);
    points.iter().map(|p| [x.dot(*p), y.dot(*p)]).collect()
}

/// Whether a point of the plane is inside an outline: an odd number of edges passes above it.
#[inline(always)]
pub(super) fn is_inside(outline: &[[f64; 2]], [px, py]: [f64; 2]) -> bool {
    let mut inside = false;
    let mut a = outline[outline.len() - 1];
    for &b in outline {
        let left = (b[0] - a[0]) * (py - a[1]) - (b[1] - a[1]) * (px - a[0]) > 0.0;
        inside ^= ((a[1] > py) != (b[1] > py)) && (left == (b[1] > a[1]));
        a = b;
    }
    inside
}

#[cfg(test)]
mod tests;
