//! Direct light of a source that nothing hides, from its formula.
//!
//! | aperture | acceptance | how |
//! |---|---|---|
//! | point | hemisphere, cone | closed form |
//! | point | rotationally symmetric table | ∫ R dG over the closed form of the cone |
//! | point | head that sees all round | `all_round.rs` |
//! | disc or rectangle | hemisphere | solid angle of the aperture, coaxial discs, exchange of polygons where they apply |
//! | disc or rectangle | any | adaptive quadrature of the point's formula over the aperture |

use std::f64::consts::FRAC_PI_2;

use super::all_round;
use super::closed_form::aperture::{self, Bounded, aperture_average};
use super::closed_form::{cone, directional, disc, exchange, point, polygon, polygon_in_cone, sphere};
use crate::geometry::mesh::Mesh;
use crate::geometry::rays::COINCIDENT;
use crate::geometry::shape::{Disc, Shape, Side, Sphere};
use crate::math::DVec3;
use crate::scene::{Pose, Scene};
use crate::sensor::{Acceptance, Aperture, Sensor};
use crate::source::{Emitter, Source};

/// Relative tolerance asked of every quadrature.
const TOLERANCE: f64 = 1e-11;

/// Mean weighted irradiance over the aperture per unit of the source's density; `None` if a quadrature does not converge.
pub(super) fn direct(scene: &Scene, sensor: &Sensor, pose: &Pose, source: &Source) -> Option<Bounded> {
    if let Some(value) = whole_aperture(scene, sensor, pose, source) {
        return Some(value);
    }
    let area = match sensor.aperture {
        Aperture::Point => return Some(at_point(scene, &sensor.acceptance, pose, pose.at, source)),
        Aperture::Disc { radius_m } => {
            aperture::Aperture::Disc { centre: DVec3::ZERO, radius_u: radius_m * pose.x_axis, radius_v: radius_m * pose.y_axis() }
        }
        Aperture::Rectangle { half_width_m, half_height_m } => {
            let (u, v) = (half_width_m * pose.x_axis, half_height_m * pose.y_axis());
            aperture::Aperture::Parallelogram { corner: -u - v, edge_u: 2.0 * u, edge_v: 2.0 * v }
        }
    };
    // Positions are taken relative to the centre of the aperture: a scene far from the origin keeps its digits.
    aperture_average(area, &|offset| at_point(scene, &sensor.acceptance, pose, pose.at + offset, source).value, TOLERANCE)
}

/// The same at one point of the aperture.
pub(super) fn at_point(scene: &Scene, acceptance: &Acceptance, pose: &Pose, at: DVec3, source: &Source) -> Bounded {
    if let Some(head) = acceptance.head() {
        return all_round::at_point(scene, head, pose, at, source);
    }
    let exact = |value: f64| Bounded { value, error: 0.0 };
    let response = |to: DVec3| {
        let (x, y, z) = (pose.x_axis.dot(to), pose.y_axis().dot(to), pose.normal.dot(to));
        acceptance.at(z, x.hypot(y), y.atan2(x))
    };
    match &source.emitter {
        Emitter::Point { at: lamp } => {
            let to = *lamp - at;
            exact(response(to) * point::irradiance_factor(to, pose.normal))
        }
        Emitter::Directional { travels } => exact(response(-*travels) * (-travels.dot(pose.normal)).max(0.0)),
        Emitter::Environment => exact(acceptance.projected_solid_angle_sr()),
        Emitter::Area { elements } => {
            let of_cone = |half_angle_rad: f64| -> f64 {
                elements.iter().map(|&(e, side)| within_cone(&scene.elements[e].shape, side, at, pose.normal, half_angle_rad)).sum()
            };
            match acceptance {
                Acceptance::Cone { half_angle_rad } => exact(of_cone(*half_angle_rad)),
                Acceptance::Directional(table) => {
                    let Some((theta, values)) = table.rotationally_symmetric() else {
                        return Bounded { value: f64::NAN, error: f64::INFINITY };
                    };
                    let response: Vec<(f64, f64)> = theta.iter().copied().zip(values.iter().copied()).collect();
                    let breaks = edges_rad(scene, elements, at, pose.normal);
                    directional::weighted_by_table(&of_cone, &response, &breaks, TOLERANCE)
                }
                _ => exact(elements.iter().map(|&(e, side)| over_hemisphere(&scene.elements[e].shape, side, at, pose.normal)).sum()),
            }
        }
    }
}

