//! Group g2, chromaticities and efficacies: black bodies, illuminants, LEDs. One function a family.

use super::bench::Family;

pub(crate) const FAMILIES: &[(&str, Family)] = &[];
