//! Rays a second against triangle meshes, on one thread.
//!
//! With `ETENDUE_BENCH_CACHE` set to a folder with `s5_<size>.ply` and `rays_<size>_<kind>.f32` (little-endian `f32`, seven a ray: origin,
//! direction, `t_max`), these are traced, so that another engine can be timed on the same rays. Otherwise a generated bumpy sphere.

use criterion::{BenchmarkId, Criterion, Throughput};
use etendue::geometry::bvh::{Bvh, NO_TRIANGLE, Ray};
use etendue::geometry::mesh::Mesh;
use etendue::math::DVec3;
use etendue::scene::mesh_file::{MeshData, parse_ply};
use std::hint::black_box;
use std::path::Path;

/// Rays of one kind in one round; enough to defeat the caches.
const ROUND: usize = 1 << 17;

fn main() {
    let mut criterion = Criterion::default().sample_size(10).configure_from_args();
    match std::env::var_os("ETENDUE_BENCH_CACHE") {
        Some(folder) => {
            for size in ["small", "large"] {
                from_files(&mut criterion, Path::new(&folder), size);
            }
        }
        None => {
            let data = bumpy_sphere(700);
            let rays = inward_rays(ROUND);
            trace(&mut criterion, "bumpy sphere", &data, &[("inward", rays)]);
        }
    }
    criterion.final_summary();
}

fn from_files(criterion: &mut Criterion, folder: &Path, size: &str) {
    let path = folder.join(format!("s5_{size}.ply"));
    let bytes = std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    criterion.bench_function(&format!("{size}/read PLY"), |b| b.iter(|| parse_ply(black_box(&bytes)).map(|mesh| mesh.triangles.len())));
    let data = parse_ply(&bytes).unwrap_or_else(|problems| panic!("{}: {problems}", path.display()));
    let kinds: Vec<(&str, Vec<Ray>)> = ["coherent", "incoherent", "scatter", "shadow"]
        .into_iter()
        .filter_map(|kind| Some((kind, read_rays(&folder.join(format!("rays_{size}_{kind}.f32")))?)))
        .collect();
    trace(criterion, size, &data, &kinds);
}

fn trace(criterion: &mut Criterion, name: &str, data: &MeshData, kinds: &[(&str, Vec<Ray>)]) {
    let mut group = criterion.benchmark_group(name);
    let vertices: Vec<[f32; 3]> = data.points.iter().map(|p| p.as_vec3().to_array()).collect();
    group.bench_function("build", |b| b.iter(|| Bvh::build(&vertices, &data.triangles)));
    let bvh = Bvh::build(&vertices, &data.triangles);
    let mesh = Mesh::new(&data.points, data.triangles.clone()).unwrap_or_else(|error| panic!("{error}"));
    for (kind, rays) in kinds {
        // Every so many, so that coherent rays stay neighbours of one row.
        let rays = &rays[rays.len().saturating_sub(ROUND) / 2..][..rays.len().min(ROUND)];
        group.throughput(Throughput::Elements(rays.len() as u64));
        group.bench_with_input(BenchmarkId::new("closest", kind), rays, |b, rays| {
            b.iter(|| rays.iter().filter(|ray| bvh.closest(ray).is_some()).count())
        });
        group.bench_with_input(BenchmarkId::new("blocked", kind), rays, |b, rays| {
            b.iter(|| rays.iter().filter(|ray| bvh.blocked(ray)).count())
        });
        let in_world: Vec<(DVec3, DVec3, f64)> = rays.iter().map(world).collect();
        group.bench_with_input(BenchmarkId::new("mesh closest", kind), &in_world, |b, rays| {
            b.iter(|| rays.iter().filter(|(o, d, t)| mesh.closest(*o, *d, *t, None).is_some()).count());
        });
        group.bench_with_input(BenchmarkId::new("mesh blocked", kind), &in_world, |b, rays| {
            b.iter(|| rays.iter().filter(|(o, d, t)| mesh.blocked(*o, *d, *t, None, None)).count());
        });
    }
    group.finish();
}

/// The ray with a unit direction in double precision.
fn world(ray: &Ray) -> (DVec3, DVec3, f64) {
    let [origin, direction] = [ray.origin, ray.direction].map(|v| DVec3::from_array(v.map(f64::from)));
    let length = direction.length();
    (origin, direction / length, f64::from(ray.t_max) * length)
}

fn read_rays(path: &Path) -> Option<Vec<Ray>> {
    let bytes = std::fs::read(path).ok()?;
    let (numbers, _) = bytes.as_chunks::<4>();
    let numbers: Vec<f32> = numbers.iter().map(|word| f32::from_le_bytes(*word)).collect();
    let (rays, _) = numbers.as_chunks::<7>();
    Some(
        rays.iter()
            .map(|&[ox, oy, oz, dx, dy, dz, t_max]| Ray {
                origin: [ox, oy, oz],
                direction: [dx, dy, dz],
                t_min: 0.0,
                t_max,
                skip: [NO_TRIANGLE; 2],
            })
            .collect(),
    )
}

/// A sphere of `2 n^2` triangles by latitude and longitude, with hills.
fn bumpy_sphere(n: u32) -> MeshData {
    let mut data = MeshData::default();
    for j in 0..=n {
        for i in 0..n {
            let (theta, phi) = (std::f64::consts::PI * f64::from(j) / f64::from(n), std::f64::consts::TAU * f64::from(i) / f64::from(n));
            let r = 1.0 + 0.1 * (9.0 * theta).sin() * (7.0 * phi).sin();
            data.points.push(DVec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()) * r);
            if j < n {
                let (a, b) = (j * n + i, j * n + (i + 1) % n);
                data.triangles.extend([[a, a + n, b + n], [a, b + n, b]]);
            }
        }
    }
    data
}

/// Rays from inside in directions of a Fibonacci lattice, hence incoherent.
fn inward_rays(count: usize) -> Vec<Ray> {
    let golden = std::f64::consts::TAU * 0.618_033_988_749_895;
    (0..count)
        .map(|i| {
            let (z, phi) = (1.0 - (2 * i + 1) as f64 / count as f64, golden * i as f64);
            let s = (1.0 - z * z).sqrt();
            let direction = [s * phi.cos(), s * phi.sin(), z].map(|x| x as f32);
            Ray { origin: [0.1, 0.2, 0.3], direction, t_min: 0.0, t_max: f32::INFINITY, skip: [NO_TRIANGLE; 2] }
        })
        .collect()
}
