//! Where a reading came from.

use crate::plan::Plan;
use crate::scene::Scene;
use crate::scene::files::hashed;

/// What is needed to repeat a reading.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Provenance {
    /// Version of this library.
    pub version: &'static str,
    /// Hash of every file that the scene was read from; zero for a scene made in memory.
    pub scene_hash: u64,
    /// Hash of the plan in words.
    pub plan_hash: u64,
}

impl Provenance {
    pub(super) fn of(scene: &Scene, plan: &Plan) -> Provenance {
        Provenance { version: env!("CARGO_PKG_VERSION"), scene_hash: scene.hash, plan_hash: hashed(0, plan.explain(scene).as_bytes()) }
    }
}
