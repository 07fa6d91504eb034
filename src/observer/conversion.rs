//! One quantity in another system, through a spectrum.
//!
//! ```text
//! X_to = X_from · k_to ∫ S(λ) w_to(λ) dλ / (k_from ∫ S(λ) w_from(λ) dλ)
//! ```
//!
//! | system | k | w(λ) |
//! |---|---|---|
//! | radiant | 1 | 1 |
//! | luminous | K_m = 683.002 lm/W | V(λ) |
//! | photon | 1/(hc) | n(λ) λ |
//! | scotopic | K'_m | V'(λ) |
//! | mesopic, adaptation m | K_m,mes(m) | V_mes,m(λ) |
//! | α-opic | 1 | s_α(λ) |
//!
//! S(λ) is the spectrum of the light; its scale cancels. The row of the table stays: irradiance becomes illuminance, radiance luminance.
//! Where 683 and 683.002 come from is written in [`constants`](crate::quantity::constants); the wavelengths of a
//! spectrum are in air, and photons have the energy of those in vacuum ([`photometry`]).
//!
//! ```
//! use etendue::observer::conversion::convert;
//! use etendue::quantity::table::{Illuminance, PhotonIrradiance};
//! use etendue::spectrum::library;
//!
//! let daylight = library::density("D65")?;
//! let photons: PhotonIrradiance = convert(Illuminance::new(1000.0), &daylight)?;
//! // Of all the wavelengths that D65 has, 300 nm to 830 nm.
//! assert_eq!(format!("{:.0} µmol/(m² s)", photons.umol_m2_s()), "27 µmol/(m² s)");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Sources: CIE S 017 (ILV), ISO 23539, CIE 191, CIE S 026.

use std::fmt;

use super::{AlphaOpic, Efficiency, ObserverError, mesopic};
use crate::quantity::table::{Quantity, system};
use crate::spectrum::{Density, Factor, photometry};

/// A system of quantities at run time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum System {
    /// Joules and watts.
    Radiant,
    /// Weighted with V(λ).
    Luminous,
    /// Photons.
    Photon,
    /// Weighted with V'(λ).
    Scotopic,
    /// Weighted with V_mes(λ).
    Mesopic {
        /// Coefficient of adaptation m, 0 (scotopic) to 1 (photopic).
        adaptation: f64,
    },
    /// Weighted with an action spectrum of CIE S 026.
    AlphaOpic(AlphaOpic),
}

/// Why a quantity cannot be converted.
#[derive(Debug, Clone, PartialEq)]
pub enum ConversionError {
    /// The spectrum has no power at all.
    NoLight,
    /// The spectrum has nothing where the system of the given quantity weighs anything, so it says nothing about the others.
    NothingSeen {
        /// The system.
        system: String,
    },
    /// The result cannot be held in a number.
    OutOfRange {
        /// The system asked for.
        system: String,
    },
    /// The observer has no curve for this.
    Observer(ObserverError),
}

impl fmt::Display for ConversionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoLight => f.write_str("the spectrum is zero at every wavelength"),
            Self::NothingSeen { system } => {
                write!(f, "the spectrum has nothing that the {system} system weighs, so a {system} quantity says nothing about it")
            }
            Self::OutOfRange { system } => write!(f, "the {system} quantity leaves the range of numbers (about 1e-308 to 1e308)"),
            Self::Observer(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for ConversionError {}

impl fmt::Display for System {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Radiant => "radiant",
            Self::Luminous => "luminous",
            Self::Photon => "photon",
            Self::Scotopic => "scotopic",
            Self::Mesopic { .. } => "mesopic",
            Self::AlphaOpic(receptor) => receptor.name(),
        })
    }
}

