//! The plan in words: what is kept, narrowed, left out, not built, each with its reason.

use std::fmt::Write;

use super::{Bound, CameraPlan, Method, Plan, Term, TermId, Transport};
use crate::geometry::shape::Shape;
use crate::metrology::rounding::format_significant;
use crate::scene::Scene;

/// Most names that are written out in a row.
const NAMES: usize = 3;

impl Plan {
    /// The plan as text, one block an instrument; neighbours with the same plan share one.
    #[must_use]
    pub fn explain(&self, scene: &Scene) -> String {
        let mut text = String::new();
        // Writing to a string cannot fail.
        let _ = self.write(scene, &mut text);
        text
    }

    fn write(&self, scene: &Scene, out: &mut String) -> std::fmt::Result {
        let all = self.kept.len() + self.omitted.len();
        let (how, kept) = (if self.naive { "naive plan" } else { "plan" }, self.kept.len());
        if all > 0 || scene.cameras.is_empty() {
            writeln!(out, "{how}: {kept} of {all} terms kept (instrument channel × source × direct or reflected)")?;
        } else {
            writeln!(out, "{how}: the scene has cameras and no instrument")?;
        }
        if !self.without.is_empty() {
            writeln!(out, "switched off: {}", self.without.join(", "))?;
        }
        let mut blocks: Vec<(Vec<String>, String, String)> = Vec::new();
        for (i, instrument) in scene.instruments.iter().enumerate() {
            let poses = match instrument.poses.len() {
                1 => String::new(),
                n => format!(" in {n} poses"),
            };
            let (name, mut body) = (format!("`{}`{poses}", instrument.name), String::new());
            self.write_instrument(scene, i, &mut body)?;
            match blocks.last_mut() {
                Some((names, sensor, same)) if *sensor == instrument.sensor.title && *same == body => names.push(name),
                _ => blocks.push((vec![name], instrument.sensor.title.clone(), body)),
            }
        }
        for (named, sensor, body) in blocks {
            let s = if named.len() == 1 { "" } else { "s" };
            write!(out, "\ninstrument{s} {}: {sensor}\n{body}", listed(&named))?;
        }
        for (plan, placed) in self.cameras.iter().zip(&scene.cameras) {
            plan.write(scene, placed, out)?;
        }
        let mut not_built = Vec::new();
        if !self.needs_rays && scene.cameras.is_empty() {
            not_built.push("rays, bounding volume hierarchy: no term that is kept needs a ray");
        } else if !scene.elements.iter().any(|e| matches!(e.shape, Shape::Mesh(_))) {
            not_built.push("bounding volume hierarchy: the scene has no mesh");
        }
        if !self.kept.iter().any(|t| t.method == Method::Paths) && !self.cameras.iter().any(CameraPlan::needs_paths) {
            not_built.push("paths, spectral nodes: no reflected light is sampled");
        }
        for (k, what) in not_built.iter().enumerate() {
            writeln!(out, "{}{what}", if k == 0 { "\nnot built  " } else { "           " })?;
        }
        Ok(())
    }

    fn write_instrument(&self, scene: &Scene, instrument: usize, out: &mut String) -> std::fmt::Result {
        for (c, channel) in scene.instruments[instrument].sensor.channels.iter().enumerate() {
            let unit = channel.reads.unit();
            let kind = if channel.kind.is_absolute() { format!("; {}", channel.kind.words()) } else { String::new() };
            writeln!(out, "  channel `{}` reads {} in {unit}{kind}", channel.name, channel.reads.name())?;
            let rows: Vec<Row> = [self.kept_rows(scene, instrument, c), self.omitted_rows(scene, instrument, c, unit)].concat();
            let width = rows.iter().map(|r| r.sources.chars().count()).max().unwrap_or(0);
            for Row { verb, transport, sources, what } in rows {
                writeln!(out, "    {verb:<8}  {transport:<9}  {sources:<width$}  {what}")?;
            }
        }
        let mine = |method: Method| self.kept.iter().any(|t| t.id.instrument() == instrument && t.method == method);
        for n in self.narrowed.iter().filter(|n| n.instrument == instrument) {
            // A formula that was chosen afterwards leaves no connection to speak of.
            if n.rule != "delta_source" || mine(Method::Connection) {
                writeln!(out, "  {:<8}  {} ({})", "narrowed", n.what, n.rule)?;
            }
        }
        if let (Some(s), true) = (&self.spectral[instrument], mine(Method::Paths)) {
            let nodes = s.wavelengths_nm.len();
            let what = match (s.wavelengths_nm.first(), s.wavelengths_nm.last()) {
                (Some(_), Some(_)) if nodes == 1 => {
                    "one wavelength carries all: every reflectance is the same at all wavelengths that count".to_owned()
                }
                (Some(a), Some(b)) => {
                    let share = format_significant(100.0 * s.residual, 2);
                    format!("{nodes} wavelengths from {a:.0} nm to {b:.0} nm; what lies between may change reflected light by {share} %")
                }
                _ => "no wavelength in common".to_owned(),
            };
            writeln!(out, "  {:<8}  {what}", "spectrum")?;
        }
        Ok(())
    }

