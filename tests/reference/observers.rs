//! Group g2, g to i: α-opic quantities, cones, visual pigments, mesopic luminance. One function a family.

use super::bench::Family;

pub(crate) const FAMILIES: &[(&str, Family)] = &[];
