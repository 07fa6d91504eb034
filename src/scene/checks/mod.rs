//! Checks of a scene as a whole: what each part alone cannot show. One check a file.

mod coincident_emitters;
mod lamp_at_sensor;
mod perfect_enclosure;
mod sensor_on_emitter;
#[cfg(test)]
mod tests;

use super::Scene;
use super::diagnostic::Problems;
use super::reader::Places;

/// Lengths that differ by less than this share of the sizes concerned count as equal.
const SAME: f64 = 1e-9;

/// Runs every check. Parts of the scene that had problems are not in it; the checks take what there is.
pub(super) fn run(scene: &Scene, places: &Places, problems: &mut Problems) {
    coincident_emitters::check(scene, places, problems);
    sensor_on_emitter::check(scene, places, problems);
    lamp_at_sensor::check(scene, places, problems);
    perfect_enclosure::check(scene, places, problems);
}
