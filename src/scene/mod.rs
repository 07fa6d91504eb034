//! A validated scene: what the plan is made of.
//!
//! ```text
//! text ─ document.rs → values with their places ─ the readers → Scene, or every problem at once (diagnostic.rs)
//! ```

pub mod instrument;

pub use instrument::{Instrument, Layout, Pose};

use crate::geometry::shape::Shape;
use crate::source::Source;
use crate::surface::Surface;

/// A piece of surface that a ray can meet.
#[derive(Clone, Debug)]
pub struct Element {
    /// The object or source of the scene file that it belongs to.
    pub owner: String,
    /// Where it is.
    pub shape: Shape,
    /// Index into [`Scene::surfaces`] of what covers the front.
    pub front: usize,
    /// Index into [`Scene::surfaces`] of what covers the back.
    pub back: usize,
}

/// Everything that is needed to plan and to measure. A scene that exists is valid: it cannot fail to plan.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// What it is called in reports.
    pub title: String,
    /// What a ray can meet; the emitting surfaces of area sources are among them.
    pub elements: Vec<Element>,
    /// What covers the elements.
    pub surfaces: Vec<Surface>,
    /// What emits.
    pub sources: Vec<Source>,
    /// What is read, at least one instrument.
    pub instruments: Vec<Instrument>,
    /// A hash of every file that the scene was read from; zero for a scene made in memory.
    pub hash: u64,
}
