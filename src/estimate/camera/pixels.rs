//! Runs of neighbouring pixels: their rays sixteen at a time, whichever pixel they belong to.
//!
//! ```text
//! E_g = ⟨w L⟩_g + β_g (W₀ − ⟨w⟩_g)        W₀: mean weight of the pixel in closed form, β_g: mean radiance that the other groups found
//! ```
//!
//! The other groups know nothing of the numbers of this one, so the estimate is unbiased; where a pixel sees one radiance it has no spread.

use multiversion::multiversion;

use super::Stage;
use super::view::PixelStart;
use crate::estimate::Counters;
use crate::estimate::paths::{PathScene, trace};
use crate::geometry::rays::{LANES, NONE, Rays};
use crate::math::random::{Stream, four_in_lanes};
use crate::metrology::Replicates;
use crate::plan::spectral::SpectralPlan;

/// The branch of the random numbers that cameras have to themselves.
pub(super) const BRANCH: u64 = 0x6361_6d65_7261;

/// Neighbouring pixels of a row.
pub(super) struct Run {
    pub(super) row: usize,
    pub(super) first: usize,
    pub(super) count: usize,
}

/// What they receive.
pub(super) struct Pixels {
    /// Value and standard uncertainty: for each pixel its planes, then its luminance.
    pub(super) values: Vec<(f64, f64)>,
    pub(super) counters: Counters,
}

impl Stage<'_> {
    /// Renders a run; none if a path found no end.
    pub(super) fn render(&self, run: &Run) -> Option<Pixels> {
        let (groups, points) = (self.sampling.groups, f64::from(self.sampling.points));
        let planes = self.view.camera.planes();
        let width = planes + 1;
        let samples = run.count as u64 * self.sampling.samples();
        let mut counters = Counters { rays: samples, samples, ..Counters::default() };
        // For each pixel, each group: planes, luminance, weight.
        let mut sums = vec![0.0; run.count * groups * (width + 1)];
        primary(self, run, &mut sums);
        let mut values = Vec::with_capacity(run.count * width);
        let mut of_groups = vec![0.0; groups];
        for (i, of_pixel) in sums.chunks_exact_mut(groups * (width + 1)).enumerate() {
            let column = run.first + i;
            let wanted = self.wanted(column, run.row);
            if let (Some(paths), Some(spectral)) = (&self.paths, &self.plan.spectral) {
                let start = PixelStart { view: &self.view, column, row: run.row };
                let streams = self.streams(column, run.row);
                let found = trace(paths, &start, &streams, (0, self.sampling.points));
                if found.endless {
                    return None;
                }
                counters.rays += found.rays;
                counters.escaped_paths += found.escaped;
                add_paths(paths, spectral, &found.sums, &wanted, of_pixel);
            }
            let image = self.images.of_pixel(column, run.row);
            let image_of =
                |group: usize, k: usize| image.map_or(0.0, |of_groups| of_groups[group * self.plan.responsivities.len() + wanted[k]]);
            let known = self.view.camera.mean_weight_sr(column, run.row);
            for k in 0..width {
                let all = of_pixel.chunks_exact(width + 1).fold((0.0, 0.0), |(sum, weight), sums| (sum + sums[k], weight + sums[width]));
                for (group, (value, sums)) in of_groups.iter_mut().zip(of_pixel.chunks_exact(width + 1)).enumerate() {
                    let (per, weight) = (sums[k], sums[width]);
                    *value = match (k < planes, known, weight > 0.0) {
                        // The image of a point source has no part in the radiance that goes with the weight.
                        (true, Some(known), _) => {
                            image_of(group, k) + per / points + (all.0 - per) / (all.1 - weight) * (known - weight / points)
                        }
                        (true, None, _) => image_of(group, k) + per / points,
                        (false, _, true) => (points * image_of(group, k) + per) / weight,
                        // Micro-lenses that accept nothing here see nothing.
                        (false, _, false) => 0.0,
                    };
                }
                let found = Replicates::evaluate(&of_groups).map_or((f64::NAN, f64::NAN), |r| (r.mean, r.standard_uncertainty));
                values.push(found);
            }
        }
        Some(Pixels { values, counters })
    }

    /// The channels that a pixel records, and last that of luminance.
    fn wanted(&self, column: usize, row: usize) -> Vec<usize> {
        let camera = self.view.camera;
        let recorded = (0..camera.planes()).map(|plane| camera.channel_at(plane, column, row));
        recorded.chain([camera.channels.len()]).collect()
    }

    /// The random numbers of a pixel, a stream a group.
    fn streams(&self, column: usize, row: usize) -> Vec<Stream> {
        let pixel = self.stream(column, row);
        (0..self.sampling.groups as u64).map(|g| pixel.child(g)).collect()
    }

    #[inline(always)]
    fn stream(&self, column: usize, row: usize) -> Stream {
        let pixel = (row * self.view.camera.columns + column) as u64;
        Stream::new(self.seed, &[BRANCH, self.camera, self.sampling.set, pixel])
    }
}

