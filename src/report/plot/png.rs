//! From SVG to PNG, with the font that comes with the program and no other.

use resvg::{tiny_skia, usvg};

use super::error::PlotError;
use super::text::options;

/// Most pixels of a picture.
const MOST_PIXELS: f64 = 1e8;

/// The picture of an SVG document as PNG, `scale` pixels to the px of the document. Errors if the document is not SVG, the scale not
/// positive, or the picture of more than 10⁸ pixels.
pub fn png(svg: &str, scale: f64) -> Result<Vec<u8>, PlotError> {
    let tree = usvg::Tree::from_str(svg, &options()).map_err(|e| PlotError::Drawing(e.to_string()))?;
    let (width, height) = (f64::from(tree.size().width()) * scale, f64::from(tree.size().height()) * scale);
    if !(scale > 0.0 && width >= 1.0 && height >= 1.0 && width * height <= MOST_PIXELS) {
        let what =
            format!("a scale of {scale} gives {width:.0} × {height:.0} pixels; from 1 pixel a side to 10⁸ pixels in all are possible");
        return Err(PlotError::Request { what });
    }
    let pixels = |side: f64| side.round().max(1.0) as u32;
    let mut map = tiny_skia::Pixmap::new(pixels(width), pixels(height)).ok_or_else(|| PlotError::Drawing("no memory".to_owned()))?;
    let transform = tiny_skia::Transform::from_scale(scale as f32, scale as f32);
    resvg::render(&tree, transform, &mut map.as_mut());
    map.encode_png().map_err(|e| PlotError::Drawing(e.to_string()))
}
