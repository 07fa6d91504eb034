//! Where paths start: at the aperture of an instrument, or at the pupil of a camera.

use crate::estimate::receiver::Receiver;
use crate::math::DVec3;

/// The first ray of a path.
pub(in crate::estimate) struct FirstRay {
    pub(in crate::estimate) origin: DVec3,
    /// Of any length but zero.
    pub(in crate::estimate) direction: DVec3,
    /// What a radiance along the ray counts over the density of its choice; zero where it is not accepted.
    pub(in crate::estimate) weight: f64,
}

/// Where paths start.
pub(in crate::estimate) trait Start {
    /// Unit vector that lanes hold before they have met a surface.
    fn normal(&self) -> DVec3;
    /// Element and triangle that the rays leave.
    fn leaves(&self) -> [u32; 2];
    /// The ray of four numbers.
    fn ray(&self, u: [f64; 4]) -> FirstRay;
}

impl Start for Receiver<'_> {
    #[inline(always)]
    fn normal(&self) -> DVec3 {
        self.pose.normal
    }

    #[inline(always)]
    fn leaves(&self) -> [u32; 2] {
        [self.resting_on, self.resting_part]
    }

    #[inline(always)]
    fn ray(&self, u: [f64; 4]) -> FirstRay {
        let (origin, direction, weight) = self.look(u);
        FirstRay { origin, direction, weight }
    }
}
