//! From words to a number: `photon-energy`, `wavelength_nm=555` → 3.579e-19 J, or every problem at once.

use super::equation::{Domain, Equation, Given, Input, Unit};
use super::equations;
use crate::scene::nearest::{by_distance, nearest, suggestion};
use crate::scene::{Files, spectrum_from_text};
use crate::spectrum::Density;

/// Longest wavelength that is taken for a line, nm.
const LONGEST_NM: f64 = 1e9;
/// Most characters of a word of the user that are repeated in a message.
const LONGEST_QUOTE: usize = 60;
/// Most characters of a message that may repeat them.
const LONGEST_MESSAGE: usize = 400;

/// Why an equation has no answer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// What is wrong.
    pub message: String,
    /// What is allowed, or what to type instead.
    pub help: String,
}

/// An input as it was understood.
#[derive(Debug, Clone, PartialEq)]
pub struct GivenInput {
    /// The key under which it was given.
    pub key: String,
    /// Symbol in the formula.
    pub symbol: &'static str,
    /// The number as it was typed, or the spectrum's name.
    pub value: String,
    /// The number, if it is one.
    pub number: Option<f64>,
    /// Unit; "" for a spectrum, "1" for a pure number.
    pub unit: &'static str,
    /// What it means.
    pub meaning: &'static str,
}

/// The result in another form.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Form {
    /// What it is.
    pub what: &'static str,
    /// The number.
    pub value: f64,
    /// Its unit.
    pub unit: &'static str,
}

/// The answer of an equation.
#[derive(Debug, Clone)]
pub struct Answer {
    /// The equation.
    pub equation: &'static Equation,
    /// Its inputs, in the order of the equation.
    pub inputs: Vec<GivenInput>,
    /// Standard term of the result.
    pub name: &'static str,
    /// Symbol of the result.
    pub symbol: &'static str,
    /// The number, finite.
    pub value: f64,
    /// Its unit; "1" for a pure number.
    pub unit: &'static str,
    /// Other forms of it, finite.
    pub also: Vec<Form>,
    /// How files were understood: converted units, decimal commas, gaps. To be shown to whoever asked.
    pub remarks: Vec<String>,
}

fn quoted(text: &str) -> String {
    let mut short: String = text.chars().take(LONGEST_QUOTE).map(|c| if c.is_control() { '\u{fffd}' } else { c }).collect();
    if text.chars().count() > LONGEST_QUOTE {
        short.push('…');
    }
    short
}

/// A message of another part of the program, which may repeat what was typed.
fn quoted_at_length(message: &str) -> String {
    message.chars().take(LONGEST_MESSAGE).collect()
}

fn problem(message: String, help: impl Into<String>) -> Problem {
    Problem { message, help: help.into() }
}

/// An input that was understood.
struct Understood {
    key: String,
    unit: &'static str,
    system: &'static str,
    value: String,
    number: f64,
    spectrum: Option<Density>,
    remarks: Vec<String>,
}

/// Computes the equation `name` from its inputs, `(key, value)` as they were typed, in any order. `files` reads
/// the curve that a spectrum may be; [`MemoryFiles::new()`](crate::scene::MemoryFiles) has none.
///
/// # Errors
/// Every problem at once: an unknown name or key (with the nearest one), a key that is missing or given twice, a value that is no number
/// or outside its domain, units of different systems, a result that no number holds.
pub fn answer(name: &str, given: &[(&str, &str)], files: &dyn Files) -> Result<Answer, Vec<Problem>> {
    let Some(equation) = equations().find(|equation| equation.name == name) else {
        let names = || equations().map(|equation| equation.name);
        let (close, _) = by_distance(name, names(), 3);
        let offered = nearest(name, names())
            .map_or_else(|| format!("the nearest names are {}", close.join(", ")), |near| format!("did you mean `{near}`?"));
        let help = format!("{offered} (`etendue equation` lists all of them)");
        return Err(vec![problem(format!("there is no equation `{}`", quoted(name)), help)]);
    };
    let mut problems = unknown_keys(equation, given);
    let understood: Vec<Option<Understood>> = equation.inputs.iter().map(|input| understand(input, given, files, &mut problems)).collect();
    let mut systems: Vec<&'static str> = understood.iter().flatten().map(|u| u.system).filter(|system| !system.is_empty()).collect();
    systems.dedup();
    if systems.len() > 1 {
        problems
            .push(problem(format!("quantities of different systems are given: {}", systems.join(", ")), "give all of them in one system"));
    }
    let understood: Vec<Understood> = understood.into_iter().flatten().collect();
    if !problems.is_empty() || understood.len() != equation.inputs.len() {
        return Err(problems);
    }
    let numbers = equation.inputs.iter().zip(&understood).map(|(input, u)| (input.key, u.number)).collect();
    let given = Given { numbers, spectrum: understood.iter().find_map(|u| u.spectrum.clone()) };
    let value = (equation.compute)(&given).map_err(|why| vec![problem(why, example(equation))])?;
    let also: Vec<Form> =
        equation.also.iter().map(|also| Form { what: also.what, value: (also.compute)(&given, value), unit: also.unit }).collect();
    if !value.is_finite() || also.iter().any(|form| !form.value.is_finite()) {
        let message = format!("the result of {} leaves the range of numbers (about 1e-308 to 1e308)", equation.formula);
        return Err(vec![problem(message, "give values that are nearer to one")]);
    }
    let [name, symbol, unit] = equation.outcome.words(systems.first().copied().unwrap_or("radiant"));
    let remarks = understood.iter().flat_map(|u| u.remarks.clone()).collect();
    let inputs = equation.inputs.iter().zip(understood);
    let inputs = inputs.map(|(input, u)| GivenInput {
        key: u.key,
        symbol: input.symbol,
        value: u.value,
        number: u.spectrum.is_none().then_some(u.number),
        unit: u.unit,
        meaning: input.meaning,
    });
    Ok(Answer { equation, inputs: inputs.collect(), name, symbol, value, unit, also, remarks })
}

