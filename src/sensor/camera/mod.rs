//! Cameras: a lens and an array of pixels.
//!
//! ```text
//! μ_e = t A_pix g ∫ η(λ) (n λ/hc) T(λ) E_λ(λ) dλ          expected photoelectrons of a pixel
//! E_λ = (1/A_pix) ∫∫ R(θ′) L_λ cosθ cosθ′/d² dA_y dA_x     over the pupil and the pixel (`lens.rs`)
//! ```
//!
//! | symbol | parameter | unit | range |
//! |---|---|---|---|
//! | t | `exposure_s` | s | above 0 |
//! | A_pix | `pitch_m`², a square pixel | m² | above 0 |
//! | g | `fill_factor`: what of the pixel is sensitive, as if evenly spread over it | 1 | above 0 to 1 |
//! | η | quantum efficiency of a channel, its filter included: electrons per photon | 1 | 0 to 1 |
//! | n λ/hc | photons per energy, at the wavelength in vacuum | 1/J | |
//! | T | `transmittance` of the lens | 1 | 0 to 1 |
//! | R | `angular_response` of the micro-lenses, 1 along the axis | 1 | not negative |

mod lens;
mod mosaic;

pub use lens::Lens;
pub use mosaic::Mosaic;

use super::{DirectionalResponse, Pixel};
use crate::spectrum::Factor;
use crate::spectrum::photometry::{WavelengthsIn, photons_per_joule};

/// Most pixels of a camera.
pub const MOST_PIXELS: usize = 1 << 25;

/// A kind of pixel: one colour filter.
#[derive(Clone, Debug)]
pub struct ColourChannel {
    /// The name in the sensor file, unique in the camera; one letter where a Bayer pattern names it.
    pub name: String,
    /// Electrons per photon that arrives at the pixel, 0 to 1.
    pub quantum_efficiency: Factor,
}

/// A camera, without a place in a scene.
#[derive(Clone, Debug)]
pub struct Camera {
    /// What it is called in reports.
    pub title: String,
    /// What forms the image.
    pub lens: Lens,
    /// Transmittance of the lens, 0 to 1.
    pub transmittance: Factor,
    /// Pixels in a row.
    pub columns: usize,
    /// Rows of pixels.
    pub rows: usize,
    /// From pixel to pixel, in both directions, m.
    pub pitch_m: f64,
    /// Sensitive share of a pixel, above 0 to 1.
    pub fill_factor: f64,
    /// Response of a pixel with its micro-lens to the direction of the light; `None` for every direction alike.
    pub angular_response: Option<DirectionalResponse>,
    /// The colour filters; without them every channel is recorded at every pixel.
    pub mosaic: Option<Mosaic>,
    /// At least one.
    pub channels: Vec<ColourChannel>,
    /// The electronics of a pixel; without it there are expected electrons and no frames.
    pub pixel: Option<Pixel>,
    /// Exposure time, s.
    pub exposure_s: f64,
    /// Temperature of the sensor, °C.
    pub temperature_c: f64,
}

impl Camera {
    /// Pixels of the image.
    #[must_use]
    pub fn pixels(&self) -> usize {
        self.columns * self.rows
    }

    /// Images that are recorded: one behind a mosaic, else one a channel.
    #[must_use]
    pub fn planes(&self) -> usize {
        if self.mosaic.is_some() { 1 } else { self.channels.len() }
    }

    /// The channel of a pixel in a plane.
    #[inline]
    #[must_use]
    pub fn channel_at(&self, plane: usize, column: usize, row: usize) -> usize {
        self.mosaic.as_ref().map_or(plane, |mosaic| mosaic.at(column, row))
    }

    /// Electrons per energy that arrives at the pupil, η T n λ/hc, 1/J.
    #[must_use]
    pub fn responsivity(&self, channel: usize) -> Factor {
        let efficiency = self.channels[channel].quantum_efficiency.clone();
        Factor::Product(vec![efficiency, self.transmittance.clone(), photons_per_joule(WavelengthsIn::StandardAir)])
    }

    /// What turns electrons per second and square metre of irradiated pixel into electrons, m² s.
    #[must_use]
    pub fn collection_m2_s(&self) -> f64 {
        self.exposure_s * self.pitch_m * self.pitch_m * self.fill_factor
    }

    /// The image point (to the right, up), m from the axis, at a place within a pixel: (0, 0) its upper left corner, (1, 1) its lower right.
    #[inline(always)]
    #[must_use]
    pub fn image_point_m(&self, column: usize, row: usize, within: [f64; 2]) -> [f64; 2] {
        [
            (column as f64 + within[0] - 0.5 * self.columns as f64) * self.pitch_m,
            (0.5 * self.rows as f64 - row as f64 - within[1]) * self.pitch_m,
        ]
    }

    /// The pixel at an image point, if there is one.
    #[must_use]
    pub fn pixel_at(&self, image_m: [f64; 2]) -> Option<(usize, usize)> {
        let column = (image_m[0] / self.pitch_m + 0.5 * self.columns as f64).floor();
        let row = (0.5 * self.rows as f64 - image_m[1] / self.pitch_m).floor();
        let inside = column >= 0.0 && row >= 0.0 && column < self.columns as f64 && row < self.rows as f64;
        inside.then_some((column as usize, row as usize))
    }

    /// Étendue over the area of a pixel for one ray, with the response of the micro-lens, sr.
    #[inline(always)]
    #[must_use]
    pub fn weight_sr(&self, image_m: [f64; 2], pupil_m: [f64; 2]) -> f64 {
        let weight = self.lens.weight_sr(image_m, pupil_m);
        match &self.angular_response {
            None => weight,
            Some(table) => weight * self.response(table, image_m, pupil_m),
        }
    }

    /// The mean of [`weight_sr`](Self::weight_sr) over pixel and pupil, sr, from its closed form at nine points of the pixel (Gauss).
    ///
    /// `None` with micro-lenses, and for pixels larger than 1/50 of the image distance, where nine points would not do.
    #[must_use]
    pub fn mean_weight_sr(&self, column: usize, row: usize) -> Option<f64> {
        if self.angular_response.is_some() || self.pitch_m > 0.02 * self.lens.image_distance_m() {
            return None;
        }
        let off = 0.5 * 0.6f64.sqrt();
        let nodes = [(0.5 - off, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.5 + off, 5.0 / 18.0)];
        let of_node = |(x, wx): (f64, f64)| -> f64 {
            nodes.iter().map(|&(y, wy)| wx * wy * self.lens.mean_weight_sr(self.image_point_m(column, row, [x, y]))).sum()
        };
        Some(nodes.into_iter().map(of_node).sum())
    }

    fn response(&self, table: &DirectionalResponse, image_m: [f64; 2], pupil_m: [f64; 2]) -> f64 {
        let (tangent, azimuth_rad) = self.lens.incidence(image_m, pupil_m);
        table.at(tangent.atan(), azimuth_rad)
    }
}
