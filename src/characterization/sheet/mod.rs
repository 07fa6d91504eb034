//! The data sheet of a sensor: every index computed from the curves and measured on the virtual bench. A camera has one of its own: [`camera`].
//!
//! ```text
//! curves ── exact integrals ──────────────────→ computed ┐
//! sensor ── bench: readings by the engine ──→ measured ┴→ deviation in u, class with its probability
//! ```
//!
//! | file | what |
//! |---|---|
//! | `target` | what a channel is meant to weigh with |
//! | `spectral` | f1′, u, r, mean wavelength, mismatch factors of lamps |
//! | `readout` | f3, f11 |
//! | `directional` | f2, flat field, measuring field |
//! | `camera` | the figures of EMVA 1288 of a camera |
//! | `mod.rs` | indices, classes, the sheet as a whole |
//!
//! ```
//! use etendue::characterization::sheet::{Options, data_sheet};
//! use etendue::{estimate::Watch, scene};
//!
//! let files = scene::MemoryFiles::new().with("ideal.ron", r#"Sensor(title: "ideal", aperture: Point, acceptance: Cosine,
//!     channels: [(name: "E_v", responsivity: "V", reads: Illuminance)])"#);
//! let sensor = scene::sensor_from_file("ideal.ron", &files, None)?;
//! let watch = Watch { now: &|| 0.0, progress: &|_| {} };
//! let sheet = data_sheet(&sensor, &Options::default(), &watch)?;
//! let f1 = &sheet.channels[0].indices[0];
//! assert_eq!(f1.symbol, "f1′");
//! assert!(f1.measured.value <= 2.0 * f1.measured.standard_uncertainty);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod camera;
mod directional;
mod readout;
mod spectral;
mod target;

use std::fmt;

pub use directional::{LARGEST_ANGLE_DEG, Receptor};
pub use spectral::LAMPS;
pub use target::Target;

use super::bench::goniometer::Goniogram;
use super::bench::{Bench, BenchError};
use super::class_limits::{self, Classified, Limits};
use super::directional_mismatch::DirectionalError;
use super::emva::EmvaError;
use super::spectral_mismatch::MismatchError;
use super::{Figure, figure::in_quadrature};
use crate::estimate::Watch;
use crate::quantity::Measurand;
use crate::sensor::{Acceptance, Sensor};
use crate::spectrum::SpectrumError;

/// Indices that every illuminance meter has; one that is absent is not known. Without ranges there is no f11, and nothing is missing.
const NEEDED: [&str; 5] = ["f1′", "u", "r", "f2", "f3"];

/// How the bench is run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Seed of the readings that are sampled.
    pub seed: u64,
    /// Step of the monochromator, nm.
    pub step_nm: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self { seed: 0, step_nm: 1.0 }
    }
}

/// One quality index, by both routes.
#[derive(Clone, Debug, PartialEq)]
pub struct Index {
    /// Symbol: "f1′".
    pub symbol: &'static str,
    /// In words.
    pub name: &'static str,
    /// Unit of both figures.
    pub unit: &'static str,
    /// From the curves.
    pub computed: Figure,
    /// On the bench.
    pub measured: Figure,
    /// What the stated uncertainty of the curves makes uncertain in both, standard uncertainty in the same unit.
    pub stated_u: f64,
    /// Limits of the classes, where there are any.
    pub limits: Option<&'static Limits>,
    /// Source, filter, angles: what the number depends on.
    pub conditions: String,
}

impl Index {
    /// |difference| of the two routes in joint standard uncertainties.
    #[must_use]
    pub fn deviation_u(&self) -> f64 {
        self.computed.deviation_u(&self.measured)
    }

    /// Standard uncertainty of the measured figure, the stated uncertainty of the curves included.
    #[must_use]
    pub fn standard_uncertainty(&self) -> f64 {
        self.measured.standard_uncertainty.hypot(self.stated_u)
    }

    /// The class of the measured figure, with the probability that it is within the limit.
    #[must_use]
    pub fn classified(&self) -> Option<Classified> {
        self.limits.map(|limits| limits.classify(self.measured.value, self.standard_uncertainty()))
    }
}

