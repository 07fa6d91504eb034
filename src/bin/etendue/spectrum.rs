//! `etendue spectrum SPECTRUM`: every quantity of one spectrum.

use std::path::PathBuf;

use clap::ValueEnum;
use etendue::observer::sheet::{RowUncertainty, Scale, SheetOptions, SpectralQuantity, SpectrumSheet};
use etendue::report::spectrum::{SpectrumReport, to_csv, to_json, to_text};
use etendue::scene::{GivenSpectrum, spectrum_from_text};
use etendue::spectrum::file::{Meaning, write_csv, write_spdx};
use etendue::spectrum::resample::{Lines, Rule, resample};
use etendue::spectrum::{Table, library, spdx};

use crate::{Failure, complain, disk, print};

/// Every quantity of one spectrum: radiant, photon, luminous, scotopic, mesopic, α-opic, cones, colour.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// A file (.csv, .txt, .spdx), a name of the library such as D65, or a form such as "BlackBody(3000)" or "Led(peak_nm: 530, fwhm_nm: 30)".
    #[arg(value_name = "FILE|NAME|FORM")]
    spectrum: String,
    /// How to write the quantities.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Write into this file and not to stdout.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Scale the spectrum to this illuminance, lx; a relative spectrum is scaled to 1000 lx by default.
    #[arg(long, value_name = "LX", value_parser = above_zero, allow_hyphen_values = true)]
    illuminance: Option<f64>,
    /// Scale the spectrum to this irradiance, W/m².
    #[arg(long, value_name = "W_M2", value_parser = above_zero, allow_hyphen_values = true, conflicts_with = "illuminance")]
    irradiance: Option<f64>,
    /// Read the numbers as the spectral density of this quantity, in W and per nm; a file that states its unit says so itself.
    #[arg(long, value_enum, conflicts_with_all = ["illuminance", "irradiance"])]
    quantity: Option<Quantity>,
    /// The white from which dominant wavelength and purity are counted: an illuminant of the library.
    #[arg(long, value_name = "NAME", default_value = "E")]
    white: String,
    /// Luminance to which the eye is adapted, cd/m², for mesopic quantities.
    #[arg(long, value_name = "CD_M2", value_parser = above_zero, allow_hyphen_values = true, default_value = "1")]
    adaptation: f64,
    /// Take the uncertainties of the rows of a file as fully correlated; uncorrelated by default.
    #[arg(long)]
    correlated: bool,
    /// Put the spectrum on another grid first, nm; what that costs is said.
    #[arg(long, value_name = "FROM:TO:STEP", value_parser = grid_nm)]
    resample: Option<[f64; 3]>,
    /// Write the spectrum itself again and not its quantities; one without rows of its own needs --resample.
    #[arg(long = "as", value_enum, value_name = "FORMAT", conflicts_with = "format")]
    rewritten: Option<Rewritten>,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Rewritten {
    /// Wavelengths in nm, values per nm.
    Csv,
    /// XML of IES TM-27.
    Spdx,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    /// A page for a person.
    Text,
    /// Everything, for programs.
    Json,
    /// A row a quantity.
    Csv,
}

#[derive(Clone, Copy, ValueEnum)]
enum Quantity {
    /// W/nm.
    Flux,
    /// W/(m² nm), arriving.
    Irradiance,
    /// W/(m² nm), leaving.
    Exitance,
    /// W/(m² sr nm).
    Radiance,
    /// W/(sr nm).
    Intensity,
    /// No unit: only the shape counts.
    Relative,
}

impl Quantity {
    fn scale(self) -> Scale {
        match self {
            Quantity::Flux => Scale::Absolute(SpectralQuantity::Flux),
            Quantity::Irradiance => Scale::Absolute(SpectralQuantity::Irradiance),
            Quantity::Exitance => Scale::Absolute(SpectralQuantity::Exitance),
            Quantity::Radiance => Scale::Absolute(SpectralQuantity::Radiance),
            Quantity::Intensity => Scale::Absolute(SpectralQuantity::Intensity),
            Quantity::Relative => Scale::Relative,
        }
    }
}

fn above_zero(given: &str) -> Result<f64, String> {
    match given.trim().parse::<f64>() {
        Ok(x) if x > 0.0 && x.is_finite() => Ok(x),
        _ => Err("a number above 0".to_owned()),
    }
}

