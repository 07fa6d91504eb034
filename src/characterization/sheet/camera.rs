//! The data sheet of a camera: the figures of EMVA 1288, computed from the parameters and measured from frames of a flat field.
//!
//! ```text
//! port of a sphere at f/8 ── readings by the engine ──→ photons, electrons ── frames ──→ photon transfer ──→ measured ┐
//! parameters ── linear camera model ────────────────────────────────────────────────────────────────────→ computed ┴→ deviation in u
//! η = g η_channel(λ) ⟨R⟩
//! ```
//!
//! | symbol | what |
//! |---|---|
//! | g | fill factor: photons are counted on the whole pixel |
//! | η_channel | quantum efficiency of a channel at the wavelength of the light, that of its peak if none is given |
//! | ⟨R⟩ | mean response of the micro-lenses over the port; 1 without any |
//!
//! The lens is taken off, as EMVA 1288 asks. Frames are of pixels that are all behind the same filter. The exposure times rise in equal steps
//! to just past saturation: the longest is that of the camera, or that in which the dark current brings as much noise as the readout if it is
//! longer, so that the dark current can be told from the noise.
//!
//! **Limits.** The computed saturation is that of a single pixel. The measured one is the level of largest variance, smeared by the PRNU and
//! picked among noisy variances that rise slowly before the peak and fall steeply behind it: it lies about one standard uncertainty below on
//! average, and so do SNR_max and DR. The lens is not measured, and its transmittance is not in η.
//!
//! ```
//! use etendue::characterization::sheet::camera::{Options, camera_sheet};
//! use etendue::{estimate::Watch, scene::{Device, MemoryFiles, device_from_file}};
//!
//! let files = MemoryFiles::new().with("camera.ron", r#"Camera(
//!     lens: Thin(focal_length_mm: 8, f_number: 2.8, focus_m: 2), columns: 64, rows: 64, pitch_um: 5, exposure_ms: 10,
//!     channels: [(name: "grey", quantum_efficiency: 0.6)],
//!     pixel: Pixel(gain_dn_per_e: 0.35, full_well_e: 10500, bits: 12, black_dn: 64, read_noise_e: 4, dark_current_e_s: 0, dsnu_e: 2, prnu: 0.01),
//! )"#);
//! let Device::Camera(camera) = device_from_file("camera.ron", &files, None)? else { return Err("no camera".into()) };
//! let watch = Watch { now: &|| 0.0, progress: &|_| {} };
//! let sheet = camera_sheet(&camera, &Options { wavelength_nm: Some(525.0), ..Options::default() }, &watch)?;
//! let efficiency = &sheet.channels[0].comparisons[0];
//! assert!((efficiency.computed.value - 0.6).abs() < 1e-12 && efficiency.deviation_u() < 4.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use std::f64::consts::TAU;

use super::SheetError;
use crate::characterization::Figure;
use crate::characterization::bench::Bench;
use crate::characterization::emva::{self, Figures, PAST_SATURATION, Series, Shot, photon_transfer};
use crate::estimate::Watch;
use crate::estimate::frames::expose_into;
use crate::quantity::Measurand;
use crate::sensor::camera::{Camera, ColourChannel};
use crate::sensor::pixel::light::irradiance_at_f_number;
use crate::sensor::{Acceptance, Aperture, Channel, DirectionalResponse, Exposure, Pixel, Sensor};
use crate::spectrum::photometry::{WavelengthsIn, photons_per_joule};
use crate::spectrum::{Density, Factor};

/// F-number of the port, distance over diameter.
pub const F_NUMBER: f64 = 8.0;
/// Columns and rows of a frame.
pub const SIDE: usize = 128;
/// Levels of rising light.
pub const LEVELS: usize = 50;
/// Frames of each of the two stacks.
pub const STACK: u64 = 32;
/// Largest share of the well that the dark current may fill in the longest exposure.
const MOST_DARK: f64 = 0.05;
/// Wavelengths among which the peak of a channel is looked for, nm in air.
const PEAKS_NM: (f64, f64) = (200.0, 2500.0);
/// Places of the port, in each of two directions, where micro-lenses are asked.
const PLACES: u32 = 64;

/// How the bench is run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Options {
    /// Seed of the pattern and of all noise.
    pub seed: u64,
    /// Wavelength of the light in air, nm; that of the peak of each channel if `None`.
    pub wavelength_nm: Option<f64>,
}

/// A figure by both routes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// Name for programs, with the unit.
    pub key: &'static str,
    /// Symbol of the standard.
    pub symbol: &'static str,
    /// What it is.
    pub name: &'static str,
    /// Unit of both; 1 for a number.
    pub unit: &'static str,
    /// From the parameters.
    pub computed: Figure,
    /// From frames.
    pub measured: Figure,
    /// What has to be known about the measured value.
    pub note: Option<&'static str>,
}

