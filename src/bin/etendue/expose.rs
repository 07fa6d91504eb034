//! `etendue expose SCENE --out DIR`: the picture of a camera, and raw frames of it.
//!
//! | file | what |
//! |---|---|
//! | `NAME-expected_e.npy`, `NAME-uncertainty_e.npy` | expected electrons and their standard uncertainty, 64 bits: rows × columns, or channels × rows × columns |
//! | `NAME-luminance_cd_m2.npy` | the luminance that each pixel looks at |
//! | `NAME.exr` | all three, 32 bits: a channel each, `Y` for luminance |
//! | `NAME-preview.png`, `NAME-luminance.png` | for the eye |
//! | `NAME-regions.csv` | the regions |
//! | `NAME-frame-0000.png` … | raw frames with noise, 16 bits; `.tiff` if asked for; with the channel's name where there is no mosaic |

use std::path::PathBuf;
use std::time::Instant;

use etendue::estimate::run::with_threads;
use etendue::estimate::{Stop, Watch};
use etendue::measurement::{Frame, expose};
use etendue::report::image::{ImageError, exr, npy_f64, png8_rgb, png16, tiff16};
use etendue::report::picture::{false_colour, preview};
use etendue::report::{csv, text};
use etendue::scene::{PlacedCamera, Scene};
use etendue::sensor::Exposure;

use crate::file_set::FileSet;
use crate::measure::{failed, share, whole};
use crate::output::progress_bar;
use crate::{Failure, complain, disk, explain, print};

/// Digital numbers, columns and rows to a file.
type Encoder = fn(&[u16], usize, usize) -> Result<Vec<u8>, ImageError>;

/// Take the picture of a camera of a scene.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The scene file.
    scene: String,
    /// The camera, where the scene has more than one.
    #[arg(long, value_name = "NAME")]
    camera: Option<String>,
    /// Samples of each pixel, rounded up to a power of two of at least 4 [default: 8].
    #[arg(long, value_name = "N", value_parser = whole(1, 1 << 20), allow_hyphen_values = true)]
    samples: Option<u64>,
    /// Take so many samples that the expanded uncertainty (95 %) of nearly all pixels is at most this share, e.g. 1%.
    #[arg(long, value_name = "SHARE", value_parser = share, allow_hyphen_values = true, conflicts_with = "samples")]
    target: Option<f64>,
    /// Raw frames with noise.
    #[arg(long, value_name = "N", value_parser = whole(0, 1_000_000), allow_hyphen_values = true, default_value_t = 0)]
    frames: u64,
    /// Write the raw frames as TIFF instead of PNG.
    #[arg(long)]
    tiff: bool,
    /// Seed of the random numbers: the same seed gives the same bits.
    #[arg(long, value_name = "N", value_parser = whole(0, u64::MAX), allow_hyphen_values = true, default_value_t = 0)]
    seed: u64,
    /// Threads; as many as there are cores by default. Pictures do not depend on it.
    #[arg(long, value_name = "N", value_parser = whole(1, 1024), allow_hyphen_values = true)]
    threads: Option<u64>,
    /// The folder for the files.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    #[command(flatten)]
    plan: explain::Options,
    /// The folder that no file may lie outside of; by default the one that holds `scenes/` and `sensors/`, else the scene's own.
    #[arg(long, value_name = "DIR")]
    root: Option<String>,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let scene = disk::scene(&arguments.scene, arguments.root.as_deref())?;
    let index = chosen(&scene, arguments.camera.as_deref())?;
    let placed = &scene.cameras[index];
    if arguments.frames > 0 && placed.camera.pixel.is_none() {
        return Err(Failure::Input(format!(
            "error: the camera `{}` has no electronics, so it gives no raw frames\n  = help: add `pixel: Pixel(gain_dn_per_e: 0.25, …)` to its \
             file, or leave --frames out: expected electrons need none",
            placed.name
        )));
    }
    let plan = arguments.plan.plan(&scene)?;
    let name = file_name(&placed.name);
    let names = names(placed, arguments).into_iter().map(|ending| format!("{name}{ending}"));
    let set = FileSet::new(&arguments.out, names, "--out takes a folder that can be written")?;
    let stop = Stop { target: arguments.target, budget_seconds: None, samples: arguments.samples };
    let bar = progress_bar();
    let start = Instant::now();
    let watch = Watch { now: &|| start.elapsed().as_secs_f64(), progress: &|share| bar.set_position((1000.0 * share) as u64) };
    let threads = arguments.threads.and_then(|n| usize::try_from(n).ok());
    with_threads(threads, || {
        let frame = expose(&scene, &plan, index, &stop, arguments.seed, &watch);
        bar.finish_and_clear();
        let mut frame = frame.map_err(|e| failed(&e))?;
        frame.provenance.scene_file.clone_from(&arguments.scene);
        frame.provenance.root.clone_from(&arguments.root);
        let files = Files { set, name };
        files.write(&frame, placed)?;
        files.write_frames(&frame, placed, arguments)?;
        files.set.finish()?;
        print(&report(&frame, placed, arguments))
    })
}

