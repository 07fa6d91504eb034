//! `etendue plot sensor`.

use clap::ValueEnum;
use etendue::report::plot::{self, Chart};
use etendue::scene::sensor_from_file;

use super::output::Output;
use super::{all, bad};
use crate::{Failure, disk};

#[derive(clap::Args)]
pub(super) struct Arguments {
    /// Sensor files (.ron).
    #[arg(required = true)]
    sensors: Vec<String>,
    /// What of them.
    #[arg(long, value_enum, default_value_t = View::Responsivity, conflicts_with = "polar")]
    view: View,
    /// The directional response in polar coordinates; the same as `--view polar`.
    #[arg(long)]
    polar: bool,
    #[command(flatten)]
    pub(super) output: Output,
}

#[derive(Clone, Copy, ValueEnum)]
enum View {
    /// Spectral responsivity of each channel, with V(λ) behind.
    Responsivity,
    /// Response over the angle of incidence, with the cosine behind.
    Directional,
    /// Deviation from the cosine over the angle of incidence.
    Deviation,
    /// The directional response in polar coordinates.
    Polar,
}

impl Arguments {
    pub(super) fn chart(&self) -> Result<Chart, Failure> {
        let sensors = all(&self.sensors, |path| sensor_from_file(path, &disk::Anywhere, None))?;
        match if self.polar { View::Polar } else { self.view } {
            View::Responsivity => plot::sensor::responsivity(&sensors),
            View::Directional => plot::sensor::directional(&sensors),
            View::Deviation => plot::sensor::deviation(&sensors),
            View::Polar => plot::polar::chart(&sensors),
        }
        .map_err(bad)
    }
}
