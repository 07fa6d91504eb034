//! The shapes a scene is made of, placed in the world.
//!
//! | shape | surface | its front |
//! |---|---|---|
//! | `Rectangle` | centre ± `half_u` ± `half_v` | the side of `half_u × half_v` |
//! | `Polygon` | the plane figure within its corners | the side from which the corners run counter-clockwise |
//! | `Disc` | the points within `radius_m` of the centre and not within `hole_radius_m`, in the plane of `normal` | the side of `normal` |
//! | `Sphere` | the points at `radius_m` from the centre | the outside |
//! | `Mesh` | triangles | the side from which the vertices run counter-clockwise |
//!
//! A box is six rectangles; whoever builds one decides which way they face.

use std::sync::Arc;

use super::mesh::Mesh;
use super::polygon::Polygon;
use super::rays::COINCIDENT;
use crate::math::DVec3;
use crate::math::frame::tangents;

/// A plane rectangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    /// Centre, m.
    pub centre: DVec3,
    /// From the centre to the middle of one side, m.
    pub half_u: DVec3,
    /// From the centre to the middle of a neighbouring side, m; perpendicular to `half_u`.
    pub half_v: DVec3,
}

impl Rectangle {
    /// Unit normal of the front.
    #[must_use]
    pub fn normal(&self) -> DVec3 {
        self.half_u.normalize().cross(self.half_v.normalize()).normalize()
    }

    /// Area in m².
    #[must_use]
    pub fn area_m2(&self) -> f64 {
        4.0 * self.half_u.length() * self.half_v.length()
    }

    /// The corners, counter-clockwise as seen from the front, m.
    #[must_use]
    pub fn corners(&self) -> [DVec3; 4] {
        let (c, u, v) = (self.centre, self.half_u, self.half_v);
        [c - u - v, c + u - v, c + u + v, c - u + v]
    }
}

/// A plane disc, or a ring: a plate with a round hole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    /// Centre, m.
    pub centre: DVec3,
    /// Unit normal of the front.
    pub normal: DVec3,
    /// Radius, m.
    pub radius_m: f64,
    /// Radius of the hole about the centre, m; zero for a disc.
    pub hole_radius_m: f64,
}

impl Disc {
    /// Area in m².
    #[must_use]
    pub fn area_m2(&self) -> f64 {
        std::f64::consts::PI * (self.radius_m - self.hole_radius_m) * (self.radius_m + self.hole_radius_m)
    }

    /// The point of the disc or ring that is nearest to `point`, m.
    #[must_use]
    pub fn nearest_point(&self, point: DVec3) -> DVec3 {
        let offset = point - self.centre;
        let flat = offset - self.normal * offset.dot(self.normal);
        if flat.length() >= self.hole_radius_m {
            return self.centre + flat.clamp_length_max(self.radius_m);
        }
        // On the axis every point of the rim is as near.
        self.centre + self.hole_radius_m * flat.try_normalize().unwrap_or_else(|| tangents(self.normal).0)
    }
}

/// A sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Centre, m.
    pub centre: DVec3,
    /// Radius, m.
    pub radius_m: f64,
}

impl Sphere {
    /// Whether a point is within the sphere, or on it to the rounding of coordinates: a point that was found on the surface is on either
    /// side of it by a few roundings.
    #[must_use]
    pub fn holds(&self, point: DVec3) -> bool {
        let rounding = 4.0 * f64::EPSILON * (self.centre.abs().max_element() + point.abs().max_element());
        (point - self.centre).length() <= self.radius_m * (1.0 + COINCIDENT) + rounding
    }
}

/// A shape in the world.
#[derive(Clone, Debug)]
pub enum Shape {
    /// A plane rectangle.
    Rectangle(Rectangle),
    /// A plane polygon.
    Polygon(Polygon),
    /// A plane disc.
    Disc(Disc),
    /// A sphere.
    Sphere(Sphere),
    /// A triangle mesh, shared because it may be large.
    Mesh(Arc<Mesh>),
}

/// One of the two sides of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Side {
    /// The side that the normal points to.
    Front,
    /// The other side.
    Back,
}

impl Side {
    /// +1 for the front, −1 for the back.
    #[must_use]
    pub fn sign(self) -> f64 {
        match self {
            Side::Front => 1.0,
            Side::Back => -1.0,
        }
    }
}

