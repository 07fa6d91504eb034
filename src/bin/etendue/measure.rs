//! `etendue measure SCENE`: read every instrument.

use std::path::PathBuf;
use std::time::Instant;

use etendue::estimate::journal::{Journal, Share, Unrecorded};
use etendue::estimate::run::with_threads;
use etendue::estimate::{EstimateError, Stop, Watch, contribute};
use etendue::measurement::{CheckpointHeader, Measurement, Provenance, add_ideal, measure_with};
use etendue::plan::Plan;
use etendue::scene::Scene;

use crate::{Failure, checkpoint, complain, disk, explain, output, print};

/// Read every instrument of a scene.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The scene file.
    scene: String,
    /// Stop when the expanded uncertainty (95 %) is at most this share of each reading, e.g. 0.1% or 0.001 [default: 1%].
    #[arg(long, value_name = "SHARE", value_parser = share, allow_hyphen_values = true, conflicts_with = "samples")]
    target: Option<f64>,
    /// Start no further round of samples after this time, e.g. 2s, 500ms or 1min.
    #[arg(long, value_name = "TIME", value_parser = seconds, allow_hyphen_values = true, conflicts_with = "samples")]
    budget: Option<f64>,
    /// Take this many samples for each sampled contribution, rounded up to 16 times a power of two.
    #[arg(long, value_name = "N", value_parser = whole(1, 1 << 32), allow_hyphen_values = true)]
    samples: Option<u64>,
    /// Seed of the random numbers: the same seed gives the same bits.
    #[arg(long, value_name = "N", value_parser = whole(0, u64::MAX), allow_hyphen_values = true, default_value_t = 0)]
    seed: u64,
    /// Threads; as many as there are cores by default. Readings do not depend on it.
    #[arg(long, value_name = "N", value_parser = whole(1, 1024), allow_hyphen_values = true)]
    threads: Option<u64>,
    /// Write finished work to this file, and go on from there if it exists: a run that was killed and is started again with the same
    /// command has the bits of one that was not. At most the work of --checkpoint-every is lost. The file stays when the run has ended; with it the
    /// same command reads again without sampling. Not with --budget.
    #[arg(long, value_name = "FILE")]
    checkpoint: Option<PathBuf>,
    /// Hold finished work back for at most this long before it goes to the checkpoint.
    #[arg(long, value_name = "TIME", value_parser = seconds, allow_hyphen_values = true, default_value = "1s", requires = "checkpoint")]
    checkpoint_every: f64,
    /// Leave out what ideal instruments would indicate, which takes up to as long again for instruments that are not ideal.
    #[arg(long)]
    no_ideal: bool,
    /// Do only this share of the work, such as 2/3, and write it to the file of --checkpoint, for `etendue merge` to put
    /// together; needs --samples.
    #[arg(long, value_name = "k/K", value_parser = part, conflicts_with_all = ["format", "out"])]
    shard: Option<Share>,
    #[command(flatten)]
    output: output::Options,
    #[command(flatten)]
    plan: explain::Options,
    /// The folder that no file may lie outside of; by default the one that holds `scenes/` and `sensors/`, else the scene's own.
    #[arg(long, value_name = "DIR")]
    root: Option<String>,
}

pub(crate) fn share(given: &str) -> Result<f64, String> {
    let (number, scale) = match given.trim().strip_suffix('%') {
        Some(percent) => (percent, 0.01),
        None => (given.trim(), 1.0),
    };
    match number.trim().parse::<f64>() {
        // Whoever writes 5 means 5 %.
        Ok(x) if scale == 1.0 && x >= 1.0 && x.is_finite() => {
            Err(format!("{} means {} %; write {}%", number.trim(), 100.0 * x, number.trim()))
        }
        Ok(x) if x > 0.0 && x.is_finite() => Ok(x * scale),
        _ => Err("a positive share such as 0.1% or 0.001".to_owned()),
    }
}

pub(crate) fn whole(lowest: u64, highest: u64) -> impl Fn(&str) -> Result<u64, String> + Clone {
    move |given| match given.trim().parse() {
        Ok(n) if (lowest..=highest).contains(&n) => Ok(n),
        _ => Err(format!("a whole number, {lowest} to {highest}")),
    }
}

