//! The eye: luminous efficiency, cones, colour matching, α-opic action spectra, and the colour of a spectrum.
//!
//! An observer is a set of curves like any other sensor's; what makes it an observer is what the curves stand for.

pub mod colour;
