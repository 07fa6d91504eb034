//! Spectra and factors from files, and to files: CSV and the XML of IES TM-27 (SPDX).
//!
//! ```text
//! # name: my lamp
//! # wavelength_unit: nm            nm, um, m; asked for if all wavelengths are below 10
//! # per: nm                        nm, um, m, or a band such as `band 5 nm`
//! wavelength_nm,flux,standard_uncertainty
//! 380,0.012,0.001
//! ```
//!
//! Nothing is guessed silently: whatever is converted, assumed or unusual is a remark, and remarks are for whoever gave the file. A
//! density is zero outside the rows of its file; a factor is what its reader says.

use super::table_text::{TextProblem, TextRules, parse_bytes};
use super::table_units::{Per, WavelengthUnit, per_nm, unit_of_column};
use super::{Density, Outside, SpectrumError, Table, spdx};

/// What the file is to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Meaning {
    /// A spectral distribution, per nm once read.
    Density,
    /// A reflectance, a transmittance, a responsivity.
    Factor,
}

/// What whoever reads a file states about it; a contradiction to the file itself is a problem.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FileRules {
    /// Unit of the wavelengths.
    pub wavelength_unit: Option<WavelengthUnit>,
    /// What the values are per.
    pub per: Option<Per>,
    /// Whether commas in numbers are decimal commas.
    pub decimal_comma: bool,
}

/// A curve with what its file says of it.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveFile {
    /// The rows; values per nm if it is a density.
    pub table: Table,
    /// Standard uncertainty of each row, in the unit of the values, if the file has it.
    pub standard_uncertainty: Option<Vec<f64>>,
    /// What the curve is called: `# name:`, or the description of an SPDX file.
    pub name: Option<String>,
    /// What the curve is: `# quantity:`, or the quantity of an SPDX file.
    pub quantity: Option<String>,
    /// Unit of the values, stated by the file in `# unit:` or in the name of their column; per nm if they were converted to that, and a
    /// remark says so.
    pub unit: Option<String>,
    /// Header lines as (key, value), in their order; keys in lower case.
    pub header: Vec<(String, String)>,
    /// How the file was understood.
    pub remarks: Vec<String>,
}

/// A spectral distribution from a file.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectrumFile {
    /// The distribution, per nm, zero outside the rows of the file.
    pub density: Density,
    /// Its rows, its uncertainties, and what the file says.
    pub curve: CurveFile,
}

/// Reads a spectral distribution, CSV or SPDX.
///
/// # Errors
/// Every problem with its line and column.
///
/// ```
/// use etendue::spectrum::file::{FileRules, read};
/// let text = "# wavelength_unit: um\n# per: um\n0,4;1,5\n0,5;2,5\n";
/// let file = read(text.as_bytes(), &FileRules::default()).unwrap();
/// assert_eq!(file.curve.table.wavelengths_nm(), [400.0, 500.0]);
/// assert_eq!(file.density.continuum_at(500.0), 2.5e-3);
/// assert!(file.curve.remarks.iter().any(|remark| remark.contains("converted from µm")));
/// ```
pub fn read(bytes: &[u8], rules: &FileRules) -> Result<SpectrumFile, Vec<TextProblem>> {
    let curve = read_curve(bytes, Meaning::Density, rules)?;
    let density = Density::table(curve.table.clone()).map_err(|error| vec![whole(error.to_string(), "")])?;
    Ok(SpectrumFile { density, curve })
}

/// Reads a curve of either meaning, CSV or SPDX. Errors as [`read`].
pub fn read_curve(bytes: &[u8], meaning: Meaning, rules: &FileRules) -> Result<CurveFile, Vec<TextProblem>> {
    let first = bytes.iter().find(|byte| !byte.is_ascii_whitespace() && ![0xef, 0xbb, 0xbf].contains(*byte));
    if first == Some(&b'<') { read_spdx(bytes, meaning, rules) } else { read_csv(bytes, meaning, rules) }
}

/// A problem of the file as a whole.
fn whole(message: impl Into<String>, help: impl Into<String>) -> TextProblem {
    TextProblem { line: 1, column: 1, message: message.into(), help: help.into() }
}

/// Names of a column that holds standard uncertainties.
fn is_uncertainty(name: &str) -> bool {
    matches!(name.trim().to_lowercase().replace([' ', '-'], "_").as_str(), "u" | "uncertainty" | "standard_uncertainty")
}

/// Whether a unit is one of photons: their number, or mol of them. As a distribution of power such numbers have the wrong shape.
fn counts_photons(unit: &str) -> bool {
    const PHOTONS: [&str; 9] = ["photon", "photons", "quanta", "mol", "mmol", "µmol", "μmol", "umol", "nmol"];
    unit.split(|c: char| !c.is_alphabetic()).any(|word| PHOTONS.contains(&word.to_lowercase().as_str()))
}