/// The camera that is asked for, or the only one.
pub(crate) fn chosen(scene: &Scene, name: Option<&str>) -> Result<usize, Failure> {
    let names: Vec<String> = scene.cameras.iter().map(|c| format!("`{}`", c.name)).collect();
    let wrong = |what: String, help: String| Err(Failure::Input(format!("error: {what}\n  = help: {help}")));
    match (name, names.len()) {
        (_, 0) => wrong(
            "the scene has no camera".to_owned(),
            "add `cameras: [(name: \"cam\", camera: \"../sensors/rgb-camera.ron\", at: (0, -1, 0), facing: (0, 1, 0))]`; `etendue measure` reads its \
             instruments"
                .to_owned(),
        ),
        (None, 1) => Ok(0),
        (None, _) => wrong("the scene has more than one camera".to_owned(), format!("choose one with --camera: {}", names.join(", "))),
        (Some(name), _) => match scene.cameras.iter().position(|c| c.name == name) {
            Some(index) => Ok(index),
            None => wrong(format!("the scene has no camera called `{name}`"), format!("cameras of this scene: {}", names.join(", "))),
        },
    }
}

/// A name that every file system takes.
fn file_name(name: &str) -> String {
    name.chars().map(|c| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' }).collect()
}

/// Endings of all files that will be written.
fn names(placed: &PlacedCamera, arguments: &Arguments) -> Vec<String> {
    let fixed = ["-expected_e.npy", "-uncertainty_e.npy", "-luminance_cd_m2.npy", ".exr", "-preview.png", "-luminance.png"];
    let mut names: Vec<String> = fixed.iter().map(ToString::to_string).collect();
    if !placed.regions.is_empty() {
        names.push("-regions.csv".to_owned());
    }
    for plane in 0..placed.camera.planes() {
        let channel = channel_part(placed, plane);
        names.extend((0..arguments.frames).map(|number| frame_ending(&channel, number, arguments.tiff)));
    }
    names
}

/// What tells the frames of a plane from those of the others: nothing where there is only one.
fn channel_part(placed: &PlacedCamera, plane: usize) -> String {
    if placed.camera.planes() == 1 { String::new() } else { format!("-{}", file_name(&placed.camera.channels[plane].name)) }
}

fn frame_ending(channel: &str, number: u64, tiff: bool) -> String {
    format!("{channel}-frame-{number:04}.{}", if tiff { "tiff" } else { "png" })
}

struct Files {
    set: FileSet,
    name: String,
}

/// An encoder fails for what cannot be encoded only, which a frame is not.
fn encoded(bytes: Result<Vec<u8>, ImageError>) -> Result<Vec<u8>, Failure> {
    bytes.map_err(|e| Failure::Run(format!("error: {e}")))
}

impl Files {
    fn save(&self, ending: &str, bytes: &[u8]) -> Result<(), Failure> {
        self.set.add(&format!("{}{ending}", self.name), bytes)
    }

    fn write(&self, frame: &Frame, placed: &PlacedCamera) -> Result<(), Failure> {
        let (columns, rows) = (frame.columns, frame.rows);
        let stacked = |of: &dyn Fn(&etendue::measurement::Plane) -> Vec<f64>| {
            let numbers: Vec<f64> = frame.planes.iter().flat_map(of).collect();
            let shape = if frame.planes.len() == 1 { vec![rows, columns] } else { vec![frame.planes.len(), rows, columns] };
            encoded(npy_f64(&numbers, &shape))
        };
        self.save("-expected_e.npy", &stacked(&|plane| plane.expected_e.clone())?)?;
        self.save("-uncertainty_e.npy", &stacked(&|plane| plane.standard_uncertainty_e.clone())?)?;
        self.save("-luminance_cd_m2.npy", &encoded(npy_f64(&frame.luminance_cd_m2, &[rows, columns]))?)?;
        let single = |numbers: &[f64]| numbers.iter().map(|&x| x as f32).collect::<Vec<f32>>();
        let mut channels: Vec<(String, Vec<f32>)> = vec![("Y".to_owned(), single(&frame.luminance_cd_m2))];
        for plane in &frame.planes {
            channels.push((format!("expected_e.{}", plane.name), single(&plane.expected_e)));
            channels.push((format!("uncertainty_e.{}", plane.name), single(&plane.standard_uncertainty_e)));
        }
        let channels: Vec<(&str, &[f32])> = channels.iter().map(|(name, numbers)| (name.as_str(), numbers.as_slice())).collect();
        self.save(".exr", &encoded(exr(&channels, columns, rows))?)?;
        self.save("-preview.png", &encoded(png8_rgb(&preview(frame, &placed.camera).rgb, columns, rows))?)?;
        let luminance = false_colour(frame);
        self.save("-luminance.png", &encoded(png8_rgb(&luminance.rgb, luminance.columns, luminance.rows))?)?;
        if !frame.readings.is_empty() {
            self.save("-regions.csv", csv::to_csv(&frame.measurement()).as_bytes())?;
        }
        Ok(())
    }

    /// A thread a frame: the memory of as many frames as there are threads, whatever their number.
    fn write_frames(&self, frame: &Frame, placed: &PlacedCamera, arguments: &Arguments) -> Result<(), Failure> {
        let Some(pixel) = &placed.camera.pixel else { return Ok(()) };
        let write: Encoder = if arguments.tiff { tiff16 } else { png16 };
        let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get) as u64;
        let workers = arguments.threads.unwrap_or(cores).min(arguments.frames);
        for (k, plane) in frame.planes.iter().enumerate() {
            let expected: Vec<f32> = plane.expected_e.iter().map(|&x| x as f32).collect();
            let channel = channel_part(placed, k);
            let work = |worker: u64| {
                let mut digital = vec![0u16; expected.len()];
                (worker..arguments.frames).step_by(workers as usize).try_for_each(|number| {
                    let exposure = Exposure {
                        exposure_s: placed.camera.exposure_s,
                        temperature_c: placed.camera.temperature_c,
                        // Each channel of a camera without a mosaic has a sensor of its own.
                        seed: arguments.seed.wrapping_add(k as u64),
                        frame: number,
                    };
                    pixel.expose_part(&exposure, 0, &expected, &mut digital);
                    let bytes = encoded(write(&digital, frame.columns, frame.rows))?;
                    self.save(&frame_ending(&channel, number, arguments.tiff), &bytes)
                })
            };
            let work = &work;
            let done: Vec<Result<(), Failure>> = std::thread::scope(|scope| {
                let threads: Vec<_> = (0..workers).map(|worker| scope.spawn(move || work(worker))).collect();
                let stopped = |_| Err(Failure::Run("error: a thread that wrote frames stopped".to_owned()));
                threads.into_iter().map(|thread| thread.join().unwrap_or_else(stopped)).collect()
            });
            done.into_iter().collect::<Result<(), Failure>>()?;
        }
        Ok(())
    }
}

