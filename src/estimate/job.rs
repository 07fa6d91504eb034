//! What is sampled: a job in a pose adds up geometric sums for each replicate, and can be continued at any time.

use super::direct::{self, SourceJob};
pub(super) use super::journal::Piece;
use super::paths::{BrightSpot, PathScene, trace};
use super::receiver::Receiver;
use super::sky;
use super::{Counters, EstimateError, REPLICATES, Sampled};
use crate::geometry::world::World;
use crate::math::random::Stream;
use crate::metrology::Replicates;
use crate::plan::spectral::SpectralPlan;

/// Confidence 95 %: if N independent trials all had the same outcome, the other one has a probability below 3/N.
const RULE_OF_THREE: f64 = 3.0;

/// What is sampled for an instrument.
pub(super) enum Job<'a> {
    /// Direct light of one source.
    Source(SourceJob<'a>),
    /// Direct light of the environment; the source's index.
    Sky { source: usize },
    /// Reflected light of all sources.
    Paths { scene: PathScene<'a>, spectral: &'a SpectralPlan, accepted_sr: f64 },
}

/// How a job goes in one pose.
#[derive(Clone, Debug, Default)]
pub(super) struct Progress {
    /// Points a replicate so far.
    pub(super) points: u32,
    /// `REPLICATES` × width sums.
    pub(super) sums: Vec<f64>,
    /// Connections that were made, and how many were clear.
    pub(super) connections: u64,
    pub(super) clear: u64,
    /// Sum of what all connections would have brought, had they been clear; of paths, for each group of sources.
    pub(super) potential: Vec<f64>,
    /// Share of the light that a pilot run found clear.
    pub(super) share_clear: f64,
    /// The unobstructed light by its formula, where there is one.
    pub(super) known: Option<f64>,
    /// The most that a connection to the source brings, taken as if it were accepted; zero for what is no source with an area.
    pub(super) brightest: f64,
    /// Bright spots that paths may overlook.
    pub(super) spots: Vec<BrightSpot>,
}

impl Progress {
    /// Forgets all samples, but not what is known beforehand.
    pub(super) fn restart(&mut self) {
        *self = Progress {
            share_clear: self.share_clear,
            known: self.known,
            brightest: self.brightest,
            spots: std::mem::take(&mut self.spots),
            ..Progress::default()
        };
    }
}

