//! A flat field that rays find: what the pixels of a camera in a scene get a second, and how many photons arrive there.
//!
//! ```text
//! electrons: the picture of the camera, one of its filters before all pixels
//! photons:   the picture of an ideal counter in its place: η = 1, g = 1, every direction alike
//! ```
//!
//! Both are pictures of the same scene by the same rays, of the middle of the sensor. Photons are counted where EMVA 1288 counts them, at the
//! pixel: behind the lens, if there is one. Light that varies over the pixels is found in the frames as part of the PRNU, and so is the spread of
//! the samples of a pixel; both are stated.
//!
//! ```
//! use etendue::characterization::traced_field::{Options, traced_field};
//! use etendue::{estimate::Watch, scene};
//!
//! let scene = scene::scene_from_text(r#"Scene(
//!     sources: [(name: "sky", shape: Disc(0.05), at: (0, 0.02, 0), facing: (0, -1, 0), strength: Radiance(3), spectrum: Line(525))],
//!     cameras: [(name: "camera", at: (0, 0, 0), facing: (0, 1, 0), camera: Camera(
//!         lens: Pinhole(distance_mm: 160, diameter_mm: 20), columns: 64, rows: 48, pitch_um: 5, fill_factor: 0.8,
//!         channels: [(name: "grey", quantum_efficiency: 0.75)], exposure_ms: 5,
//!     ))],
//! )"#)?;
//! let watch = Watch { now: &|| 0.0, progress: &|_| {} };
//! let field = traced_field(&scene, &Options { side: 32, ..Options::default() }, &watch)?;
//! assert_eq!(field.electrons_per_s.len(), 32 * 32);
//! assert!((field.mean_electrons_per_s() / field.photons_per_s.value - 0.6).abs() < 1e-6 && field.rays > 0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use std::sync::Arc;

use super::Figure;
use crate::estimate::{EstimateError, Stop, Watch};
use crate::measurement::{Frame, expose};
use crate::plan::{Plan, PlanError, PlanOptions};
use crate::scene::{PlacedCamera, Region, Scene};
use crate::sensor::camera::{Camera, ColourChannel};
use crate::spectrum::Factor;

/// What is traced, and how.
#[derive(Clone, Debug)]
pub struct Options {
    /// Index of the camera in the scene.
    pub camera: usize,
    /// Index of the channel whose filter is before the pixels.
    pub channel: usize,
    /// Columns and rows of the middle of the sensor that are used, at most.
    pub side: usize,
    /// How to plan.
    pub plan: PlanOptions,
    /// How many samples, or which target.
    pub stop: Stop,
    /// Seed of the samples.
    pub seed: u64,
}

impl Default for Options {
    /// The first channel of the first camera, 128 × 128 pixels.
    fn default() -> Self {
        let stop = Stop { target: None, budget_seconds: None, samples: None };
        Options { camera: 0, channel: 0, side: 128, plan: PlanOptions::default(), stop, seed: 0 }
    }
}

/// Why there is no field.
#[derive(Debug, thiserror::Error)]
pub enum TracedFieldError {
    /// The scene cannot be planned so.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// The picture cannot be taken.
    #[error(transparent)]
    Estimate(#[from] EstimateError),
    /// There is no light, or none that the pixels take.
    #[error(
        "the camera `{camera}` gets {photons_per_s:.4} photons and {electrons_per_s:.4} electrons a second on a pixel: there is no light to transfer"
    )]
    Dark {
        /// Name of the camera in the scene.
        camera: String,
        /// Photons a second on a pixel.
        photons_per_s: f64,
        /// Electrons a second in a pixel.
        electrons_per_s: f64,
    },
}

/// What pixels in a scene get.
#[derive(Clone, Debug, PartialEq)]
pub struct TracedField {
    /// Pixels in a row.
    pub columns: usize,
    /// Rows.
    pub rows: usize,
    /// Expected electrons a second of each pixel, row by row.
    pub electrons_per_s: Vec<f64>,
    /// Relative standard uncertainty of their mean.
    pub u_electrons: f64,
    /// Photons a second on a pixel, mean over the pixels.
    pub photons_per_s: Figure,
    /// Standard deviation of the electrons over the pixels, relative: fall-off of the light and spread of the samples together.
    pub non_uniformity: f64,
    /// What of it is the spread of the samples, relative: root mean square of the standard uncertainties of the pixels.
    pub of_samples: f64,
    /// Rays that were traced.
    pub rays: u64,
}

impl TracedField {
    /// Mean of the expected electrons, 1/s.
    #[must_use]
    pub fn mean_electrons_per_s(&self) -> f64 {
        self.electrons_per_s.iter().sum::<f64>() / self.electrons_per_s.len() as f64
    }
}

