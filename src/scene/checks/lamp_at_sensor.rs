//! A point source must not stand where a sensor is: `E = I cosθ / r²` has no value at r = 0.

use crate::scene::Scene;
use crate::scene::diagnostic::Problems;
use crate::scene::reader::Places;
use crate::source::Emitter;

/// Notes the first such pose of each instrument and source.
pub(super) fn check(scene: &Scene, places: &Places, problems: &mut Problems) {
    for (instrument, place) in scene.instruments.iter().zip(&places.instruments) {
        let poses = &instrument.poses;
        let (low, high) = instrument.bounds();
        for source in &scene.sources {
            let Emitter::Point { at } = source.emitter else { continue };
            // Large scenes: most lamps are outside the box of the poses.
            if at.clamp(low, high) != at {
                continue;
            }
            if let Some(index) = poses.iter().position(|pose| pose.at == at) {
                let which =
                    if poses.len() > 1 { format!("pose {index} of \"{}\"", instrument.name) } else { format!("\"{}\"", instrument.name) };
                let message = format!("{which} is at the very place of the point source \"{}\", where I/r² has no value", source.name);
                let help = "move one of them, or give the source a size, e.g. `shape: Sphere(0.01)`";
                place.problem_at(&place.title_span(), problems, message, help);
            }
        }
    }
}
