//! Who can see whom: bounds from extents and bounding spheres, on the safe side, without a ray.
//!
//! An aperture of radius a at p with normal n, a source S, an occluder O; c and R are centre and radius of a bounding sphere.
//!
//! ```text
//! height over the horizon    h = max over x in S of n · (x − p)                          below it if h ≤ 0
//! smallest angle off axis    θ = ∠(n, c − p) − asin((R + a)/|c − p|)                     outside if θ > the limit of the acceptance
//! side that emits, plane     m · (p − q) + a > 0     for a plane through q whose lit side m points to; sphere: |p − c| − R + a > 0
//! ```
//!
//! Nothing stands between S and the apertures, which lie in a ball (c₀, R₀) about all poses, if for each O one of these holds:
//!
//! ```text
//! itself      O is the piece of S that shines: plane or a sphere, a convex closed mesh, or a mesh on one side of each of its triangles
//! unseen      O is below the horizon (heads that see all round have none), or outside the acceptance, of every pose
//! behind      O lies wholly in m · (x − q) ≤ 0, behind the plane of a flat source
//! same side   with the distance d from the plane of O, or d = |x − c| − R from a sphere: d ≤ 0 or d ≥ 0 for apertures and S alike
//!             (for a sphere d ≤ 0 only: a ball is convex, what is outside of it is not)
//! beside      |c − x(t)| > (1 − t) R₀ + t R_S + R for all t in 0 … 1, x(t) = (1 − t) c₀ + t c_S: O misses the hull of the two balls
//!             (the difference is convex in t, so its minimum is found by ternary search)
//! aside       for parallel light along s, with w = c − c₀: |w − (w · s) s| > R₀ + R, or w · s > R₀ + R, O being downstream
//! ```

use std::f64::consts::PI;

use crate::geometry::mesh::Mesh;
use crate::geometry::shape::{Shape, Side};
use crate::math::DVec3;
use crate::scene::{Instrument, Pose, Scene};
use crate::source::{Emitter, Source};

/// Triangles of a mesh up to which each is held against each.
const MOST_TRIANGLES: usize = 64;

/// How far the source reaches above the plane of the aperture, m (for parallel light the cosine of incidence); at most zero when
/// all of it is below the horizon.
pub(crate) fn highest_over_horizon(scene: &Scene, pose: &Pose, source: &Source) -> f64 {
    match &source.emitter {
        Emitter::Point { at } => pose.normal.dot(*at - pose.at),
        Emitter::Directional { travels } => -travels.dot(pose.normal),
        Emitter::Area { elements } => {
            let highest = |&(e, _): &(usize, Side)| scene.elements[e].shape.extent_along(pose.at, pose.normal).1;
            elements.iter().map(highest).fold(f64::NEG_INFINITY, f64::max)
        }
        Emitter::Environment => f64::INFINITY,
    }
}

/// Whether an emitting side of the source may face some point within `reach_m` of `at`.
pub(crate) fn may_emit_towards(scene: &Scene, source: &Source, at: DVec3, reach_m: f64) -> bool {
    let Emitter::Area { elements } = &source.emitter else { return true };
    elements.iter().any(|&(e, side)| {
        let shape = &scene.elements[e].shape;
        match (shape.plane(), shape) {
            (Some((point, normal)), _) => side.sign() * normal.dot(at - point) + reach_m > 0.0,
            // On the sphere to the rounding of coordinates counts as within it, as it does where the light is computed.
            (None, Shape::Sphere(s)) if side == Side::Back => s.holds(at) || (at - s.centre).length() - reach_m < s.radius_m,
            (None, Shape::Sphere(s)) => (at - s.centre).length() + reach_m > s.radius_m,
            (None, _) => true,
        }
    })
}

/// A lower limit of the angle between the normal and any direction from the aperture to the source, rad.
pub(crate) fn smallest_angle_rad(scene: &Scene, pose: &Pose, reach_m: f64, source: &Source) -> f64 {
    match &source.emitter {
        Emitter::Point { at } => smallest_angle_of_ball_rad(pose, reach_m, *at, 0.0),
        Emitter::Directional { travels } => angle_rad(pose.normal, -*travels),
        Emitter::Area { elements } => elements
            .iter()
            .map(|&(e, _)| smallest_angle_of_shape_rad(pose, reach_m, &scene.elements[e].shape))
            .fold(f64::INFINITY, f64::min),
        Emitter::Environment => 0.0,
    }
}

