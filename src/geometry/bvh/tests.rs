//! Laws of the tree and its search.

use super::*;
use proptest::prelude::*;
use std::collections::BTreeMap;
use std::f32::consts::TAU;

/// An icosahedron whose triangles are split in four `level` times and pushed to the unit sphere, in double precision.
pub(crate) fn icosphere(level: usize) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let g = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let mut points = vec![[-1.0, g, 0.0], [1.0, g, 0.0], [-1.0, -g, 0.0], [1.0, -g, 0.0]];
    points.extend([[0.0, -1.0, g], [0.0, 1.0, g], [0.0, -1.0, -g], [0.0, 1.0, -g]]);
    points.extend([[g, 0.0, -1.0], [g, 0.0, 1.0], [-g, 0.0, -1.0], [-g, 0.0, 1.0]]);
    let mut triangles: Vec<[u32; 3]> = vec![[0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11], [1, 5, 9], [5, 11, 4]];
    triangles.extend([[11, 10, 2], [10, 7, 6], [7, 1, 8], [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9]]);
    triangles.extend([[4, 9, 5], [2, 4, 11], [6, 2, 10], [8, 6, 7], [9, 8, 1]]);
    for _ in 0..level {
        let mut middles = BTreeMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                let (p, q) = (points[a as usize], points[b as usize]);
                points.push(std::array::from_fn(|i| (p[i] + q[i]) / 2.0));
                points.len() as u32 - 1
            })
        };
        triangles = triangles
            .iter()
            .flat_map(|&[a, b, c]| {
                let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
                [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
            })
            .collect();
        points.iter_mut().for_each(|p| {
            let length = p.iter().map(|x| x * x).sum::<f64>().sqrt();
            p.iter_mut().for_each(|x| *x /= length);
        });
    }
    (points, triangles)
}

/// A closed surface with hills and valleys that its centre sees from end to end.
pub(crate) fn bumpy_icosphere(level: usize) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let (mut points, triangles) = icosphere(level);
    for p in &mut points {
        let r = 1.0 + 0.1 * (11.0 * p[0] + 2.0).sin() * (13.0 * p[1]).sin() * (9.0 * p[2] + 1.0).sin();
        *p = p.map(|x| r * x);
    }
    (points, triangles)
}

/// A stream of numbers in 0..1 (splitmix64).
pub(crate) struct Stream(pub(crate) u64);

impl Stream {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A point on the unit sphere.
    pub(crate) fn direction(&mut self) -> [f64; 3] {
        let z = 2.0 * self.next() - 1.0;
        let (r, phi) = ((1.0 - z * z).sqrt(), f64::from(TAU) * self.next());
        [r * phi.cos(), r * phi.sin(), z]
    }
}

fn ray(origin: [f32; 3], direction: [f32; 3]) -> Ray {
    Ray { origin, direction, t_min: 0.0, t_max: f32::INFINITY, skip: [NO_TRIANGLE; 2] }
}

fn towards(from: [f32; 3], to: [f32; 3]) -> Ray {
    ray(from, std::array::from_fn(|i| to[i] - from[i]))
}

#[test]
fn no_ray_escapes_through_a_vertex_or_an_edge_of_a_closed_mesh() {
    let (points, triangles) = bumpy_icosphere(4);
    for (radius, shift) in [(1.0, 0.0), (1.0, 1e4), (1e-4, 0.0), (1e-9, 0.0), (1e9, 0.0)] {
        let vertices: Vec<[f32; 3]> = points.iter().map(|p| p.map(|x| (x * radius + shift) as f32)).collect();
        let bvh = Bvh::build(&vertices, &triangles);
        let mut stream = Stream(1);
        for i in 0..100_000_usize {
            let corners = triangles[i % triangles.len()].map(|k| vertices[k as usize]);
            let share = stream.next() as f32;
            let inside = stream.direction().map(|x| (0.3 * stream.next() * radius * x + shift) as f32);
            let target = match i % 3 {
                0 => corners[0],
                1 => std::array::from_fn(|k| 0.5 * (corners[0][k] + corners[1][k])),
                _ => std::array::from_fn(|k| corners[1][k] + share * (corners[2][k] - corners[1][k])),
            };
            let ray = towards(inside, target);
            assert!(bvh.closest(&ray).is_some(), "radius {radius}, shift {shift}: {ray:?} escapes");
            assert!(bvh.blocked(&ray));
        }
    }
}

