//! What a scene does not need: one rule a file, each a sentence, a function and a bound.

mod behind_horizon;
pub(super) mod delta_source;
mod emits_elsewhere;
mod no_common_wavelength;
mod no_reflector_in_view;
pub(super) mod nothing_blocks;
mod outside_acceptance;
mod weak_reflections;

use super::Plan;
use crate::scene::Scene;

/// A rule of omission.
pub struct Rule {
    /// What `--without` calls it.
    pub name: &'static str,
    /// What it observes, as a sentence.
    pub sentence: &'static str,
    /// Applies it.
    pub apply: fn(&Scene, &mut Plan),
}

/// The rules in the order in which they are applied: first what removes terms for good and cheaply, so that the later,
/// geometric ones have less to look at; visibility after that, since it only matters for terms that are left; the bound on
/// weak reflections last, since it needs the direct terms that it is compared with.
pub const RULES: &[Rule] = &[
    no_common_wavelength::RULE,
    behind_horizon::RULE,
    emits_elsewhere::RULE,
    outside_acceptance::RULE,
    no_reflector_in_view::RULE,
    nothing_blocks::RULE,
    delta_source::RULE,
    weak_reflections::RULE,
];
