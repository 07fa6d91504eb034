//! Images of sources without extent, and of those that are hardly larger than a pixel: rays from the pixels would not find them, so they
//! are traced to the sensor.
//!
//! ```text
//! E_pixel = (1/A_pix) Σ_p (A_p/n) E_p c R(θ′) V(p → source)        E_p = I cosθ/r², E₀ cosθ for parallel light, L A cosθ cosθ_s/r² for areas
//! c = cos⁴θ′ / cos⁴θ
//! ```
//!
//! n points of the pupil, each with its share of the flux, which lands where the lens puts it: in one pixel where the source is in focus, on a
//! disc of blur where it is not. There are as many points as the disc has pixels, sixteen times. Areas take a point of theirs with each.
//!
//! θ and θ′ are the angles before and behind the lens. What rays from the pixels see weighs `cosθ cosθ′/d²` behind the lens, as EMVA 1288 has
//! it (E = πLT/(4N² + 1)); an ideal thin lens does not keep the étendue of each ray, and c makes a point the limit of a small disc.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use super::Sampling;
use super::pixels::BRANCH;
use super::shade::Shades;
use super::view::View;
use crate::estimate::Counters;
use crate::estimate::light::Lights;
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

/// Areas whose image has a radius below so many pixels are traced from the source.
const SMALL_PIXELS: f64 = 2.0;

/// Which sources are traced to the sensor and not looked for from the pixels.
pub(super) fn traced(scene: &Scene, view: &View<'_>) -> Vec<bool> {
    scene.sources.iter().map(|source| place(scene, view, source).is_some()).collect()
}

/// The images of all sources without extent, and of small ones.
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
            let Some(inverse_depth_1_m) = place(scene, view, source) else { continue };
            let lights = Lights::new(scene, [(source, 0, 1.0)]);
            let stream = Stream::new(seed, &[BRANCH, camera, sampling.set, u64::MAX, s as u64]);
            for group in 0..sampling.groups {
                let image = Image { view, world, lights: &lights, inverse_depth_1_m, stream: stream.child(group as u64) };
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

/// One over the depth of a source that is traced to the sensor and lies in front of the camera.
fn place(scene: &Scene, view: &View<'_>, source: &Source) -> Option<f64> {
    match &source.emitter {
        Emitter::Point { at } => {
            let depth = view.ahead.dot(*at - view.at);
            (depth > 0.0).then(|| 1.0 / depth)
        }
        Emitter::Directional { travels } => (view.ahead.dot(-*travels) > 0.0).then_some(0.0),
        Emitter::Area { elements } => {
            let spheres = || elements.iter().map(|&(e, _)| scene.elements[e].shape.bounding_sphere());
            let centre = spheres().map(|(c, _)| c).sum::<DVec3>() / elements.len() as f64;
            let radius_m = spheres().map(|(c, r)| (c - centre).length() + r).fold(0.0, f64::max);
            let depth = view.ahead.dot(centre - view.at);
            let image_pixels = view.camera.lens.image_distance_m() * radius_m / depth / view.camera.pitch_m;
            (depth > radius_m && image_pixels < SMALL_PIXELS).then(|| 1.0 / depth)
        }
        Emitter::Environment => None,
    }
}

struct Image<'a> {
    view: &'a View<'a>,
    world: &'a World,
    lights: &'a Lights,
    /// Of the middle of the source: how wide the blur is.
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
                rays.active[lane] = false;
                let light = self.lights.sample(origin, [u[2], u[3]]);
                let distant = light.t_end.is_infinite();
                let to = if distant { light.to } else { origin + light.to - self.view.at };
                let (depth, towards) = (self.view.ahead.dot(to), self.view.ahead.dot(light.to));
                if depth <= 0.0 || towards <= 0.0 || light.weight <= 0.0 {
                    continue;
                }
                let slope = [self.view.right.dot(to) / depth, self.view.up.dot(to) / depth];
                let image = camera.lens.image_of(slope, if distant { 0.0 } else { 1.0 / depth }, pupil);
                let Some((column, row)) = camera.pixel_at(image) else { continue };
                // The weight of a ray of the pixel is A_p cos⁴θ′ R/v².
                let v = camera.lens.image_distance_m();
                let behind = camera.weight_sr(image, pupil) * v * v / camera.lens.pupil_area_m2();
                let before = (towards / light.to.length()).powi(4);
                landing[lane] = (row * camera.columns + column, share * light.weight * towards * behind / before);
                rays.active[lane] = landing[lane].1 > 0.0;
                rays.origin.set(lane, origin);
                rays.direction.set(lane, light.to);
                rays.t_end[lane] = light.t_end;
                rays.leaving[lane] = NONE;
                (rays.arriving[lane], rays.arriving_part[lane]) = (light.element, light.part);
            }
            *rays_traced += rays.active.iter().filter(|&&a| a).count() as u64;
            let blocked = self.world.blocked(&rays);
            for lane in (0..LANES).filter(|&lane| rays.active[lane] && !blocked[lane]) {
                *found.entry(landing[lane].0).or_insert(0.0) += landing[lane].1;
            }
        }
        found
    }
}
