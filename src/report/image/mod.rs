//! Frames as files: bytes for whoever writes them.
//!
//! | function | format | samples | for |
//! |---|---|---|---|
//! | [`png16`] | PNG, grey | 16 bits | raw frames |
//! | [`png8_rgb`] | PNG, colour | 3 × 8 bits, sRGB | previews |
//! | [`tiff16`] | TIFF, grey, no compression | 16 bits | raw frames |
//! | [`npy_f32`], [`npy_f64`] | NPY 1.0, any shape | 32- and 64-bit floats | expected electrons, for NumPy |
//! | [`exr`] | OpenEXR, channels by name, ZIP | 32-bit floats | expected electrons, for picture programs |
//!
//! Pixels go row by row from the top left; nothing is scaled or rounded, and what is written reads back bit for bit. The same pixels give
//! the same bytes: no dates, no names of programs.
//!
//! ```
//! let bytes = etendue::report::image::png16(&[0, 64, 4095, 65535, 1, 2], 3, 2)?;
//! assert_eq!(&bytes[1..4], b"PNG");
//! # Ok::<(), etendue::report::image::ImageError>(())
//! ```

mod error;
mod exr;
mod npy;
mod png;
#[cfg(test)]
mod tests;
mod tiff;

pub use self::error::ImageError;
pub use self::exr::exr;
pub use self::npy::{npy_f32, npy_f64};
pub use self::png::{png8_rgb, png16};
pub use self::tiff::tiff16;

/// Errors unless there is a pixel at all and `samples` are `per_pixel` for each of `columns` × `rows`.
fn sized(samples: usize, per_pixel: usize, columns: usize, rows: usize) -> Result<(u32, u32), ImageError> {
    let expected = columns.checked_mul(rows).and_then(|pixels| pixels.checked_mul(per_pixel));
    match (u32::try_from(columns), u32::try_from(rows)) {
        (Ok(width), Ok(height)) if expected == Some(samples) && samples > 0 && width <= i32::MAX as u32 && height <= i32::MAX as u32 => {
            Ok((width, height))
        }
        _ => Err(ImageError::Size { samples, per_pixel, columns, rows }),
    }
}
