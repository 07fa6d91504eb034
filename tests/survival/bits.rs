//! Whole = resumed = merged, on any number of threads.

use std::sync::LazyLock;

use etendue::estimate::journal::{Journal, Recorder, Recording, Rounds, Share, Shares, Unrecorded, header_bytes};
use etendue::estimate::run::with_threads;
use etendue::estimate::{EstimateError, Stop, Watch, contribute};
use etendue::measurement::{Measurement, measure_with};
use etendue::plan::{Plan, PlanOptions};
use etendue::scene::{Scene, read_scene, scene_from_text};
use proptest::prelude::*;

use crate::disk::Repository;

const HEADER: &str = "a test\n";
const WATCH: Watch<'_> = Watch { now: &|| 0.0, progress: &|_| {} };

/// A screen that hides half a panel from a row of meters on a reflecting floor.
const SCREEN: &str = "Scene(
    surfaces: { \"floor\": Lambertian(0.4), \"screen\": Lambertian(0) },
    objects: [(name: \"floor\", shape: Quad(corner: (-3, -3, 0), u: (6, 0, 0), v: (0, 6, 0)), surface: \"floor\"),
              (name: \"screen\", shape: Quad(corner: (0, -3, 1), u: (3, 0, 0), v: (0, 6, 0)), surface: \"screen\")],
    sources: [(name: \"panel\", shape: Rectangle(0.6, 0.6), at: (0, 0, 2), facing: (0, 0, -1), strength: Lumens(1000), spectrum: \"A\"),
              (name: \"lamp\", shape: Sphere(0.1), at: (1, 0.5, 2), strength: Lumens(500), spectrum: \"D65\")],
    instruments: [(name: \"row\", grid: (from: (-0.3, 0, 0.1), to: (0.3, 0, 0.1), points: (4, 1)), facing: (0, 0, 1),
        sensor: Sensor(title: \"ideal\", aperture: Point, acceptance: Cosine,
                       channels: [(name: \"E_v\", responsivity: \"V\", reads: Illuminance), (name: \"E_e\", responsivity: Constant(1), reads: Irradiance)]))],
)";

/// A scene, how a run of it ends, and the measurement of an uninterrupted one.
struct Case {
    name: &'static str,
    scene: Scene,
    plan: Plan,
    stop: Stop,
    whole: Measurement,
    /// The journal of that run, finished.
    journal: Vec<u8>,
}

static CASES: LazyLock<Vec<Case>> = LazyLock::new(|| {
    let target = |share| Stop { target: Some(share), budget_seconds: None, samples: None };
    let samples = |n| Stop { target: None, budget_seconds: None, samples: Some(n) };
    let read = |path| read_scene(path, &Repository, None).unwrap();
    let screen = || scene_from_text(SCREEN).unwrap_or_else(|problems| panic!("{problems}"));
    vec![
        Case::new("box to a target", read("scenes/cornell-box.ron"), target(0.02)),
        Case::new("box", read("scenes/cornell-box.ron"), samples(1 << 15)),
        Case::new("office", read("scenes/office.ron"), samples(256)),
        Case::new("screen to a target", screen(), target(0.01)),
        Case::new("screen", screen(), samples(1 << 14)),
    ]
});

impl Case {
    fn new(name: &'static str, scene: Scene, stop: Stop) -> Case {
        let plan = Plan::new(&scene, &PlanOptions::default()).unwrap();
        let recorder = Recorder::new(HEADER, Share::WHOLE, header_bytes(HEADER));
        let run = |journal: &dyn Journal| measure_with(&scene, &plan, &stop, 5, &WATCH, journal).unwrap();
        let recorded = run(&recorder);
        let whole = run(&Unrecorded);
        assert_eq!(whole, recorded, "{name}: a journal must not change a run");
        let journal = recorder.finish(recorded.pieces).unwrap();
        Case { name, scene, plan, stop, whole, journal }
    }

    fn run(&self, journal: &dyn Journal) -> Measurement {
        measure_with(&self.scene, &self.plan, &self.stop, 5, &WATCH, journal).unwrap()
    }

    /// Goes on with the journal as it is after so many bytes; the journal and how many pieces were recalled.
    fn resumed(&self, bytes: usize) -> (Vec<u8>, u64) {
        let known = Recording::read(self.journal[..bytes].to_vec()).unwrap();
        let pieces = known.pieces();
        let to = self.journal[..known.whole_bytes()].to_vec();
        let recorder = Recorder::resumed(known, Share::WHOLE, to);
        let measurement = self.run(&recorder);
        assert!(self.whole.bits() == measurement.bits(), "{} resumed after {bytes} bytes", self.name);
        assert_eq!(measurement, self.whole, "{} resumed after {bytes} bytes", self.name);
        assert_eq!(recorder.recalled(), pieces);
        (recorder.finish(measurement.pieces).unwrap(), pieces)
    }

    fn samples(&self) -> Option<u64> {
        self.stop.samples
    }
}

trait Bits {
    fn bits(&self) -> Vec<u64>;
}

impl Bits for Measurement {
    /// Equality of numbers does not see the sign of a zero.
    fn bits(&self) -> Vec<u64> {
        let of = |r: &etendue::measurement::Reading| [r.value, r.standard_uncertainty(), r.expanded.expanded_uncertainty].map(f64::to_bits);
        self.readings.iter().flat_map(of).collect()
    }
}

#[test]
fn runs_have_the_same_bits_on_any_number_of_threads() {
    for case in CASES.iter() {
        for threads in [1, 2, 8] {
            let found = with_threads(Some(threads), || case.run(&Unrecorded));
            assert_eq!((found.bits(), &found), (case.whole.bits(), &case.whole), "{} on {threads} threads", case.name);
        }
    }
}

#[test]
fn a_run_from_a_finished_journal_samples_nothing() {
    for case in CASES.iter() {
        let recording = Recording::read(case.journal.clone()).unwrap();
        assert!(recording.pieces() > 0 && recording.completion().is_some_and(|end| end.pieces == case.whole.pieces));
        let shares = Shares::new(vec![recording]);
        let found = case.run(&shares);
        assert_eq!((found.bits(), &found, shares.left_over()), (case.whole.bits(), &case.whole, 0), "{}", case.name);
    }
}

#[test]
fn shares_put_together_have_the_bits_of_the_whole() {
    for case in CASES.iter() {
        let Some(samples) = case.samples() else { continue };
        for of in [1, 3, 7] {
            let share_of = |number: u32| {
                let share = Share::new(number, of).unwrap();
                let recorder = Recorder::new(HEADER, share, header_bytes(HEADER));
                // A share each on another number of threads.
                let work = || contribute(&case.scene, &case.plan, samples, 5, &WATCH, &recorder).unwrap();
                let tally = with_threads(Some(1 + number as usize % 2), work);
                assert_eq!(tally.pieces, case.whole.pieces);
                Recording::read(recorder.finish(tally.pieces).unwrap()).unwrap()
            };
            let shares = Shares::new((1..=of).map(share_of).collect());
            for threads in [1, 8] {
                let found = with_threads(Some(threads), || case.run(&shares));
                assert_eq!((found.bits(), &found), (case.whole.bits(), &case.whole), "{} from {of} shares", case.name);
            }
        }
    }
}

#[test]
fn shares_cost_alike() {
    let case = CASES.iter().find(|case| case.name == "office").unwrap();
    let sizes: Vec<u64> = (1..=3)
        .map(|number| {
            let recorder = Recorder::new(HEADER, Share::new(number, 3).unwrap(), header_bytes(HEADER));
            let tally = contribute(&case.scene, &case.plan, 256, 5, &WATCH, &recorder).unwrap();
            tally.pieces - tally.missing
        })
        .collect();
    let (most, least) = (sizes.iter().max().unwrap(), sizes.iter().min().unwrap());
    assert!(most - least <= 1 && sizes.iter().sum::<u64>() == case.whole.pieces, "{sizes:?}");
}

#[test]
fn a_share_is_not_taken_for_the_whole() {
    let case = CASES.iter().find(|case| case.name == "box").unwrap();
    let recorder = Recorder::new(HEADER, Share::new(1, 2).unwrap(), Vec::new());
    let found = measure_with(&case.scene, &case.plan, &case.stop, 5, &WATCH, &recorder);
    assert!(matches!(found, Err(EstimateError::Incomplete { missing, pieces }) if missing == pieces / 2), "{found:?}");
}

#[test]
fn pieces_of_another_scene_are_no_pieces_of_this_run() {
    let find = |name: &str| CASES.iter().find(|case| case.name == name).unwrap();
    let shares = Shares::new(vec![Recording::read(find("screen").journal.clone()).unwrap()]);
    let case = find("box");
    let found = measure_with(&case.scene, &case.plan, &case.stop, 5, &WATCH, &shares);
    assert!(matches!(found, Err(EstimateError::Incomplete { .. } | EstimateError::Foreign { .. })), "{found:?}");
}

#[test]
fn a_run_that_a_clock_ended_repeats_by_its_rounds() {
    for case in CASES.iter().filter(|case| case.stop.target.is_some()) {
        for target in [None, Some(1e-4)] {
            let stop = Stop { target, budget_seconds: Some(1.0), samples: None };
            // A clock that ticks at every look ends the run somewhere.
            for ticks in [10, 25, 60] {
                let looks = std::sync::atomic::AtomicU32::new(0);
                let now = || f64::from(looks.fetch_add(1, std::sync::atomic::Ordering::Relaxed)) / f64::from(ticks);
                let watch = Watch { now: &now, progress: &|_| {} };
                let ended = measure_with(&case.scene, &case.plan, &stop, 5, &watch, &Unrecorded).unwrap();
                let rounds = Rounds(ended.provenance.rounds.clone());
                assert!(!rounds.0.is_empty());
                let again = measure_with(&case.scene, &case.plan, &stop, 5, &WATCH, &rounds).unwrap();
                assert_eq!(again.bits(), ended.bits(), "{} after {:?} rounds", case.name, rounds.0);
                assert_eq!(again.counters, ended.counters);
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn a_run_cut_at_any_byte_is_resumed_with_the_same_bits(which in 0..5usize, share in 0.0..=1.0, threads in 1..4usize) {
        let case = &CASES[which];
        let start = header_bytes(HEADER).len();
        let bytes = start + ((case.journal.len() - start) as f64 * share) as usize;
        let (journal, _) = with_threads(Some(threads), || case.resumed(bytes));
        // Resumed as it was cut: the records may stand in another order, and are as many.
        prop_assert_eq!(Recording::read(journal).unwrap().pieces(), case.whole.pieces);
    }

    #[test]
    fn a_run_may_be_cut_again_and_again(which in 0..5usize, shares in proptest::collection::vec(0.0..1.0f64, 1..4)) {
        let case = &CASES[which];
        let start = header_bytes(HEADER).len();
        let mut journal = case.journal.clone();
        for share in shares {
            let bytes = start + ((journal.len() - start) as f64 * share) as usize;
            let known = Recording::read(journal[..bytes].to_vec()).unwrap();
            let to = journal[..known.whole_bytes()].to_vec();
            let recorder = Recorder::resumed(known, Share::WHOLE, to);
            let measurement = case.run(&recorder);
            prop_assert_eq!(measurement.bits(), case.whole.bits());
            journal = recorder.finish(measurement.pieces).unwrap();
        }
    }
}
