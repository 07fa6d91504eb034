//! Étendue: put a modelled instrument into a modelled scene and read it, with a stated uncertainty.
pub mod estimate;
pub mod geometry;
pub mod math;
pub mod measurement;
pub mod metrology;
pub mod plan;
pub mod quantity;
pub mod report;
pub mod scene;
pub mod sensor;
pub mod source;
pub mod spectrum;
pub mod surface;
