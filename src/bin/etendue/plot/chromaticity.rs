//! `etendue plot chromaticity`.

use clap::ValueEnum;
use etendue::observer::Matching;
use etendue::report::plot::Chart;
use etendue::report::plot::chromaticity::{Contents, Diagram, DisplayGamut, chart};
use etendue::scene::{sensor_from_file, spectrum_from_text};

use super::output::Output;
use super::{all, bad, official};
use crate::{Failure, complain, disk};

#[derive(clap::Args)]
pub(super) struct Arguments {
    /// Spectra to put on it: files (.csv, .spdx), names of the library such as LED-B3, or forms such as "BlackBody(3000)".
    spectra: Vec<String>,
    /// Coordinates.
    #[arg(long, value_enum, default_value_t = DiagramName::Xy)]
    diagram: DiagramName,
    /// Observer.
    #[arg(long, value_enum, default_value_t = ObserverName::Cie1931)]
    observer: ObserverName,
    /// White points, by their names in the library; none with `--white ""`.
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', default_value = "A,D50,D65,E")]
    white: Vec<String>,
    /// Gamuts of displays: sRGB, "Display P3", "Rec. 2020", "Adobe RGB" (CIE 1931 only).
    #[arg(long, value_name = "NAME,…", value_delimiter = ',')]
    gamut: Vec<String>,
    /// The gamut of a display whose primaries have these spectra, in order around it.
    #[arg(long, value_name = "SPECTRUM", num_args = 3..)]
    primaries: Vec<String>,
    /// What the channels of a sensor file select out of the equal-energy spectrum, as if they were filters; three channels or more.
    #[arg(long, value_name = "FILE")]
    sensor: Vec<String>,
    #[command(flatten)]
    pub(super) output: Output,
}

#[derive(Clone, Copy, ValueEnum)]
enum DiagramName {
    /// CIE x, y.
    Xy,
    /// CIE 1976 u′, v′.
    Uv,
}

#[derive(Clone, Copy, ValueEnum)]
enum ObserverName {
    /// CIE 1931, 2°.
    #[value(name = "1931")]
    Cie1931,
    /// CIE 1964, 10°.
    #[value(name = "1964")]
    Cie1964,
    /// CIE 2015, 2°.
    #[value(name = "2015-2")]
    Cie2015TwoDegree,
    /// CIE 2015, 10°.
    #[value(name = "2015-10")]
    Cie2015TenDegree,
}

impl Arguments {
    pub(super) fn chart(&self) -> Result<Chart, Failure> {
        let observer = match self.observer {
            ObserverName::Cie1931 => Matching::Cie1931,
            ObserverName::Cie1964 => Matching::Cie1964,
            ObserverName::Cie2015TwoDegree => Matching::Cie2015TwoDegree,
            ObserverName::Cie2015TenDegree => Matching::Cie2015TenDegree,
        };
        let diagram = match self.diagram {
            DiagramName::Xy => Diagram::Xy,
            DiagramName::Uv => Diagram::UvPrime,
        };
        let given = all(&self.spectra, |text| spectrum_from_text(text, &disk::Anywhere))?;
        let primaries = all(&self.primaries, |text| spectrum_from_text(text, &disk::Anywhere))?;
        given.iter().chain(&primaries).flat_map(|one| &one.remarks).for_each(|remark| complain(&format!("remark: {remark}")));
        let mut gamuts = all(&self.gamut, DisplayGamut::named)?;
        if !primaries.is_empty() {
            let spectra: Vec<_> = primaries.into_iter().map(|one| one.density).collect();
            gamuts.push(DisplayGamut::of_primaries("primaries", &spectra, observer).map_err(bad)?);
        }
        for sensor in all(&self.sensor, |path| sensor_from_file(path, &disk::Anywhere, None))? {
            gamuts.push(DisplayGamut::of_sensor(&sensor, observer).map_err(bad)?);
        }
        let white_points = self.white.iter().map(|name| name.trim().to_owned()).filter(|name| !name.is_empty()).collect();
        let spectra = given.into_iter().map(|one| (official(&one.name), one.density)).collect();
        chart(&Contents { diagram, observer, white_points, spectra, gamuts, size: self.output.size() }).map_err(bad)
    }
}
