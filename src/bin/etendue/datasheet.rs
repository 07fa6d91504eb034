//! `etendue datasheet SENSOR`: every quality index, computed and measured.

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::ValueEnum;
use etendue::characterization::sheet::camera::{self, camera_sheet};
use etendue::characterization::sheet::{Options, SheetError, data_sheet};
use etendue::estimate::Watch;
use etendue::estimate::run::with_threads;
use etendue::report::datasheet::{to_json, to_text};
use etendue::report::emva::{sheet_to_json, sheet_to_text};
use etendue::scene::{Device, characterised_from_file};

use crate::file_set::FileSet;
use crate::measure::whole;
use crate::{Failure, disk, output, print};

/// The data sheet of a sensor or a camera: every quality index computed from its curves and measured on a virtual bench.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// A file that holds `Sensor(…)` or `Camera(…)`.
    sensor: String,
    /// How to write it.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Write sheet (.txt, .json) and pictures (.svg, .png) into this folder.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Seed of the readings that are sampled: the same seed gives the same bits.
    #[arg(long, value_name = "N", value_parser = whole(0, u64::MAX), allow_hyphen_values = true, default_value_t = 0)]
    seed: u64,
    /// Threads; as many as there are cores by default. Figures do not depend on it.
    #[arg(long, value_name = "N", value_parser = whole(1, 1024), allow_hyphen_values = true)]
    threads: Option<u64>,
    /// Step of the monochromator, 0.1 to 20 nm.
    #[arg(long, value_name = "NM", default_value = "1", allow_hyphen_values = true)]
    step: f64,
    /// Wavelength of the flat field of a camera, nm in air, 100 to 20000; the peak of each channel by default.
    #[arg(long, value_name = "NM", value_parser = wavelength_nm, allow_hyphen_values = true)]
    wavelength: Option<f64>,
}

fn wavelength_nm(given: &str) -> Result<f64, String> {
    let found = given.trim().parse().ok().filter(|nm| (100.0..=20_000.0).contains(nm));
    found.ok_or_else(|| "a wavelength from 100 to 20000 nm, such as 525".to_owned())
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    /// A page for a person.
    Text,
    /// Everything, for programs.
    Json,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let device =
        characterised_from_file(&arguments.sensor, &disk::Anywhere, None).map_err(|problems| Failure::Input(problems.to_string()))?;
    if let Some(folder) = &arguments.out {
        let help = "--out takes a folder that can be written";
        std::fs::create_dir_all(folder).map_err(|e| disk::unwritable(folder, &e, help))?;
    }
    let pages = match device {
        Device::Sensor(_) if arguments.wavelength.is_some() => {
            let words = "error: --wavelength is for cameras; a meter is led through all wavelengths, in steps that --step sets";
            return Err(Failure::Input(words.to_owned()));
        }
        Device::Sensor(sensor) => {
            let options = Options { seed: arguments.seed, step_nm: arguments.step };
            let sheet = arguments.measured(|watch| data_sheet(&sensor, &options, watch))?;
            Pages { text: to_text(&sheet), json: to_json(&sheet), pictures: pictures_of_meter(&sheet) }
        }
        Device::Camera(camera) => {
            let options = camera::Options { seed: arguments.seed, wavelength_nm: arguments.wavelength };
            let sheet = arguments.measured(|watch| camera_sheet(&camera, &options, watch))?;
            Pages { text: sheet_to_text(&sheet), json: sheet_to_json(&sheet), pictures: pictures_of_camera(&sheet) }
        }
    };
    match (&arguments.out, arguments.format) {
        (Some(folder), _) => pages.save(folder),
        (None, Format::Text) => print(&pages.text),
        (None, Format::Json) => print(&pages.json),
    }
}

impl Arguments {
    fn measured<T: Send>(&self, sheet: impl FnOnce(&Watch<'_>) -> Result<T, SheetError> + Send) -> Result<T, Failure> {
        let bar = output::progress_bar();
        let start = Instant::now();
        let watch = Watch { now: &|| start.elapsed().as_secs_f64(), progress: &|share| bar.set_position((1000.0 * share) as u64) };
        let threads = self.threads.and_then(|n| usize::try_from(n).ok());
        let sheet = with_threads(threads, || sheet(&watch));
        bar.finish_and_clear();
        sheet.map_err(|e| Failure::Input(format!("error: {}: {e}", self.sensor)))
    }
}

/// A sheet as it is written.
struct Pages {
    text: String,
    json: String,
    pictures: Pictures,
}

impl Pages {
    fn save(self, folder: &Path) -> Result<(), Failure> {
        let mut files: Vec<(String, Vec<u8>)> =
            vec![("sheet.txt".to_owned(), self.text.into_bytes()), ("sheet.json".to_owned(), self.json.into_bytes())];
        files.extend(drawn(&self.pictures)?);
        let set = FileSet::new(folder, files.iter().map(|(name, _)| name.clone()), "--out takes a folder that can be written")?;
        files.iter().try_for_each(|(name, bytes)| set.add(name, bytes))?;
        crate::complain(&format!("wrote {} in {}", set.finish()?.join(", "), folder.display()));
        Ok(())
    }
}

#[cfg(feature = "plot")]
use etendue::report::{datasheet::chart::charts as pictures_of_meter, emva::chart::charts as pictures_of_camera};

/// Charts with the stems of their files.
#[cfg(feature = "plot")]
type Pictures = Vec<(String, etendue::report::plot::chart::Chart)>;

#[cfg(feature = "plot")]
fn drawn(pictures: &Pictures) -> Result<Vec<(String, Vec<u8>)>, Failure> {
    use etendue::report::plot::{self, Size, Style, Theme};
    let failed = |e: plot::PlotError| Failure::Run(format!("error: {e}"));
    let mut files = Vec::new();
    for (stem, chart) in pictures {
        let svg = plot::svg(chart, &Style { theme: Theme::Light, size: Size::Paper }).map_err(failed)?;
        files.push((format!("{stem}.png"), plot::png(&svg, 2.0).map_err(failed)?));
        files.push((format!("{stem}.svg"), svg.into_bytes()));
    }
    Ok(files)
}

/// Without the feature `plot` there is nothing to draw.
#[cfg(not(feature = "plot"))]
type Pictures = ();

#[cfg(not(feature = "plot"))]
fn pictures_of_meter(_: &etendue::characterization::sheet::DataSheet) -> Pictures {}

#[cfg(not(feature = "plot"))]
fn pictures_of_camera(_: &camera::CameraSheet) -> Pictures {}

#[cfg(not(feature = "plot"))]
fn drawn((): &Pictures) -> Result<Vec<(String, Vec<u8>)>, Failure> {
    Ok(Vec::new())
}
