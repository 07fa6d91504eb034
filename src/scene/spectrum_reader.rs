//! Spectra and factors of scene and sensor files.
//!
//! | spectrum | what it is |
//! |---|---|
//! | `"D65"`, `"lamp.csv"` | from the library, or a file that ends in `.csv`, `.txt` or `.spdx` |
//! | `BlackBody(2856)` | by Planck, K |
//! | `Daylight(cct_k: 5500)` | CIE D series, 4000 K to 25000 K |
//! | `Line(633)`, `Lines([(435.8, 1.0), (546.1, 0.8)])` | nm; nm and relative power |
//! | `Gaussian(centre_nm: 530, fwhm_nm: 30)` | FWHM = 2 √(2 ln 2) σ |
//! | `Led(peak_nm: 530, fwhm_nm: 30)` | by Ohno |
//! | `Flat(from_nm: 380, to_nm: 780)` | the same per nm |
//! | `Sum([(0.7, "A"), (0.3, Line(546))])` | weights of parts that are first scaled to an integral of one |
//! | `Filtered(spectrum, factor)` | a spectrum times a factor |
//!
//! | factor | what it is |
//! |---|---|
//! | `0.85`, `Constant(0.85)` | the same at every wavelength |
//! | `"V"`, `"oak.csv"` | from the library, or a file |
//! | `Band(from_nm: 400, to_nm: 700, value: 0.9)` | zero outside; value 1 if it is not given |
//! | `Gaussian(peak: 1, centre_nm: 530, fwhm_nm: 30)` | a bell curve |
//! | `Product([f, g])`, `Sum([f, g])`, `Scaled(0.5, f)` | of other factors |

use super::decode::Value;
use super::diagnostic::{Diagnostic, lines_of};
use super::document::Kind;
use super::factor_range::{LARGEST, outside_of};
use super::files::LONGEST_CURVE_BYTES;
use super::reading::Reading;
use crate::naming::nearest;
use crate::spectrum::file::{self, CurveFile, FileRules, Meaning};
use crate::spectrum::{Density, Factor, Line, Outside, SpectrumError, Table, library};

pub(super) const SPECTRA: [&str; 9] = ["BlackBody", "Daylight", "Line", "Lines", "Gaussian", "Led", "Flat", "Sum", "Filtered"];
pub(super) const FACTORS: [&str; 6] = ["Constant", "Band", "Gaussian", "Product", "Sum", "Scaled"];

/// Longest wavelength that is taken for one, nm.
const LONGEST_NM: f64 = 1e9;

/// V(λ), CIE 1924.
pub(super) fn v_lambda() -> Factor {
    library::v_lambda()
}

/// Full width at half maximum → standard deviation: 1 / (2 √(2 ln 2)).
fn sigma_nm(fwhm_nm: f64) -> f64 {
    fwhm_nm / (2.0 * (2.0 * std::f64::consts::LN_2).sqrt())
}

/// Whether a text names a file rather than an entry of the library.
pub(super) fn is_file(name: &str) -> bool {
    let lower = name.to_lowercase();
    [".csv", ".txt", ".spdx"].iter().any(|ending| lower.ends_with(ending))
}

