//! Where light is received: a sensor in one of its poses.

use std::f64::consts::PI;

use crate::geometry::rays::NONE;
use crate::geometry::shape::Shape;
use crate::math::DVec3;
use crate::math::frame::world_from_local;
use crate::math::sample::{sample_cone, sample_cosine_cone, sample_disc};
use crate::scene::{Pose, Scene};
use crate::sensor::{Acceptance, Aperture, Head, Sensor, Spot};
use crate::source::Emitter;

/// A sensor in a pose, prepared for sampling.
#[derive(Clone, Copy, Debug)]
pub(super) struct Receiver<'a> {
    pub(super) pose: Pose,
    /// Where its rays start: the centre of the aperture, off every surface that it lies on.
    at: DVec3,
    y_axis: DVec3,
    pub(super) acceptance: &'a Acceptance,
    pub(super) aperture: Aperture,
    /// Where light from all round is weighed.
    head: Option<Head>,
    /// Where the response depends on the point of the aperture.
    spot: Option<Spot>,
    /// Sine of the angle beyond which nothing is accepted.
    sine_limit: f64,
    /// The mesh on which the aperture lies, if any: rays do not meet it where they start.
    pub(super) resting_on: u32,
    /// The triangle of that mesh.
    pub(super) resting_part: u32,
}

impl<'a> Receiver<'a> {
    /// `traced`: whether rays will start here; what the aperture lies on matters only to them.
    pub(super) fn new(scene: &Scene, sensor: &'a Sensor, pose: Pose, traced: bool) -> Receiver<'a> {
        let place = if traced { Start::of(scene, &pose) } else { Start { at: pose.at, mesh: NONE, triangle: NONE } };
        let limit = sensor.acceptance.limit_rad();
        Receiver {
            pose,
            at: place.at,
            y_axis: pose.y_axis(),
            acceptance: &sensor.acceptance,
            aperture: sensor.aperture,
            head: sensor.acceptance.head(),
            spot: if let Acceptance::Spot(spot) = &sensor.acceptance { Some(*spot) } else { None },
            sine_limit: if limit >= 0.5 * PI { 1.0 } else { limit.sin() },
            resting_on: place.mesh,
            resting_part: place.triangle,
        }
    }

    /// The centre of the aperture, where rays start.
    pub(super) fn centre(&self) -> DVec3 {
        self.at
    }

    /// A point of the aperture, uniformly over its area: readings are means over the aperture, so the weight is one.
    #[inline(always)]
    pub(super) fn point(&self, u: [f64; 2]) -> DVec3 {
        match self.aperture {
            Aperture::Point => self.at,
            Aperture::Disc { radius_m } => {
                let [a, b] = sample_disc(u);
                self.at + radius_m * (self.pose.x_axis * a + self.y_axis * b)
            }
            Aperture::Rectangle { half_width_m, half_height_m } => {
                self.at + self.pose.x_axis * (half_width_m * (2.0 * u[0] - 1.0)) + self.y_axis * (half_height_m * (2.0 * u[1] - 1.0))
            }
        }
    }

    /// What light from `to` counts at a point of the aperture, times the length of `to`: `R n·to` of a plane receptor, zero below its horizon; `w |to|` of a head.
    #[inline(always)]
    pub(super) fn received(&self, at: DVec3, to: DVec3) -> f64 {
        if let Some(spot) = &self.spot {
            let ahead = self.pose.normal.dot(to);
            // Where the ray meets the plane of focus.
            let focus = (at - self.at) + to * (spot.focus_m / ahead);
            let aside = self.pose.x_axis.dot(focus).hypot(self.y_axis.dot(focus));
            return if ahead > 0.0 { ahead * spot.response(aside) } else { 0.0 };
        }
        match self.head {
            None => self.pose.normal.dot(to).max(0.0) * self.response(to),
            Some(head) => head.weight_times_length(DVec3::new(self.pose.x_axis.dot(to), self.y_axis.dot(to), self.pose.normal.dot(to))),
        }
    }

    /// A point of the aperture, a direction to look into, and what it counts over the density of its choice, by four numbers. A spot looks at
    /// points of its field, evenly over their area: `R π r² cos²θ/ρ²` at a distance ρ.
    #[inline(always)]
    pub(super) fn look(&self, u: [f64; 4]) -> (DVec3, DVec3, f64) {
        let at = self.point([u[2], u[3]]);
        let Some(spot) = &self.spot else {
            let (direction, counts) = self.direction([u[0], u[1]]);
            return (at, direction, counts);
        };
        let ([a, b], radius) = (sample_disc([u[0], u[1]]), spot.outer_radius_m());
        let field = self.at + radius * (self.pose.x_axis * a + self.y_axis * b) + spot.focus_m * self.pose.normal;
        let to = field - at;
        let distance = to.length();
        let (cos, r) = (spot.focus_m / distance, radius / distance);
        (at, to / distance, spot.response(radius * a.hypot(b)) * PI * r * r * cos * cos)
    }

    /// Whether a source is larger than the field at its distance: looking into the field then finds more of its light than choosing a point of
    /// the source does.
    pub(super) fn is_filled_by(&self, area_m2: f64, at: DVec3) -> bool {
        self.spot.is_some_and(|spot| {
            let ahead = self.pose.normal.dot(at - self.at);
            ahead > 0.0 && area_m2 > PI * spot.beam_radius_m(ahead).powi(2)
        })
    }

    /// A direction to look into, by two numbers, and what it counts over the density of its choice: cosθ/(π sin²α) within the limit of a
    /// plane receptor, 1/4π for a head.
    #[inline(always)]
    fn direction(&self, u: [f64; 2]) -> (DVec3, f64) {
        match self.head {
            None => {
                let direction = world_from_local(self.pose.normal, sample_cosine_cone(u, self.sine_limit));
                (direction, self.response(direction) * PI * self.sine_limit * self.sine_limit)
            }
            Some(_) => {
                let direction = world_from_local(self.pose.normal, sample_cone(u, 2.0));
                (direction, self.received(self.at, direction) * 4.0 * PI)
            }
        }
    }

    /// The relative response R for light that comes from `to` (any length); zero below the horizon.
    #[inline(always)]
    fn response(&self, to: DVec3) -> f64 {
        let cos = self.pose.normal.dot(to);
        if cos <= 0.0 {
            return 0.0;
        }
        match self.acceptance {
            Acceptance::Cosine => 1.0,
            other => {
                let (x, y) = (self.pose.x_axis.dot(to), self.y_axis.dot(to));
                // Lengths cancel in the angles.
                other.at(cos, x.hypot(y), y.atan2(x))
            }
        }
    }
}

/// Share of an element's size within which the aperture counts as lying on it, or of the distance to what is next if that is less: a wall of
/// 10⁹ m is not touched a metre away.
const TOUCHING: f64 = 1e-9;

/// Where rays start.
struct Start {
    at: DVec3,
    mesh: u32,
    triangle: u32,
}

impl Start {
    /// The centre of the aperture, moved off every surface that it lies on by twice the distance at which it counts as lying on it.
    ///
    /// A meter on a floor does not see it, one that stands upright on it or in a corner does, at no distance. It is moved to the side that
    /// it faces, or, where it faces along the surface, to the side on which the rest of the scene is. Meshes are coarser than
    /// that: there the triangle that rays start from is named.
    fn of(scene: &Scene, pose: &Pose) -> Start {
        let mut start = Start { at: pose.at, mesh: NONE, triangle: NONE };
        let n = scene.elements.len().max(1) as f64;
        let middle = scene.elements.iter().map(|e| e.shape.bounding_sphere().0 / n).sum::<DVec3>();
        let next = Next::to(scene, pose.at);
        for (e, element) in scene.elements.iter().enumerate() {
            let size_m = element.shape.bounding_sphere().1.min(next.other_than(e));
            let slack = TOUCHING * size_m + 4.0 * f64::EPSILON * pose.at.length();
            let Some(normal) = touching(&element.shape, pose, slack) else { continue };
            if let Shape::Mesh(m) = &element.shape {
                if let Some(hit) = m.closest(pose.at + slack * pose.normal, -pose.normal, 2.0 * slack, None) {
                    (start.mesh, start.triangle) = (e as u32, hit.triangle);
                }
                continue;
            }
            let faces = pose.normal.dot(normal);
            let towards = if faces.abs() > 1e-6 { faces } else { normal.dot(middle - pose.at) };
            start.at += normal * (2.0 * slack).copysign(towards);
        }
        start
    }
}

/// What is next to an aperture and does not touch it.
struct Next {
    /// The nearest element and its distance, m.
    nearest: (usize, f64),
    /// The distance of the next one, or of a lamp without extent, m.
    second_m: f64,
}

impl Next {
    fn to(scene: &Scene, at: DVec3) -> Next {
        let mut next = Next { nearest: (usize::MAX, f64::INFINITY), second_m: f64::INFINITY };
        for (e, element) in scene.elements.iter().enumerate() {
            let (centre, radius_m) = element.shape.bounding_sphere();
            let distance_m = match &element.shape {
                Shape::Mesh(_) => (at - centre).length() - radius_m,
                shape => shape.distance_m(at),
            };
            if distance_m <= TOUCHING * radius_m {
                continue;
            }
            if distance_m < next.nearest.1 {
                next = Next { nearest: (e, distance_m), second_m: next.nearest.1.min(next.second_m) };
            } else {
                next.second_m = next.second_m.min(distance_m);
            }
        }
        let lamps = scene.sources.iter().filter_map(|source| match source.emitter {
            Emitter::Point { at: lamp } => Some((lamp - at).length()).filter(|d| *d > 0.0),
            _ => None,
        });
        next.second_m = lamps.fold(next.second_m, f64::min);
        next
    }

