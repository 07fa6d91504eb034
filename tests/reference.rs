//! The reference cases of `src/study/verify/cases/`, read as a user would read them: a scene is written, planned and measured.
//!
//! What computes them is in the library, so that `etendue verify` and these tests are one thing. Here stand the laws that it has to keep: every
//! case is read or waits for a stated reason, all agree, a deviation is told. Cases that state a behaviour and no number have a test each in
//! `reference/behaviour.rs`.

#![allow(clippy::unwrap_used, clippy::print_stderr)]

#[path = "reference/behaviour.rs"]
mod behaviour;
mod disk;

use etendue::observer::AlphaOpic;
use etendue::study::verify::families::observers::source;
use etendue::study::verify::{Check, Selection, Suite, Tables, Verdict, WAITING};

/// The tables that cases name and that are not shipped.
fn tables() -> Tables {
    let folder = "tests/reference/data";
    let text = |file: String| (file.clone(), std::fs::read_to_string(disk::root().join(folder).join(file)).unwrap());
    disk::files_in(folder, &["csv"]).into_iter().map(text).collect()
}

fn suite() -> Suite {
    Suite::built_in(tables()).unwrap_or_else(|problems| panic!("{}", problems.join("\n")))
}

/// Computes every case of a group and says which fail.
fn run(group: &str) {
    let found = suite().run(&Selection::group(group), &|| 0.0).unwrap();
    if std::env::var_os("ETENDUE_SHOW_REFERENCE").is_some() {
        eprintln!("{}", etendue::report::verify::text(&found));
    }
    let total = found.total();
    eprintln!("{group}: {} cases read; largest deviation {:?} of the limit", total.agree + total.fail, total.largest);
    assert!(found.passed(), "{}", etendue::report::verify::failures(&found));
}

#[test]
fn radiometry_agrees_with_its_closed_forms() {
    run("g1");
}

#[test]
fn spectra_and_observers_agree_with_their_references() {
    run("g2");
}

#[test]
fn transport_agrees_with_its_references() {
    run("g3");
}

#[test]
fn extreme_and_stiff_cases_agree_with_their_references() {
    run("g4");
}

#[test]
fn the_camera_model_agrees_with_its_references() {
    run("g6");
}

/// With the tables at hand nothing waits but what [`WAITING`] names, and whatever that names is a case.
#[test]
fn every_case_is_read_or_waits_for_a_stated_reason() {
    let suite = suite();
    for case in suite.cases() {
        let named = WAITING.iter().any(|(name, _)| *name == case.id() || *name == case.family());
        let has_number = case.reference().is_some();
        assert_eq!(has_number, case.behaviour().is_none(), "{}", case.id());
        if has_number && !named {
            assert!(case.tolerance() > 0.0, "{}: no tolerance", case.id());
        }
    }
    for (name, why) in WAITING {
        assert!(suite.cases().iter().any(|case| *name == case.id() || *name == case.family()), "{name} waits but is no case");
        assert!(why.len() > 20, "{name}");
    }
}

/// What the behaviours state is held by a test each, whose file names them.
#[test]
fn every_behaviour_has_its_test() {
    const HELD: [&str; 10] =
        ["zero-area", "coincident", "coplanar-sensor", "behind", "empty", "laser-gap", "zero-omega", "nan-in", "rho-one", "flip"];
    let suite = suite();
    let mut stated: Vec<&str> =
        suite.cases().iter().filter(|case| case.reference().is_none()).filter_map(|case| case.family().strip_prefix("g4h.")).collect();
    stated.sort_unstable();
    let mut held = HELD.to_vec();
    held.sort_unstable();
    assert_eq!(stated, held);
}

/// Guards the comparison itself: a wrong reference must fail and be told.
#[test]
fn a_value_that_is_off_by_more_than_the_tolerance_is_told() {
    let suite = suite();
    let off = |check: &Check| matches!(check.verdict, Verdict::Deviates(_)) && check.deviation_in_limits().unwrap() > 1.0;
    for case in suite.cases().iter().filter(|case| case.group() == "g1" && case.reference().is_some()) {
        let reference = case.reference().unwrap();
        assert!(case.deviation_in_tolerances(reference) == 0.0);
        assert!(case.deviation_in_tolerances(f64::NAN).is_nan());
        if suite.check(case, &|| 0.0).found().is_some() {
            let check = suite.check(&case.with_reference(reference + 3.0 * case.tolerance()), &|| 0.0);
            assert!(check.fails() && off(&check), "{}", case.id());
        }
    }
}

/// Five digits against six, integrals against sums, and a rod curve that one of the two rounds to three decimals at some wavelengths: equivalent
/// daylight illuminance agrees to 5e-5.
#[test]
fn the_action_spectra_of_the_library_agree_with_the_reference() {
    let mut read = 0;
    for case in suite().cases().iter().filter(|case| case.id().starts_with("g2g.edi")) {
        let alpha = AlphaOpic::named(case.text("action").unwrap()).unwrap();
        let value = case.number("E_v_lx").unwrap() * alpha.daylight_efficacy_ratio(&source(case).unwrap()).unwrap();
        let reference = case.reference().unwrap();
        assert!((value / reference - 1.0).abs() < 5e-5, "{}: {value:e} instead of {reference:e}", case.id());
        read += 1;
    }
    assert!(read >= 9);
}