/// Reads a spectrum; its absolute scale is what the file or the law says.
pub(super) fn read_spectrum(value: &Value, reading: &mut Reading) -> Option<Density> {
    if let Kind::Text(name) = &value.node.kind {
        if is_file(name) {
            let table = read_curve(value, name, Meaning::Density, reading)?;
            let density = Density::table(table);
            return checked(value, density, reading);
        }
        return library::density(name).map_err(|error| unknown(value, &error, "spectrum", reading)).ok();
    }
    if !SPECTRA.contains(&value.name()) {
        refuse(value, "a spectrum", "\"D65\" (library), \"lamp.csv\" (file)", &SPECTRA, library::density(value.name()).is_ok(), reading);
        return None;
    }
    match value.name() {
        "BlackBody" => {
            let item = value.positional(1, "BlackBody(2856)", &mut reading.problems)?.into_iter().next()?;
            let temperature_k =
                item.number_in("the temperature", "1e-12 K to 1e9 K", |t| (1e-12..=1e9).contains(&t), &mut reading.problems)?;
            checked(value, Density::black_body(temperature_k), reading)
        }
        "Daylight" => {
            let fields = value.fields("`Daylight`", &["cct_k"], &mut reading.problems)?;
            let item = fields.require("cct_k", "5500", &mut reading.problems)?;
            let cct_k = item.number(&mut reading.problems)?;
            checked(&item, Density::daylight(cct_k), reading)
        }
        "Led" => {
            let numbers = read_keyed(value, &["peak_nm", "fwhm_nm"], reading)?;
            checked(value, Density::led(numbers[0], numbers[1]), reading)
        }
        "Line" => {
            let item = value.positional(1, "Line(633)", &mut reading.problems)?.into_iter().next()?;
            let nm = read_wavelength(&item, reading)?;
            checked(value, Density::line(nm, 1.0), reading)
        }
        "Lines" => {
            let item = value.positional(1, "Lines([(435.8, 1.0), (546.1, 0.8)])", &mut reading.problems)?.into_iter().next()?;
            let rows = item.list("lines", &mut reading.problems)?;
            let lines: Vec<Option<Line>> = rows
                .iter()
                .map(|row| {
                    let pair = row.positional(2, "(435.8, 1.0)", &mut reading.problems)?;
                    let wavelength_nm = read_wavelength(&pair[0], reading);
                    let power = pair[1].number_in("the relative power", "0 and above", |x| x >= 0.0, &mut reading.problems);
                    Some(Line { wavelength_nm: wavelength_nm?, power: power? })
                })
                .collect();
            let lines = lines.into_iter().collect::<Option<Vec<Line>>>()?;
            if lines.iter().all(|line| line.power == 0.0) {
                value.problem(
                    &mut reading.problems,
                    "the spectrum has no line with a power above 0",
                    "write `Lines([(435.8, 1.0)])`: nm and relative power",
                );
                return None;
            }
            checked(value, Density::lines_only(&lines), reading)
        }
        "Gaussian" => {
            let numbers = read_keyed(value, &["centre_nm", "fwhm_nm"], reading)?;
            checked(value, Density::gaussian(1.0, numbers[0], sigma_nm(numbers[1])), reading)
        }
        "Flat" => {
            let numbers = read_keyed(value, &["from_nm", "to_nm"], reading)?;
            checked(value, Density::flat(numbers[0], numbers[1], 1.0), reading)
        }
        "Sum" => read_sum(value, reading),
        _ => {
            let parts = value.positional(2, "Filtered(\"A\", \"filter.csv\")", &mut reading.problems)?;
            let spectrum = read_spectrum(&parts[0], reading);
            let factor = read_factor(&parts[1], Outside::Zero, reading).and_then(|factor| not_negative(&parts[1], factor, reading));
            Some(spectrum?.filtered(&factor?))
        }
    }
}

fn read_sum(value: &Value, reading: &mut Reading) -> Option<Density> {
    let form = "Sum([(0.7, \"A\"), (0.3, Line(546))])";
    let list = value.positional(1, form, &mut reading.problems)?.into_iter().next()?.list("parts of a sum", &mut reading.problems)?;
    let parts: Vec<Option<Density>> = list
        .iter()
        .map(|part| {
            let pair = part.positional(2, "(0.7, \"A\")", &mut reading.problems)?;
            let weight = pair[0].number_in("the weight", "0 and above", |x| x >= 0.0, &mut reading.problems);
            let density = read_spectrum(&pair[1], reading);
            let (weight, density) = (weight?, density?);
            let total = density.total();
            if !(total > 0.0 && total.is_finite()) {
                pair[1].problem(
                    &mut reading.problems,
                    "this part is zero at every wavelength, so it cannot be weighted",
                    "leave it out, or give another spectrum",
                );
                return None;
            }
            checked(part, density.scaled(weight / total), reading)
        })
        .collect();
    let parts = parts.into_iter().collect::<Option<Vec<Density>>>()?;
    let sum = parts.iter().fold(Density::zero(), |sum, part| sum.plus(part));
    if sum.support().is_empty() {
        value.problem(&mut reading.problems, "the sum is zero at every wavelength", "give at least one part a weight above 0");
        return None;
    }
    Some(sum)
}

