//! The plan of a camera in words.

use std::fmt::Write;

use super::{CameraPlan, FirstReflection, RULES};
use crate::scene::{PlacedCamera, Scene};
use crate::source::Emitter;

impl CameraPlan {
    /// Appends the plan of a camera.
    pub(in crate::plan) fn write(&self, scene: &Scene, placed: &PlacedCamera, out: &mut String) -> std::fmt::Result {
        let camera = &placed.camera;
        let size = format!("{} × {} pixels", camera.columns, camera.rows);
        writeln!(out, "\ncamera `{}`: {}, {size}", placed.name, camera.title)?;
        writeln!(out, "  rays through the pupil find what each pixel sees; V(λ) is carried beside its channels")?;
        for (source, first) in scene.sources.iter().zip(&self.first) {
            let seen = match source.emitter {
                Emitter::Point { .. } | Emitter::Directional { .. } => "imaged through the pupil",
                Emitter::Area { .. } => "seen where a ray meets it",
                Emitter::Environment => "seen where a ray meets nothing",
            };
            let first = match first {
                FirstReflection::Formula => format!("by its formula, {} ({})", RULES[0].1, RULES[0].0),
                FirstReflection::Sampled if matches!(source.emitter, Emitter::Environment) => "sample the sky".to_owned(),
                FirstReflection::Sampled => "one connection for each ray, shadow rays".to_owned(),
                FirstReflection::Nothing => "left out, zero: no surface reflects it at a wavelength that counts".to_owned(),
            };
            writeln!(out, "    `{}`  itself: {seen};  first reflection: {first}", source.name)?;
        }
        match (&self.spectral, self.interreflection) {
            (None, _) => writeln!(out, "    left out  further reflections  zero: nothing is reflected"),
            (Some(_), false) => writeln!(out, "    left out  further reflections  zero: {} ({})", RULES[1].1, RULES[1].0),
            (Some(s), true) => {
                let (nodes, plural) = (s.wavelengths_nm.len(), if s.wavelengths_nm.len() == 1 { "" } else { "s" });
                writeln!(out, "    kept      further reflections  paths with next-event estimation, {nodes} wavelength{plural}")
            }
        }
    }
}