    fn kept_rows(&self, scene: &Scene, instrument: usize, channel: usize) -> Vec<Row> {
        let mine = |t: &&Term| t.id.instrument() == instrument && t.id.channel() == channel;
        let mut groups: Vec<(Term, Vec<usize>)> = Vec::new();
        for term in self.kept.iter().filter(mine) {
            let same = |(t, _): &&mut (Term, Vec<usize>)| {
                t.id.transport == term.id.transport && t.method == term.method && t.visibility == term.visibility
            };
            match groups.iter_mut().find(same) {
                Some((_, sources)) => sources.push(term.id.source()),
                None => groups.push((*term, vec![term.id.source()])),
            }
        }
        let row = |(term, sources): (Term, Vec<usize>)| {
            let method = match term.method.rule() {
                Some(rule) => format!("{} ({rule})", term.method.words()),
                None => term.method.words().to_owned(),
            };
            let sight = match (term.id.transport, term.visibility.rule()) {
                (Transport::Reflected, _) => String::new(),
                (Transport::Direct, Some(rule)) => format!(", nothing can block ({rule})"),
                (Transport::Direct, None) => ", shadow rays".to_owned(),
            };
            Row { verb: "kept", transport: transport(&term.id), sources: names(scene, &sources), what: format!("{method}{sight}") }
        };
        groups.into_iter().map(row).collect()
    }

    fn omitted_rows(&self, scene: &Scene, instrument: usize, channel: usize, unit: &str) -> Vec<Row> {
        let mut groups: Vec<(&super::Omission, Vec<usize>)> = Vec::new();
        for o in self.omitted.iter().filter(|o| o.id.instrument() == instrument && o.id.channel() == channel) {
            let same = |(g, _): &&mut (&super::Omission, Vec<usize>)| {
                g.id.transport == o.id.transport && g.rule == o.rule && g.reason == o.reason && g.bound == o.bound
            };
            // Neighbours share their reason; only the last few groups can match.
            match groups.iter_mut().rev().take(8).find(same) {
                Some((_, sources)) => sources.push(o.id.source()),
                None => groups.push((o, vec![o.id.source()])),
            }
        }
        groups.sort_by_key(|(o, _)| o.id.transport);
        let row = |(o, sources): (&super::Omission, Vec<usize>)| {
            let bound = match o.bound {
                Bound::Zero => "zero".to_owned(),
                Bound::AtMost(most) => format!("at most {} {unit}", format_significant(most, 2)),
            };
            let what = format!("{bound}: {} ({})", o.reason, o.rule);
            Row { verb: "left out", transport: transport(&o.id), sources: names(scene, &sources), what }
        };
        groups.into_iter().map(row).collect()
    }
}

/// A line about terms.
#[derive(Clone)]
struct Row {
    verb: &'static str,
    transport: &'static str,
    sources: String,
    what: String,
}

fn transport(id: &TermId) -> &'static str {
    match id.transport {
        Transport::Direct => "direct",
        Transport::Reflected => "reflected",
    }
}

fn names(scene: &Scene, sources: &[usize]) -> String {
    let named: Vec<String> = sources.iter().map(|&s| format!("`{}`", scene.sources[s].name)).collect();
    listed(&named)
}

/// The first names of a row, and how many more there are.
fn listed(names: &[String]) -> String {
    let first = names.iter().take(NAMES).cloned().collect::<Vec<_>>().join(", ");
    match names.len().saturating_sub(NAMES) {
        0 => first,
        more => format!("{first} and {more} more"),
    }
}