pub(crate) fn seconds(given: &str) -> Result<f64, String> {
    let given = given.trim();
    let units = [("ms", 1e-3), ("min", 60.0), ("s", 1.0), ("h", 3600.0)];
    let found = units.iter().find_map(|(unit, scale)| Some((given.strip_suffix(unit)?, *scale)));
    match found.and_then(|(number, scale)| Some((number.trim().parse::<f64>().ok()?, scale))) {
        Some((x, scale)) if x > 0.0 && x.is_finite() => Ok(x * scale),
        _ => Err("a positive time with its unit, such as 2s, 500ms or 1min".to_owned()),
    }
}

fn part(given: &str) -> Result<Share, String> {
    let numbers = given.trim().split_once('/').and_then(|(number, of)| Some((number.trim().parse().ok()?, of.trim().parse().ok()?)));
    let share = numbers.and_then(|(number, of)| Share::new(number, of));
    share.ok_or_else(|| "a share k/K with 1 ≤ k ≤ K, such as 2/3: the shares 1/3, 2/3 and 3/3 are the whole".to_owned())
}

/// Says which cameras have no region to be read; with nothing else to read that is a failure.
fn regions_to_read(scene: &Scene, file: &str) -> Result<(), Failure> {
    let help = format!(
        "`etendue expose {file} --out DIR` takes the picture; `regions: {{ \"patch\": (x: 10, y: 12, width: 8, height: 8) }}` is read here"
    );
    let without: Vec<&str> = scene.cameras.iter().filter(|c| c.regions.is_empty()).map(|c| c.name.as_str()).collect();
    if scene.instruments.is_empty() && without.len() == scene.cameras.len() {
        let message = "error: the scene has cameras without regions and no instrument, so there is nothing to read";
        return Err(Failure::Input(format!("{message}\n  = help: {help}")));
    }
    for name in without {
        complain(&format!("note: the camera `{name}` has no region and is not read\n  = help: {help}"));
    }
    Ok(())
}

/// A scene, how it is planned, and what makes a run of it.
pub(crate) struct Run<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) plan: &'a Plan,
    pub(crate) provenance: Provenance,
    pub(crate) threads: Option<u64>,
    /// Whether to say what ideal instruments would indicate.
    pub(crate) ideal: bool,
}

impl Run<'_> {
    /// Reads every instrument, with a bar that shows how far it is.
    pub(crate) fn measure(&self, journal: &dyn Journal) -> Result<Measurement, EstimateError> {
        let Provenance { stop, seed, .. } = &self.provenance;
        let mut measured = self.watched(|watch| {
            let mut measured = measure_with(self.scene, self.plan, stop, *seed, watch, journal)?;
            if self.ideal {
                add_ideal(&mut measured, self.scene, self.plan, watch)?;
            }
            Ok(measured)
        });
        if let Ok(measurement) = &mut measured {
            measurement.provenance.scene_file.clone_from(&self.provenance.scene_file);
            measurement.provenance.root.clone_from(&self.provenance.root);
        }
        measured
    }

    fn watched<R: Send>(&self, work: impl FnOnce(&Watch<'_>) -> R + Send) -> R {
        let bar = output::progress_bar();
        let start = Instant::now();
        let watch = Watch { now: &|| start.elapsed().as_secs_f64(), progress: &|share| bar.set_position((1000.0 * share) as u64) };
        let threads = self.threads.and_then(|n| usize::try_from(n).ok());
        let result = with_threads(threads, || work(&watch));
        bar.finish_and_clear();
        result
    }
}

/// What a run failed of, in words.
pub(crate) fn failed(e: &EstimateError) -> Failure {
    Failure::Run(format!("error: {e}"))
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    arguments.agree()?;
    let scene = disk::scene(&arguments.scene, arguments.root.as_deref())?;
    regions_to_read(&scene, &arguments.scene)?;
    let plan = arguments.plan.plan(&scene)?;
    let stop = Stop {
        // A budget of time alone is used up.
        target: match (arguments.target, arguments.budget, arguments.samples) {
            (None, None, None) => Stop::default().target,
            (target, _, _) => target,
        },
        budget_seconds: arguments.budget,
        samples: arguments.samples,
    };
    let mut provenance = Provenance::of(&scene, &plan, &stop, arguments.seed);
    provenance.scene_file.clone_from(&arguments.scene);
    provenance.root.clone_from(&arguments.root);
    let run = Run { scene: &scene, plan: &plan, provenance, threads: arguments.threads, ideal: !arguments.no_ideal };
    match (arguments.shard, arguments.samples) {
        (Some(share), Some(samples)) => arguments.contribute(&run, share, samples),
        _ => arguments.measure(&run),
    }
}

