//! From values with their places to fields, numbers, vectors and names; each problem is noted and reading goes on.
//!
//! A decoder answers `None` when it has noted a problem, so that `?` skips what depends on it.

use std::ops::Range;

use super::diagnostic::{Diagnostic, Problems};
use super::document::{Body, Document, Field, Kind, Node};
use crate::math::DVec3;
use crate::naming::{nearest, suggestion};

/// Largest and smallest length that is taken for a length, m.
pub(super) const LARGEST_M: f64 = 1e33;
/// See [`LARGEST_M`].
pub(super) const SMALLEST_M: f64 = 1e-33;

/// A number for a message: with an exponent where it would have many zeros.
pub(super) fn readable(x: f64) -> String {
    if x == 0.0 || !x.is_finite() || (1e-5..1e16).contains(&x.abs()) { format!("{x}") } else { format!("{x:e}") }
}

/// A value, the document it belongs to, and its path in it.
#[derive(Clone, Debug)]
pub(super) struct Value<'d> {
    pub(super) document: &'d Document,
    pub(super) node: &'d Node,
    pub(super) path: String,
}

impl<'d> Value<'d> {
    pub(super) fn root(document: &'d Document) -> Self {
        Self { document, node: &document.root, path: String::new() }
    }

    pub(super) fn child(&self, node: &'d Node, step: &str) -> Value<'d> {
        let dot = if self.path.is_empty() || step.starts_with('[') { "" } else { "." };
        Value { document: self.document, node, path: format!("{}{dot}{step}", self.path) }
    }

    /// A problem of this value.
    pub(super) fn problem(&self, problems: &mut Problems, message: impl Into<String>, help: impl Into<String>) {
        self.problem_at(&self.node.span, problems, message, help);
    }

    /// A problem of a part of this value.
    pub(super) fn problem_at(&self, span: &Range<usize>, problems: &mut Problems, message: impl Into<String>, help: impl Into<String>) {
        if problems.is_full() {
            problems.skip();
            return;
        }
        let help: String = help.into();
        problems.add(Diagnostic::at(self.document, span, &self.path, message, (!help.is_empty()).then_some(help)));
    }

    /// The name in front of the brackets; empty if there is none or the value is not a struct.
    pub(super) fn name(&self) -> &'d str {
        match &self.node.kind {
            Kind::Struct { name, .. } => name,
            _ => "",
        }
    }

    /// Bytes of the name in front of the brackets.
    pub(super) fn name_span(&self) -> Range<usize> {
        let name = self.name();
        if name.is_empty() { self.node.span.clone() } else { self.node.span.start..self.node.span.start + name.len() }
    }

    /// What the value is, for messages.
    pub(super) fn described(&self) -> String {
        match &self.node.kind {
            Kind::Number(x) => format!("the number {}", readable(*x)),
            Kind::Text(text) => format!("the text \"{}\"", text.chars().take(40).collect::<String>()),
            Kind::Bool(x) => format!("`{x}`"),
            Kind::List(_) => "a list […]".into(),
            Kind::Map(_) => "a map {…}".into(),
            Kind::Struct { name, body: Body::None } => format!("`{name}`"),
            Kind::Struct { name, .. } => format!("`{name}(…)`"),
        }
    }