/// An index that the sensor does not have, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Absent {
    /// Symbol.
    pub symbol: &'static str,
    /// Why there is none.
    pub why: String,
}

/// Mismatch correction factor for a lamp: true = reading × F after adjustment.
#[derive(Clone, Debug, PartialEq)]
pub struct Lamp {
    /// Name in the library.
    pub name: String,
    /// F from the curves.
    pub computed: Figure,
    /// F by substitution of an ideal meter on the bench.
    pub measured: Figure,
}

/// A spectral responsivity that was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Responsivity {
    /// Wavelengths, nm.
    pub wavelengths_nm: Vec<f64>,
    /// Readings, per W/m², in the unit of the channel.
    pub readings: Vec<Figure>,
}

/// What a channel is like.
#[derive(Clone, Debug, PartialEq)]
pub struct ChannelSheet {
    /// Name in the sensor file.
    pub name: String,
    /// What it reads.
    pub reads: Measurand,
    /// What it is meant to weigh with; `None` where the measurand does not say.
    pub target: Option<Target>,
    /// Indices of the spectral responsivity.
    pub indices: Vec<Index>,
    /// Mismatch of lamps.
    pub lamps: Vec<Lamp>,
    /// What it does not have.
    pub absent: Vec<Absent>,
    /// The measured responsivity.
    pub responsivity: Responsivity,
    /// Symbols of the indices that have limits and are not known: class and total are at best what is said here.
    pub unknown: Vec<&'static str>,
    /// Class by all indices that have limits and are known, those of the directional response included; for illuminance meters.
    pub class: Option<Classified>,
    /// Sum of the indices that have limits, %, with the class of the sum; for illuminance meters.
    pub total: Option<(Figure, Classified)>,
}

/// A data sheet.
#[derive(Clone, Debug, PartialEq)]
pub struct DataSheet {
    /// Title of the sensor.
    pub title: String,
    /// What kind of receptor it has.
    pub receptor: Receptor,
    /// Indices of the directional response.
    pub directional: Vec<Index>,
    /// What the directional response does not have.
    pub absent: Vec<Absent>,
    /// The measured directional response of a planar receptor.
    pub goniogram: Option<Goniogram>,
    /// A sheet for each channel.
    pub channels: Vec<ChannelSheet>,
    /// Readings that were taken, and rays that were traced for them.
    pub tally: (usize, u64),
    /// How the bench was run.
    pub options: Options,
}

/// Why there is no data sheet.
#[derive(Debug, Clone, PartialEq)]
pub enum SheetError {
    /// The sensor has no channel.
    NoChannel,
    /// The options are out of range.
    Step(f64),
    /// The bench has no reading.
    Bench(BenchError),
    /// The spectral responsivity of a channel has no index.
    Spectral {
        /// Name of the channel.
        channel: String,
        /// What is wrong.
        error: MismatchError,
    },
    /// The directional response has no index.
    Directional(DirectionalError),
    /// The camera has no pixel, so it takes no frames.
    NoPixel,
    /// A channel of a camera sees nothing of the light of the flat field.
    Blind {
        /// Name of the channel.
        channel: String,
        /// Wavelength in air, nm.
        wavelength_nm: f64,
    },
    /// The frames of a camera give no figures.
    Frames {
        /// Name of the channel.
        channel: String,
        /// What is wrong.
        error: EmvaError,
    },
}

impl fmt::Display for SheetError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoChannel => f.write_str("the sensor has no channel, so there is nothing to characterise; give it one"),
            Self::Step(step) => write!(f, "the step of the monochromator is {step} nm; allowed: 0.1 nm to 20 nm"),
            Self::Bench(error) => {
                write!(f, "{error}; a data sheet compares with that reading: give the sensor a response there")
            }
            Self::Spectral { channel, error } => write!(f, "channel `{channel}` has no mismatch index: {error}"),
            Self::Directional(error) => write!(f, "the directional response has no index: {error}"),
            Self::NoPixel => f.write_str(
                "the camera has no `pixel`, so it gives expected electrons and no frames to measure; add `pixel: Pixel(gain_dn_per_e: 0.35, \
                 full_well_e: 10500, bits: 12, black_dn: 64, read_noise_e: 3, dark_current_e_s: 5, dsnu_e: 1.5, prnu: 0.006)`",
            ),
            Self::Blind { channel, wavelength_nm } => {
                write!(f, "channel `{channel}` has no quantum efficiency at {wavelength_nm} nm; choose a wavelength in nm that it sees")
            }
            Self::Frames { channel, error } => write!(f, "the frames of channel `{channel}` give no figures: {error}"),
        }
    }
}

