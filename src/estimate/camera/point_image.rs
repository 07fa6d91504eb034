//! Images of sources without extent: no ray finds them by chance, so they are traced to the sensor.
//!
//! ```text
//! E_pixel = (1/A_pix) Σ_p (A_p/n) I cosθ/r² R(θ′) V(p → source)        parallel light: E₀ cosθ instead of I cosθ/r²
//! ```
//!
//! n points of the pupil, each with its share of the flux, which lands where the lens puts it: in one pixel where the source is in focus, on a
//! disc of blur where it is not. There are as many points as the disc has pixels, sixteen times.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use super::Sampling;
use super::pixels::BRANCH;
use super::shade::Shades;
use super::view::View;
use crate::estimate::Counters;
use crate::geometry::rays::{LANES, NONE, Rays};
use crate::geometry::world::World;
use crate::math::DVec3;
use crate::math::random::Stream;
use crate::scene::Scene;
use crate::source::{Emitter, Source};

/// Pupil points for each pixel of the disc of blur, and the fewest and most of them in a group.
const POINTS_PER_PIXEL: f64 = 16.0;
const FEWEST_POINTS: f64 = 256.0;
const MOST_POINTS: f64 = 1_048_576.0;

/// The images of all sources without extent.
#[derive(Default)]
pub(super) struct PointImages {
    columns: usize,
    /// By pixel: for each group, each channel, what is received.
    pixels: BTreeMap<usize, Vec<f64>>,
    pub(super) counters: Counters,
}

impl PointImages {
    pub(super) fn new(
        scene: &Scene,
        world: &World,
        view: &View<'_>,
        shades: &Shades<'_>,
        sampling: Sampling,
        seed: u64,
        camera: u64,
    ) -> PointImages {
        let mut images = PointImages { columns: view.camera.columns, ..PointImages::default() };
        for (s, source) in scene.sources.iter().enumerate() {
            let Some((slope, inverse_depth_1_m)) = place(view, source) else { continue };
            let stream = Stream::new(seed, &[BRANCH, camera, sampling.set, u64::MAX, s as u64]);
            for group in 0..sampling.groups {
                let image = Image { view, world, source, slope, inverse_depth_1_m, stream: stream.child(group as u64) };
                let mut rays = 0;
                for (pixel, irradiance) in image.trace(&mut rays) {
                    let weights = &shades.weights[s];
                    let sums = images.pixels.entry(pixel).or_insert_with(|| vec![0.0; sampling.groups * weights.len()]);
                    for (sum, weight) in sums[group * weights.len()..].iter_mut().zip(weights) {
                        *sum += irradiance * weight;
                    }
                }
                images.counters.rays += rays;
            }
        }
        images
    }

    /// What a pixel receives of them: channels of the first group, of the second, …
    pub(super) fn of_pixel(&self, column: usize, row: usize) -> Option<&[f64]> {
        self.pixels.get(&(row * self.columns + column)).map(Vec::as_slice)
    }
}

/// Slope to the right and up and one over the depth of a source without extent in front of the camera.
fn place(view: &View<'_>, source: &Source) -> Option<([f64; 2], f64)> {
    let (to, distant) = match source.emitter {
        Emitter::Point { at } => (at - view.at, false),
        Emitter::Directional { travels } => (-travels, true),
        Emitter::Area { .. } | Emitter::Environment => return None,
    };
    let depth = view.ahead.dot(to);
    let ahead = depth > 0.0;
    ahead.then(|| ([view.right.dot(to) / depth, view.up.dot(to) / depth], if distant { 0.0 } else { 1.0 / depth }))
}

struct Image<'a> {
    view: &'a View<'a>,
    world: &'a World,
    source: &'a Source,
    slope: [f64; 2],
    inverse_depth_1_m: f64,
    stream: Stream,
}

impl Image<'_> {
    /// Irradiance per unit of the source's density, pixel by pixel.
    fn trace(&self, rays_traced: &mut u64) -> BTreeMap<usize, f64> {
        let camera = self.view.camera;
        let radius_m = camera.lens.pupil_radius_m();
        let blur_pixels =
            camera.lens.image_distance_m() * radius_m * (camera.lens.vergence_1_m() - self.inverse_depth_1_m).abs() / camera.pitch_m;
        let points = (POINTS_PER_PIXEL * PI * blur_pixels * blur_pixels).clamp(FEWEST_POINTS, MOST_POINTS) as u32;
        let points = points.next_power_of_two();
        let share = camera.lens.pupil_area_m2() / f64::from(points) / (camera.pitch_m * camera.pitch_m);
        let mut found = BTreeMap::new();
        let mut rays = Rays::none();
        let mut landing = [(0, 0.0); LANES];
        for start in (0..points).step_by(LANES) {
            for lane in 0..LANES {
                let u = self.stream.four(start + lane as u32, 0);
                let pupil = self.view.pupil([u[0], u[1]]);
                let origin = self.view.pupil_point(pupil);
                let (direction, per_area) = self.arrives(origin);
                let image = camera.lens.image_of(self.slope, self.inverse_depth_1_m, pupil);
                rays.active[lane] = false;
                let Some((column, row)) = camera.pixel_at(image) else { continue };
                // Of the weight of a ray only the response of the micro-lens is left.
                let response = camera.weight_sr(image, pupil) / camera.lens.weight_sr(image, pupil);
                landing[lane] = (row * camera.columns + column, share * per_area * response);
                rays.active[lane] = landing[lane].1 > 0.0;
                rays.origin.set(lane, origin);
                rays.direction.set(lane, direction);
                rays.t_end[lane] = if matches!(self.source.emitter, Emitter::Point { .. }) { 1.0 } else { f64::INFINITY };
                rays.leaving[lane] = NONE;
            }
            *rays_traced += rays.active.iter().filter(|&&a| a).count() as u64;
            let blocked = self.world.blocked(&rays);
            for lane in (0..LANES).filter(|&lane| rays.active[lane] && !blocked[lane]) {
                *found.entry(landing[lane].0).or_insert(0.0) += landing[lane].1;
            }
        }
        found
    }

    /// From a point of the pupil to the source, and the irradiance of the pupil there.
    fn arrives(&self, pupil: DVec3) -> (DVec3, f64) {
        match self.source.emitter {
            Emitter::Point { at } => {
                let to = at - pupil;
                let r2 = to.length_squared();
                (to, self.view.ahead.dot(to).max(0.0) / (r2 * r2.sqrt()))
            }
            Emitter::Directional { travels } => (-travels, (-travels.dot(self.view.ahead)).max(0.0)),
            Emitter::Area { .. } | Emitter::Environment => (DVec3::ZERO, 0.0),
        }
    }
}
