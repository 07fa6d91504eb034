//! Where a reading came from.

use crate::plan::Plan;
use crate::scene::Scene;

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
        Provenance { version: env!("CARGO_PKG_VERSION"), scene_hash: scene.hash, plan_hash: fnv1a(plan.explain(scene).as_bytes()) }
    }
}

/// FNV-1a, 64 bits: tells files apart, guards against nothing.
fn fnv1a(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |h, &b| (h ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3))
}
