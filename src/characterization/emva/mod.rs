//! The figures of EMVA 1288, measured from frames: photon transfer at rising light, stacks for the fixed pattern.
//!
//! ```text
//! K = slope of (σ_y² − σ_y.dark²) over (μ_y − μ_y.dark)       R = slope of (μ_y − μ_y.dark) over μ_p       η = R/K
//! both through the origin, up to 70 % of saturation           saturation: where σ_y² is largest
//! ```
//!
//! | figure | from |
//! |---|---|
//! | K, R, η | pairs of frames at every level, and pairs in the dark |
//! | σ_y.dark, σ_d | the dark variance, extrapolated to no exposure time |
//! | μ_I | slope of the dark mean over the exposure time; once more from the variance |
//! | μ_p.sat, μ_e.sat, SNR_max, μ_p.min, DR | these |
//! | DSNU, PRNU | a stack of frames in the dark and one at about half of saturation |
//! | linearity error | deviations from a line with relative weights, 5 % to 95 % of saturation |
//!
//! Each figure carries a standard uncertainty. It holds what the frames cannot tell: temporal noise of means and variances, the finite
//! number of pixels, the step of the levels where the saturation is read off, and the stated uncertainty of the photons. The noise of a
//! variance is that of a normal one.
//!
//! Frames are taken one by one and not kept: memory is that of two stacks, whatever the number of levels and frames.
//!
//! **Source and limits.** EMVA Standard 1288, release 4.0 linear, sections 5 to 8, as the package emva1288 1.0.2 computes it; the text of the
//! standard was not at hand. Three things differ on purpose: the absolute threshold is the exact root of SNR = 1 and not the short form;
//! the largest variance is that of all levels; the variance in the dark is not lifted to 0.24 DN² but marked where it is lower. Not
//! measured: spectrograms, histograms, defect pixels, spectral and thermal series.
//!
//! ```
//! use etendue::characterization::emva::{Series, photon_transfer};
//! use etendue::sensor::Pixel;
//!
//! let pixel = Pixel { read_noise_e: 8.0, dsnu_e: 3.0, prnu: 0.01, ..Pixel::ideal(0.25, 14000.0, 64.0, 12) };
//! // 60 % quantum efficiency under a light of 10⁶ photons a second and pixel, exposure times up to saturation.
//! let series = Series::by_exposure_time(64, 64, 1e6, 0.0242, 40, 16);
//! let figures = photon_transfer(&series, &mut |shot, frame| {
//!     let electrons = vec![(0.6 * shot.photons) as f32; frame.len()];
//!     frame.copy_from_slice(&pixel.expose(&electrons, shot.exposure_s, 20.0, 1, shot.number));
//!     Ok(())
//! })?;
//! let gain = figures.get("gain_dn_per_e").ok_or("no gain")?;
//! assert!((gain.value - 0.25).abs() < 4.0 * gain.standard_uncertainty);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod error;
mod figures;
mod fit;
mod model;
mod range;
pub mod statistics;
#[cfg(test)]
mod tests;

pub use error::EmvaError;
pub use figures::{FITTED_UP_TO, Figure, Figures};
pub use model::expected;
pub use range::longest_exposure_s;
use statistics::{Pair, Spatial, Stack};

/// The longest exposure of a series, in times that fill the well or reach the end of the ADC: just past saturation.
pub const PAST_SATURATION: f64 = 1.04;

/// Light and time of a level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level {
    /// Exposure time, s.
    pub exposure_s: f64,
    /// Mean photons on a pixel in that time, above 0.
    pub photons: f64,
}

/// Which frames are to be taken.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Rows of a frame, at least 3.
    pub rows: usize,
    /// Columns of a frame, at least 3.
    pub columns: usize,
    /// Levels of rising light, at least 8. Two bright frames at each, and two in the dark at every exposure time.
    pub levels: Vec<Level>,
    /// The level of the bright stack: about half of saturation.
    pub stack_level: usize,
    /// Frames of each of the two stacks, at least 2.
    pub stack_frames: u64,
    /// Relative standard uncertainty of the photons, common to all levels.
    pub u_photons: f64,
}

/// A frame to be taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shot {
    /// Exposure time, s.
    pub exposure_s: f64,
    /// Mean photons on a pixel; 0 in the dark.
    pub photons: f64,
    /// Running number of the frame, from 0: no two frames have the same noise.
    pub number: u64,
    /// Whether it belongs to a stack, and not to a pair.
    pub of_stack: bool,
}

