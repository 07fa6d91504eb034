//! Where a reading came from.

use crate::estimate::Stop;
use crate::plan::Plan;
use crate::scene::Scene;
use crate::scene::files::hashed;

/// What is needed to repeat a measurement.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Provenance {
    /// Version of this library.
    pub version: String,
    /// The scene file as it was named; empty for a scene made in memory. The library is not told: whoever read the file fills it in.
    pub scene_file: String,
    /// The folder that no file may lie outside of, if one was named; filled in like the file.
    pub root: Option<String>,
    /// Hash of every file that the scene was read from; zero for a scene made in memory.
    pub scene_hash: u64,
    /// Hash of the plan in words.
    pub plan_hash: u64,
    /// Whether nothing was left out on purpose.
    pub naive: bool,
    /// Rules that were switched off by name.
    pub without: Vec<String>,
    /// Seed of the random numbers.
    pub seed: u64,
    /// What ended the run.
    pub stop: Stop,
    /// For a run that a budget of time may have ended, the rounds of samples that each batch of poses took; else empty.
    pub rounds: Vec<u32>,
}

impl Provenance {
    /// Of a measurement that is about to be made by this library.
    #[must_use]
    pub fn of(scene: &Scene, plan: &Plan, stop: &Stop, seed: u64) -> Provenance {
        Provenance {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            scene_hash: scene.hash,
            plan_hash: hashed(0, plan.explain(scene).as_bytes()),
            naive: plan.naive,
            without: plan.without.clone(),
            seed,
            stop: *stop,
            ..Provenance::default()
        }
    }

    /// What keeps two measurements from having the same bits. Where the scene lies is no difference as long as it says the same.
    #[must_use]
    pub fn differences(&self, there: &Provenance) -> Vec<Difference> {
        let mut found = Vec::new();
        let mut compare = |what: &'static str, here: String, there: String| {
            if here != there {
                found.push(Difference { what, here, there });
            }
        };
        let hash = |h: u64| format!("{h:016x}");
        let rules = |p: &Provenance| {
            let mut rules = p.without.clone();
            rules.sort();
            rules.dedup();
            if rules.is_empty() { "none".to_owned() } else { rules.join(", ") }
        };
        compare("version", self.version.clone(), there.version.clone());
        compare("scene (a hash of all its files)", hash(self.scene_hash), hash(there.scene_hash));
        compare("seed", self.seed.to_string(), there.seed.to_string());
        compare("stop rule", in_words(&self.stop), in_words(&there.stop));
        compare("naive", self.naive.to_string(), there.naive.to_string());
        compare("rules switched off", rules(self), rules(there));
        // A plan follows from the rest: told only where the rest does not.
        if found.is_empty() {
            let (here, there) = (hash(self.plan_hash), hash(there.plan_hash));
            if here != there {
                found.push(Difference { what: "plan (a hash of it in words)", here, there });
            }
        }
        found
    }
}

/// Something that two measurements do not share.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// What it is: "seed".
    pub what: &'static str,
    /// How it is in the one that was asked.
    pub here: String,
    /// How it is in the other one.
    pub there: String,
}

impl Difference {
    /// In words, with a name for each of the two: "seed: 0 here, 1 in the checkpoint".
    #[must_use]
    pub fn told(&self, here: &str, there: &str) -> String {
        format!("{}: {} {here}, {} {there}", self.what, self.here, self.there)
    }
}

/// A rule to stop, as one would ask for it.
#[must_use]
pub fn in_words(stop: &Stop) -> String {
    let parts: Vec<String> = [
        stop.target.map(|t| format!("target {t:?}")),
        stop.budget_seconds.map(|b| format!("budget {b:?} s")),
        stop.samples.map(|n| format!("{n} samples")),
    ]
    .into_iter()
    .flatten()
    .collect();
    if parts.is_empty() { "none".to_owned() } else { parts.join(", ") }
}
