//! Étendue: put a modelled instrument into a modelled scene and read it, with a stated uncertainty.
pub mod estimate;
pub mod geometry;
pub mod math;
pub mod metrology;
pub mod quantity;
pub mod scene;
pub mod spectrum;
