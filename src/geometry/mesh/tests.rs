//! Laws of meshes in the world.

use super::*;
use crate::geometry::bvh::tests::{Stream, bumpy_icosphere, icosphere};
use proptest::prelude::*;

fn mesh((points, triangles): (Vec<[f64; 3]>, Vec<[u32; 3]>), radius: f64, centre: DVec3) -> Mesh {
    let points: Vec<DVec3> = points.into_iter().map(|p| DVec3::from_array(p) * radius + centre).collect();
    Mesh::new(&points, triangles).unwrap()
}

fn unit_square() -> Mesh {
    Mesh::new(&[DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y], vec![[0, 1, 2], [0, 2, 3]]).unwrap()
}

/// Radii and places at which everything must work.
fn places() -> Vec<(f64, DVec3)> {
    let aside = DVec3::new(0.6, -0.7, 0.4);
    vec![
        (1.0, DVec3::ZERO),
        (1e-9, DVec3::ZERO),
        (1e9, DVec3::ZERO),
        (1.0, aside * 1e4),
        (1e-4, DVec3::ZERO),
        (1e-9, aside * 1e-5),
        (1.0, aside * 1e7),
    ]
}

#[test]
fn no_ray_escapes_from_a_closed_mesh() {
    for (radius, centre) in places() {
        let closed = mesh(bumpy_icosphere(3), radius, centre);
        let mut stream = Stream(4);
        for i in 0..20_000 {
            let [a, b, c] = closed.triangle(i % closed.triangle_count() as u32).unwrap();
            let from = centre + DVec3::from_array(stream.direction()) * (0.3 * radius * stream.next());
            let target = match i % 3 {
                0 => a,
                1 => (b + c) * 0.5,
                _ => a + (c - a) * stream.next(),
            };
            let hit = closed.closest(from, (target - from).normalize(), f64::INFINITY, None);
            let hit = hit.unwrap_or_else(|| panic!("radius {radius} centre {centre}: ray {i} escapes"));
            // What is met is the target, or something before it.
            assert!(hit.t < (target - from).length() + 1e-6 * radius);
        }
    }
}

#[test]
fn outgoing_rays_of_a_convex_mesh_meet_nothing_and_inward_rays_always_something() {
    for (radius, centre) in places() {
        let sphere = mesh(icosphere(4), radius, centre);
        let mut stream = Stream(5);
        for i in 0..40_000 {
            let (triangle, mut point, normal) = sphere.sample_by_area([stream.next(), stream.next(), stream.next()]);
            if i % 4 == 0 {
                // On the edge, where the neighbour begins.
                let [a, b, _] = sphere.triangle(triangle).unwrap();
                point = a + (b - a) * stream.next();
            }
            let mut direction = DVec3::from_array(stream.direction());
            if i % 3 == 0 {
                // Nearly grazing.
                direction = (direction - normal * normal.dot(direction) * (1.0 - 1e-3)).normalize();
            }
            let outgoing = direction * normal.dot(direction).signum();
            let again = sphere.closest(point, outgoing, f64::INFINITY, Some(triangle));
            assert_eq!(again, None, "radius {radius} centre {centre}, ray {i}");
            assert!(!sphere.blocked(point, outgoing, f64::INFINITY, Some(triangle), None));
            assert!(sphere.closest(point, -outgoing, f64::INFINITY, Some(triangle)).is_some(), "radius {radius} centre {centre}, ray {i}");
        }
    }
}

