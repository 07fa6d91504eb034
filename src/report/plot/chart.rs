//! What is to be drawn, as plain data: [`Chart`] knows nothing of pixels, fonts or files.
//!
//! | field | drawn as |
//! |---|---|
//! | `title`, `subtitle` | two lines of text above |
//! | `x`, `y` | hair grid, tick labels, quantity and unit; linear or logarithmic |
//! | `spans` | ranges of x shaded over the whole height, such as the visible band |
//! | `shade` | an area coloured point by point, behind everything but the grid |
//! | `areas` | filled polygons, at the very back |
//! | `bands` | uncertainty between two curves |
//! | `curves` | lines with a label at the curve itself |
//! | `impulses` | spectral lines: vertical, from the base to their power; `impulse_axis` says what their height means |
//! | `points` | discs with or without a label |
//! | `notes` | text at a place |
//! | `keys` | a short legend of dashes at the top right, where several sets are drawn alike |
//! | `strip` | a band of colours along the x axis |
//!
//! Coordinates are those of the axes. A coordinate that is not finite, or not positive on a logarithmic axis, interrupts a line.

/// A picture with one pair of axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// What the picture shows.
    pub title: String,
    /// One grey line below it: source, conditions.
    pub subtitle: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Whether a unit of x is as long as one of y, as in a chromaticity diagram.
    pub equal_scale: bool,
    /// Height over width on a page or in a column, where the width is given; the size's own if `None`.
    pub proportion: Option<f64>,
    /// Colours along the x axis, rising in x; none if empty.
    pub strip: Vec<Stop>,
    /// Ranges of x.
    pub spans: Vec<Span>,
    /// An area coloured point by point.
    pub shade: Option<Shade>,
    /// Filled polygons.
    pub areas: Vec<Area>,
    /// Bands between two curves.
    pub bands: Vec<Band>,
    /// Lines.
    pub curves: Vec<Curve>,
    /// What the kinds of lines mean.
    pub keys: Vec<Key>,
    /// Spectral lines.
    pub impulses: Vec<Impulse>,
    /// Quantity and unit of the impulses' height, on an axis of its own at the right.
    pub impulse_axis: Option<Axis>,
    /// Points.
    pub points: Vec<Point>,
    /// Text at a place.
    pub notes: Vec<Note>,
}

impl Chart {
    /// A chart with axes and nothing in it.
    pub fn new(title: &str, subtitle: &str, x: Axis, y: Axis) -> Self {
        Self {
            title: title.to_owned(),
            subtitle: subtitle.to_owned(),
            x,
            y,
            equal_scale: false,
            proportion: None,
            strip: Vec::new(),
            spans: Vec::new(),
            shade: None,
            areas: Vec::new(),
            bands: Vec::new(),
            curves: Vec::new(),
            keys: Vec::new(),
            impulses: Vec::new(),
            impulse_axis: None,
            points: Vec::new(),
            notes: Vec::new(),
        }
    }
}

/// Linear or logarithmic.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Equal steps are equal differences.
    Linear,
    /// Equal steps are equal ratios; both ends are positive.
    Log,
}

/// An axis: what it carries and over which range.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// The quantity in words, with its symbol where that helps.
    pub quantity: String,
    /// Its unit; `1` for a number.
    pub unit: String,
    /// Linear or logarithmic.
    pub scale: Scale,
    /// Value at the left or lower end.
    pub from: f64,
    /// Value at the right or upper end; larger than `from`.
    pub to: f64,
    /// Where ticks stand and what they say; chosen from the range if empty.
    pub ticks: Vec<(f64, String)>,
    /// Whether grid, ticks and name are drawn at all.
    pub visible: bool,
}

impl Axis {
    /// A linear axis.
    pub fn linear(quantity: &str, unit: &str, from: f64, to: f64) -> Self {
        Self { quantity: quantity.to_owned(), unit: unit.to_owned(), scale: Scale::Linear, from, to, ticks: Vec::new(), visible: true }
    }

    /// A logarithmic axis.
    pub fn log(quantity: &str, unit: &str, from: f64, to: f64) -> Self {
        Self { scale: Scale::Log, ..Self::linear(quantity, unit, from, to) }
    }

    /// `quantity (unit)`, as it stands at the axis and at the head of a column.
    pub fn name(&self) -> String {
        format!("{} ({})", self.quantity, self.unit)
    }
}

/// Which colour; what it is in light and dark is the theme's business.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Ink {
    /// A colour of the palette, counted round and round.
    Palette(usize),
    /// The colour of text.
    Text,
    /// The colour of what stands behind: references, minor text.
    Muted,
    /// The colour of the grid: names may stand on such a line.
    Grid,
    /// The colour of text and lines on a shade, dark in both themes.
    OnShade,
    /// A colour of its own, sRGB.
    Fixed([u8; 3]),
}

/// How a line is broken up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dash {
    /// Not at all.
    Solid,
    /// Into dashes.
    Dashed,
    /// Into dots.
    Dotted,
}

