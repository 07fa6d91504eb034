//! What the pixels of a camera receive, by rays through its pupil.
//!
//! ```text
//! E_c = ⟨ w Σ_k L_c(ray_k) ⟩            w = A_p cosθ cosθ′/d² R(θ′) (`sensor::camera`), mean over pixel and pupil
//! L_c = L_emitted + (ρ/π) E_first + further reflections
//! ```
//!
//! | file | what |
//! |---|---|
//! | `view.rs` | pixel and pupil → ray |
//! | `shade.rs` | what a ray from the pupil sees: emission, and first reflections with a formula |
//! | `lambert.rs` | the irradiance of polygons, fast |
//! | `point_image.rs` | images of sources without extent |
//! | `pixels.rs` | runs of pixels |
//!
//! Every pixel has random numbers of its own, in a few independent groups of low-discrepancy points; the uncertainty of a pixel is the
//! spread of its groups. Pixels are independent of each other and of the order in which they are rendered.

mod lambert;
mod pixels;
mod point_image;
mod shade;
mod view;

use super::paths::PathScene;
use super::run::in_order;
use super::{Counters, EstimateError, Watch};
use crate::geometry::world::World;
use crate::plan::Plan;
use crate::plan::camera::{CameraPlan, FirstReflection};
use crate::scene::{PlacedCamera, Scene};
use pixels::{Pixels, Run};
use point_image::PointImages;
use shade::Shades;
use view::View;

/// Pixels of a piece of work.
const RUN: usize = 512;
/// Pieces between two reports of progress.
const PORTION: usize = 256;

/// A rectangle of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Area {
    /// First column.
    pub x: usize,
    /// First row.
    pub y: usize,
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
}

/// Samples of a pixel: independent groups of so many low-discrepancy points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sampling {
    /// Groups, at least two; their spread is the uncertainty.
    pub groups: usize,
    /// Points of a group, a power of two.
    pub points: u32,
    /// Which of the independent sets of random numbers.
    pub set: u64,
}

impl Default for Sampling {
    fn default() -> Sampling {
        Sampling { groups: 4, points: 2, set: 0 }
    }
}

impl Sampling {
    /// So many samples a pixel, rounded up: in four groups, from 64 on in sixteen.
    #[must_use]
    pub fn of(samples: u64) -> Sampling {
        let groups = if samples < 64 { 4 } else { 16 };
        let points = samples.div_ceil(groups as u64).clamp(1, 1 << 24).next_power_of_two();
        Sampling { groups, points: points as u32, set: 0 }
    }

    /// Samples of a pixel.
    #[must_use]
    pub fn samples(&self) -> u64 {
        self.groups as u64 * u64::from(self.points)
    }
}

/// What the pixels of areas receive, area by area; rows from the top, columns from the left.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rendered {
    /// For each plane (one behind a mosaic, else one a channel), each pixel: ∫ s_c E dλ, electrons per second and square metre.
    pub planes: Vec<Vec<f64>>,
    /// Standard uncertainties from the spread of the groups.
    pub plane_uncertainties: Vec<Vec<f64>>,
    /// The mean luminance of what each pixel sees, cd/m².
    pub luminance: Vec<f64>,
    /// Its standard uncertainty.
    pub luminance_uncertainty: Vec<f64>,
    /// What was done.
    pub counters: Counters,
}