fn read_csv(bytes: &[u8], meaning: Meaning, rules: &FileRules) -> Result<CurveFile, Vec<TextProblem>> {
    let FileRules { wavelength_unit, per, decimal_comma } = *rules;
    let mut text = parse_bytes(bytes, &TextRules { wavelength_unit, per, decimal_comma, ..TextRules::default() })?;
    let second_is_uncertainty = text.column_names.get(1).is_some_and(|name| is_uncertainty(name));
    let columns = text.columns.len();
    if columns != 1 && !(columns == 2 && second_is_uncertainty) {
        let help = "a curve has two columns: wavelength in nm, value; a third may be called `standard_uncertainty`; if commas here are \
                    decimal commas, write points";
        return Err(vec![whole(format!("the file has {columns} columns of values"), help)]);
    }
    let mut uncertainty = if columns == 2 { text.columns.pop() } else { None };
    let mut values = text.columns.pop().unwrap_or_default();
    let mut remarks = std::mem::take(&mut text.remarks);
    match (meaning, text.per) {
        (Meaning::Factor, Some(per)) => {
            let message = format!("the values are {}, so the file is a spectral distribution; a factor is needed here", per.described());
            return Err(vec![whole(message, "give a reflectance, a transmittance or a responsivity")]);
        }
        (Meaning::Factor, None) => {}
        (Meaning::Density, Some(Per::Unit(WavelengthUnit::Nanometre))) => {}
        (Meaning::Density, Some(per)) => {
            let width_nm = per.width_nm();
            values.iter_mut().chain(uncertainty.iter_mut().flatten()).for_each(|value| *value /= width_nm);
            remarks.push(format!("values {} divided by {width_nm} to be per nm", per.described()));
        }
        (Meaning::Density, None) => {
            remarks.push("the file does not say what its values are per; they are taken per nm (`# per: nm` says so)".into());
        }
    }
    if text.wavelength_unit.is_none() {
        remarks
            .push("the file does not say in what unit its wavelengths are; they are taken in nm (`# wavelength_unit: nm` says so)".into());
    }
    let value = |key: &str| text.header_value(key).map(str::to_owned);
    let (name, quantity, unit) = (value("name"), value("quantity"), value("unit"));
    let column = text.column_names.first().filter(|_| meaning == Meaning::Density);
    let of_column = column.filter(|_| unit.is_none()).and_then(|name| Some((name.to_owned(), unit_of_column(name)?)));
    let (quantity, unit) = match of_column {
        Some((name, unit)) => (quantity.or(Some(name)), Some(unit)),
        None => (quantity, unit),
    };
    if let Some(unit) = unit.as_deref().filter(|unit| meaning == Meaning::Density && counts_photons(unit)) {
        let help = "a spectrum is in W here; multiply every row by the energy of its photons, hc/λ, and correct the unit";
        return Err(vec![whole(format!("the unit `{unit}` counts photons"), help)]);
    }
    let unit = unit.map(|unit| if meaning == Meaning::Density && text.per.is_some() { per_nm(&unit) } else { unit });
    let wavelengths_nm = text.wavelengths_nm;
    finish(
        CurveFile {
            table: table(wavelengths_nm, values)?,
            standard_uncertainty: uncertainty,
            name,
            quantity,
            unit,
            header: text.header,
            remarks,
        },
        meaning,
    )
}

fn read_spdx(bytes: &[u8], meaning: Meaning, rules: &FileRules) -> Result<CurveFile, Vec<TextProblem>> {
    let found = spdx::read(bytes)?;
    let stated = |states: bool, what: &str| states.then(|| whole(format!("{what}, but an SPDX file has nm"), "leave the option out"));
    let unit =
        stated(rules.wavelength_unit.is_some_and(|unit| unit != WavelengthUnit::Nanometre), "the option says another unit of wavelengths");
    let per = stated(rules.per.is_some_and(|per| per != Per::Unit(WavelengthUnit::Nanometre)), "the option says another interval");
    let contradictions: Vec<TextProblem> = unit.into_iter().chain(per).collect();
    if !contradictions.is_empty() {
        return Err(contradictions);
    }
    let quantity = found.quantity;
    if let Some(other) = quantity.meaning().filter(|other| *other != meaning) {
        let (line, column) = found.quantity_place;
        let message = match other {
            Meaning::Factor => format!("`{}` is a factor; a spectral distribution is needed here", quantity.name()),
            Meaning::Density => format!("`{}` is a spectral distribution; a factor is needed here", quantity.name()),
        };
        let help = format!("allowed here: {}", spdx::SpectralQuantity::names_of(meaning).join(", "));
        return Err(vec![TextProblem { line, column, message, help }]);
    }
    let remarks = found.remarks.clone();
    let header = found.header.entries();
    let name = found.header.description.clone();
    let curve = CurveFile {
        table: table(found.wavelengths_nm, found.values)?,
        standard_uncertainty: None,
        name,
        quantity: Some(quantity.name().to_owned()),
        unit: quantity.unit().map(str::to_owned),
        header,
        remarks,
    };
    finish(curve, meaning)
}

