//! What frames are taken of: a camera in a scene, by rays; or a pixel that stands where an instrument of a scene counts photons.

use etendue::characterization::traced_field::{Options, TracedFieldError, traced_field};
use etendue::estimate::{Stop, Watch};
use etendue::measurement::{Reading, measure};
use etendue::naming::suggestion;
use etendue::plan::PlanError;
use etendue::quantity::constants::AVOGADRO_PER_MOL;
use etendue::scene::{PlacedCamera, Scene, pixel_from_file};
use etendue::sensor::Pixel;

use super::Arguments;
use crate::measure::failed;
use crate::{Failure, complain, disk, expose};

/// Expanded uncertainty over the value that is enough for the photons, where rays find them.
const TARGET: f64 = 1e-3;
/// The unit in which a channel that reads `PhotonIrradiance` indicates.
const PHOTON_IRRADIANCE: &str = "µmol/(m² s)";
/// Largest standard deviation of the light over the pixels, as a share of its mean: figures that are means over the pixels need one light. EMVA 1288 allows 3 % from
/// the darkest to the brightest pixel, some three standard deviations.
const FLAT: f64 = 0.01;
/// A non-uniformity of so much of the PRNU adds 2 % to it.
const SEEN_IN_PRNU: f64 = 0.2;

/// Pixels in their light.
pub(super) struct Field {
    pub(super) pixel: Pixel,
    pub(super) temperature_c: f64,
    pub(super) columns: usize,
    pub(super) rows: usize,
    /// Expected electrons a second of each pixel, row by row.
    pub(super) electrons_per_s: Vec<f64>,
    /// Photons a second on a pixel.
    pub(super) photons_per_s: f64,
    /// Relative standard uncertainty of electrons per photon.
    pub(super) u_photons: f64,
    /// What it is, in words.
    pub(super) words: String,
}

fn trouble(scene: &str, what: &str, help: &str) -> Failure {
    Failure::Input(format!("error: {scene}: {what}\n  = help: {help}"))
}

impl Arguments {
    pub(super) fn field(&self) -> Result<Field, Failure> {
        match (&self.scene, self.quantum_efficiency, self.pitch_um) {
            (Some(scene), Some(quantum_efficiency), Some(pitch_um)) => self.of_pixel(scene, quantum_efficiency, pitch_um),
            _ => self.of_camera(),
        }
    }

    /// The middle of a camera's sensor, traced.
    fn of_camera(&self) -> Result<Field, Failure> {
        if disk::holds(&self.file).as_deref() == Some("Pixel") {
            let help = "give its flat field: --scene scenes/flat-field.ron --quantum-efficiency 0.6 --pitch-um 5; or name a scene with a camera, such as \
                        scenes/flat-field-of-a-camera.ron";
            return Err(trouble(&self.file, "a pixel alone sees no light", help));
        }
        let scene = disk::scene(&self.file, None)?;
        let camera = expose::chosen(&scene, self.camera.as_deref())?;
        let placed = &scene.cameras[camera];
        let Some(pixel) = placed.camera.pixel else {
            let what = format!("the camera `{}` has no electronics, so it gives no raw frames", placed.name);
            return Err(trouble(&self.file, &what, "add `pixel: Pixel(gain_dn_per_e: 0.25, …)` to it"));
        };
        let channel = self.chosen_channel(placed)?;
        self.plan.plan(&scene)?;
        let stop = Stop { target: None, budget_seconds: None, samples: self.samples };
        let options = Options { camera, channel, side: self.size as usize, plan: self.plan.options(), stop, seed: self.seed };
        let watch = Watch { now: &|| 0.0, progress: &|_| {} };
        let found = traced_field(&scene, &options, &watch).map_err(|e| match e {
            TracedFieldError::Dark { .. } => trouble(&self.file, &e.to_string(), &format!("`etendue explain {}` says why", self.file)),
            TracedFieldError::Plan(PlanError::UnknownRule { .. }) => Failure::Input(format!("error: {e}")),
            TracedFieldError::Plan(_) | TracedFieldError::Estimate(_) => Failure::Run(format!("error: {e}")),
        })?;
        if found.non_uniformity > FLAT {
            let what = format!(
                "no flat field: over the {} × {} pixels the light varies by {:.1} % of itself (standard deviation; allowed: {} %, at which EMVA 1288's limit of 3 % \
                 from the darkest to the brightest pixel is met)",
                found.columns,
                found.rows,
                100.0 * found.non_uniformity,
                100.0 * FLAT
            );
            let help = "let a source of one luminance fill the camera's field, as in scenes/flat-field-of-a-camera.ron, or take fewer pixels: --size 32";
            return Err(trouble(&self.file, &what, help));
        }
        let seen = if found.non_uniformity > SEEN_IN_PRNU * pixel.prnu { ", and is found as part of the PRNU" } else { "" };
        complain(&format!(
            "note: {} rays; over the {} × {} pixels the light varies by {:.1e} of itself (standard deviation; {:.1e} by the samples of a pixel){seen}",
            found.rays, found.columns, found.rows, found.non_uniformity, found.of_samples
        ));
        Ok(Field {
            pixel,
            temperature_c: self.temperature.unwrap_or(placed.camera.temperature_c),
            columns: found.columns,
            rows: found.rows,
            photons_per_s: found.photons_per_s.value,
            u_photons: found.u_electrons.hypot(found.photons_per_s.standard_uncertainty / found.photons_per_s.value),
            electrons_per_s: found.electrons_per_s,
            words: format!("camera `{}`, channel `{}`, of {}", placed.name, placed.camera.channels[channel].name, self.file),
        })
    }

