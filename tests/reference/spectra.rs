//! Group g2, a to d: black bodies, illuminants, the daylight series, lines and Gaussians. One function a family.

use super::bench::Family;

pub(crate) const FAMILIES: &[(&str, Family)] = &[];
