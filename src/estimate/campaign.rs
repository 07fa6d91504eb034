//! How many samples for which job: a trial finds out, and a run with numbers of its own gives the reading.
//!
//! ```text
//! trial     double the job with the largest u² / (samples · cost) until k u_c ≤ 2 target · |value|
//! reading   new numbers, points × (2 k u_c / target |value|)² rounded up to a power of two; doubled on if that was not enough
//! ```
//!
//! A run that stops at the first small spread favours spreads that are small by luck: its intervals cover too little, and where the
//! spread goes with the value it is biased. So nothing of the run that decides is reported, and the reading is planned with a margin
//! that makes it rare that it has to go on. Only a run that never gets there reports its trial: out of time, out of samples, or when
//! nothing was found at all; it says that the target was not met. Rounds and their pieces depend on the numbers of samples alone, never on time or
//! threads.

use super::run::in_order;
use super::task::{PoseState, Standing, Task};
use super::{Counters, EstimateError, Estimates, PoseEstimate, REPLICATES, Stop, Watch};
use crate::geometry::world::World;
use crate::metrology::{Budget, BudgetRow, Replicates};
use crate::plan::Plan;
use crate::scene::Scene;

/// Points a replicate in the first round.
const FIRST_POINTS: u32 = 16;
/// Points a replicate after which a search that has found nothing ends, with the bound of what it may have missed.
const MOST_BLIND_POINTS: u32 = 1 << 16;
/// The trial ends at this multiple of the target.
const TRIAL_RATIO: f64 = 2.0;
/// How much larger than the trial's spread the true one is taken to be: 1.44 is its upper 95 % limit at 15 degrees of freedom, and
/// a trial that ends at the first spread below its mark has a small one by choice.
const UPPER_SPREAD: f64 = 2.0;
/// Points of all replicates in one piece of work.
const PIECE: u32 = 16_384;
/// Pieces of work whose sums are held at once.
const PORTION: usize = 1024;
/// Poses that are estimated together; bounds the memory for sums.
const BATCH: usize = 2048;
/// Samples a job and pose at which a target is given up, for one pose and for many.
const MOST_SAMPLES: u64 = 1 << 26;
const MOST_SAMPLES_IN_ALL: u64 = 1 << 30;

/// Estimates every term of a plan, for every pose of every instrument.
pub fn estimate(scene: &Scene, plan: &Plan, stop: &Stop, seed: u64, watch: &Watch<'_>) -> Result<Estimates, EstimateError> {
    let world = if plan.needs_rays { World::new(scene.elements.iter().map(|e| &e.shape)) } else { World::default() };
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
            let batch = Batch { task: &task, stop, seed, watch, deadline, done, poses: all };
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

/// Poses that are estimated together.
struct Batch<'a> {
    task: &'a Task<'a>,
    stop: &'a Stop,
    seed: u64,
    watch: &'a Watch<'a>,
    deadline: Option<f64>,
    /// Poses that earlier batches have finished, and poses in all.
    done: usize,
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
            let finished = states.iter().filter(|s| s.standing == Standing::Finished).count();
            (self.watch.progress)((self.done + finished) as f64 / self.poses as f64);
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
        // In portions, so that the sums of a long round need not all be held at once; the order stays that of the work.
        for portion in work.chunks(PORTION) {
            self.sample_portion(states, portion)?;
        }
        Ok(())
    }

    fn sample_portion(&self, states: &mut [PoseState<'_>], work: &[Work]) -> Result<(), EstimateError> {
        let shared: &[PoseState<'_>] = states;
        let pieces = in_order(work, |w| {
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
            progress.potential.resize(piece.potential.len(), 0.0);
            progress.potential.iter_mut().zip(&piece.potential).for_each(|(sum, more)| *sum += more);
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
                let most = if verdict.blind { most.min(MOST_BLIND_POINTS) } else { most };
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
        let mut verdict = Verdict { ratio: 0.0, gain: vec![0.0; state.jobs.len()], blind: true };
        for channel in &self.task.channels(state) {
            let mut budget = Budget::new();
            // What no number of samples lowers.
            let mut fixed = Budget::new();
            fixed.push(BudgetRow::rectangular("", channel.exact.quadrature_error));
            let mut value = channel.exact.value;
            let mut sizes = Vec::with_capacity(active.len());
            for sampled in &channel.sampled {
                let Some(found) = Replicates::evaluate(&sampled.replicates) else { continue };
                value += found.mean;
                let missed = sampled.missed.as_ref().map_or(0.0, |(bound, _)| bound / 3f64.sqrt());
                budget.push(BudgetRow::type_a("", found.standard_uncertainty, found.degrees_of_freedom()));
                budget.push(BudgetRow::normal("", missed));
                fixed.push(BudgetRow::rectangular("", sampled.spectral_residual * found.mean.abs()));
                sizes.push(found.standard_uncertainty.hypot(missed));
            }
            if budget.combined_standard_uncertainty() == 0.0 {
                continue;
            }
            // Without a target the budget of time alone ends the run.
            let over = |rows: &Budget| {
                let expanded = rows.expanded().map_or(f64::INFINITY, |e| e.expanded_uncertainty);
                let ratio = self.stop.target.map_or(f64::INFINITY, |target| expanded / (target * value.abs()));
                if ratio.is_nan() { f64::INFINITY } else { ratio }
            };
            let size = budget.combined_standard_uncertainty();
            let hopeless = self.stop.target.is_some() && over(&fixed) >= 1.0;
            budget.rows.extend(fixed.rows);
            verdict.ratio = verdict.ratio.max(over(&budget));
            verdict.blind &= value == 0.0;
            if hopeless {
                // No sample would help this channel.
                continue;
            }
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
    /// Nothing has been found at all: more samples only lower the bound of what was missed.
    blind: bool,
}
