//! Names, symbols and units of the totals of a spectral quantity (CIE S 017, ISO 80000-7; photons in mol as in ISO 80000-7, item 7-20).

/// Which quantity a density is the spectral density of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpectralQuantity {
    /// Spectral radiant flux, W nm⁻¹.
    Flux,
    /// Spectral irradiance, W m⁻² nm⁻¹.
    Irradiance,
    /// Spectral radiant exitance, W m⁻² nm⁻¹.
    Exitance,
    /// Spectral radiance, W m⁻² sr⁻¹ nm⁻¹.
    Radiance,
    /// Spectral radiant intensity, W sr⁻¹ nm⁻¹.
    Intensity,
}

impl SpectralQuantity {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Flux, Self::Irradiance, Self::Exitance, Self::Radiance, Self::Intensity];

    /// One word, as on a command line.
    pub fn word(self) -> &'static str {
        match self {
            Self::Flux => "flux",
            Self::Irradiance => "irradiance",
            Self::Exitance => "exitance",
            Self::Radiance => "radiance",
            Self::Intensity => "intensity",
        }
    }

    /// The quantity whose spectral density has this unit, written in any of the usual ways (`W/(m² nm)`, `W m^-2 nm^-1`, `W·m⁻²·nm⁻¹`,
    /// `W/nm`). Per µm counts as per nm, because tables are per nm once they are read. An irradiance is taken for a unit that it shares
    /// with an exitance. `None` for another unit, also for a multiple such as mW.
    pub fn of_unit(unit: &str) -> Option<Self> {
        let (numerator, denominator) = unit.split_once('/').map_or((unit, ""), |(over, under)| (over, under));
        let mut factors = Vec::new();
        factors.extend(powers(numerator, 1)?);
        // `W/m²/nm` has a second stroke; what follows it is below the line as well.
        factors.extend(powers(&denominator.replace('/', " "), -1)?);
        factors.sort();
        let known = |list: &[(&str, i32)]| factors.iter().map(|(name, power)| (name.as_str(), *power)).eq(list.iter().copied());
        Self::ALL.into_iter().find(|quantity| known(quantity.unit_powers()))
    }

    /// The unit as powers of units, in alphabetical order.
    fn unit_powers(self) -> &'static [(&'static str, i32)] {
        match self {
            Self::Flux => &[("nm", -1), ("w", 1)],
            Self::Irradiance | Self::Exitance => &[("m", -2), ("nm", -1), ("w", 1)],
            Self::Radiance => &[("m", -2), ("nm", -1), ("sr", -1), ("w", 1)],
            Self::Intensity => &[("nm", -1), ("sr", -1), ("w", 1)],
        }
    }

    /// Name and unit of the spectral density.
    pub fn spectral_words(self) -> &'static str {
        match self {
            Self::Flux => "spectral radiant flux in W/nm",
            Self::Irradiance => "spectral irradiance in W/(m² nm)",
            Self::Exitance => "spectral radiant exitance in W/(m² nm)",
            Self::Radiance => "spectral radiance in W/(m² sr nm)",
            Self::Intensity => "spectral radiant intensity in W/(sr nm)",
        }
    }

    /// Letter of the quantity.
    pub(super) fn letter(self) -> &'static str {
        match self {
            Self::Flux => "Φ",
            Self::Irradiance => "E",
            Self::Exitance => "M",
            Self::Radiance => "L",
            Self::Intensity => "I",
        }
    }

    /// Name and unit of the radiant total.
    pub(super) fn radiant(self) -> (&'static str, &'static str) {
        match self {
            Self::Flux => ("radiant flux", "W"),
            Self::Irradiance => ("irradiance", "W/m²"),
            Self::Exitance => ("radiant exitance", "W/m²"),
            Self::Radiance => ("radiance", "W/(m² sr)"),
            Self::Intensity => ("radiant intensity", "W/sr"),
        }
    }

    /// Name and unit of the photon total.
    pub(super) fn photon(self) -> (&'static str, &'static str) {
        match self {
            Self::Flux => ("photon flux", "µmol/s"),
            Self::Irradiance => ("photon irradiance", "µmol/(m² s)"),
            Self::Exitance => ("photon exitance", "µmol/(m² s)"),
            Self::Radiance => ("photon radiance", "µmol/(m² s sr)"),
            Self::Intensity => ("photon intensity", "µmol/(s sr)"),
        }
    }

    /// Name of the photon total from 400 nm to 700 nm.
    pub(super) fn photosynthetic(self) -> &'static str {
        match self {
            Self::Flux => "photosynthetic photon flux, PPF",
            Self::Irradiance => "photosynthetic photon flux density, PPFD",
            Self::Exitance => "photosynthetic photon exitance",
            Self::Radiance => "photosynthetic photon radiance",
            Self::Intensity => "photosynthetic photon intensity",
        }
    }

    /// Name and unit of the luminous total.
    pub(super) fn luminous(self) -> (&'static str, &'static str) {
        match self {
            Self::Flux => ("luminous flux", "lm"),
            Self::Irradiance => ("illuminance", "lx"),
            Self::Exitance => ("luminous exitance", "lm/m²"),
            Self::Radiance => ("luminance", "cd/m²"),
            Self::Intensity => ("luminous intensity", "cd"),
        }
    }

    /// Name, symbol and unit of the equivalent daylight quantity, where CIE S 026 defines one.
    pub(super) fn equivalent_daylight(self) -> Option<(&'static str, &'static str, &'static str)> {
        match self {
            Self::Irradiance => Some(("EDI", "E_v,α^D65", "lx")),
            Self::Radiance => Some(("EDL", "L_v,α^D65", "cd/m²")),
            Self::Flux | Self::Exitance | Self::Intensity => None,
        }
    }
}

