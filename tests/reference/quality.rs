//! Group g2, f: quality indices of meters. One function a family.

use super::bench::Family;

pub(crate) const FAMILIES: &[(&str, Family)] = &[];
