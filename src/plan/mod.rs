//! What will be computed, what is left out, and why. Pure: no rays, no random numbers, no clocks.
//!
//! ```text
//! Scene ─naive→ every term, by rays ─omit→ fewer and narrower terms ─choose→ a method for each ─check→ Plan
//! ```
//!
//! A plan is a partition. The naive plan lists every term of the measurand: instrument channel × source × {direct, reflected},
//! each over the whole band, with visibility tests. A rule (`omit/`, one a file) may leave a term out, with a reason and a bound,
//! or narrow it; `choose/` then picks the cheapest method that serves. After every rule the terms kept and left out must be the
//! naive ones again; a rule that breaks this stops the run.

mod acting;
pub mod camera;
mod check;
pub mod choose;
mod explain;
pub mod omit;
pub(crate) mod sight;
pub mod spectral;
mod term;

pub use camera::CameraPlan;
pub use check::PlanError;
pub use term::{Bound, Method, Narrowing, Omission, Term, TermId, Transport, Visibility};

use crate::scene::Scene;
use spectral::SpectralPlan;

/// How to plan.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PlanOptions {
    /// Leave nothing out: every term by rays.
    pub naive: bool,
    /// Names of rules that are switched off.
    pub without: Vec<String>,
}

/// What will be computed, and what not.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Whether nothing was left out on purpose.
    pub naive: bool,
    /// The terms that will be computed.
    pub kept: Vec<Term>,
    /// The terms that will not.
    pub omitted: Vec<Omission>,
    /// What the rules made smaller.
    pub narrowed: Vec<Narrowing>,
    /// How the wavelengths of reflected light are treated, per instrument; `None` where nothing reflected is computed.
    pub spectral: Vec<Option<SpectralPlan>>,
    /// Whether rays are traced at all, and so whether the surfaces are prepared for them.
    pub needs_rays: bool,
    /// How each camera of the scene is rendered.
    pub cameras: Vec<CameraPlan>,
    /// Rules that were switched off by name.
    pub without: Vec<String>,
}

impl Plan {
    /// Plans a scene. A scene that validated always has a plan; the errors are an unknown rule name, and a rule that lost a term.
    pub fn new(scene: &Scene, options: &PlanOptions) -> Result<Plan, PlanError> {
        for name in &options.without {
            if !rule_names().contains(&name.as_str()) {
                return Err(PlanError::unknown_rule(name));
            }
        }
        let mut plan = Plan::naive(scene);
        plan.naive = options.naive;
        plan.without.clone_from(&options.without);
        let expected = check::Census::of(&plan);
        if !options.naive {
            for rule in omit::RULES {
                if !options.without.iter().any(|name| name == rule.name) {
                    (rule.apply)(scene, &mut plan);
                    expected.verify(&plan, rule.name)?;
                }
            }
            choose::choose_methods(scene, &mut plan, &options.without);
            expected.verify(&plan, "choose")?;
        }
        plan.spectral = spectral::plan_wavelengths(scene, &plan);
        plan.cameras = CameraPlan::of(scene, options);
        plan.needs_rays = plan.kept.iter().any(Term::needs_rays);
        Ok(plan)
    }

    /// Every term of the measurand, by rays.
    fn naive(scene: &Scene) -> Plan {
        let mut kept = Vec::new();
        for (instrument, i) in scene.instruments.iter().enumerate() {
            for channel in 0..i.sensor.channels.len() {
                for transport in [Transport::Direct, Transport::Reflected] {
                    for (source, s) in scene.sources.iter().enumerate() {
                        let id = TermId::new(instrument, channel, source, transport);
                        kept.push(Term { id, visibility: Visibility::Tested, method: Method::by_rays(s, transport) });
                    }
                }
            }
        }
        Plan {
            naive: true,
            kept,
            omitted: Vec::new(),
            narrowed: Vec::new(),
            spectral: Vec::new(),
            needs_rays: true,
            cameras: Vec::new(),
            without: Vec::new(),
        }
    }

    /// Moves the terms that a rule names to the omitted ones.
    pub(crate) fn omit(&mut self, rule: &'static str, mut reason: impl FnMut(&Term) -> Option<(std::borrow::Cow<'static, str>, Bound)>) {
        let mut omitted = std::mem::take(&mut self.omitted);
        self.kept.retain(|term| match reason(term) {
            Some((reason, bound)) => {
                omitted.push(Omission { id: term.id, rule, reason, bound });
                false
            }
            None => true,
        });
        self.omitted = omitted;
    }

    /// The kept terms of an instrument with one kind of transport.
    pub fn terms_of(&self, instrument: usize, transport: Transport) -> impl Iterator<Item = &Term> {
        self.kept.iter().filter(move |t| t.id.instrument() == instrument && t.id.transport == transport)
    }
}

/// Every name that `--without` accepts: the rules of readings, then those of cameras.
#[must_use]
pub fn rule_names() -> Vec<&'static str> {
    reading_rule_names().into_iter().chain(camera::RULES.iter().map(|(name, _)| *name)).collect()
}

/// The rules of readings: those that omit, then ways to choose.
#[must_use]
pub fn reading_rule_names() -> Vec<&'static str> {
    omit::RULES.iter().map(|r| r.name).chain(choose::CHOICES.iter().map(|c| c.name)).collect()
}