impl System {
    /// k and w(λ).
    fn weight(self) -> Result<(f64, Factor), ConversionError> {
        let efficiency = |efficiency: Efficiency| (efficiency.max_efficacy_lm_w(), efficiency.curve());
        Ok(match self {
            Self::Radiant => (1.0, Factor::ONE),
            Self::Luminous => efficiency(Efficiency::Photopic1924),
            Self::Photon => (1.0, photometry::photons_per_joule(photometry::WavelengthsIn::StandardAir)),
            Self::Scotopic => efficiency(Efficiency::Scotopic1951),
            Self::Mesopic { adaptation } => {
                let of_observer = ConversionError::Observer;
                (mesopic::max_efficacy_lm_w(adaptation).map_err(of_observer)?, mesopic::curve(adaptation).map_err(of_observer)?)
            }
            Self::AlphaOpic(receptor) => (1.0, receptor.curve()),
        })
    }

    /// How much of this system one unit of the radiant system is: lm for a watt, photons for a joule, … Zero if the system sees nothing of
    /// the spectrum.
    ///
    /// # Errors
    /// A spectrum without light; a coefficient of adaptation outside 0 to 1.
    pub fn per_radiant(self, spectrum: &Density) -> Result<f64, ConversionError> {
        let (scale, weight) = self.weight()?;
        Ok(scale * spectrum.mean_of(&weight).ok_or(ConversionError::NoLight)?)
    }
}

/// How much of the system `to` one unit of the system `from` is, for light of this spectrum.
///
/// ```
/// use etendue::observer::conversion::{System, ratio};
/// use etendue::spectrum::Density;
///
/// let green = Density::line(555.0, 1.0)?;
/// assert_eq!(ratio(System::Radiant, System::Luminous, &green)?, 683.002);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// A spectrum without light, or with none that `from` weighs; a ratio that leaves the range of `f64`; a coefficient of adaptation outside
/// 0 to 1.
pub fn ratio(from: System, to: System, spectrum: &Density) -> Result<f64, ConversionError> {
    let (given, wanted) = (from.per_radiant(spectrum)?, to.per_radiant(spectrum)?);
    if given == 0.0 {
        return Err(ConversionError::NothingSeen { system: from.to_string() });
    }
    let ratio = wanted / given;
    if ratio.is_finite() { Ok(ratio) } else { Err(ConversionError::OutOfRange { system: to.to_string() }) }
}

/// A system of the table whose weighting is fixed: all but the mesopic one, which belongs to a state of adaptation.
pub trait FixedSystem {
    /// The system at run time.
    const SYSTEM: System;
}

macro_rules! fixed {
    ($($marker:ident: $system:expr;)*) => {
        $(impl FixedSystem for system::$marker {
            const SYSTEM: System = $system;
        })*
    };
}

fixed! {
    Radiant: System::Radiant;
    Luminous: System::Luminous;
    Photon: System::Photon;
    Scotopic: System::Scotopic;
    SConeOpic: System::AlphaOpic(AlphaOpic::SCone);
    MConeOpic: System::AlphaOpic(AlphaOpic::MCone);
    LConeOpic: System::AlphaOpic(AlphaOpic::LCone);
    Rhodopic: System::AlphaOpic(AlphaOpic::Rhodopic);
    Melanopic: System::AlphaOpic(AlphaOpic::Melanopic);
}

fn times<K, A, B>(quantity: Quantity<K, A>, ratio: f64, to: System) -> Result<Quantity<K, B>, ConversionError> {
    let value = quantity.value() * ratio;
    let lost = value.is_infinite() && quantity.value().is_finite();
    if lost { Err(ConversionError::OutOfRange { system: to.to_string() }) } else { Ok(Quantity::new(value)) }
}

/// The same light in another system; the row of the table stays. Zero if the other system sees nothing of the spectrum.
///
/// # Errors
/// As [`ratio`]; a result that leaves the range of `f64`.
///
/// ```
/// use etendue::observer::conversion::convert;
/// use etendue::quantity::table::{Luminance, Radiance};
/// use etendue::spectrum::Density;
///
/// let furnace = Density::black_body(2042.0)?;
/// let luminance: Luminance = convert(Radiance::new(furnace.total()), &furnace)?;
/// // Freezing platinum, 60 cd/cm², was the definition of the candela.
/// assert!((luminance.value() / 60e4 - 1.0).abs() < 0.02);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn convert<K, From: FixedSystem, To: FixedSystem>(
    quantity: Quantity<K, From>,
    spectrum: &Density,
) -> Result<Quantity<K, To>, ConversionError> {
    times(quantity, ratio(From::SYSTEM, To::SYSTEM, spectrum)?, To::SYSTEM)
}

