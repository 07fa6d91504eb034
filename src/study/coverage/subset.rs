//! What is read: all poses of an instrument, or of a large grid some that are evenly spread over it; and with responsivities that are taken as
//! exactly known. Their stated uncertainty is the same in every run, and an interval that holds it covers whatever the samples do.

use std::sync::Arc;

use crate::scene::{Layout, Scene};

/// The scene with at most so many poses of each instrument, in the order that they had, and with responsivities without an uncertainty; and how
/// many poses each had before.
pub(super) fn subset(scene: &Scene, most_poses: usize) -> (Scene, Vec<usize>) {
    let mut scene = scene.clone();
    let before = scene.instruments.iter().map(|i| i.poses.len()).collect();
    for instrument in &mut scene.instruments {
        let all = instrument.poses.len();
        if all > most_poses {
            // The middle of each of the equal parts of the list.
            instrument.poses = (0..most_poses).map(|i| instrument.poses[(2 * i + 1) * all / (2 * most_poses)]).collect();
            instrument.layout = Layout::List;
        }
        if instrument.sensor.channels.iter().any(|channel| !channel.responsivity_uncertainty.is_empty()) {
            Arc::make_mut(&mut instrument.sensor).channels.iter_mut().for_each(|channel| channel.responsivity_uncertainty.clear());
        }
    }
    (scene, before)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::scene_from_text;

    #[test]
    fn a_grid_is_thinned_evenly_and_a_small_one_is_left_alone() {
        let scene = scene_from_text(
            r#"Scene(
                sources: [(name: "lamp", shape: Point, at: (0, 0, 2), strength: Candela(1), spectrum: "A")],
                instruments: [(name: "m", grid: (from: (0, 0, 0), to: (99, 0, 0), points: (100, 1)), facing: (0, 0, 1),
                    sensor: Sensor(aperture: Point, acceptance: Cosine,
                                   channels: [(name: "E", responsivity: "V", reads: Illuminance)]))])"#,
        )
        .expect("a scene");
        let (few, before) = subset(&scene, 4);
        assert_eq!(before, [100]);
        let at: Vec<f64> = few.instruments[0].poses.iter().map(|p| p.at.x).collect();
        assert_eq!(at, [12.0, 37.0, 62.0, 87.0]);
        let (all, _) = subset(&scene, 100);
        assert_eq!(all.instruments[0].poses.len(), 100);
        assert_eq!(all.instruments[0].layout, scene.instruments[0].layout);
    }

    #[test]
    fn what_a_certificate_states_is_left_out() {
        let scene = scene_from_text(
            r#"Scene(
                sources: [(name: "lamp", shape: Point, at: (0, 0, 2), strength: Candela(1), spectrum: "A")],
                instruments: [(name: "m", at: (0, 0, 0), facing: (0, 0, 1),
                    sensor: Sensor(aperture: Point, acceptance: Cosine,
                                   channels: [(name: "E", responsivity: "V", uncertainty_percent: 2, reads: Illuminance)]))])"#,
        )
        .expect("a scene");
        assert_eq!(scene.instruments[0].sensor.channels[0].responsivity_uncertainty.len(), 1);
        let (read, _) = subset(&scene, 1);
        assert!(read.instruments[0].sensor.channels[0].responsivity_uncertainty.is_empty());
    }
}