fn grid_nm(given: &str) -> Result<[f64; 3], String> {
    let numbers: Vec<f64> = given.split(':').map_while(|part| part.trim().parse().ok()).collect();
    match numbers[..] {
        [from, to, step] if given.split(':').count() == 3 && from >= 1.0 && to >= from + step && step > 0.0 && to <= 1e9 => {
            Ok([from, to, step])
        }
        _ => Err("two wavelengths from 1 to 1e9 nm and a step from the one towards the other, such as 380:780:5".to_owned()),
    }
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut given = spectrum_from_text(&arguments.spectrum, &disk::Anywhere).map_err(|problems| Failure::Input(problems.to_string()))?;
    let mut remarks = given.remarks.clone();
    let entry = if given.file.is_none() { library::entry(&given.name).ok() } else { None };
    let mut table = given.file.as_ref().map(|file| file.table.clone());
    if let Some([from_nm, to_nm, step_nm]) = arguments.resample {
        let lines = if arguments.rewritten.is_some() { Lines::IntoBins } else { Lines::Keep };
        let found = resample(&given.density, from_nm, to_nm, step_nm, Rule::BinAverages, lines);
        let found = found.map_err(|error| Failure::Input(format!("error: --resample: {error}")))?;
        remarks.extend(found.remarks);
        if let Some(file) = &mut given.file {
            if file.standard_uncertainty.take().is_some() {
                remarks.push("the uncertainties of the rows are left out: they do not belong to the rows of the new grid".to_owned());
            }
            file.table = found.table.clone();
        }
        (given.density, table) = (found.density, Some(found.table));
    }
    let (wanted, understood) = scale(arguments, &given, entry)?;
    remarks.extend(understood);
    if let Some(rewritten) = arguments.rewritten {
        let help = "the spectrum has no rows of its own; give a grid for them, such as --resample 380:780:5";
        let table = table.ok_or_else(|| Failure::Input(format!("error: {help}")))?;
        put(arguments, &rewrite(rewritten, &table, &given, wanted)?)?;
        remarks.iter().for_each(|remark| complain(&format!("remark: {remark}")));
        return Ok(());
    }
    let options = SheetOptions {
        scale: wanted,
        white: arguments.white.clone(),
        adaptation_cd_m2: arguments.adaptation,
        range_nm: given.file.as_ref().map(|file| file.table.range_nm()).or(entry.map(|entry| entry.range_nm)),
        uncertainty: given.file.as_ref().and_then(|file| {
            Some(RowUncertainty {
                wavelengths_nm: file.table.wavelengths_nm().to_vec(),
                standard_uncertainty: file.standard_uncertainty.clone()?,
                correlated: arguments.correlated,
            })
        }),
    };
    if arguments.correlated && options.uncertainty.is_none() {
        remarks.push("the spectrum carries no uncertainties, so --correlated changes nothing".to_owned());
    }
    let sheet = SpectrumSheet::new(&given.density, &options).map_err(|error| Failure::Input(format!("error: {error}")))?;
    let name = entry.map_or(given.name, |entry| entry.name.clone());
    let report = SpectrumReport { spectrum: name, sheet, remarks };
    let written = match arguments.format {
        Format::Text => to_text(&report),
        Format::Json => to_json(&report),
        Format::Csv => to_csv(&report),
    };
    put(arguments, &written)?;
    report.all_remarks().for_each(|remark| complain(&format!("remark: {remark}")));
    Ok(())
}

/// The text of the spectrum itself.
fn rewrite(format: Rewritten, table: &Table, given: &GivenSpectrum, wanted: Scale) -> Result<String, Failure> {
    let (quantity, unit) = match wanted {
        Scale::Absolute(SpectralQuantity::Flux) => (spdx::SpectralQuantity::Flux, "W/nm"),
        Scale::Absolute(SpectralQuantity::Irradiance) => (spdx::SpectralQuantity::Irradiance, "W/(m² nm)"),
        Scale::Absolute(SpectralQuantity::Exitance) => (spdx::SpectralQuantity::Exitance, "W/(m² nm)"),
        Scale::Absolute(SpectralQuantity::Radiance) => (spdx::SpectralQuantity::Radiance, "W/(m² sr nm)"),
        Scale::Absolute(SpectralQuantity::Intensity) => (spdx::SpectralQuantity::Intensity, "W/(sr nm)"),
        _ => (spdx::SpectralQuantity::Relative, "1/nm (relative)"),
    };
    if format == Rewritten::Spdx {
        let header = spdx::SpdxHeader { description: Some(given.name.clone()), ..spdx::SpdxHeader::default() };
        return Ok(write_spdx(table, quantity, &header));
    }
    let mut header = given.file.as_ref().map_or_else(Vec::new, |file| file.header.clone());
    let mut state = |key: &str, value: &str| {
        if header.iter().all(|(known, _)| known != key) {
            header.push((key.to_owned(), value.to_owned()));
        }
    };
    state("name", &given.name);
    state("quantity", quantity.name());
    state("unit", unit);
    let uncertainty = given.file.as_ref().and_then(|file| file.standard_uncertainty.as_deref());
    write_csv(table, uncertainty, Meaning::Density, &header).map_err(|error| Failure::Run(format!("error: {error}")))
}

