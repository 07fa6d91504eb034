//! What a reading is a reading of, as run-time data: name, symbol and unit.
//!
//! Variants that are cells of the [`table`] take their words from it.
//! Source of the terms: CIE S 017 (ILV); EMVA 1288 for the signals of a camera.

use super::table::{self, Cell};
use std::borrow::Cow;
use std::fmt;

/// The quantity intended to be measured.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Measurand {
    /// Radiant energy, J.
    RadiantEnergy,
    /// Luminous energy, lm s.
    LuminousEnergy,
    /// Photon number, 1.
    PhotonNumber,
    /// Radiant flux, W.
    RadiantFlux,
    /// Luminous flux, lm.
    LuminousFlux,
    /// Photon flux, 1/s.
    PhotonFlux,
    /// Irradiance, W/m².
    Irradiance,
    /// Illuminance, lx.
    Illuminance,
    /// Photon irradiance, 1/(m² s).
    PhotonIrradiance,
    /// Radiant exitance, W/m².
    RadiantExitance,
    /// Luminous exitance, lm/m².
    LuminousExitance,
    /// Photon exitance, 1/(m² s).
    PhotonExitance,
    /// Radiance, W/(m² sr).
    Radiance,
    /// Luminance, cd/m².
    Luminance,
    /// Photon radiance, 1/(m² s sr).
    PhotonRadiance,
    /// Radiant intensity, W/sr.
    RadiantIntensity,
    /// Luminous intensity, cd.
    LuminousIntensity,
    /// Photon intensity, 1/(s sr).
    PhotonIntensity,
    /// Photocurrent of a detector, A.
    Photocurrent,
    /// Electrons collected by a pixel in one exposure, e⁻.
    Electrons,
    /// Digital number of a pixel, DN.
    DigitalNumber,
    /// A quantity of another weighted system (α-opic, scotopic, erythemal), with its own words.
    Weighted {
        /// Standard term, e.g. "melanopic equivalent daylight illuminance".
        name: String,
        /// Symbol, e.g. "E_v,mel".
        symbol: String,
        /// Unit symbol, e.g. "lx".
        unit: String,
    },
    /// An uncalibrated output of a channel.
    Signal {
        /// Unit symbol, e.g. "V".
        unit: String,
    },
}

/// Name, symbol and unit symbol of one measurand.
type Words<'a> = [&'a str; 3];

fn of_cell<C: Cell>() -> Words<'static> {
    [C::NAME, C::SYMBOL, C::UNIT]
}

impl Measurand {
    /// Every variant whose words are fixed.
    pub const FIXED: [Self; 21] = [
        Self::RadiantEnergy,
        Self::LuminousEnergy,
        Self::PhotonNumber,
        Self::RadiantFlux,
        Self::LuminousFlux,
        Self::PhotonFlux,
        Self::Irradiance,
        Self::Illuminance,
        Self::PhotonIrradiance,
        Self::RadiantExitance,
        Self::LuminousExitance,
        Self::PhotonExitance,
        Self::Radiance,
        Self::Luminance,
        Self::PhotonRadiance,
        Self::RadiantIntensity,
        Self::LuminousIntensity,
        Self::PhotonIntensity,
        Self::Photocurrent,
        Self::Electrons,
        Self::DigitalNumber,
    ];

    fn words(&self) -> Words<'_> {
        match self {
            Self::RadiantEnergy => of_cell::<table::RadiantEnergy>(),
            Self::LuminousEnergy => of_cell::<table::LuminousEnergy>(),
            Self::PhotonNumber => of_cell::<table::PhotonNumber>(),
            Self::RadiantFlux => of_cell::<table::RadiantFlux>(),
            Self::LuminousFlux => of_cell::<table::LuminousFlux>(),
            Self::PhotonFlux => of_cell::<table::PhotonFlux>(),
            Self::Irradiance => of_cell::<table::Irradiance>(),
            Self::Illuminance => of_cell::<table::Illuminance>(),
            Self::PhotonIrradiance => of_cell::<table::PhotonIrradiance>(),
            Self::RadiantExitance => of_cell::<table::RadiantExitance>(),
            Self::LuminousExitance => of_cell::<table::LuminousExitance>(),
            Self::PhotonExitance => of_cell::<table::PhotonExitance>(),
            Self::Radiance => of_cell::<table::Radiance>(),
            Self::Luminance => of_cell::<table::Luminance>(),
            Self::PhotonRadiance => of_cell::<table::PhotonRadiance>(),
            Self::RadiantIntensity => of_cell::<table::RadiantIntensity>(),
            Self::LuminousIntensity => of_cell::<table::LuminousIntensity>(),
            Self::PhotonIntensity => of_cell::<table::PhotonIntensity>(),
            Self::Photocurrent => ["photocurrent", "I_ph", "A"],
            Self::Electrons => ["collected electrons", "µ_e", "e⁻"],
            Self::DigitalNumber => ["digital number", "µ_y", "DN"],
            Self::Weighted { name, symbol, unit } => [name, symbol, unit],
            Self::Signal { unit } => ["signal", "S", unit],
        }
    }

    /// Standard term, e.g. "illuminance".
    pub fn name(&self) -> &str {
        self.words()[0]
    }

    /// Symbol of the quantity, e.g. "E_v".
    pub fn symbol(&self) -> &str {
        self.words()[1]
    }

    /// Symbol of the unit, e.g. "lx"; "1" for a number.
    pub fn unit(&self) -> &str {
        self.words()[2]
    }

    /// `number` followed by the unit, the unit one being left out: "25 lx".
    pub fn with_unit<'a>(&self, number: &'a str) -> Cow<'a, str> {
        match self.unit() {
            "" | "1" => Cow::Borrowed(number),
            unit => Cow::Owned(format!("{number} {unit}")),
        }
    }
}

/// The name.
impl fmt::Display for Measurand {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn illuminance_is_in_lux() {
        let words = Measurand::Illuminance;
        assert_eq!([words.name(), words.symbol(), words.unit()], ["illuminance", "E_v", "lx"]);
        assert_eq!(words.with_unit("25"), "25 lx");
        assert_eq!(Measurand::PhotonNumber.with_unit("25"), "25");
    }

    #[test]
    fn names_and_symbols_are_distinct() {
        let names: BTreeSet<_> = Measurand::FIXED.iter().map(Measurand::name).collect();
        let symbols: BTreeSet<_> = Measurand::FIXED.iter().map(Measurand::symbol).collect();
        assert_eq!(names.len(), Measurand::FIXED.len());
        assert_eq!(symbols.len(), Measurand::FIXED.len());
    }

    #[test]
    fn other_systems_bring_their_own_words() {
        let melanopic =
            Measurand::Weighted { name: "melanopic equivalent daylight illuminance".into(), symbol: "E_v,mel".into(), unit: "lx".into() };
        assert_eq!(melanopic.unit(), "lx");
        assert_eq!(melanopic.to_string(), "melanopic equivalent daylight illuminance");
        assert_eq!(Measurand::Signal { unit: "V".into() }.unit(), "V");
    }
}
