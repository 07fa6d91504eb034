//! Functions of wavelength: densities, factors, lines, exact product integrals.
//!
//! Two kinds of function, and they do not mix:
//!
//! | kind | type | examples | per nm? |
//! |---|---|---|---|
//! | density | [`Density`] | spectral flux, spectral radiance, a laser line | yes |
//! | factor | [`Factor`] | reflectance, transmittance, responsivity, V(λ) | no |
//!
//! A density times factors, integrated over wavelength, is a number ([`Density::integral`]); there is no other way from a
//! spectrum to a number. Wavelengths are in nm, in air, and positive.
//!
//! | file | what it holds |
//! |---|---|
//! | `table` | piecewise-linear tables |
//! | `support` | sets of wavelengths where something is not zero |
//! | `factor` | dimensionless functions |
//! | `density` | continuum and lines |
//! | `black_body` | Planck's law |
//! | `daylight` | the CIE's D series |
//! | `product_integral` | exact integrals of products |
//! | `integrals` | many of them at once |
//! | `table_product` | the same for tables alone, by closed forms |
//! | `kernel` | weights of a grid: integrals as dot products |
//! | `resample` | other grids, on request, with the error stated |
//! | `term` | a density times factors, cut into smooth pieces |
//! | `quadrature` | few wavelengths and positive weights for path products |
//! | `peak` | peak wavelength and half width |
//! | `placement` | greedy choice of those wavelengths |
//! | `test_products` | products of reflectances on which a quadrature is tried |
//! | `photometry` | radiant, luminous and photon totals |
//! | `table_text`, `table_reader`, `table_row`, `table_units`, `decimal_comma` | text of a curve file to columns, or all its problems |
//! | `file` | spectra and factors from files, and to files |
//! | `library` | embedded tables by name |

pub mod black_body;
pub mod daylight;
pub(crate) mod decimal_comma;
mod density;
mod error;
mod factor;
pub mod file;
mod gauss_legendre;
mod integrals;
pub mod kernel;
pub mod library;
mod peak;
pub mod photometry;
mod placement;
mod product_integral;
pub mod quadrature;
pub mod resample;
mod scaled_number;
pub mod spdx;
mod support;
mod table;
mod table_product;
mod table_reader;
mod table_row;
pub mod table_text;
pub mod table_units;
mod term;
mod test_products;

pub use density::{Continuum, Density, LED_WIDTH_OVER_FWHM, Line};
pub use error::SpectrumError;
pub use factor::Factor;
pub use peak::Peak;
pub use support::Support;
pub use table::{Outside, Table};

#[cfg(test)]
mod tests;
