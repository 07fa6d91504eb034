//! Laws of radiometry, held by readings as a user gets them: a scene is written, planned and measured.
//!
//! | law | tolerance of formulas | of samples |
//! |---|---|---|
//! | white furnace: `L/(1 − ρ)` everywhere | – | 4 u |
//! | energy balance: what a source emits, the walls absorb | 1e-9 | 4 u |
//! | superposition of sources | 1e-9 | 4 u |
//! | linearity in strength and responsivity | 1e-9 | 1e-9 at the same seed |
//! | scale: lengths × k | 1e-9 | 1e-9 at the same seed |
//! | rotation, translation | 1e-9, rounding of coordinates | 4 u |
//! | reciprocity of two surfaces | 1e-9 | 4 u |
//! | inverse square, cosine | 1e-9 | – |
//! | order of the items of a scene | 1e-9 | 4 u |
//! | spectra: a line is a line, nodes do not matter, σT⁴ | 1e-9 | – |
//! | heads that see all round: totals, mean over azimuth, sums | 1e-9 | 4 u |
//! | luminance meters: a filled field reads L, étendues of discs | 1e-12 | 4 u |
//! | methods: formulas and samples agree | – | 4 u |

#![allow(clippy::unwrap_used, clippy::print_stderr)]

mod bench;
mod cosine;
mod energy_balance;
mod heads;
mod inverse_square;
mod linearity;
mod methods;
mod motion;
mod order;
mod reciprocity;
mod scale;
mod spectra;
mod spot;
mod superposition;
mod white_furnace;