impl Shape {
    /// Area of one side, m².
    #[must_use]
    pub fn area_m2(&self) -> f64 {
        use std::f64::consts::PI;
        match self {
            Shape::Rectangle(r) => r.area_m2(),
            Shape::Polygon(p) => p.area_m2(),
            Shape::Disc(d) => d.area_m2(),
            Shape::Sphere(s) => 4.0 * PI * s.radius_m * s.radius_m,
            Shape::Mesh(m) => m.area_m2(),
        }
    }

    /// A point of a plane shape and the unit normal of its front; `None` if it is curved or a mesh.
    #[must_use]
    pub fn plane(&self) -> Option<(DVec3, DVec3)> {
        match self {
            Shape::Rectangle(r) => Some((r.centre, r.normal())),
            Shape::Polygon(p) => Some((p.corners()[0], p.normal())),
            Shape::Disc(d) => Some((d.centre, d.normal)),
            Shape::Sphere(_) | Shape::Mesh(_) => None,
        }
    }

    /// Corners of a rectangle or polygon, counter-clockwise as seen from the front, m.
    #[must_use]
    pub fn corners(&self) -> Option<Vec<DVec3>> {
        match self {
            Shape::Rectangle(r) => Some(r.corners().to_vec()),
            Shape::Polygon(p) => Some(p.corners().to_vec()),
            Shape::Disc(_) | Shape::Sphere(_) | Shape::Mesh(_) => None,
        }
    }

    /// Centre and radius of a sphere that holds the shape, m.
    #[must_use]
    pub fn bounding_sphere(&self) -> (DVec3, f64) {
        match self {
            Shape::Rectangle(r) => (r.centre, r.half_u.length().hypot(r.half_v.length())),
            Shape::Polygon(p) => p.bounding_sphere(),
            Shape::Disc(d) => (d.centre, d.radius_m),
            Shape::Sphere(s) => (s.centre, s.radius_m),
            Shape::Mesh(m) => {
                let (low, high) = m.bounds();
                let centre = low + 0.5 * (high - low);
                (centre, (high - centre).length())
            }
        }
    }

    /// Distance from a point to the surface, m. Meshes answer with infinity: their nearest point takes a search.
    #[must_use]
    pub fn distance_m(&self, point: DVec3) -> f64 {
        match self {
            Shape::Rectangle(r) => {
                let to = point - r.centre;
                let beyond = |half: DVec3| (to.dot(half.normalize()).abs() - half.length()).max(0.0);
                DVec3::new(beyond(r.half_u), beyond(r.half_v), to.dot(r.normal())).length()
            }
            Shape::Polygon(p) => (point - p.nearest_point(point)).length(),
            Shape::Disc(d) => {
                let to = point - d.centre;
                let height = to.dot(d.normal);
                let aside = (to - height * d.normal).length();
                (aside - d.radius_m).max(d.hole_radius_m - aside).max(0.0).hypot(height)
            }
            Shape::Sphere(s) => ((point - s.centre).length() - s.radius_m).abs(),
            Shape::Mesh(_) => f64::INFINITY,
        }
    }

    /// Lowest and highest value of `axis · x` over the shape, m; `axis` need not be of unit length.
    ///
    /// Meshes answer with the box that holds them.
    #[must_use]
    pub fn extent_along(&self, origin: DVec3, axis: DVec3) -> (f64, f64) {
        let around = |centre: DVec3, half: f64| {
            let middle = axis.dot(centre - origin);
            (middle - half, middle + half)
        };
        match self {
            Shape::Rectangle(r) => around(r.centre, axis.dot(r.half_u).abs() + axis.dot(r.half_v).abs()),
            Shape::Polygon(p) => p
                .corners()
                .iter()
                .map(|&corner| axis.dot(corner - origin))
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at))),
            Shape::Disc(d) => around(d.centre, axis.cross(d.normal).length() * d.radius_m),
            Shape::Sphere(s) => around(s.centre, axis.length() * s.radius_m),
            Shape::Mesh(m) => {
                let (low, high) = m.bounds();
                around(low + 0.5 * (high - low), axis.abs().dot(0.5 * (high - low)))
            }
        }
    }
}