impl Comparison {
    /// |difference| of the two routes in joint standard uncertainties.
    #[must_use]
    pub fn deviation_u(&self) -> f64 {
        self.computed.deviation_u(&self.measured)
    }
}

/// What the pixels behind one filter are like.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraChannelSheet {
    /// Name in the camera file.
    pub name: String,
    /// Wavelength of the light in air, nm.
    pub wavelength_nm: f64,
    /// Photons a second on a pixel, read by the engine.
    pub photons_per_s: Figure,
    /// Longest exposure, s.
    pub longest_s: f64,
    /// Every figure, in the order of a data sheet.
    pub comparisons: Vec<Comparison>,
    /// What was measured: figures, photon-transfer curve, stacks.
    pub measured: Figures,
}

/// A data sheet of a camera.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraSheet {
    /// Title of the camera.
    pub title: String,
    /// Temperature of the sensor, °C.
    pub temperature_c: f64,
    /// A sheet for each channel.
    pub channels: Vec<CameraChannelSheet>,
    /// Readings that were taken of the flat field, and rays that were traced for them.
    pub tally: (usize, u64),
    /// Frames that were taken.
    pub frames: u64,
    /// How the bench was run.
    pub options: Options,
}

/// Computes and measures the data sheet of a camera. `watch.progress` is told the share that is done.
///
/// # Errors
/// A camera without a pixel or a channel, a wavelength at which a channel sees nothing, frames that show no figures.
pub fn camera_sheet(camera: &Camera, options: &Options, watch: &Watch<'_>) -> Result<CameraSheet, SheetError> {
    let pixel = camera.pixel.as_ref().ok_or(SheetError::NoPixel)?;
    if camera.channels.is_empty() {
        return Err(SheetError::NoChannel);
    }
    let mut sheet = CameraSheet {
        title: camera.title.clone(),
        temperature_c: camera.temperature_c,
        channels: Vec::with_capacity(camera.channels.len()),
        tally: (0, 0),
        frames: 0,
        options: *options,
    };
    for index in 0..camera.channels.len() {
        let share = |part: f64| (watch.progress)((index as f64 + part) / camera.channels.len() as f64);
        sheet.characterise(camera, pixel, index, &Watch { now: watch.now, progress: &share })?;
    }
    Ok(sheet)
}

impl CameraSheet {
    fn characterise(&mut self, camera: &Camera, pixel: &Pixel, index: usize, watch: &Watch<'_>) -> Result<(), SheetError> {
        let channel = &camera.channels[index];
        let (wavelength_nm, efficiency) = light_for(channel, self.options.wavelength_nm)?;
        let efficiency = camera.fill_factor * efficiency * camera.angular_response.as_ref().map_or(1.0, mean_over_port);
        let temperature_c = camera.temperature_c;
        let dark_e_s = pixel.dark_current_at(temperature_c);
        let hard_e = pixel.linear(0.0, temperature_c).hard_limit_e();
        let longest_s = longest_exposure_s(camera.exposure_s, pixel.read_noise_e, dark_e_s, hard_e);

        // The lamp is set by the closed form, and read by the engine.
        let electrons_per_s = PAST_SATURATION * hard_e / longest_s - dark_e_s;
        emva::longest_exposure_s(pixel, temperature_c, electrons_per_s)
            .map_err(|error| SheetError::Frames { channel: channel.name.clone(), error })?;
        let per_joule = photons_per_joule(WavelengthsIn::StandardAir).at(wavelength_nm);
        let per_radiance = irradiance_at_f_number(1.0, F_NUMBER) * per_joule * camera.pitch_m * camera.pitch_m;
        let lamp = Density::line(wavelength_nm, electrons_per_s / (efficiency * per_radiance))?;
        let counter = Bench::new(photon_counter(), self.options.seed, watch);
        let bench = counter.with(pixels_behind_filter(camera, channel));
        let (Some(photons), Some(electrons)) = (counter.port(&lamp, F_NUMBER)?.pop(), bench.port(&lamp, F_NUMBER)?.pop()) else {
            return Err(SheetError::NoChannel);
        };
        bench.count(&counter);
        let relative = |x: Figure| x.standard_uncertainty / x.value;
        let photons_per_s = photons.scaled(camera.pitch_m * camera.pitch_m);
        let electrons_per_photon = electrons.value / photons.value;

        let mut series = Series::by_exposure_time(SIDE, SIDE, photons_per_s.value, longest_s, LEVELS, STACK);
        series.u_photons = relative(photons).hypot(relative(electrons));
        // Other pixels behind another filter.
        let seed = self.options.seed.wrapping_add(index as u64);
        let mut expected_e = vec![0f32; SIDE * SIDE];
        let whole = (4 * LEVELS) as f64 + 2.0 * STACK as f64;
        let measured = photon_transfer(&series, &mut |shot: &Shot, frame: &mut [u16]| {
            expected_e.fill((electrons_per_photon * shot.photons) as f32);
            expose_into(pixel, &Exposure { exposure_s: shot.exposure_s, temperature_c, seed, frame: shot.number }, &expected_e, frame);
            self.frames += 1;
            (watch.progress)((shot.number + 1) as f64 / whole);
            Ok(())
        })
        .map_err(|error| SheetError::Frames { channel: channel.name.clone(), error })?;

        let (readings, rays) = bench.tally();
        self.tally = (self.tally.0 + readings, self.tally.1 + rays);
        let expected = emva::expected(pixel, efficiency, temperature_c, longest_s / PAST_SATURATION);
        let comparisons = measured.list.iter().filter_map(|found| compared(found, &expected)).collect();
        self.channels.push(CameraChannelSheet {
            name: channel.name.clone(),
            wavelength_nm,
            photons_per_s,
            longest_s,
            comparisons,
            measured,
        });
        Ok(())
    }
}

