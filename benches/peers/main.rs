//! Error against processor time on the scenes of the peers lab, beside other engines.
//!
//! ```text
//! cargo bench --bench peers -- --peers DIR [--scene S2g S2s …] [--quick] [--seed N] [--samples N …]
//! ```
//!
//! DIR holds `scenes.json`, `references.json` and, for S5, `cache/`. For each scene and each number of samples K runs with seeds of
//! their own are timed on one thread; values, times and stated uncertainties go to `DIR/results-local/<scene>__etendue.json`
//! (`results-local/quick/` with `--quick`) in the form that the lab's report reads. Fails if a value is off by more than chance allows.
#![allow(clippy::print_stdout)] // The table is what this program is for.
#![allow(missing_docs)]

mod clock;
mod contract;
mod summary;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clock::Clock;
use contract::{Contract, Failure};
use etendue::estimate::run::with_threads;
use etendue::estimate::{Stop, Watch};
use etendue::measurement::{Measurement, measure};
use etendue::plan::{Plan, PlanOptions};
use etendue::scene::Scene;
use serde_json::json;
use summary::{Figures, Reference, Row, TARGET, largest_plausible_z, seconds_to_target};

/// Scene, then (log₂ of the samples, runs) a row. Scenes with an exact answer have one row without samples. `S3paths` is S3ball with
/// the sum of its reflections switched off.
const SWEEPS: [(&str, &[(u32, usize)]); 8] = [
    ("S1", &[]),
    ("S2g", &[(8, 400), (10, 400), (12, 300), (14, 200), (15, 200), (16, 64), (17, 48), (18, 32)]),
    ("S2s", &[(8, 400), (10, 400), (12, 300), (14, 200), (15, 200), (16, 64), (17, 48), (18, 32)]),
    ("S3ball", &[]),
    ("S3paths", &[(8, 200), (10, 100), (12, 48), (14, 24), (16, 16)]),
    ("S3point", &[]),
    ("S4", &[(6, 4), (8, 4), (10, 3), (12, 2)]),
    ("S5", &[(8, 48), (10, 32), (12, 24), (14, 16), (16, 8)]),
];

/// Runs of a scene with an exact answer: they differ in time only.
const EXACT_RUNS: usize = 15;

/// What the command line says.
struct Arguments {
    lab: PathBuf,
    scenes: Vec<String>,
    quick: bool,
    seed: u64,
    samples: Vec<u64>,
}

fn main() -> Result<(), Failure> {
    let Some(arguments) = arguments()? else {
        println!("peers: nothing to do without `-- --peers DIR`; see benches/README.md");
        return Ok(());
    };
    let contract = Contract::read(&arguments.lab)?;
    let references = std::fs::read_to_string(arguments.lab.join("references.json"))?;
    let references: BTreeMap<String, serde_json::Value> = serde_json::from_str(&references)?;
    println!("one thread; {}", Clock::kind());
    println!(
        "{:8} {:>9} {:>4} {:>10} {:>10} {:>10} {:>10} {:>7} {:>7} {:>6} {:>9}",
        "scene", "samples", "runs", "cpu s", "wall s", "rms %", "mean %", "z", "u/rms", "95 %", "rays/s"
    );
    let mut off = Vec::new();
    for (name, sweep) in SWEEPS {
        if !arguments.scenes.is_empty() && !arguments.scenes.iter().any(|s| s == name) {
            continue;
        }
        let reference: Reference =
            serde_json::from_value(references.get(scene_of(name).0).cloned().ok_or_else(|| format!("references.json has no {name}"))?)?;
        if !run(name, sweep, &contract, &reference, &arguments)? {
            off.push(name);
        }
    }
    if off.is_empty() { Ok(()) } else { Err(format!("readings disagree with the reference: {}", off.join(", ")).into()) }
}

