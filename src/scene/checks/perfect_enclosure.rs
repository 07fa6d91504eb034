//! Light that is emitted where nothing absorbs piles up without end: the reading is `1/(1 − ρ)` with ρ = 1.
//!
//! A closed container (a sphere, a box, a closed mesh) is refused if at a wavelength at which a source shines into it the inside
//! and everything in it reflect all light. Where ρ(λ) touches 1 at one wavelength only, `∫ dλ/(1 − ρ)` has no finite value either.

use std::ops::Range;

use super::coincident_emitters::nearest_point;
use crate::geometry::shape::{Shape, Side};
use crate::math::DVec3;
use crate::scene::diagnostic::Problems;
use crate::scene::reader::Places;
use crate::scene::{Element, Scene};
use crate::source::{Emitter, Source};
use crate::spectrum::Factor;

/// Notes each container and source without a finite answer.
pub(super) fn check(scene: &Scene, places: &Places, problems: &mut Problems) {
    if !scene.surfaces.iter().any(|surface| surface.reflectance.max_over(0.0, f64::INFINITY) >= 1.0) {
        return;
    }
    let runs = runs(&scene.elements);
    let boxes: Vec<bool> = runs.iter().flat_map(|run| run.clone().map(|_| run.len() == 6)).collect();
    for run in runs {
        let Some(container) = Container::of(&scene.elements, run) else { continue };
        let own = &scene.elements[container.run.start];
        let own = if container.inner == Side::Back { own.back } else { own.front };
        if scene.surfaces[own].reflectance.max_over(0.0, f64::INFINITY) < 1.0 {
            continue;
        }
        let lit: Vec<_> =
            scene.sources.iter().zip(&places.sources).filter(|(source, _)| container.is_lit_by(source, &scene.elements)).collect();
        if lit.is_empty() || problems.is_full() {
            continue;
        }
        let surfaces = container.surfaces_inside(&scene.elements, &boxes);
        let reflectances: Vec<&Factor> = surfaces.iter().map(|&index| &scene.surfaces[index].reflectance).collect();
        for (source, place) in lit {
            if let Some(nm) = perfect_wavelength(&reflectances, source) {
                let owner = &scene.elements[container.run.start].owner;
                let message =
                    format!("the reading has no finite value: at {nm} nm nothing in \"{owner}\" absorbs the light of \"{}\"", source.name);
                place.problem_at(
                    &place.title_span(),
                    problems,
                    message,
                    "give the inside of the container a reflectance below 1, such as 0.99, or put something into it that absorbs",
                );
            }
        }
    }
}

/// Elements one after the other that belong to the same object or source.
fn runs(elements: &[Element]) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for (i, element) in elements.iter().enumerate() {
        match runs.last_mut() {
            Some(run) if elements[run.start].owner == element.owner => run.end = i + 1,
            _ => runs.push(i..i + 1),
        }
    }
    runs
}

/// A closed surface.
struct Container {
    run: Range<usize>,
    centre: DVec3,
    inner: Side,
    kind: Kind,
}

enum Kind {
    Sphere {
        radius_m: f64,
    },
    /// Points and outward normals of the faces.
    Box(Vec<(DVec3, DVec3)>),
    /// The box that holds a closed mesh.
    Mesh {
        low: DVec3,
        high: DVec3,
    },
}

impl Container {
    fn of(elements: &[Element], run: Range<usize>) -> Option<Self> {
        let shapes: Vec<&Shape> = elements[run.clone()].iter().map(|element| &element.shape).collect();
        let (centre, inner, kind) = match shapes.as_slice() {
            [Shape::Sphere(s)] => (s.centre, Side::Back, Kind::Sphere { radius_m: s.radius_m }),
            [Shape::Mesh(mesh)] if mesh.is_closed() => {
                let (low, high) = mesh.bounds();
                let centre = low + 0.5 * (high - low);
                // Six times the volume, positive if the normals point outwards.
                let volume: f64 = (0..mesh.triangle_count() as u32)
                    .filter_map(|i| mesh.triangle(i))
                    .map(|[a, b, c]| (a - centre).dot((b - centre).cross(c - centre)))
                    .sum();
                (centre, if volume > 0.0 { Side::Back } else { Side::Front }, Kind::Mesh { low, high })
            }
            [_, _, _, _, _, _] => {
                let faces = shapes.iter().map(|shape| if let Shape::Rectangle(r) = shape { Some((r.centre, r.normal())) } else { None });
                let faces: Vec<(DVec3, DVec3)> = faces.collect::<Option<_>>()?;
                let centre = faces.iter().fold(DVec3::ZERO, |sum, face| sum + face.0 / 6.0);
                (centre, Side::Back, Kind::Box(faces))
            }
            _ => return None,
        };
        Some(Container { run, centre, inner, kind })
    }