/// Reads a factor. `outside` is what a file's curve is worth beyond its ends.
pub(super) fn read_factor(value: &Value, outside: Outside, reading: &mut Reading) -> Option<Factor> {
    match &value.node.kind {
        Kind::Number(_) => return value.number(&mut reading.problems).map(Factor::Constant),
        Kind::Text(name) if is_file(name) => {
            return read_curve(value, name, Meaning::Factor, reading).map(|table| Factor::Table(table.with_outside(outside)));
        }
        Kind::Text(name) => {
            let found = library::factor(name).map_err(|error| unknown(value, &error, "factor", reading)).ok()?;
            return Some(match found {
                Factor::Table(table) => Factor::Table(table.with_outside(outside)),
                other => other,
            });
        }
        _ => {}
    }
    if !FACTORS.contains(&value.name()) {
        refuse(
            value,
            "a factor",
            "0.85 (constant), \"V\" (library), \"oak.csv\" (file)",
            &FACTORS,
            library::factor(value.name()).is_ok(),
            reading,
        );
        return None;
    }
    match value.name() {
        "Constant" => {
            let item = value.positional(1, "Constant(0.85)", &mut reading.problems)?.into_iter().next()?;
            item.number(&mut reading.problems).map(Factor::Constant)
        }
        "Band" => {
            let fields = value.fields("`Band`", &["from_nm", "to_nm", "value"], &mut reading.problems)?;
            let mut edge =
                |key: &str, example: &str| fields.require(key, example, &mut reading.problems).and_then(|v| read_wavelength(&v, reading));
            let (from_nm, to_nm) = (edge("from_nm", "400"), edge("to_nm", "700"));
            let height = fields.get("value").map_or(Some(1.0), |v| v.number(&mut reading.problems));
            checked(value, Factor::band(from_nm?, to_nm?, height?), reading)
        }
        "Gaussian" => {
            let fields = value.fields("`Gaussian`", &["peak", "centre_nm", "fwhm_nm"], &mut reading.problems)?;
            let peak = fields.get("peak").map_or(Some(1.0), |v| v.number(&mut reading.problems));
            let mut width =
                |key: &str, example: &str| fields.require(key, example, &mut reading.problems).and_then(|v| read_wavelength(&v, reading));
            let (centre_nm, fwhm_nm) = (width("centre_nm", "530"), width("fwhm_nm", "30"));
            checked(value, Factor::gaussian(peak?, centre_nm?, sigma_nm(fwhm_nm?)), reading)
        }
        "Scaled" => {
            let parts = value.positional(2, "Scaled(0.5, \"V\")", &mut reading.problems)?;
            let scale = parts[0].number(&mut reading.problems);
            Some(read_factor(&parts[1], outside, reading)?.scaled(scale?))
        }
        name => {
            let form = format!("{name}([f, g])");
            let list = value.positional(1, &form, &mut reading.problems)?.into_iter().next()?.list("the parts", &mut reading.problems)?;
            if list.is_empty() {
                value.problem(&mut reading.problems, format!("`{name}` has no parts"), format!("write `{form}`"));
                return None;
            }
            let parts: Vec<Option<Factor>> = list.iter().map(|part| read_factor(part, outside, reading)).collect();
            let parts = parts.into_iter().collect::<Option<Vec<Factor>>>()?;
            Some(if name == "Product" { Factor::Product(parts) } else { Factor::Sum(parts) })
        }
    }
}

/// Notes that a value is neither a name nor one of the forms; `in_library` if it would be with quotes.
fn refuse(value: &Value, what: &str, names: &str, forms: &[&str], in_library: bool, reading: &mut Reading) {
    let found = value.described();
    let help = match nearest(value.name(), forms.iter().copied()) {
        _ if in_library => format!("names are written in quotes: \"{}\"", value.name()),
        Some(name) => format!("did you mean `{name}`? allowed: {names}, {}", forms.join(", ")),
        None => format!("allowed: {names}, {}", forms.join(", ")),
    };
    value.problem_at(&value.name_span(), &mut reading.problems, format!("{what} is expected, not {found}"), help);
}

/// A factor that is nowhere negative.
fn not_negative(value: &Value, factor: Factor, reading: &mut Reading) -> Option<Factor> {
    let Some((nm, found)) = outside_of(&factor, 0.0, LARGEST) else { return Some(factor) };
    let help = format!("allowed: 0 to {LARGEST:e} at every wavelength");
    value.problem(&mut reading.problems, format!("the filter is {found} at {nm} nm"), help);
    None
}

