//! What came out: case by case, and by group.

use std::collections::BTreeMap;

use super::case::{Case, Found};

/// What became of a case.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// It agrees.
    Agrees(Found),
    /// It deviates by more than is allowed.
    Deviates(Found),
    /// It could not be computed: a failure.
    Failed(String),
    /// It is not computed, for a reason that is stated.
    Waits(String),
    /// It states a behaviour and no number; the tests hold it.
    Behaviour(String),
}

impl Verdict {
    /// Whether what was found agrees with the reference.
    pub(super) fn of(case: &Case, reference: f64, found: Found) -> Verdict {
        let deviation = (found.value - reference).abs();
        if deviation <= found.limit(case.tolerance()) { Verdict::Agrees(found) } else { Verdict::Deviates(found) }
    }
}

/// A case with what became of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// `g1c.disc-par-3`.
    pub id: String,
    /// `g1`.
    pub group: String,
    /// `g1c`.
    pub part: String,
    /// What is computed, in a sentence.
    pub title: String,
    /// Symbol of the quantity.
    pub quantity: String,
    /// Unit of reference, reading and tolerance.
    pub unit: String,
    /// The reference.
    pub reference: Option<f64>,
    /// Largest deviation that passes.
    pub tolerance: f64,
    /// What became of it.
    pub verdict: Verdict,
    /// Time that it took, s.
    pub seconds: f64,
}

impl Check {
    pub(super) fn new(case: &Case, verdict: Verdict, seconds: f64) -> Check {
        Check {
            id: case.id().to_owned(),
            group: case.group().to_owned(),
            part: case.part().to_owned(),
            title: case.title().to_owned(),
            quantity: case.quantity().to_owned(),
            unit: case.unit().to_owned(),
            reference: case.reference(),
            tolerance: case.tolerance(),
            verdict,
            seconds,
        }
    }

    /// What was computed, if anything was.
    pub fn found(&self) -> Option<&Found> {
        match &self.verdict {
            Verdict::Agrees(found) | Verdict::Deviates(found) => Some(found),
            _ => None,
        }
    }

    /// Whether the program is at fault.
    pub fn fails(&self) -> bool {
        matches!(self.verdict, Verdict::Deviates(_) | Verdict::Failed(_))
    }

    /// One word for the verdict.
    pub fn word(&self) -> &'static str {
        match self.verdict {
            Verdict::Agrees(_) => "ok",
            Verdict::Deviates(_) => "DEVIATES",
            Verdict::Failed(_) => "FAILED",
            Verdict::Waits(_) => "waits",
            Verdict::Behaviour(_) => "behaviour",
        }
    }

    /// Why there is no value.
    pub fn reason(&self) -> Option<&str> {
        match &self.verdict {
            Verdict::Failed(why) | Verdict::Waits(why) | Verdict::Behaviour(why) => Some(why),
            _ => None,
        }
    }

    /// Reading less reference, in the unit of the case.
    pub fn deviation(&self) -> Option<f64> {
        Some(self.found()?.value - self.reference?)
    }

    /// Deviation over |reference|; `None` for a reference of zero.
    pub fn relative_deviation(&self) -> Option<f64> {
        let reference = self.reference.filter(|reference| *reference != 0.0)?;
        Some(self.deviation()? / reference.abs())
    }

    /// Deviation over the standard uncertainty that the reading states; `None` for the value of a function or a reading without doubt.
    pub fn deviation_in_u(&self) -> Option<f64> {
        let u = self.found()?.standard_uncertainty.filter(|u| *u > 0.0)?;
        Some(self.deviation()? / u)
    }

    /// |deviation| over the largest that passes, [`Found::limit`]. Above 1 it fails; NaN for no number.
    pub fn deviation_in_limits(&self) -> Option<f64> {
        let found = self.found()?;
        let deviation = self.deviation()?.abs();
        Some(if deviation == 0.0 { 0.0 } else { deviation / found.limit(self.tolerance) })
    }
}

/// Counts and largest deviations of some cases.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// Group or part.
    pub name: String,
    /// What it is about; empty for a part.
    pub title: String,
    /// Cases that agree.
    pub agree: usize,
    /// Cases that deviate or could not be computed.
    pub fail: usize,
    /// Cases that wait.
    pub wait: usize,
    /// Cases that state a behaviour.
    pub behaviours: usize,
    /// Largest deviation in limits, and the case that has it.
    pub largest: Option<(f64, String)>,
    /// Largest |deviation| in u of the readings, and the case that has it.
    pub largest_in_u: Option<(f64, String)>,
    /// Time, s.
    pub seconds: f64,
}

/// Of two deviations the one that is worse: NaN is worst.
fn worse(a: &Option<(f64, String)>, b: f64) -> bool {
    a.as_ref().is_none_or(|(a, _)| !a.is_nan() && (b.is_nan() || b > *a))
}

impl Summary {
    /// Of the cases given.
    pub fn of<'a>(name: &str, title: &str, checks: impl Iterator<Item = &'a Check>) -> Summary {
        let mut sum = Summary {
            name: name.to_owned(),
            title: title.to_owned(),
            agree: 0,
            fail: 0,
            wait: 0,
            behaviours: 0,
            largest: None,
            largest_in_u: None,
            seconds: 0.0,
        };
        for check in checks {
            match check.verdict {
                Verdict::Agrees(_) => sum.agree += 1,
                Verdict::Deviates(_) | Verdict::Failed(_) => sum.fail += 1,
                Verdict::Waits(_) => sum.wait += 1,
                Verdict::Behaviour(_) => sum.behaviours += 1,
            }
            sum.seconds += check.seconds;
            if let Some(x) = check.deviation_in_limits().filter(|x| worse(&sum.largest, *x)) {
                sum.largest = Some((x, check.id.clone()));
            }
            if let Some(x) = check.deviation_in_u().map(f64::abs).filter(|x| worse(&sum.largest_in_u, *x)) {
                sum.largest_in_u = Some((x, check.id.clone()));
            }
        }
        sum
    }

    /// Cases of any verdict.
    pub fn cases(&self) -> usize {
        self.agree + self.fail + self.wait + self.behaviours
    }
}

/// What came out of all cases of a selection.
#[derive(Clone, Debug, PartialEq)]
pub struct Verification {
    /// Case by case.
    pub checks: Vec<Check>,
    /// What each group is about.
    pub titles: BTreeMap<String, String>,
    /// Time from start to end, s.
    pub seconds: f64,
}

impl Verification {
    /// Whether something was computed and nothing fails.
    pub fn passed(&self) -> bool {
        self.checks.iter().any(|check| check.found().is_some()) && !self.checks.iter().any(Check::fails)
    }

    /// Groups, in the order of their names.
    pub fn groups(&self) -> Vec<Summary> {
        let of = |name: &str| {
            let title = self.titles.get(name).map_or("", String::as_str);
            Summary::of(name, title, self.checks.iter().filter(|check| check.group == name))
        };
        names(self.checks.iter().map(|check| check.group.as_str())).into_iter().map(of).collect()
    }

    /// Parts of the groups, in the order of their names.
    pub fn parts(&self) -> Vec<Summary> {
        let of = |name: &str| Summary::of(name, "", self.checks.iter().filter(|check| check.part == name));
        names(self.checks.iter().map(|check| check.part.as_str())).into_iter().map(of).collect()
    }

    /// Everything.
    pub fn total(&self) -> Summary {
        Summary { seconds: self.seconds, ..Summary::of("all", "", self.checks.iter()) }
    }
}

fn names<'a>(of: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut names: Vec<&str> = of.collect();
    names.sort_unstable();
    names.dedup();
    names
}