/// What is filled between a curve and the base of the chart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Under {
    /// Nothing.
    Nothing,
    /// The colour of the curve, faint.
    Tint,
    /// The colours of the strip.
    Spectral,
}

/// A line.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Its name; empty for none.
    pub label: String,
    /// What is written at the curve in place of its name; empty for nothing.
    pub written: Option<String>,
    /// (x, y).
    pub points: Vec<[f64; 2]>,
    /// Colour of line and label.
    pub ink: Ink,
    /// Width as a multiple of the style's.
    pub width: f64,
    /// Dashes.
    pub dash: Dash,
    /// Fill below.
    pub under: Under,
}

impl Curve {
    /// A solid line of ordinary width.
    pub fn new(label: &str, points: Vec<[f64; 2]>, ink: Ink) -> Self {
        Self { label: label.to_owned(), written: None, points, ink, width: 1.0, dash: Dash::Solid, under: Under::Nothing }
    }

    /// What is written at the curve.
    pub fn text(&self) -> &str {
        self.written.as_deref().unwrap_or(&self.label)
    }

    /// The same line, thin and muted, as a reference behind the others.
    pub fn behind(self) -> Self {
        Self { ink: Ink::Muted, width: 0.6, ..self }
    }

    /// The same line, named in the table of numbers only.
    pub fn unwritten(self) -> Self {
        Self { written: Some(String::new()), ..self }
    }

    /// The same line, dashed or dotted.
    pub fn dashed(self, dash: Dash) -> Self {
        Self { dash, ..self }
    }

    /// The same line with what is below it filled.
    pub fn filled(self, under: Under) -> Self {
        Self { under, ..self }
    }
}

/// What lines of one kind have in common.
#[derive(Debug, Clone, PartialEq)]
pub struct Key {
    /// What it is.
    pub text: String,
    /// Width as a multiple of the style's.
    pub width: f64,
    /// Dashes.
    pub dash: Dash,
}

/// A filled polygon.
#[derive(Debug, Clone, PartialEq)]
pub struct Area {
    /// Corners, in order.
    pub points: Vec<[f64; 2]>,
    /// Colour.
    pub ink: Ink,
    /// 0 to 1.
    pub opacity: f64,
}

/// A range of y that depends on x: an uncertainty.
#[derive(Debug, Clone, PartialEq)]
pub struct Band {
    /// What it is; goes into the table of numbers.
    pub label: String,
    /// (x, lower y, upper y), rising in x.
    pub points: Vec<[f64; 3]>,
    /// Colour, drawn faint.
    pub ink: Ink,
}

/// A spectral line.
#[derive(Debug, Clone, PartialEq)]
pub struct Impulse {
    /// Its name; empty for none.
    pub label: String,
    /// Place.
    pub x: f64,
    /// Height on `impulse_axis`, or on the y axis if there is none.
    pub height: f64,
    /// Colour.
    pub ink: Ink,
}

/// A point.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// Its name, written beside it; empty for none.
    pub label: String,
    /// (x, y).
    pub at: [f64; 2],
    /// Colour.
    pub ink: Ink,
    /// Radius as a multiple of the style's.
    pub radius: f64,
    /// Whether its name is written beside it, where there is room; it stands in the table of numbers in any case.
    pub written: bool,
}

/// Which point of a text stands at its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// The left end.
    Start,
    /// The middle.
    Middle,
    /// The right end.
    End,
}

/// Text at a place; its middle line stands at the place's height.
#[derive(Debug, Clone, PartialEq)]
pub struct Note {
    /// The text.
    pub text: String,
    /// (x, y).
    pub at: [f64; 2],
    /// Shift in sizes of the text, right and up.
    pub shift_em: [f64; 2],
    /// Which point of the text stands there.
    pub anchor: Anchor,
    /// Colour.
    pub ink: Ink,
}

/// A colour at a place of the strip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// Place on the x axis.
    pub x: f64,
    /// sRGB.
    pub colour: [u8; 3],
    /// 0 to 1.
    pub opacity: f64,
}

/// A range of x.
#[derive(Debug, Clone, PartialEq)]
pub struct Span {
    /// Its name, written at its top; empty for none.
    pub label: String,
    /// Left end.
    pub from: f64,
    /// Right end.
    pub to: f64,
}

/// An area coloured point by point: rows of horizontal gradients inside an outline.
#[derive(Debug, Clone, PartialEq)]
pub struct Shade {
    /// Corners of the outline, in order.
    pub outline: Vec<[f64; 2]>,
    /// Rows that together cover it.
    pub rows: Vec<ShadeRow>,
}

/// Colours along x between two heights.
#[derive(Debug, Clone, PartialEq)]
pub struct ShadeRow {
    /// Lower end.
    pub from: f64,
    /// Upper end.
    pub to: f64,
    /// Colours, rising in x.
    pub stops: Vec<Stop>,
}