/// What was done, in words.
fn report(frame: &Frame, placed: &PlacedCamera, arguments: &Arguments) -> String {
    frame.notes.iter().for_each(|note| complain(&format!("note: {note}")));
    let mut out = if frame.readings.is_empty() { format!("{}\n", frame.scene) } else { text::to_text(&frame.measurement()) };
    let most = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
    out += &format!(
        "\ncamera `{}`: {} × {} pixels, {} samples each in {} groups\n",
        frame.camera, frame.columns, frame.rows, frame.samples, frame.groups
    );
    for plane in &frame.planes {
        let relative: Vec<f64> =
            plane.expected_e.iter().zip(&plane.standard_uncertainty_e).filter(|(e, _)| **e > 0.0).map(|(e, u)| u / e).collect();
        let median = {
            let mut sorted = relative.clone();
            sorted.sort_by(f64::total_cmp);
            sorted.get(sorted.len() / 2).copied().unwrap_or(0.0)
        };
        let largest = most(&plane.expected_e);
        out += &format!("  {}: up to {largest:.4e} e⁻; u of half of the lit pixels at most {:.2e} of theirs\n", plane.name, median);
        if let Some(pixel) = placed.camera.pixel.filter(|pixel| largest > pixel.full_well_e) {
            out += &format!("  the brightest pixels saturate: their well holds {} e⁻\n", pixel.full_well_e);
        }
    }
    let preview = preview(frame, &placed.camera).rule;
    if let (Some(pixel), true) = (&placed.camera.pixel, arguments.frames > 0) {
        out += &format!(
            "  raw frames hold digital numbers 0 … {} in 16 bits, black at {}{}\n",
            pixel.largest_dn(),
            pixel.black_dn,
            if pixel.bits < 16 { ": a viewer that expects 0 … 65535 shows them dark; the preview is the picture to look at" } else { "" }
        );
    }
    out += &format!("  preview: {preview}\n  files in `{}`, {:.2} s\n", arguments.out.display(), frame.wall_seconds);
    out
}