/// A measured figure beside the one that the parameters give.
fn compared(found: &emva::Figure, expected: &[(&'static str, f64)]) -> Option<Comparison> {
    let (_, value) = expected.iter().find(|(key, _)| *key == found.key)?;
    let emva::Figure { key, symbol, name, unit, note, .. } = *found;
    let measured = Figure { value: found.value, standard_uncertainty: found.standard_uncertainty };
    Some(Comparison { key, symbol, name, unit, computed: Figure::exact(*value, *value), measured, note })
}

/// Wavelength of the light for a channel, nm, and its quantum efficiency there, above 0.
fn light_for(channel: &ColourChannel, wavelength_nm: Option<f64>) -> Result<(f64, f64), SheetError> {
    let at = |nm: f64| channel.quantum_efficiency.at(nm);
    let wavelength_nm = wavelength_nm.unwrap_or_else(|| {
        let whole = (PEAKS_NM.0 as u32..=PEAKS_NM.1 as u32).map(f64::from);
        whole.fold(PEAKS_NM.0, |best, nm| if at(nm) > at(best) { nm } else { best })
    });
    match at(wavelength_nm) {
        efficiency if efficiency > 0.0 => Ok((wavelength_nm, efficiency)),
        _ => Err(SheetError::Blind { channel: channel.name.clone(), wavelength_nm }),
    }
}

fn longest_exposure_s(own_s: f64, read_noise_e: f64, dark_e_s: f64, hard_e: f64) -> f64 {
    if dark_e_s > 0.0 { own_s.max(read_noise_e * read_noise_e / dark_e_s).min(MOST_DARK * hard_e / dark_e_s) } else { own_s }
}

/// An ideal counter of photons in the plane of the pixels, per second and square metre.
fn photon_counter() -> Sensor {
    in_the_plane("photons", photons_per_joule(WavelengthsIn::StandardAir), 1.0, Acceptance::Cosine)
}

/// The pixels of a channel, without the lens: electrons per second and square metre.
fn pixels_behind_filter(camera: &Camera, channel: &ColourChannel) -> Sensor {
    let electrons = Factor::Product(vec![channel.quantum_efficiency.clone(), photons_per_joule(WavelengthsIn::StandardAir)]);
    let acceptance = camera.angular_response.clone().map_or(Acceptance::Cosine, Acceptance::Directional);
    in_the_plane("electrons", electrons, camera.fill_factor, acceptance)
}

fn in_the_plane(counts: &str, per_joule: Factor, scale: f64, acceptance: Acceptance) -> Sensor {
    let channel = Channel::new(counts, per_joule, Measurand::Signal { unit: "1/(m² s)".to_owned() }, scale);
    Sensor::new("plane of the pixels", Aperture::Point, acceptance, vec![channel])
}

/// Mean of a directional response over the port, with the cosine: even in sin²θ and in azimuth.
fn mean_over_port(response: &DirectionalResponse) -> f64 {
    let widest = 1.0 / (1.0 + 4.0 * F_NUMBER * F_NUMBER);
    let middle = |k: u32| (f64::from(k) + 0.5) / f64::from(PLACES);
    let places = (0..PLACES).flat_map(|i| (0..PLACES).map(move |j| (i, j)));
    let sum: f64 = places.map(|(i, j)| response.at((widest * middle(i)).sqrt().asin(), TAU * middle(j))).sum();
    sum / f64::from(PLACES).powi(2)
}
