//! Where light enters: the area `A` over which the irradiance is collected.
//!
//! | aperture | scene file | area |
//! |---|---|---|
//! | a point | `Point` | none: readings are per square metre |
//! | a disc about the position | `Disc(radius_mm: 5)` | π r² |
//! | a rectangle about the position, its width along the sensor's x axis | `Rectangle(width_mm: 10, height_mm: 8)` | w h |

use std::f64::consts::PI;

/// The area over which a sensor collects, in the plane of its normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Aperture {
    /// A point.
    Point,
    /// A disc.
    Disc {
        /// Radius, m.
        radius_m: f64,
    },
    /// A rectangle.
    Rectangle {
        /// Half the extent along the sensor's x axis, m.
        half_width_m: f64,
        /// Half the extent along the sensor's y axis, m.
        half_height_m: f64,
    },
}

impl Aperture {
    /// Area in m²; none for a point.
    #[must_use]
    pub fn area_m2(&self) -> Option<f64> {
        match *self {
            Aperture::Point => None,
            Aperture::Disc { radius_m } => Some(PI * radius_m * radius_m),
            Aperture::Rectangle { half_width_m, half_height_m } => Some(4.0 * half_width_m * half_height_m),
        }
    }

    /// Radius of a circle about the centre that holds the aperture, m.
    #[must_use]
    pub fn radius_m(&self) -> f64 {
        match *self {
            Aperture::Point => 0.0,
            Aperture::Disc { radius_m } => radius_m,
            Aperture::Rectangle { half_width_m, half_height_m } => half_width_m.hypot(half_height_m),
        }
    }
}
