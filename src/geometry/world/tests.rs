//! The shapes of a scene against rays: boxes agree with their six faces, spheres and flats with their equations.

use proptest::prelude::*;

use super::*;
use crate::geometry::shape::{Rectangle, Sphere};
use crate::math::DMat3;

/// Six faces about a centre, turned, in the order that scenes build them or any other.
fn faces(centre: DVec3, half: DVec3, turn: DMat3, order: [usize; 6]) -> Vec<Shape> {
    let axes = [turn.col(0) * half.x, turn.col(1) * half.y, turn.col(2) * half.z];
    order
        .iter()
        .map(|&k| {
            let (i, sign) = (k / 2, if k % 2 == 0 { -1.0 } else { 1.0 });
            let (u, v) = if sign > 0.0 { ((i + 1) % 3, (i + 2) % 3) } else { ((i + 2) % 3, (i + 1) % 3) };
            Shape::Rectangle(Rectangle { centre: centre + sign * axes[i], half_u: axes[u], half_v: axes[v] })
        })
        .collect()
}

fn one_ray(origin: DVec3, direction: DVec3, leaving: u32) -> Rays {
    let mut rays = Rays::none();
    rays.active[3] = true;
    rays.origin.set(3, origin);
    rays.direction.set(3, direction);
    rays.leaving[3] = leaving;
    rays
}

/// A world in which every rectangle is met by itself.
fn loose(shapes: &[Shape]) -> World {
    let mut world = World::new(shapes);
    world.blocks.clear();
    world.loose = world.rectangles.clone();
    world
}

fn vector(range: std::ops::Range<f64>) -> impl Strategy<Value = DVec3> {
    (range.clone(), range.clone(), range).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

proptest! {
    #[test]
    fn a_box_is_met_where_its_faces_are(
        centre in vector(-5.0..5.0), half in vector(0.1..2.0), turn in vector(-3.0..3.0), origin in vector(-8.0..8.0), towards in vector(-3.0..3.0),
        swap in 0..6usize, exponent in -9..9,
    ) {
        let scale = 10f64.powi(exponent);
        let turn = DMat3::from_rotation_z(turn.z) * DMat3::from_rotation_y(turn.y) * DMat3::from_rotation_x(turn.x);
        let mut order = [0, 1, 2, 3, 4, 5];
        order.swap(0, swap);
        let shapes = faces(centre * scale, half * scale, turn, order);
        let (whole, parts) = (World::new(&shapes), loose(&shapes));
        prop_assert_eq!(whole.blocks.len(), 1);
        prop_assert!(whole.loose.is_empty());
        let direction = (centre + towards - origin) * scale;
        let rays = one_ray(origin * scale, direction, NONE);
        let (a, b) = (whole.closest(&rays), parts.closest(&rays));
        prop_assert_eq!(a.element[3], b.element[3]);
        if a.element[3] != NONE {
            prop_assert!((a.t[3] / b.t[3] - 1.0).abs() < 1e-9);
            // Onwards from the face that was met, through the box or away from it.
            let hit = whole.surface_point(rays.origin.get(3), direction, a.t[3], a.element[3], NONE);
            for way in [direction, -direction, hit.normal * scale, -hit.normal * scale] {
                let on = one_ray(hit.point, way, a.element[3]);
                let (a, b) = (whole.closest(&on), parts.closest(&on));
                prop_assert_eq!(a.element[3], b.element[3]);
            }
        }
        let mut shadow = rays.clone();
        shadow.t_end[3] = 1.0;
        prop_assert_eq!(whole.blocked(&shadow)[3], parts.blocked(&shadow)[3]);
    }

    #[test]
    fn a_ray_from_inside_a_closed_box_always_meets_it(inside in vector(-0.999..0.999), towards in vector(-1.0..1.0), half in vector(0.1..5.0)) {
        prop_assume!(towards.length() > 1e-3);
        let world = World::new(faces(DVec3::new(3.0, -2.0, 7.0), half, DMat3::IDENTITY, [0, 1, 2, 3, 4, 5]).iter());
        let mut at = DVec3::new(3.0, -2.0, 7.0) + inside * half;
        let (mut direction, mut leaving) = (towards, NONE);
        for _ in 0..20 {
            let hits = world.closest(&one_ray(at, direction, leaving));
            prop_assert!(hits.element[3] != NONE && hits.element[3] != leaving);
            let hit = world.surface_point(at, direction, hits.t[3], hits.element[3], NONE);
            (at, leaving) = (hit.point, hits.element[3]);
            direction -= 2.0 * hit.normal * direction.dot(hit.normal);
        }
    }

    #[test]
    fn six_rectangles_that_enclose_no_box_stay_apart(shift in 1e-6..0.5_f64, which in 0..6usize) {
        let mut shapes = faces(DVec3::ZERO, DVec3::ONE, DMat3::IDENTITY, [0, 1, 2, 3, 4, 5]);
        if let Shape::Rectangle(r) = &mut shapes[which] {
            r.half_u *= 1.0 - shift;
        }
        prop_assert!(World::new(&shapes).blocks.is_empty());
    }

    #[test]
    fn a_far_small_sphere_is_met_where_it_is(distance in 1.0..9.0_f64, aside in 0.0..0.999_f64, toward in vector(-1.0..1.0)) {
        let far = 10f64.powf(distance);
        prop_assume!(toward.length() > 0.1);
        let to = toward.normalize();
        let (x, _) = crate::math::frame::tangents(to);
        let world = World::new([&Shape::Sphere(Sphere { centre: far * to, radius_m: 1.0 })]);
        // Aimed at a point of the silhouette's disc, given relative to the centre.
        let rays = one_ray(aside * x, to, NONE);
        let expected = far - (1.0 - aside * aside).sqrt();
        let hits = world.closest(&rays);
        prop_assert_eq!(hits.element[3], 0);
        prop_assert!((hits.t[3] - expected).abs() <= 1e-15 * far * 8.0 + 1e-6 * far * f64::EPSILON.sqrt());
    }
}