/// What was measured at a level: a point of the photon-transfer curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TransferPoint {
    /// Light and time.
    pub level: Level,
    /// Two bright frames.
    pub bright: Pair,
    /// Two frames in the dark of the same exposure time.
    pub dark: Pair,
    /// Which pair in the dark it is: levels of the same exposure time share one.
    pub dark_number: usize,
}

/// Whoever takes the frames: fills the slice, row by row, or says why not.
pub type Camera<'c> = dyn FnMut(&Shot, &mut [u16]) -> Result<(), String> + 'c;

impl Series {
    /// `levels` exposure times in equal steps up to `longest_s`, of a light of `photons_per_s` on a pixel, with stacks of `stack_frames`
    /// frames. The stacks are taken at half of the longest time, so the longest should be just past saturation.
    #[must_use]
    pub fn by_exposure_time(rows: usize, columns: usize, photons_per_s: f64, longest_s: f64, levels: usize, stack_frames: u64) -> Series {
        let times = (1..=levels).map(|i| longest_s * i as f64 / levels as f64);
        let levels: Vec<Level> = times.map(|exposure_s| Level { exposure_s, photons: photons_per_s * exposure_s }).collect();
        Series { rows, columns, stack_level: levels.len() / 2, levels, stack_frames, u_photons: 0.0 }
    }

    fn check(&self) -> Result<(), EmvaError> {
        let wrong = |words: String| Err(EmvaError::Series(words));
        if self.rows < 3 || self.columns < 3 {
            return wrong(format!("frames of {} × {} pixels are too small; allowed: 3 × 3 and more", self.columns, self.rows));
        }
        if self.levels.len() < 8 {
            return wrong(format!("{} levels are too few for a photon-transfer curve; allowed: 8 and more", self.levels.len()));
        }
        if !(2..=statistics::MOST_FRAMES).contains(&self.stack_frames) || self.stack_level >= self.levels.len() {
            return wrong(format!("stacks need 2 to {} frames at one of the levels", statistics::MOST_FRAMES));
        }
        let usable = |level: &Level| level.photons > 0.0 && level.photons.is_finite() && level.exposure_s >= 0.0;
        if !self.levels.iter().all(usable) || !self.levels.windows(2).all(|pair| pair[0].photons < pair[1].photons) {
            return wrong("the photons of the levels must rise from above 0".into());
        }
        Ok(())
    }
}

/// Takes the frames of a series and gives the figures.
///
/// # Errors
/// When the series cannot be measured, the camera fails, or the frames do not show what a figure needs: light that moves the mean, levels
/// past saturation.
pub fn photon_transfer(series: &Series, camera: &mut Camera) -> Result<Figures, EmvaError> {
    series.check()?;
    let mut number = 0;
    let mut shoot = |level: &Level, bright: bool, of_stack: bool, frame: &mut [u16]| {
        let shot = Shot { exposure_s: level.exposure_s, photons: if bright { level.photons } else { 0.0 }, number, of_stack };
        number += 1;
        camera(&shot, frame).map_err(EmvaError::Camera)
    };
    let pixels = series.rows * series.columns;
    let (mut a, mut b) = (vec![0u16; pixels], vec![0u16; pixels]);
    let mut points: Vec<TransferPoint> = Vec::with_capacity(series.levels.len());
    for level in &series.levels {
        let known = points.iter().find(|point| point.level.exposure_s == level.exposure_s).map(|point| (point.dark, point.dark_number));
        let mut pair = |bright: bool| {
            shoot(level, bright, false, &mut a)?;
            shoot(level, bright, false, &mut b)?;
            Ok::<Pair, EmvaError>(Pair::of(&a, &b))
        };
        let (dark, dark_number) = match known {
            Some(known) => known,
            None => (pair(false)?, points.iter().map(|point| point.dark_number + 1).max().unwrap_or(0)),
        };
        points.push(TransferPoint { level: *level, bright: pair(true)?, dark, dark_number });
    }
    let mut stack = |bright: bool| -> Result<Spatial, EmvaError> {
        let mut stack = Stack::new(series.rows, series.columns);
        for _ in 0..series.stack_frames {
            shoot(&series.levels[series.stack_level], bright, true, &mut a)?;
            stack.push(&a);
        }
        stack.spatial().ok_or_else(|| EmvaError::Series("the stack is too small".into()))
    };
    let (dark, bright) = (stack(false)?, stack(true)?);
    figures::figures(points, dark, bright, series.u_photons)
}
