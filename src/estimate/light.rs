//! Sampling towards the light from a point that receives.
//!
//! ```text
//! E = ∫ L cosθ_r dω = ∫_A L cosθ_r cosθ_s / r² dA          weight of a sample: integrand / density
//! ```
//!
//! | piece | density of the sample | E per unit of the source's density |
//! |---|---|---|
//! | point | one connection | cosθ_r / r² |
//! | parallel light | one connection | cosθ_r |
//! | rectangle, polygon, disc, triangle of a mesh | 1/A over the area | A cosθ_r cosθ_s / r² |
//! | the same if it is near | 1/(Δφ Δs) over the rectangle around it (`near_light`) | Δφ Δs cosθ_r |
//! | sphere from outside | 1/Ω over its cone | Ω cosθ_r |
//! | sphere from inside | 1/4π over all directions | 4π cosθ_r |
//! | sphere from its own wall | 1/A over the area | A cosθ_r cosθ_s / r² |
//!
//! No weight grows without bound where a receiver touches a light: the spread of the samples would say nothing of what they miss.
//! A light is never found by chance: every sample goes to one.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use super::near_light::{self, Frame, Outline, Place};
use crate::geometry::mesh::Mesh;
use crate::geometry::polygon::Polygon;
use crate::geometry::rays::NONE;
use crate::geometry::shape::{Shape, Side, Sphere};
use crate::math::DVec3;
use crate::math::angle::one_minus_cos_of_sine;
use crate::math::frame::world_from_local;
use crate::math::sample::{sample_cone, sample_disc};
use crate::scene::Scene;
use crate::source::{Emitter, Source};

/// Share of a sphere's radius within which a point counts as lying on its wall: where rays start, a little off it, they still do.
const ON_THE_WALL: f64 = 1e-8;

/// A part of a source that is sampled as a whole.
#[derive(Clone, Debug)]
enum Piece {
    Point {
        at: DVec3,
    },
    Parallel {
        travels: DVec3,
    },
    /// Rectangle: centre ± u ± v.
    Rectangle {
        element: u32,
        centre: DVec3,
        u: DVec3,
        v: DVec3,
        normal: DVec3,
        area_m2: f64,
        frame: Frame,
    },
    Polygon {
        element: u32,
        polygon: Polygon,
        normal: DVec3,
        frame: Frame,
        outline: Outline,
    },
    Disc {
        element: u32,
        centre: DVec3,
        u: DVec3,
        v: DVec3,
        normal: DVec3,
        area_m2: f64,
        frame: Frame,
    },
    Sphere {
        element: u32,
        sphere: Sphere,
        side: Side,
    },
    Mesh {
        element: u32,
        mesh: Arc<Mesh>,
        side: Side,
    },
}

/// A connection from a receiving point to a light.
#[derive(Clone, Copy, Debug)]
pub(super) struct Connection {
    /// From the receiver to the light, m; of any length for parallel light.
    pub(super) to: DVec3,
    /// Where the light is, as a multiple of `to`: one, or infinity.
    pub(super) t_end: f64,
    /// `weight · (n·to)` is the irradiance per unit of the source's density; negative or zero: no light goes this way.
    pub(super) weight: f64,
    /// The group that the light belongs to.
    pub(super) group: u32,
    /// The element of the light, which does not stand in its own way.
    pub(super) element: u32,
    /// Its triangle.
    pub(super) part: u32,
}

/// The sources to which connections are made, each with the probability of being chosen.
#[derive(Clone, Debug, Default)]
pub(super) struct Lights {
    pieces: Vec<(Piece, u32)>,
    /// Probability of each piece, and the sum of those before it.
    share: Vec<f64>,
    before: Vec<f64>,
}

