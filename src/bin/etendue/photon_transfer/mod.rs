//! `etendue photon-transfer PIXEL`: frames of a camera pixel in a flat field, and the figures of EMVA 1288 measured from them.

use std::path::{Path, PathBuf};

use clap::ValueEnum;
use etendue::characterization::emva::{Camera, EmvaError, Figures, PAST_SATURATION, Series, Shot, photon_transfer};
use etendue::estimate::frames::expose_into;
use etendue::estimate::run::with_threads;
use etendue::estimate::{Stop, Watch};
use etendue::measurement::{Reading, measure};
use etendue::quantity::constants::AVOGADRO_PER_MOL;
use etendue::report::emva::descriptor::Descriptor;
use etendue::report::emva::{to_json, to_text};
use etendue::report::image::png16;
use etendue::scene::pixel_from_file;
use etendue::sensor::{Exposure, Pixel};

use crate::measure::{failed, whole};
use crate::output::save_at;
use crate::{Failure, complain, disk, explain, print};

/// Expanded uncertainty over the value that is enough for the photons, where rays find them.
const TARGET: f64 = 1e-3;

/// The unit in which a channel that reads `PhotonIrradiance` indicates.
const PHOTON_IRRADIANCE: &str = "µmol/(m² s)";
/// Folder of the frames beside the descriptor.
const FRAMES: &str = "images";

/// Take frames of a camera pixel in a flat field, and measure the figures of EMVA 1288 from them.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// A file that holds `Pixel(…)`, such as sensors/pixels/monochrome-12-bit.ron.
    pixel: String,
    /// The flat field: a scene with an instrument that reads `PhotonIrradiance` in the plane of the pixels, such as scenes/flat-field.ron.
    #[arg(long, value_name = "SCENE")]
    scene: String,
    /// The instrument, where the scene has more than one of them.
    #[arg(long, value_name = "NAME")]
    instrument: Option<String>,
    /// Electrons per photon in the light of the scene, above 0 to 1.
    #[arg(long, value_name = "ETA", value_parser = efficiency, allow_hyphen_values = true)]
    quantum_efficiency: f64,
    /// Side of the square from which a pixel collects, µm.
    #[arg(long, value_name = "UM", value_parser = pitch_um, allow_hyphen_values = true)]
    pitch_um: f64,
    /// Temperature of the sensor, °C; that of the pixel's dark current by default.
    #[arg(long, value_name = "C", value_parser = temperature_c, allow_hyphen_values = true)]
    temperature: Option<f64>,
    /// Columns and rows of a frame.
    #[arg(long, value_name = "N", value_parser = whole(8, 4096), allow_hyphen_values = true, default_value_t = 128)]
    size: u64,
    /// Exposure times, in equal steps up to just past saturation; two bright and two dark frames at each.
    #[arg(long, value_name = "N", value_parser = whole(8, 1000), allow_hyphen_values = true, default_value_t = 50)]
    levels: u64,
    /// Frames of the dark and of the bright stack, for the fixed pattern.
    #[arg(long, value_name = "N", value_parser = whole(3, 1000), allow_hyphen_values = true, default_value_t = 32)]
    stack: u64,
    /// Seed of the sensor's pattern and of all noise: the same seed gives the same bits.
    #[arg(long, value_name = "N", value_parser = whole(0, u64::MAX), allow_hyphen_values = true, default_value_t = 0)]
    seed: u64,
    #[command(flatten)]
    plan: explain::Options,
    /// Threads; as many as there are cores by default. Frames do not depend on it.
    #[arg(long, value_name = "N", value_parser = whole(1, 1024), allow_hyphen_values = true)]
    threads: Option<u64>,
    /// How to write the figures.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Write the frames as 16-bit PNG into this folder, with a descriptor `emva1288.txt` as the Python package emva1288 reads it.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    /// A table for a person.
    Text,
    /// Figures and photon-transfer curve, for programs.
    Json,
}

fn number(given: &str, holds: impl Fn(f64) -> bool, allowed: &str) -> Result<f64, String> {
    given.trim().parse().ok().filter(|x| holds(*x)).ok_or_else(|| allowed.to_owned())
}

fn efficiency(given: &str) -> Result<f64, String> {
    number(given, |x| x > 0.0 && x <= 1.0, "electrons per photon, above 0 to 1, such as 0.6")
}

fn pitch_um(given: &str) -> Result<f64, String> {
    number(given, |x| (1e-3..=1e6).contains(&x), "a length from 0.001 to 1e6 µm, such as 5")
}

fn temperature_c(given: &str) -> Result<f64, String> {
    number(given, |x| (-273.15..=1000.0).contains(&x), "a temperature from -273.15 to 1000 °C, such as 30")
}

/// Photons a second and square metre, with their relative standard uncertainty.
struct Light {
    photons_s_m2: f64,
    u_relative: f64,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let pixel = pixel_from_file(&arguments.pixel, &disk::Anywhere).map_err(|problems| Failure::Input(problems.to_string()))?;
    let threads = arguments.threads.and_then(|n| usize::try_from(n).ok());
    with_threads(threads, || {
        let light = arguments.light()?;
        let figures = arguments.take(&pixel, &light)?;
        let title = format!(
            "{} under {}: {} levels of {} × {} pixels",
            arguments.pixel, arguments.scene, arguments.levels, arguments.size, arguments.size
        );
        print(&match arguments.format {
            Format::Text => to_text(&title, &figures),
            Format::Json => to_json(&title, &figures),
        })
    })
}

