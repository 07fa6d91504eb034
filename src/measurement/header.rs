//! The header of a checkpoint: whose pieces of work it holds, a line a fact.
//!
//! ```text
//! version: 0.1.0
//! scene: scenes/office.ron
//! scene_hash: 0123456789abcdef
//! …
//! shard: 2/3
//! ```
//!
//! Lines end in line breaks; a line break or a backslash in a name is written `\n` or `\\`.

use std::fmt::Write as _;

use super::{Difference, Provenance};
use crate::estimate::journal::Share;

/// Whose pieces of work a checkpoint holds.
#[derive(Clone, Debug, PartialEq)]
pub struct CheckpointHeader {
    /// The run.
    pub provenance: Provenance,
    /// Which of its pieces.
    pub share: Share,
}

impl CheckpointHeader {
    /// The header in words.
    #[must_use]
    pub fn to_text(&self) -> String {
        let p = &self.provenance;
        let mut text = String::new();
        let mut line = |key: &str, value: String| {
            let _ = writeln!(text, "{key}: {value}");
        };
        line("version", escaped(&p.version));
        line("scene", escaped(&p.scene_file));
        p.root.iter().for_each(|root| line("root", escaped(root)));
        line("scene_hash", format!("{:016x}", p.scene_hash));
        line("plan_hash", format!("{:016x}", p.plan_hash));
        line("seed", p.seed.to_string());
        // Digits that read back as the same number.
        p.stop.target.iter().for_each(|x| line("target", format!("{x:?}")));
        p.stop.budget_seconds.iter().for_each(|x| line("budget_seconds", format!("{x:?}")));
        p.stop.samples.iter().for_each(|n| line("samples", n.to_string()));
        line("naive", p.naive.to_string());
        p.without.iter().for_each(|rule| line("without", escaped(rule)));
        line("shard", format!("{}/{}", self.share.number, self.share.of));
        text
    }

    /// Reads a header back.
    ///
    /// # Errors
    /// The line that cannot be understood, or the key that is missing.
    pub fn from_text(text: &str) -> Result<CheckpointHeader, String> {
        let mut p = Provenance::default();
        p.stop.target = None;
        let mut share = None;
        let mut seen: Vec<&str> = Vec::new();
        for line in text.lines() {
            let (key, value) = line.split_once(": ").ok_or_else(|| format!("`{line}` is no `key: value`"))?;
            let wrong = || format!("`{line}` is not understood");
            if key != "without" && seen.contains(&key) {
                return Err(format!("`{key}` stands twice"));
            }
            seen.push(key);
            let hash = || u64::from_str_radix(value, 16).map_err(|_| wrong());
            let number = || value.parse::<u64>().map_err(|_| wrong());
            let real = || value.parse::<f64>().ok().filter(|x| *x > 0.0 && x.is_finite()).ok_or_else(wrong);
            match key {
                "version" => p.version = unescaped(value),
                "scene" => p.scene_file = unescaped(value),
                "root" => p.root = Some(unescaped(value)),
                "scene_hash" => p.scene_hash = hash()?,
                "plan_hash" => p.plan_hash = hash()?,
                "seed" => p.seed = number()?,
                "target" => p.stop.target = Some(real()?),
                "budget_seconds" => p.stop.budget_seconds = Some(real()?),
                "samples" => p.stop.samples = Some(number()?),
                "naive" => p.naive = value.parse().map_err(|_| wrong())?,
                "without" => p.without.push(unescaped(value)),
                "shard" => {
                    let numbers = value.split_once('/').and_then(|(k, n)| Some((k.parse().ok()?, n.parse().ok()?)));
                    share = numbers.and_then(|(k, n)| Share::new(k, n));
                    share.ok_or_else(wrong)?;
                }
                _ => return Err(wrong()),
            }
        }
        for key in ["version", "scene", "scene_hash", "plan_hash", "seed", "naive"] {
            if !seen.contains(&key) {
                return Err(format!("it has no `{key}`"));
            }
        }
        Ok(CheckpointHeader { provenance: p, share: share.ok_or("it has no `shard`")? })
    }

    /// What keeps pieces recorded there from serving here.
    #[must_use]
    pub fn differences(&self, there: &CheckpointHeader) -> Vec<Difference> {
        let mut found = self.provenance.differences(&there.provenance);
        if self.share != there.share {
            let [here, there] = [self.share, there.share].map(|s| format!("{}/{}", s.number, s.of));
            found.push(Difference { what: "shard", here, there });
        }
        found
    }
}

fn escaped(name: &str) -> String {
    name.replace('\\', "\\\\").replace('\n', "\\n").replace('\r', "\\r")
}

fn unescaped(name: &str) -> String {
    let mut text = String::with_capacity(name.len());
    let mut characters = name.chars();
    while let Some(c) = characters.next() {
        match c {
            '\\' => match characters.next() {
                Some('n') => text.push('\n'),
                Some('r') => text.push('\r'),
                Some(other) => text.push(other),
                None => text.push('\\'),
            },
            c => text.push(c),
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::estimate::Stop;

    proptest! {
        #[test]
        fn a_header_reads_back_as_it_was_written(
            scene_file in ".*", root in proptest::option::of(".*"), rules in proptest::collection::vec("[a-z -]*", 0..3),
            numbers in any::<[u64; 3]>(), target in proptest::option::of(f64::MIN_POSITIVE..1e300),
            samples in proptest::option::of(any::<u64>()), naive in any::<bool>(), (number, of) in (1u32..9).prop_flat_map(|of| (1..=of, Just(of))),
        ) {
            let [scene_hash, plan_hash, seed] = numbers;
            let provenance = Provenance {
                version: "1.2.3".to_owned(), scene_file, root, scene_hash, plan_hash, naive, without: rules, seed,
                stop: Stop { target, budget_seconds: None, samples }, rounds: Vec::new(),
            };
            let header = CheckpointHeader { provenance, share: Share { number, of } };
            prop_assert_eq!(CheckpointHeader::from_text(&header.to_text()), Ok(header));
        }

        #[test]
        fn no_text_makes_it_panic(text in "((version|scene|seed|shard|target|naive): .{0,8}\n|.{0,20}\n){0,12}") {
            let _ = CheckpointHeader::from_text(&text);
        }
    }
}
