//! The catalogue as a whole, and what is said of inputs that cannot be.

use super::{answer as answer_with, *};
use crate::scene::MemoryFiles;
use std::collections::BTreeSet;

fn answer(name: &str, given: &[(&str, &str)]) -> Result<Answer, Vec<Problem>> {
    let files = MemoryFiles::new().with("lamp.csv", "wavelength_nm;W/nm\n500;1,0\n600;1,0\n");
    answer_with(name, given, &files)
}

fn problems(name: &str, given: &[(&str, &str)]) -> Vec<Problem> {
    answer(name, given).expect_err("an answer where there should be problems")
}

#[test]
fn every_equation_has_its_words_and_a_name_of_its_own() {
    let names: BTreeSet<_> = equations().map(|equation| equation.name).collect();
    assert_eq!(names.len(), equations().count());
    assert!(names.len() >= 40, "{}", names.len());
    for equation in equations() {
        let [name, symbol, unit] = equation.outcome.words("radiant");
        for word in [equation.formula, equation.about, equation.source, name, symbol, unit] {
            assert!(!word.is_empty(), "{}", equation.name);
        }
        assert!(equation.name.chars().all(|c| c.is_ascii_lowercase() || c == '-'), "{}", equation.name);
        let keys: Vec<String> = equation.inputs.iter().flat_map(Input::keys).map(|(key, ..)| key).collect();
        assert_eq!(keys.iter().collect::<BTreeSet<_>>().len(), keys.len(), "{}", equation.name);
        assert!(keys.iter().all(|key| key.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')), "{keys:?}");
    }
}

#[test]
fn groups_are_in_one_piece() {
    let mut seen = Vec::new();
    for equation in equations() {
        if seen.last() != Some(&equation.group) {
            assert!(!seen.contains(&equation.group), "{}", equation.name);
            seen.push(equation.group);
        }
    }
    assert_eq!(seen.len(), 6);
}

#[test]
fn every_example_has_an_answer() {
    for equation in equations() {
        let answer = answer(equation.name, equation.example).unwrap_or_else(|problems| panic!("{}: {problems:?}", equation.name));
        assert!(answer.value > 0.0 && answer.value.is_finite(), "{}: {}", equation.name, answer.value);
        assert_eq!(answer.inputs.len(), equation.inputs.len());
    }
}

#[test]
fn an_equation_is_the_same_in_every_system() {
    let unit = |key: &str| answer("inverse-square", &[(key, "100"), ("distance_m", "2"), ("angle_deg", "0")]).map(|a| (a.value, a.unit));
    assert_eq!(unit("intensity_w_sr"), Ok((25.0, "W/m²")));
    assert_eq!(unit("intensity_cd"), Ok((25.0, "lx")));
    assert_eq!(unit("intensity_per_s_sr"), Ok((25.0, "1/(m² s)")));
    let twice = problems("isotropic-emitter", &[("flux_w", "1"), ("flux_lm", "683")]);
    assert!(twice.iter().any(|p| p.message.contains("more than one unit")), "{twice:?}");
}

#[test]
fn every_number_outside_its_domain_is_refused() {
    for equation in equations() {
        for (index, input) in equation.inputs.iter().enumerate().filter(|(_, input)| input.domain != Domain::Spectrum) {
            let mut wrong = vec!["NaN", "inf", "-inf", "1e999", "five", ""];
            wrong.extend((!input.domain.contains(-1e300)).then_some("-1e300"));
            wrong.extend((input.domain == Domain::Positive).then_some("0"));
            wrong.extend(matches!(input.domain, Domain::Between(..) | Domain::AboveUpTo(..)).then_some("1e300"));
            for text in wrong {
                let given: Vec<(&str, &str)> =
                    equation.example.iter().enumerate().map(|(i, (key, value))| (*key, if i == index { text } else { *value })).collect();
                let found = problems(equation.name, &given);
                assert_eq!(found.len(), 1, "{} {text}: {found:?}", equation.name);
                assert!(found[0].message.contains(given[index].0) && found[0].help.contains("allowed"), "{found:?}");
            }
        }
    }
}

#[test]
fn every_problem_is_said_at_once() {
    let found = problems("flux-from-current", &[("efficiency", "1.5"), ("voltage", "-2"), ("efficiency", "0.2"), ("current_a", "two")]);
    let all: String = found.iter().map(|p| format!("{} {}\n", p.message, p.help)).collect();
    for part in
        ["`voltage` is no input", "did you mean `voltage_v`", "given twice", "allowed: 0 to 1", "`voltage_v` is missing", "no number"]
    {
        assert!(all.contains(part), "no `{part}` in\n{all}");
    }
}

#[test]
fn a_misspelt_equation_is_told_the_nearest() {
    let found = problems("foton-energy", &[]);
    assert!(found[0].help.contains("`photon-energy`"), "{found:?}");
    let long = "x".repeat(100_000);
    assert!(problems(&long, &[])[0].message.len() < 200);
    assert!(problems("photon-energy", &[(&long, "1")])[0].message.len() < 200);
    assert!(problems("photon-energy", &[("wavelength_nm", &long)])[0].message.len() < 200);
}

#[test]
fn what_no_number_holds_is_said() {
    let found = problems("photon-flux", &[("radiant_flux_w", "1e300"), ("wavelength_nm", "1e9")]);
    assert!(found[0].message.contains("leaves the range of numbers"), "{found:?}");
    let found = problems("planck", &[("wavelength_nm", "555"), ("temperature_k", "1")]);
    assert!(found[0].message.contains("too small for a number"), "{found:?}");
    let found = problems("spherical-triangle", &["ax", "ay", "az", "bx", "by", "bz", "cx", "cy", "cz"].map(|key| (key, "0")));
    assert!(found[0].message.contains("at the viewer"), "{found:?}");
}

#[test]
fn spectra_are_names_or_lines() {
    let of = |spectrum: &str| answer("luminous-efficacy-of-a-spectrum", &[("spectrum", spectrum)]);
    assert_eq!(of("555").map(|a| a.value), Ok(683.002));
    assert!(of("D65").is_ok());
    assert!(of("BlackBody(2856)").is_ok() && of("Sum([(1, \"A\"), (2, Line(555))])").is_ok());
    for (spectrum, part) in [("D56", "D5"), ("-5", "above 0"), ("NaN", "above 0"), ("1e300", "up to"), ("lump.csv", "lump.csv"), ("", "")] {
        let found = of(spectrum).unwrap_err();
        let all: String = found.iter().map(|p| format!("{} {}\n", p.message, p.help)).collect();
        assert!(all.contains(part), "{spectrum}: {found:?}");
    }
    assert!(of("V").is_err(), "V(λ) is no spectrum");
    let file = of("lamp.csv").unwrap();
    assert!(file.value > 0.0 && !file.remarks.is_empty(), "decimal commas are accepted, and said");
    let blind = problems("radiance-to-luminance", &[("radiance_w_m2_sr", "1"), ("spectrum", "1064")]);
    assert!(blind[0].message.contains("sees nothing"), "{blind:?}");
}
