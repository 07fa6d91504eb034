//! Units of a curve file: of its wavelengths, and of the interval that its values are per.
//!
//! | statement | where | examples |
//! |---|---|---|
//! | unit of the wavelengths | option, `# wavelength_unit:`, name of the first column | `nm`, `um`, `µm`, `m`, `angstrom`; `wavelength (µm)` |
//! | interval of a density | option, `# per:`, `# unit:`, name of the value's column | `nm`, `um`, `m`, `band 5 nm`; `W/(m2 nm)`, `W m-2 µm-1` |

/// Unit of the wavelengths of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WavelengthUnit {
    /// 1 nm.
    Nanometre,
    /// 1000 nm.
    Micrometre,
    /// 10⁹ nm.
    Metre,
    /// 0.1 nm.
    Angstrom,
}

impl WavelengthUnit {
    /// What may be written for a unit, for messages.
    pub const ALLOWED: &str = "nm, um (or µm), m, angstrom";

    /// The unit that a word stands for.
    pub fn parse(word: &str) -> Option<Self> {
        match word.to_lowercase().as_str() {
            "nm" | "nanometre" | "nanometres" | "nanometer" | "nanometers" => Some(Self::Nanometre),
            "um" | "µm" | "μm" | "micron" | "microns" | "micrometre" | "micrometres" | "micrometer" | "micrometers" => {
                Some(Self::Micrometre)
            }
            "m" | "metre" | "metres" | "meter" | "meters" => Some(Self::Metre),
            "å" | "angstrom" | "angstroms" | "ångström" | "ångstrom" => Some(Self::Angstrom),
            _ => None,
        }
    }

    /// The symbol: nm, µm, m, Å.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Nanometre => "nm",
            Self::Micrometre => "µm",
            Self::Metre => "m",
            Self::Angstrom => "Å",
        }
    }

    /// The power of ten that makes nm of it.
    pub fn power_of_ten(self) -> i32 {
        match self {
            Self::Nanometre => 0,
            Self::Micrometre => 3,
            Self::Metre => 9,
            Self::Angstrom => -1,
        }
    }

    /// The unit that the name of a wavelength column ends in or holds: `wavelength_um`, `λ [µm]`, `nm`.
    pub(super) fn of_column(name: &str) -> Option<Self> {
        words(name).into_iter().rev().find_map(|word| Self::parse(&word))
    }
}

/// What the values of a density are per.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Per {
    /// Per nm, per µm and the like.
    Unit(WavelengthUnit),
    /// The power within a band of this width, nm.
    Band {
        /// Width, nm.
        width_nm: f64,
    },
}

impl Per {
    /// What may be written, for messages.
    pub const ALLOWED: &str = "nm, um, m, or a band such as `band 5 nm`";

    /// The interval that a header line or an option states.
    pub fn parse(text: &str) -> Option<Self> {
        if text.trim_start().starts_with('-') {
            return None;
        }
        let parts: Vec<String> = words(text).into_iter().filter(|word| !matches!(word.as_str(), "band" | "bands" | "per" | "of")).collect();
        match parts.as_slice() {
            [unit] if !text.to_lowercase().contains("band") => WavelengthUnit::parse(unit).map(Self::Unit),
            [width, unit] => Self::band(width, unit),
            _ => None,
        }
    }

    fn band(width: &str, unit: &str) -> Option<Self> {
        let width: f64 = width.parse().ok()?;
        let width_nm = width * 10.0_f64.powi(WavelengthUnit::parse(unit)?.power_of_ten());
        (width_nm > 0.0 && width_nm.is_finite()).then_some(Self::Band { width_nm })
    }

    /// The width of the interval, nm: values are divided by it.
    pub fn width_nm(self) -> f64 {
        match self {
            Self::Unit(unit) => 10.0_f64.powi(unit.power_of_ten()),
            Self::Band { width_nm } => width_nm,
        }
    }

    /// In words: `per µm`, `per band of 5 nm`.
    pub fn described(self) -> String {
        match self {
            Self::Unit(unit) => format!("per {}", unit.symbol()),
            Self::Band { width_nm } => format!("per band of {width_nm} nm"),
        }
    }

