//! A preview of a frame: what a simple camera would show.
//!
//! ```text
//! demosaic   c(pixel) = mean of the pixels with channel c among itself and its neighbours, as far as half a tile
//! balance    channel c times 0.9/m_c, m_c: its mean over the brightest hundredth of the pixels by luminance
//! sRGB       gamma of IEC 61966-2-1, values beyond one cut off
//! ```
//!
//! Channels called R, G and B (or red, green and blue) are taken as the primaries of sRGB without a colour matrix, so colours are paler than
//! those of a developed photograph. A camera without these three is shown in grey, by luminance.

use crate::measurement::Frame;
use crate::sensor::camera::Camera;

/// Share of the pixels that are taken for white, and how bright they are shown.
const WHITE: f64 = 0.01;
const SHOWN_AS: f64 = 0.9;

/// A picture in RGB, three bytes a pixel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Preview {
    /// Row by row from the top.
    pub rgb: Vec<u8>,
    /// How it was made, in words.
    pub rule: String,
}

/// The preview of a frame that this camera took.
#[must_use]
pub fn preview(frame: &Frame, camera: &Camera) -> Preview {
    let white = brightest(&frame.luminance_cd_m2);
    let colours = [["R", "red"], ["G", "green"], ["B", "blue"]];
    let found = colours.map(|names| camera.channels.iter().position(|c| names.iter().any(|n| c.name.eq_ignore_ascii_case(n))));
    let (images, rule) = match found {
        [Some(r), Some(g), Some(b)] => (
            [r, g, b].map(|c| demosaicked(frame, camera, c)),
            "channels R, G, B as primaries of sRGB, white from the brightest hundredth of the pixels".to_owned(),
        ),
        _ => {
            let grey = frame.luminance_cd_m2.clone();
            ([grey.clone(), grey.clone(), grey], "luminance in grey, white from the brightest hundredth of the pixels".to_owned())
        }
    };
    let scales = images.each_ref().map(|image| {
        let mean = white.iter().map(|&i| image[i]).sum::<f64>() / white.len().max(1) as f64;
        if mean > 0.0 { SHOWN_AS / mean } else { 0.0 }
    });
    let mut rgb = Vec::with_capacity(3 * frame.luminance_cd_m2.len());
    for i in 0..frame.luminance_cd_m2.len() {
        for (image, scale) in images.iter().zip(scales) {
            rgb.push(srgb_byte(scale * image[i]));
        }
    }
    Preview { rgb, rule }
}

/// Indices of the brightest pixels.
fn brightest(luminance: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..luminance.len()).collect();
    let count = ((WHITE * luminance.len() as f64).ceil() as usize).clamp(1, luminance.len().max(1));
    if count < order.len() {
        order.select_nth_unstable_by(count - 1, |&a, &b| luminance[b].total_cmp(&luminance[a]));
        order.truncate(count);
    }
    order
}

/// The value of a channel at every pixel.
fn demosaicked(frame: &Frame, camera: &Camera, channel: usize) -> Vec<f64> {
    let Some(mosaic) = &camera.mosaic else { return frame.planes[channel].expected_e.clone() };
    let raw = &frame.planes[0].expected_e;
    let (reach_x, reach_y) = (mosaic.columns() / 2, mosaic.rows() / 2);
    let at = |column: usize, row: usize| {
        let (mut sum, mut count) = (0.0, 0.0);
        for y in row.saturating_sub(reach_y)..=(row + reach_y).min(frame.rows - 1) {
            for x in column.saturating_sub(reach_x)..=(column + reach_x).min(frame.columns - 1) {
                if mosaic.at(x, y) == channel {
                    sum += raw[y * frame.columns + x];
                    count += 1.0;
                }
            }
        }
        if count > 0.0 { sum / count } else { 0.0 }
    };
    (0..frame.rows).flat_map(|row| (0..frame.columns).map(move |column| (column, row))).map(|(column, row)| at(column, row)).collect()
}

/// IEC 61966-2-1.
fn srgb_byte(linear: f64) -> u8 {
    let x = linear.clamp(0.0, 1.0);
    let coded = if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 };
    (255.0 * coded).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_and_the_middle_of_srgb() {
        assert_eq!([0.0, 1.0, 2.0, f64::NAN].map(srgb_byte), [0, 255, 255, 0]);
        // Half of the light is 188 in sRGB.
        assert_eq!(srgb_byte(0.5), 188);
    }

    #[test]
    fn the_brightest_hundredth_is_found() {
        let mut values = vec![1.0; 400];
        for i in [7, 70, 170, 399] {
            values[i] = 2.0;
        }
        let mut found = brightest(&values);
        found.sort_unstable();
        assert_eq!(found, [7, 70, 170, 399]);
        assert_eq!(brightest(&[3.0]), [0]);
    }
}