fn read_wavelength(value: &Value, reading: &mut Reading) -> Option<f64> {
    let nm = value.number(&mut reading.problems)?;
    if nm > 0.0 && nm <= LONGEST_NM {
        if nm < 10.0 {
            value.problem(
                &mut reading.problems,
                format!("a wavelength of {nm} nm is an X-ray"),
                format!("wavelengths are in nm; {nm} µm is written {}", nm * 1000.0),
            );
            return None;
        }
        return Some(nm);
    }
    value.problem(&mut reading.problems, format!("the wavelength is {nm} nm"), "allowed: 10 nm to 1e9 nm");
    None
}

fn read_keyed(value: &Value, keys: &[&str], reading: &mut Reading) -> Option<Vec<f64>> {
    let fields = value.fields(&format!("`{}`", value.name()), keys, &mut reading.problems)?;
    let numbers: Vec<Option<f64>> = keys
        .iter()
        .map(|&key| {
            let found = fields.require(key, if key == "fwhm_nm" { "30" } else { "500" }, &mut reading.problems)?;
            if key == "fwhm_nm" {
                return found.number_in(
                    "the full width at half maximum",
                    "above 0 nm",
                    |x| x > 0.0 && x <= LONGEST_NM,
                    &mut reading.problems,
                );
            }
            read_wavelength(&found, reading)
        })
        .collect();
    numbers.into_iter().collect()
}

fn checked<T>(value: &Value, made: Result<T, SpectrumError>, reading: &mut Reading) -> Option<T> {
    made.map_err(|error| value.problem(&mut reading.problems, error.to_string(), "")).ok()
}

fn unknown(value: &Value, error: &library::LookupError, what: &str, reading: &mut Reading) {
    let (message, help) = match error {
        library::LookupError::Unknown { name, nearest } => {
            let near: Vec<String> = nearest.iter().map(|n| format!("\"{n}\"")).collect();
            let files = "a file name ends in .csv, .txt or .spdx";
            (format!("the library has no {what} called \"{name}\""), format!("nearest: {}; {files}", near.join(", ")))
        }
        library::LookupError::Ambiguous { name, candidates } => {
            let some: Vec<String> = candidates.iter().take(6).map(|n| format!("\"{n}\"")).collect();
            (format!("\"{name}\" names several curves of the library"), format!("say which of {}: {}", candidates.len(), some.join(", ")))
        }
        other => {
            let example = if what == "spectrum" {
                "write a spectrum such as \"A\", \"D65\", \"LED-B3\""
            } else {
                "write a factor such as \"V\", a number, or the name of a curve file"
            };
            (other.to_string(), example.into())
        }
    };
    value.problem(&mut reading.problems, message, help);
}

/// Reads a curve file; what was understood and not plainly said goes into the remarks.
fn read_curve(value: &Value, name: &str, meaning: Meaning, reading: &mut Reading) -> Option<Table> {
    let path = reading.path(value, name)?;
    let key = (path, meaning);
    if let Some(known) = reading.curves.get(&key) {
        return known.as_ref().map(|curve| curve.table.clone());
    }
    let bytes = reading.bytes(value, &key.0, "curve file", LONGEST_CURVE_BYTES);
    let curve = bytes.and_then(|bytes| parse_curve(&key.0, &bytes, meaning, reading));
    let table = curve.as_ref().map(|curve| curve.table.clone());
    reading.curves.insert(key, curve);
    table
}

fn parse_curve(path: &str, bytes: &[u8], meaning: Meaning, reading: &mut Reading) -> Option<CurveFile> {
    match file::read_curve(bytes, meaning, &FileRules::default()) {
        Ok(curve) => {
            reading.remarks.extend(curve.remarks.iter().map(|remark| format!("{path}: {remark}")));
            Some(curve)
        }
        Err(problems) => {
            let lines = lines_of(bytes, problems.iter().map(|problem| problem.line));
            for problem in problems {
                let line = String::from_utf8_lossy(lines.get(&problem.line).map_or(&[][..], |line| line));
                reading.problems.add(Diagnostic::of_column(path, problem.line, problem.column, &line, problem.message, problem.help));
            }
            None
        }
    }
}
