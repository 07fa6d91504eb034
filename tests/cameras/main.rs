//! Cameras: pictures against closed forms, against instruments, and against each other.

#![allow(clippy::unwrap_used)]

mod chart;
mod command;
mod laws;
mod paths;

use etendue::estimate::{Stop, Watch};
use etendue::measurement::{Frame, Measurement, expose, measure};
use etendue::plan::{Plan, PlanOptions};
use etendue::quantity::air::wavelength_in_vacuum_nm;
use etendue::scene::{Scene, scene_from_text};

/// A camera for the light of one line at 550 nm, all of it counted; `lens` and `size` as they are written, pitch 5 µm, 1 ms.
pub(crate) fn camera(lens: &str, size: [usize; 2]) -> String {
    format!(
        "Camera(lens: {lens}, columns: {}, rows: {}, pitch_um: 5, channels: [(name: \"grey\", quantum_efficiency: 1)], exposure_ms: 1)",
        size[0], size[1]
    )
}

/// Electrons of such a pixel per W/m² of 550 nm.
pub(crate) fn electrons_per_irradiance() -> f64 {
    1e-3 * 25e-12 * wavelength_in_vacuum_nm(550.0) * 1e-9 / (6.626_070_15e-34 * 299_792_458.0)
}

/// A scene whose camera looks along +y from the origin.
pub(crate) fn scene(things: &str, camera: &str, regions: &str) -> Scene {
    let text =
        format!("Scene({things} cameras: [(name: \"cam\", camera: {camera}, at: (0, 0, 0), facing: (0, 1, 0), regions: {{{regions}}})])");
    scene_from_text(&text).unwrap_or_else(|problems| panic!("{problems}"))
}

pub(crate) fn planned(scene: &Scene, naive: bool) -> Plan {
    Plan::new(scene, &PlanOptions { naive, without: Vec::new() }).unwrap()
}

pub(crate) const QUIET: Watch<'_> = Watch { now: &|| 0.0, progress: &|_| {} };

pub(crate) fn samples(n: u64) -> Stop {
    Stop { target: None, budget_seconds: None, samples: Some(n) }
}

pub(crate) fn taken(scene: &Scene, n: u64, seed: u64) -> Frame {
    expose(scene, &planned(scene, false), 0, &samples(n), seed, &QUIET).unwrap()
}

pub(crate) fn measured(scene: &Scene, n: u64, seed: u64) -> Measurement {
    measure(scene, &planned(scene, false), &samples(n), seed, &QUIET).unwrap()
}

/// Whether a value agrees with what is expected of it: 4.5 standard uncertainties of 12 degrees of freedom and more, and the rounding of formulas.
pub(crate) fn agree(value: f64, u: f64, expected: f64) -> bool {
    (value - expected).abs() <= 6.0 * u + 1e-9 * expected.abs()
}