    /// The interval in the unit of a value: `W/(m2 nm)`, `W m-2 µm-1`, `power per 5 nm`. A metre is an area or a distance there.
    pub(super) fn of_unit(unit: &str) -> Option<Self> {
        let words = words(unit);
        let at = words.iter().rposition(|word| WavelengthUnit::parse(word).is_some_and(|unit| unit != WavelengthUnit::Metre))?;
        if let Some(number) = at.checked_sub(1).map(|before| words[before].as_str()).filter(|word| word.parse::<f64>().is_ok()) {
            let (before, behind) = unit.rfind(number).map_or(("", ""), |at| (&unit[..at], &unit[at + number.len()..]));
            let adjacent = behind.trim_start_matches([' ', '_', '-']).to_lowercase().starts_with(&words[at]);
            // The exponent of another unit, as in `W m-2 nm-1`, says nothing; a width says a band; else it is a wavelength, as in `at 550 nm`.
            if adjacent && !before.ends_with(|c: char| c.is_alphabetic() || "-^".contains(c)) {
                let divided = before.trim_end_matches([' ', '_', '(']).to_lowercase();
                return if divided.ends_with('/') || divided.ends_with("per") { Self::band(number, &words[at]) } else { None };
            }
        }
        WavelengthUnit::parse(&words[at]).map(Self::Unit)
    }
}

/// The unit of values once they are per nm, from the unit that a file states for them: `W/(m2 um)` and `W/5nm` become `W/(m2 nm)` and
/// `W/nm`; a unit without an interval is divided by nm, except a relative one.
pub(super) fn per_nm(unit: &str) -> String {
    let Some(per) = Per::of_unit(unit) else {
        let relative = unit.to_lowercase().contains("relative") || matches!(unit.trim(), "" | "1");
        return if relative { unit.to_owned() } else { format!("{unit}/nm") };
    };
    let mut found = None;
    let mut start = None;
    for (at, character) in unit.char_indices().chain([(unit.len(), ' ')]) {
        match (character.is_alphabetic(), start) {
            (true, None) => start = Some(at),
            (false, Some(from)) => {
                if WavelengthUnit::parse(&unit[from..at]).is_some_and(|unit| unit != WavelengthUnit::Metre) {
                    found = Some((from, at));
                }
                start = None;
            }
            _ => {}
        }
    }
    let Some((from, to)) = found else { return unit.to_owned() };
    let before = match per {
        Per::Unit(_) => &unit[..from],
        Per::Band { .. } => unit[..from].trim_end_matches([' ', '_', '-']).trim_end_matches(|c: char| c.is_ascii_digit() || c == '.'),
    };
    format!("{before}nm{}", &unit[to..])
}

/// The unit of a density that the name of a column ends in: in brackets as in `irradiance (W/(m2 nm))`, as the whole name (`W/m2/nm`), or
/// joined by underscores as in `irradiance_w_m2_nm`. `None` for a name that states no interval.
pub(super) fn unit_of_column(name: &str) -> Option<String> {
    let name = name.trim();
    let unit = if let Some(from) = name.find([' ', '[', '(']).filter(|_| name.ends_with([')', ']']) && !name.starts_with("W/")) {
        name[from..].trim().strip_prefix(['(', '[']).map_or(&name[from..], |inner| &inner[..inner.len() - 1]).trim().to_owned()
    } else if let Some((_, below)) = format!("_{}", name.to_lowercase()).split_once("_w_") {
        format!("W/({})", below.replace('_', " "))
    } else {
        name.to_owned()
    };
    Per::of_unit(&unit).map(|_| unit)
}

/// What the name of a first column says that is not a wavelength in a unit that is known: `frequency_THz`, `wavenumber_cm-1`, `energy (eV)`.
pub(super) fn other_abscissa(name: &str) -> Option<String> {
    const OTHERS: [&str; 15] = [
        "frequency",
        "frequencies",
        "wavenumber",
        "wavenumbers",
        "energy",
        "hz",
        "ghz",
        "thz",
        "phz",
        "ev",
        "mev",
        "kev",
        "cm",
        "mm",
        "pm",
    ];
    words(name).into_iter().find(|word| OTHERS.contains(&word.as_str()))
}

/// Words and numbers of a text, in lower case; a unit that follows a number without a blank is a word of its own.
fn words(text: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    let mut last: Option<bool> = None;
    for character in text.chars() {
        let digit = character.is_ascii_digit() || (character == '.' && last == Some(true));
        if digit || character.is_alphabetic() {
            match (words.last_mut(), last) {
                (Some(word), Some(was_digit)) if was_digit == digit => word.extend(character.to_lowercase()),
                _ => words.push(character.to_lowercase().collect()),
            }
            last = Some(digit);
        } else {
            last = None;
        }
    }
    words
}

