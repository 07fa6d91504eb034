//! How many samples for which job: rounds of doubling until every reading is good enough.
//!
//! ```text
//! stop when k √(f² u_A² + u_B²) ≤ target · |value|        f = √(ν/χ²₀.₀₅(ν)): the upper limit of the spread
//! else double the job with the largest u² / (samples · cost)
//! ```
//!
//! Stopping at the first small spread would favour spreads that are small by luck, and the intervals would cover too little; the
//! upper limit takes that away. Rounds and their pieces depend on the numbers of samples alone, never on time or threads.

use super::deterministic::{direct, sphere_wall};
use super::direct::{SourceJob, connection};
use super::job::{Job, Progress};
use super::paths::PathScene;
use super::receiver::Receiver;
use super::run::in_order;
use super::{ChannelEstimate, Counters, EstimateError, Estimates, Exact, PoseEstimate, REPLICATES, Stop, Watch};
use crate::geometry::world::World;
use crate::math::random::Stream;
use crate::metrology::replicates::spread_upper_factor;
use crate::metrology::{Budget, BudgetRow, CompensatedSum, Replicates};
use crate::plan::{Method, Plan, Transport, Visibility};
use crate::scene::{Instrument, Scene};

/// Points a replicate in the first round.
const FIRST_POINTS: u32 = 16;
/// Points of all replicates in one piece of work.
const PIECE: u32 = 16_384;
/// Poses that are estimated together; bounds the memory for sums.
const BATCH: usize = 2048;
/// Samples a job and pose at which a target is given up, for one pose and for many.
const MOST_SAMPLES: u64 = 1 << 26;
const MOST_SAMPLES_IN_ALL: u64 = 1 << 30;

/// Estimates every term of a plan, for every pose of every instrument.
pub fn estimate(scene: &Scene, plan: &Plan, stop: &Stop, seed: u64, watch: &Watch<'_>) -> Result<Estimates, EstimateError> {
    let world = if plan.needs_rays { World::new(scene.elements.iter().map(|e| Some(&e.shape))) } else { World::default() };
    let mut counters = Counters { bvh_nodes: world.bvh_nodes() as u64, ..Counters::default() };
    let all: usize = scene.instruments.iter().map(|i| i.poses.len()).sum();
    let start = (watch.now)();
    let mut done = 0;
    let mut poses = Vec::with_capacity(scene.instruments.len());
    for (i, instrument) in scene.instruments.iter().enumerate() {
        let task = Task::new(scene, plan, &world, i);
        counters.spectral_nodes = counters.spectral_nodes.max(task.spectral_nodes());
        let mut results = Vec::with_capacity(instrument.poses.len());
        for first in (0..instrument.poses.len()).step_by(BATCH) {
            let indices: Vec<usize> = (first..instrument.poses.len().min(first + BATCH)).collect();
            let deadline = stop.budget_seconds.map(|b| start + b * (done + indices.len()) as f64 / all as f64);
            let batch = Batch { task: &task, stop, seed, watch, deadline, poses: all };
            let (estimates, counted) = batch.run(&indices)?;
            done += indices.len();
            counters.add(&counted);
            results.extend(estimates);
            (watch.progress)(done as f64 / all as f64);
        }
        poses.push(results);
    }
    Ok(Estimates { poses, counters })
}

/// What is to be done for an instrument.
struct Task<'a> {
    scene: &'a Scene,
    world: &'a World,
    index: usize,
    instrument: &'a Instrument,
    /// `weights[channel][source]` = ∫ density · responsivity.
    weights: Vec<Vec<f64>>,
    /// Sources with a formula, and the job to fall back on where its quadrature fails.
    formulas: Vec<(usize, Option<usize>)>,
    /// Sources to which one connection is made, and whether it is tested.
    connections: Vec<(usize, bool)>,
    /// (channel, source) whose reflections are summed.
    spheres: Vec<(usize, usize)>,
    jobs: Vec<(Job<'a>, String)>,
    /// Jobs that run in any case come first.
    certain: usize,
}

