//! Sensors: aperture × acceptance × channels × readout.
//!
//! ```text
//! S = ∫λ ∫A ∫Ω s(λ) R(ω) L(x, ω, λ) (ω·n) dω dA dλ
//! ```
//!
//! | part | file | what it is |
//! |---|---|---|
//! | aperture | `aperture.rs` | where light enters: `A` |
//! | acceptance | `acceptance.rs` | from which directions, and how well: `R(ω)` |
//! | channel | `channel.rs` | how well each wavelength counts, `s(λ)`, and what is read off |

pub mod acceptance;
pub mod aperture;
pub mod channel;

pub use acceptance::{Acceptance, DirectionalResponse};
pub use aperture::Aperture;
pub use channel::{Channel, ResponsivityKind, ResponsivityUncertainty, TemperatureCoefficient, Weighting};

/// A sensor, without a place in a scene.
#[derive(Clone, Debug)]
pub struct Sensor {
    /// What it is called in reports.
    pub title: String,
    /// Where light enters.
    pub aperture: Aperture,
    /// From which directions.
    pub acceptance: Acceptance,
    /// What is read off, at least one.
    pub channels: Vec<Channel>,
}

impl Sensor {
    /// A sensor of its parts; at least one channel is needed to read anything.
    #[must_use]
    pub fn new(title: impl Into<String>, aperture: Aperture, acceptance: Acceptance, channels: Vec<Channel>) -> Sensor {
        Sensor { title: title.into(), aperture, acceptance, channels }
    }
}