/// Renders areas of the image of a camera, one after the other; the plan must be one of this scene.
///
/// # Errors
/// When light is never absorbed.
pub fn render(
    scene: &Scene,
    plan: &Plan,
    camera: usize,
    areas: &[Area],
    sampling: Sampling,
    seed: u64,
    watch: &Watch<'_>,
) -> Result<Rendered, EstimateError> {
    let (placed, plan) = (&scene.cameras[camera], &plan.cameras[camera]);
    let world = World::new(scene.elements.iter().map(|e| &e.shape));
    let stage = Stage::new(scene, placed, plan, &world, camera as u64, sampling, seed);
    let runs: Vec<Run> = areas.iter().flat_map(Area::runs).collect();
    let planes = placed.camera.planes();
    let mut rendered = Rendered { planes: vec![Vec::new(); planes], plane_uncertainties: vec![Vec::new(); planes], ..Rendered::default() };
    for (k, portion) in runs.chunks(PORTION).enumerate() {
        for found in in_order(portion, |run| stage.render(run)) {
            rendered.append(found.ok_or_else(|| EstimateError::Endless { instrument: placed.name.clone() })?);
        }
        (watch.progress)(((k + 1) * PORTION).min(runs.len()) as f64 / runs.len() as f64);
    }
    rendered.counters.add(&stage.images.counters);
    rendered.counters.bvh_nodes = world.bvh_nodes() as u64;
    rendered.counters.spectral_nodes =
        if stage.paths.is_some() { plan.spectral.as_ref().map_or(0, |s| s.wavelengths_nm.len() as u64) } else { 0 };
    Ok(rendered)
}

impl Area {
    /// Pixels of the area.
    #[must_use]
    pub fn pixels(&self) -> usize {
        self.width * self.height
    }

    /// Row by row, in pieces of work.
    fn runs(&self) -> impl Iterator<Item = Run> {
        let Area { x, y, width, height } = *self;
        (y..y + height)
            .flat_map(move |row| (x..x + width).step_by(RUN).map(move |first| Run { row, first, count: RUN.min(x + width - first) }))
    }
}

impl Rendered {
    /// Takes the first pixels out, so that areas that were rendered together can be told apart.
    #[must_use]
    pub fn split_off_first(&mut self, pixels: usize) -> Rendered {
        let first = |values: &mut Vec<f64>| {
            let rest = values.split_off(pixels.min(values.len()));
            std::mem::replace(values, rest)
        };
        Rendered {
            planes: self.planes.iter_mut().map(first).collect(),
            plane_uncertainties: self.plane_uncertainties.iter_mut().map(first).collect(),
            luminance: first(&mut self.luminance),
            luminance_uncertainty: first(&mut self.luminance_uncertainty),
            counters: Counters::default(),
        }
    }

    fn append(&mut self, pixels: Pixels) {
        let Pixels { values, counters } = pixels;
        let planes = self.planes.len();
        for pixel in values.chunks_exact(planes + 1) {
            for (k, (value, u)) in pixel.iter().enumerate() {
                let (values, spreads) = match k {
                    k if k < planes => (&mut self.planes[k], &mut self.plane_uncertainties[k]),
                    _ => (&mut self.luminance, &mut self.luminance_uncertainty),
                };
                values.push(*value);
                spreads.push(*u);
            }
        }
        self.counters.add(&counters);
    }
}

/// All that the pixels of a camera share.
struct Stage<'a> {
    view: View<'a>,
    world: &'a World,
    plan: &'a CameraPlan,
    shades: Shades<'a>,
    images: PointImages,
    /// Reflected light without a formula.
    paths: Option<PathScene<'a>>,
    camera: u64,
    sampling: Sampling,
    seed: u64,
}

impl<'a> Stage<'a> {
    fn new(
        scene: &'a Scene,
        placed: &'a PlacedCamera,
        plan: &'a CameraPlan,
        world: &'a World,
        camera: u64,
        sampling: Sampling,
        seed: u64,
    ) -> Stage<'a> {
        let view = View::of(placed);
        let shades = Shades::new(scene, plan, &point_image::traced(scene, &view));
        let images = PointImages::new(scene, world, &view, &shades, sampling, seed, camera);
        let paths = plan.spectral.as_ref().filter(|_| plan.needs_paths()).map(|spectral| {
            let sampled = |s: usize| plan.first[s] == FirstReflection::Sampled;
            PathScene::new(scene, world, spectral).after_first(scene, spectral, &sampled, plan.interreflection)
        });
        Stage { view, world, plan, shades, images, paths, camera, sampling, seed }
    }
}
