//! Calibrations as files.
//!
//! | file | what |
//! |---|---|
//! | `text.rs` | a page for a person: what was found, how well, what was not seen |
//! | `consistency.rs` | the part of that page on readings that contradict the rest |
//! | `parametric.rs` | the part of that page on the parameters of a model |
//! | `json.rs` | everything, for programs |
//! | `curve.rs` | the curve as CSV, a root of its covariance, readings and residuals |
//! | `sensor.rs` | a sensor file with the fitted curves, to be used in scenes |

mod consistency;
mod curve;
mod json;
mod parametric;
mod sensor;
mod text;

pub use curve::{covariance_root_to_csv, curve_to_csv, readings_to_csv};
pub use json::to_json;
pub use sensor::{directional_to_csv, to_sensor_file};
pub use text::to_text;

/// A name of a channel as a part of a file's name.
#[must_use]
pub fn file_part(channel: &str) -> String {
    let plain: String = channel.chars().map(|c| if c.is_alphanumeric() || c == '-' || c == '_' { c } else { '-' }).collect();
    if plain.is_empty() { "channel".to_owned() } else { plain }
}