impl<'a> Task<'a> {
    fn new(scene: &'a Scene, plan: &'a Plan, world: &'a World, index: usize) -> Task<'a> {
        let instrument = &scene.instruments[index];
        let channels = &instrument.sensor.channels;
        let mut weights = vec![vec![0.0; scene.sources.len()]; channels.len()];
        let mut task_terms: Vec<&crate::plan::Term> = Vec::new();
        let mut spheres = Vec::new();
        let mut reflected = false;
        let mut seen = vec![false; scene.sources.len()];
        let mut last: Option<(usize, usize)> = None;
        for term in plan.kept.iter().filter(|t| t.id.instrument() == index) {
            let (c, s) = (term.id.channel(), term.id.source());
            weights[c][s] = match last {
                Some((lc, ls)) if lc == c && scene.sources[ls].density == scene.sources[s].density => weights[lc][ls],
                _ => scene.sources[s].density.integral(&[&channels[c].responsivity]),
            };
            last = Some((c, s));
            match (term.id.transport, term.method) {
                (Transport::Reflected, Method::ClosedSphere) => spheres.push((c, s)),
                (Transport::Reflected, _) => reflected = true,
                // Which method serves a direct term does not depend on the channel.
                (Transport::Direct, _) if !std::mem::replace(&mut seen[s], true) => task_terms.push(term),
                (Transport::Direct, _) => {}
            }
        }
        let mut task = Task {
            scene,
            world,
            index,
            instrument,
            weights,
            formulas: Vec::new(),
            connections: Vec::new(),
            spheres,
            jobs: Vec::new(),
            certain: 0,
        };
        let mut fallback = Vec::new();
        for term in task_terms {
            let source = term.id.source();
            let name = &scene.sources[source].name;
            let job = || Job::Source(SourceJob::new(scene, &instrument.sensor, term, plan.naive));
            match term.method {
                Method::ClosedForm => task.formulas.push((source, None)),
                Method::Quadrature => {
                    task.formulas.push((source, Some(fallback.len())));
                    fallback.push((job(), format!("direct light of `{name}` (its quadrature did not converge)")));
                }
                Method::Connection => task.connections.push((source, term.visibility == Visibility::Tested)),
                Method::SampledSource => task.jobs.push((job(), format!("direct light of `{name}`"))),
                Method::SampledSky => task.jobs.push((Job::Sky { source }, format!("direct light of `{name}`"))),
                Method::Paths | Method::ClosedSphere => {}
            }
        }
        if let (true, Some(spectral)) = (reflected, &plan.spectral[index]) {
            let accepted_sr = instrument.sensor.acceptance.projected_solid_angle_sr();
            let paths = Job::Paths { scene: PathScene::new(scene, world, spectral), spectral, accepted_sr };
            task.jobs.push((paths, "reflected light".to_owned()));
        }
        task.certain = task.jobs.len();
        for (_, slot) in &mut task.formulas {
            *slot = slot.map(|s| s + task.certain);
        }
        task.jobs.extend(fallback);
        task
    }

    fn spectral_nodes(&self) -> u64 {
        let nodes = |job: &Job<'_>| match job {
            Job::Paths { spectral, .. } => spectral.wavelengths_nm.len() as u64,
            _ => 0,
        };
        self.jobs.iter().map(|(job, _)| nodes(job)).max().unwrap_or(0)
    }

    fn stream(&self, seed: u64, pose: usize, job: usize) -> Stream {
        let [kind, part] = self.jobs[job].0.tag();
        Stream::new(seed, &[self.index as u64, pose as u64, kind, part])
    }

