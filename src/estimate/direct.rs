//! Direct light of a source that something may hide.
//!
//! ```text
//! E = β E₀ + ⟨ g (V − β) ⟩        g: a connection as if it were clear, V: whether it is, E₀ = ⟨g⟩ by its formula
//! ```
//!
//! β is the share of the light that a pilot run found clear, with random numbers of its own; for any fixed β the estimate is
//! unbiased. Where nothing hides the source β = 1 and V = 1: the formula comes out without any spread. Where all is hidden, zero
//! does. Between the two, in the penumbra, most of the variation of g is taken away. Without a formula β = 0.

use multiversion::multiversion;

use super::deterministic::at_point;
use super::job::Piece;
use super::lanes::each_sixteen;
use super::light::Lights;
use super::receiver::Receiver;
use super::sky::Lit;
use super::{Counters, REPLICATES};
use crate::geometry::rays::{LANES, Rays};
use crate::geometry::shape::Side;
use crate::geometry::world::World;
use crate::math::DVec3;
use crate::math::random::Stream;
use crate::plan::choose::{Formula, formula};
use crate::plan::{Term, Visibility};
use crate::scene::Scene;
use crate::sensor::{Acceptance, Sensor};
use crate::source::{Emitter, Source};

/// Connections of the pilot run.
const PILOT: u32 = 64;

/// Direct light of one source.
pub(super) struct SourceJob<'a> {
    /// Index into `Scene::sources`.
    pub(super) source: usize,
    pub(super) light: &'a Source,
    lights: Lights,
    /// Whether there is a formula for the unobstructed light.
    pub(super) has_formula: bool,
    /// Whether something may stand in the way.
    pub(super) tested: bool,
    /// The most that a source with a radiance can give, per unit of it; zero for a source without extent.
    pub(super) largest: f64,
    /// For a spot: which sides of which elements shine, the area of all, and where they are.
    target: Option<Target>,
}

/// A source as a spot looks for it.
struct Target {
    lit: Lit,
    area_m2: f64,
    middle: DVec3,
}

