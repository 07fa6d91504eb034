//! Blocks of rays that are traced in lockstep, one lane a ray, components apart so that loops over lanes become vector code.

use crate::math::DVec3;
pub use crate::math::random::LANES;

/// No element, no triangle.
pub const NONE: u32 = u32::MAX;

/// Two surfaces closer together than this share of the distance to them count as one; the one that comes first in the scene is
/// met. It is a ratio: no length is built in.
pub const COINCIDENT: f64 = 1e-12;

/// A vector in every lane.
#[derive(Clone, Copy, Debug)]
pub struct Vectors {
    /// x components.
    pub x: [f64; LANES],
    /// y components.
    pub y: [f64; LANES],
    /// z components.
    pub z: [f64; LANES],
}

impl Vectors {
    /// Zero in every lane.
    pub const ZERO: Vectors = Vectors { x: [0.0; LANES], y: [0.0; LANES], z: [0.0; LANES] };

    /// The vector of a lane.
    #[inline(always)]
    #[must_use]
    pub fn get(&self, lane: usize) -> DVec3 {
        DVec3::new(self.x[lane], self.y[lane], self.z[lane])
    }

    /// Sets the vector of a lane.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, v: DVec3) {
        (self.x[lane], self.y[lane], self.z[lane]) = (v.x, v.y, v.z);
    }
}

/// A block of rays.
#[derive(Clone, Debug)]
pub struct Rays {
    /// Where they start, m.
    pub origin: Vectors,
    /// Where they go; of any length, distances are counted in its multiples.
    pub direction: Vectors,
    /// The rays end at `origin + t_end · direction`.
    pub t_end: [f64; LANES],
    /// The element that a ray leaves, which it cannot meet again at its start.
    pub leaving: [u32; LANES],
    /// The triangle of that element.
    pub leaving_part: [u32; LANES],
    /// The element that a ray ends on, which does not stand in its way.
    pub arriving: [u32; LANES],
    /// The triangle of that element.
    pub arriving_part: [u32; LANES],
    /// Whether the lane holds a ray.
    pub active: [bool; LANES],
}

impl Rays {
    /// No rays.
    #[must_use]
    pub fn none() -> Rays {
        Rays {
            origin: Vectors::ZERO,
            direction: Vectors::ZERO,
            t_end: [f64::INFINITY; LANES],
            leaving: [NONE; LANES],
            leaving_part: [NONE; LANES],
            arriving: [NONE; LANES],
            arriving_part: [NONE; LANES],
            active: [false; LANES],
        }
    }
}

/// What a block of rays meets first.
#[derive(Clone, Debug)]
pub struct Hits {
    /// Where, as a multiple of the direction; infinite where nothing is met.
    pub t: [f64; LANES],
    /// The element met, or [`NONE`].
    pub element: [u32; LANES],
    /// Its triangle, or [`NONE`].
    pub part: [u32; LANES],
}

impl Hits {
    /// Nothing met within the rays' ends.
    #[must_use]
    pub fn nothing(rays: &Rays) -> Hits {
        Hits { t: rays.t_end, element: [NONE; LANES], part: [NONE; LANES] }
    }
}