/// The same light in the mesopic system of an eye with the coefficient of adaptation `adaptation`, 0 to 1
/// ([`mesopic()`](crate::observer::mesopic::mesopic) has it for a scene).
///
/// # Errors
/// As [`convert`]; a coefficient outside 0 to 1.
pub fn to_mesopic<K, From: FixedSystem>(
    quantity: Quantity<K, From>,
    spectrum: &Density,
    adaptation: f64,
) -> Result<Quantity<K, system::Mesopic>, ConversionError> {
    let to = System::Mesopic { adaptation };
    times(quantity, ratio(From::SYSTEM, to, spectrum)?, to)
}

/// A mesopic quantity of an eye with the coefficient of adaptation `adaptation`, 0 to 1, in another system.
///
/// # Errors
/// As [`to_mesopic`].
pub fn from_mesopic<K, To: FixedSystem>(
    quantity: Quantity<K, system::Mesopic>,
    spectrum: &Density,
    adaptation: f64,
) -> Result<Quantity<K, To>, ConversionError> {
    times(quantity, ratio(System::Mesopic { adaptation }, To::SYSTEM, spectrum)?, To::SYSTEM)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantity::table::{
        Illuminance, Irradiance, Luminance, MelanopicIrradiance, PhotonIrradiance, Radiance, RadiantFlux, ScotopicIlluminance,
    };
    use crate::spectrum::library;
    use proptest::prelude::*;

    fn close(a: f64, b: f64, relative: f64) -> bool {
        (a - b).abs() <= relative * b.abs()
    }

    #[test]
    fn a_watt_of_green_in_every_system() {
        let green = Density::line(555.0, 1.0).unwrap();
        let one = Irradiance::new(1.0);
        let lux: Illuminance = convert(one, &green).unwrap();
        assert_eq!(lux.value(), 683.002);
        let photons: PhotonIrradiance = convert(one, &green).unwrap();
        let in_vacuum_nm = crate::quantity::air::wavelength_in_vacuum_nm(555.0);
        assert!(close(photons.value(), crate::quantity::photon::photons_per_joule(in_vacuum_nm), 1e-8));
        // CIE 1951: V'(555 nm) = 0.402.
        let scotopic: ScotopicIlluminance = convert(one, &green).unwrap();
        assert!(close(scotopic.value(), 1700.05 * 0.402, 1e-12), "{scotopic}");
    }

    #[test]
    fn a_thousand_lux_of_daylight_are_as_much_melanopic_as_the_standard_says() {
        // CIE S 026: 1.3262 mW/lm for D65.
        let d65 = library::density("D65").unwrap();
        let melanopic: MelanopicIrradiance = convert(Illuminance::new(1000.0), &d65).unwrap();
        assert!(close(melanopic.value(), 1.3262, 5e-5), "{melanopic}");
    }

    #[test]
    fn radiance_to_luminance_is_the_integral_of_the_lecture() {
        let spectrum = library::density("LED-B3").unwrap();
        let v = library::v_lambda();
        let luminance: Luminance = convert(Radiance::new(2.0), &spectrum).unwrap();
        assert!(close(luminance.value(), 2.0 * 683.002 * spectrum.integral(&[&v]) / spectrum.total(), 1e-14));
    }

    #[test]
    fn what_a_system_does_not_see_says_nothing_and_is_zero() {
        let infrared = Density::line(1064.0, 1.0).unwrap();
        let lumens: Result<RadiantFlux, _> = convert(crate::quantity::table::LuminousFlux::new(1.0), &infrared);
        assert_eq!(lumens, Err(ConversionError::NothingSeen { system: "luminous".into() }));
        let seen: Illuminance = convert(Irradiance::new(1.0), &infrared).unwrap();
        assert_eq!(seen, Illuminance::ZERO);
        let dark: Result<Illuminance, _> = convert(Irradiance::new(1.0), &Density::zero());
        assert_eq!(dark, Err(ConversionError::NoLight));
    }

    #[test]
    fn the_ends_of_the_mesopic_scale_are_those_of_cie_191() {
        let a = library::density("A").unwrap();
        let lux = Illuminance::new(3.0);
        let photopic = to_mesopic(lux, &a, 1.0).unwrap();
        assert!(close(photopic.value(), 3.0, 1e-12));
        // The lumen fixes K at 555 nm in CIE 191, so S/P is counted with 1699/683.
        let scotopic = to_mesopic(lux, &a, 0.0).unwrap();
        let expected = crate::observer::efficiency::sp_ratio_with(&a, mesopic::EFFICACY_RATIO).unwrap() * 3.0;
        assert!(close(scotopic.value(), expected, 1e-12), "{} {expected}", scotopic.value());
        assert!(matches!(to_mesopic(lux, &a, 1.5), Err(ConversionError::Observer(_))));
        assert!(matches!(to_mesopic(lux, &a, f64::NAN), Err(ConversionError::Observer(_))));
    }

    const SYSTEMS: [System; 10] = [
        System::Radiant,
        System::Luminous,
        System::Photon,
        System::Scotopic,
        System::Mesopic { adaptation: 0.4 },
        System::AlphaOpic(AlphaOpic::SCone),
        System::AlphaOpic(AlphaOpic::MCone),
        System::AlphaOpic(AlphaOpic::LCone),
        System::AlphaOpic(AlphaOpic::Rhodopic),
        System::AlphaOpic(AlphaOpic::Melanopic),
    ];

    proptest! {
        #[test]
        fn the_way_there_and_back_is_the_identity(i in 0..10usize, j in 0..10usize, nm in 420.0..660.0f64, scale in -300.0..300.0f64) {
            let spectrum = Density::gaussian(scale.exp2(), nm, 20.0).unwrap();
            let there = ratio(SYSTEMS[i], SYSTEMS[j], &spectrum).unwrap();
            let back = ratio(SYSTEMS[j], SYSTEMS[i], &spectrum).unwrap();
            prop_assert!(there > 0.0 && close(there * back, 1.0, 1e-14));
        }

        #[test]
        fn conversions_are_linear_and_forget_the_scale(x in 1e-9..1e9f64, kelvin in 1500.0..20000.0f64, scale in 1e-300..1e300f64) {
            let spectrum = Density::black_body(kelvin).unwrap();
            let one: Illuminance = convert(Irradiance::new(1.0), &spectrum).unwrap();
            let many: Illuminance = convert(Irradiance::new(x), &spectrum.scaled(scale).unwrap()).unwrap();
            prop_assert!(close(many.value(), x * one.value(), 1e-14));
        }

        #[test]
        fn a_detour_changes_nothing(kelvin in 1500.0..20000.0f64) {
            let spectrum = Density::black_body(kelvin).unwrap();
            let direct: PhotonIrradiance = convert(Illuminance::new(100.0), &spectrum).unwrap();
            let melanopic: MelanopicIrradiance = convert(Illuminance::new(100.0), &spectrum).unwrap();
            let detour: PhotonIrradiance = convert(melanopic, &spectrum).unwrap();
            prop_assert!(close(detour.value(), direct.value(), 1e-14));
            let mesopic = to_mesopic(Illuminance::new(100.0), &spectrum, 0.3).unwrap();
            let by_mesopic: PhotonIrradiance = from_mesopic(mesopic, &spectrum, 0.3).unwrap();
            prop_assert!(close(by_mesopic.value(), direct.value(), 1e-14));
        }
    }
}