impl<'a> SourceJob<'a> {
    pub(super) fn new(scene: &'a Scene, sensor: &Sensor, term: &Term, naive: bool) -> SourceJob<'a> {
        let source = term.id.source();
        let light = &scene.sources[source];
        let target = match (&sensor.acceptance, &light.emitter) {
            (Acceptance::Spot(_), Emitter::Area { elements }) => Some(Target::of(scene, elements)),
            _ => None,
        };
        SourceJob {
            source,
            light,
            lights: Lights::new(scene, [(light, 0, 1.0)]),
            // The naive plan is a check on the formulas and must not use them.
            has_formula: !naive && formula(scene, sensor, light) != Formula::Unknown,
            tested: term.visibility == Visibility::Tested,
            largest: if matches!(light.emitter, Emitter::Area { .. }) { sensor.acceptance.projected_solid_angle_sr() } else { 0.0 },
            target,
        }
    }

    /// What to look for, where the source fills the field of a spot.
    pub(super) fn looked_for(&self, receiver: &Receiver<'_>) -> Option<&Lit> {
        self.target.as_ref().filter(|target| receiver.is_filled_by(target.area_m2, target.middle)).map(|target| &target.lit)
    }
}

impl Target {
    fn of(scene: &Scene, elements: &[(usize, Side)]) -> Target {
        let mut target = Target { lit: vec![[false; 2]; scene.elements.len()], area_m2: 0.0, middle: DVec3::ZERO };
        for &(e, side) in elements {
            let shape = &scene.elements[e].shape;
            target.lit[e][usize::from(side == Side::Back)] = true;
            target.area_m2 += shape.area_m2();
            target.middle += shape.bounding_sphere().0 / elements.len() as f64;
        }
        target
    }
}

pub(super) fn pilot(job: &SourceJob<'_>, world: &World, receiver: &Receiver<'_>, stream: Stream) -> (f64, Counters) {
    if !job.has_formula {
        return (0.0, Counters::default());
    }
    let (mut all, mut clear, mut rays) = (0.0, 0.0, 0);
    each_connection(job, world, receiver, &[stream], (0, PILOT), |_, g, visible| {
        all += g;
        clear += if visible { g } else { 0.0 };
        rays += u64::from(g > 0.0);
    });
    let share = if all > 0.0 { clear / all } else { 1.0 };
    (share, Counters { rays: if job.tested { rays } else { 0 }, samples: u64::from(PILOT), ..Counters::default() })
}

/// The most that any of a pilot run's connections would bring if the acceptance took it.
pub(super) fn brightest(job: &SourceJob<'_>, receiver: &Receiver<'_>, stream: Stream) -> f64 {
    let mut brightest = 0.0_f64;
    each_sixteen(&[stream], (0, PILOT), |points| {
        let u = &points.u;
        for lane in 0..points.lanes {
            let light = job.lights.sample(receiver.point([u[2][lane], u[3][lane]]), [u[0][lane], u[1][lane]]);
            brightest = brightest.max(light.weight * receiver.pose.normal.dot(light.to));
        }
    });
    brightest
}

/// The points `first .. first + count` of every replicate; `known` is E₀, and β is zero without it.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+avx2+fma", "x86_64+avx2+fma"))]
pub(super) fn sample(
    job: &SourceJob<'_>,
    world: &World,
    receiver: &Receiver<'_>,
    stream: Stream,
    (first, count): (u32, u32),
    share_clear: f64,
    known: Option<f64>,
) -> Piece {
    let streams: [Stream; REPLICATES] = std::array::from_fn(|r| stream.child(r as u64));
    let (beta, known) = known.map_or((0.0, 0.0), |known| (share_clear, known));
    let mut piece = Piece {
        sums: vec![0.0; REPLICATES],
        connections: 0,
        clear: 0,
        potential: vec![0.0],
        counters: Counters { samples: u64::from(count) * REPLICATES as u64, ..Counters::default() },
    };
    each_connection(job, world, receiver, &streams, (first, count), |replicate, g, visible| {
        // Written so that β = V leaves the formula alone, without g's rounding.
        piece.sums[replicate] += beta * known + g * (f64::from(visible) - beta);
        if g > 0.0 {
            piece.connections += 1;
            piece.clear += u64::from(visible);
            piece.potential[0] += g;
        }
    });
    piece.counters.rays = if job.tested { piece.connections } else { 0 };
    piece
}

/// Calls `take(replicate, g, whether it is clear)` for every point of every stream, sixteen at a time.
#[inline(always)]
fn each_connection(
    job: &SourceJob<'_>,
    world: &World,
    receiver: &Receiver<'_>,
    streams: &[Stream],
    range: (u32, u32),
    mut take: impl FnMut(usize, f64, bool),
) {
    let mut rays = Rays::none();
    rays.leaving = [receiver.resting_on; LANES];
    rays.leaving_part = [receiver.resting_part; LANES];
    let mut g = [0.0; LANES];
    each_sixteen(streams, range, |points| {
        let u = &points.u;
        rays.active = [false; LANES];
        for lane in 0..points.lanes {
            let at = receiver.point([u[2][lane], u[3][lane]]);
            let light = job.lights.sample(at, [u[0][lane], u[1][lane]]);
            g[lane] = if light.weight > 0.0 { light.weight * receiver.received(at, light.to) } else { 0.0 };
            rays.active[lane] = g[lane] > 0.0;
            rays.origin.set(lane, at);
            rays.direction.set(lane, light.to);
            rays.t_end[lane] = light.t_end;
            rays.arriving[lane] = light.element;
            rays.arriving_part[lane] = light.part;
        }
        let blocked = if job.tested { world.blocked(&rays) } else { [false; LANES] };
        for lane in 0..points.lanes {
            take(points.replicate[lane], g[lane], !blocked[lane]);
        }
    });
}

/// One connection to a source without extent, from a point: exact but for what stands in the way. Returns g V and the rays traced.
pub(super) fn connection(scene: &Scene, world: &World, receiver: &Receiver<'_>, source: &Source, tested: bool) -> (f64, u64) {
    let g = at_point(scene, receiver.acceptance, &receiver.pose, receiver.pose.at, source).value;
    if !tested || g <= 0.0 {
        return (g, 0);
    }
    let light = Lights::new(scene, [(source, 0, 1.0)]).sample(receiver.centre(), [0.5, 0.5]);
    let mut rays = Rays::none();
    rays.active[0] = true;
    rays.origin.set(0, receiver.centre());
    rays.direction.set(0, light.to);
    rays.t_end[0] = light.t_end;
    rays.leaving[0] = receiver.resting_on;
    rays.leaving_part[0] = receiver.resting_part;
    (if world.blocked(&rays)[0] { 0.0 } else { g }, 1)
}