impl Job<'_> {
    /// Sums that a replicate adds up.
    pub(super) fn width(&self) -> usize {
        match self {
            Job::Source(_) | Job::Sky { .. } => 1,
            Job::Paths { scene, .. } => scene.width(),
        }
    }

    /// Relative time of a sample: a path against a connection.
    pub(super) fn cost(&self) -> f64 {
        match self {
            Job::Source(_) | Job::Sky { .. } => 1.0,
            Job::Paths { .. } => 5.0,
        }
    }

    /// Its own branch of the random numbers.
    pub(super) fn tag(&self) -> [u64; 2] {
        match self {
            Job::Source(job) => [1, job.source as u64],
            Job::Sky { source } => [2, *source as u64],
            Job::Paths { .. } => [3, 0],
        }
    }

    /// A first look at what is clear, with numbers of its own, so that the estimate stays unbiased.
    pub(super) fn pilot(&self, world: &World, receiver: &Receiver<'_>, stream: Stream) -> (f64, Counters) {
        match self {
            Job::Source(job) => match job.looked_for(receiver) {
                Some(lit) => sky::pilot(world, Some(lit), receiver, stream),
                None => direct::pilot(job, world, receiver, stream),
            },
            Job::Sky { .. } => sky::pilot(world, None, receiver, stream),
            Job::Paths { .. } => (0.0, Counters::default()),
        }
    }

    /// The most that a connection brings, whether or not the acceptance takes it, per unit of density.
    pub(super) fn brightest(&self, receiver: &Receiver<'_>, stream: Stream) -> f64 {
        match self {
            Job::Source(job) => direct::brightest(job, receiver, stream),
            _ => 0.0,
        }
    }

    /// The points `first .. first + count` of every replicate.
    pub(super) fn sample(
        &self,
        world: &World,
        receiver: &Receiver<'_>,
        stream: Stream,
        (first, count): (u32, u32),
        progress: &Progress,
    ) -> Result<Piece, EstimateError> {
        match self {
            Job::Source(job) => Ok(match job.looked_for(receiver) {
                Some(lit) => sky::sample(world, Some(lit), receiver, stream, (first, count), progress.share_clear),
                None => direct::sample(job, world, receiver, stream, (first, count), progress.share_clear, progress.known),
            }),
            Job::Sky { .. } => Ok(sky::sample(world, None, receiver, stream, (first, count), progress.share_clear)),
            Job::Paths { scene, .. } => {
                let streams: [Stream; REPLICATES] = std::array::from_fn(|r| stream.child(r as u64));
                let out = trace(scene, receiver, &streams, (first, count));
                if out.endless {
                    return Err(EstimateError::Endless { instrument: String::new() });
                }
                let samples = u64::from(count) * REPLICATES as u64;
                Ok(Piece {
                    sums: out.sums,
                    connections: 0,
                    clear: 0,
                    potential: out.potential,
                    counters: Counters { rays: out.rays, samples, escaped_paths: out.escaped, ..Counters::default() },
                })
            }
        }
    }

    /// What a channel makes of it. `direct_weights[source]` is the integral of density and responsivity, zero where left out.
    pub(super) fn seen_by(&self, progress: &Progress, channel: usize, direct_weight: &dyn Fn(usize) -> f64, label: &str) -> Sampled {
        let samples = u64::from(progress.points) * REPLICATES as u64;
        let mut replicates = [0.0; REPLICATES];
        if progress.points == 0 {
            return Sampled { label: label.to_owned(), replicates, samples, missed: None, spectral_residual: 0.0 };
        }
        let n = f64::from(progress.points);
        let width = self.width();
        let (scale, spectral_residual) = match self {
            Job::Source(SourceJob { source, .. }) | Job::Sky { source } => {
                let weight = direct_weight(*source);
                for (value, sum) in replicates.iter_mut().zip(&progress.sums) {
                    *value = sum / n * weight;
                }
                (weight, 0.0)
            }
            Job::Paths { scene, spectral, .. } => {
                let weights = &spectral.weights[channel];
                for (value, sums) in replicates.iter_mut().zip(progress.sums.chunks_exact(width)) {
                    for (group, weight) in weights.iter().enumerate() {
                        // Divided first: a sum of many paths times a large radiance stays in range.
                        *value += scene.group(sums, group).iter().zip(weight).map(|(s, w)| s / n * w).sum::<f64>();
                    }
                }
                (weights.iter().flatten().sum(), spectral.residual)
            }
        };
        let missed = match self {
            Job::Paths { scene, spectral, accepted_sr } => missed_by_paths(scene, &spectral.weights[channel], *accepted_sr, progress),
            _ => self.missed(progress).map(|(bound, why)| (bound * scale, why)),
        };
        let missed = missed.filter(|(bound, _)| *bound > 0.0);
        Sampled { label: label.to_owned(), replicates, samples, missed, spectral_residual }
    }

    /// Mean of the replicates and its standard uncertainty from their spread, summed over groups and nodes, per unit of density.
    fn mean_and_spread(&self, progress: &Progress) -> (f64, f64) {
        let n = f64::from(progress.points);
        let means: Vec<f64> = progress.sums.chunks_exact(self.width()).map(|sums| sums.iter().sum::<f64>() / n).collect();
        Replicates::evaluate(&means).map_or((0.0, 0.0), |found| (found.mean, found.standard_uncertainty))
    }

    /// What all connections may have missed, per unit of density.
    fn missed(&self, progress: &Progress) -> Option<(f64, String)> {
        let samples = f64::from(progress.points) * REPLICATES as f64;
        let potential: f64 = progress.potential.iter().sum();
        match self {
            Job::Paths { .. } => None,
            // Where nothing blocks, connections vary without gaps; that none was accepted says only that the acceptance is narrow.
            Job::Source(SourceJob { tested: false, .. }) if progress.connections > 0 => None,
            Job::Source(_) | Job::Sky { .. } => {
                let n = progress.connections as f64;
                if progress.connections == 0 {
                    return match self {
                        // A part of a large source that fills a narrow acceptance is hit seldom and brings much: more than the acceptance
                        // takes in all, which is the most that there can be.
                        // Without extent, it brings what the brightest connection would, if the acceptance took it.
                        Job::Source(job) => {
                            let rare = RULE_OF_THREE / samples;
                            let bound = if job.largest > 0.0 {
                                (rare * job.largest.max(progress.brightest)).min(job.largest)
                            } else {
                                rare * progress.brightest
                            };
                            (bound > 0.0).then(|| (bound, format!("no way to the source in {samples} samples")))
                        }
                        _ => None,
                    };
                }
                let bound = RULE_OF_THREE / n * potential / samples;
                if progress.clear == 0 {
                    Some((bound, format!("no clear connection in {n}")))
                } else if progress.clear == progress.connections {
                    Some((bound, format!("no blocked connection in {n}")))
                } else if self.mean_and_spread(progress).1 < potential / samples / samples {
                    // The strata quantise the share that is clear. One replicate of sixteen that differs by one connection would spread
                    // more than this: they all found the same count, which says no more than that a different one is rare.
                    Some((bound, format!("every replicate found the same share of {n} connections clear")))
                } else {
                    None
                }
            }
        }
    }
}

