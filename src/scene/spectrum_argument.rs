//! One spectrum or one factor given as text, as on a command line, in the grammar of scene files.
//!
//! | text | what it is |
//! |---|---|
//! | `D65`, `"D65"`, `CIE illuminant A` | from the library, with or without quotes |
//! | `lamp.csv`, `../lamp.spdx` | a file, by any path that [`Files`] can read |
//! | `BlackBody(3000)`, `Sum([(0.7, "A"), (0.3, Line(546))])` | a form of scene files; see `spectrum_reader` |
//!
//! What is said about the text has the file name `argument`, line 1, and the column of the text.

use super::decode::Value;
use super::diagnostic::Diagnostics;
use super::document::{Document, Kind};
use super::files::Files;
use super::reading::Reading;
use super::spectrum_reader::{FACTORS, SPECTRA, is_file, read_factor, read_spectrum};
use crate::naming::nearest;
use crate::spectrum::file::{CurveFile, Meaning};
use crate::spectrum::{Density, Factor, Outside};

/// What the text is called in messages.
const ARGUMENT: &str = "argument";

/// A spectrum that was given as text.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenSpectrum {
    /// The spectrum; its absolute scale is what the file or the law says.
    pub density: Density,
    /// The text as it was given, without quotes around it.
    pub name: String,
    /// The file it came from, if the text names one: rows, standard uncertainties, header, unit.
    pub file: Option<CurveFile>,
    /// How files were understood: converted units, decimal commas, gaps. To be shown to whoever gave the text.
    pub remarks: Vec<String>,
}

/// A factor that was given as text.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenFactor {
    /// The factor.
    pub factor: Factor,
    /// The text as it was given, without quotes around it.
    pub name: String,
    /// The file it came from, if the text names one.
    pub file: Option<CurveFile>,
    /// How files were understood. To be shown to whoever gave the text.
    pub remarks: Vec<String>,
}

/// Reads a spectrum.
///
/// # Errors
/// Every problem of the text and of the files that it names.
///
/// ```
/// use etendue::scene::{MemoryFiles, spectrum_from_text};
/// let given = spectrum_from_text("Line(546.07)", &MemoryFiles::new())?;
/// assert_eq!(given.density.total(), 1.0);
/// let unknown = spectrum_from_text("D56", &MemoryFiles::new()).unwrap_err();
/// assert!(unknown.to_string().contains("D65"));
/// # Ok::<(), etendue::scene::Diagnostics>(())
/// ```
pub fn spectrum_from_text(text: &str, files: &dyn Files) -> Result<GivenSpectrum, Diagnostics> {
    let (density, name, file, remarks) = given(text, &SPECTRA, Meaning::Density, files, read_spectrum)?;
    Ok(GivenSpectrum { density, name, file, remarks })
}

/// Reads a factor: a reflectance, a transmittance, a responsivity, a weighting function. `outside` is what a table is worth beyond its
/// ends.
///
/// # Errors
/// Every problem of the text and of the files that it names.
///
/// ```
/// use etendue::{scene::{MemoryFiles, factor_from_text}, spectrum::Outside};
/// let given = factor_from_text("V(lambda)", Outside::Zero, &MemoryFiles::new())?;
/// assert_eq!(given.factor.at(555.0), 1.0);
/// # Ok::<(), etendue::scene::Diagnostics>(())
/// ```
pub fn factor_from_text(text: &str, outside: Outside, files: &dyn Files) -> Result<GivenFactor, Diagnostics> {
    let (factor, name, file, remarks) =
        given(text, &FACTORS, Meaning::Factor, files, |value, reading| read_factor(value, outside, reading))?;
    Ok(GivenFactor { factor, name, file, remarks })
}

/// The value, its name, the file that it is, and the remarks.
type Given<T> = (T, String, Option<CurveFile>, Vec<String>);

fn given<T>(
    text: &str,
    forms: &[&str],
    meaning: Meaning,
    files: &dyn Files,
    read: impl Fn(&Value, &mut Reading) -> Option<T>,
) -> Result<Given<T>, Diagnostics> {
    let document = if is_written_out(text, forms) {
        Document::parse(ARGUMENT, text).map_err(|problem| Diagnostics(vec![*problem]))?
    } else {
        Document::of_text(ARGUMENT, text.trim())
    };
    let mut reading = Reading::anywhere(files, ARGUMENT);
    let value = Value::root(&document);
    let found = read(&value, &mut reading);
    match found {
        Some(found) if reading.problems.count() == 0 => {
            let (name, file) = match &document.root.kind {
                Kind::Text(name) => (name.clone(), reading.curves.get(&(name.clone(), meaning)).cloned().flatten()),
                _ => (text.trim().to_owned(), None),
            };
            Ok((found, name, file, reading.remarks))
        }
        _ => Err(reading.problems.finish()),
    }
}

