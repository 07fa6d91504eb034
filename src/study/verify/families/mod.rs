//! How the cases of each family are computed: from their inputs alone, so that further cases of a family need no code.
//!
//! A file a part of the project; each holds a table of its families and is named in `all`.

mod calibration;
mod colour;
mod emva;
mod extreme;
pub mod observers;
mod quality;
pub mod radiometry;
mod spectra;
mod transport;

use super::case::{Case, Fault, Found};

/// What a family makes of a case.
pub type Outcome = Result<Found, Fault>;

/// Builds the scene of a case from its inputs, or calls the function, and answers with the quantity that the case asks for.
pub type Family = fn(&Case) -> Outcome;

/// Names and functions of the families of a file.
pub(super) type Families = &'static [(&'static str, Family)];

/// All families by name.
pub(super) fn all() -> impl Iterator<Item = (&'static str, Family)> {
    [
        radiometry::FAMILIES,
        extreme::FAMILIES,
        spectra::FAMILIES,
        colour::FAMILIES,
        observers::FAMILIES,
        quality::FAMILIES,
        transport::FAMILIES,
        emva::FAMILIES,
        calibration::FAMILIES,
    ]
    .into_iter()
    .flatten()
    .copied()
}

/// An input that describes in words what the function does: it must be the words that the function was written for.
fn stated(c: &Case, key: &str, words: &str) -> Result<(), Fault> {
    let found = c.text(key)?;
    if found == words { Ok(()) } else { Err(Fault::wrong(format!("`{key}` is `{found}`; this family computes `{words}`"))) }
}

/// A constant of the case: it must be that of the library.
fn stated_number(c: &Case, key: &str, constant: f64) -> Result<(), Fault> {
    let found = c.number(key)?;
    if found == constant { Ok(()) } else { Err(Fault::wrong(format!("`{key}` is {found}; the constant of the library is {constant}"))) }
}
