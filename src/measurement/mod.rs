//! From estimates to readings: value, unit, uncertainty with its budget, and where it came from.
//!
//! ```text
//! reading = indication_per_irradiance · (Σ exact + Σ means of replicates),   U = k u_c,   k = t₀.₉₇₅(ν_eff)
//! ```
//!
//! | row of the budget | type | from |
//! |---|---|---|
//! | a sampled contribution | A | the spread of its 16 replicates, 15 degrees of freedom |
//! | a shadow or a gap that all samples may have missed | B | one-sided bound, 95 % |
//! | wavelengths between the nodes | B | residual of the spectral quadrature |
//! | quadrature over aperture or response | B | its own error estimate |
//! | double-precision arithmetic | B | within ± 1e-12 of the value |
//! | rounding of coordinates | B | far from the origin, and of slivers, where it is more than that (`coordinates.rs`) |
//! | what a rule left out | B | its bound |
//! | responsivity | B | as its file states it, the same cause at all wavelengths |
//! | noise and steps of a readout | B | one reading of the display (`electronics.rs`) |
//!
//! What an ideal instrument would indicate in the same place: [`ideal`].

mod companion;
mod coordinates;
mod electronics;
pub mod frame;
mod header;
pub mod ideal;
mod own_uncertainty;
mod provenance;
mod reading;

pub use electronics::DisplayReading;
pub use frame::{Frame, Plane, expose};
pub use header::CheckpointHeader;
pub use ideal::{Cause, IdealReading, Part, add_ideal};
pub use provenance::{Difference, Provenance, in_words};
pub use reading::{Measurement, Reading, measure, measure_with};