fn arguments() -> Result<Option<Arguments>, Failure> {
    let mut found = Arguments { lab: PathBuf::new(), scenes: Vec::new(), quick: false, seed: 1, samples: Vec::new() };
    let mut key = String::new();
    for word in std::env::args().skip(1) {
        match word.as_str() {
            "--bench" => {}
            "--quick" => found.quick = true,
            "--peers" | "--scene" | "--seed" | "--samples" => key = word,
            _ => match key.as_str() {
                "--peers" => found.lab = word.into(),
                "--scene" if SWEEPS.iter().any(|(name, _)| *name == word) => found.scenes.push(word),
                "--scene" => return Err(format!("no scene `{word}`; there are {}", SWEEPS.map(|(name, _)| name).join(", ")).into()),
                "--seed" => found.seed = word.parse()?,
                "--samples" => found.samples.push(word.parse()?),
                _ => return Err(format!("`{word}` means nothing here; see benches/README.md").into()),
            },
        }
    }
    Ok((!found.lab.as_os_str().is_empty()).then_some(found))
}

/// The scene of the contract that a sweep runs, and the rules that it switches off.
fn scene_of(sweep: &str) -> (&str, &'static [&'static str]) {
    match sweep {
        "S3paths" => ("S3ball", &["closed_sphere"]),
        name => (name, &[]),
    }
}

/// Runs the sweep of a scene; false if a value is off by more than chance allows.
fn run(name: &str, sweep: &[(u32, usize)], contract: &Contract, reference: &Reference, arguments: &Arguments) -> Result<bool, Failure> {
    let clock = Clock::start();
    let (scene, without) = scene_of(name);
    let scene = contract.scene(scene, &arguments.lab)?;
    let (load_s, _) = clock.stop();
    let clock = Clock::start();
    let plan = Plan::new(&scene, &PlanOptions { naive: false, without: without.iter().map(|r| (*r).to_owned()).collect() })?;
    let (plan_s, _) = clock.stop();

    let mut rows = Vec::new();
    if sweep.is_empty() {
        rows.push(sample_row(&scene, &plan, 0, EXACT_RUNS, arguments.seed, reference)?);
    } else if arguments.samples.is_empty() {
        let most_runs = if arguments.quick { 24 } else { usize::MAX };
        let kept = if arguments.quick { sweep.len() - 1 } else { sweep.len() };
        for &(log2, runs) in &sweep[..kept] {
            rows.push(sample_row(&scene, &plan, 1 << log2, runs.min(most_runs), arguments.seed, reference)?);
        }
    } else {
        let runs = sweep.iter().map(|&(_, runs)| runs).max().unwrap_or(1);
        for &samples in &arguments.samples {
            rows.push(sample_row(&scene, &plan, samples, runs.min(if arguments.quick { 24 } else { 400 }), arguments.seed, reference)?);
        }
    }
    let exact = sweep.is_empty();
    let mut figures = Vec::new();
    for row in &rows {
        let f = row.figures(reference);
        print_row(name, row, &f);
        figures.push(f);
    }
    let limit = largest_plausible_z(reference.values.len());
    let good = match figures.last() {
        // The references of exact scenes are printed with nine digits.
        Some(f) if exact => f.rms < 1e-8,
        _ => figures.iter().all(|f| f.z.abs() <= limit),
    };
    match seconds_to_target(&figures) {
        Some(_) if exact => println!("  no ray and no sample; loading {load_s:.3e} s, planning {plan_s:.3e} s"),
        Some((seconds, between)) => println!(
            "  {:.1} % in {seconds:.3e} CPU s{}; worst z plausible below {limit:.1}; loading {load_s:.3e} s, planning {plan_s:.3e} s",
            100.0 * TARGET,
            if between { "" } else { " (extrapolated)" }
        ),
        None => {}
    }
    if !good {
        println!("  DISAGREES with the reference");
    }
    write(name, &rows, exact, (load_s, plan_s), arguments)?;
    Ok(good)
}

