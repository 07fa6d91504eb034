//! OpenEXR: 32-bit floats, channels by name.

use super::{ImageError, sized};
use exr::prelude::{AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, SmallVec, Text, WritableImage};
use std::io::Cursor;

/// A picture of channels, each with its name and a number for every pixel. Channels are stored in the order of the alphabet, as the format
/// asks for.
///
/// # Errors
/// When a channel does not fill `columns` × `rows`, or has no name of its own in plain letters.
pub fn exr(channels: &[(&str, &[f32])], columns: usize, rows: usize) -> Result<Vec<u8>, ImageError> {
    let unfit = |name: &str, why: &'static str| ImageError::Channel { name: name.into(), why };
    let mut list = SmallVec::new();
    for (i, (name, samples)) in channels.iter().enumerate() {
        sized(samples.len(), 1, columns, rows)?;
        if channels[..i].iter().any(|(other, _)| other == name) {
            return Err(unfit(name, "there twice"));
        }
        let text = Text::new_or_none(name).filter(|_| !name.is_empty() && name.is_ascii());
        let text = text.ok_or_else(|| unfit(name, "no name for this format"))?;
        list.push(AnyChannel::new(text, FlatSamples::F32(samples.to_vec())));
    }
    if list.is_empty() {
        return Err(unfit("", "missing"));
    }
    let layer = Layer::new((columns, rows), LayerAttributes::default(), Encoding::SMALL_LOSSLESS, AnyChannels::sort(list));
    let mut bytes = Cursor::new(Vec::new());
    let written = Image::from_layer(layer).write().to_buffered(&mut bytes);
    written.map_err(|error| ImageError::Encoding { format: "EXR", why: error.to_string() })?;
    Ok(bytes.into_inner())
}