/// Whether the text is a value of a scene file rather than a bare name: a text in quotes, a number, or one of the forms, also a
/// misspelt one. `V(lambda)` and `CIE illuminant A` are names.
fn is_written_out(text: &str, forms: &[&str]) -> bool {
    let text = text.trim();
    if text.starts_with(['"', '[', '{', '(']) || text.parse::<f64>().is_ok() {
        return true;
    }
    if is_file(text) && !text.contains('(') {
        return false;
    }
    let name = text.split('(').next().unwrap_or_default().trim_end();
    if crate::spectrum::library::entry(text).is_ok() {
        return false;
    }
    forms.contains(&name) || (text.contains('(') && nearest(name, forms.iter().copied()).is_some())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::MemoryFiles;

    fn files() -> MemoryFiles {
        MemoryFiles::new()
            .with("lamp.csv", "# wavelength_unit: nm\n# per: nm\n400,1\n500,2\n")
            .with("/data/Lamp.CSV", "# wavelength_unit: nm\n# per: nm\n400,1\n500,2\n")
            .with("../my lamp.csv", "400;1,5\n500;2\n")
            .with("paint.csv", "400,0.5\n500,0.6\n")
            .with("broken.csv", "400,1\n400,x\n")
    }

    #[test]
    fn names_files_and_forms_are_told_apart() {
        for text in [
            "A",
            "\"A\"",
            " D65 ",
            "LED-B3",
            "led b3",
            "CIE illuminant A",
            "lamp.csv",
            "\"lamp.csv\"",
            "/data/Lamp.CSV",
            "../my lamp.csv",
            "Line(546.07)",
            "BlackBody(3000)",
            "Daylight(cct_k: 5500)",
            "Led(peak_nm: 530, fwhm_nm: 30)",
            "Sum([(0.7, \"A\"), (0.3, Line(546))])",
            "Filtered(\"A\", \"V\")",
            "Sum([(0.7, \"lamp.csv\"), (0.3, \"/data/Lamp.CSV\")])",
        ] {
            assert!(spectrum_from_text(text, &files()).is_ok(), "{text}: {}", spectrum_from_text(text, &files()).unwrap_err());
        }
        for text in ["V", "V(lambda)", "0.5", "Band(from_nm: 400, to_nm: 500)", "Product([\"V\", 0.5])", "paint.csv"] {
            assert!(factor_from_text(text, Outside::Zero, &files()).is_ok(), "{text}");
        }
        assert_eq!(spectrum_from_text("\"A\"", &files()).unwrap().name, "A");
    }

    #[test]
    fn what_is_wrong_is_said_with_its_column() {
        let told = |text: &str| {
            let problems = spectrum_from_text(text, &files()).unwrap_err();
            (problems.0[0].column, problems.to_string())
        };
        for (text, column, words) in [
            ("LED-B33", 1, "LED-B3"),
            ("lamp.cvs", 1, "no spectrum called"),
            ("lmap.csv", 1, "did you mean `lamp.csv`"),
            ("BlackBdy(3000)", 1, "did you mean `BlackBody`"),
            ("BlackBody(-3)", 11, "1e-12 K to 1e9 K"),
            ("BlackBody", 1, "write `BlackBody(2856)`"),
            ("Daylight(cct_k: 3000)", 17, "4000 to 25000"),
            ("Sum([(0.7, \"A\"), (0.3, Lin(546))])", 24, "did you mean `Line`"),
            ("Line(546", 1, ""),
            ("V", 1, "a spectral distribution is needed here"),
            ("", 1, ""),
        ] {
            let (found, message) = told(text);
            assert!(message.contains(words), "{text}: {message}");
            assert!(found == column || words.is_empty(), "{text}: column {found}\n{message}");
            assert!(message.contains("argument"), "{message}");
        }
        let problems = spectrum_from_text("broken.csv", &files()).unwrap_err();
        assert_eq!((problems.0[0].file.as_str(), problems.0[0].line), ("broken.csv", 2));
    }

    proptest::proptest! {
        #[test]
        fn any_text_ends_in_a_spectrum_or_in_problems(text in "[()\\[\\]A-Za-z0-9 .,:\"{}µ-]{0,60}") {
            for problems in [spectrum_from_text(&text, &files()).err(), factor_from_text(&text, Outside::Hold, &files()).err()].into_iter().flatten() {
                proptest::prop_assert!(!problems.0.is_empty() && problems.0.iter().all(|p| p.line >= 1 && p.column >= 1));
            }
        }
    }
}