/// K runs with the same number of samples; none stands for a scene that has an exact answer.
fn sample_row(scene: &Scene, plan: &Plan, samples: u64, runs: usize, seed: u64, reference: &Reference) -> Result<Row, Failure> {
    let mut row = Row { samples, ..Row::default() };
    for k in 0..runs as u64 {
        // Seeds of rows do not meet.
        let (wall_s, cpu_s, measured) = timed(scene, plan, samples, seed * 1_000_000_000 + samples * 1000 + k)?;
        if measured.readings.len() != reference.values.len() {
            return Err(format!("{} readings for {} reference values", measured.readings.len(), reference.values.len()).into());
        }
        if samples == 0 && (measured.counters.samples, measured.counters.rays) != (0, 0) {
            return Err(format!(
                "the answer should be exact, but {} samples and {} rays were taken",
                measured.counters.samples, measured.counters.rays
            )
            .into());
        }
        row.rays = measured.counters.rays;
        row.wall_s.push(wall_s);
        row.cpu_s.push(cpu_s);
        row.values.push(measured.readings.iter().map(|r| r.value).collect());
        row.uncertainties.push(measured.readings.iter().map(|r| r.standard_uncertainty()).collect());
        row.expanded.push(measured.readings.iter().map(|r| r.expanded.expanded_uncertainty).collect());
    }
    if samples == 0 && row.values.iter().any(|v| v != &row.values[0]) {
        return Err("an exact answer depends on the seed".into());
    }
    Ok(row)
}

/// One evaluation on one thread: wall and processor seconds.
fn timed(scene: &Scene, plan: &Plan, samples: u64, seed: u64) -> Result<(f64, f64, Measurement), Failure> {
    let stop = Stop { target: None, budget_seconds: None, samples: Some(samples.max(1)) };
    let epoch = Instant::now();
    let watch = Watch { now: &|| epoch.elapsed().as_secs_f64(), progress: &|_| {} };
    // The clock runs on the thread that works.
    with_threads(Some(1), || {
        let clock = Clock::start();
        let measured = measure(scene, plan, &stop, seed, &watch)?;
        let (wall_s, cpu_s) = clock.stop();
        Ok::<_, etendue::estimate::EstimateError>((wall_s, cpu_s, measured))
    })
    .map_err(Into::into)
}

fn print_row(name: &str, row: &Row, f: &Figures) {
    if row.samples == 0 {
        let dash = "-";
        println!(
            "{name:8} {:>9} {:>4} {:>10.3e} {:>10.3e} {:>10.3e} {:>+10.2e} {dash:>7} {dash:>7} {dash:>6} {dash:>9}",
            "exact",
            row.values.len(),
            f.cpu_s,
            f.wall_s,
            100.0 * f.rms,
            100.0 * f.mean
        );
        return;
    }
    println!(
        "{name:8} {:>9} {:>4} {:>10.3e} {:>10.3e} {:>10.3e} {:>+10.2e} {:>+7.2} {:>7.3} {:>6.3} {:>9.2e}",
        row.samples,
        row.values.len(),
        f.cpu_s,
        f.wall_s,
        100.0 * f.rms,
        100.0 * f.mean,
        f.z,
        f.u_over_rms,
        f.coverage,
        row.rays as f64 / f.cpu_s
    );
}

/// Writes what the lab's report reads; a sweep that is no scene of the lab's is only printed.
fn write(name: &str, rows: &[Row], exact: bool, (load_s, plan_s): (f64, f64), arguments: &Arguments) -> Result<(), Failure> {
    if scene_of(name).0 != name {
        return Ok(());
    }
    let folder = arguments.lab.join(if arguments.quick { "results-local/quick" } else { "results-local" });
    std::fs::create_dir_all(&folder)?;
    let runs: Vec<serde_json::Value> = rows
        .iter()
        .map(|r| json!({"quality": r.samples, "wall_s": r.wall_s, "cpu_s": r.cpu_s, "values": r.values, "self_error": r.uncertainties, "rays": r.rays}))
        .collect();
    let method = if exact {
        "exact: formulas, no ray and no sample"
    } else {
        "planned: formulas where there are any, else randomised quasi-Monte Carlo in 16 replicates"
    };
    let result = json!({
        "scene": name, "peer": "etendue",
        // The lab extrapolates Monte Carlo ("mc") and takes the rest ("tuned") as measured.
        "kind": if exact { "tuned" } else { "mc" },
        "method": method, "threads": 1, "version": env!("CARGO_PKG_VERSION"),
        "import_s": 0, "load_s": load_s, "plan_s": plan_s, "cpu_clock": Clock::kind(), "runs": runs,
    });
    save(&folder.join(format!("{name}__etendue.json")), &result)
}

fn save(path: &Path, result: &serde_json::Value) -> Result<(), Failure> {
    let partial = path.with_extension("json.partial");
    std::fs::write(&partial, serde_json::to_string(result)?)?;
    std::fs::rename(&partial, path)?;
    Ok(())
}
