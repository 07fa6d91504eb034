//! Numerical stability: sweeps over what is stiff or extreme, each reading held against a closed form or a law.
//!
//! ```text
//! parameter → scene text → plan → reading S ± U        deviation δ = S − S₀
//! a row holds:   |δ| ≤ 2 U + τ |S₀|   by a closed form S₀ that is itself good to the share τ
//!                |δ| ≤ τ |S₀|         by a law: the same scene transformed, with the same random numbers
//!                or the program says in words what is the matter
//! ```
//!
//! U is the expanded uncertainty at 95 %; one reading in twenty lies outside of it by its definition, hence the 2. Where S₀ is the
//! reading of another scene, both uncertainties count.
//!
//! | sweep | parameter | reference |
//! |---|---|---|
//! | [`scale`] | length of one metre, m | radiance has no length: the same reading |
//! | [`offset`] | distance from the origin, m | the same reading |
//! | [`source_size`] | solid angle of a source, sr | E = L Ω (1 − Ω/4π), and half of a disc |
//! | [`acceptance`] | solid angle of the acceptance, sr | E = π L sin²α; a filled meter reads L |
//! | [`grazing`] | angle from the normal, degrees | E = E₀ cos θ |
//! | [`reflectance`] | 1 − ρ | E = Φ / (4πR² (1 − ρ)) |
//! | [`radiance`] | radiance, W m⁻² sr⁻¹ | proportionality |
//! | [`line_width`] | width of a spectral line, nm | V(λ₀) + ½ (V′₊ − V′₋) σ √(2/π) → V(λ₀) |
//! | [`slivers`] | aspect ratio of triangles | product Gauss quadrature; half of a disc |
//! | [`touching`] | gap between an aperture and an emitter | perpendicular rectangles with a common edge |
//! | [`penumbra`] | width of a penumbra, m | the integral over the part that is seen |
//! | [`counts`] | numbers of spectral lines, sources, instruments | sums |
//!
//! | [`fits`] | condition, noise, number, faults and units of calibration readings | the true curve within its bands, or words |
//!
//! `run` executes, `reference` integrates, `text` writes scenes.

pub mod acceptance;
pub mod counts;
pub mod fits;
pub mod grazing;
pub mod line_width;
pub mod offset;
pub mod penumbra;
pub mod radiance;
pub mod reference;
pub mod reflectance;
mod run;
pub mod scale;
pub mod slivers;
pub mod source_size;
mod text;
pub mod touching;

pub use run::{COSTLY_SECONDS, Failing, Judgement, Row, SweepResult, run};

/// A parameter driven to where it is stiff or extreme.
#[derive(Clone, Copy, Debug)]
pub struct Sweep {
    /// Its name on the command line.
    pub name: &'static str,
    /// What is driven.
    pub parameter: &'static str,
    /// The parameter's unit; `1` for a number.
    pub unit: &'static str,
    /// What the readings are held against.
    pub law: &'static str,
    /// The points, series by series, each series towards the extreme.
    pub points: fn() -> Vec<Point>,
}

/// Every sweep.
pub const SWEEPS: [Sweep; 21] = [
    scale::SWEEP,
    offset::SWEEP,
    source_size::SWEEP,
    acceptance::SWEEP,
    grazing::SWEEP,
    reflectance::SWEEP,
    radiance::SWEEP,
    line_width::SWEEP,
    slivers::SWEEP,
    touching::SWEEP,
    penumbra::SWEEP,
    counts::LINES,
    counts::SOURCES,
    counts::INSTRUMENTS,
    fits::condition::SWEEP,
    fits::noise::SWEEP,
    fits::counts::EXPOSURES,
    fits::counts::DUPLICATES,
    fits::faults::ZEROS,
    fits::faults::CONTRADICTIONS,
    fits::units::SWEEP,
];

/// One scene of a sweep, and what it must read.
#[derive(Clone, Debug)]
pub struct Point {
    /// The series of the sweep that it belongs to.
    pub series: &'static str,
    /// Value of the parameter, in the sweep's unit.
    pub parameter: f64,
    /// The scene file; empty for a fit.
    pub scene: String,
    /// Files that it names: path and content.
    pub files: Vec<(String, Vec<u8>)>,
    /// Rules that are switched off, as with `--without`.
    pub without: Vec<&'static str>,
    /// Samples of each sampled contribution; `None` for the program's own stopping rule.
    pub samples: Option<u64>,
    /// What it must read.
    pub reference: Reference,
}

/// What a scene must read.
#[derive(Clone, Debug)]
pub enum Reference {
    /// A value for each reading, or one for all of them, good to the share `relative`.
    Values {
        /// In the unit of the readings.
        values: Vec<f64>,
        /// Rounding of the reference itself and of the numbers in the scene file, as a share of the value.
        relative: f64,
    },
    /// The readings of another scene times a factor. `relative` says that the random numbers are the same, and so all but the rounding.
    Law {
        /// The other scene.
        scene: String,
        /// What the law says.
        factor: f64,
        /// The share within which they must agree; `None`: within their joint uncertainty.
        relative: Option<f64>,
    },
    /// No reading at all: the program has to say why.
    Refused,
    /// No scene but readings, and the curves that their fits must find.
    Fit(Box<fits::FitProblem>),
}

impl Reference {
    /// A closed form; the reference and the numbers of the scene are rounded some ten times.
    #[must_use]
    pub fn exactly(value: f64) -> Reference {
        Reference::Values { values: vec![value], relative: 2e-15 }
    }
}

impl Point {
    /// A point that needs no more than its scene.
    #[must_use]
    pub fn new(series: &'static str, parameter: f64, scene: String, reference: Reference) -> Point {
        Point { series, parameter, scene, files: Vec::new(), without: Vec::new(), samples: None, reference }
    }

    /// The same with so many samples.
    #[must_use]
    pub fn sampled(self, samples: u64) -> Point {
        Point { samples: Some(samples), ..self }
    }
}

/// A true curve at its nodes, nm.
type Curve = fn(&[f64]) -> Vec<f64>;

/// 10ⁿ for n from `from` to `to` in steps of `step`, as the nearest double.
fn decades(from: i32, to: i32, step: i32) -> Vec<f64> {
    let count = (to - from) / step;
    (0..=count).map(|i| power_of_ten(from + i * step)).collect()
}

/// The double nearest to 10ⁿ.
fn power_of_ten(n: i32) -> f64 {
    format!("1e{n}").parse().unwrap_or(f64::NAN)
}
