//! The equations of a lecture on radiometry and photometry, each by name: formula, inputs with units, result.
//!
//! | file | what |
//! |---|---|
//! | `equation` | what an equation consists of |
//! | `answer` | text in, number and unit out, or every problem at once |
//! | `photons`, `emission`, `solid_angles`, `collecting`, `photometry`, `black_bodies` | the catalogue, as the lecture goes |
//!
//! Every equation is a call of the function of the library that everything else uses; nothing is computed here.
//!
//! ```
//! use etendue::{lecture, scene::MemoryFiles};
//!
//! let answer = lecture::answer("photon-energy", &[("wavelength_nm", "555")], &MemoryFiles::new()).unwrap();
//! assert_eq!(answer.equation.formula, "Q = h c / λ");
//! assert_eq!((format!("{:.4e}", answer.value).as_str(), answer.unit), ("3.5792e-19", "J"));
//! ```

mod answer;
mod black_bodies;
mod collecting;
mod emission;
mod equation;
mod photometry;
mod photons;
mod solid_angles;
#[cfg(test)]
mod tests;

pub use answer::{Answer, Form, GivenInput, Problem, answer};
pub use equation::{Also, Domain, Equation, Given, Group, Input, Outcome, SYSTEMS_IN_KEYS, Unit};

/// Every equation, group by group.
pub fn equations() -> impl Iterator<Item = &'static Equation> {
    [
        photons::EQUATIONS,
        emission::EQUATIONS,
        solid_angles::EQUATIONS,
        collecting::EQUATIONS,
        photometry::EQUATIONS,
        black_bodies::EQUATIONS,
    ]
    .into_iter()
    .flatten()
}
