//! What is to be done for an instrument: its deterministic terms and its jobs.

use super::deterministic::direct;
use super::direct::{SourceJob, connection};
use super::job::{Job, Progress};
use super::paths::PathScene;
use super::receiver::Receiver;
use super::{ChannelEstimate, Counters, Exact};
use crate::geometry::world::World;
use crate::math::random::Stream;
use crate::metrology::CompensatedSum;
use crate::plan::choose::ClosedSphere;
use crate::plan::{Method, Plan, Transport, Visibility};
use crate::scene::{Instrument, Scene};

/// What is to be done for an instrument.
pub(super) struct Task<'a> {
    pub(super) scene: &'a Scene,
    pub(super) world: &'a World,
    pub(super) index: usize,
    pub(super) instrument: &'a Instrument,
    /// `weights[channel][source]` = ∫ density · responsivity.
    pub(super) weights: Vec<Vec<f64>>,
    /// Sources with a formula, and the job to fall back on where its quadrature fails.
    pub(super) formulas: Vec<(usize, Option<usize>)>,
    /// Sources to which one connection is made, and whether it is tested.
    pub(super) connections: Vec<(usize, bool)>,
    /// Channel and sum of all reflections, the same at every place of a sphere's wall.
    pub(super) spheres: Vec<(usize, f64)>,
    pub(super) jobs: Vec<(Job<'a>, String)>,
    /// Jobs that run in any case come first.
    pub(super) certain: usize,
}

impl<'a> Task<'a> {
    pub(super) fn new(scene: &'a Scene, plan: &'a Plan, world: &'a World, index: usize) -> Task<'a> {
        let instrument = &scene.instruments[index];
        let channels = &instrument.sensor.channels;
        let mut weights = vec![vec![0.0; scene.sources.len()]; channels.len()];
        let mut task_terms: Vec<&crate::plan::Term> = Vec::new();
        let sphere = ClosedSphere::of(scene);
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
                (Transport::Reflected, Method::ClosedSphere) => {
                    // The plan chose the sum because there is one; a NaN would end as an error, not as a reading.
                    let sum = sphere.as_ref().and_then(|sphere| sphere.reflected(scene, &scene.sources[s]));
                    spheres.push((c, weights[c][s] * sum.unwrap_or(f64::NAN)));
                }
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

    pub(super) fn spectral_nodes(&self) -> u64 {
        let nodes = |job: &Job<'_>| match job {
            Job::Paths { spectral, .. } => spectral.wavelengths_nm.len() as u64,
            _ => 0,
        };
        self.jobs.iter().map(|(job, _)| nodes(job)).max().unwrap_or(0)
    }

    pub(super) fn stream(&self, seed: u64, pose: usize, job: usize) -> Stream {
        let [kind, part] = self.jobs[job].0.tag();
        Stream::new(seed, &[self.index as u64, pose as u64, kind, part])
    }

    /// The deterministic terms in one pose; jobs whose quadrature failed are switched on.
    pub(super) fn start(&self, pose: usize) -> PoseState<'a> {
        let channels = self.instrument.sensor.channels.len();
        let place = self.instrument.poses[pose];
        let receiver = Receiver::new(self.scene, &self.instrument.sensor, place, !self.world.is_empty());
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
        for &(c, value) in &self.spheres {
            sums[c].add(value);
            exact[c].terms += 1;
        }
        for (exact, sum) in exact.iter_mut().zip(&sums) {
            exact.value = sum.value();
        }
        let jobs = self
            .jobs
            .iter()
            .map(|(job, _)| Progress {
                spots: match job {
                    Job::Paths { scene, .. } => scene.bright_spots(receiver.centre()),
                    _ => Vec::new(),
                },
                ..Progress::default()
            })
            .collect();
        PoseState { pose, receiver, exact, active, jobs, counters, standing: Standing::Trial, target_met: true }
    }

    /// The unobstructed light of a sampled source, where a formula gives it.
    pub(super) fn known(&self, pose: usize, job: usize) -> Option<f64> {
        match &self.jobs[job].0 {
            Job::Source(j) if j.has_formula => {
                direct(self.scene, &self.instrument.sensor, &self.instrument.poses[pose], j.light).map(|found| found.value)
            }
            _ => None,
        }
    }

    pub(super) fn channels(&self, state: &PoseState<'_>) -> Vec<ChannelEstimate> {
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
pub(super) struct PoseState<'a> {
    pub(super) pose: usize,
    pub(super) receiver: Receiver<'a>,
    pub(super) exact: Vec<Exact>,
    pub(super) active: Vec<bool>,
    pub(super) jobs: Vec<Progress>,
    pub(super) counters: Counters,
    pub(super) standing: Standing,
    pub(super) target_met: bool,
}

/// Where a pose is on its way.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Standing {
    /// Finds out how many samples are needed.
    Trial,
    /// Takes the samples that will be reported.
    Reading,
    /// Done.
    Finished,
}