/// Angles from the normal at which a source begins or ends, as far as its bounding spheres tell.
fn edges_rad(scene: &Scene, elements: &[(usize, Side)], at: DVec3, normal: DVec3) -> Vec<f64> {
    let mut edges: Vec<f64> = elements
        .iter()
        .flat_map(|&(e, _)| {
            let angle = |to: DVec3| normal.cross(to).length().atan2(normal.dot(to));
            match &scene.elements[e].shape {
                shape if shape.corners().is_some() => shape.corners().into_iter().flatten().map(|c| angle(c - at)).collect(),
                shape => {
                    let (centre, radius) = shape.bounding_sphere();
                    let half = (radius / (centre - at).length()).min(1.0).asin();
                    vec![angle(centre - at) - half, angle(centre - at) + half]
                }
            }
        })
        .collect();
    edges.sort_by(f64::total_cmp);
    edges
}

/// Whether a receiver in the plane of an emitting face looks away from it or along it, to the rounding of its coordinates. It receives
/// nothing of that face then; the closed forms take the limit from the front.
fn skims(point: DVec3, front: DVec3, size_m: f64, at: DVec3, normal: DVec3) -> bool {
    let slack = COINCIDENT * size_m + 4.0 * f64::EPSILON * (at.abs().max_element() + point.abs().max_element());
    front.dot(at - point).abs() <= slack && normal.dot(front) > -COINCIDENT
}

fn face_is_dark(shape: &Shape, side: Side, at: DVec3, normal: DVec3) -> bool {
    shape.plane().is_some_and(|(point, front)| skims(point, side.sign() * front, shape.bounding_sphere().1, at, normal))
}

/// The triangles of a mesh, without those whose plane a receiver skims, each in the order that shows its emitting side.
fn lit_triangles(m: &Mesh, side: Side, at: DVec3, normal: DVec3) -> impl Iterator<Item = Vec<DVec3>> {
    (0..m.triangle_count() as u32).filter_map(move |t| {
        let corners = m.triangle(t)?;
        let front = side.sign() * m.normal(t)?;
        let size = (corners[1] - corners[0]).length().max((corners[2] - corners[0]).length());
        (!skims(corners[0], front, size, at, normal)).then(|| facing(&corners, at, side))
    })
}

fn over_hemisphere(shape: &Shape, side: Side, at: DVec3, normal: DVec3) -> f64 {
    if face_is_dark(shape, side, at, normal) {
        return 0.0;
    }
    match shape {
        Shape::Rectangle(r) => polygon::polygon(&facing(&r.corners(), at, side), normal),
        Shape::Polygon(p) => polygon::polygon(&facing(p.corners(), at, side), normal),
        Shape::Disc(d) => of_ring(d, |radius_m| disc::disc(d.centre - at, side.sign() * d.normal, radius_m, normal)),
        Shape::Sphere(s) => match (side, s.holds(at)) {
            (Side::Front, false) => sphere::sphere(s.centre - at, s.radius_m, normal),
            (Side::Back, true) => from_within(s, at, normal, FRAC_PI_2),
            _ => 0.0,
        },
        Shape::Mesh(m) => lit_triangles(m, side, at, normal).map(|corners| polygon::polygon(&corners, normal)).sum(),
    }
}

fn within_cone(shape: &Shape, side: Side, at: DVec3, normal: DVec3, half_angle_rad: f64) -> f64 {
    let of_polygon = |corners: &[DVec3]| {
        if polygon::receiver_in_front(corners) { polygon_in_cone::polygon_in_cone(corners, normal, half_angle_rad) } else { 0.0 }
    };
    if face_is_dark(shape, side, at, normal) {
        return 0.0;
    }
    match shape {
        Shape::Rectangle(r) => of_polygon(&facing(&r.corners(), at, side)),
        Shape::Polygon(p) => of_polygon(&facing(p.corners(), at, side)),
        Shape::Disc(d) => {
            let front = side.sign() * d.normal;
            if disc::receiver_in_front(d.centre - at, front) {
                of_ring(d, |radius_m| disc::disc_in_cone(d.centre - at, front, radius_m, normal, half_angle_rad))
            } else {
                0.0
            }
        }
        Shape::Sphere(s) => match (side, s.holds(at)) {
            (Side::Front, false) => sphere::sphere_in_cone(s.centre - at, s.radius_m, normal, half_angle_rad),
            (Side::Back, true) => from_within(s, at, normal, half_angle_rad),
            _ => 0.0,
        },
        Shape::Mesh(m) => lit_triangles(m, side, at, normal).map(|corners| of_polygon(&corners)).sum(),
    }
}

