//! The invariant of planning: kept + left out = naive, after every rule.

use super::{Plan, TermId, rule_names};

/// Why there is no plan.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlanError {
    /// `--without` names no rule.
    #[error("unknown rule `{name}`; rules: {}", .known.join(", "))]
    UnknownRule {
        /// What was given.
        name: String,
        /// What could have been.
        known: Vec<&'static str>,
    },
    /// A rule lost or invented terms: an error of the program.
    #[error(
        "internal error: after the rule `{rule}` the plan holds {found} terms instead of {expected}, or not the same ones; please report this"
    )]
    NotAPartition {
        /// The rule after which it was noticed.
        rule: &'static str,
        /// Terms of the naive plan.
        expected: usize,
        /// Terms now.
        found: usize,
    },
}

impl PlanError {
    pub(super) fn unknown_rule(name: &str) -> PlanError {
        PlanError::UnknownRule { name: name.to_owned(), known: rule_names() }
    }
}

/// The terms of the naive plan, as a count and an order-free sum of hashes.
pub(super) struct Census {
    count: usize,
    sum: u64,
}

impl Census {
    pub(super) fn of(plan: &Plan) -> Census {
        let ids = plan.kept.iter().map(|t| &t.id).chain(plan.omitted.iter().map(|o| &o.id));
        let (count, sum) = ids.fold((0, 0u64), |(n, sum), id| (n + 1, sum.wrapping_add(fingerprint(id))));
        Census { count, sum }
    }

    pub(super) fn verify(&self, plan: &Plan, rule: &'static str) -> Result<(), PlanError> {
        let now = Census::of(plan);
        if now.count == self.count && now.sum == self.sum {
            Ok(())
        } else {
            Err(PlanError::NotAPartition { rule, expected: self.count, found: now.count })
        }
    }
}

fn fingerprint(id: &TermId) -> u64 {
    let parts = [id.instrument() as u64, id.channel() as u64, id.source() as u64, id.transport as u64];
    // A multiply–rotate chain: terms that swap their indices must not cancel in the sum.
    parts.iter().fold(0x243f_6a88_85a3_08d3, |h: u64, &p| (h ^ p).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29))
}
