//! How many samples for which job: a trial finds out, and a run with numbers of its own gives the reading.
//!
//! ```text
//! trial     double the job with the largest u² / (samples · cost) until k u_c ≤ 2 target · |value|
//! reading   new numbers, points × (2 k u_c / target |value|)² rounded up to a power of two; doubled on if that was not enough
//! ```
//!
//! A run that stops at the first small spread favours spreads that are small by luck: its intervals cover too little, and where the
//! spread goes with the value it is biased. So nothing of the run that decides is reported, and the reading is planned with a margin
//! that makes it rare that it has to go on. Rounds and their pieces depend on the numbers of samples alone, never on time or
//! threads.

use super::deterministic::{direct, sphere_wall};
use super::direct::{SourceJob, connection};
use super::job::{Job, Progress};
use super::paths::PathScene;
use super::receiver::Receiver;
use super::run::in_order;
use super::{ChannelEstimate, Counters, EstimateError, Estimates, Exact, PoseEstimate, REPLICATES, Stop, Watch};
use crate::geometry::world::World;
use crate::math::random::Stream;
use crate::metrology::{Budget, BudgetRow, CompensatedSum, Replicates};
use crate::plan::{Method, Plan, Transport, Visibility};
use crate::scene::{Instrument, Scene};

/// Points a replicate in the first round.
const FIRST_POINTS: u32 = 16;
/// The trial ends at this multiple of the target.
const TRIAL_RATIO: f64 = 2.0;
/// How much larger than the trial's spread the true one is taken to be: 1.44 is its upper 95 % limit at 15 degrees of freedom, and
/// a trial that ends at the first spread below its mark has a small one by choice.
const UPPER_SPREAD: f64 = 2.0;
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
        PoseState { pose, receiver, exact, active, jobs: vec![Progress::default(); self.jobs.len()], counters, standing: Standing::Trial, target_met: true }
    }

    /// The unobstructed light of a sampled source, where a formula gives it.
    fn known(&self, pose: usize, job: usize) -> Option<f64> {
        match &self.jobs[job].0 {
            Job::Source(j) if j.has_formula => {
                direct(self.scene, &self.instrument.sensor, &self.instrument.poses[pose], j.light).map(|found| found.value)
            }
            _ => None,
        }
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
    standing: Standing,
    target_met: bool,
}

/// Where a pose is on its way.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Standing {
    /// Finds out how many samples are needed.
    Trial,
    /// Takes the samples that will be reported.
    Reading,
    /// Done.
    Finished,
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
                if self.stop.samples.is_some() || self.stop.target.is_none() {
                    state.standing = Standing::Reading;
                }
                state.jobs[job].share_clear = share;
                state.jobs[job].known = self.task.known(pose, job);
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
            let stream = self.task.stream(self.seed, state.pose, w.job).child(state.standing as u64);
            let job = &self.task.jobs[w.job].0;
            job.sample(self.task.world, &state.receiver, stream, (w.first, w.count), &state.jobs[w.job])
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
        let most = self.most_points();
        let slots: Vec<usize> = (0..states.len()).filter(|&s| states[s].standing != Standing::Finished).collect();
        let shared: &[PoseState<'_>] = states;
        let verdicts = in_order(&slots, |&slot| self.judge(&shared[slot]));
        let mut requests = Vec::new();
        for (slot, verdict) in slots.into_iter().zip(verdicts) {
            let state = &mut states[slot];
            state.target_met = verdict.ratio <= 1.0;
            let before = requests.len();
            if late || verdict.ratio == 0.0 {
                // Out of time, or nothing varies.
            } else if state.standing == Standing::Trial && verdict.ratio <= TRIAL_RATIO {
                let factor = (UPPER_SPREAD * verdict.ratio).powi(2);
                for job in (0..state.jobs.len()).filter(|&j| state.active[j]) {
                    // What did not vary in the trial is read with as many points as the trial had.
                    let factor = if verdict.gain[job] > 0.0 { factor.max(1.0) } else { 1.0 };
                    let points = (f64::from(state.jobs[job].points) * factor).min(f64::from(most)) as u32;
                    requests.push((slot, job, points.next_power_of_two()));
                    state.jobs[job].restart();
                }
                state.standing = Standing::Reading;
            } else if verdict.ratio > 1.0 {
                let may_grow = |job: &usize| state.jobs[*job].points < most && verdict.gain[*job] > 0.0;
                let by_gain = |a: &usize, b: &usize| verdict.gain[*a].total_cmp(&verdict.gain[*b]).then(b.cmp(a));
                let next = (0..state.jobs.len()).filter(may_grow).max_by(by_gain);
                requests.extend(next.map(|job| (slot, job, 2 * state.jobs[job].points)));
            }
            if requests.len() == before {
                state.standing = Standing::Finished;
            }
        }
        requests
    }

    /// Points a replicate at which a target is given up.
    fn most_points(&self) -> u32 {
        let samples = (MOST_SAMPLES_IN_ALL / self.poses as u64).clamp(1 << 16, MOST_SAMPLES);
        (samples / REPLICATES as u64) as u32
    }

    /// How far from the target the worst channel is, and what each job would gain by growing.
    fn judge(&self, state: &PoseState<'_>) -> Verdict {
        let active: Vec<usize> = (0..state.jobs.len()).filter(|&j| state.active[j]).collect();
        let mut verdict = Verdict { ratio: 0.0, gain: vec![0.0; state.jobs.len()] };
        for channel in &self.task.channels(state) {
            let mut budget = Budget::new();
            let mut value = channel.exact.value;
            let mut sizes = Vec::with_capacity(active.len());
            for sampled in &channel.sampled {
                let Some(found) = Replicates::evaluate(&sampled.replicates) else { continue };
                value += found.mean;
                let missed = sampled.missed.as_ref().map_or(0.0, |(bound, _)| bound / 3f64.sqrt());
                budget.push(BudgetRow::type_a("", found.standard_uncertainty, found.degrees_of_freedom()));
                budget.push(BudgetRow::normal("", missed));
                sizes.push(found.standard_uncertainty.hypot(missed));
            }
            let expanded = budget.expanded().map_or(f64::INFINITY, |e| e.expanded_uncertainty);
            if expanded == 0.0 {
                continue;
            }
            // Without a target the budget of time alone ends the run.
            let ratio = self.stop.target.map_or(f64::INFINITY, |target| expanded / (target * value.abs()));
            verdict.ratio = verdict.ratio.max(if ratio.is_nan() { f64::INFINITY } else { ratio });
            let size = budget.combined_standard_uncertainty();
            for (&job, u) in active.iter().zip(sizes) {
                let cost = f64::from(state.jobs[job].points) * self.task.jobs[job].0.cost();
                verdict.gain[job] += (u / size).powi(2) / cost;
            }
        }
        verdict
    }
}

/// How good a pose is.
struct Verdict {
    /// Expanded uncertainty over what the target allows, of the worst channel; zero where nothing varies.
    ratio: f64,
    /// Share of the variance per sample and cost, a job each.
    gain: Vec<f64>,
}
