//! How a picture looks: theme, size, and the colours and widths that follow from them.
//!
//! | size | width × height | text |
//! |---|---|---|
//! | `Paper` | 170 mm × 100 mm | 8 pt |
//! | `Column` | 85 mm × 68 mm | 7 pt |
//! | `Slide` | 1280 px × 720 px | 20 px |
//! | `Custom` | as asked | grows with the square root of the area |
//!
//! Lengths are in px of 1/96 inch. The palette keeps its order of lightness for the colour-blind: hues that are confused differ in
//! lightness.

use super::chart::Ink;

/// Light or dark background.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Theme {
    /// For print.
    Light,
    /// For the screen.
    Dark,
}

/// Size of the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Size {
    /// The width of a page of a journal, 170 mm.
    Paper,
    /// One of its two columns, 85 mm.
    Column,
    /// A slide, 16:9.
    Slide,
    /// Any other, px.
    Custom {
        /// Width, px.
        width_px: u32,
        /// Height, px.
        height_px: u32,
    },
}

/// Smallest and largest side of a picture, px.
pub const SIDES_PX: (u32, u32) = (240, 8000);

/// Theme and size.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Style {
    /// Light or dark.
    pub theme: Theme,
    /// Size.
    pub size: Size,
}

/// Eight colours for lines and text, told apart by the colour-blind as well.
const LIGHT: [[u8; 3]; 8] =
    [[0, 95, 168], [201, 72, 0], [0, 125, 97], [138, 58, 150], [160, 110, 0], [30, 145, 200], [90, 98, 114], [176, 28, 88]];
const DARK: [[u8; 3]; 8] =
    [[92, 172, 240], [255, 138, 76], [56, 198, 158], [206, 140, 220], [230, 184, 60], [140, 214, 250], [170, 178, 192], [250, 122, 164]];

/// Colours and lengths of a style, px.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Look {
    pub(super) width: f64,
    pub(super) height: f64,
    /// Width and height as written at the root of the document.
    pub(super) stated: (String, String),
    pub(super) background: [u8; 3],
    pub(super) text: [u8; 3],
    pub(super) muted: [u8; 3],
    pub(super) grid: [u8; 3],
    /// A range of x.
    pub(super) span: [u8; 3],
    palette: [[u8; 3]; 8],
    /// Size of ordinary text.
    pub(super) text_px: f64,
    pub(super) title_px: f64,
    /// Width of a curve.
    pub(super) line_px: f64,
    /// Width of a line of the grid.
    pub(super) hair_px: f64,
    pub(super) tint: f64,
    /// Opacity of an area coloured point by point: so that the grid and, in print, dark lines show on it.
    pub(super) shade: f64,
}

impl Style {
    /// Colours and lengths; `proportion` is the height over the width where the size leaves it open.
    pub(super) fn look(&self, proportion: Option<f64>) -> Look {
        let mm = 96.0 / 25.4;
        let tall = |width_mm: f64, usual: f64| (width_mm * proportion.unwrap_or(usual).clamp(0.2, 5.0)).round();
        let metric = |w: f64, h: f64| (w * mm, h * mm, (format!("{w}mm"), format!("{h}mm")));
        let (width, height, stated, text_px) = match self.size {
            Size::Paper => {
                let (w, h, s) = metric(170.0, tall(170.0, 0.59));
                (w, h, s, 8.0 * 4.0 / 3.0)
            }
            Size::Column => {
                let (w, h, s) = metric(85.0, tall(85.0, 0.8));
                (w, h, s, 7.0 * 4.0 / 3.0)
            }
            Size::Slide => (1280.0, 720.0, ("1280".to_owned(), "720".to_owned()), 20.0),
            Size::Custom { width_px, height_px } => {
                let clamp = |side: u32| f64::from(side.clamp(SIDES_PX.0, SIDES_PX.1));
                let (w, h) = (clamp(width_px), clamp(height_px));
                (w, h, (format!("{w}"), format!("{h}")), (0.0205 * (w * h).sqrt()).max(8.0))
            }
        };
        let dark = self.theme == Theme::Dark;
        let pick = |light: [u8; 3], night: [u8; 3]| if dark { night } else { light };
        Look {
            width,
            height,
            stated,
            background: pick([255, 255, 255], [20, 23, 29]),
            text: pick([38, 42, 51], [232, 234, 239]),
            muted: pick([106, 113, 126], [150, 157, 170]),
            grid: pick([230, 233, 238], [43, 48, 57]),
            span: pick([246, 247, 250], [28, 32, 39]),
            palette: if dark { DARK } else { LIGHT },
            text_px,
            title_px: 1.3 * text_px,
            line_px: 0.14 * text_px,
            hair_px: 0.07 * text_px,
            shade: if dark { 0.9 } else { 0.8 },
            tint: if dark { 0.16 } else { 0.10 },
        }
    }
}

impl Look {
    /// What an ink is in this theme.
    pub(super) fn colour(&self, ink: Ink) -> [u8; 3] {
        match ink {
            Ink::Palette(index) => self.palette[index % self.palette.len()],
            Ink::Text => self.text,
            Ink::Muted => self.muted,
            Ink::Grid => self.grid,
            Ink::OnShade => [24, 26, 32],
            Ink::Fixed(colour) => colour,
        }
    }
}

impl Look {
    /// Whether a colour of its own hardly differs from the background.
    pub(super) fn is_faint(&self, ink: Ink) -> bool {
        matches!(ink, Ink::Fixed(colour) if contrast(colour, self.background) < 1.5)
    }

    /// The ink itself, or that of text where letters in it would be hard to read.
    pub(super) fn readable(&self, ink: Ink) -> Ink {
        if matches!(ink, Ink::Fixed(colour) if contrast(colour, self.background) < 3.0) { Ink::Text } else { ink }
    }
}

/// Contrast of two sRGB colours, 1 to 21 (WCAG 2.1).
pub(super) fn contrast(a: [u8; 3], b: [u8; 3]) -> f64 {
    let linear = |byte: u8| {
        let value = f64::from(byte) / 255.0;
        if value <= 0.040_45 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
    };
    let luminance = |c: [u8; 3]| 0.2126 * linear(c[0]) + 0.7152 * linear(c[1]) + 0.0722 * linear(c[2]);
    let (low, high) = (luminance(a).min(luminance(b)), luminance(a).max(luminance(b)));
    (high + 0.05) / (low + 0.05)
}

/// `#rrggbb`.
pub(super) fn hex(colour: [u8; 3]) -> String {
    format!("#{:02X}{:02X}{:02X}", colour[0], colour[1], colour[2])
}