impl std::error::Error for SheetError {}

impl From<BenchError> for SheetError {
    fn from(error: BenchError) -> Self {
        Self::Bench(error)
    }
}

impl From<SpectrumError> for SheetError {
    fn from(error: SpectrumError) -> Self {
        Self::Bench(BenchError::Spectrum(error))
    }
}

impl From<DirectionalError> for SheetError {
    fn from(error: DirectionalError) -> Self {
        Self::Directional(error)
    }
}

/// Computes and measures the data sheet of a sensor. `watch.progress` is told the share that is done.
///
/// # Errors
/// [`SheetError`].
pub fn data_sheet(sensor: &Sensor, options: &Options, watch: &Watch<'_>) -> Result<DataSheet, SheetError> {
    if sensor.channels.is_empty() {
        return Err(SheetError::NoChannel);
    }
    if !(0.1..=20.0).contains(&options.step_nm) {
        return Err(SheetError::Step(options.step_nm));
    }
    // The optical part by itself; the electronics come in where they are the subject.
    let optics = Sensor { readout: None, ..sensor.clone() };
    let turned = Bench::new(optics.clone(), options.seed, watch);
    let directional = directional::characterise(&turned)?;
    let sensor = &without_lens(sensor);
    let bench = Bench::new(without_lens(&optics), options.seed, watch);
    bench.count(&turned);
    (watch.progress)(0.3);
    let (from_nm, to_nm) = spectral::range_nm(sensor);
    let spectrogram = bench.spectrogram(from_nm, to_nm, options.step_nm)?;
    (watch.progress)(0.7);
    let mut channels = Vec::with_capacity(sensor.channels.len());
    for (index, channel) in sensor.channels.iter().enumerate() {
        let mut sheet = spectral::characterise(&bench, sensor, index, &spectrogram)?;
        if spectral::is_illuminance(channel) {
            let all = || sheet.indices.iter().chain(&directional.indices);
            let judged: Vec<_> = all().filter_map(|i| Some((i.limits?, i.measured.value, i.standard_uncertainty()))).collect();
            let absent = sheet.absent.iter().chain(&directional.absent).map(|absent| absent.symbol);
            sheet.unknown = absent.filter(|symbol| NEEDED.contains(symbol)).collect();
            sheet.class = class_limits::worst(&judged);
            sheet.total = total(&judged);
        }
        channels.push(sheet);
        (watch.progress)(0.7 + 0.3 * (index + 1) as f64 / sensor.channels.len() as f64);
    }
    Ok(DataSheet {
        title: sensor.title.clone(),
        receptor: directional.receptor,
        directional: directional.indices,
        absent: directional.absent,
        goniogram: directional.goniogram,
        channels,
        tally: bench.tally(),
        options: *options,
    })
}

/// A sensor whose lens is taken off: what it makes of a spectrum does not depend on where it is focused, and has a formula without it.
fn without_lens(sensor: &Sensor) -> Sensor {
    match &sensor.acceptance {
        Acceptance::Spot(spot) => Sensor { acceptance: Acceptance::Cone { half_angle_rad: spot.half_angle_rad }, ..sensor.clone() },
        _ => sensor.clone(),
    }
}

/// Sum of indices and its class: linear, as the manual that the limits are from adds them.
fn total(judged: &[(&Limits, f64, f64)]) -> Option<(Figure, Classified)> {
    let limits = class_limits::limits("total")?;
    let u: Vec<f64> = judged.iter().map(|(.., u)| *u).collect();
    let sum = Figure { value: judged.iter().map(|(_, value, _)| value).sum(), standard_uncertainty: in_quadrature(&u) };
    Some((sum, limits.classify(sum.value, sum.standard_uncertainty)))
}
