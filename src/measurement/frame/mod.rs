//! The picture of a camera: expected electrons of every pixel with their uncertainty, and the luminance that each looks at.
//!
//! ```text
//! μ_e = t A_pix g ∫ s_c(λ) E_λ dλ        u from the spread of independent groups of samples (4, or 16 with a target), one pixel by itself
//! ```
//!
//! A spread of zero says that all samples of a pixel agree; what is smaller than the distance of its samples may have been missed by all of
//! them. Regions (`regions.rs`) are ordinary readings with a budget.

mod regions;

pub(super) use regions::measure_regions;
use regions::read_regions;

use super::{Measurement, Provenance, Reading};
use crate::estimate::camera::{Area, Rendered, Sampling, render};
use crate::estimate::{Counters, EstimateError, Stop, Watch};
use crate::metrology::distribution::student_t_quantile;
use crate::plan::Plan;
use crate::scene::Scene;

/// Pixels in a row and a column of the trial that finds out how many samples a target needs.
const TRIAL: usize = 48;
/// Share of the pixels of the trial that have to meet it.
const MOST_OF_THEM: f64 = 0.95;
/// Most samples of a pixel.
const MOST_SAMPLES: u64 = 1 << 14;

/// Expected electrons of one image: the one behind the mosaic, or that of a channel.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    /// The name of the channel, or "mosaic".
    pub name: String,
    /// Expected electrons, row by row from the top.
    pub expected_e: Vec<f64>,
    /// Their standard uncertainties.
    pub standard_uncertainty_e: Vec<f64>,
}

/// The picture of a camera.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Title of the scene.
    pub scene: String,
    /// Name of the camera in the scene.
    pub camera: String,
    /// Pixels in a row.
    pub columns: usize,
    /// Rows.
    pub rows: usize,
    /// At least one.
    pub planes: Vec<Plane>,
    /// Mean luminance of what each pixel looks at, cd/m².
    pub luminance_cd_m2: Vec<f64>,
    /// Its standard uncertainty, cd/m².
    pub luminance_uncertainty_cd_m2: Vec<f64>,
    /// The regions, channel by channel.
    pub readings: Vec<Reading>,
    /// What a reader should know.
    pub notes: Vec<String>,
    /// Samples of each pixel.
    pub samples: u64,
    /// Independent groups that they were taken in.
    pub groups: usize,
    /// Whether the target that was asked for is met by nearly all pixels.
    pub target_met: bool,
    /// What was really done.
    pub counters: Counters,
    /// Where it came from.
    pub provenance: Provenance,
    /// Seconds from start to end.
    pub wall_seconds: f64,
}

impl Frame {
    /// The regions as readings of a measurement, for reports.
    #[must_use]
    pub fn measurement(&self) -> Measurement {
        Measurement {
            scene: self.scene.clone(),
            readings: self.readings.clone(),
            counters: self.counters,
            pieces: 0,
            provenance: self.provenance.clone(),
            wall_seconds: self.wall_seconds,
        }
    }
}