#[test]
fn points_of_a_convex_mesh_see_each_other_from_inside() {
    for (radius, centre) in places() {
        let sphere = mesh(icosphere(4), radius, centre);
        let mut stream = Stream(6);
        for i in 0..20_000 {
            let (leaving, p, _) = sphere.sample_by_area([stream.next(), stream.next(), stream.next()]);
            let (arriving, q, _) = sphere.sample_by_area([stream.next(), stream.next(), stream.next()]);
            let way = q - p;
            if leaving != arriving {
                let blocked = sphere.blocked(p, way.normalize(), way.length(), Some(leaving), Some(arriving));
                assert!(!blocked, "radius {radius} centre {centre}, pair {i}");
            }
            // From outside only the half that faces the point is seen.
            let far = centre + DVec3::from_array(stream.direction()) * (1e6 * radius);
            let way = q - far;
            let facing = -sphere.normal(arriving).unwrap().dot(way.normalize());
            if facing.abs() > 1e-2 {
                let blocked = sphere.blocked(far, way.normalize(), way.length(), None, Some(arriving));
                assert_eq!(blocked, facing < 0.0, "radius {radius} centre {centre}, pair {i}, cosine {facing}");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn hits_do_not_depend_on_scale_and_place(power in -9..=9_i32, x in -1e3..1e3_f64, y in -1e3..1e3_f64, seed in any::<u64>()) {
        let (scale, shift) = (10.0_f64.powi(power), DVec3::new(x, y, 0.3) * 10.0_f64.powi(power));
        let here = mesh(bumpy_icosphere(2), 1.0, DVec3::ZERO);
        let there = mesh(bumpy_icosphere(2), scale, shift);
        let mut stream = Stream(seed);
        for _ in 0..200 {
            let (from, direction) = (DVec3::from_array(stream.direction()) * 2.0, DVec3::from_array(stream.direction()));
            let a = here.closest(from, direction, f64::INFINITY, None);
            let b = there.closest(from * scale + shift, direction, f64::INFINITY, None);
            // Rays that graze an edge may differ.
            if let (Some(a), Some(b)) = (a, b) && a.triangle == b.triangle && a.normal.dot(direction).abs() > 0.05 {
                prop_assert!((b.t / scale - a.t).abs() < 1e-5, "{a:?} {b:?}");
                prop_assert!(((b.point - shift) / scale - a.point).length() < 1e-5);
            }
        }
    }

    #[test]
    fn a_hit_is_on_the_ray_and_on_the_triangle(seed in any::<u64>(), distance in 0.0..6.0_f64) {
        let closed = mesh(bumpy_icosphere(3), 1.0, DVec3::new(3.0, 2.0, 1.0));
        let mut stream = Stream(seed);
        for _ in 0..200 {
            let direction = DVec3::from_array(stream.direction());
            let inside = closed.bounds().0 * 0.5 + closed.bounds().1 * 0.5 + DVec3::from_array(stream.direction()) * 0.5;
            let from = inside - direction * 10.0_f64.powf(distance);
            let Some(hit) = closed.closest(from, direction, f64::INFINITY, None) else {
                return Err(TestCaseError::fail("a ray through the mesh misses it"));
            };
            let [a, b, c] = closed.triangle(hit.triangle).unwrap();
            prop_assert!((hit.point - a).dot(hit.normal).abs() <= hit.error_m.dot(hit.normal.abs()) * 4.0);
            prop_assert!((from + direction * hit.t - hit.point).length() < 1e-6);
            let inverted = closed.invert_area_sample(hit.triangle, hit.point).unwrap();
            prop_assert!(inverted.iter().all(|u| (0.0..=1.0).contains(u)));
            prop_assert!(((b - a).cross(c - a).normalize() - hit.normal).length() < 1e-12);
        }
    }

    #[test]
    fn an_area_sample_is_inverted(u in [0.0..1.0_f64, 1e-6..1.0_f64, 0.0..1.0_f64]) {
        let surface = mesh(bumpy_icosphere(1), 1e-3, DVec3::new(1.0, 2.0, 3.0));
        let (triangle, point, _) = surface.sample_by_area(u);
        let [v0, v1, v2] = surface.invert_area_sample(triangle, point).unwrap();
        prop_assert!((v1 - u[1]).abs() < 1e-6 && (v2 - u[2]).abs() * u[1].sqrt() < 1e-6, "{u:?} {v1} {v2}");
        prop_assert_eq!(surface.sample_by_area([v0, v1, v2]).0, triangle);
    }
}

#[test]
fn area_samples_are_as_dense_as_area() {
    // Two triangles of areas 3 and 1: counts and the mean point.
    let points = [DVec3::ZERO, DVec3::new(3.0, 0.0, 0.0), DVec3::new(0.0, 2.0, 0.0), DVec3::new(-1.0, 0.0, 0.0)];
    let surface = Mesh::new(&points, vec![[0, 1, 2], [0, 2, 3]]).unwrap();
    assert!((surface.area_m2() - 4.0).abs() < 1e-6);
    assert!((surface.triangle_areas_m2().sum::<f64>() * surface.area_pdf_m2() - 1.0).abs() < 1e-12);
    let n = 64;
    let (mut first, mut mean) = (0, DVec3::ZERO);
    for i in 0..n * n * n {
        let u = [i % n, i / n % n, i / (n * n)].map(|k| (k as f64 + 0.5) / n as f64);
        let (triangle, point, normal) = surface.sample_by_area(u);
        first += usize::from(triangle == 0);
        mean += point / (n * n * n) as f64;
        assert!((normal - DVec3::Z).length() < 1e-12);
    }
    assert_eq!(first, 3 * n * n * n / 4);
    let expected = (DVec3::new(1.0, 2.0 / 3.0, 0.0) * 3.0 + DVec3::new(-1.0 / 3.0, 2.0 / 3.0, 0.0)) / 4.0;
    assert!((mean - expected).length() < 1e-3, "{mean}");
}

#[test]
fn a_mesh_knows_whether_it_is_closed_and_convex() {
    for (radius, centre) in places() {
        let sphere = mesh(icosphere(3), radius, centre);
        assert!(sphere.is_closed() && sphere.is_convex_closed(), "{radius} {centre}");
        let bumpy = mesh(bumpy_icosphere(3), radius, centre);
        assert!(bumpy.is_closed() && !bumpy.is_convex_closed());
    }
    let (points, mut triangles) = icosphere(2);
    triangles.pop();
    let open = mesh((points.clone(), triangles), 1.0, DVec3::ZERO);
    assert!(!open.is_closed() && !open.is_convex_closed());
    // Turned inside out it is closed, but its normals are not outside.
    let inward = icosphere(2).1.iter().map(|&[a, b, c]| [a, c, b]).collect();
    let inward = mesh((points.clone(), inward), 1.0, DVec3::ZERO);
    assert!(inward.is_closed() && !inward.is_convex_closed());
    // One triangle turned over.
    let mut turned = icosphere(2).1;
    turned[7].swap(0, 1);
    assert!(!mesh((points, turned), 1.0, DVec3::ZERO).is_closed());
    // Own vertices for each triangle.
    let (points, triangles) = icosphere(2);
    let soup: Vec<[f64; 3]> = triangles.iter().flatten().map(|&i| points[i as usize]).collect();
    let apart = (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    assert!(mesh((soup, apart), 1.0, DVec3::ZERO).is_convex_closed());
}

#[test]
fn area_and_bounds_scale_as_geometry_says() {
    for (radius, centre) in places() {
        let sphere = mesh(icosphere(5), radius, centre);
        // An inscribed polyhedron is a little smaller than the sphere.
        let share = sphere.area_m2() / (4.0 * std::f64::consts::PI * radius * radius);
        assert!(share < 1.0 && share > 0.999, "{share}");
        let (min, max) = sphere.bounds();
        assert!(((max - min) / (2.0 * radius) - DVec3::ONE).length() < 2e-3);
    }
}

#[test]
fn what_is_not_a_surface_is_an_error_that_says_why() {
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
    assert_eq!(Mesh::new(&corners, vec![]).unwrap_err(), MeshError::NoTriangles);
    assert_eq!(Mesh::new(&corners, vec![[0, 1, 3]]).unwrap_err(), MeshError::IndexOutOfRange { triangle: 0, index: 3, vertices: 3 });
    for bad in [f64::NAN, f64::INFINITY] {
        let points = [DVec3::ZERO, DVec3::new(0.0, bad, 0.0), DVec3::Y];
        assert_eq!(Mesh::new(&points, vec![[0, 1, 2]]).unwrap_err(), MeshError::VertexNotFinite { vertex: 1 });
    }
    assert_eq!(Mesh::new(&corners, vec![[0, 1, 1]]).unwrap_err(), MeshError::AllDegenerate { triangles: 1 });
    assert_eq!(Mesh::new(&[DVec3::X; 3], vec![[0, 1, 2]]).unwrap_err(), MeshError::AllDegenerate { triangles: 1 });
    for size in [1e-200, 1e300] {
        let points = corners.map(|p| p * size);
        assert!(matches!(Mesh::new(&points, vec![[0, 1, 2]]), Err(MeshError::ExtentOutOfRange { .. })));
    }
}

#[test]
fn triangles_without_area_are_dropped_and_counted() {
    let points = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(2.0, 0.0, 0.0)];
    let surface = Mesh::new(&points, vec![[0, 1, 3], [0, 1, 2], [2, 2, 1]]).unwrap();
    assert_eq!((surface.triangle_count(), surface.degenerate_count(), surface.vertex_count()), (1, 2, 4));
    assert!(surface.closest(DVec3::new(0.2, 0.2, 1.0), -DVec3::Z, 2.0, None).is_some());
}

#[test]
fn a_way_that_ends_at_a_surface_is_free_and_one_that_goes_through_is_not() {
    let square = unit_square();
    let from = DVec3::new(0.3, 0.4, 2.0);
    assert!(!square.blocked(from, -DVec3::Z, 2.0, None, None));
    assert!(square.blocked(from, -DVec3::Z, 2.0 + 1e-5, None, None));
    assert!(square.closest(from, -DVec3::Z, 1.999, None).is_none());
    let hit = square.closest(from, -DVec3::Z, f64::INFINITY, None).unwrap();
    assert!((hit.t - 2.0).abs() < 1e-12 && (hit.normal - DVec3::Z).length() < 1e-12, "{hit:?}");
}

#[test]
fn a_ray_from_a_billion_radii_away_meets_the_mesh_where_it_should() {
    let square = unit_square();
    let target = DVec3::new(0.25, 0.5, 0.0);
    for distance in [1.0, 1e3, 1e6, 1e9] {
        let direction = DVec3::new(0.0, 0.6, -0.8);
        let hit = square.closest(target - direction * distance, direction, f64::INFINITY, None).unwrap();
        assert!((hit.point - target).length() < 4e-16 * distance + 1e-7, "{distance}: {hit:?}");
    }
}
