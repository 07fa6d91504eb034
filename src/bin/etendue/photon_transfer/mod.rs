//! `etendue photon-transfer SCENE`: frames of a camera in a flat field, and the figures of EMVA 1288 measured from them.
//!
//! | file | what |
//! |---|---|
//! | `mod.rs` | arguments, frames |
//! | `field.rs` | what the pixels get: of a camera in a scene, or of a bare pixel |
//! | `archive.rs` | the folder of frames |

mod archive;
mod field;

use std::path::PathBuf;

use clap::ValueEnum;
use etendue::characterization::emva::{Camera, EmvaError, Figures, Series, Shot, longest_exposure_s, photon_transfer};
use etendue::estimate::frames::expose_into;
use etendue::estimate::run::with_threads;
use etendue::report::emva::descriptor::Descriptor;
use etendue::report::emva::{to_json, to_text};
use etendue::sensor::Exposure;

use self::archive::Archive;
use self::field::Field;
use crate::measure::whole;
use crate::{Failure, explain, print};

/// Take frames of a camera in a flat field, and measure the figures of EMVA 1288 from them.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// A scene with a camera that looks at a flat field, such as scenes/flat-field-of-a-camera.ron; with --scene a file that holds `Pixel(…)`.
    #[arg(value_name = "SCENE")]
    file: String,
    /// The camera, where the scene has more than one.
    #[arg(long, value_name = "NAME", conflicts_with = "scene")]
    camera: Option<String>,
    /// The channel whose filter is before the pixels, where the camera has more than one.
    #[arg(long, value_name = "NAME", conflicts_with = "scene")]
    channel: Option<String>,
    /// Samples of each pixel, rounded up to a power of two of at least 4 [default: 8].
    #[arg(long, value_name = "N", value_parser = whole(1, 1 << 20), allow_hyphen_values = true, conflicts_with = "scene")]
    samples: Option<u64>,
    /// The flat field of a bare pixel: a scene with an instrument that reads `PhotonIrradiance` in the plane of the pixels, such as
    /// scenes/flat-field.ron.
    #[arg(long, value_name = "SCENE", requires_all = ["quantum_efficiency", "pitch_um"])]
    scene: Option<String>,
    /// The instrument, where that scene has more than one of them.
    #[arg(long, value_name = "NAME", requires = "scene")]
    instrument: Option<String>,
    /// Electrons per photon of a bare pixel in the light of the scene, above 0 to 1.
    #[arg(long, value_name = "ETA", value_parser = efficiency, allow_hyphen_values = true, requires = "scene")]
    quantum_efficiency: Option<f64>,
    /// Side of the square from which a bare pixel collects, µm.
    #[arg(long, value_name = "UM", value_parser = pitch_um, allow_hyphen_values = true, requires = "scene")]
    pitch_um: Option<f64>,
    /// Temperature of the sensor, °C; by default that of the camera, or that of the dark current of a bare pixel.
    #[arg(long, value_name = "C", value_parser = temperature_c, allow_hyphen_values = true)]
    temperature: Option<f64>,
    /// Columns and rows of a frame: of the middle of the sensor, or as many as a smaller one has.
    #[arg(long, value_name = "N", value_parser = whole(8, 4096), allow_hyphen_values = true, default_value_t = 128)]
    size: u64,
    /// Exposure times, in equal steps up to just past saturation; two bright and two dark frames at each.
    #[arg(long, value_name = "N", value_parser = whole(8, 1000), allow_hyphen_values = true, default_value_t = 50)]
    levels: u64,
    /// Frames of the dark and of the bright stack, for the fixed pattern.
    #[arg(long, value_name = "N", value_parser = whole(3, 1000), allow_hyphen_values = true, default_value_t = 32)]
    stack: u64,
    /// Seed of the samples, of the sensor's pattern and of all noise: the same seed gives the same bits.
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

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let threads = arguments.threads.and_then(|n| usize::try_from(n).ok());
    with_threads(threads, || {
        let field = arguments.field()?;
        let figures = arguments.take(&field)?;
        let title = format!("{}: {} levels of {} × {} pixels", field.words, arguments.levels, field.columns, field.rows);
        print(&match arguments.format {
            Format::Text => to_text(&title, &figures),
            Format::Json => to_json(&title, &figures),
        })
    })
}

impl Arguments {
    /// Takes the frames and measures; with `--out` keeps them.
    fn take(&self, field: &Field) -> Result<Figures, Failure> {
        let Field { pixel, temperature_c, columns, rows, .. } = *field;
        let electrons_per_s = field.electrons_per_s.iter().sum::<f64>() / field.electrons_per_s.len() as f64;
        let longest_s = longest_exposure_s(&pixel, temperature_c, electrons_per_s).map_err(|e| self.no_figures(&e))?;
        let mut series = Series::by_exposure_time(rows, columns, field.photons_per_s, longest_s, self.levels as usize, self.stack);
        series.u_photons = field.u_photons;
        let comment = format!("{}, seed {}, {temperature_c} °C", field.words, self.seed);
        // Two bright and two dark frames a level, and the two stacks.
        let frames = 4 * self.levels + 2 * self.stack;
        let mut archive = self
            .out
            .as_deref()
            .map(|folder| Archive::new(folder, frames, Descriptor::new(&comment, pixel.bits, columns, rows)))
            .transpose()?;
        let mut refused = None;
        let mut electrons_e = vec![0f32; columns * rows];
        let mut camera = |shot: &Shot, frame: &mut [u16]| {
            // In the dark there are no photons.
            let light_s = if shot.photons > 0.0 { shot.exposure_s } else { 0.0 };
            electrons_e.iter_mut().zip(&field.electrons_per_s).for_each(|(e, per_s)| *e = (per_s * light_s) as f32);
            let of = Exposure { exposure_s: shot.exposure_s, temperature_c, seed: self.seed, frame: shot.number };
            expose_into(&pixel, &of, &electrons_e, frame);
            let kept = archive.as_mut().map_or(Ok(()), |archive| archive.keep(shot, frame, columns, rows));
            kept.map_err(|failure| {
                refused = Some(failure);
                String::new()
            })
        };
        let measured = photon_transfer(&series, &mut camera as &mut Camera);
        if let Some(failure) = refused {
            return Err(failure);
        }
        let figures = measured.map_err(|e| self.no_figures(&e))?;
        if let Some(archive) = archive {
            archive.finish()?;
        }
        Ok(figures)
    }

    fn no_figures(&self, e: &EmvaError) -> Failure {
        match e {
            EmvaError::Series(_) | EmvaError::Frames(_) => Failure::Input(format!("error: {}: {e}", self.file)),
            EmvaError::Camera(_) => Failure::Run(format!("error: {e}")),
        }
    }
}