    /// The name of the variant, if it is one of `allowed`.
    pub(super) fn variant(&self, what: &str, allowed: &[&str], problems: &mut Problems) -> Option<&'d str> {
        let name = self.name();
        if allowed.contains(&name) {
            return Some(name);
        }
        let help = match &self.node.kind {
            // A name in quotes where the bare name belongs.
            Kind::Text(text) if nearest(text, allowed.iter().copied()).is_some() => {
                format!("{}; write it without quotes", suggestion(text, allowed))
            }
            _ => suggestion(name, allowed),
        };
        if name.is_empty() {
            let found = self.described();
            self.problem(problems, format!("{what} is expected, not {found}"), help);
        } else {
            self.problem_at(&self.name_span(), problems, format!("`{name}` is not {what}"), help);
        }
        None
    }

    /// Notes a problem unless nothing follows the name of the variant.
    pub(super) fn without_brackets(&self, problems: &mut Problems) -> Option<()> {
        match &self.node.kind {
            Kind::Struct { body: Body::None, .. } => Some(()),
            _ => {
                self.problem(problems, format!("`{}` takes nothing in brackets", self.name()), format!("write `{}`", self.name()));
                None
            }
        }
    }

    /// The values in the brackets of a variant; `form` shows how it is written, such as `Disc(radius)`.
    pub(super) fn positional(&self, count: usize, form: &str, problems: &mut Problems) -> Option<Vec<Value<'d>>> {
        match &self.node.kind {
            Kind::Struct { body: Body::Positional(items), .. } if items.len() == count => {
                let name = self.name();
                let step = |i: usize| if count == 1 { name.to_string() } else { format!("{name}[{i}]") };
                Some(items.iter().enumerate().map(|(i, node)| self.child(node, &step(i))).collect())
            }
            Kind::Struct { name, body } => {
                let found = match body {
                    Body::None => "nothing follows it".to_string(),
                    Body::Positional(items) => format!("{} are given", items.len()),
                    Body::Named(_) => "they are given with keys".to_string(),
                };
                let plural = if count == 1 { "value" } else { "values" };
                self.problem(
                    problems,
                    format!("`{name}` needs {count} {plural} in brackets, without keys; {found}"),
                    format!("write `{form}`"),
                );
                None
            }
            _ => {
                let found = self.described();
                self.problem(problems, format!("{found} where `{form}` is expected"), "");
                None
            }
        }
    }

    /// A finite number.
    pub(super) fn number(&self, problems: &mut Problems) -> Option<f64> {
        match &self.node.kind {
            Kind::Number(x) if x.is_finite() => Some(*x),
            Kind::Number(x) => {
                let found = if x.is_nan() { "NaN" } else { "an infinite one" };
                self.problem(problems, format!("a finite number is expected, not {found}"), "write a number between -1e308 and 1e308");
                None
            }
            _ => {
                let found = self.described();
                self.problem(problems, format!("a number is expected, not {found}"), "");
                None
            }
        }
    }

    /// A finite number within limits, given in words as well.
    pub(super) fn number_in(&self, what: &str, allowed: &str, holds: impl Fn(f64) -> bool, problems: &mut Problems) -> Option<f64> {
        let x = self.number(problems)?;
        if holds(x) {
            return Some(x);
        }
        self.problem(problems, format!("{what} is {}", readable(x)), format!("allowed: {allowed}"));
        None
    }

    /// A length above zero; `unit_m` is its unit in metres.
    pub(super) fn length_m(&self, what: &str, unit_m: f64, problems: &mut Problems) -> Option<f64> {
        let x = self.number_in(what, "above 0", |x| x > 0.0, problems)? * unit_m;
        if (SMALLEST_M..=LARGEST_M).contains(&x) {
            return Some(x);
        }
        self.problem(problems, format!("{what} is {x:e} m, which is absurd"), format!("allowed: {SMALLEST_M:e} m to {LARGEST_M:e} m"));
        None
    }

    /// Three finite numbers.
    pub(super) fn vector(&self, problems: &mut Problems) -> Option<DVec3> {
        if let Kind::Struct { name, body: Body::Positional(items) } = &self.node.kind
            && name.is_empty()
            && items.len() == 3
        {
            let mut all = items.iter().enumerate().map(|(i, node)| self.child(node, ["x", "y", "z"][i]).number(problems));
            let (x, y, z) = (all.next()?, all.next()?, all.next()?);
            return Some(DVec3::new(x?, y?, z?));
        }
        let found = match &self.node.kind {
            Kind::Struct { name, body: Body::Positional(items) } if name.is_empty() => format!("{} numbers", items.len()),
            Kind::List(_) => "a list […]; vectors are written in round brackets".into(),
            _ => self.described(),
        };
        self.problem(problems, format!("a vector is expected, not {found}"), "write `(x, y, z)`");
        None
    }

    /// A point in space, m.
    pub(super) fn point_m(&self, problems: &mut Problems) -> Option<DVec3> {
        let point = self.vector(problems)?;
        if point.abs().max_element() <= LARGEST_M {
            return Some(point);
        }
        self.problem(
            problems,
            "the point lies absurdly far away",
            format!("allowed: coordinates from {:e} m to {LARGEST_M:e} m", -LARGEST_M),
        );
        None
    }

    /// A unit vector along a vector that is not zero.
    pub(super) fn direction(&self, problems: &mut Problems) -> Option<DVec3> {
        let v = self.vector(problems)?;
        if let Some(unit) = normalised(v) {
            return Some(unit);
        }
        self.problem(
            problems,
            "the vector is zero, so it has no direction",
            "write the direction, of any length but zero, such as `(0, 0, 1)`",
        );
        None
    }

    /// A text.
    pub(super) fn text(&self, problems: &mut Problems) -> Option<&'d str> {
        if let Kind::Text(text) = &self.node.kind {
            return Some(text);
        }
        let found = self.described();
        self.problem(problems, format!("a text is expected, not {found}"), "write it in double quotes: \"…\"");
        None
    }

    /// The items of a list.
    pub(super) fn list(&self, what: &str, problems: &mut Problems) -> Option<Vec<Value<'d>>> {
        if let Kind::List(items) = &self.node.kind {
            return Some(items.iter().enumerate().map(|(i, node)| self.child(node, &format!("[{i}]"))).collect());
        }
        let found = self.described();
        self.problem(problems, format!("{what} are written as a list, not {found}"), "write `[ …, … ]`");
        None
    }

    /// Opens a struct with keys. Unknown and repeated keys are noted; `what` names it in messages.
    pub(super) fn fields(&self, what: &str, allowed: &[&str], problems: &mut Problems) -> Option<Fields<'d>> {
        let fields: &'d [Field] = match &self.node.kind {
            Kind::Struct { body: Body::Named(fields), .. } => fields,
            Kind::Struct { body: Body::Positional(items), .. } if items.is_empty() => &[],
            Kind::Struct { name, .. } => {
                let keys: Vec<String> = allowed.iter().map(|key| format!("{key}: …")).collect();
                self.problem(problems, format!("the values of {what} are given with keys"), format!("write `{name}({})`", keys.join(", ")));
                return None;
            }
            _ => {
                let found = self.described();
                let keys: Vec<String> = allowed.iter().map(|key| format!("{key}: …")).collect();
                self.problem(problems, format!("{what} is expected, not {found}"), format!("write `({})`", keys.join(", ")));
                return None;
            }
        };
        for (i, field) in fields.iter().enumerate() {
            if !allowed.contains(&field.name.as_str()) {
                let help = suggestion(&field.name, allowed);
                self.problem_at(&field.name_span, problems, format!("unknown key `{}` in {what}", field.name), help);
            } else if fields[..i].iter().any(|earlier| earlier.name == field.name) {
                self.problem_at(
                    &field.name_span,
                    problems,
                    format!("the key `{}` is given twice in {what}", field.name),
                    "keep one of them",
                );
            }
        }
        // A key that was probably meant is not called missing as well.
        let meant = fields
            .iter()
            .filter(|field| !allowed.contains(&field.name.as_str()))
            .filter_map(|field| nearest(&field.name, allowed.iter().copied()));
        let meant = meant.map(str::to_string).collect();
        Some(Fields { owner: self.clone(), what: what.into(), fields, meant })
    }

    /// Bytes of the value of `name`, by which a whole item is pointed at; of the item if it has none.
    pub(super) fn title_span(&self) -> Range<usize> {
        let Kind::Struct { body: Body::Named(fields), .. } = &self.node.kind else { return self.node.span.clone() };
        fields.iter().find(|field| field.name == "name").map_or(self.node.span.clone(), |field| field.value.span.clone())
    }
}