/// What paths may have missed, as a channel weighs it, group by group: light of a source that no path found, or that every replicate
/// found alike, and bright spots beside lamps.
fn missed_by_paths(scene: &PathScene<'_>, weights: &[Vec<f64>], accepted_sr: f64, progress: &Progress) -> Option<(f64, String)> {
    let samples = f64::from(progress.points) * REPLICATES as f64;
    let n = f64::from(progress.points);
    // As if every path had found the brightest reflecting surface.
    let brightest = scene.survival.iter().copied().fold(0.0, f64::max) * accepted_sr;
    let mut bound = 0.0;
    let mut reasons: Vec<String> = Vec::new();
    let mut add = |more: f64, why: String| {
        bound += more;
        if more > 0.0 && !reasons.contains(&why) {
            reasons.push(why);
        }
    };
    for (group, weight) in weights.iter().enumerate() {
        let seen = |sums: &[f64]| scene.group(sums, group).iter().zip(weight).map(|(s, w)| s / n * w).sum::<f64>();
        let values: Vec<f64> = progress.sums.chunks_exact(scene.width()).map(seen).collect();
        let Some(found) = Replicates::evaluate(&values) else { continue };
        let total: f64 = weight.iter().sum();
        if found.mean == 0.0 {
            let potential = progress.potential.get(group).copied().unwrap_or(0.0) / samples;
            let scale = if potential > 0.0 { potential } else { brightest };
            add(RULE_OF_THREE / samples * scale * total, format!("no path out of {samples} found light of a source"));
        } else if found.standard_uncertainty < found.mean / samples {
            add(RULE_OF_THREE / samples * found.mean, format!("every replicate found the same in {samples} paths"));
        }
    }
    let weight = |group: u32| weights[group as usize].iter().sum::<f64>();
    for spot in progress.spots.iter().filter(|spot| spot.is_unresolved(samples)) {
        add(spot.bound * weight(spot.group), "a bright spot beside a lamp that too few paths can have found".to_owned());
    }
    (bound > 0.0).then(|| (bound, reasons.join("; ")))
}
