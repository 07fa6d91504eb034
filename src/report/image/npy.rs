//! NPY 1.0: arrays of floats for NumPy.
//!
//! ```text
//! \x93NUMPY  1 0  length of the header (u16)  {'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }  …  \n  numbers
//! ```
//!
//! Little-endian, last index fastest; the header is filled up with blanks so that the numbers start at a multiple of 64 bytes.
//!
//! Source: NumPy Enhancement Proposal 1.

use super::ImageError;

fn with_header(numbers: usize, kind: &str, shape: &[usize], bytes: impl Iterator<Item = u8>) -> Result<Vec<u8>, ImageError> {
    if shape.iter().try_fold(1usize, |product, n| product.checked_mul(*n)) != Some(numbers) {
        let why = format!("{numbers} numbers do not fill the shape {shape:?}");
        return Err(ImageError::Encoding { format: "NPY", why });
    }
    // A tuple of one has a comma behind it.
    let sides: String = shape.iter().map(|n| format!("{n}, ")).collect();
    let mut header = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({}), }}", sides.trim_end_matches(' '));
    const BEFORE: usize = 10;
    let length = (BEFORE + header.len() + 1).next_multiple_of(64) - BEFORE;
    header.extend(std::iter::repeat_n(' ', length - 1 - header.len()));
    header.push('\n');
    let Ok(length) = u16::try_from(length) else {
        return Err(ImageError::Encoding { format: "NPY", why: "the shape has too many sides".into() });
    };
    let mut out = b"\x93NUMPY\x01\x00".to_vec();
    out.extend(length.to_le_bytes());
    out.extend(header.into_bytes());
    out.extend(bytes);
    Ok(out)
}

/// An array of 32-bit floats of any shape, e.g. `[rows, columns]`; the last index runs fastest.
///
/// # Errors
/// When the numbers do not fill the shape.
pub fn npy_f32(numbers: &[f32], shape: &[usize]) -> Result<Vec<u8>, ImageError> {
    with_header(numbers.len(), "<f4", shape, numbers.iter().flat_map(|x| x.to_le_bytes()))
}

/// An array of 64-bit floats of any shape.
///
/// # Errors
/// When the numbers do not fill the shape.
pub fn npy_f64(numbers: &[f64], shape: &[usize]) -> Result<Vec<u8>, ImageError> {
    with_header(numbers.len(), "<f8", shape, numbers.iter().flat_map(|x| x.to_le_bytes()))
}