impl Lights {
    /// Sources with their groups; half of the choices are in proportion to `power`, which may be any positive guess, and half are even: a
    /// lamp that counts for little by its power may be the only one that counts here.
    pub(super) fn new<'a>(scene: &'a Scene, sources: impl IntoIterator<Item = (&'a Source, u32, f64)>) -> Lights {
        let mut lights = Lights::default();
        for (source, group, power) in sources {
            let mut push = |piece, share| {
                lights.pieces.push((piece, group));
                lights.share.push(share);
            };
            match &source.emitter {
                Emitter::Point { at } => push(Piece::Point { at: *at }, power),
                Emitter::Directional { travels } => push(Piece::Parallel { travels: *travels }, power),
                Emitter::Environment => {}
                Emitter::Area { elements } => {
                    let total: f64 = elements.iter().map(|&(e, _)| scene.elements[e].shape.area_m2()).sum();
                    for &(e, side) in elements {
                        let shape = &scene.elements[e].shape;
                        push(piece(shape, e as u32, side), power * shape.area_m2() / total);
                    }
                }
            }
        }
        let total: f64 = lights.share.iter().sum();
        let even = 1.0 / lights.share.len().max(1) as f64;
        let mut sum = 0.0;
        for share in &mut lights.share {
            // Powers that are all zero or overflow leave an even choice.
            *share = if total > 0.0 && total.is_finite() { 0.5 * (*share / total + even) } else { even };
            lights.before.push(sum);
            sum += *share;
        }
        lights
    }

    pub(super) fn is_empty(&self) -> bool {
        self.pieces.is_empty()
    }

    /// A connection from `x`, by two numbers for the place on the light; the first one also chooses the light.
    #[inline(always)]
    pub(super) fn sample(&self, x: DVec3, u: [f64; 2]) -> Connection {
        let chosen = if self.pieces.len() <= 32 {
            let mut chosen = 0;
            for i in 1..self.before.len() {
                chosen += usize::from(self.before[i] <= u[0]);
            }
            chosen
        } else {
            self.before.partition_point(|&b| b <= u[0]).max(1) - 1
        };
        let share = self.share[chosen];
        // The chosen piece's stretch of (0, 1) is spread over (0, 1) again: the strata survive the choice.
        let rest = ((u[0] - self.before[chosen]) / share).clamp(0.0, 1.0 - f64::EPSILON);
        let (piece, group) = &self.pieces[chosen];
        let mut connection = connect(piece, x, [rest, u[1]]);
        connection.group = *group;
        connection.weight /= share;
        connection
    }
}

fn piece(shape: &Shape, element: u32, side: Side) -> Piece {
    match shape {
        Shape::Rectangle(r) => {
            let normal = side.sign() * r.normal();
            let frame = Frame::rectangle(r.centre, r.half_u, r.half_v, normal);
            Piece::Rectangle { element, centre: r.centre, u: r.half_u, v: r.half_v, normal, area_m2: r.area_m2(), frame }
        }
        Shape::Polygon(p) => {
            let normal = side.sign() * p.normal();
            let (frame, outline) = Frame::around(p.corners(), normal);
            Piece::Polygon { element, polygon: p.clone(), normal, frame, outline }
        }
        Shape::Disc(d) => {
            let (x, y) = crate::math::frame::tangents(d.normal);
            Piece::Disc {
                element,
                centre: d.centre,
                u: x * d.radius_m,
                v: y * d.radius_m,
                normal: side.sign() * d.normal,
                area_m2: PI * d.radius_m * d.radius_m,
                frame: Frame::disc(d.centre, d.radius_m, side.sign() * d.normal),
            }
        }
        Shape::Sphere(s) => Piece::Sphere { element, sphere: *s, side },
        Shape::Mesh(m) => Piece::Mesh { element, mesh: Arc::clone(m), side },
    }
}

