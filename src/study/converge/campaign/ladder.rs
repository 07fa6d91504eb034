//! Simulates and fits, rung by rung, within the budget.

use super::super::{ConvergeError, ConvergeOptions, FIRST_SAMPLES, LEAST_SEEDS, RUNG_FACTOR};
use super::order::nested_order;
use super::{CampaignRung, LadderKind};
use crate::calibration::{Exposures, FitOptions, Readings, fit};
use crate::characterization::campaign::{self, Light};
use crate::estimate::{Stop, Watch};
use crate::scene::Calibration;
use crate::spectrum::Density;
use crate::study::StudyWatch;
use crate::study::calibrate::{CalibrateOptions, bends, model, per_factor, prior};

/// Exposures of the lowest rung.
const FIRST_EXPOSURES: usize = 3;
/// Powers of four by which the noise is multiplied, from the first down to the last.
const NOISE_POWERS: (i32, i32) = (2, -6);
/// Noise over the largest reading beyond which readings say nothing.
const MOST_NOISE: f64 = 0.3;
/// Fits of all exposures that a seed costs: 2 in the ladder of exposures, 9 in that of noise.
const FITS_PER_SEED: f64 = 11.0;
/// Share of the budget for these two ladders, and for the rungs of the third; the rest is for its long run.
const SHARES: (f64, f64) = (0.6, 0.15);
/// Samples of the long run over those of the highest rung.
const LONG_RUN: u64 = 16;
/// Coverage factor of a band that holds 95 % of a normal distribution.
const BAND_95: f64 = 1.96;

type Spectra = Vec<(String, Density)>;
type Found = Option<(LadderKind, Vec<CampaignRung>)>;

/// Sums over channels and nodes.
#[derive(Clone, Copy, Default)]
struct Sums {
    error: f64,
    claimed: f64,
    within: f64,
    nodes: f64,
    told: u64,
}

/// Climbs the ladders of a campaign.
pub(super) struct Climber<'a> {
    calibration: &'a Calibration,
    options: &'a ConvergeOptions,
    watch: &'a StudyWatch<'a>,
    start: f64,
    seeds: u64,
    /// Light of the exposures in nested order, then that of the candidates.
    light: Spectra,
    /// How many of them the campaign takes.
    taken: usize,
    sampled: bool,
    pub(super) remarks: Vec<String>,
}

fn failed(e: impl std::fmt::Display) -> ConvergeError {
    ConvergeError::Campaign(e.to_string())
}

