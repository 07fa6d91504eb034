//! The words of the table: name, symbol and unit of every cell, as types and as a list.
//!
//! | system | weighted with | unit of a flux |
//! |---|---|---|
//! | radiant (e) | 1 | W |
//! | luminous (v) | K_m V(λ) | lm |
//! | photon (p) | λ/(hc) | 1/s |
//! | scotopic (v') | K'_m V'(λ) | lm |
//! | mesopic (mes) | K_m,mes V_mes(λ) for one state of adaptation | lm |
//! | α-opic (sc, mc, lc, rh, mel) | the action spectrum s_α(λ), peak one | W |
//!
//! Every system has the same six rows. The unit of a scotopic or a mesopic quantity is that of the luminous one: the lumen is defined for all
//! three, and the name says which is meant. A mesopic quantity belongs to one state of adaptation; the type does not hold it.
//!
//! ```
//! use etendue::quantity::cell::{CELLS, Row};
//! let words = CELLS.iter().find(|words| words.row == Row::Energy && words.system == "luminous").unwrap();
//! assert_eq!((words.unit, words.unit_name), ("lm s", "lumen second"));
//! assert_eq!(words.row.other_units(words.system)[0].name, "talbot");
//! ```
//!
//! Sources: CIE S 017 (ILV) and ISO 80000-7 for the radiant, luminous, photon and scotopic terms; CIE 191 for the mesopic ones;
//! CIE S 026 for the α-opic ones.

use super::constants::AVOGADRO_PER_MOL;
use super::table::{Quantity, kind, system};

/// The rows of the table at run time, in the order of the lecture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Row {
    /// Energy `Q`.
    Energy,
    /// Flux `Φ = dQ/dt`.
    Flux,
    /// Flux density that arrives, `E = dΦ/dA`.
    FluxDensityIn,
    /// Flux density that leaves, `M = dΦ/dA`; the lecture's `B`.
    FluxDensityOut,
    /// Radiance `L = d²Φ/(dA cos θ dω)`.
    Radiance,
    /// Intensity `I = dΦ/dω`.
    Intensity,
}

/// Another unit in which a cell is written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OtherUnit {
    /// Symbol, e.g. "mol/s".
    pub unit: &'static str,
    /// Name, e.g. "mole per second".
    pub name: &'static str,
    /// How many of the cell's own unit it is, e.g. 6.02214076e23.
    pub size: f64,
}

const fn other(unit: &'static str, name: &'static str, size: f64) -> OtherUnit {
    OtherUnit { unit, name, size }
}

const MICROMOLE: f64 = AVOGADRO_PER_MOL * 1e-6;
const TALBOT: [OtherUnit; 1] = [other("T", "talbot", 1.0)];
const PHOTON_NUMBER: [OtherUnit; 2] = [other("mol", "mole", AVOGADRO_PER_MOL), other("µmol", "micromole", MICROMOLE)];
const PHOTON_FLUX: [OtherUnit; 2] =
    [other("mol/s", "mole per second", AVOGADRO_PER_MOL), other("µmol/s", "micromole per second", MICROMOLE)];
const PHOTON_FLUX_DENSITY: [OtherUnit; 2] = [
    other("mol/(m² s)", "mole per square metre second", AVOGADRO_PER_MOL),
    other("µmol/(m² s)", "micromole per square metre second", MICROMOLE),
];
const PHOTON_RADIANCE: [OtherUnit; 2] = [
    other("mol/(m² s sr)", "mole per square metre second steradian", AVOGADRO_PER_MOL),
    other("µmol/(m² s sr)", "micromole per square metre second steradian", MICROMOLE),
];
const PHOTON_INTENSITY: [OtherUnit; 2] =
    [other("mol/(s sr)", "mole per second steradian", AVOGADRO_PER_MOL), other("µmol/(s sr)", "micromole per second steradian", MICROMOLE)];
const NIT: [OtherUnit; 1] = [other("nt", "nit", 1.0)];

impl Row {
    /// All rows.
    pub const ALL: [Self; 6] = [Self::Energy, Self::Flux, Self::FluxDensityIn, Self::FluxDensityOut, Self::Radiance, Self::Intensity];