/// Crossing in double precision: distance, barycentrics, cosine between ray and normal.
fn crossing(ray: &Ray, corners: [[f32; 3]; 3]) -> (f64, [f64; 3], f64) {
    use crate::math::DVec3;
    let vector = |v: [f32; 3]| DVec3::from_array(v.map(f64::from));
    let (o, d) = (vector(ray.origin), vector(ray.direction));
    let [a, b, c] = corners.map(|v| vector(v) - o);
    let volume = [d.dot(c.cross(b)), d.dot(a.cross(c)), d.dot(b.cross(a))];
    let sum: f64 = volume.iter().sum();
    let weights = volume.map(|v| v / sum);
    let normal = (b - a).cross(c - a);
    let point = a * weights[0] + b * weights[1] + c * weights[2];
    (point.dot(d) / d.length_squared(), weights, normal.dot(d) / (normal.length() * d.length()))
}

/// The nearest triangle that the ray crosses well inside and not at grazing incidence, by trying all.
fn clear_hit(ray: &Ray, vertices: &[[f32; 3]], triangles: &[[u32; 3]]) -> f64 {
    let all = triangles.iter().enumerate().map(|(i, t)| (i as u32, crossing(ray, t.map(|k| vertices[k as usize]))));
    all.filter(|(i, (t, weights, cosine))| {
        weights.iter().all(|w| *w > 1e-3)
            && cosine.abs() > 1e-3
            && *t > f64::from(ray.t_min)
            && *t < f64::from(ray.t_max)
            && !ray.skip.contains(i)
    })
    .fold(f64::INFINITY, |nearest, (_, (t, ..))| nearest.min(t))
}

fn coordinate() -> impl Strategy<Value = f32> {
    prop_oneof![4 => -1.0_f32..1.0, 1 => prop::sample::select(vec![-1.0_f32, -0.5, -0.0, 0.0, 0.5, 1.0])]
}

fn point() -> impl Strategy<Value = [f32; 3]> {
    [coordinate(), coordinate(), coordinate()]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn the_tree_finds_what_trying_every_triangle_finds(
        vertices in prop::collection::vec(point(), 3..200),
        picks in prop::collection::vec([any::<prop::sample::Index>(), any::<prop::sample::Index>(), any::<prop::sample::Index>()], 0..300),
        rays in prop::collection::vec((point(), point(), 0.0_f32..0.5, 0.5_f32..4.0), 40),
    ) {
        let triangles: Vec<[u32; 3]> = picks.iter().map(|p| p.map(|i| i.index(vertices.len()) as u32)).collect();
        let bvh = Bvh::build(&vertices, &triangles);
        let portable = bvh.clone().portable();
        for (origin, direction, t_min, t_max) in rays {
            let ray = Ray { t_min, t_max, skip: [0, NO_TRIANGLE], ..ray(origin, direction) };
            let hit = bvh.closest(&ray);
            prop_assert_eq!(hit, portable.closest(&ray));
            prop_assert_eq!(hit.is_some(), bvh.blocked(&ray));
            prop_assert_eq!(hit.is_some(), portable.blocked(&ray));
            let length = direction.iter().map(|x| f64::from(x * x)).sum::<f64>().sqrt();
            let clear = clear_hit(&ray, &vertices, &triangles);
            match hit {
                None => prop_assert!(clear == f64::INFINITY || (clear - f64::from(t_max)).abs() < 1e-3 || (clear - f64::from(t_min)).abs() < 1e-3, "missed {}", clear),
                Some(hit) => {
                    prop_assert!(hit.triangle != 0 && hit.t > t_min && hit.t < t_max);
                    prop_assert!((f64::from(hit.t) - clear) * length < 1e-3, "{hit:?} is behind {clear}");
                    let corners = triangles[hit.triangle as usize].map(|k| vertices[k as usize]);
                    for axis in 0..3 {
                        let on_ray = f64::from(origin[axis]) + f64::from(hit.t) * f64::from(direction[axis]);
                        let on_triangle: f64 = (0..3).map(|k| f64::from(hit.barycentric[k]) * f64::from(corners[k][axis])).sum();
                        prop_assert!((on_ray - on_triangle).abs() < 1e-4, "axis {axis}: {on_ray} {on_triangle}");
                    }
                }
            }
        }
    }

    #[test]
    fn any_bits_as_coordinates_make_no_panic(
        vertices in prop::collection::vec([any::<u32>(), any::<u32>(), any::<u32>()], 1..60),
        triangles in prop::collection::vec([0_u32..70, 0_u32..70, 0_u32..70], 0..100),
        rays in prop::collection::vec([any::<u32>(), any::<u32>(), any::<u32>(), any::<u32>(), any::<u32>(), any::<u32>(), any::<u32>(), any::<u32>()], 20),
    ) {
        let vertices: Vec<[f32; 3]> = vertices.iter().map(|v| v.map(f32::from_bits)).collect();
        let bvh = Bvh::build(&vertices, &triangles);
        let portable = bvh.clone().portable();
        for bits in rays {
            let x = bits.map(f32::from_bits);
            let ray = Ray { t_min: x[6], t_max: x[7], ..ray([x[0], x[1], x[2]], [x[3], x[4], x[5]]) };
            let bits = |hit: Option<Hit>| hit.map(|h| (h.t.to_bits(), h.triangle, h.barycentric.map(f32::to_bits)));
            prop_assert_eq!(bits(bvh.closest(&ray)), bits(portable.closest(&ray)));
            prop_assert_eq!(bvh.blocked(&ray), portable.blocked(&ray));
        }
    }
}

