//! How a picture looks: theme, size, and the colours and widths that follow from them.
//!
//! | size | width × height | text |
//! |---|---|---|
//! | `Paper` | 170 mm × 100 mm | 8 pt |
//! | `Column` | 85 mm × 68 mm | 7 pt |
//! | `Slide` | 1280 px × 720 px | 20 px |
//! | `Custom` | as asked | grows with the square root of the area |
//!
//! Lengths are in px of 1/96 inch. The palette was sought by computer: hues that the colour-blind confuse differ in lightness.

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
    [[30, 64, 123], [204, 66, 18], [81, 137, 96], [157, 87, 230], [76, 46, 2], [0, 156, 197], [45, 55, 43], [133, 67, 94]];
const DARK: [[u8; 3]; 8] =
    [[32, 134, 255], [218, 114, 37], [181, 247, 197], [186, 110, 176], [253, 225, 18], [80, 209, 254], [172, 176, 173], [250, 68, 98]];

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

#[cfg(test)]
mod tests {
    use super::*;

    type Matrix = [[f64; 3]; 3];

    /// What the colour-blind see of linear sRGB: nobody, protanopes, deuteranopes, tritanopes (Machado, Oliveira and Fernandes 2009).
    const SEEN: [Matrix; 4] = [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
        [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
        [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
    ];
    const SRGB_TO_XYZ: Matrix = [[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]];

    fn times(m: &Matrix, v: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|i| m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2])
    }

    /// CIELAB of an sRGB colour as it is seen.
    fn lab(colour: [u8; 3], seen: &Matrix) -> [f64; 3] {
        let linear = colour.map(|byte| {
            let value = f64::from(byte) / 255.0;
            if value <= 0.040_45 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
        });
        let [x, y, z] = times(&SRGB_TO_XYZ, times(seen, linear).map(|part| part.clamp(0.0, 1.0)));
        let f = |t: f64| if t > 216.0 / 24389.0 { t.cbrt() } else { (24389.0 / 27.0 * t + 16.0) / 116.0 };
        let (x, y, z) = (f(x / 0.950_47), f(y), f(z / 1.088_83));
        [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
    }

    #[test]
    fn the_colours_of_the_palette_are_told_apart_by_everyone() {
        for palette in [LIGHT, DARK] {
            for (index, one) in palette.iter().enumerate() {
                for other in &palette[index + 1..] {
                    for seen in &SEEN {
                        let (a, b) = (lab(*one, seen), lab(*other, seen));
                        let difference = (a[0] - b[0]).hypot(a[1] - b[1]).hypot(a[2] - b[2]);
                        assert!(difference > 14.0, "{one:?} {other:?}: {difference:.1}");
                    }
                }
            }
        }
    }

    #[test]
    fn lines_and_letters_stand_out_from_the_background() {
        for theme in [Theme::Light, Theme::Dark] {
            let look = Style { theme, size: Size::Paper }.look(None);
            for ink in (0..8).map(Ink::Palette) {
                assert!(contrast(look.colour(ink), look.background) >= 3.0, "{theme:?} {ink:?}");
            }
            for colour in [look.text, look.muted] {
                assert!(contrast(colour, look.background) >= 4.5, "{theme:?} {colour:?}");
            }
        }
    }
}