    fn holds(&self, point: DVec3) -> bool {
        match &self.kind {
            Kind::Sphere { radius_m } => (point - self.centre).length() < *radius_m,
            Kind::Box(faces) => faces.iter().all(|(on, normal)| normal.dot(point - *on) < 0.0),
            Kind::Mesh { low, high } => point.cmpgt(*low).all() && point.cmplt(*high).all(),
        }
    }

    /// Whether a part of an element stands inside; the container itself does not.
    fn contains(&self, index: usize, element: &Element) -> bool {
        if self.run.contains(&index) {
            return false;
        }
        let (centre, _) = element.shape.bounding_sphere();
        let towards = match &element.shape {
            Shape::Rectangle(r) => nearest_point(r, self.centre),
            Shape::Polygon(p) => p.nearest_point(self.centre),
            Shape::Disc(d) => d.nearest_point(self.centre),
            Shape::Sphere(s) => {
                let offset = self.centre - s.centre;
                // A sphere about the whole container is around it, not in it.
                if offset.length() < s.radius_m {
                    centre + offset.normalize_or(DVec3::X) * s.radius_m
                } else {
                    centre + offset.clamp_length_max(s.radius_m)
                }
            }
            Shape::Mesh(mesh) => {
                let (low, high) = mesh.bounds();
                self.centre.clamp(low, high)
            }
        };
        self.holds(towards)
    }

    /// Surfaces that light inside can meet. `of_a_box` tells of each element whether it is a side of a box.
    fn surfaces_inside(&self, elements: &[Element], of_a_box: &[bool]) -> Vec<usize> {
        let mut surfaces = Vec::new();
        for (index, element) in elements.iter().enumerate() {
            if self.run.contains(&index) {
                surfaces.push(if self.inner == Side::Back { element.back } else { element.front });
            } else if self.contains(index, element) {
                surfaces.push(element.front);
                // The inside of a sphere or of a box is not lit from outside of it.
                let closed = matches!(element.shape, Shape::Sphere(_)) || of_a_box[index];
                if !closed {
                    surfaces.push(element.back);
                }
            }
        }
        surfaces.sort_unstable();
        surfaces.dedup();
        surfaces
    }

    fn is_lit_by(&self, source: &Source, elements: &[Element]) -> bool {
        match &source.emitter {
            Emitter::Point { at } => self.holds(*at),
            Emitter::Area { elements: emitting } => emitting
                .iter()
                .any(|&(index, side)| if self.run.contains(&index) { side == self.inner } else { self.contains(index, &elements[index]) }),
            Emitter::Directional { .. } | Emitter::Environment => false,
        }
    }
}

/// A wavelength at which the source shines and every reflectance is one.
fn perfect_wavelength(reflectances: &[&Factor], source: &Source) -> Option<f64> {
    if reflectances.iter().any(|factor| factor.max_over(0.0, f64::INFINITY) < 1.0) {
        return None;
    }
    let support = source.density.support();
    let mut candidates: Vec<f64> = reflectances.iter().flat_map(|factor| factor.breakpoints()).collect();
    for &(from, to) in support.intervals() {
        // A black body shines everywhere; its visible part stands for it.
        candidates.extend([from, to, 555.0_f64.clamp(from, to)]);
    }
    candidates.retain(|nm| nm.is_finite() && *nm > 0.0);
    candidates.sort_by(f64::total_cmp);
    let between: Vec<f64> = candidates.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect();
    candidates.extend(between);
    candidates.into_iter().find(|&nm| support.contains(nm) && reflectances.iter().all(|factor| factor.at(nm) >= 1.0))
}
