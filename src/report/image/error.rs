//! Why a picture cannot be written.

/// Why there are no bytes.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ImageError {
    /// The samples do not fill the picture, or there is no pixel.
    #[error("{samples} samples for a picture of {columns} × {rows} pixels; {per_pixel} for each pixel and at least one pixel are needed")]
    Size {
        /// How many samples there are.
        samples: usize,
        /// How many belong to a pixel.
        per_pixel: usize,
        /// Pixels in a row.
        columns: usize,
        /// Rows.
        rows: usize,
    },
    /// The names of channels are empty, alike, or none.
    #[error("the channel `{name}` is {why}; give every channel a name of its own, such as `R`")]
    Channel {
        /// The name.
        name: String,
        /// What is wrong with it.
        why: &'static str,
    },
    /// The encoder failed.
    #[error("the picture cannot be written as {format}: {why}")]
    Encoding {
        /// The format.
        format: &'static str,
        /// The encoder's words.
        why: String,
    },
}
