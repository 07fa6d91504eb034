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
//! | head | `head.rs` | the weight `w(ω)` of receptors that see all round |
//! | spot | `spot.rs` | the field of a luminance meter: R depends on the point of the pupil as well |
//! | channel | `channel.rs` | how well each wavelength counts, `s(λ)`, and what is read off |
//! | readout | `photodiode.rs` | from a photocurrent to what is displayed: noise, range, steps |

pub mod acceptance;
pub mod aperture;
pub mod camera;
pub mod channel;
pub mod head;
pub mod noise;
pub mod photodiode;
pub mod pixel;
pub mod spot;

pub use acceptance::{Acceptance, DirectionalResponse};
pub use aperture::Aperture;
pub use channel::{Channel, ResponsivityKind, ResponsivityUncertainty, TemperatureCoefficient, Weighting};
pub use head::{Head, HeadWeights};
pub use noise::Exposure;
pub use photodiode::Photodiode;
pub use pixel::{LinearModel, Pixel};
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
    /// Electronics behind the channels; without one a channel indicates what it collects.
    pub readout: Option<Photodiode>,
}

impl Sensor {
    /// A sensor of its parts without a readout; at least one channel is needed to read anything.
    #[must_use]
    pub fn new(title: impl Into<String>, aperture: Aperture, acceptance: Acceptance, channels: Vec<Channel>) -> Sensor {
        Sensor { title: title.into(), aperture, acceptance, channels, readout: None }
    }

    /// Photocurrent of one unit of a channel's indication, A.
    ///
    /// `None` where there is none: the responsivity is not in A/W or the aperture is a point, and the readout does not state it.
    #[must_use]
    pub fn photocurrent_per_unit_a(&self, channel: &Channel) -> Option<f64> {
        if let Some(stated) = self.readout.as_ref().and_then(|readout| readout.current_a_per_unit) {
            return Some(stated);
        }
        // Temperature changes current and indication alike.
        let unheated = Channel { temperature: None, ..channel.clone() };
        let per_irradiance = unheated.indication_per_irradiance(&self.aperture, &self.acceptance)?;
        channel.kind.is_absolute().then_some(self.aperture.area_m2()? / per_irradiance)
    }
}
