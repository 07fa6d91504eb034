//! What the rounding of coordinates costs a reading: doubles far from the origin are coarse, and slivers are thin.
//!
//! ```text
//! a coordinate c is rounded by ½ ε |c|, the vector between two points by δ ≤ √3 ε max|c|
//! distance:   E ∝ cos θ / r²   →   δE/E ≤ 3 δ / r              r: from the pose to the source
//! outline:    E ∝ area         →   δE/E ≤ ½ ε max|c| P / A     P: length of all edges, A: area; of polygons and meshes, given by corners
//! ```
//!
//! A pose on a source has no distance from it; there the bounding sphere is the scale.

use crate::geometry::shape::Shape;
use crate::math::DVec3;
use crate::scene::Scene;
use crate::source::Emitter;

/// Share of its size at which a pose is taken to be on a source.
const ON_SOURCE: f64 = 1e-9;

/// What of this does not depend on the pose.
pub(super) struct Coordinates {
    /// Length of the edges over the area, 1/m, of every source; zero where no corners are given.
    edges_per_area: Vec<f64>,
}

impl Coordinates {
    pub(super) fn of(scene: &Scene) -> Coordinates {
        let of_emitter = |emitter: &Emitter| match emitter {
            Emitter::Area { elements } => elements.iter().map(|&(e, _)| edges_per_area(&scene.elements[e].shape)).fold(0.0, f64::max),
            Emitter::Point { .. } | Emitter::Directional { .. } | Emitter::Environment => 0.0,
        };
        Coordinates { edges_per_area: scene.sources.iter().map(|source| of_emitter(&source.emitter)).collect() }
    }

    /// The largest share of a reading at this pose that rounding may change.
    pub(super) fn share(&self, scene: &Scene, at: DVec3) -> f64 {
        let of_distance = |largest: f64, distance_m: f64| 3.0 * 3f64.sqrt() * f64::EPSILON * largest / distance_m;
        let mut most = 0.0_f64;
        for (source, edges_per_area) in scene.sources.iter().zip(&self.edges_per_area) {
            match &source.emitter {
                Emitter::Point { at: lamp } => {
                    let largest = lamp.abs().max_element().max(at.abs().max_element());
                    most = most.max(of_distance(largest, (*lamp - at).length()));
                }
                Emitter::Area { elements } => {
                    for (element, _) in elements {
                        let shape = &scene.elements[*element].shape;
                        let (centre, radius_m) = shape.bounding_sphere();
                        let largest = (centre.abs().max_element() + radius_m).max(at.abs().max_element());
                        let distance_m = shape.distance_m(at);
                        let scale_m = if distance_m > ON_SOURCE * radius_m { distance_m } else { radius_m };
                        // The nearest point of the source is no further from the origin than this.
                        let nearest = at.abs().max_element() + scale_m;
                        most = most.max(of_distance(nearest, scale_m)).max(0.5 * f64::EPSILON * largest * edges_per_area);
                    }
                }
                Emitter::Directional { .. } | Emitter::Environment => {}
            }
        }
        most
    }
}

fn edges_per_area(shape: &Shape) -> f64 {
    let around = |corners: &[DVec3]| -> f64 { (0..corners.len()).map(|i| (corners[(i + 1) % corners.len()] - corners[i]).length()).sum() };
    let edges_m = match shape {
        Shape::Polygon(polygon) => around(polygon.corners()),
        Shape::Mesh(mesh) => (0..mesh.triangle_count() as u32).filter_map(|t| mesh.triangle(t)).map(|corners| around(&corners)).sum(),
        Shape::Rectangle(_) | Shape::Disc(_) | Shape::Sphere(_) => return 0.0,
    };
    edges_m / shape.area_m2()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::scene_from_text;

    fn share(source: &str, at: DVec3) -> f64 {
        let text = format!(
            "Scene(sources: [(name: \"s\", {source}, spectrum: Line(555))], instruments: [(name: \"m\", at: (0, 0, 0), facing: (0, 0, 1),
                sensor: Sensor(aperture: Point, acceptance: Cosine, channels: [(name: \"E\", responsivity: 1, reads: Irradiance)]))])"
        );
        let scene = scene_from_text(&text).unwrap_or_else(|problems| panic!("{problems}"));
        Coordinates::of(&scene).share(&scene, at)
    }

    #[test]
    fn an_ordinary_scene_is_not_touched_by_it() {
        for source in [
            "shape: Point, at: (0.1, 0.2, 2), strength: WattsPerSteradian(1)",
            "shape: Rectangle(0.6, 0.6), at: (0, 0, 3), facing: (0, 0, -1), strength: Radiance(1)",
            "shape: Polygon([(0, 0, 2), (1, 0, 2), (0, 1, 2)]), seen_from: Both, strength: Radiance(1)",
            "shape: Environment, strength: Radiance(1)",
        ] {
            assert!(share(source, DVec3::ZERO) < 1e-14, "{source}");
        }
    }

    #[test]
    fn it_grows_with_the_distance_from_the_origin_and_with_the_aspect_ratio() {
        let lamp = "shape: Point, at: (1e9, 1e9, 1000000001), strength: WattsPerSteradian(1)";
        let found = share(lamp, DVec3::new(1e9, 1e9, 1e9));
        assert!((1e-7..1e-5).contains(&found), "{found}");
        let sliver = "shape: Polygon([(-1, 0, 1), (1, 0, 1), (1, 2e-6, 1)]), seen_from: Both, strength: Radiance(1)";
        let found = share(sliver, DVec3::ZERO);
        assert!((1e-10..1e-8).contains(&found), "{found}");
    }
}