impl Arguments {
    /// What the instrument in the plane of the pixels reads.
    fn light(&self) -> Result<Light, Failure> {
        let scene = disk::scene(&self.scene, None)?;
        let plan = self.plan.plan(&scene)?;
        let watch = Watch { now: &|| 0.0, progress: &|_| {} };
        let measured =
            measure(&scene, &plan, &Stop { target: Some(TARGET), ..Stop::default() }, self.seed, &watch).map_err(|e| failed(&e))?;
        let counts = |reading: &&Reading| reading.measurand.unit() == PHOTON_IRRADIANCE && reading.index == 0;
        let counting: Vec<&Reading> = measured.readings.iter().filter(counts).collect();
        let names = counting.iter().map(|reading| format!("`{}`", reading.instrument)).collect::<Vec<_>>().join(", ");
        let wanted = |reading: &&&Reading| self.instrument.as_ref().is_none_or(|name| *name == reading.instrument);
        let found: Vec<&&Reading> = counting.iter().filter(wanted).collect();
        let trouble = |what: String, help: String| Failure::Input(format!("error: {}: {what}\n  = help: {help}", self.scene));
        match found[..] {
            [reading] if reading.value > 0.0 => Ok(Light {
                photons_s_m2: reading.value * 1e-6 * AVOGADRO_PER_MOL,
                u_relative: reading.standard_uncertainty() / reading.value,
            }),
            [reading] => {
                Err(trouble(format!("`{}` reads no light", reading.instrument), format!("`etendue explain {}` says why", self.scene)))
            }
            [] if counting.is_empty() => Err(trouble(
                "no instrument of the scene counts photons".into(),
                "give one the channel `(name: \"E_p\", responsivity: 1.0, reads: PhotonIrradiance)`".into(),
            )),
            [] => Err(trouble("no instrument of this name counts photons".into(), format!("allowed: {names}"))),
            _ => Err(trouble("more than one reading counts photons".into(), format!("choose with --instrument; allowed: {names}"))),
        }
    }

    /// Takes the frames and measures; with `--out` keeps them.
    fn take(&self, pixel: &Pixel, light: &Light) -> Result<Figures, Failure> {
        let temperature_c = self.temperature.unwrap_or(pixel.reference_temperature_c);
        let photons_per_s = light.photons_s_m2 * (self.pitch_um * 1e-6).powi(2);
        let electrons_per_s = self.quantum_efficiency * photons_per_s + pixel.dark_current_at(temperature_c);
        let longest_s = PAST_SATURATION * pixel.linear(0.0, temperature_c).hard_limit_e() / electrons_per_s;
        let side = self.size as usize;
        let mut series = Series::by_exposure_time(side, side, photons_per_s, longest_s, self.levels as usize, self.stack);
        series.u_photons = light.u_relative;
        let comment = format!("{} under {}, seed {}, {temperature_c} °C", self.pixel, self.scene, self.seed);
        let mut archive =
            self.out.as_deref().map(|folder| Archive::new(folder, Descriptor::new(&comment, pixel.bits, side, side))).transpose()?;
        let mut refused = None;
        let mut electrons_e = vec![0f32; side * side];
        let mut camera = |shot: &Shot, frame: &mut [u16]| {
            electrons_e.fill((self.quantum_efficiency * shot.photons) as f32);
            let of = Exposure { exposure_s: shot.exposure_s, temperature_c, seed: self.seed, frame: shot.number };
            expose_into(pixel, &of, &electrons_e, frame);
            let kept = archive.as_mut().map_or(Ok(()), |archive| archive.keep(shot, frame, side));
            kept.map_err(|failure| {
                refused = Some(failure);
                String::new()
            })
        };
        let measured = photon_transfer(&series, &mut camera as &mut Camera);
        if let Some(failure) = refused {
            return Err(failure);
        }
        let figures = measured.map_err(|e| match e {
            EmvaError::Series(_) | EmvaError::Frames(_) => Failure::Input(format!("error: {e}")),
            EmvaError::Camera(_) => Failure::Run(format!("error: {e}")),
        })?;
        if let Some(archive) = archive {
            archive.finish()?;
        }
        Ok(figures)
    }
}

/// A folder of frames with its descriptor, which is written last: a folder without one is not finished.
struct Archive<'f> {
    folder: &'f Path,
    descriptor: Descriptor,
}

impl<'f> Archive<'f> {
    fn new(folder: &'f Path, descriptor: Descriptor) -> Result<Self, Failure> {
        let frames = folder.join(FRAMES);
        std::fs::create_dir_all(&frames).map_err(|e| disk::unwritable(&frames, &e, "--out takes a folder that can be written"))?;
        Ok(Archive { folder, descriptor })
    }

    fn keep(&mut self, shot: &Shot, frame: &[u16], side: usize) -> Result<(), Failure> {
        let name = format!("{:05}.png", shot.number);
        let png = png16(frame, side, side).map_err(|e| Failure::Run(format!("error: {e}")))?;
        save_at(&self.folder.join(FRAMES).join(&name), &png)?;
        self.descriptor.add(shot, FRAMES, &name);
        Ok(())
    }

    fn finish(self) -> Result<(), Failure> {
        let target = self.folder.join("emva1288.txt");
        save_at(&target, self.descriptor.text().as_bytes())?;
        complain(&format!("note: frames and descriptor in {}", target.display()));
        Ok(())
    }
}