/// A function of a disc's radius for a disc, or the difference of plate and hole for a ring.
fn of_ring(d: &Disc, of_radius: impl Fn(f64) -> f64) -> f64 {
    let plate = of_radius(d.radius_m);
    if d.hole_radius_m > 0.0 { (plate - of_radius(d.hole_radius_m)).max(0.0) } else { plate }
}

/// Projected solid angle under which a receiver within a luminous sphere sees it: all that it accepts, or, on the wall itself, the half
/// space on the inner side, as a receiver on a luminous face does not see that face.
fn from_within(s: &Sphere, at: DVec3, normal: DVec3, half_angle_rad: f64) -> f64 {
    let to = s.centre - at;
    let rounding = 4.0 * f64::EPSILON * (s.centre.abs().max_element() + at.abs().max_element());
    if to.length() < s.radius_m * (1.0 - COINCIDENT) - rounding {
        return cone::projected_solid_angle(half_angle_rad);
    }
    cone::half_space_in_cone(to, normal, half_angle_rad)
}

/// Corners relative to a receiver, in the order that shows the emitting side counter-clockwise.
fn facing(corners: &[DVec3], at: DVec3, side: Side) -> Vec<DVec3> {
    let relative = corners.iter().map(|&c| c - at);
    if side == Side::Back { relative.rev().collect() } else { relative.collect() }
}

/// Formulas for the aperture as a whole: a cosine receptor only.
fn whole_aperture(scene: &Scene, sensor: &Sensor, pose: &Pose, source: &Source) -> Option<Bounded> {
    let area = sensor.aperture.area_m2()?;
    let exact = |value: f64| Some(Bounded { value, error: 0.0 });
    match &source.emitter {
        Emitter::Environment => return exact(sensor.acceptance.projected_solid_angle_sr()),
        Emitter::Directional { .. } => return Some(at_point(scene, &sensor.acceptance, pose, pose.at, source)),
        _ if sensor.acceptance != Acceptance::Cosine => return None,
        Emitter::Point { at } => {
            let to = *at - pose.at;
            let height = pose.normal.dot(to);
            if height <= 0.0 {
                return exact(0.0);
            }
            // The flux through the aperture is I Ω, its mean irradiance I Ω / A.
            return exact(match sensor.aperture {
                Aperture::Disc { radius_m } => point::disc_solid_angle(radius_m, height, pose.normal.cross(to).length()) / area,
                Aperture::Rectangle { half_width_m, half_height_m } => {
                    let (u, v) = (half_width_m * pose.x_axis, half_height_m * pose.y_axis());
                    point::parallelogram_solid_angle(-to - u - v, 2.0 * u, 2.0 * v) / area
                }
                Aperture::Point => return None,
            });
        }
        Emitter::Area { .. } => {}
    }
    let Emitter::Area { elements } = &source.emitter else { return None };
    let [(e, side)] = elements.as_slice() else { return None };
    match (&scene.elements[*e].shape, sensor.aperture) {
        (Shape::Disc(d), Aperture::Disc { radius_m }) => {
            let to = d.centre - pose.at;
            let height = pose.normal.dot(to);
            let facing = side.sign() * d.normal;
            let size = height.abs() + d.radius_m + radius_m;
            let coaxial = pose.normal.cross(to).length() <= 1e-12 * size && (facing + pose.normal).length() <= 1e-12 && height > 0.0;
            coaxial
                .then(|| Bounded { value: of_ring(d, |emitter_m| exchange::coaxial_discs(radius_m, emitter_m, height)) / area, error: 0.0 })
        }
        (shape @ (Shape::Rectangle(_) | Shape::Polygon(_)), Aperture::Rectangle { half_width_m, half_height_m }) => {
            let (u, v) = (half_width_m * pose.x_axis, half_height_m * pose.y_axis());
            let receiver = [-u - v, u - v, u + v, v - u];
            let emitter = facing(&shape.corners()?, pose.at, Side::Front);
            let (point, front) = shape.plane()?;
            // Each wholly on the facing side of the other; a common edge is allowed.
            let size = emitter.iter().map(|c| c.length()).fold(0.0, f64::max);
            let ahead = |points: &[DVec3], origin: DVec3, normal: DVec3| points.iter().all(|p| normal.dot(*p - origin) >= -1e-12 * size);
            if !(ahead(&emitter, DVec3::ZERO, pose.normal) && ahead(&receiver, point - pose.at, side.sign() * front)) {
                return None;
            }
            let etendue = exchange::polygons(&emitter, &receiver, TOLERANCE)?;
            Some(Bounded { value: etendue.value / area, error: etendue.error / area })
        }
        _ => None,
    }
}
