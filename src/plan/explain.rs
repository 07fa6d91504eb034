//! The plan in words: what is kept, narrowed, left out, not built, each with its reason.

use std::fmt::Write;

use super::{Bound, Method, Plan, Term, TermId, Transport, Visibility};
use crate::geometry::shape::Shape;
use crate::scene::Scene;

/// Most names that are written out in a row.
const NAMES: usize = 3;

impl Plan {
    /// The plan as text, one block an instrument.
    #[must_use]
    pub fn explain(&self, scene: &Scene) -> String {
        let mut text = String::new();
        // Writing to a string cannot fail.
        let _ = self.write(scene, &mut text);
        text
    }

    fn write(&self, scene: &Scene, out: &mut String) -> std::fmt::Result {
        let all = self.kept.len() + self.omitted.len();
        let how = if self.naive { "naive plan: every term by rays" } else { "plan" };
        writeln!(out, "{how}: {} of {all} terms kept", self.kept.len())?;
        if !self.without.is_empty() {
            writeln!(out, "switched off: {}", self.without.join(", "))?;
        }
        for (i, instrument) in scene.instruments.iter().enumerate() {
            let poses = match instrument.poses.len() {
                1 => String::new(),
                n => format!(", {n} poses"),
            };
            writeln!(out, "\ninstrument `{}`: {}{poses}", instrument.name, instrument.sensor.title)?;
            for (c, channel) in instrument.sensor.channels.iter().enumerate() {
                writeln!(out, "  channel `{}` reads {} in {}", channel.name, channel.reads.name(), channel.reads.unit())?;
                self.write_kept(scene, i, c, out)?;
                self.write_omitted(scene, i, c, out)?;
            }
            for n in self.narrowed.iter().filter(|n| n.instrument == i) {
                writeln!(out, "  narrowed   {:<24} {}", n.rule, n.what)?;
            }
            if let Some(s) = &self.spectral[i] {
                let what = match (s.wavelengths_nm.first(), s.wavelengths_nm.last()) {
                    (Some(_), Some(_)) if s.wavelengths_nm.len() == 1 => "one wavelength carries all: every reflectance is grey".to_owned(),
                    (Some(a), Some(b)) => {
                        format!("{} wavelengths from {a:.0} nm to {b:.0} nm, residual {:.1e}", s.wavelengths_nm.len(), s.residual)
                    }
                    _ => "no wavelength in common".to_owned(),
                };
                writeln!(out, "  spectrum   {what}")?;
            }
        }
        let mut not_built = Vec::new();
        if !self.needs_rays {
            not_built.push("rays, bounding volume hierarchy: no term that is kept needs a ray");
        } else if !scene.elements.iter().any(|e| matches!(e.shape, Shape::Mesh(_))) {
            not_built.push("bounding volume hierarchy: the scene has no mesh");
        }
        if !self.kept.iter().any(|t| t.method == Method::Paths) {
            not_built.push("paths, spectral nodes: no reflected light is sampled");
        }
        for (k, what) in not_built.iter().enumerate() {
            writeln!(out, "{}{what}", if k == 0 { "\nnot built  " } else { "           " })?;
        }
        Ok(())
    }

    fn write_kept(&self, scene: &Scene, instrument: usize, channel: usize, out: &mut String) -> std::fmt::Result {
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
        for (term, sources) in groups {
            let sight = match (term.id.transport, term.visibility, term.method) {
                (Transport::Reflected, _, _) => "",
                (_, Visibility::Clear, _) => ", nothing can block",
                (_, Visibility::Tested, _) => ", shadow rays",
            };
            writeln!(out, "    kept     {:<9}  {:<32}  {}{sight}", transport(&term.id), names(scene, &sources), term.method.words())?;
        }
        Ok(())
    }

    fn write_omitted(&self, scene: &Scene, instrument: usize, channel: usize, out: &mut String) -> std::fmt::Result {
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
        for (o, sources) in groups {
            let bound = match o.bound {
                Bound::Zero => "zero".to_owned(),
                Bound::AtMost(most) => format!("at most {most:.2e}"),
            };
            let (who, rule, reason) = (names(scene, &sources), o.rule, &o.reason);
            writeln!(out, "    left out {:<9}  {who:<32}  {bound}: {reason} ({rule})", transport(&o.id))?;
        }
        Ok(())
    }
}

fn transport(id: &TermId) -> &'static str {
    match id.transport {
        Transport::Direct => "direct",
        Transport::Reflected => "reflected",
    }
}

fn names(scene: &Scene, sources: &[usize]) -> String {
    let named: Vec<String> = sources.iter().take(NAMES).map(|&s| format!("`{}`", scene.sources[s].name)).collect();
    match sources.len().saturating_sub(NAMES) {
        0 => named.join(", "),
        more => format!("{} and {more} more", named.join(", ")),
    }
}
