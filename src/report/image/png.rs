//! PNG: 16-bit grey and 8-bit colour.

use super::{ImageError, sized};
use png::{BitDepth, ColorType, Encoder};

fn encoded(width: u32, height: u32, colour: ColorType, depth: BitDepth, samples: &[u8]) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, width, height);
    encoder.set_color(colour);
    encoder.set_depth(depth);
    if depth == BitDepth::Sixteen {
        // Noise hardly gets smaller, whatever time is spent on it.
        encoder.set_compression(png::Compression::Fast);
    }
    if colour == ColorType::Rgb {
        encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(samples)?;
    writer.finish()?;
    Ok(bytes)
}

fn failed(error: png::EncodingError) -> ImageError {
    ImageError::Encoding { format: "PNG", why: error.to_string() }
}

/// A grey picture of 16 bits a pixel.
///
/// # Errors
/// When `digital` does not fill `columns` × `rows`.
pub fn png16(digital: &[u16], columns: usize, rows: usize) -> Result<Vec<u8>, ImageError> {
    let (width, height) = sized(digital.len(), 1, columns, rows)?;
    // PNG counts the larger byte first.
    let samples: Vec<u8> = digital.iter().flat_map(|y| y.to_be_bytes()).collect();
    encoded(width, height, ColorType::Grayscale, BitDepth::Sixteen, &samples).map_err(failed)
}

/// A picture in sRGB: three bytes a pixel, red first.
///
/// # Errors
/// When `rgb` does not fill `columns` × `rows`.
pub fn png8_rgb(rgb: &[u8], columns: usize, rows: usize) -> Result<Vec<u8>, ImageError> {
    let (width, height) = sized(rgb.len(), 3, columns, rows)?;
    encoded(width, height, ColorType::Rgb, BitDepth::Eight, rgb).map_err(failed)
}
