//! Standard uncertainty of readings that comes from responsivities with an uncertainty for each wavelength.
//!
//! ```text
//! u(S) = scale · ∫ u(s) E dλ      one cause for all wavelengths: contributions add up
//! ```
//!
//! E is the light that arrives, so a companion with u(s) for a responsivity reads it (`companion.rs`). A few samples suffice: an uncertainty
//! that is known to some percent is well known.

use super::companion::{Received, estimated, indication};
use crate::estimate::{EstimateError, PoseEstimate, Watch};
use crate::plan::Plan;
use crate::scene::Scene;
use crate::sensor::{Channel, ResponsivityUncertainty, Sensor};

/// Samples of each contribution and pose.
const SAMPLES: u64 = 1024;

/// One instrument with such responsivities.
struct Own {
    instrument: usize,
    sensor: Sensor,
    /// The channel that each channel of the companion belongs to.
    channels: Vec<usize>,
    poses: Vec<PoseEstimate>,
}

/// What companions of all instruments read.
pub(super) struct OwnUncertainty(Vec<Own>);

impl OwnUncertainty {
    pub(super) fn of(scene: &Scene, plan: &Plan, seed: u64, watch: &Watch<'_>) -> Result<OwnUncertainty, EstimateError> {
        let mut found = Vec::new();
        for (instrument, i) in scene.instruments.iter().enumerate() {
            let (mut channels, mut companions) = (Vec::new(), Vec::new());
            for (c, channel) in i.sensor.channels.iter().enumerate() {
                for u in &channel.responsivity_uncertainty {
                    if let ResponsivityUncertainty::Curve(curve) = u {
                        channels.push(c);
                        companions.push(Channel { responsivity: curve.clone(), ..channel.clone() });
                    }
                }
            }
            if channels.is_empty() {
                continue;
            }
            let sensor = Sensor::new(i.sensor.title.clone(), i.sensor.aperture, i.sensor.acceptance.clone(), companions);
            let poses = estimated(scene, plan, vec![(instrument, sensor.clone())], SAMPLES, seed, watch)?;
            let poses = poses.into_iter().next().unwrap_or_default();
            found.push(Own { instrument, sensor, channels, poses });
        }
        Ok(OwnUncertainty(found))
    }

    /// Standard uncertainties of a reading, one for each cause, in its unit.
    pub(super) fn of_channel(&self, instrument: usize, pose: usize, channel: usize) -> Vec<f64> {
        let mine = self.0.iter().filter(|own| own.instrument == instrument);
        let read = |own: &Own, k: usize| -> Option<f64> {
            let scale = own.sensor.channels.get(k)?.indication_per_irradiance(&own.sensor.aperture, &own.sensor.acceptance)?;
            Some(indication(Received { estimate: own.poses.get(pose)?.channels.get(k)?, scale }).0)
        };
        mine.flat_map(|own| (0..own.channels.len()).filter(|&k| own.channels[k] == channel).filter_map(|k| read(own, k))).collect()
    }
}