/// To the file that was named, else to stdout.
fn put(arguments: &Arguments, written: &str) -> Result<(), Failure> {
    match &arguments.out {
        None => print(written),
        Some(target) => {
            let help = "--out takes a file in a folder that can be written";
            disk::save(target, written.as_bytes()).map_err(|e| disk::unwritable(target, &e, help))
        }
    }
}

/// How the numbers are to be read, and what is to be said about it.
fn scale(arguments: &Arguments, given: &GivenSpectrum, entry: Option<&library::Entry>) -> Result<(Scale, Option<String>), Failure> {
    let (unit, words) = match (&given.file, entry) {
        (Some(file), _) => (file.unit.as_deref(), file.quantity.as_deref()),
        (None, Some(entry)) if entry.is_absolute() => (Some(entry.unit.as_str()), Some(entry.quantity.as_str())),
        _ => (None, None),
    };
    let unit = unit.filter(|unit| !unit.to_lowercase().contains("relative") && !matches!(unit.trim(), "" | "1"));
    let stated = unit.and_then(SpectralQuantity::of_unit);
    match (arguments.illuminance, arguments.irradiance, arguments.quantity) {
        (Some(lx), _, _) => return Ok((Scale::Illuminance(lx), None)),
        (_, Some(w_m2), _) => return Ok((Scale::Irradiance(w_m2), None)),
        (_, _, Some(quantity)) => {
            let shared = |a: SpectralQuantity, b: Scale| Scale::Absolute(a) == b || (is_per_area(Scale::Absolute(a)) && is_per_area(b));
            let other = unit.filter(|_| !stated.is_some_and(|stated| shared(stated, quantity.scale())));
            let remark =
                other.map(|unit| format!("the file says that its unit is `{unit}`; --quantity overrules it, no number is converted"));
            return Ok((quantity.scale(), remark));
        }
        _ => {}
    }
    let Some(unit) = unit else { return Ok((Scale::Relative, None)) };
    let Some(quantity) = stated else {
        let remark = format!(
            "the unit `{unit}` is none of W/nm, W/(m² nm), W/(m² sr nm), W/(sr nm), so the spectrum is taken as relative; convert the numbers to one of these, or say --quantity"
        );
        return Ok((Scale::Relative, Some(remark)));
    };
    let named = words.and_then(named_quantity).unwrap_or(quantity);
    if named != quantity && !(is_per_area(Scale::Absolute(named)) && is_per_area(Scale::Absolute(quantity))) {
        let problem =
            format!("the unit `{unit}` is that of a spectral {}, but the quantity is `{}`", quantity.word(), words.unwrap_or_default());
        let help = "correct one of the two lines `# unit:` and `# quantity:`, or say --quantity";
        return Err(Failure::Input(format!("error: {}: {problem}\n  = help: {help}", given.name)));
    }
    Ok((Scale::Absolute(named), None))
}

/// Irradiance and exitance share their unit.
fn is_per_area(scale: Scale) -> bool {
    matches!(scale, Scale::Absolute(SpectralQuantity::Irradiance | SpectralQuantity::Exitance))
}

/// Words of a text, in lower case.
fn words_of(text: &str) -> Vec<String> {
    text.split(|c: char| !c.is_alphabetic()).filter(|word| !word.is_empty()).map(str::to_lowercase).collect()
}

/// The one quantity that a text such as `spectral radiance` names; `None` if it names none or several.
fn named_quantity(text: &str) -> Option<SpectralQuantity> {
    let words = words_of(text);
    let mut named = SpectralQuantity::ALL.into_iter().filter(|quantity| words.iter().any(|word| word == quantity.word()));
    named.next().filter(|_| named.next().is_none())
}