/// The same for one shape.
pub(crate) fn smallest_angle_of_shape_rad(pose: &Pose, reach_m: f64, shape: &Shape) -> f64 {
    let (centre, radius) = shape.bounding_sphere();
    smallest_angle_of_ball_rad(pose, reach_m, centre, radius)
}

fn smallest_angle_of_ball_rad(pose: &Pose, reach_m: f64, centre: DVec3, radius_m: f64) -> f64 {
    let to = centre - pose.at;
    let (distance, radius) = (to.length(), radius_m + reach_m);
    if distance <= radius {
        return 0.0;
    }
    angle_rad(pose.normal, to) - (radius / distance).asin()
}

/// Angle between two vectors, without the loss of digits of an arc cosine.
pub(crate) fn angle_rad(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b))
}

/// The straight ways from a source to all poses of an instrument.
pub(crate) struct Shafts {
    centre: DVec3,
    radius_m: f64,
    /// Per element: below the horizon of every pose, or outside every acceptance.
    unseen: Vec<bool>,
    /// Per element: lowest and highest distance of the receivers from its plane, or from its sphere's centre less the radius, m.
    apart: Vec<(f64, f64)>,
}

impl Shafts {
    pub(crate) fn new(scene: &Scene, instrument: &Instrument) -> Shafts {
        let reach = instrument.sensor.aperture.radius_m();
        let (limit, horizon) = (instrument.sensor.acceptance.limit_rad(), instrument.sensor.acceptance.has_horizon());
        let (low, high) = instrument.bounds();
        let centre = low + 0.5 * (high - low);
        let radius_m = instrument.poses.iter().map(|p| (p.at - centre).length()).fold(0.0, f64::max) + reach;
        let unseen = scene
            .elements
            .iter()
            .map(|e| {
                instrument.poses.iter().all(|p| {
                    (horizon && e.shape.extent_along(p.at, p.normal).1 <= 0.0)
                        || (limit < 0.5 * PI && smallest_angle_of_shape_rad(p, reach, &e.shape) > limit)
                })
            })
            .collect();
        let apart = scene
            .elements
            .iter()
            .map(|e| {
                let mut range = (f64::INFINITY, f64::NEG_INFINITY);
                for p in &instrument.poses {
                    let (low, high) = match (e.shape.plane(), &e.shape) {
                        (Some((point, normal)), _) => around(normal.dot(p.at - point), normal.cross(p.normal).length() * reach),
                        (None, Shape::Sphere(s)) => around((p.at - s.centre).length() - s.radius_m, reach),
                        (None, _) => (f64::NEG_INFINITY, f64::INFINITY),
                    };
                    range = (range.0.min(low), range.1.max(high));
                }
                range
            })
            .collect();
        Shafts { centre, radius_m, unseen, apart }
    }

    /// Whether it is proved that nothing stands between the source and any pose.
    pub(crate) fn clear(&self, scene: &Scene, source: &Source) -> bool {
        let elements = scene.elements.iter().enumerate();
        match &source.emitter {
            Emitter::Environment => self.unseen.iter().all(|&u| u),
            Emitter::Directional { travels } => {
                let mut rest = elements.filter(|(e, _)| !self.unseen[*e]);
                rest.all(|(_, element)| {
                    let (centre, radius) = element.shape.bounding_sphere();
                    let to = centre - self.centre;
                    let along = -to.dot(*travels);
                    let aside = (to + along * *travels).length();
                    let sum = self.radius_m + radius;
                    aside > sum || along < -sum
                })
            }
            Emitter::Point { at } => {
                let mut rest = elements.filter(|(e, _)| !self.unseen[*e]);
                rest.all(|(e, element)| {
                    let from = match (element.shape.plane(), &element.shape) {
                        (Some((point, normal)), _) => normal.dot(*at - point),
                        (None, Shape::Sphere(s)) => (*at - s.centre).length() - s.radius_m,
                        (None, _) => f64::NAN,
                    };
                    self.same_side(e, &element.shape, (from, from)) || self.beside(&element.shape, *at, 0.0)
                })
            }
            Emitter::Area { elements: pieces } => pieces.iter().all(|&(piece, side)| {
                let shape = &scene.elements[piece].shape;
                let (centre, radius) = shape.bounding_sphere();
                elements.clone().filter(|(e, _)| !self.unseen[*e]).all(|(e, element)| {
                    if e == piece {
                        return match shape {
                            Shape::Mesh(m) => (side == Side::Front && m.is_convex_closed()) || self.shows_all_of(m),
                            _ => true,
                        };
                    }
                    behind(shape, side, &element.shape)
                        || self.same_side(e, &element.shape, span(&element.shape, shape))
                        || self.beside(&element.shape, centre, radius)
                })
            }),
        }
    }

