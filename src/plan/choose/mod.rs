//! How the terms that are left are computed: the cheapest method that serves, one choice a file.

pub(super) mod closed_form;
pub(super) mod closed_sphere;

use super::Plan;
use crate::scene::Scene;

/// A choice among methods.
pub struct Choice {
    /// What `--without` calls it.
    pub name: &'static str,
    /// What it observes, as a sentence.
    pub sentence: &'static str,
    /// Applies it.
    pub apply: fn(&Scene, &mut Plan),
}

/// The choices, in the order in which they are tried.
pub const CHOICES: &[Choice] = &[closed_form::CHOICE, closed_sphere::CHOICE];

pub(super) fn choose_methods(scene: &Scene, plan: &mut Plan, without: &[String]) {
    for choice in CHOICES {
        if !without.iter().any(|name| name == choice.name) {
            (choice.apply)(scene, plan);
        }
    }
}

pub use closed_form::Formula;
pub use closed_form::formula;
pub use closed_sphere::ClosedSphere;
