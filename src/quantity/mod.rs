//! Units: the two-way table of quantity and system as types.
//!
//! The rows are energy, flux, flux density that arrives, flux density that leaves, radiance and intensity; the columns
//! are the radiant, the luminous and the photon system. A cell is a type, so that lux and W/m² cannot be added.
//!
//! | file | holds |
//! |---|---|
//! | [`constants`] | exact constants of the SI and the convention for wavelengths and lumens |
//! | [`air`] | wavelength in air and in vacuum |
//! | [`table`] | the table as types, with name, symbol and unit of every cell |
//! | [`extent`] | distance, area, solid angle, étendue, duration |
//! | [`relation`] | the physical products between cells and extents |
//! | [`photon`] | photons of monochromatic radiation |
//! | [`measurand`] | the same words as run-time data, for readings and reports |

pub mod air;
pub mod constants;
pub mod extent;
pub mod measurand;
pub mod photon;
pub mod relation;
pub mod table;

pub use extent::{Area, Distance, Duration, Etendue, SolidAngle};
pub use measurand::Measurand;
pub use table::{Cell, Quantity};
