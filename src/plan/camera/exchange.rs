//! Which surfaces see each other, and what can stand between them and a source; on the safe side, without a ray.
//!
//! A reflecting side r, another element o, a lit piece p of a source; heights are counted over the plane of a side.
//!
//! ```text
//! no exchange of r and q      all of q at heights ≤ 0 over r, or all of r at heights ≤ 0 over q; a plane side or the outside of a
//!                             sphere does not see itself
//! o does not hide p from r    o is p or r, and plane or a sphere;  o wholly behind p;  p and o on opposite sides of the plane of r;
//!                             r and p on the same side of the plane of o, or both within the sphere o
//! an environment              is whole over r if every other element is at height zero over r
//! ```

use crate::geometry::shape::{Shape, Side};
use crate::math::DVec3;
use crate::scene::Scene;
use crate::source::{Emitter, Source};
use crate::surface::Surface;

/// Heights below this share of the extents count as zero: the rounding of coordinates.
const SLACK: f64 = 1e-12;

/// A side of an element.
pub(super) type ElementSide = (usize, Side);

/// The sides that reflect at some wavelength, without the insides of spheres that no camera is in: their light stays there.
pub(super) fn reflecting_sides(scene: &Scene) -> Vec<ElementSide> {
    let black: Vec<bool> = scene.surfaces.iter().map(Surface::is_black).collect();
    let elements = scene.elements.iter().enumerate();
    let sides = elements.flat_map(|(i, e)| [(i, Side::Front, black[e.front]), (i, Side::Back, black[e.back])]);
    let shut = |i: usize, side: Side| match &scene.elements[i].shape {
        Shape::Sphere(s) if side == Side::Back => scene.cameras.iter().all(|placed| {
            let pupil = placed.camera.lens.pupil_radius_m();
            (placed.pose.at - s.centre).length() > (s.radius_m + pupil) * (1.0 + SLACK)
        }),
        _ => false,
    };
    sides.filter(|&(i, side, black)| !black && !shut(i, side)).map(|(i, side, _)| (i, side)).collect()
}

/// Lowest and highest height of a shape over a plane, rounded to zero where it is less than the rounding of coordinates.
fn heights(shape: &Shape, point: DVec3, normal: DVec3) -> (f64, f64) {
    let (low, high) = shape.extent_along(point, normal);
    let (centre, radius) = shape.bounding_sphere();
    let slack = SLACK * ((centre - point).length() + radius + point.abs().max_element());
    let rounded = |x: f64| if x.abs() <= slack { 0.0 } else { x };
    (rounded(low), rounded(high))
}

/// The plane of a side that has one, its normal away from the side.
fn plane(scene: &Scene, (element, side): ElementSide) -> Option<(DVec3, DVec3)> {
    scene.elements[element].shape.plane().map(|(point, normal)| (point, side.sign() * normal))
}

/// Whether light that leaves one of these sides meets none of them again.
pub(super) fn no_exchange(scene: &Scene, sides: &[ElementSide]) -> bool {
    let below = |a: ElementSide, b: ElementSide| {
        plane(scene, b).is_some_and(|(point, normal)| heights(&scene.elements[a.0].shape, point, normal).1 <= 0.0)
    };
    let alone = |a: ElementSide| match &scene.elements[a.0].shape {
        Shape::Sphere(_) => a.1 == Side::Front,
        Shape::Mesh(_) => false,
        _ => true,
    };
    sides.iter().enumerate().all(|(i, &a)| {
        // The two sides of one element do not see each other, unless it is a mesh, which is excluded.
        alone(a) && sides[..i].iter().all(|&b| a.0 == b.0 || below(a, b) || below(b, a))
    })
}

/// Whether nothing can stand between a source and any of these sides, and there is a formula for its irradiance.
pub(super) fn clear(scene: &Scene, sides: &[ElementSide], source: &Source) -> bool {
    sides.iter().all(|&side| clear_from(scene, side, source))
}

