//! The eye: luminous efficiency, cones, colour matching, α-opic action spectra, and the colour of a spectrum.
//!
//! An observer is a set of curves like any other sensor's; what makes it an observer is what the curves stand for.
//!
//! ```text
//! excitation = k ∫ X_e,λ(λ) s(λ) dλ
//! ```
//!
//! | file | what it holds | s(λ) | source |
//! |---|---|---|---|
//! | `efficiency` | luminous quantities | V, V′, V_M, V_F, V_F,10, V_10 | ISO 23539, CIE 086, CIE 170-2, CIE 165 |
//! | `mesopic` | luminances between starlight and lamplight | V_mes,m | CIE 191 (MES2) |
//! | `cones` | excitation of the three cones | l̄, m̄, s̄ | CIE 170-1 |
//! | `individual` | cones of an age and a field | computed | CIE 170-1 |
//! | `components` | what they are computed from: lens, macula, pigments | | CIE 170-1 |
//! | `template` | visual pigments of any wavelength of maximum | S(λ) | Govardovskii 2000 |
//! | `matching` | tristimulus values | x̄ ȳ z̄, r̄ ḡ b̄ | CIE 015 |
//! | `colour` | the colour of a spectrum: XYZ, xy, CCT, dominant wavelength, sRGB | | CIE 015, IEC 61966-2-1 |
//! | `alpha_opic` | the five photoreceptors behind non-visual responses | s_α | CIE S 026 |
//! | `conversion` | a quantity in another system, through a spectrum | all of them | |
//! | `sheet` | every quantity of one spectrum | all of them | |

pub mod alpha_opic;
pub mod colour;
pub mod components;
pub mod cones;
pub mod conversion;
pub mod efficiency;
mod error;
pub mod individual;
pub mod matching;
pub mod mesopic;
mod names;
pub mod sheet;
pub mod template;

pub use alpha_opic::AlphaOpic;
pub use components::Components;
pub use cones::{Cone, Cones};
pub use efficiency::Efficiency;
pub use error::ObserverError;
pub use individual::Individual;
pub use matching::Matching;
pub use mesopic::Mesopic;

use crate::spectrum::{Factor, library};

/// A curve of the library. NaN everywhere if it has none of this name, which the tests exclude for every name asked for here.
fn embedded(name: &str) -> Factor {
    library::factor(name).unwrap_or(Factor::Constant(f64::NAN))
}

#[cfg(test)]
mod tests;
