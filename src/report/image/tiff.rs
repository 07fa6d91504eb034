//! TIFF: 16-bit grey without compression.

use super::{ImageError, sized};
use std::io::Cursor;
use tiff::encoder::{TiffEncoder, colortype::Gray16};

/// A grey picture of 16 bits a pixel.
///
/// # Errors
/// When `digital` does not fill `columns` × `rows`.
pub fn tiff16(digital: &[u16], columns: usize, rows: usize) -> Result<Vec<u8>, ImageError> {
    let (width, height) = sized(digital.len(), 1, columns, rows)?;
    let failed = |error: tiff::TiffError| ImageError::Encoding { format: "TIFF", why: error.to_string() };
    let mut bytes = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut bytes).map_err(failed)?;
    encoder.write_image::<Gray16>(width, height, digital).map_err(failed)?;
    Ok(bytes.into_inner())
}
