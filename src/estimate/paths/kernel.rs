//! The loop over blocks of paths.

use std::f64::consts::PI;

use multiversion::multiversion;

use super::prepare::PathScene;
use super::start::Start;
use super::{ENDLESS, ROULETTE_AFTER};
use crate::geometry::rays::{LANES, NONE, Rays, Vectors};
use crate::math::DVec3;
use crate::math::frame::world_from_local;
use crate::math::random::{Stream, four_in_lanes};
use crate::math::sample::sample_cosine_hemisphere;

/// What a run of paths adds up.
#[derive(Clone, Debug)]
pub(in crate::estimate) struct PathSums {
    /// Replicates × width sums.
    pub(in crate::estimate) sums: Vec<f64>,
    /// Connections to the lights of each group as if nothing stood in their way: the scale of what may have been missed.
    pub(in crate::estimate) potential: Vec<f64>,
    /// Rays traced.
    pub(in crate::estimate) rays: u64,
    /// Paths that left the scene.
    pub(in crate::estimate) escaped: u64,
    /// A path that found no end: nothing absorbs its light.
    pub(in crate::estimate) endless: bool,
}

/// Traces the points `first .. first + count` of every stream, a stream a replicate.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+avx2+fma", "x86_64+avx2+fma"))]
pub(in crate::estimate) fn trace<S: Start>(scene: &PathScene<'_>, start: &S, streams: &[Stream], (first, count): (u32, u32)) -> PathSums {
    let row = scene.row;
    let width = scene.groups * row;
    let mut out =
        PathSums { sums: vec![0.0; streams.len() * width], potential: vec![0.0; scene.groups], rays: 0, escaped: 0, endless: false };
    let replicates = streams.len() as u64;
    let items = u64::from(count) * replicates;
    let mut next = 0u64;

    let mut block = Block::new(streams[0], row);
    let mut rays = Rays::none();
    let mut shadow = Rays::none();
    loop {
        for lane in 0..LANES {
            if block.alive[lane] || next == items {
                continue;
            }
            let replicate = (next % replicates) as usize;
            block.start(lane, replicate, streams[replicate], first + (next / replicates) as u32, start);
            next += 1;
        }
        if !block.alive.iter().any(|&a| a) {
            break;
        }
        let mut u = [[0.0; LANES]; 4];
        four_in_lanes(&block.stream, &block.index, &block.vertex, &mut u);

        connect(scene, &mut block, &mut shadow, &u, &mut out);

        let mut local = Vectors::ZERO;
        for lane in 0..LANES {
            local.set(lane, sample_cosine_hemisphere([u[0][lane], u[1][lane]]));
        }
        for lane in 0..LANES {
            let direction = world_from_local(block.normal.get(lane), local.get(lane));
            rays.direction.set(lane, direction);
        }
        for lane in 0..LANES {
            if !block.alive[lane] {
                continue;
            }
            if block.vertex[lane] == 0 {
                let ray = start.ray(std::array::from_fn(|d| u[d][lane]));
                block.point.set(lane, ray.origin);
                rays.direction.set(lane, ray.direction);
                block.weight[lane] = ray.weight;
                block.alive[lane] = block.weight[lane] > 0.0;
            } else if block.vertex[lane] >= scene.most_reflections && scene.skies.is_empty() {
                block.alive[lane] = false;
            } else if block.vertex[lane] > ROULETTE_AFTER {
                let p = block.survival[lane];
                block.alive[lane] = block.roulette(lane) < p;
                block.weight[lane] /= p;
            }
        }
        rays.origin = block.point;
        rays.leaving = block.element;
        rays.leaving_part = block.part;
        rays.active = block.alive;
        out.rays += block.alive.iter().filter(|&&a| a).count() as u64;
        let hits = scene.world.closest(&rays);
        for lane in 0..LANES {
            if !block.alive[lane] {
                continue;
            }
            let element = hits.element[lane];
            if element != NONE && block.vertex[lane] >= scene.most_reflections {
                block.alive[lane] = false;
                continue;
            }
            if element == NONE {
                out.escaped += 1;
                block.alive[lane] = false;
                if block.vertex[lane] > scene.sky_known_to {
                    for &group in &scene.skies {
                        // (ρ/π) cosθ over the density cosθ/π leaves ρ; the environment's radiance is the unit.
                        block.add(lane, group, block.weight[lane], width, row, &mut out.sums);
                    }
                }
                continue;
            }
            let (origin, direction) = (rays.origin.get(lane), rays.direction.get(lane));
            let hit = scene.world.surface_point(origin, direction, hits.t[lane], element, hits.part[lane]);
            let front = hit.normal.dot(direction) < 0.0;
            let surface = scene.surfaces[element as usize][usize::from(!front)] as usize;
            block.survival[lane] = scene.survival[surface];
            if scene.survival[surface] <= 0.0 {
                block.alive[lane] = false;
                continue;
            }
            let reflectance = &scene.reflectance[surface * row..(surface + 1) * row];
            let carried = &mut block.carried[lane * row..(lane + 1) * row];
            if block.vertex[lane] == 0 {
                carried.copy_from_slice(reflectance);
            } else {
                for (c, r) in carried.iter_mut().zip(reflectance) {
                    *c *= r;
                }
            }
            block.point.set(lane, hit.point);
            block.normal.set(lane, if front { hit.normal } else { -hit.normal });
            block.element[lane] = element;
            block.part[lane] = hits.part[lane];
            block.vertex[lane] += 1;
            block.lossless[lane] = if scene.survival[surface] < 1.0 { 0 } else { block.lossless[lane] + 1 };
            out.endless |= block.lossless[lane] > ENDLESS;
        }
        if out.endless {
            break;
        }
    }
    out
}