#[test]
fn both_versions_return_the_same_bits_on_a_large_mesh() {
    let (points, triangles) = bumpy_icosphere(5);
    let vertices: Vec<[f32; 3]> = points.iter().map(|p| p.map(|x| x as f32)).collect();
    let bvh = Bvh::build(&vertices, &triangles);
    let portable = bvh.clone().portable();
    let mut stream = Stream(2);
    for _ in 0..20_000 {
        let origin = stream.direction().map(|x| (1.5 * x) as f32);
        let ray = ray(origin, stream.direction().map(|x| x as f32));
        let bits = |hit: Option<Hit>| hit.map(|h| (h.t.to_bits(), h.triangle, h.barycentric.map(f32::to_bits)));
        assert_eq!(bits(bvh.closest(&ray)), bits(portable.closest(&ray)));
        assert_eq!(bvh.blocked(&ray), portable.blocked(&ray));
    }
}

#[test]
fn every_triangle_is_in_exactly_one_leaf() {
    let (points, triangles) = bumpy_icosphere(3);
    let vertices: Vec<[f32; 3]> = points.iter().map(|p| p.map(|x| x as f32)).collect();
    let bvh = Bvh::build(&vertices, &triangles);
    let mut found: Vec<u32> = bvh.packets.iter().flat_map(|p| p.triangle).filter(|&t| t != NO_TRIANGLE).collect();
    found.sort_unstable();
    assert_eq!(found, (0..triangles.len() as u32).collect::<Vec<_>>());
    assert_eq!(bvh.triangle_count(), triangles.len());
}

#[test]
fn coincident_triangles_make_a_tree_of_bounded_depth() {
    let vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    for count in [1, 8, 9, 5_000, 70_000] {
        let bvh = Bvh::build(&vertices, &vec![[0, 1, 2]; count]);
        assert!(bvh.depth() <= build::DEPTH_LIMIT, "{count}: {}", bvh.depth());
        assert_eq!(bvh.triangle_count(), count);
        let hit = bvh.closest(&ray([0.2, 0.2, 1.0], [0.0, 0.0, -1.0]));
        assert_eq!(hit.map(|h| h.t), Some(1.0));
        assert!(!bvh.blocked(&ray([0.7, 0.7, 1.0], [0.0, 0.0, -1.0])));
    }
}

