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
//! | camera | `camera/` | a lens and an array of pixels |
//! | pixel | `pixel/`, `noise/` | charge, gain, noise and digital numbers of a camera pixel |
//! | channel | `channel.rs` | how well each wavelength counts, `s(λ)`, and what is read off |

pub mod acceptance;
pub mod aperture;
pub mod camera;
pub mod channel;
pub mod noise;
pub mod pixel;

pub use acceptance::{Acceptance, DirectionalResponse};
pub use aperture::Aperture;
pub use channel::Channel;
pub use noise::Exposure;
pub use pixel::{LinearModel, Pixel};

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
