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
//! | head | `head.rs` | the weight `w(ω)` of receptors that see all round |
//! | spot | `spot.rs` | the field of a luminance meter: R depends on the point of the pupil as well |
//! | channel | `channel.rs` | how well each wavelength counts, `s(λ)`, and what is read off |

pub mod acceptance;
pub mod aperture;
pub mod channel;
pub mod head;
pub mod spot;

pub use acceptance::{Acceptance, DirectionalResponse};
pub use aperture::Aperture;
pub use channel::Channel;
pub use head::{Head, HeadWeights};
pub use spot::Spot;

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
