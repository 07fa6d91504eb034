//! All shapes of a scene: which one does a ray meet first, and is the way between two points clear?
//!
//! Plane shapes and spheres are met in double precision, every lane against every shape; meshes through their own hierarchies,
//! each about its own origin, so that clusters far apart keep their digits.
//!
//! Surfaces that coincide (to a share of 1e-12 of the distance) count as one: the one that comes first in the list is met.

use std::sync::Arc;

use super::balls::{self, Ball};
use super::blocks::{self, Block};
use super::flats::{self, Flat, Outline};
use super::mesh::Mesh;
use super::rays::{COINCIDENT, Hits, LANES, NONE, Rays};
use super::shape::Shape;
use crate::math::DVec3;

/// The shapes of a scene, prepared for rays.
#[derive(Clone, Debug, Default)]
pub struct World {
    /// Every rectangle; those that enclose a box are met as `blocks`, the rest as `loose`.
    rectangles: Vec<Flat>,
    loose: Vec<Flat>,
    blocks: Vec<Block>,
    polygons: Vec<Outline>,
    discs: Vec<Flat>,
    balls: Vec<Ball>,
    meshes: Vec<(u32, Arc<Mesh>)>,
    /// Where to find each element for its normal.
    places: Vec<Place>,
}

#[derive(Clone, Copy, Debug)]
enum Place {
    Rectangle(usize),
    Polygon(usize),
    Disc(usize),
    Ball(usize),
    Mesh(usize),
}

/// A point on a surface.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePoint {
    /// Where, m.
    pub point: DVec3,
    /// Unit normal of the front there.
    pub normal: DVec3,
}

impl World {
    /// Prepares the shapes; the index of a shape in the list is its element.
    #[must_use]
    pub fn new<'a>(shapes: impl IntoIterator<Item = &'a Shape>) -> World {
        let mut world = World::default();
        for (element, shape) in shapes.into_iter().enumerate() {
            let element = u32::try_from(element).unwrap_or(NONE);
            world.places.push(match shape {
                Shape::Rectangle(r) => {
                    world.rectangles.push(Flat::rectangle(element, r));
                    Place::Rectangle(world.rectangles.len() - 1)
                }
                Shape::Polygon(p) => {
                    world.polygons.push(Outline::new(element, p));
                    Place::Polygon(world.polygons.len() - 1)
                }
                Shape::Disc(d) => {
                    world.discs.push(Flat::disc(element, d));
                    Place::Disc(world.discs.len() - 1)
                }
                Shape::Sphere(s) => {
                    world.balls.push(Ball::new(element, s));
                    Place::Ball(world.balls.len() - 1)
                }
                Shape::Mesh(m) => {
                    world.meshes.push((element, Arc::clone(m)));
                    Place::Mesh(world.meshes.len() - 1)
                }
            });
        }
        world.find_blocks();
        world
    }

    /// Sorts the rectangles into boxes, of which six in a row may be one, and others.
    fn find_blocks(&mut self) {
        let mut rest = self.rectangles.as_slice();
        while let Some(first) = rest.first() {
            match rest.first_chunk::<6>().and_then(Block::of) {
                Some(block) => {
                    self.blocks.push(block);
                    rest = &rest[6..];
                }
                None => {
                    self.loose.push(*first);
                    rest = &rest[1..];
                }
            }
        }
    }

    /// Whether there is nothing to meet.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.places.is_empty()
    }

    /// Nodes of all hierarchies.
    #[must_use]
    pub fn bvh_nodes(&self) -> usize {
        self.meshes.iter().map(|(_, m)| m.node_count()).sum()
    }

    /// The first surface that each ray meets.
    #[inline(always)]
    #[must_use]
    pub fn closest(&self, rays: &Rays) -> Hits {
        let mut hits = Hits::nothing(rays);
        flats::nearest::<false>(&self.loose, rays, &mut hits);
        blocks::nearest(&self.blocks, rays, &mut hits);
        flats::nearest::<true>(&self.discs, rays, &mut hits);
        flats::nearest_outline(&self.polygons, rays, &mut hits);
        balls::nearest(&self.balls, rays, &mut hits);
        for (element, mesh) in &self.meshes {
            for lane in 0..LANES {
                if rays.active[lane] {
                    let leaving = (rays.leaving[lane] == *element).then_some(rays.leaving_part[lane]);
                    let direction = rays.direction.get(lane);
                    let length = direction.length();
                    let t_end = hits.t[lane] * length * (1.0 - COINCIDENT);
                    if let Some(hit) = mesh.closest(rays.origin.get(lane), direction / length, t_end, leaving) {
                        hits.t[lane] = hit.t / length;
                        hits.element[lane] = *element;
                        hits.part[lane] = hit.triangle;
                    }
                }
            }
        }
        hits
    }

    /// Whether something stands in the way of each ray before its end.
    #[inline(always)]
    #[must_use]
    pub fn blocked(&self, rays: &Rays) -> [bool; LANES] {
        let mut blocked = [false; LANES];
        flats::cut::<false>(&self.loose, rays, &mut blocked);
        blocks::cut(&self.blocks, rays, &mut blocked);
        flats::cut::<true>(&self.discs, rays, &mut blocked);
        flats::cut_outline(&self.polygons, rays, &mut blocked);
        balls::cut(&self.balls, rays, &mut blocked);
        for (element, mesh) in &self.meshes {
            for lane in 0..LANES {
                if rays.active[lane] && !blocked[lane] {
                    let leaving = (rays.leaving[lane] == *element).then_some(rays.leaving_part[lane]);
                    let arriving = (rays.arriving[lane] == *element).then_some(rays.arriving_part[lane]);
                    let direction = rays.direction.get(lane);
                    let length = direction.length();
                    let t_end = rays.t_end[lane] * length * (1.0 - COINCIDENT);
                    blocked[lane] = mesh.blocked(rays.origin.get(lane), direction / length, t_end, leaving, arriving);
                }
            }
        }
        blocked
    }

    /// Where a ray meets an element, and the normal of the front there.
    #[inline(always)]
    #[must_use]
    pub fn surface_point(&self, origin: DVec3, direction: DVec3, t: f64, element: u32, part: u32) -> SurfacePoint {
        let point = origin + direction * t;
        match self.places[element as usize] {
            Place::Rectangle(i) => SurfacePoint { point, normal: self.rectangles[i].normal },
            Place::Polygon(i) => SurfacePoint { point, normal: self.polygons[i].flat.normal },
            Place::Disc(i) => SurfacePoint { point, normal: self.discs[i].normal },
            Place::Ball(i) => SurfacePoint { point, normal: (point - self.balls[i].centre).normalize() },
            Place::Mesh(i) => {
                let (point, normal) = self.meshes[i].1.surface_point(part, point);
                SurfacePoint { point, normal }
            }
        }
    }
}

#[cfg(test)]
mod tests;
