//! Irradiance of a polygon with uniform radiance, fast where it is easy.
//!
//! ```text
//! E/L = ½ Σ n·(a × b)/|a × b| atan2(|a × b|, a·b)       over the edges a → b as seen from the receiver (Lambert)
//! ```
//!
//! Easy are polygons wholly above the horizon of a receiver in front of them, whose sum does not cancel. All other cases, and all other
//! shapes, are for [`at_point`].

use crate::estimate::deterministic::at_point;
use crate::geometry::shape::Side;
use crate::math::DVec3;
use crate::math::frame::tangents;
use crate::scene::{Pose, Scene};
use crate::sensor::Acceptance;
use crate::source::{Emitter, Source};

/// The sum is taken if it is more than this share of its terms: rounding stays below 1e-12 of it.
const LEAST_SHARE: f64 = 1e-3;
/// Most corners of a polygon that is treated here.
const MOST_CORNERS: usize = 8;

/// A source as it irradiates points of surfaces.
pub(super) struct Irradiance<'a> {
    scene: &'a Scene,
    source: &'a Source,
    /// Corners counter-clockwise as seen from the lit side, and the normal of that side; none if some piece is no small polygon.
    polygons: Option<Vec<(Vec<DVec3>, DVec3)>>,
}

impl<'a> Irradiance<'a> {
    pub(super) fn of(scene: &'a Scene, source: &'a Source) -> Irradiance<'a> {
        let piece = |&(element, side): &(usize, Side)| {
            let shape = &scene.elements[element].shape;
            let mut corners = shape.corners().filter(|c| c.len() <= MOST_CORNERS)?;
            if side == Side::Back {
                corners.reverse();
            }
            Some((corners, side.sign() * shape.plane()?.1))
        };
        let polygons = match &source.emitter {
            Emitter::Area { elements } => elements.iter().map(piece).collect(),
            _ => None,
        };
        Irradiance { scene, source, polygons }
    }

    /// Irradiance at a point of a surface with this unit normal, per unit of the source's density.
    #[inline(always)]
    pub(super) fn at(&self, point: DVec3, normal: DVec3) -> f64 {
        if let Some(polygons) = &self.polygons {
            let mut sum = 0.0;
            let easy = polygons.iter().all(|(corners, front)| match lambert(corners, *front, point, normal) {
                Some(part) => {
                    sum += part;
                    true
                }
                None => false,
            });
            if easy {
                return sum;
            }
        }
        let pose = Pose { at: point, normal, x_axis: tangents(normal).0 };
        at_point(self.scene, &Acceptance::Cosine, &pose, point, self.source).value
    }
}

/// One polygon; `None` where the general formula has to be asked.
#[inline(always)]
fn lambert(corners: &[DVec3], front: DVec3, point: DVec3, normal: DVec3) -> Option<f64> {
    let mut to = [DVec3::ZERO; MOST_CORNERS];
    let (mut lowest, mut highest) = (f64::INFINITY, f64::NEG_INFINITY);
    for (to, corner) in to.iter_mut().zip(corners) {
        *to = *corner - point;
        let height = normal.dot(*to);
        lowest = lowest.min(height);
        highest = highest.max(height);
    }
    if highest < 0.0 {
        return Some(0.0);
    }
    if lowest <= 0.0 || front.dot(to[0]) >= 0.0 {
        return None;
    }
    let n = corners.len();
    let (mut sum, mut size) = (0.0, 0.0);
    for i in 0..n {
        let (a, b) = (to[i], to[if i + 1 == n { 0 } else { i + 1 }]);
        let cross = a.cross(b);
        let length = cross.length();
        let term = cross.dot(normal) / length * length.atan2(a.dot(b));
        sum += term;
        size += term.abs();
    }
    // Seen from the receiver the corners run clockwise: the lit side shows them counter-clockwise.
    let value = -0.5 * sum;
    (value > LEAST_SHARE * size).then_some(value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::scene_from_text;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn fast_and_general_formulas_agree(
            x in -3.0..3.0_f64, y in -3.0..3.0_f64, z in -3.0..3.0_f64, tilt in (-1.0..1.0_f64, -1.0..1.0_f64), both in any::<bool>(),
        ) {
            let side = if both { "Inside" } else { "Outside" };
            let scene = scene_from_text(&format!(
                "Scene(sources: [(name: \"s\", shape: Polygon([(0, 0, 2), (1, 0, 2), (1.2, 0.7, 2), (0, 1, 2)]), seen_from: {side}, strength: Radiance(1),
                    spectrum: Line(555))],
                instruments: [(name: \"m\", at: (9, 9, 0), facing: (0, 0, 1),
                    sensor: Sensor(aperture: Point, acceptance: Cosine, channels: [(name: \"E\", responsivity: 1, reads: Irradiance)]))])"
            )).unwrap();
            let normal = DVec3::new(tilt.0, tilt.1, 1.0).normalize();
            let point = DVec3::new(x, y, z);
            let pose = Pose { at: point, normal, x_axis: tangents(normal).0 };
            let exact = at_point(&scene, &Acceptance::Cosine, &pose, point, &scene.sources[0]).value;
            let found = Irradiance::of(&scene, &scene.sources[0]).at(point, normal);
            prop_assert!((found - exact).abs() <= 1e-12 * exact, "{found:e} against {exact:e}");
        }
    }
}