/// Connects every lane that stands on a surface to a light, and adds what arrives.
#[inline(always)]
fn connect(scene: &PathScene<'_>, block: &mut Block, shadow: &mut Rays, u: &[[f64; LANES]; 4], out: &mut PathSums) {
    if scene.lights.is_empty() {
        return;
    }
    let first = scene.first_lights.as_ref().unwrap_or(&scene.lights);
    let mut arrives = [0.0; LANES];
    let mut group = [0u32; LANES];
    let mut any = false;
    for lane in 0..LANES {
        shadow.active[lane] = false;
        if !block.alive[lane] || block.vertex[lane] == 0 {
            continue;
        }
        let lights = if block.vertex[lane] == 1 { first } else { &scene.lights };
        if lights.is_empty() {
            continue;
        }
        let light = lights.sample(block.point.get(lane), [u[2][lane], u[3][lane]]);
        let irradiance = light.weight * block.normal.get(lane).dot(light.to);
        if light.weight > 0.0 && irradiance > 0.0 {
            // ρ/π times the irradiance; ρ is in the carried spectrum.
            arrives[lane] = block.weight[lane] * irradiance / PI;
            group[lane] = light.group;
            shadow.active[lane] = true;
            shadow.direction.set(lane, light.to);
            shadow.t_end[lane] = light.t_end;
            shadow.arriving[lane] = light.element;
            shadow.arriving_part[lane] = light.part;
            out.potential[light.group as usize] += arrives[lane];
            out.rays += 1;
            any = true;
        }
    }
    if !any {
        return;
    }
    shadow.origin = block.point;
    shadow.leaving = block.element;
    shadow.leaving_part = block.part;
    let blocked = scene.world.blocked(shadow);
    let width = scene.groups * scene.row;
    for lane in 0..LANES {
        if shadow.active[lane] && !blocked[lane] {
            block.add(lane, group[lane], arrives[lane], width, scene.row, &mut out.sums);
        }
    }
}

/// Sixteen paths.
struct Block {
    alive: [bool; LANES],
    stream: [Stream; LANES],
    replicate: [usize; LANES],
    index: [u32; LANES],
    /// Reflections so far.
    vertex: [u32; LANES],
    /// Of these, the last ones in a row that absorbed nothing.
    lossless: [u32; LANES],
    /// W and 1/p.
    weight: [f64; LANES],
    survival: [f64; LANES],
    point: Vectors,
    normal: Vectors,
    element: [u32; LANES],
    part: [u32; LANES],
    /// Products of reflectances at the nodes, a row a lane.
    carried: Vec<f64>,
}

impl Block {
    fn new(stream: Stream, row: usize) -> Block {
        Block {
            alive: [false; LANES],
            stream: [stream; LANES],
            replicate: [0; LANES],
            index: [0; LANES],
            vertex: [0; LANES],
            lossless: [0; LANES],
            weight: [0.0; LANES],
            survival: [0.0; LANES],
            point: Vectors::ZERO,
            normal: Vectors { x: [0.0; LANES], y: [0.0; LANES], z: [1.0; LANES] },
            element: [NONE; LANES],
            part: [NONE; LANES],
            carried: vec![0.0; row * LANES],
        }
    }

    #[inline(always)]
    fn start(&mut self, lane: usize, replicate: usize, stream: Stream, index: u32, start: &impl Start) {
        self.alive[lane] = true;
        self.stream[lane] = stream;
        self.replicate[lane] = replicate;
        self.index[lane] = index;
        self.vertex[lane] = 0;
        self.lossless[lane] = 0;
        self.point.set(lane, DVec3::ZERO);
        self.normal.set(lane, start.normal());
        [self.element[lane], self.part[lane]] = start.leaves();
    }

    /// A number of its own for the decision to go on, independent of the points.
    #[inline(always)]
    fn roulette(&self, lane: usize) -> f64 {
        self.stream[lane].child(u64::from(self.index[lane])).child(u64::from(self.vertex[lane])).number()
    }

    #[inline(always)]
    fn add(&self, lane: usize, group: u32, factor: f64, width: usize, row: usize, sums: &mut [f64]) {
        let start = self.replicate[lane] * width + group as usize * row;
        let carried = &self.carried[lane * row..(lane + 1) * row];
        for (sum, c) in sums[start..start + row].iter_mut().zip(carried) {
            *sum += factor * c;
        }
    }
}