    /// What the row is called where no system is named.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Energy => "energy",
            Self::Flux => "flux",
            Self::FluxDensityIn => "flux density in",
            Self::FluxDensityOut => "flux density out",
            Self::Radiance => "radiance",
            Self::Intensity => "intensity",
        }
    }

    /// What the row is, as an equation.
    pub const fn definition(self) -> &'static str {
        match self {
            Self::Energy => "Q",
            Self::Flux => "Φ = dQ/dt",
            Self::FluxDensityIn => "E = dΦ/dA",
            Self::FluxDensityOut => "M = dΦ/dA",
            Self::Radiance => "L = d²Φ/(dA cos θ dω)",
            Self::Intensity => "I = dΦ/dω",
        }
    }

    /// Other units in which this row is written in a system (a name of [`CELLS`]): moles of photons, the talbot, the nit.
    pub fn other_units(self, system: &str) -> &'static [OtherUnit] {
        match (self, system) {
            (Self::Energy, "luminous" | "scotopic" | "mesopic") => &TALBOT,
            (Self::Radiance, "luminous" | "scotopic" | "mesopic") => &NIT,
            (Self::Energy, "photon") => &PHOTON_NUMBER,
            (Self::Flux, "photon") => &PHOTON_FLUX,
            (Self::FluxDensityIn | Self::FluxDensityOut, "photon") => &PHOTON_FLUX_DENSITY,
            (Self::Radiance, "photon") => &PHOTON_RADIANCE,
            (Self::Intensity, "photon") => &PHOTON_INTENSITY,
            _ => &[],
        }
    }
}

/// The words of one cell at run time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Words {
    /// The row.
    pub row: Row,
    /// The system, e.g. "luminous", "melanopic".
    pub system: &'static str,
    /// Standard term, e.g. "illuminance".
    pub name: &'static str,
    /// Symbol, e.g. "E_v".
    pub symbol: &'static str,
    /// Symbol of the unit, e.g. "lx"; "1" for a number.
    pub unit: &'static str,
    /// Name of the unit, e.g. "lux".
    pub unit_name: &'static str,
}

/// A system of the table: a column.
pub trait Column {
    /// What it is called, e.g. "luminous".
    const NAME: &'static str;
}

macro_rules! columns {
    ($($system:ident: $name:literal;)*) => {
        $(
            impl Column for system::$system {
                const NAME: &'static str = $name;
            }
        )*

        /// The names of the systems, in the order of the columns.
        pub const SYSTEMS: &[&str] = &[$($name),*];
    };
}

columns! {
    Radiant: "radiant";
    Luminous: "luminous";
    Photon: "photon";
    Scotopic: "scotopic";
    Mesopic: "mesopic";
    SConeOpic: "S-cone-opic";
    MConeOpic: "M-cone-opic";
    LConeOpic: "L-cone-opic";
    Rhodopic: "rhodopic";
    Melanopic: "melanopic";
}

/// Name, symbol and unit of a cell.
pub trait Cell {
    /// Standard term, e.g. "illuminance".
    const NAME: &'static str;
    /// Symbol of the quantity, e.g. "E_v".
    const SYMBOL: &'static str;
    /// Symbol of the unit, e.g. "lx"; "1" for a number.
    const UNIT: &'static str;
    /// Name of the unit, e.g. "lux".
    const UNIT_NAME: &'static str;
}

macro_rules! cells {
    ($($alias:ident = $kind:ident, $system:ident: $name:literal, $symbol:literal, $unit:literal, $unit_name:literal;)*) => {
        $(
            #[doc = concat!("The ", $name, " `", $symbol, "`, in ", $unit_name, " (", $unit, ").")]
            pub type $alias = Quantity<kind::$kind, system::$system>;

            impl Cell for $alias {
                const NAME: &'static str = $name;
                const SYMBOL: &'static str = $symbol;
                const UNIT: &'static str = $unit;
                const UNIT_NAME: &'static str = $unit_name;
            }
        )*

        /// The words of every cell, system by system.
        pub const CELLS: &[Words] = &[$(Words {
            row: Row::$kind,
            system: <system::$system as Column>::NAME,
            name: $name,
            symbol: $symbol,
            unit: $unit,
            unit_name: $unit_name,
        }),*];
    };
}