/// `W·m⁻²` → w¹ m⁻², each power times `sign`.
fn powers(text: &str, sign: i32) -> Option<Vec<(String, i32)>> {
    let text: String = text.chars().filter_map(plain).collect();
    text.split_whitespace()
        .map(|word| {
            let start = word.find(|c: char| c == '-' || c.is_ascii_digit()).unwrap_or(word.len());
            let (name, power) = word.split_at(start);
            let power: i32 = if power.is_empty() { 1 } else { power.parse().ok()? };
            let name = if matches!(name, "um" | "µm" | "μm") { "nm".to_owned() } else { name.to_lowercase() };
            (!name.is_empty()).then(|| (name, sign.saturating_mul(power)))
        })
        .collect()
}

/// Superscripts as digits; signs of multiplication and brackets as blanks; `^` left out. M for mega stays apart from m.
fn plain(c: char) -> Option<char> {
    const SUPERSCRIPTS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    match c {
        '⁻' | '−' => Some('-'),
        '^' => None,
        '·' | '*' | '(' | ')' | '.' | '⋅' => Some(' '),
        c => Some(SUPERSCRIPTS.iter().position(|&s| s == c).and_then(|i| char::from_digit(i as u32, 10)).unwrap_or(c)),
    }
}

#[cfg(test)]
mod tests {
    use super::SpectralQuantity as Q;

    #[test]
    fn units_are_read_in_every_usual_form() {
        for (unit, quantity) in [
            ("W/nm", Some(Q::Flux)),
            ("W nm^-1", Some(Q::Flux)),
            ("W/(m² nm)", Some(Q::Irradiance)),
            ("W m^-2 nm^-1", Some(Q::Irradiance)),
            ("W·m⁻²·nm⁻¹", Some(Q::Irradiance)),
            ("W/m2/nm", Some(Q::Irradiance)),
            ("W/(m^2 sr nm)", Some(Q::Radiance)),
            ("W/(sr nm)", Some(Q::Intensity)),
            ("W/(m² µm)", Some(Q::Irradiance)),
            ("mW/(m² nm)", None),
            ("W/m²", None),
            ("1/nm (relative)", None),
            ("", None),
        ] {
            assert_eq!(Q::of_unit(unit), quantity, "{unit}");
        }
    }
}
