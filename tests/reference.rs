//! The reference cases of `tests/reference/*.json`, read as a user would read them: a scene is written, planned and measured.
//!
//! A case passes if |reading − reference| ≤ max(rel_tol · |reference|, abs_tol), with the tolerances of the case. Every family of
//! cases has a function that builds its scene from the inputs alone, so that further cases of a family need no code. A case that no
//! function covers is in [`WAITING`] with the reason; a case that is in neither table fails.

#![allow(clippy::unwrap_used, clippy::print_stderr)]

#[path = "reference/behaviour.rs"]
mod behaviour;
#[path = "reference/bench.rs"]
mod bench;
#[path = "reference/colour.rs"]
mod colour;
#[path = "reference/extreme.rs"]
mod extreme;
#[path = "reference/observers.rs"]
mod observers;
#[path = "reference/quality.rs"]
mod quality;
#[path = "reference/radiometry.rs"]
mod radiometry;
#[path = "reference/spectra.rs"]
mod spectra;

use bench::{Case, Family, cases};

/// Families and single cases that wait, each with the reason.
const WAITING: &[(&str, &str)] = &[
    ("g1h.point-cyl", "cylindrical illuminance needs an instrument of its own"),
    ("g1h.cap-cyl", "cylindrical illuminance needs an instrument of its own"),
    ("g1h.rect-cyl", "cylindrical illuminance needs an instrument of its own"),
    ("g1h.point-sph", "spherical illuminance needs an instrument of its own"),
    ("g1h.cap-sph", "spherical illuminance needs an instrument of its own"),
    ("g1h.rect-sph", "spherical illuminance needs an instrument of its own"),
    ("g4f.sphere-stiff", "1e6 reflections at a tolerance of 1e-6 need a deterministic solution of the enclosure with its port"),
];

/// Cases that state a behaviour and no number: each has a test of this name in `reference/behaviour.rs`.
const BEHAVIOURS: &[&str] =
    &["zero-area", "coincident", "coplanar-sensor", "behind", "empty", "laser-gap", "zero-omega", "nan-in", "rho-one", "flip"];

fn families() -> Vec<(&'static str, Family)> {
    [radiometry::FAMILIES, extreme::FAMILIES, spectra::FAMILIES, colour::FAMILIES, observers::FAMILIES, quality::FAMILIES].concat()
}

/// "g1c.disc-par-3" → "g1c.disc-par".
fn family(id: &str) -> &str {
    id.rsplit_once('-').map_or(id, |(family, _)| family)
}

fn waiting(id: &str) -> Option<&'static str> {
    WAITING.iter().find(|(name, _)| *name == id || *name == family(id)).map(|(_, why)| *why)
}

/// Reads every case of a group that has a function, and says which fail.
fn run(group: &str) {
    let families = families();
    let mut failed = Vec::new();
    let (mut read, mut worst) = (0, (0.0, String::new()));
    for case in cases(group) {
        let Some((_, of_case)) = families.iter().find(|(name, _)| *name == family(case.id())) else { continue };
        if waiting(case.id()).is_some() {
            continue;
        }
        read += 1;
        let value = of_case(&case);
        let share = case.deviation_in_tolerances(value);
        if share > worst.0 || share.is_nan() {
            worst = (share, case.id().to_owned());
        }
        if share.is_nan() || share > 1.0 {
            failed.push(format!("{}: {value:e} instead of {:e}, {share:.3e} tolerances off", case.id(), case.reference()));
        }
        if std::env::var_os("ETENDUE_SHOW_REFERENCE").is_some() {
            eprintln!("{:<28} {value:<24e} {share:.2e} tolerances", case.id());
        }
    }
    eprintln!("{group}: {read} cases read; largest deviation {:.2e} tolerances ({})", worst.0, worst.1);
    assert!(failed.is_empty(), "{} of {read} cases fail:\n{}", failed.len(), failed.join("\n"));
}

#[test]
fn radiometry_agrees_with_its_closed_forms() {
    run("g1_radiometry");
}

#[test]
fn extreme_and_stiff_cases_agree_with_their_references() {
    run("g4_extreme");
}

#[test]
fn spectra_and_observers_agree_with_their_references() {
    run("g2_spectral");
}

#[test]
fn every_case_is_read_or_waits_for_a_stated_reason() {
    let families = families();
    let mut used = vec![false; WAITING.len()];
    for case in cases("g1_radiometry").into_iter().chain(cases("g4_extreme")) {
        let id = case.id();
        let covered = families.iter().any(|(name, _)| *name == family(id));
        let behaviour = family(id).strip_prefix("g4h.").is_some_and(|name| BEHAVIOURS.contains(&name));
        let waits = WAITING.iter().position(|(name, _)| *name == id || *name == family(id));
        if let Some(entry) = waits {
            used[entry] = true;
        }
        assert!(covered || behaviour || waits.is_some(), "{id} is neither read nor waiting");
        assert!(!behaviour || case.has_no_number(), "{id} has a number");
    }
    for ((name, _), used) in WAITING.iter().zip(used) {
        assert!(used, "{name} waits but is no case");
    }
}

/// Guards the comparison itself: a wrong value must fail.
#[test]
fn a_value_that_is_off_by_more_than_the_tolerance_is_told() {
    for case in cases("g1_radiometry").iter().filter(|case: &&Case| !case.has_no_number()) {
        assert!(case.deviation_in_tolerances(case.reference()) == 0.0);
        let off = case.reference() + 2.0 * case.tolerance();
        assert!(case.deviation_in_tolerances(off) > 1.0, "{}", case.id());
        assert!(case.deviation_in_tolerances(f64::NAN).is_nan());
    }
}