fn clear_from(scene: &Scene, side: ElementSide, source: &Source) -> bool {
    let receiver = &scene.elements[side.0].shape;
    if matches!(receiver, Shape::Mesh(_)) {
        return false;
    }
    // The wall of a hollow sphere hides what is outside from its inside.
    let hollow = match receiver {
        Shape::Sphere(s) if side.1 == Side::Back => Some((s.centre, s.radius_m)),
        _ => None,
    };
    let others = || scene.elements.iter().enumerate().filter(|(o, _)| *o != side.0);
    match &source.emitter {
        Emitter::Environment => match plane(scene, side) {
            Some((point, normal)) => others().all(|(_, o)| heights(&o.shape, point, normal).1 <= 0.0),
            None => side.1 == Side::Front && others().next().is_none(),
        },
        // Parallel light comes from beyond everything: only what is below the receiver's plane is surely not in its way.
        Emitter::Directional { .. } => match plane(scene, side) {
            Some((point, normal)) => others().all(|(_, o)| heights(&o.shape, point, normal).1 <= 0.0),
            None => side.1 == Side::Front && others().next().is_none(),
        },
        Emitter::Point { at } => {
            hollow.is_none_or(|(centre, radius)| (*at - centre).length() <= radius)
                && others().all(|(_, o)| {
                    let lamp = |point: DVec3, normal: DVec3| {
                        let height = normal.dot(*at - point);
                        (height, height)
                    };
                    passes(side, scene, &o.shape, &lamp, &|centre, radius| (*at - centre).length() <= radius)
                })
        }
        Emitter::Area { elements } => elements.iter().all(|&(piece, lit)| {
            let shape = &scene.elements[piece].shape;
            if matches!(shape, Shape::Mesh(_)) || hollow.is_some_and(|(centre, radius)| !within(shape, centre, radius)) {
                return false;
            }
            others().filter(|(o, _)| *o != piece).all(|(_, o)| {
                let behind = shape.plane().is_some_and(|(point, normal)| heights(&o.shape, point, lit.sign() * normal).1 <= 0.0);
                let lamp = |point: DVec3, normal: DVec3| heights(shape, point, normal);
                behind || passes(side, scene, &o.shape, &lamp, &|centre, radius| within(shape, centre, radius))
            })
        }),
    }
}

/// Whether the element `o` lets all light of a lamp pass to a side; `lamp` tells its heights over a plane, `inside` whether it is within a ball.
fn passes(
    side: ElementSide,
    scene: &Scene,
    o: &Shape,
    lamp: &dyn Fn(DVec3, DVec3) -> (f64, f64),
    inside: &dyn Fn(DVec3, f64) -> bool,
) -> bool {
    let receiver = &scene.elements[side.0].shape;
    if let Some((point, normal)) = plane(scene, side) {
        // What is not above the side's horizon does not stand over it; a lamp that is not above it gives nothing.
        if heights(o, point, normal).1 <= 0.0 || lamp(point, normal).1 <= 0.0 {
            return true;
        }
    }
    match (o.plane(), o) {
        (Some((point, normal)), _) => {
            let (from, to) = (lamp(point, normal), heights(receiver, point, normal));
            (from.0 >= 0.0 && to.0 >= 0.0) || (from.1 <= 0.0 && to.1 <= 0.0)
        }
        (None, Shape::Sphere(s)) => inside(s.centre, s.radius_m) && within(receiver, s.centre, s.radius_m),
        (None, _) => false,
    }
}

/// Whether a shape is surely within a ball, which is convex.
fn within(shape: &Shape, centre: DVec3, radius_m: f64) -> bool {
    match shape.corners() {
        Some(corners) => corners.iter().all(|c| (*c - centre).length() <= radius_m * (1.0 + SLACK)),
        None => {
            let (middle, radius) = shape.bounding_sphere();
            (middle - centre).length() + radius <= radius_m * (1.0 + SLACK)
        }
    }
}
