//! Two emitters must not share a piece of surface: where they overlap, it is not defined which one is seen.
//!
//! Rectangles, polygons and discs overlap if they lie in one plane, face the same way and their outlines cross by more than a share of
//! 1e-9; spheres and meshes if they are the same. Emitters that only touch are fine.

use std::collections::BTreeSet;
use std::sync::Arc;

use super::SAME;
use crate::geometry::shape::{Disc, Shape, Side};
use crate::math::DVec3;
use crate::scene::Scene;
use crate::scene::diagnostic::Problems;
use crate::scene::reader::Places;
use crate::source::Emitter;

/// One emitting side.
struct Emitting<'s> {
    source: usize,
    shape: &'s Shape,
    side: Side,
    centre: DVec3,
    radius_m: f64,
}

/// Notes each pair of sources that overlap.
pub(super) fn check(scene: &Scene, places: &Places, problems: &mut Problems) {
    let mut emitting: Vec<Emitting> = Vec::new();
    for (source, entry) in scene.sources.iter().enumerate() {
        let Emitter::Area { elements } = &entry.emitter else { continue };
        for &(element, side) in elements {
            let shape = &scene.elements[element].shape;
            let (centre, radius_m) = shape.bounding_sphere();
            emitting.push(Emitting { source, shape, side, centre, radius_m });
        }
    }
    // Swept along the axis of the largest spread: only neighbours whose extents overlap there are compared.
    let low = emitting.iter().fold(DVec3::INFINITY, |low, e| low.min(e.centre));
    let high = emitting.iter().fold(DVec3::NEG_INFINITY, |high, e| high.max(e.centre));
    let axis = (0..3).max_by(|&i, &j| (high[i] - low[i]).total_cmp(&(high[j] - low[j]))).unwrap_or(0);
    let start = |e: &Emitting| e.centre[axis] - e.radius_m;
    emitting.sort_by(|a, b| start(a).total_cmp(&start(b)));
    let mut told: BTreeSet<(usize, usize)> = BTreeSet::new();
    for (i, a) in emitting.iter().enumerate() {
        if problems.is_full() {
            return;
        }
        for b in emitting[i + 1..].iter().take_while(|b| start(b) <= a.centre[axis] + a.radius_m) {
            let pair = (a.source.min(b.source), a.source.max(b.source));
            if a.source != b.source && overlap(a, b) && told.insert(pair) {
                let (first, second) = (&scene.sources[pair.0].name, &scene.sources[pair.1].name);
                let help = "move one of them towards where it shines, or make them one source whose spectrum is a `Sum`";
                let place = &places.sources[pair.1];
                place.problem_at(
                    &place.title_span(),
                    problems,
                    format!("the sources \"{first}\" and \"{second}\" emit from the same surface"),
                    help,
                );
            }
        }
    }
}

fn overlap(a: &Emitting, b: &Emitting) -> bool {
    if let (Shape::Mesh(m), Shape::Mesh(n)) = (a.shape, b.shape) {
        return Arc::ptr_eq(m, n) && a.side == b.side;
    }
    if let (Shape::Sphere(s), Shape::Sphere(t)) = (a.shape, b.shape) {
        let size = s.radius_m.max(t.radius_m);
        return a.side == b.side && (s.centre - t.centre).length() <= SAME * size && (s.radius_m - t.radius_m).abs() <= SAME * size;
    }
    let (Some((n, m)), offset) = (emission_normal(a).zip(emission_normal(b)), b.centre - a.centre) else { return false };
    let one_plane = offset.dot(n).abs() <= SAME * (a.radius_m + b.radius_m);
    if n.cross(m).length() > SAME || n.dot(m) < 0.0 || !one_plane {
        return false;
    }
    match (a.shape, b.shape) {
        (Shape::Disc(d), Shape::Disc(e)) => {
            let in_hole = |ring: &Disc, other: &Disc| offset.length() + other.radius_m <= ring.hole_radius_m * (1.0 + SAME);
            offset.length() < (d.radius_m + e.radius_m) * (1.0 - SAME) && !in_hole(d, e) && !in_hole(e, d)
        }
        (Shape::Disc(d), shape) | (shape, Shape::Disc(d)) => {
            let nearest = match shape {
                Shape::Rectangle(r) => nearest_point(r, d.centre),
                Shape::Polygon(p) => p.nearest_point(d.centre),
                _ => return false,
            };
            let (centre, radius_m) = shape.bounding_sphere();
            let in_hole = (centre - d.centre).length() + radius_m <= d.hole_radius_m * (1.0 + SAME);
            (nearest - d.centre).length() < d.radius_m * (1.0 - SAME) && !in_hole
        }
        (shape, other) => {
            let (parts, others) = (convex_parts(shape), convex_parts(other));
            parts.iter().any(|part| others.iter().any(|other| !separated(part, other, n) && !separated(other, part, n)))
        }
    }
}

/// A rectangle as it is, a polygon in triangles; counter-clockwise as seen from the front.
fn convex_parts(shape: &Shape) -> Vec<Vec<DVec3>> {
    match shape {
        Shape::Rectangle(r) => vec![r.corners().to_vec()],
        Shape::Polygon(p) => p.triangles().map(|t| t.to_vec()).collect(),
        _ => Vec::new(),
    }
}

/// Whether an edge of `part` separates it from another convex figure in the same plane, to a share of their size.
fn separated(part: &[DVec3], other: &[DVec3], normal: DVec3) -> bool {
    (0..part.len()).any(|i| {
        let across = (part[(i + 1) % part.len()] - part[i]).cross(normal);
        let along = |points: &[DVec3]| {
            points
                .iter()
                .map(|p| across.dot(*p - part[i]))
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
        };
        let ((low, high), (from, to)) = (along(part), along(other));
        let slack = SAME * (high - low).max(to - from);
        from >= high - slack || to <= low + slack
    })
}

/// The point of a rectangle that is closest to a point.
pub(super) fn nearest_point(r: &crate::geometry::shape::Rectangle, point: DVec3) -> DVec3 {
    let along = |half: DVec3| half * ((point - r.centre).dot(half) / half.length_squared()).clamp(-1.0, 1.0);
    r.centre + along(r.half_u) + along(r.half_v)
}

/// The direction into which something flat emits.
fn emission_normal(emitting: &Emitting) -> Option<DVec3> {
    emitting.shape.plane().map(|(_, normal)| normal * emitting.side.sign())
}