cells! {
    RadiantEnergy = Energy, Radiant: "radiant energy", "Q_e", "J", "joule";
    RadiantFlux = Flux, Radiant: "radiant flux", "Φ_e", "W", "watt";
    Irradiance = FluxDensityIn, Radiant: "irradiance", "E_e", "W/m²", "watt per square metre";
    RadiantExitance = FluxDensityOut, Radiant: "radiant exitance", "M_e", "W/m²", "watt per square metre";
    Radiance = Radiance, Radiant: "radiance", "L_e", "W/(m² sr)", "watt per square metre steradian";
    RadiantIntensity = Intensity, Radiant: "radiant intensity", "I_e", "W/sr", "watt per steradian";
    LuminousEnergy = Energy, Luminous: "luminous energy", "Q_v", "lm s", "lumen second";
    LuminousFlux = Flux, Luminous: "luminous flux", "Φ_v", "lm", "lumen";
    Illuminance = FluxDensityIn, Luminous: "illuminance", "E_v", "lx", "lux";
    LuminousExitance = FluxDensityOut, Luminous: "luminous exitance", "M_v", "lm/m²", "lumen per square metre";
    Luminance = Radiance, Luminous: "luminance", "L_v", "cd/m²", "candela per square metre";
    LuminousIntensity = Intensity, Luminous: "luminous intensity", "I_v", "cd", "candela";
    PhotonNumber = Energy, Photon: "photon number", "N_p", "1", "one";
    PhotonFlux = Flux, Photon: "photon flux", "Φ_p", "1/s", "one per second";
    PhotonIrradiance = FluxDensityIn, Photon: "photon irradiance", "E_p", "1/(m² s)", "one per square metre second";
    PhotonExitance = FluxDensityOut, Photon: "photon exitance", "M_p", "1/(m² s)", "one per square metre second";
    PhotonRadiance = Radiance, Photon: "photon radiance", "L_p", "1/(m² s sr)", "one per square metre second steradian";
    PhotonIntensity = Intensity, Photon: "photon intensity", "I_p", "1/(s sr)", "one per second steradian";
    ScotopicLuminousEnergy = Energy, Scotopic: "scotopic luminous energy", "Q_v'", "lm s", "lumen second";
    ScotopicLuminousFlux = Flux, Scotopic: "scotopic luminous flux", "Φ_v'", "lm", "lumen";
    ScotopicIlluminance = FluxDensityIn, Scotopic: "scotopic illuminance", "E_v'", "lx", "lux";
    ScotopicLuminousExitance = FluxDensityOut, Scotopic: "scotopic luminous exitance", "M_v'", "lm/m²", "lumen per square metre";
    ScotopicLuminance = Radiance, Scotopic: "scotopic luminance", "L_v'", "cd/m²", "candela per square metre";
    ScotopicLuminousIntensity = Intensity, Scotopic: "scotopic luminous intensity", "I_v'", "cd", "candela";
    MesopicLuminousEnergy = Energy, Mesopic: "mesopic luminous energy", "Q_mes", "lm s", "lumen second";
    MesopicLuminousFlux = Flux, Mesopic: "mesopic luminous flux", "Φ_mes", "lm", "lumen";
    MesopicIlluminance = FluxDensityIn, Mesopic: "mesopic illuminance", "E_mes", "lx", "lux";
    MesopicLuminousExitance = FluxDensityOut, Mesopic: "mesopic luminous exitance", "M_mes", "lm/m²", "lumen per square metre";
    MesopicLuminance = Radiance, Mesopic: "mesopic luminance", "L_mes", "cd/m²", "candela per square metre";
    MesopicLuminousIntensity = Intensity, Mesopic: "mesopic luminous intensity", "I_mes", "cd", "candela";
    SConeOpicRadiantEnergy = Energy, SConeOpic: "S-cone-opic radiant energy", "Q_sc", "J", "joule";
    SConeOpicRadiantFlux = Flux, SConeOpic: "S-cone-opic radiant flux", "Φ_sc", "W", "watt";
    SConeOpicIrradiance = FluxDensityIn, SConeOpic: "S-cone-opic irradiance", "E_sc", "W/m²", "watt per square metre";
    SConeOpicRadiantExitance = FluxDensityOut, SConeOpic: "S-cone-opic radiant exitance", "M_sc", "W/m²", "watt per square metre";
    SConeOpicRadiance = Radiance, SConeOpic: "S-cone-opic radiance", "L_sc", "W/(m² sr)", "watt per square metre steradian";
    SConeOpicRadiantIntensity = Intensity, SConeOpic: "S-cone-opic radiant intensity", "I_sc", "W/sr", "watt per steradian";
    MConeOpicRadiantEnergy = Energy, MConeOpic: "M-cone-opic radiant energy", "Q_mc", "J", "joule";
    MConeOpicRadiantFlux = Flux, MConeOpic: "M-cone-opic radiant flux", "Φ_mc", "W", "watt";
    MConeOpicIrradiance = FluxDensityIn, MConeOpic: "M-cone-opic irradiance", "E_mc", "W/m²", "watt per square metre";
    MConeOpicRadiantExitance = FluxDensityOut, MConeOpic: "M-cone-opic radiant exitance", "M_mc", "W/m²", "watt per square metre";
    MConeOpicRadiance = Radiance, MConeOpic: "M-cone-opic radiance", "L_mc", "W/(m² sr)", "watt per square metre steradian";
    MConeOpicRadiantIntensity = Intensity, MConeOpic: "M-cone-opic radiant intensity", "I_mc", "W/sr", "watt per steradian";
    LConeOpicRadiantEnergy = Energy, LConeOpic: "L-cone-opic radiant energy", "Q_lc", "J", "joule";
    LConeOpicRadiantFlux = Flux, LConeOpic: "L-cone-opic radiant flux", "Φ_lc", "W", "watt";
    LConeOpicIrradiance = FluxDensityIn, LConeOpic: "L-cone-opic irradiance", "E_lc", "W/m²", "watt per square metre";
    LConeOpicRadiantExitance = FluxDensityOut, LConeOpic: "L-cone-opic radiant exitance", "M_lc", "W/m²", "watt per square metre";
    LConeOpicRadiance = Radiance, LConeOpic: "L-cone-opic radiance", "L_lc", "W/(m² sr)", "watt per square metre steradian";
    LConeOpicRadiantIntensity = Intensity, LConeOpic: "L-cone-opic radiant intensity", "I_lc", "W/sr", "watt per steradian";
    RhodopicRadiantEnergy = Energy, Rhodopic: "rhodopic radiant energy", "Q_rh", "J", "joule";
    RhodopicRadiantFlux = Flux, Rhodopic: "rhodopic radiant flux", "Φ_rh", "W", "watt";
    RhodopicIrradiance = FluxDensityIn, Rhodopic: "rhodopic irradiance", "E_rh", "W/m²", "watt per square metre";
    RhodopicRadiantExitance = FluxDensityOut, Rhodopic: "rhodopic radiant exitance", "M_rh", "W/m²", "watt per square metre";
    RhodopicRadiance = Radiance, Rhodopic: "rhodopic radiance", "L_rh", "W/(m² sr)", "watt per square metre steradian";
    RhodopicRadiantIntensity = Intensity, Rhodopic: "rhodopic radiant intensity", "I_rh", "W/sr", "watt per steradian";
    MelanopicRadiantEnergy = Energy, Melanopic: "melanopic radiant energy", "Q_mel", "J", "joule";
    MelanopicRadiantFlux = Flux, Melanopic: "melanopic radiant flux", "Φ_mel", "W", "watt";
    MelanopicIrradiance = FluxDensityIn, Melanopic: "melanopic irradiance", "E_mel", "W/m²", "watt per square metre";
    MelanopicRadiantExitance = FluxDensityOut, Melanopic: "melanopic radiant exitance", "M_mel", "W/m²", "watt per square metre";
    MelanopicRadiance = Radiance, Melanopic: "melanopic radiance", "L_mel", "W/(m² sr)", "watt per square metre steradian";
    MelanopicRadiantIntensity = Intensity, Melanopic: "melanopic radiant intensity", "I_mel", "W/sr", "watt per steradian";
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_system_has_every_row_once() {
        assert_eq!(CELLS.len(), Row::ALL.len() * SYSTEMS.len());
        for system in SYSTEMS {
            let rows: Vec<Row> = CELLS.iter().filter(|words| words.system == *system).map(|words| words.row).collect();
            assert_eq!(rows, Row::ALL, "{system}");
        }
    }

    #[test]
    fn names_and_symbols_are_distinct_and_nothing_is_empty() {
        let names: BTreeSet<_> = CELLS.iter().map(|words| words.name).collect();
        let symbols: BTreeSet<_> = CELLS.iter().map(|words| words.symbol).collect();
        assert_eq!((names.len(), symbols.len()), (CELLS.len(), CELLS.len()));
        assert!(CELLS.iter().all(|w| [w.name, w.symbol, w.unit, w.unit_name].iter().all(|word| !word.is_empty())));
    }

    #[test]
    fn units_follow_from_the_unit_of_the_flux() {
        // One row is derived from another by seconds, square metres and steradians, so the units of a system hang together.
        for system in SYSTEMS {
            let unit = |row: Row| CELLS.iter().find(|w| w.system == *system && w.row == row).map(|w| w.unit).unwrap();
            let expected: [&str; 6] = match unit(Row::Flux) {
                "W" => ["J", "W", "W/m²", "W/m²", "W/(m² sr)", "W/sr"],
                "lm" => ["lm s", "lm", "lx", "lm/m²", "cd/m²", "cd"],
                "1/s" => ["1", "1/s", "1/(m² s)", "1/(m² s)", "1/(m² s sr)", "1/(s sr)"],
                other => panic!("{system}: a flux in {other}"),
            };
            assert_eq!(Row::ALL.map(unit), expected, "{system}");
        }
    }

    #[test]
    fn a_micromole_is_a_millionth_of_a_mole_in_every_row() {
        for row in Row::ALL {
            let [mole, micromole] = row.other_units("photon") else { panic!("{row:?}") };
            assert_eq!(mole.size, AVOGADRO_PER_MOL);
            assert!((micromole.size / mole.size * 1e6 - 1.0).abs() < 1e-15);
            assert_eq!(micromole.unit, format!("µ{}", mole.unit));
        }
    }
}