#[inline(always)]
fn connect(piece: &Piece, x: DVec3, u: [f64; 2]) -> Connection {
    let dark = Connection { to: DVec3::Z, t_end: 1.0, weight: 0.0, group: 0, element: NONE, part: NONE };
    match piece {
        Piece::Rectangle { element, centre, u: hu, v: hv, normal, area_m2, frame } => {
            if let Some(place) = frame.sample(x, u) {
                return from_near(place, *element, NONE);
            }
            let to = (*centre - x) + *hu * (2.0 * u[0] - 1.0) + *hv * (2.0 * u[1] - 1.0);
            from_area(to, *normal, *area_m2, *element, NONE)
        }
        Piece::Polygon { element, polygon, normal, frame, outline } => {
            if let Some(place) = frame.sample_polygon(outline, x, u) {
                return from_near(place, *element, NONE);
            }
            let to = (polygon.corners()[0] - x) + polygon.sample_by_area(u);
            from_area(to, *normal, polygon.area_m2(), *element, NONE)
        }
        Piece::Disc { element, centre, u: hu, v: hv, normal, area_m2, frame } => {
            if let Some(place) = frame.sample_disc(x, u) {
                return from_near(place, *element, NONE);
            }
            let [a, b] = sample_disc(u);
            from_area((*centre - x) + *hu * a + *hv * b, *normal, *area_m2, *element, NONE)
        }
        Piece::Point { at } => {
            let to = *at - x;
            let r2 = to.length_squared();
            Connection { to, weight: 1.0 / (r2 * r2.sqrt()), ..dark }
        }
        Piece::Parallel { travels } => Connection { to: -*travels, t_end: f64::INFINITY, weight: 1.0, ..dark },
        Piece::Sphere { element, sphere, side } => {
            let Sphere { centre, radius_m } = sphere;
            let axis = *centre - x;
            let distance = axis.length();
            if distance > *radius_m && *side == Side::Front {
                let h = one_minus_cos_of_sine(radius_m / distance);
                let direction = world_from_local(axis / distance, sample_cone(u, h));
                // The nearer intersection; the farther one would do as well for an arriving ray, but not for what stands before it.
                let along = direction.dot(axis);
                let aside2 = (axis - along * direction).length_squared();
                let t = along - (radius_m * radius_m - aside2).max(0.0).sqrt();
                // density 1/Ω with Ω = 2π (1 − cos α): E = L cosθ_r Ω, and n·to = t cosθ_r
                Connection { to: t * direction, weight: TAU * h / t, element: *element, ..dark }
            } else if *side == Side::Back && sphere.holds(x) {
                let z = 1.0 - 2.0 * u[0];
                let s = (1.0 - z * z).max(0.0).sqrt();
                let (sin, cos) = (TAU * u[1]).sin_cos();
                let outward = DVec3::new(s * cos, s * sin, z);
                if distance < *radius_m * (1.0 - ON_THE_WALL) {
                    let along = outward.dot(axis);
                    let t = along + (along * along + (radius_m - distance) * (radius_m + distance)).sqrt();
                    return Connection { to: t * outward, weight: 2.0 * TAU / t, element: *element, ..dark };
                }
                from_area(axis + *radius_m * outward, -outward, 4.0 * PI * radius_m * radius_m, *element, NONE)
            } else {
                dark
            }
        }
        Piece::Mesh { element, mesh, side } => {
            let (triangle, rest) = mesh.choose_by_area(u[0]);
            if let (Some(corners), Some(normal)) = (mesh.triangle(triangle), mesh.normal(triangle))
                && let Some(mut place) = near_light::on_triangle(&corners, side.sign() * normal, x, [rest, u[1]])
            {
                place.weight *= mesh.area_m2();
                return from_near(place, *element, triangle);
            }
            let (triangle, point, normal) = mesh.sample_by_area_with_two(u);
            from_area(point - x, side.sign() * normal, mesh.area_m2(), *element, triangle)
        }
    }
}

/// A place on a light that is near.
#[inline(always)]
fn from_near(place: Place, element: u32, part: u32) -> Connection {
    Connection { to: place.to, t_end: 1.0, weight: place.weight, group: 0, element, part }
}

/// A point chosen with density 1/A: E = L A cosθ_r cosθ_s / r², with cosθ_r = n·to/r and cosθ_s = −n_s·to/r.
#[inline(always)]
fn from_area(to: DVec3, normal: DVec3, area_m2: f64, element: u32, part: u32) -> Connection {
    let r2 = to.length_squared();
    let weight = area_m2 * -normal.dot(to) / (r2 * r2);
    // A receiver on the light itself sees it edge-on.
    Connection { to, t_end: 1.0, weight: if r2 > 0.0 { weight } else { 0.0 }, group: 0, element, part }
}