    fn chosen_channel(&self, placed: &PlacedCamera) -> Result<usize, Failure> {
        let names: Vec<&str> = placed.camera.channels.iter().map(|channel| channel.name.as_str()).collect();
        match &self.channel {
            None if names.len() == 1 => Ok(0),
            None => {
                let help = format!("choose with --channel: {}; all pixels are then behind the filter of that channel", names.join(", "));
                Err(trouble(&self.file, &format!("the camera `{}` has more than one channel", placed.name), &help))
            }
            Some(name) => names.iter().position(|known| known == name).ok_or_else(|| {
                trouble(&self.file, &format!("the camera `{}` has no channel called `{name}`", placed.name), &suggestion(name, &names))
            }),
        }
    }

    /// A pixel in the light that an instrument of the scene reads.
    fn of_pixel(&self, scene: &str, quantum_efficiency: f64, pitch_um: f64) -> Result<Field, Failure> {
        let pixel = pixel_from_file(&self.file, &disk::Anywhere).map_err(|problems| Failure::Input(problems.to_string()))?;
        let (photons_s_m2, u_photons) = self.photons(scene, &disk::scene(scene, None)?)?;
        let photons_per_s = photons_s_m2 * (pitch_um * 1e-6).powi(2);
        let side = self.size as usize;
        Ok(Field {
            temperature_c: self.temperature.unwrap_or(pixel.reference_temperature_c),
            pixel,
            columns: side,
            rows: side,
            electrons_per_s: vec![quantum_efficiency * photons_per_s; side * side],
            photons_per_s,
            u_photons,
            words: format!("{} under {scene}", self.file),
        })
    }

    /// Photons a second and square metre, and their relative standard uncertainty: what the instrument in the plane of the pixels reads.
    fn photons(&self, file: &str, scene: &Scene) -> Result<(f64, f64), Failure> {
        let plan = self.plan.plan(scene)?;
        let watch = Watch { now: &|| 0.0, progress: &|_| {} };
        let stop = Stop { target: Some(TARGET), ..Stop::default() };
        let measured = measure(scene, &plan, &stop, self.seed, &watch).map_err(|e| failed(&e))?;
        let counts = |reading: &&Reading| reading.measurand.unit() == PHOTON_IRRADIANCE && reading.index == 0;
        let counting: Vec<&Reading> = measured.readings.iter().filter(counts).collect();
        let names = counting.iter().map(|reading| format!("`{}`", reading.instrument)).collect::<Vec<_>>().join(", ");
        let wanted = |reading: &&&Reading| self.instrument.as_ref().is_none_or(|name| *name == reading.instrument);
        let found: Vec<&&Reading> = counting.iter().filter(wanted).collect();
        match found[..] {
            [reading] if reading.value > 0.0 => {
                Ok((reading.value * 1e-6 * AVOGADRO_PER_MOL, reading.standard_uncertainty() / reading.value))
            }
            [reading] => {
                Err(trouble(file, &format!("`{}` reads no light", reading.instrument), &format!("`etendue explain {file}` says why")))
            }
            [] if counting.is_empty() => Err(trouble(
                file,
                "no instrument of the scene counts photons",
                "give one the channel `(name: \"E_p\", responsivity: 1.0, reads: PhotonIrradiance)`",
            )),
            [] => Err(trouble(file, "no instrument of this name counts photons", &format!("allowed: {names}"))),
            _ => Err(trouble(file, "more than one reading counts photons", &format!("choose with --instrument; allowed: {names}"))),
        }
    }
}
