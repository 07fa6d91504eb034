//! Where paths start: at the aperture of an instrument, or at the pupil of a camera.

use std::f64::consts::PI;

use crate::estimate::receiver::Receiver;
use crate::math::DVec3;

/// The first ray of a path.
pub(in crate::estimate) struct FirstRay {
    pub(in crate::estimate) origin: DVec3,
    /// Of any length but zero.
    pub(in crate::estimate) direction: DVec3,
    /// What a radiance along the ray counts; zero where it is not accepted.
    pub(in crate::estimate) weight: f64,
}

/// Where paths start.
pub(in crate::estimate) trait Start {
    /// Unit normal about which directions are proposed.
    fn normal(&self) -> DVec3;
    /// Sine of the angle from it within which they are, with density cosθ/(π sin²α).
    fn sine_limit(&self) -> f64;
    /// Element and triangle that the rays leave.
    fn leaves(&self) -> [u32; 2];
    /// The ray of four numbers, the first two of which made the proposed direction.
    fn ray(&self, proposed: DVec3, u: [f64; 4]) -> FirstRay;
}

impl Start for Receiver<'_> {
    #[inline(always)]
    fn normal(&self) -> DVec3 {
        self.pose.normal
    }

    #[inline(always)]
    fn sine_limit(&self) -> f64 {
        self.sine_limit
    }

    #[inline(always)]
    fn leaves(&self) -> [u32; 2] {
        [self.resting_on, self.resting_part]
    }

    #[inline(always)]
    fn ray(&self, proposed: DVec3, u: [f64; 4]) -> FirstRay {
        let sine = self.sine_limit;
        FirstRay { origin: self.point([u[2], u[3]]), direction: proposed, weight: self.response(proposed) * PI * sine * sine }
    }
}