fn table(wavelengths_nm: Vec<f64>, values: Vec<f64>) -> Result<Table, Vec<TextProblem>> {
    Table::new(wavelengths_nm, values, Outside::Zero).map_err(|error| vec![whole(error.to_string(), "")])
}

/// Remarks that the rows themselves give rise to.
fn finish(mut curve: CurveFile, meaning: Meaning) -> Result<CurveFile, Vec<TextProblem>> {
    curve.remarks.extend(gaps(curve.table.wavelengths_nm()));
    let (from_nm, to_nm) = curve.table.range_nm();
    if meaning == Meaning::Density {
        curve.remarks.push(format!("zero outside {from_nm} nm to {to_nm} nm, the range of the file"));
    }
    Ok(curve)
}

/// Steps that are far larger than the others: rows may be missing there.
fn gaps(wavelengths_nm: &[f64]) -> Vec<String> {
    const FAR_LARGER: f64 = 3.5;
    const TOLD: usize = 3;
    let mut steps: Vec<f64> = wavelengths_nm.windows(2).map(|pair| pair[1] - pair[0]).collect();
    steps.sort_by(f64::total_cmp);
    let Some(&usual) = steps.get(steps.len() / 2).filter(|_| steps.len() >= 4) else { return Vec::new() };
    let wide: Vec<&[f64]> = wavelengths_nm.windows(2).filter(|pair| pair[1] - pair[0] > FAR_LARGER * usual).collect();
    let mut told: Vec<String> = wide
        .iter()
        .take(TOLD)
        .map(|pair| format!("a gap: no row between {} nm and {} nm, where the curve is a straight line", pair[0], pair[1]))
        .collect();
    if wide.len() > TOLD {
        told.push(format!("and {} more gaps", wide.len() - TOLD));
    }
    told
}

/// The text of a CSV file that [`read`] understands without a remark on its units. `header` lines are written in their order; those that
/// speak of units of wavelength, intervals and decimal marks are not, because the text has its own, and a `unit` that is not per nm
/// becomes `unit_before`. Line ends within a header become blanks.
///
/// # Errors
/// If there are not as many uncertainties as rows.
pub fn write_csv(
    table: &Table,
    standard_uncertainty: Option<&[f64]>,
    meaning: Meaning,
    header: &[(String, String)],
) -> Result<String, SpectrumError> {
    use std::fmt::Write;
    let rows = table.values().len();
    if let Some(uncertainties) = standard_uncertainty.filter(|uncertainties| uncertainties.len() != rows) {
        return Err(SpectrumError::LengthsDiffer { wavelengths: rows, values: uncertainties.len() });
    }
    let mut text = String::new();
    let one_line = |part: &str| part.split(['\r', '\n']).collect::<Vec<_>>().join(" ").trim().to_owned();
    let mut written: Vec<String> = ["wavelength_unit", "per", "decimal"].map(str::to_owned).to_vec();
    for (key, value) in header {
        let per_other = key == "unit" && Per::of_unit(value).is_some_and(|per| per != Per::Unit(WavelengthUnit::Nanometre));
        let key = if per_other { "unit_before".to_owned() } else { one_line(key).replace(':', " ").trim().to_lowercase() };
        if !written.contains(&key) {
            let _ = writeln!(text, "# {key}: {}", one_line(value));
            written.push(key);
        }
    }
    text.push_str("# wavelength_unit: nm\n");
    if meaning == Meaning::Density {
        text.push_str("# per: nm\n");
    }
    text.push_str(if standard_uncertainty.is_some() { "wavelength_nm,value,standard_uncertainty\n" } else { "wavelength_nm,value\n" });
    for (index, (nm, value)) in table.rows().enumerate() {
        let _ = match standard_uncertainty {
            Some(uncertainties) => writeln!(text, "{nm},{value:e},{:e}", uncertainties[index]),
            None => writeln!(text, "{nm},{value:e}"),
        };
    }
    Ok(text)
}

/// The XML of IES TM-27 for a curve; see [`spdx::write`]. Lines of a density have no place in it, and neither have uncertainties.
pub fn write_spdx(table: &Table, quantity: spdx::SpectralQuantity, header: &spdx::SpdxHeader) -> String {
    spdx::write(&spdx::Spdx {
        header: header.clone(),
        quantity,
        quantity_place: (1, 1),
        reflection_geometry: None,
        transmission_geometry: None,
        bandwidth_fwhm_nm: None,
        bandwidth_corrected: None,
        wavelengths_nm: table.wavelengths_nm().to_vec(),
        values: table.values().to_vec(),
        remarks: Vec::new(),
    })
}

#[cfg(test)]
#[path = "tests/file.rs"]
mod tests;