impl<'a> Climber<'a> {
    /// Traces the bench, and times a fit of everything.
    pub(super) fn new(
        calibration: &'a Calibration,
        options: &'a ConvergeOptions,
        watch: &'a StudyWatch<'a>,
    ) -> Result<Climber<'a>, ConvergeError> {
        let start = (watch.now)();
        let mut climber = Climber {
            calibration,
            options,
            watch,
            start,
            seeds: LEAST_SEEDS,
            light: Vec::new(),
            taken: 0,
            sampled: false,
            remarks: Vec::new(),
        };
        let light = climber
            .traced(&Stop { target: Some(1e-3), budget_seconds: Some(0.1 * options.budget_seconds), samples: None }, options.seed)?;
        climber.sampled = light.samples > 0;
        climber.taken = calibration.exposures.len();
        let candidates = light.spectra.len() - climber.taken;
        let order = nested_order(climber.taken).into_iter().chain(nested_order(candidates).into_iter().map(|i| climber.taken + i));
        climber.light = order.filter_map(|i| light.spectra.get(i).cloned()).collect();
        let begun = (watch.now)();
        let all = climber.light.clone();
        climber.fitted(&all, &all, 1.0, 0.0, options.seed)?;
        let seconds = (watch.now)() - begun;
        let left = SHARES.0 * options.budget_seconds - (begun - start);
        let affordable = if seconds > 0.0 { left / (FITS_PER_SEED * seconds) } else { f64::INFINITY };
        if affordable < LEAST_SEEDS as f64 {
            return Err(ConvergeError::Budget(format!(
                "the budget of {} s is too short: a fit takes {seconds:.2} s, and a study needs {:.0} times that; give at least {:.0} s",
                options.budget_seconds,
                FITS_PER_SEED * LEAST_SEEDS as f64 / SHARES.0,
                ((begun - start + 1.5 * FITS_PER_SEED * LEAST_SEEDS as f64 * seconds) / SHARES.0).ceil()
            )));
        }
        climber.seeds = options.seeds.min(affordable as u64).max(LEAST_SEEDS);
        if climber.seeds < options.seeds {
            climber.remarks.push(format!("{} seeds, not {}: the budget is too short for more", climber.seeds, options.seeds));
        }
        if let Some(reference) = &calibration.reference {
            climber.remarks.push(format!(
                "the beam is taken as known: what {} adds to the uncertainty is left out, `etendue calibrate` tells it",
                reference.sensor.title
            ));
        }
        if calibration.scale_uncertainty > 0.0 {
            climber.remarks.push(format!(
                "the uncertainty of the irradiance scale, {} %, is left out: it is common to all readings, and none of them makes it smaller",
                100.0 * calibration.scale_uncertainty
            ));
        }
        Ok(climber)
    }

    fn share(&self) -> f64 {
        (((self.watch.now)() - self.start) / self.options.budget_seconds).clamp(0.0, 1.0)
    }

    fn traced(&self, stop: &Stop, seed: u64) -> Result<Light, ConvergeError> {
        let watch = Watch { now: self.watch.now, progress: &|_| (self.watch.progress)(self.share()) };
        campaign::light(self.calibration, stop, seed, &watch).map_err(failed)
    }

    /// Readings of the true light, fitted as if the light were the known one.
    fn fitted(
        &self,
        truly: &[(String, Density)],
        known: &[(String, Density)],
        noise: f64,
        scale: f64,
        seed: u64,
    ) -> Result<Sums, ConvergeError> {
        let c = self.calibration;
        let mut noisy = Calibration { scale_uncertainty: 0.0, reference: None, ..c.clone() };
        noisy.noise.relative *= noise;
        noisy.noise.absolute *= noise;
        let readings = campaign::simulated(&noisy, truly, seed);
        let sensor = &c.bench.instruments[0].sensor;
        let scaled: Vec<Readings> = readings
            .iter()
            .zip(&sensor.channels)
            .map(|(r, channel)| per_factor(r, campaign::geometry_factor(sensor, channel), None))
            .collect();
        let exposures = Exposures::new(&c.nodes_nm, known).map_err(failed)?;
        let options = FitOptions {
            prior: prior(&CalibrateOptions::default(), &readings, &c.nodes_nm),
            model: model(&c.model),
            ..FitOptions::default()
        };
        let found = fit(&exposures, &scaled, &options).map_err(failed)?;
        let bends = found
            .curves
            .iter()
            .any(|curve| bends::too_coarse(&c.nodes_nm, &curve.values, &curve.standard_uncertainties(), (&curve.channel, "")).is_some());
        let mut sums = Sums { told: u64::from(bends || !found.remarks.is_empty()), ..Sums::default() };
        for (curve, channel) in found.curves.iter().zip(&sensor.channels) {
            let sought = campaign::sought(channel);
            let truth: Vec<f64> = c.nodes_nm.iter().map(|nm| sought.at(*nm)).collect();
            let peak = truth.iter().fold(0.0f64, |most, s| most.max(*s));
            for ((s, t), u) in curve.values.iter().zip(&truth).zip(bends::with_bends(&curve.values, &curve.standard_uncertainties())) {
                let u = u.hypot(scale * s);
                sums.error += ((s - t) / peak).powi(2);
                sums.claimed += (u / peak).powi(2);
                sums.within += f64::from((s - t).abs() <= BAND_95 * u);
                sums.nodes += 1.0;
            }
        }
        Ok(sums)
    }

    /// A rung: `once` runs with a seed and gives its sums and the samples that it took.
    fn rung(&self, of: CampaignRung, once: &dyn Fn(u64) -> Result<(Sums, u64), ConvergeError>) -> Result<CampaignRung, ConvergeError> {
        let (begun, cpu) = ((self.watch.now)(), (self.watch.cpu)());
        let mut sums = Sums::default();
        let mut samples = 0;
        for seed in 1..=self.seeds {
            let (one, taken) = once(self.options.seed.wrapping_add(seed))?;
            sums = Sums {
                error: sums.error + one.error,
                claimed: sums.claimed + one.claimed,
                within: sums.within + one.within,
                nodes: sums.nodes + one.nodes,
                told: sums.told + one.told,
            };
            samples = taken;
            (self.watch.progress)(self.share());
        }
        let n = self.seeds as f64;
        Ok(CampaignRung {
            seeds: self.seeds,
            samples,
            cpu_seconds: ((self.watch.cpu)() - cpu) / n,
            wall_seconds: ((self.watch.now)() - begun) / n,
            error: (sums.error / sums.nodes).sqrt(),
            claimed: (sums.claimed / sums.nodes).sqrt(),
            within_95: sums.within / sums.nodes,
            told: sums.told,
            ..of
        })
    }

    fn blank(&self, parameter: f64, exposures: usize, noise_factor: f64) -> CampaignRung {
        CampaignRung {
            parameter,
            exposures,
            noise_factor,
            samples: 0,
            seeds: 0,
            cpu_seconds: 0.0,
            wall_seconds: 0.0,
            error: 0.0,
            claimed: 0.0,
            within_95: 0.0,
            told: 0,
        }
    }

    /// Whether the budget is used up; then it is said.
    fn over(&mut self, kind: LadderKind) -> bool {
        let over = (self.watch.now)() - self.start > self.options.budget_seconds;
        if over {
            self.remarks.push(format!("{}: ended by the budget of {} s", kind.name(), self.options.budget_seconds));
        }
        over
    }

    /// 3, 6, 12 … all exposures.
    pub(super) fn exposures(&mut self) -> Result<Found, ConvergeError> {
        let all = self.light.len();
        let mut counts: Vec<usize> =
            std::iter::successors(Some(FIRST_EXPOSURES), |n| Some(2 * n)).take_while(|n| 3 * n <= 2 * all).collect();
        counts.push(all);
        if counts.len() < 2 {
            self.remarks.push(format!("exposures: there are {all} and no candidates; add `candidates: […]` for a ladder"));
            return Ok(None);
        }
        let mut rungs = Vec::new();
        for count in counts {
            if self.over(LadderKind::Exposures) {
                break;
            }
            let light = self.light[..count].to_vec();
            let once = |seed| Ok((self.fitted(&light, &light, 1.0, 0.0, seed)?, 0));
            rungs.push(self.rung(self.blank(count as f64, count, 1.0), &once)?);
        }
        Ok(Some((LadderKind::Exposures, rungs)))
    }

    /// The noise of the file times powers of four.
    pub(super) fn noise(&mut self) -> Result<Found, ConvergeError> {
        let light = self.light[..self.taken].to_vec();
        let readings = campaign::simulated(self.calibration, &light, self.options.seed);
        let largest = readings.iter().flat_map(|r| &r.values).fold(0.0f64, |most, y| most.max(y.abs()));
        let squares: Vec<f64> = readings.iter().flat_map(|r| &r.standard_uncertainties).map(|u| u * u).collect();
        let noise = (squares.iter().sum::<f64>() / squares.len() as f64).sqrt() / largest;
        if noise == 0.0 {
            self.remarks.push("noise: the file states none".to_owned());
            return Ok(None);
        }
        let mut rungs = Vec::new();
        for power in (NOISE_POWERS.1..=NOISE_POWERS.0).rev() {
            let factor = 4f64.powi(power);
            if factor * noise > MOST_NOISE {
                continue;
            }
            if self.over(LadderKind::Noise) {
                break;
            }
            let once = |seed| Ok((self.fitted(&light, &light, factor, 0.0, seed)?, 0));
            rungs.push(self.rung(self.blank(factor * noise, self.taken, factor), &once)?);
        }
        Ok(Some((LadderKind::Noise, rungs)))
    }

    /// Samples of the bench; nothing where formulas serve.
    pub(super) fn samples(&mut self) -> Result<Found, ConvergeError> {
        if !self.sampled {
            self.remarks.push("samples: the light of the bench is exact, by formulas; run time is that of the fit".to_owned());
            return Ok(None);
        }
        let at = |samples: u64| Stop { target: None, budget_seconds: None, samples: Some(samples) };
        let begun = (self.watch.now)();
        let mut counts = vec![FIRST_SAMPLES];
        let mut samples = FIRST_SAMPLES;
        // The ladder ends where tracing one more rung for every seed would take its share.
        loop {
            let rung = (self.watch.now)();
            self.traced(&at(samples), self.options.seed)?;
            let took = (self.watch.now)() - rung;
            let next = samples.saturating_mul(RUNG_FACTOR);
            let cost = RUNG_FACTOR as f64 * took * (self.seeds as f64).max(LONG_RUN as f64);
            if next > self.options.most_samples || rung - begun + cost > SHARES.1 * self.options.budget_seconds || next > 1 << 24 {
                break;
            }
            samples = next;
            counts.push(next);
        }
        let truly: Spectra = self.traced(&at(samples.saturating_mul(LONG_RUN)), self.options.seed)?.spectra;
        let truly = &truly[..self.taken];
        let mut rungs = Vec::new();
        for count in counts {
            if self.over(LadderKind::Samples) {
                break;
            }
            let once = |seed| {
                let light = self.traced(&at(count), seed)?;
                let known = &light.spectra[..self.taken];
                Ok((self.fitted(truly, known, 1.0, light.relative_uncertainty, seed)?, light.samples))
            };
            rungs.push(self.rung(self.blank(count as f64, self.taken, 1.0), &once)?);
        }
        Ok(Some((LadderKind::Samples, rungs)))
    }
}