    /// The deterministic terms in one pose; jobs whose quadrature failed are switched on.
    fn start(&self, pose: usize) -> PoseState<'a> {
        let channels = self.instrument.sensor.channels.len();
        let place = self.instrument.poses[pose];
        let receiver = Receiver::new(self.scene, &self.instrument.sensor, place);
        let mut active: Vec<bool> = (0..self.jobs.len()).map(|j| j < self.certain).collect();
        let mut sums = vec![CompensatedSum::new(); channels];
        let mut exact = vec![Exact::default(); channels];
        let mut counters = Counters::default();
        let mut add = |source: usize, value: f64, error: f64| {
            for c in 0..channels {
                let weight = self.weights[c][source];
                sums[c].add(weight * value);
                exact[c].quadrature_error += weight * error;
                exact[c].terms += 1;
            }
        };
        for &(source, fallback) in &self.formulas {
            match (direct(self.scene, &self.instrument.sensor, &place, &self.scene.sources[source]), fallback) {
                (Some(found), _) => add(source, found.value, found.error),
                (None, Some(job)) => active[job] = true,
                // A closed form is not a quadrature and cannot fail to converge.
                (None, None) => add(source, 0.0, f64::INFINITY),
            }
        }
        for &(source, tested) in &self.connections {
            let (value, rays) = connection(self.scene, self.world, &receiver, &self.scene.sources[source], tested);
            counters.rays += rays;
            add(source, value, 0.0);
        }
        for &(c, s) in &self.spheres {
            sums[c].add(self.weights[c][s] * sphere_wall(self.scene, &self.scene.sources[s]).unwrap_or(0.0));
            exact[c].terms += 1;
        }
        for (exact, sum) in exact.iter_mut().zip(&sums) {
            exact.value = sum.value();
        }
        PoseState { pose, receiver, exact, active, jobs: vec![Progress::default(); self.jobs.len()], counters, finished: false, target_met: true }
    }

    fn channels(&self, state: &PoseState<'_>) -> Vec<ChannelEstimate> {
        state
            .exact
            .iter()
            .enumerate()
            .map(|(c, exact)| ChannelEstimate {
                exact: *exact,
                sampled: self
                    .jobs
                    .iter()
                    .enumerate()
                    .filter(|(j, _)| state.active[*j])
                    .map(|(j, (job, label))| job.seen_by(&state.jobs[j], c, &|source| self.weights[c][source], label))
                    .collect(),
            })
            .collect()
    }
}

/// How it stands with one pose.
struct PoseState<'a> {
    pose: usize,
    receiver: Receiver<'a>,
    exact: Vec<Exact>,
    active: Vec<bool>,
    jobs: Vec<Progress>,
    counters: Counters,
    finished: bool,
    target_met: bool,
}

/// Poses that are estimated together.
struct Batch<'a> {
    task: &'a Task<'a>,
    stop: &'a Stop,
    seed: u64,
    watch: &'a Watch<'a>,
    deadline: Option<f64>,
    poses: usize,
}

/// A piece of work: points `first .. first + count` of a job in a pose.
struct Work {
    slot: usize,
    job: usize,
    first: u32,
    count: u32,
}

