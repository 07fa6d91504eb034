//! Plots in SVG and PNG.
//!
//! ```text
//! a plot's arguments ─v_lambda, cones, …→ Chart ─svg→ SVG ─png→ PNG
//!                                           └───csv→ the numbers that are drawn
//! ```
//!
//! | file | what |
//! |---|---|
//! | `chart` | what is to be drawn, as plain data |
//! | `style` | theme, size, colours |
//! | `axis` | ticks, and where a value stands |
//! | `text` | the font, widths of texts |
//! | `polyline` | cutting and thinning lines |
//! | `layout` | places of frame, texts, legend |
//! | `labels` | names beside the curves, where there is room |
//! | `canvas` | lines and areas through plotters |
//! | `shade` | areas coloured point by point |
//! | `svg`, `png`, `table` | the documents |
//! | `chromaticity` | spectral, Planckian and daylight loci, white points, gamuts |
//! | `sample` | points of a function, colours along an axis |
//! | `sensor`, `polar` | responsivity and directional response of sensors |
//! | `wavelength_colour` | colours of wavelengths, smooth to the eye |
//! | `v_lambda`, `cones`, `pigments`, `cmf`, `spectrum`, `reflectance`, `blackbody`, `convergence`, `campaign`, `calibration`, `calibration_statistics` | a plot each |
//!
//! ```
//! use etendue::report::plot::{self, Size, Style, Theme};
//!
//! let chart = plot::v_lambda::chart(&plot::v_lambda::Choice::default())?;
//! let picture = plot::svg(&chart, &Style { theme: Theme::Light, size: Size::Paper })?;
//! assert!(picture.contains("Wavelength") && plot::csv(&chart).starts_with("item,kind,"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod axis;
pub mod blackbody;
pub mod calibration;
mod calibration_statistics;
pub mod campaign;
mod canvas;
pub mod chart;
pub mod chromaticity;
pub mod cmf;
pub mod cones;
pub mod convergence;
mod error;
mod labels;
mod layout;
pub mod pigments;
mod png;
pub mod polar;
mod polyline;
pub mod reflectance;
mod sample;
pub mod sensor;
mod shade;
pub mod spectrum;
mod style;
mod svg;
mod table;
mod text;
pub mod v_lambda;
pub mod wavelength_colour;

pub use self::png::png;
pub use chart::Chart;
pub use error::PlotError;
pub use style::{SIDES_PX, Size, Style, Theme};
pub use svg::svg;
pub use table::csv;
