//! How many samples for which job: a trial finds out, and a run with numbers of its own gives the reading.
//!
//! ```text
//! trial     double the job with the largest u² / (samples · cost) until k u_c ≤ 2 target · |value|
//! reading   new numbers, points × (2 k u_c / target |value|)² rounded up to a power of two, 64 or more; doubled on if that was not enough
//! ```
//!
//! A run that stops at the first small spread favours spreads that are small by luck: its intervals cover too little, and where the
//! spread goes with the value it is biased. So nothing of the run that decides is reported, and the reading is planned with a margin
//! that makes it rare that it has to go on. Only a run that never gets there reports its trial: out of time, out of samples, or when
//! nothing was found at all; it says that the target was not met. Rounds and their pieces depend on the numbers of samples alone, never on time or
//! threads.

use super::campaign::Tally;
use super::job::Piece;
use super::journal::{Answer, Journal, PieceKey};
use super::run::in_order;
use super::task::{PoseState, Standing, Task};
use super::{Counters, EstimateError, PoseEstimate, REPLICATES, Stop, Watch};
use crate::metrology::{Budget, BudgetRow, Replicates};

/// Points a replicate in the first round.
const FIRST_POINTS: u32 = 16;
/// Points a replicate of a reading, at least, of what varied in the trial: means of fewer are skewed, where a path may come close to a
/// lamp, and 16 of them cover less than Student's distribution says.
const LEAST_READING_POINTS: u32 = 128;
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
/// Samples a job and pose at which a target is given up, for one pose and for many.
const MOST_SAMPLES: u64 = 1 << 26;
const MOST_SAMPLES_IN_ALL: u64 = 1 << 30;

/// Poses that are estimated together.
pub(super) struct Batch<'a> {
    pub(super) task: &'a Task<'a>,
    pub(super) stop: &'a Stop,
    pub(super) seed: u64,
    pub(super) watch: &'a Watch<'a>,
    pub(super) journal: &'a dyn Journal,
    pub(super) deadline: Option<f64>,
    /// The round after which a clock ended the run that this one repeats; the present clock does not count then.
    pub(super) last_round: Option<u32>,
    /// Poses that earlier batches have finished, and poses in all.
    pub(super) done: usize,
    pub(super) poses: usize,
}

/// What came of a batch.
pub(super) struct Batched {
    pub(super) estimates: Vec<PoseEstimate>,
    pub(super) counters: Counters,
    pub(super) rounds: u32,
}

/// A piece of work: points `first .. first + count` of a job in a pose.
struct Work {
    /// Number of the piece in the run.
    index: u64,
    slot: usize,
    job: usize,
    first: u32,
    count: u32,
}

impl Batch<'_> {
    pub(super) fn run(&self, poses: &[usize], tally: &mut Tally) -> Result<Batched, EstimateError> {
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
                state.jobs[job].brightest = self.task.jobs[job].0.brightest(&state.receiver, stream);
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
        let mut rounds = 0;
        loop {
            let round = (self.watch.now)();
            self.sample(&mut states, &requests, tally)?;
            let round = (self.watch.now)() - round;
            rounds += 1;
            if self.stop.samples.is_some() || tally.missing > 0 {
                break;
            }
            let late = match self.last_round {
                Some(last) => rounds >= last,
                // A round doubles a job: the next one costs up to twice this one.
                None => self.deadline.is_some_and(|d| (self.watch.now)() + 2.0 * round > d),
            };
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
        if tally.missing > 0 {
            return Ok(Batched { estimates: Vec::new(), counters, rounds });
        }
        let estimates = states
            .iter()
            .map(|state| {
                counters.add(&state.counters);
                PoseEstimate { channels: self.task.channels(state), target_met: state.target_met, seconds }
            })
            .collect();
        Ok(Batched { estimates, counters, rounds })
    }

    /// Brings jobs to a number of points each.
    fn sample(&self, states: &mut [PoseState<'_>], requests: &[(usize, usize, u32)], tally: &mut Tally) -> Result<(), EstimateError> {
        let most = PIECE / REPLICATES as u32;
        let mut work = Vec::new();
        for &(slot, job, points) in requests {
            let mut first = states[slot].jobs[job].points;
            while first < points {
                let count = most.min(points - first);
                work.push(Work { index: 0, slot, job, first, count });
                first += count;
            }
        }
        self.number(&mut work, tally);
        // In portions, so that the sums of a long round need not all be held at once; the order stays that of the work.
        for portion in work.chunks(PORTION) {
            self.sample_portion(states, portion, tally)?;
        }
        Ok(())
    }

    /// Numbers pieces on from those before. The pieces of a job follow one another, so that every n-th piece is every n-th of each job:
    /// shares of a run cost alike.
    fn number(&self, work: &mut [Work], tally: &mut Tally) {
        let mut next = vec![0; self.task.jobs.len()];
        for w in work.iter() {
            next[w.job] += 1;
        }
        for next in &mut next {
            tally.pieces += std::mem::replace(next, tally.pieces);
        }
        for w in work {
            w.index = next[w.job];
            next[w.job] += 1;
        }
    }

    /// What a piece brings: as the journal knows it, or sampled; `None` if that is for another run to do.
    fn piece(&self, state: &PoseState<'_>, w: &Work) -> Result<Option<Piece>, EstimateError> {
        let name = || self.task.instrument.name.clone();
        let job = &self.task.jobs[w.job].0;
        let key = PieceKey {
            instrument: self.task.index as u64,
            pose: state.pose as u64,
            reading: state.standing == Standing::Reading,
            job: w.job as u64,
            first: w.first,
            count: w.count,
        };
        match self.journal.ask(w.index, &key) {
            Answer::Elsewhere => Ok(None),
            Answer::Known(piece) if piece.fits(job.width(), w.count) => Ok(Some(piece)),
            Answer::Known(_) => Err(EstimateError::Foreign { instrument: name() }),
            Answer::Wanted => {
                let stream = self.task.stream(self.seed, state.pose, w.job).child(state.standing as u64);
                let piece = job.sample(self.task.world, &state.receiver, stream, (w.first, w.count), &state.jobs[w.job]);
                let piece = piece.map_err(|_| EstimateError::Endless { instrument: name() })?;
                self.journal.record(&key, &piece);
                Ok(Some(piece))
            }
        }
    }

    fn sample_portion(&self, states: &mut [PoseState<'_>], work: &[Work], tally: &mut Tally) -> Result<(), EstimateError> {
        let shared: &[PoseState<'_>] = states;
        let pieces = in_order(work, |w| self.piece(&shared[w.slot], w));
        for (w, piece) in work.iter().zip(pieces) {
            let Some(piece) = piece? else {
                tally.missing += 1;
                continue;
            };
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
                    let points = if verdict.gain[job] > 0.0 { points.max(LEAST_READING_POINTS) } else { points };
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
                budget.push(BudgetRow::type_a("", found.standard_uncertainty, found.degrees_of_freedom));
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
            // Where nothing was found nothing is fixed, and a share of zero says nothing.
            let hopeless = self.stop.target.is_some() && fixed.combined_standard_uncertainty() > 0.0 && over(&fixed) >= 1.0;
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