/// Traces what the middle of a camera's sensor gets. `watch.progress` is told the share that is done.
///
/// # Errors
/// A rule that is not known, a picture that has no finite pixels, no light.
pub fn traced_field(scene: &Scene, options: &Options, watch: &Watch<'_>) -> Result<TracedField, TracedFieldError> {
    let placed = &scene.cameras[options.camera];
    let own = Camera {
        columns: options.side.min(placed.camera.columns),
        rows: options.side.min(placed.camera.rows),
        mosaic: None,
        channels: vec![placed.camera.channels[options.channel].clone()],
        exposure_s: 1.0,
        ..Camera::clone(&placed.camera)
    };
    let counter = Camera {
        fill_factor: 1.0,
        angular_response: None,
        channels: vec![ColourChannel { name: "photons".to_owned(), quantum_efficiency: Factor::ONE }],
        ..own.clone()
    };
    let half = |first: f64| move |part: f64| (watch.progress)(first + 0.5 * part);
    let electrons = picture(scene, placed, own, options, &Watch { now: watch.now, progress: &half(0.0) })?;
    let photons = picture(scene, placed, counter, options, &Watch { now: watch.now, progress: &half(0.5) })?;
    // The first reading is that of the channel, over the whole picture.
    let figure = |frame: &Frame| Figure { value: frame.readings[0].value, standard_uncertainty: frame.readings[0].standard_uncertainty() };
    let (of_pixels, photons_per_s) = (figure(&electrons), figure(&photons));
    if !(of_pixels.value > 0.0 && photons_per_s.value > 0.0) {
        let camera = placed.name.clone();
        return Err(TracedFieldError::Dark { camera, photons_per_s: photons_per_s.value, electrons_per_s: of_pixels.value });
    }
    let plane = &electrons.planes[0];
    let root_mean = |squares: f64| (squares / plane.expected_e.len() as f64).sqrt() / of_pixels.value;
    Ok(TracedField {
        columns: electrons.columns,
        rows: electrons.rows,
        electrons_per_s: plane.expected_e.clone(),
        u_electrons: of_pixels.standard_uncertainty / of_pixels.value,
        photons_per_s,
        non_uniformity: root_mean(plane.expected_e.iter().map(|e| (e - of_pixels.value).powi(2)).sum()),
        of_samples: root_mean(plane.standard_uncertainty_e.iter().map(|u| u * u).sum()),
        rays: electrons.counters.rays + photons.counters.rays,
    })
}

/// The picture of a camera in the place of another one, with one region that holds all of it.
fn picture(scene: &Scene, placed: &PlacedCamera, camera: Camera, options: &Options, watch: &Watch<'_>) -> Result<Frame, TracedFieldError> {
    let all = Region { name: "all".to_owned(), x: 0, y: 0, width: camera.columns, height: camera.rows };
    let cameras = vec![PlacedCamera { camera: Arc::new(camera), regions: vec![all], ..placed.clone() }];
    let scene = Scene { instruments: Vec::new(), cameras, ..scene.clone() };
    let plan = Plan::new(&scene, &options.plan)?;
    Ok(expose(&scene, &plan, 0, &options.stop, options.seed, watch)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::scene_from_text;

    fn field(lens: &str, radius_m: f64, options: &Options) -> Result<TracedField, TracedFieldError> {
        let text = format!(
            "Scene(
                sources: [(name: \"sky\", shape: Disc({radius_m}), at: (0, 0.02, 0), facing: (0, -1, 0), strength: Radiance(3), spectrum: Line(525))],
                cameras: [(name: \"cam\", at: (0, 0, 0), facing: (0, 1, 0), camera: Camera(
                    lens: {lens}, columns: 40, rows: 24, pitch_um: 5, fill_factor: 0.5, transmittance: 0.5, mosaic: Bayer(\"RGGB\"), exposure_ms: 5,
                    channels: [
                        (name: \"R\", quantum_efficiency: Gaussian(peak: 0.6, centre_nm: 600, fwhm_nm: 50)),
                        (name: \"G\", quantum_efficiency: 0.4), (name: \"B\", quantum_efficiency: Line(450)),
                    ],
                ))])"
        );
        let text = text.replace("Line(450)", "Band(from_nm: 400, to_nm: 500)");
        let scene = scene_from_text(&text).unwrap_or_else(|problems| panic!("{problems}"));
        traced_field(&scene, options, &Watch { now: &|| 0.0, progress: &|_| {} })
    }

    #[test]
    fn photons_are_those_of_the_disc_behind_the_transmittance() {
        let options = Options { channel: 1, side: 24, ..Options::default() };
        let found = field("Pinhole(distance_mm: 160, diameter_mm: 20)", 0.05, &options).unwrap_or_else(|e| panic!("{e}"));
        let per_joule = crate::spectrum::photometry::photons_per_joule(crate::spectrum::photometry::WavelengthsIn::StandardAir).at(525.0);
        let expected = 0.5 * std::f64::consts::PI * 3.0 / 257.0 * 25e-12 * per_joule;
        assert!((found.photons_per_s.value / expected - 1.0).abs() < 1e-5, "{} against {expected}", found.photons_per_s.value);
        assert!((found.mean_electrons_per_s() / found.photons_per_s.value - 0.2).abs() < 1e-9);
        assert_eq!((found.columns, found.rows, found.electrons_per_s.len()), (24, 24, 24 * 24));
        assert!(found.rays > 0 && found.non_uniformity < 1e-4 && found.of_samples < 1e-4, "{found:?}");
    }

    #[test]
    fn a_port_that_is_too_small_is_no_flat_field() {
        let options = Options { channel: 1, ..Options::default() };
        let found = field("Thin(focal_length_mm: 8, f_number: 2, focus_m: 0.02)", 5e-5, &options).unwrap_or_else(|e| panic!("{e}"));
        assert!(found.non_uniformity > 0.1, "{}", found.non_uniformity);
    }

    #[test]
    fn a_channel_that_the_light_does_not_reach_is_told() {
        let options = Options { channel: 2, ..Options::default() };
        let error = field("Pinhole(distance_mm: 160, diameter_mm: 20)", 0.05, &options).map_or_else(|e| e.to_string(), |_| String::new());
        assert!(error.contains("`cam` gets") && error.contains("no light to transfer"), "{error}");
    }
}
