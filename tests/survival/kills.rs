//! Killed at random moments: nothing is lost but what was not written yet, and no file reads as something that it is not.

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use etendue::estimate::journal::Recording;
use etendue::measurement::CheckpointHeader;

use crate::disk::root;
use crate::program::{BOX, done, etendue, name, scratch, stderr, timeless};

const KILLS: usize = 50;

/// Longest wait for a run to write something, on however busy a machine.
const PATIENCE: Duration = Duration::from_secs(20);

/// Waits for a moment to kill: every third time at once or a little later, whatever the run does then; else a little after the file
/// has grown. Moments are spread by the golden ratio.
fn wait(kill: usize, file: &Path, known: usize, child: &mut Child) {
    let random = (kill as f64 * 0.618_033_988_75).fract();
    if kill.is_multiple_of(3) {
        return std::thread::sleep(Duration::from_secs_f64(0.03 * random));
    }
    let start = Instant::now();
    let length = || fs::metadata(file).map_or(0, |about| about.len());
    // A header has some two hundred bytes: growth means pieces of work.
    while length() <= known.max(1000) as u64 && child.try_wait().unwrap().is_none() && start.elapsed() < PATIENCE {
        std::thread::sleep(Duration::from_micros(200));
    }
    std::thread::sleep(Duration::from_secs_f64(0.04 * random));
}

#[test]
fn fifty_kills_lose_nothing_that_was_written() {
    let folder = scratch("kills");
    let file = folder.join("run.checkpoint");
    let mut seed = 0;
    let mut known = Vec::new();
    let (mut survived, mut torn, mut finished) = (0, 0, 0);
    for kill in 0..KILLS {
        let number = seed.to_string();
        let run = ["measure", BOX, "--samples", "262144", "--seed", &number, "--checkpoint", name(&file), "--checkpoint-every", "2ms"];
        let mut child = Command::new(env!("CARGO_BIN_EXE_etendue"))
            .args(run)
            .args(["--format", "json"])
            .current_dir(root())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        wait(kill, &file, known.len(), &mut child);
        // SIGKILL: nothing of the program runs after it.
        child.kill().unwrap();
        let ended_well = child.wait().unwrap().success();
        let Ok(bytes) = fs::read(&file) else {
            assert!(known.is_empty(), "kill {kill} took the checkpoint away");
            continue;
        };
        let recording = Recording::read(bytes.clone()).unwrap_or_else(|e| panic!("kill {kill} left a file that is not one: {e}"));
        assert_eq!(CheckpointHeader::from_text(recording.header()).unwrap().provenance.seed, seed);
        // What was known before is still there, byte for byte, and nothing is called finished that is not.
        assert!(bytes.starts_with(&known), "kill {kill} changed what was written");
        assert!(!ended_well || recording.completion().is_some());
        known = bytes[..recording.whole_bytes()].to_vec();
        survived += usize::from(recording.pieces() > 0);
        torn += usize::from(recording.torn_bytes() > 0);
        if recording.completion().is_some() {
            finished += 1;
            agrees(&file, seed);
            fs::remove_file(&file).unwrap();
            known.clear();
            seed += 1;
        }
    }
    assert!(survived >= KILLS / 2, "only {survived} kills met a run that had written anything");
    println!("{survived} of {KILLS} kills met written work, {torn} tore a record, {finished} runs were finished between them");
    agrees(&file, seed);
}

/// The run goes on to its end, with the readings of one that was left alone.
fn agrees(file: &Path, seed: u64) {
    let number = seed.to_string();
    let common = ["measure", BOX, "--samples", "262144", "--seed", &number, "--format", "json"];
    let resumed = etendue(&[&common[..], &["--checkpoint", name(file)]].concat());
    assert_eq!(resumed.status.code(), Some(0), "{}", stderr(&resumed));
    let resumed = String::from_utf8(resumed.stdout).unwrap();
    assert_eq!(timeless(&resumed), timeless(&done(&common)));
}
