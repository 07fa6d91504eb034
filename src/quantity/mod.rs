//! Units: the two-way table of quantity and system as types.
//!
//! The rows are energy, flux, flux density that arrives, flux density that leaves, radiance and intensity; the columns
//! are the radiant, the luminous, the photon, the scotopic, the mesopic and the five α-opic systems. A cell is a type, so that lux and
//! W/m² cannot be added.
//!
//! | file | holds |
//! |---|---|
//! | [`constants`] | exact constants of the SI and the convention for wavelengths and lumens |
//! | [`air`] | wavelength in air and in vacuum |
//! | [`table`] | the table as types, with name, symbol and unit of every cell |
//! | [`cell`] | name, symbol and units of every cell, as types and as a list |
//! | [`extent`] | distance, area, solid angle, projected solid angle, étendue, duration |
//! | [`solid_angle`] | solid angles of patches, rectangles, zones and triangles |
//! | [`relation`] | the physical products between cells and extents |
//! | [`emission`] | what a lamp emits: from its electrical power, isotropic, Lambertian, as a power of the cosine |
//! | [`photon`] | photons of monochromatic radiation |
//! | [`measurand`] | the same words as run-time data, for readings and reports |

pub mod air;
pub mod cell;
pub mod constants;
pub mod emission;
pub mod extent;
pub mod measurand;
pub mod photon;
pub mod relation;
pub mod solid_angle;
pub mod table;

pub use extent::{Area, Distance, Duration, Etendue, ProjectedSolidAngle, SolidAngle};
pub use measurand::Measurand;
pub use table::{Cell, Quantity};