/// The example as it is typed.
fn example(equation: &Equation) -> String {
    let words: Vec<String> = equation.example.iter().map(|(key, value)| format!(" {key}={value}")).collect();
    format!("for example: etendue equation {}{}", equation.name, words.concat())
}

/// Keys that are none of the equation, and keys that are given twice.
fn unknown_keys(equation: &Equation, given: &[(&str, &str)]) -> Vec<Problem> {
    let keys: Vec<String> = equation.inputs.iter().flat_map(Input::keys).map(|(key, ..)| key).collect();
    let keys: Vec<&str> = keys.iter().map(String::as_str).collect();
    let mut problems = Vec::new();
    for (index, (key, _)) in given.iter().enumerate() {
        if !keys.contains(key) {
            let help = if keys.is_empty() { "it takes none".to_owned() } else { suggestion(key, &keys) };
            problems.push(problem(format!("`{}` is no input of `{}`", quoted(key), equation.name), help));
        } else if given[..index].iter().any(|(earlier, _)| earlier == key) {
            problems.push(problem(format!("`{key}` is given twice"), "keep one of them"));
        }
    }
    problems
}

/// One input out of what was given.
fn understand(input: &Input, given: &[(&str, &str)], files: &dyn Files, problems: &mut Vec<Problem>) -> Option<Understood> {
    let keys = input.keys();
    let found: Vec<_> = keys.iter().filter_map(|k| given.iter().find(|(key, _)| *key == k.0).map(|(_, value)| (k, *value))).collect();
    let names = || keys.iter().map(|(key, ..)| format!("`{key}`")).collect::<Vec<_>>().join(" or ");
    let [((key, unit, system), text)] = found[..] else {
        let what = format!("{} {}", input.symbol, input.meaning);
        problems.push(match found.len() {
            0 => problem(format!("{} is missing: {what}", names()), format!("allowed: {}", input.domain.words())),
            _ => problem(format!("{what} is given in more than one unit"), format!("keep one of {}", names())),
        });
        return None;
    };
    let plain =
        |value: String, number: f64| Understood { key: key.clone(), unit, system, value, number, spectrum: None, remarks: Vec::new() };
    let number = text.trim().parse::<f64>().ok();
    if input.domain == Domain::Spectrum {
        let (name, density, remarks) = spectrum(key, text.trim(), number, files, problems)?;
        return Some(Understood { spectrum: Some(density), remarks, ..plain(name, f64::NAN) });
    }
    let shown_unit = if matches!(input.unit, Unit::Fixed("1")) { String::new() } else { format!(" {unit}") };
    match number {
        Some(x) if input.domain.contains(x) => Some(plain(text.trim().to_owned(), x)),
        Some(_) => {
            let message = format!("`{key}` is {}{shown_unit}: {}", quoted(text.trim()), input.meaning);
            problems.push(problem(message, format!("allowed: {}", input.domain.words())));
            None
        }
        None => {
            let help = format!("allowed: a number, {}; units are in the key and decimals are written with a point", input.domain.words());
            problems.push(problem(format!("`{key}` is `{}`, which is no number", quoted(text)), help));
            None
        }
    }
}

/// A spectrum in the grammar of scene files, or a line by its wavelength: its name, itself, and remarks.
fn spectrum(
    key: &str,
    text: &str,
    number: Option<f64>,
    files: &dyn Files,
    problems: &mut Vec<Problem>,
) -> Option<(String, Density, Vec<String>)> {
    if let Some(nm) = number {
        let line = if nm > LONGEST_NM { None } else { Density::line(nm, 1.0).ok() };
        if line.is_none() {
            let help = format!("allowed: {}; a wavelength is above 0 and up to {LONGEST_NM:e} nm", Domain::Spectrum.words());
            problems.push(problem(format!("`{key}` is {}, a line at no wavelength", quoted(text)), help));
        }
        return line.map(|line| (format!("line of {text} nm"), line, Vec::new()));
    }
    match spectrum_from_text(text, files) {
        Ok(given) => Some((given.name, given.density, given.remarks)),
        Err(found) => {
            problems.extend(found.0.into_iter().map(|p| {
                let help = p.help.unwrap_or_else(|| format!("allowed: {}", Domain::Spectrum.words()));
                problem(format!("`{key}`: {}", quoted_at_length(&p.message)), quoted_at_length(&help))
            }));
            None
        }
    }
}