/// What all rays of a run see at their first surface.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+avx2+fma", "x86_64+avx2+fma"))]
fn primary(stage: &Stage<'_>, run: &Run, sums: &mut [f64]) {
    let groups = stage.sampling.groups;
    let samples = stage.sampling.samples() as usize;
    let items = run.count * samples;
    let planes = stage.view.camera.planes();
    let stride = planes + 2;
    let wanted: Vec<Vec<usize>> = (0..run.count).map(|i| stage.wanted(run.first + i, run.row)).collect();
    let streams: Vec<Stream> = (0..run.count).map(|i| stage.stream(run.first + i, run.row)).collect();
    let mut rays = Rays::none();
    let mut u = [[0.0; LANES]; 4];
    let mut weight = [0.0; LANES];
    for start in (0..items).step_by(LANES) {
        let lanes = LANES.min(items - start);
        let item: [usize; LANES] = std::array::from_fn(|lane| start + lane.min(lanes - 1));
        let pixel = item.map(|i| i / samples);
        let group = item.map(|i| i % samples % groups);
        let index = item.map(|i| (i % samples / groups) as u32);
        let stream = std::array::from_fn(|lane| streams[pixel[lane]].child(group[lane] as u64));
        four_in_lanes(&stream, &index, &[0; LANES], &mut u);
        for lane in 0..LANES {
            rays.active[lane] = lane < lanes;
            let ray = stage.view.ray(run.first + pixel[lane], run.row, std::array::from_fn(|d| u[d][lane]));
            rays.origin.set(lane, ray.origin);
            rays.direction.set(lane, ray.direction);
            weight[lane] = ray.weight;
        }
        let hits = stage.world.closest(&rays);
        for lane in 0..lanes {
            let at = (pixel[lane] * groups + group[lane]) * stride;
            let (sums, wanted) = (&mut sums[at..at + stride], &wanted[pixel[lane]]);
            sums[planes + 1] += weight[lane];
            if hits.element[lane] == NONE {
                stage.shades.add_row(&stage.shades.sky, weight[lane], wanted, &mut sums[..=planes]);
                continue;
            }
            let direction = rays.direction.get(lane);
            let hit = stage.world.surface_point(rays.origin.get(lane), direction, hits.t[lane], hits.element[lane], hits.part[lane]);
            let front = hit.normal.dot(direction) < 0.0;
            let normal = if front { hit.normal } else { -hit.normal };
            stage.shades.add((hits.element[lane], front), hit.point, normal, weight[lane], wanted, &mut sums[..=planes]);
        }
    }
}

/// Adds what the paths of a pixel found, group by group.
fn add_paths(paths: &PathScene<'_>, spectral: &SpectralPlan, found: &[f64], wanted: &[usize], of_pixel: &mut [f64]) {
    let stride = wanted.len() + 1;
    for (sums, found) in of_pixel.chunks_exact_mut(stride).zip(found.chunks_exact(paths.width())) {
        for (sum, &channel) in sums.iter_mut().zip(wanted) {
            for (group, weights) in spectral.weights[channel].iter().enumerate() {
                *sum += paths.group(found, group).iter().zip(weights).map(|(s, w)| s * w).sum::<f64>();
            }
        }
    }
}