    /// The smallest distance to anything but one element, m; infinite if there is nothing else.
    fn other_than(&self, element: usize) -> f64 {
        if element == self.nearest.0 { self.second_m } else { self.nearest.1.min(self.second_m) }
    }
}

/// The normal of a shape where the centre of the aperture lies on it.
fn touching(shape: &Shape, pose: &Pose, slack: f64) -> Option<DVec3> {
    let (on, normal) = match shape {
        Shape::Rectangle(r) => {
            let to = pose.at - r.centre;
            let inside = |half: DVec3| to.dot(half.normalize()).abs() <= half.length() + slack;
            (r.normal().dot(to).abs() <= slack && inside(r.half_u) && inside(r.half_v), r.normal())
        }
        Shape::Polygon(p) => ((pose.at - p.nearest_point(pose.at)).length() <= slack, p.normal()),
        Shape::Disc(d) => {
            let to = pose.at - d.centre;
            (d.normal.dot(to).abs() <= slack && to.length() <= d.radius_m + slack && to.length() >= d.hole_radius_m - slack, d.normal)
        }
        Shape::Sphere(s) => {
            let to = pose.at - s.centre;
            ((to.length() - s.radius_m).abs() <= slack, to.normalize_or_zero())
        }
        Shape::Mesh(_) => (true, pose.normal),
    };
    on.then_some(normal)
}