/// The fields of a struct with keys.
#[derive(Clone, Debug)]
pub(super) struct Fields<'d> {
    pub(super) owner: Value<'d>,
    what: String,
    fields: &'d [Field],
    /// Keys that unknown ones were probably meant to be.
    meant: Vec<String>,
}

impl<'d> Fields<'d> {
    /// The value of a key, if it is given.
    pub(super) fn get(&self, key: &str) -> Option<Value<'d>> {
        self.fields.iter().find(|field| field.name == key).map(|field| self.owner.child(&field.value, key))
    }

    /// Where a key stands.
    pub(super) fn key_span(&self, key: &str) -> Range<usize> {
        self.fields.iter().find(|field| field.name == key).map_or(self.owner.node.span.clone(), |field| field.name_span.clone())
    }

    /// The value of a key that must be given; `example` shows how it is written.
    pub(super) fn require(&self, key: &str, example: &str, problems: &mut Problems) -> Option<Value<'d>> {
        let value = self.get(key);
        if value.is_none() && !self.meant.iter().any(|meant| meant == key) {
            let span = self.owner.name_span();
            let span = if self.owner.name().is_empty() { span.start..span.start + 1 } else { span };
            self.owner.problem_at(&span, problems, format!("{} has no `{key}`", self.what), format!("add `{key}: {example}`"));
        }
        value
    }

    /// Notes a problem for each of these keys that is given.
    pub(super) fn refuse(&self, keys: &[&str], why: &str, problems: &mut Problems) {
        for key in keys {
            if self.get(key).is_some() {
                self.owner.problem_at(
                    &self.key_span(key),
                    problems,
                    format!("the key `{key}` has no meaning here: {why}"),
                    format!("leave `{key}` out"),
                );
            }
        }
    }
}

/// A unit vector; none along the zero vector. Lengths from 1e-300 to 1e300 neither underflow nor overflow.
pub(super) fn normalised(v: DVec3) -> Option<DVec3> {
    let largest = v.abs().max_element();
    if !(largest > 0.0 && largest.is_finite()) {
        return None;
    }
    let scaled = v / largest;
    // A vector along an axis stays exact.
    Some(scaled / scaled.length())
}