/// The number in a text times a power of ten, rounded once: `0.5461` and 3 give exactly 546.1.
pub(super) fn shifted(text: &str, power_of_ten: i32) -> Option<f64> {
    let (mantissa, exponent) = match text.find(['e', 'E']) {
        Some(at) => (&text[..at], text[at + 1..].parse::<i32>().ok()?),
        None => (text, 0),
    };
    format!("{mantissa}e{}", exponent.saturating_add(power_of_ten)).parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_found_in_names_of_columns() {
        use WavelengthUnit::{Angstrom, Metre, Micrometre, Nanometre};
        for (name, unit) in [
            ("wavelength_nm", Some(Nanometre)),
            ("nm", Some(Nanometre)),
            ("Wavelength (µm)", Some(Micrometre)),
            ("λ[μm]", Some(Micrometre)),
            ("lambda/m", Some(Metre)),
            ("Wavelength Å", Some(Angstrom)),
            ("wavelength", None),
            ("number", None),
        ] {
            assert_eq!(WavelengthUnit::of_column(name), unit, "{name}");
        }
    }

    #[test]
    fn intervals_are_found_in_units_and_statements() {
        let (nm, um) = (Some(Per::Unit(WavelengthUnit::Nanometre)), Some(Per::Unit(WavelengthUnit::Micrometre)));
        let band = |width_nm| Some(Per::Band { width_nm });
        for (unit, per) in [
            ("W/(m2 nm)", nm),
            ("W m-2 nm-1", nm),
            ("1/nm (relative)", nm),
            ("power_w_nm", nm),
            ("µW/cm²/µm", um),
            ("W m-2 sr-1 um-1", um),
            ("W per 5 nm", band(5.0)),
            ("W/5nm", band(5.0)),
            ("power_per_2.5_nm", band(2.5)),
            ("A/W", None),
            ("W m-2", None),
            ("reflectance at 550 nm", None),
            ("power_5nm", None),
            ("umol m-2 s-1", None),
        ] {
            assert_eq!(Per::of_unit(unit), per, "{unit}");
        }
        for (text, per) in [
            ("nm", nm),
            ("µm", um),
            ("m", Some(Per::Unit(WavelengthUnit::Metre))),
            ("band 5 nm", band(5.0)),
            ("5 nm band", band(5.0)),
            ("5nm", band(5.0)),
            ("band of 0.01 µm", band(10.0)),
            ("band", None),
            ("band nm", None),
            ("0 nm", None),
            ("furlong", None),
        ] {
            assert_eq!(Per::parse(text), per, "{text}");
        }
    }

    #[test]
    fn units_per_another_interval_become_units_per_nm() {
        for (unit, converted) in [
            ("W/(m2 um)", "W/(m2 nm)"),
            ("W m-2 µm-1", "W m-2 nm-1"),
            ("W/(m² nm)", "W/(m² nm)"),
            ("W/5nm", "W/nm"),
            ("W per 2.5 nm", "W per nm"),
            ("W/m2", "W/m2/nm"),
            ("relative", "relative"),
            ("1", "1"),
        ] {
            assert_eq!(per_nm(unit), converted, "{unit}");
        }
    }

    #[test]
    fn units_of_densities_are_found_in_names_of_columns() {
        for (name, unit) in [
            ("irradiance (W/(m² nm))", Some("W/(m² nm)")),
            ("irradiance [W m-2 um-1]", Some("W m-2 um-1")),
            ("W/m2/nm", Some("W/m2/nm")),
            ("W/(m2 nm)", Some("W/(m2 nm)")),
            ("irradiance_w_m2_nm", Some("W/(m2 nm)")),
            ("w_m2_sr_um", Some("W/(m2 sr um)")),
            ("value", None),
            ("responsivity_a_w", None),
        ] {
            assert_eq!(unit_of_column(name).as_deref(), unit, "{name}");
        }
    }

    #[test]
    fn shifting_the_decimal_point_rounds_once() {
        assert_eq!(shifted("0.5461", 3), Some(546.1));
        assert_eq!(shifted("546.1e-9", 9), Some(546.1));
        assert_eq!(shifted("5461", -1), Some(546.1));
        assert_eq!(shifted("1e999999999999", 3), None);
        assert_eq!(shifted("x", 3), None);
    }
}