#[test]
fn a_ribbon_of_equal_cells_is_hit_cell_by_cell() {
    let cells = 20_000_u32;
    let vertices: Vec<[f32; 3]> = (0..=cells).flat_map(|i| [[i as f32, 0.0, 0.0], [i as f32, 1.0, 0.0]]).collect();
    let triangles: Vec<[u32; 3]> = (0..cells).flat_map(|i| [[2 * i, 2 * i + 2, 2 * i + 3], [2 * i, 2 * i + 3, 2 * i + 1]]).collect();
    let bvh = Bvh::build(&vertices, &triangles);
    assert!(bvh.depth() <= 10, "{}", bvh.depth());
    for i in (0..cells).step_by(37) {
        let hit = bvh.closest(&ray([i as f32 + 0.75, 0.25, 1.0], [0.0, 0.0, -1.0]));
        assert_eq!(hit.map(|h| h.triangle), Some(2 * i));
    }
}

#[test]
fn a_row_of_ever_larger_triangles_makes_a_tree_of_bounded_depth() {
    let vertices: Vec<[f32; 3]> = (0..3_000)
        .flat_map(|i| {
            let x = 1.01_f32.powi(i);
            [[x, 0.0, 0.0], [x, x, 0.0], [x, 0.0, x]]
        })
        .collect();
    let triangles: Vec<[u32; 3]> = (0..3_000).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let bvh = Bvh::build(&vertices, &triangles);
    assert!(bvh.depth() <= build::DEPTH_LIMIT);
    let hit = bvh.closest(&ray([0.0, 0.1, 0.1], [1.0, 0.0, 0.0]));
    assert_eq!(hit.map(|h| h.triangle), Some(0));
}

#[test]
fn a_ray_along_an_axis_hits_a_wall_edge_on_its_boxes() {
    // Boxes without thickness, planes through the origin of the ray: 0 * inf in the slabs.
    let vertices = [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 1.0, 1.0], [0.0, 1.0, 1.0]];
    let bvh = Bvh::build(&vertices, &[[0, 1, 2], [0, 2, 3]]);
    for (x, y) in [(0.0, 0.0), (1.0, 0.0), (0.5, 0.5), (0.0, 1.0), (1.0, 0.25)] {
        for zero in [0.0, -0.0] {
            assert_eq!(bvh.closest(&ray([x, y, 0.0], [zero, -zero, 1.0])).map(|h| h.t), Some(1.0), "{x} {y}");
            assert_eq!(bvh.closest(&ray([x, y, 2.0], [zero, zero, -0.5])).map(|h| h.t), Some(2.0), "{x} {y}");
        }
    }
}

#[test]
fn slivers_of_aspect_a_million_are_hit_and_leak_nothing() {
    // A unit square cut into a fan of slivers along one side.
    let n = 1_000_u32;
    let mut vertices = vec![[0.0, 0.0, 0.0]];
    vertices.extend((0..=n).map(|i| [1.0, i as f32 * 1e-6, 0.0]));
    let triangles: Vec<[u32; 3]> = (1..=n).map(|i| [0, i, i + 1]).collect();
    let bvh = Bvh::build(&vertices, &triangles);
    let mut stream = Stream(3);
    for _ in 0..20_000 {
        let x = 0.1 + 0.8 * stream.next() as f32;
        let target = [x, x * 9.9e-4 * stream.next() as f32, 0.0];
        assert!(bvh.blocked(&towards([0.3, 0.2, 1.0], target)), "{target:?}");
    }
}

#[test]
fn nothing_is_hit_in_an_empty_tree_or_by_a_ray_without_direction() {
    let empty = Bvh::build(&[], &[]);
    assert_eq!(empty.closest(&ray([0.0; 3], [0.0, 0.0, 1.0])), None);
    let one = Bvh::build(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &[[0, 1, 2]]);
    for direction in [[0.0; 3], [f32::NAN, 0.0, 1.0], [0.0, 0.0, f32::INFINITY]] {
        assert!(!one.blocked(&ray([0.2, 0.2, -1.0], direction)));
    }
    assert!(one.blocked(&ray([0.2, 0.2, -1.0], [0.0, 0.0, 1.0])));
}
