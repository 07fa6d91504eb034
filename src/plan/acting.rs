//! Which rule stands behind what became of a term, and which rules act in a plan.

use super::choose::{closed_form, closed_sphere};
use super::omit::{delta_source, nothing_blocks};
use super::{Method, Plan, Term, Visibility, reading_rule_names};

impl Method {
    /// The rule that chose this method; `None` for those of the naive plan.
    #[must_use]
    pub fn rule(self) -> Option<&'static str> {
        match self {
            Method::ClosedForm | Method::Quadrature => Some(closed_form::CHOICE.name),
            Method::ClosedSphere => Some(closed_sphere::CHOICE.name),
            Method::Connection => Some(delta_source::RULE.name),
            Method::SampledSource | Method::SampledSky | Method::Paths => None,
        }
    }
}

impl Visibility {
    /// The rule that proved it; `None` where rays find out.
    #[must_use]
    pub fn rule(self) -> Option<&'static str> {
        match self {
            Visibility::Clear => Some(nothing_blocks::RULE.name),
            Visibility::Tested => None,
        }
    }
}

impl Term {
    /// The rules that made this term what it is; none for a term of the naive plan.
    pub fn rules(&self) -> impl Iterator<Item = &'static str> {
        self.method.rule().into_iter().chain(self.visibility.rule())
    }
}

impl Plan {
    /// How many terms a rule left out or made cheaper. What another rule overruled afterwards does not count.
    #[must_use]
    pub fn terms_by(&self, rule: &str) -> usize {
        let made_cheaper = self.kept.iter().filter(|term| term.rules().any(|name| name == rule)).count();
        made_cheaper + self.omitted.iter().filter(|omission| omission.rule == rule).count()
    }

    /// The rules that act in this plan, in the order of [`reading_rule_names`].
    #[must_use]
    pub fn acting(&self) -> Vec<&'static str> {
        reading_rule_names().into_iter().filter(|rule| self.terms_by(rule) > 0).collect()
    }

    /// Whether the other plan computes the same terms in the same way. Reasons for what is left out may differ.
    #[must_use]
    pub fn same_work(&self, other: &Plan) -> bool {
        self.naive == other.naive && self.kept == other.kept
    }
}