impl Batch<'_> {
    fn run(&self, poses: &[usize]) -> Result<(Vec<PoseEstimate>, Counters), EstimateError> {
        let start = (self.watch.now)();
        let mut states = in_order(poses, |&pose| {
            let mut state = self.task.start(pose);
            for job in (0..state.jobs.len()).filter(|&j| state.active[j]) {
                let stream = self.task.stream(self.seed, pose, job).child(u64::MAX);
                let (share, counted) = self.task.jobs[job].0.pilot(self.task.world, &state.receiver, stream);
                state.jobs[job].share_clear = share;
                state.counters.add(&counted);
            }
            state
        });
        let first = match self.stop.samples {
            Some(samples) => u32::try_from(samples.div_ceil(REPLICATES as u64).next_power_of_two()).unwrap_or(1 << 28).clamp(1, 1 << 28),
            None => FIRST_POINTS,
        };
        let mut requests: Vec<(usize, usize, u32)> = (0..states.len())
            .flat_map(|slot| (0..self.task.jobs.len()).map(move |job| (slot, job, first)))
            .filter(|&(slot, job, _)| states[slot].active[job])
            .collect();
        loop {
            let round = (self.watch.now)();
            self.sample(&mut states, &requests)?;
            let round = (self.watch.now)() - round;
            if self.stop.samples.is_some() {
                break;
            }
            // A round doubles a job: the next one costs up to twice this one.
            let late = self.deadline.is_some_and(|d| (self.watch.now)() + 2.0 * round > d);
            let next = self.assess(&mut states, late);
            if next.is_empty() {
                break;
            }
            requests = next;
        }
        let seconds = ((self.watch.now)() - start) / poses.len() as f64;
        let mut counters = Counters::default();
        let estimates = states
            .iter()
            .map(|state| {
                counters.add(&state.counters);
                PoseEstimate { channels: self.task.channels(state), target_met: state.target_met, seconds }
            })
            .collect();
        Ok((estimates, counters))
    }

    /// Brings jobs to a number of points each.
    fn sample(&self, states: &mut [PoseState<'_>], requests: &[(usize, usize, u32)]) -> Result<(), EstimateError> {
        let most = PIECE / REPLICATES as u32;
        let mut work = Vec::new();
        for &(slot, job, points) in requests {
            let mut first = states[slot].jobs[job].points;
            while first < points {
                let count = most.min(points - first);
                work.push(Work { slot, job, first, count });
                first += count;
            }
        }
        let shared: &[PoseState<'_>] = states;
        let pieces = in_order(&work, |w| {
            let state = &shared[w.slot];
            let stream = self.task.stream(self.seed, state.pose, w.job);
            let job = &self.task.jobs[w.job].0;
            job.sample(self.task.scene, self.task.world, &state.receiver, stream, (w.first, w.count), state.jobs[w.job].share_clear)
        });
        for (w, piece) in work.iter().zip(pieces) {
            let piece = piece.map_err(|_| EstimateError::Endless { instrument: self.task.instrument.name.clone() })?;
            let state = &mut states[w.slot];
            let progress = &mut state.jobs[w.job];
            if progress.sums.is_empty() {
                progress.sums = piece.sums;
            } else {
                progress.sums.iter_mut().zip(&piece.sums).for_each(|(sum, more)| *sum += more);
            }
            progress.points += w.count;
            progress.connections += piece.connections;
            progress.clear += piece.clear;
            progress.potential += piece.potential;
            state.counters.add(&piece.counters);
        }
        Ok(())
    }

    /// Who needs more samples, and of what.
    fn assess(&self, states: &mut [PoseState<'_>], late: bool) -> Vec<(usize, usize, u32)> {
        let most = (MOST_SAMPLES_IN_ALL / self.poses as u64).clamp(1 << 16, MOST_SAMPLES) / REPLICATES as u64;
        let slots: Vec<usize> = (0..states.len()).filter(|&s| !states[s].finished).collect();
        let shared: &[PoseState<'_>] = states;
        let verdicts = in_order(&slots, |&slot| self.judge(&shared[slot], most as u32));
        let mut requests = Vec::new();
        for (slot, (met, next)) in slots.into_iter().zip(verdicts) {
            let state = &mut states[slot];
            state.target_met = met;
            match next {
                Some(job) if !met && !late => requests.push((slot, job, 2 * state.jobs[job].points)),
                _ => state.finished = true,
            }
        }
        requests
    }

    /// Whether every channel meets the target, and which job should grow otherwise.
    fn judge(&self, state: &PoseState<'_>, most: u32) -> (bool, Option<usize>) {
        let active: Vec<usize> = (0..state.jobs.len()).filter(|&j| state.active[j]).collect();
        let mut met = true;
        let mut gain = vec![0.0f64; state.jobs.len()];
        for (c, channel) in self.task.channels(state).iter().enumerate() {
            let mut spread = Budget::new();
            let mut rest = Budget::new();
            let mut value = channel.exact.value;
            let mut squares = Vec::with_capacity(active.len());
            for sampled in &channel.sampled {
                let Some(found) = Replicates::evaluate(&sampled.replicates) else { continue };
                value += found.mean;
                spread.push(BudgetRow::type_a("", found.standard_uncertainty, found.degrees_of_freedom()));
                let missed = sampled.missed.as_ref().map_or(0.0, |(bound, _)| bound / 3f64.sqrt());
                rest.push(BudgetRow::normal("", missed));
                squares.push((found.standard_uncertainty, missed));
            }
            let nu = spread.effective_degrees_of_freedom();
            let factor = spread_upper_factor(nu).unwrap_or(1.0);
            let (a, b) = (factor * spread.combined_standard_uncertainty(), rest.combined_standard_uncertainty());
            let mut total = Budget::new();
            total.push(BudgetRow::type_a("", a, nu));
            total.push(BudgetRow::normal("", b));
            let upper = total.expanded().map_or(f64::INFINITY, |e| e.expanded_uncertainty);
            // Without a target the budget of time alone ends the run.
            let good = upper == 0.0 || self.stop.target.is_some_and(|target| upper <= target * value.abs());
            debug_assert!(c < state.exact.len());
            if !good {
                met = false;
                let size = a.hypot(b);
                for (&job, (u, missed)) in active.iter().zip(squares) {
                    let cost = f64::from(state.jobs[job].points) * self.task.jobs[job].0.cost();
                    let share = u.hypot(missed) / size;
                    gain[job] += share * share / cost;
                }
            }
        }
        let next = active
            .into_iter()
            .filter(|&j| state.jobs[j].points < most && gain[j] > 0.0)
            .max_by(|&a, &b| gain[a].total_cmp(&gain[b]).then(b.cmp(&a)));
        (met, next)
    }
}