impl Arguments {
    /// Whether the options go together.
    fn agree(&self) -> Result<(), Failure> {
        let wrong = |what: &str, help: &str| Err(Failure::Input(format!("error: {what}\n  = help: {help}")));
        if self.shard.is_some() && self.samples.is_none() {
            return wrong(
                "--shard needs --samples: with a target the first samples of the whole run decide how many more are taken, and a share \
                 does not see them",
                "give the number of samples, such as --samples 65536; a run without --shard says how many it took",
            );
        }
        if self.shard.is_some() && self.checkpoint.is_none() {
            return wrong("--shard needs --checkpoint: a share has no readings, its work goes to that file", "add --checkpoint FILE");
        }
        if self.checkpoint.is_some() && self.budget.is_some() {
            return wrong(
                "--checkpoint does not go with --budget: where the clock ends a run, one that was interrupted has other bits",
                "give --target or --samples; the checkpoint survives any end",
            );
        }
        Ok(())
    }

    fn measure(&self, run: &Run<'_>) -> Result<(), Failure> {
        let output = self.output.prepare(&self.scene)?;
        let Some(path) = &self.checkpoint else {
            return output.write(&run.measure(&Unrecorded).map_err(|e| failed(&e))?);
        };
        let journal =
            checkpoint::open(path, &CheckpointHeader { provenance: run.provenance.clone(), share: Share::WHOLE }, self.checkpoint_every)?;
        let measurement = run.measure(&journal).map_err(|e| match e {
            EstimateError::Incomplete { .. } | EstimateError::Foreign { .. } => another_build(path, &e),
            e => failed(&e),
        })?;
        let recalled = journal.recalled();
        let finished = journal.finish(measurement.pieces);
        if recalled > 0 {
            complain(&format!("{recalled} of {} pieces of work recalled, {} sampled", measurement.pieces, measurement.pieces - recalled));
        }
        output.write(&measurement)?;
        finished.map(|_| ()).map_err(|e| unfinished(path, &e))
    }

    fn contribute(&self, run: &Run<'_>, share: Share, samples: u64) -> Result<(), Failure> {
        let Some(path) = &self.checkpoint else { return Ok(()) };
        let journal = checkpoint::open(path, &CheckpointHeader { provenance: run.provenance.clone(), share }, self.checkpoint_every)?;
        let tally = run.watched(|watch| contribute(run.scene, run.plan, samples, run.provenance.seed, watch, &journal));
        let tally = tally.map_err(|e| match e {
            EstimateError::Foreign { .. } => another_build(path, &e),
            e => failed(&e),
        })?;
        let recalled = journal.recalled();
        let own = (0..tally.pieces).filter(|&index| share.holds(index)).count() as u64;
        if tally.pieces - tally.missing < own {
            return Err(another_build(path, &EstimateError::Incomplete { missing: own + tally.missing - tally.pieces, pieces: own }));
        }
        journal.finish(tally.pieces).map_err(|e| unfinished(path, &e))?;
        if own == 0 {
            complain(&format!("warning: the run has only {} pieces of work, none for this share", tally.pieces));
        }
        print(&format!(
            "share {}/{}: {own} of {} pieces of work, {recalled} recalled and {} sampled, in `{}`\n",
            share.number,
            share.of,
            tally.pieces,
            own - recalled,
            path.display()
        ))
    }
}

fn another_build(path: &std::path::Path, e: &EstimateError) -> Failure {
    Failure::Input(format!(
        "error: the checkpoint `{}` is not one of this run although its header says so: {e}\n  = help: another build of the same version \
         wrote it; name another file to begin anew",
        path.display()
    ))
}

/// Whatever was asked for beside the checkpoint has been done.
fn unfinished(path: &std::path::Path, e: &std::io::Error) -> Failure {
    Failure::Run(format!("error: the checkpoint `{}` is not finished: {e}", path.display()))
}