    /// Whether receivers and source are on the same side of a plane element, or both within a sphere.
    fn same_side(&self, element: usize, shape: &Shape, source: (f64, f64)) -> bool {
        if matches!(shape, Shape::Mesh(_)) {
            // A mesh has no side of its own; and the slack of endless ranges would forgive everything.
            return false;
        }
        let receivers = self.apart[element];
        // Rounding of coordinates is forgiven to the same share of their size as coincident surfaces are.
        let slack = 1e-12 * [receivers.0, receivers.1, source.0, source.1].into_iter().map(f64::abs).fold(0.0, f64::max);
        // A mesh has no plane to be on one side of: its distances are not finite.
        if !slack.is_finite() {
            return false;
        }
        let below = receivers.1 <= slack && source.1 <= slack;
        let above = receivers.0 >= -slack && source.0 >= -slack;
        below || (above && !matches!(shape, Shape::Sphere(_)))
    }

    /// Whether no triangle of a small mesh can hide another one from a receiver: all of the mesh and all receivers are on the same side of
    /// each triangle's plane, or in it. So it is for a plane mesh, and for a convex one seen from inside.
    fn shows_all_of(&self, mesh: &Mesh) -> bool {
        if mesh.triangle_count() > MOST_TRIANGLES {
            return false;
        }
        let triangles: Vec<[DVec3; 3]> = (0..mesh.triangle_count() as u32).filter_map(|t| mesh.triangle(t)).collect();
        let (low, high) = mesh.bounds();
        // Vertices are rounded to single precision of the mesh's size.
        let slack = 16.0 * f64::from(f32::EPSILON) * (high - low).max_element();
        triangles.iter().enumerate().all(|(i, [a, b, c])| {
            let normal = (*b - *a).cross(*c - *a).normalize_or_zero();
            let others = triangles.iter().enumerate().filter(|(j, _)| *j != i).flat_map(|(_, t)| t.iter());
            let (low, high) = others.map(|p| normal.dot(*p - *a)).fold((0.0_f64, 0.0_f64), |(low, high), at| (low.min(at), high.max(at)));
            let receivers = normal.dot(self.centre - *a);
            let plane = high <= slack && low >= -slack;
            plane || (low >= -slack && receivers >= self.radius_m) || (high <= slack && receivers <= -self.radius_m)
        })
    }

    /// Whether the ball about the element stays outside the hull of the balls about receivers and source.
    fn beside(&self, shape: &Shape, source_centre: DVec3, source_radius_m: f64) -> bool {
        let (centre, radius) = shape.bounding_sphere();
        // The hull is the union of balls along the axis; the gap to them is a convex function of the place on the axis.
        let gap = |t: f64| {
            let at = self.centre.lerp(source_centre, t);
            (centre - at).length() - (self.radius_m + t * (source_radius_m - self.radius_m)) - radius
        };
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if gap(a) < gap(b) { high = b } else { low = a }
        }
        gap(0.5 * (low + high)) > 0.0
    }
}

fn around(middle: f64, half: f64) -> (f64, f64) {
    (middle - half, middle + half)
}

/// Lowest and highest distance of the emitter from the plane of a flat occluder, or from a sphere's surface, m.
fn span(occluder: &Shape, emitter: &Shape) -> (f64, f64) {
    match (occluder.plane(), occluder) {
        (Some((point, normal)), _) => emitter.extent_along(point, normal),
        (None, Shape::Sphere(s)) => {
            let (centre, radius) = emitter.bounding_sphere();
            around((centre - s.centre).length() - s.radius_m, radius)
        }
        (None, _) => (f64::NEG_INFINITY, f64::INFINITY),
    }
}

/// Whether the occluder lies wholly behind the plane of a flat emitter, where no light of it goes.
fn behind(emitter: &Shape, side: Side, occluder: &Shape) -> bool {
    emitter.plane().is_some_and(|(point, normal)| {
        let (low, high) = occluder.extent_along(point, side.sign() * normal);
        high <= 1e-12 * low.abs()
    })
}
