//! What a channel is meant to weigh with, by the name of what it reads.
//!
//! | reads | target | adjusted with |
//! |---|---|---|
//! | illuminance, luminance, luminous flux | V(λ) | A |
//! | scotopic illuminance | V′(λ) | A |
//! | α-opic equivalent daylight (D65) illuminance | the α-opic action spectrum | D65 |
//! | photosynthetic photon flux density | photons from 400 nm to 700 nm | A |
//! | erythemal irradiance, UV index | erythema action spectrum of ISO/CIE 17166 | ASTM G173 global tilt |
//!
//! Sources: CIE 018:2019, CIE S 026:2018; ISO/CIE 17166, `1` up to 298 nm, `10^(0.094 (298 − λ))` up to 328 nm, `10^(0.015 (140 − λ))` up to
//! 400 nm (139 in place of 140 in McKinlay and Diffey 1987), here piecewise linear between whole nanometres.

use crate::observer::{AlphaOpic, Efficiency};
use crate::quantity::Measurand;
use crate::sensor::Channel;
use crate::spectrum::photometry::{WavelengthsIn, photons_per_joule};
use crate::spectrum::{Density, Factor, Outside, Table, library};

/// What a channel is meant to weigh with.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// Its name.
    pub name: String,
    /// The curve.
    pub curve: Factor,
    /// Wavelengths over which a mismatch is taken, nm.
    pub range_nm: (f64, f64),
    /// Spectrum with which such meters are adjusted.
    pub calibration: Density,
    /// Its name.
    pub calibration_name: &'static str,
    /// Whether the limits of photometers apply.
    pub photopic: bool,
}

impl Target {
    /// The target of a channel: that of its measurand, or else the ideal weighting that its file gives; `None` without either.
    #[must_use]
    pub fn of(channel: &Channel) -> Option<Self> {
        Self::of_measurand(&channel.reads).or_else(|| {
            let curve = channel.ideal.as_ref()?.curve.clone();
            let (from, to) = curve.support().hull()?;
            let range_nm = (from.clamp(200.0, 2500.0), to.clamp(200.0, 2500.0));
            let a = Self::adjusted_with_a("the ideal weighting of the sensor file", curve, range_nm);
            if a.calibration.integral(&[&a.curve]) > 0.0 && range_nm.0 < range_nm.1 { Some(a) } else { None }
        })
    }

    /// The target of a measurand; `None` where its name does not say.
    fn of_measurand(reads: &Measurand) -> Option<Self> {
        match reads {
            Measurand::Illuminance | Measurand::Luminance | Measurand::LuminousFlux => {
                Some(Self { photopic: true, ..Self::adjusted_with_a("V(λ)", library::v_lambda(), (360.0, 830.0)) })
            }
            Measurand::Weighted { name, .. } => Self::named(name),
            _ => None,
        }
    }

    fn named(name: &str) -> Option<Self> {
        // Heads put their adjective before the quantity.
        let heads = ["spherical ", "hemispherical ", "cylindrical ", "semicylindrical "];
        let name = heads.iter().find_map(|head| name.strip_prefix(head)).unwrap_or(name);
        if name == "illuminance" {
            return Self::of_measurand(&Measurand::Illuminance);
        }
        if let Some(alpha) = name.strip_suffix(" equivalent daylight (D65) illuminance") {
            let alpha = AlphaOpic::ALL.into_iter().find(|one| one.name() == alpha)?;
            return Some(Self {
                name: format!("{} action spectrum", alpha.name()),
                curve: alpha.curve(),
                range_nm: (380.0, 780.0),
                calibration: library::density("D65").ok()?,
                calibration_name: "D65",
                photopic: false,
            });
        }
        match name {
            "scotopic illuminance" => Some(Self::adjusted_with_a("V′(λ)", Efficiency::Scotopic1951.curve(), (380.0, 780.0))),
            "photosynthetic photon flux density" => {
                let band = Factor::band(400.0, 700.0, 1.0).ok()?;
                let curve = Factor::Product(vec![band, photons_per_joule(WavelengthsIn::StandardAir)]);
                Some(Self::adjusted_with_a("photons, 400 nm to 700 nm", curve, (350.0, 800.0)))
            }
            // The UV index is the same by another unit: 40 m²/W.
            "erythemal irradiance" | "UV index" => Some(Self {
                name: "erythema action spectrum".to_owned(),
                curve: erythema()?,
                range_nm: (280.0, 400.0),
                calibration: library::density("ASTM G173 global tilt").ok()?,
                calibration_name: "ASTM G173 global tilt",
                photopic: false,
            }),
            _ => None,
        }
    }

    fn adjusted_with_a(name: &str, curve: Factor, range_nm: (f64, f64)) -> Self {
        let calibration = Density::illuminant_a();
        Self { name: name.to_owned(), curve, range_nm, calibration, calibration_name: "A", photopic: false }
    }
}

/// Erythema action spectrum, 1 at most, 250 nm to 400 nm; `None` never: its table is valid.
fn erythema() -> Option<Factor> {
    let at = |nm: f64| match nm {
        nm if nm <= 298.0 => 1.0,
        nm if nm <= 328.0 => 10f64.powf(0.094 * (298.0 - nm)),
        nm => 10f64.powf(0.015 * (140.0 - nm)),
    };
    let rows: Vec<(f64, f64)> = (250..=400).map(f64::from).map(|nm| (nm, at(nm))).collect();
    Table::from_rows(&rows, Outside::Zero).ok().map(Factor::Table)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn measurands_lead_to_their_targets() {
        let weighted = |name: &str| Measurand::Weighted { name: name.to_owned(), symbol: String::new(), unit: String::new() };
        assert!(Target::of_measurand(&Measurand::Illuminance).unwrap().photopic);
        for alpha in AlphaOpic::ALL {
            let found = Target::of_measurand(&weighted(&format!("{} equivalent daylight (D65) illuminance", alpha.name()))).unwrap();
            assert_eq!((found.curve, found.calibration_name), (alpha.curve(), "D65"));
        }
        assert!(Target::of_measurand(&weighted("semicylindrical illuminance")).unwrap().photopic);
        let sun = Target::of_measurand(&weighted("erythemal irradiance")).unwrap();
        assert!((sun.curve.at(328.0) / 10f64.powf(-2.82) - 1.0).abs() < 1e-12 && sun.curve.at(298.0) == 1.0);
        assert!(Target::of_measurand(&weighted("photosynthetic photon flux density")).is_some());
        assert_eq!(Target::of_measurand(&Measurand::Irradiance), None);
        assert_eq!(Target::of_measurand(&weighted("something else")), None);
    }
}
