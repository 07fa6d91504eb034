//! Pictures of a frame for the eye: a preview in colours, and luminance in false colours.
//!
//! | function | what |
//! |---|---|
//! | [`preview`] | demosaicked, white-balanced, sRGB |
//! | [`false_colour`] | luminance with a bar in cd/m² |
//!
//! Both are RGB, three bytes a pixel; for measuring there are the arrays of the frame.

mod false_colour;
mod glyphs;
mod preview;

pub use false_colour::{FalseColour, false_colour};
pub use preview::{Preview, preview};
