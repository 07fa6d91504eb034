//! A validated scene: what the plan is made of, and the reader of scene and sensor files.
//!
//! ```text
//! text ─ document.rs → values with their places ─ the readers → Scene ─ checks/ → Scene, or every problem at once (diagnostic.rs)
//! ```
//!
//! | file | what it reads |
//! |---|---|
//! | `document`, `syntax` | text → tree of values with places |
//! | `decode` | values → fields, numbers, vectors, names |
//! | `files`, `reading` | the door to files, the root, what has been read already |
//! | `placement`, `shape_reader`, `mesh_reader`, `mesh_file` | where things are, and what shape they have |
//! | `spectrum_reader`, `factor_range`, `surface_reader`, `strength` | spectra, factors, surfaces, how strong a source is |
//! | `spectrum_argument` | one spectrum or factor given as text |
//! | `object_reader`, `source_reader`, `instrument_reader` | the items of a scene |
//! | `sensor_reader`, `channel_reader`, `adjustment`, `observer_reader`, `directional_table` | sensor files |
//! | `camera_reader` | cameras and their files |
//! | `pixel_reader` | camera pixels |
//! | `responsivity_reader`, `readout_reader` | their curves with units and uncertainties, their electronics |
//! | `reader` | the scene as a whole |
//! | `calibration`, `calibration_reader`, `exposure_reader`, `curve_model_reader`, `substitution_reader` | calibration files: a bench and what is put in front of the sensor |
//! | `checks` | what only the scene as a whole can show |

mod acceptance_reader;
mod adjustment;
pub mod calibration;
mod calibration_reader;
pub mod camera;
mod camera_reader;
mod channel_reader;
mod checks;
mod curve_model_reader;
mod decode;
mod device;
pub mod diagnostic;
mod directional_table;
pub mod document;
mod exposure_reader;
mod factor_range;
pub mod files;
pub mod instrument;
mod instrument_reader;
pub mod mesh_file;
mod mesh_reader;
mod object_reader;
mod observer_reader;
mod pixel_reader;
mod placement;
mod reader;
mod reading;
mod readout_reader;
mod responsivity_reader;
mod sensor_reader;
mod shape_reader;
mod source_reader;
pub mod spectrum_argument;
mod spectrum_reader;
mod strength;
mod substitution_reader;
mod surface_reader;
mod syntax;
#[cfg(test)]
mod tests;

pub use calibration::{Beam, Calibration, CurveModel, Exposure, Noise, Substitution};
pub use calibration_reader::read_calibration;
pub use camera::{PlacedCamera, Region};
pub use device::{Device, characterised_from_file, device_from_file, held_by, sensor_from_file};
pub use diagnostic::{Diagnostic, Diagnostics};
pub use files::{FileProblem, Files, MemoryFiles};
pub use instrument::{Instrument, Layout, Pose};
pub use instrument_reader::MOST_POSES;
pub use pixel_reader::pixel_from_file;
pub use reader::{read_scene, scene_from_text};
pub use spectrum_argument::{GivenFactor, GivenSpectrum, factor_from_text, spectrum_from_text};

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
    /// What is read; at least one instrument or camera.
    pub instruments: Vec<Instrument>,
    /// What takes pictures.
    pub cameras: Vec<PlacedCamera>,
    /// How curve files were understood: converted units, decimal commas, gaps. No problem, but to be said.
    pub remarks: Vec<String>,
    /// A hash of every file that the scene was read from; zero for a scene made in memory.
    pub hash: u64,
}