/// Takes the picture of one camera of a scene.
///
/// With `stop.samples` each pixel takes so many, rounded up to a power of two of at least 4. With `stop.target` a trial on some of the pixels
/// finds the number with which the expanded uncertainty of 95 % of the pixels is at most that share of the expected electrons. Without either
/// it is [`Sampling::default`]. A budget of time is not looked at.
///
/// # Errors
/// When light is never absorbed, or a pixel receives more than numbers can say.
pub fn expose(scene: &Scene, plan: &Plan, camera: usize, stop: &Stop, seed: u64, watch: &Watch<'_>) -> Result<Frame, EstimateError> {
    let start = (watch.now)();
    let placed = &scene.cameras[camera];
    let (columns, rows) = (placed.camera.columns, placed.camera.rows);
    let (sampling, target_met) = match (stop.samples, stop.target) {
        (Some(samples), _) => (Sampling::of(samples), true),
        (None, None) => (Sampling::default(), true),
        (None, Some(target)) => for_target(scene, plan, camera, target, seed, watch)?,
    };
    let area = Area { x: 0, y: 0, width: columns, height: rows };
    let rendered = scaled(scene, camera, render(scene, plan, camera, &[area], sampling, seed, watch)?)?;
    let mut readings = read_regions(scene, plan, camera, (&rendered, area), sampling);
    readings.iter_mut().for_each(|r| r.seconds = (watch.now)() - start);
    let mut notes = Vec::new();
    if rendered.planes.iter().flatten().all(|&x| x == 0.0) {
        notes.push("every pixel expects zero electrons: no ray of this camera found light in the band of a channel".to_owned());
    }
    if !target_met {
        notes.push(format!("the target was not met within {MOST_SAMPLES} samples a pixel"));
    }
    let name = |k: usize| if placed.camera.mosaic.is_some() { "mosaic".to_owned() } else { placed.camera.channels[k].name.clone() };
    let planes = rendered.planes.into_iter().zip(rendered.plane_uncertainties).enumerate();
    Ok(Frame {
        scene: scene.title.clone(),
        camera: placed.name.clone(),
        columns,
        rows,
        planes: planes
            .map(|(k, (expected_e, standard_uncertainty_e))| Plane { name: name(k), expected_e, standard_uncertainty_e })
            .collect(),
        luminance_cd_m2: rendered.luminance,
        luminance_uncertainty_cd_m2: rendered.luminance_uncertainty,
        readings,
        notes,
        samples: sampling.samples(),
        groups: sampling.groups,
        target_met,
        counters: rendered.counters,
        provenance: Provenance::of(scene, plan, stop, seed),
        wall_seconds: (watch.now)() - start,
    })
}

/// What is received → expected electrons.
fn scaled(scene: &Scene, camera: usize, mut rendered: Rendered) -> Result<Rendered, EstimateError> {
    let placed = &scene.cameras[camera];
    let scale = placed.camera.collection_m2_s();
    let arrays = rendered.planes.iter_mut().chain(&mut rendered.plane_uncertainties);
    arrays.flatten().for_each(|x| *x *= scale);
    let (planes, spreads) = (rendered.planes.iter().flatten(), rendered.plane_uncertainties.iter().flatten());
    let finite = planes.chain(spreads).chain(&rendered.luminance).chain(&rendered.luminance_uncertainty).all(|x| x.is_finite());
    if !finite {
        return Err(EstimateError::OutOfRange { instrument: placed.name.clone() });
    }
    Ok(rendered)
}

/// The sampling with which nearly all pixels of a trial meet the target, and whether there is one.
fn for_target(
    scene: &Scene,
    plan: &Plan,
    camera: usize,
    target: f64,
    seed: u64,
    watch: &Watch<'_>,
) -> Result<(Sampling, bool), EstimateError> {
    let model = &scene.cameras[camera].camera;
    let stride = |n: usize| n.div_ceil(TRIAL).max(1);
    let (dx, dy) = (stride(model.columns), stride(model.rows));
    let quiet = Watch { now: watch.now, progress: &|_| {} };
    let places = (dy / 2..model.rows).step_by(dy).flat_map(|y| (dx / 2..model.columns).step_by(dx).map(move |x| (x, y)));
    let trial: Vec<Area> = places.map(|(x, y)| Area { x, y, width: 1, height: 1 }).collect();
    let mut sampling = Sampling { groups: 16, points: 1, set: 1 };
    loop {
        let k = student_t_quantile(0.975, sampling.groups as f64 - 1.0).unwrap_or(f64::INFINITY);
        let found = render(scene, plan, camera, &trial, sampling, seed, &quiet)?;
        let pairs = || found.planes.iter().flatten().zip(found.plane_uncertainties.iter().flatten());
        let (met, all) = (pairs().filter(|(value, u)| k * **u <= target * **value).count(), pairs().count());
        let enough = met as f64 >= MOST_OF_THEM * all as f64;
        if enough || sampling.samples() >= MOST_SAMPLES {
            // The numbers of the trial are not those of the picture.
            return Ok((Sampling { set: 0, ..sampling }, enough));
        }
        sampling.points *= 2;
    }
}
