//! Gamuts of displays: all colours between three or more primaries.

use super::super::chart::{Chart, Curve, Dash, Ink};
use super::super::error::PlotError;
use super::Contents;
use crate::observer::Matching;
use crate::observer::colour::{Chromaticity, Tristimulus};
use crate::sensor::Sensor;
use crate::spectrum::{Density, Factor, library};

/// A polygon of primaries.
#[derive(Debug, Clone, PartialEq)]
pub struct DisplayGamut {
    /// Its name.
    pub name: String,
    /// Chromaticities of the primaries, in order around the polygon.
    pub primaries: Vec<Chromaticity>,
    /// The observer they are for.
    pub observer: Matching,
}

impl DisplayGamut {
    /// Names that [`DisplayGamut::named`] knows.
    pub const NAMES: [&'static str; 4] = ["sRGB", "Display P3", "Rec. 2020", "Adobe RGB"];

    /// A standard gamut by name, case and separators aside: sRGB and Rec. 709 (IEC 61966-2-1, ITU-R BT.709), Display P3 (SMPTE EG 432-1),
    /// Rec. 2020 (ITU-R BT.2020), Adobe RGB (1998). Errors with all names if there is none.
    pub fn named(name: &str) -> Result<Self, PlotError> {
        let key: String = name.to_lowercase().chars().filter(|c| c.is_alphanumeric()).collect();
        let (name, primaries) = match key.as_str() {
            "srgb" | "rec709" | "bt709" => (Self::NAMES[0], [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]]),
            "displayp3" | "p3" => (Self::NAMES[1], [[0.680, 0.320], [0.265, 0.690], [0.150, 0.060]]),
            "rec2020" | "bt2020" => (Self::NAMES[2], [[0.708, 0.292], [0.170, 0.797], [0.131, 0.046]]),
            "adobergb" | "adobergb1998" | "adobe" => (Self::NAMES[3], [[0.64, 0.33], [0.21, 0.71], [0.15, 0.06]]),
            _ => {
                let found: String = name.chars().take(80).collect();
                return Err(PlotError::Request { what: format!("no gamut `{found}`; allowed: {}", Self::NAMES.join(", ")) });
            }
        };
        let primaries = primaries.map(|[x, y]| Chromaticity { x, y }).to_vec();
        Ok(Self { name: name.to_owned(), primaries, observer: Matching::Cie1931 })
    }

    /// The chromaticities that the channels of a sensor select out of the equal-energy spectrum, as if their responsivities were filters, in
    /// the order of the channels. Errors as [`Self::of_primaries`].
    pub fn of_sensor(sensor: &Sensor, observer: Matching) -> Result<Self, PlotError> {
        let equal_energy = library::density("E").map_err(|error| PlotError::Request { what: error.to_string() })?;
        let passed: Vec<Density> = sensor.channels.iter().map(|channel| equal_energy.filtered(&channel.responsivity)).collect();
        Self::of_primaries(&sensor.title, &passed, observer)
    }

    /// The gamut of a display whose primaries have these spectra. Errors if there are fewer than three or the observer does not see one.
    pub fn of_primaries(name: &str, spectra: &[Density], observer: Matching) -> Result<Self, PlotError> {
        let functions: [Factor; 3] = observer.functions();
        let seen = spectra.iter().map(|density| Tristimulus::of(density, &functions).chromaticity());
        let primaries: Option<Vec<Chromaticity>> = seen.collect();
        let what = |text: &str| PlotError::Request { what: format!("gamut `{name}`: {text}") };
        let primaries = primaries.ok_or_else(|| what("the observer does not see one of its primaries"))?;
        if primaries.len() < 3 {
            return Err(what(&format!("{} primaries; at least 3 are needed", primaries.len())));
        }
        Ok(Self { name: name.to_owned(), primaries, observer })
    }
}

/// Each gamut as a closed line.
pub(super) fn draw(chart: &mut Chart, contents: &Contents) -> Result<(), PlotError> {
    for (index, gamut) in contents.gamuts.iter().enumerate() {
        if gamut.observer != contents.observer {
            let what = format!("the primaries of {} are known for {} only", gamut.name, gamut.observer.title());
            return Err(PlotError::Request { what });
        }
        let corners = gamut.primaries.iter().chain(gamut.primaries.first());
        let points = corners.map(|corner| contents.diagram.place(corner)).collect();
        let dash = [Dash::Dashed, Dash::Solid, Dash::Dotted][index % 3];
        let mut curve = Curve::new(&gamut.name, points, Ink::OnShade).dashed(dash);
        curve.width = 0.6;
        chart.curves.push(curve);
    }
    Ok(())
}
