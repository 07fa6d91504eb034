//! α-opic quantities: how the five photoreceptors of the eye are excited.
//!
//! ```text
//! E_α   = ∫ E_e,λ s_α dλ              α-opic irradiance, W/m²
//! K_α,v = E_α / E_v                   α-opic efficacy of luminous radiation (ELR), W/lm
//! E_v,α^D65 = E_α / K_α,v(D65)        α-opic equivalent daylight (D65) illuminance (EDI), lx
//! γ_α,v^D65 = K_α,v / K_α,v(D65)      α-opic daylight (D65) efficacy ratio (DER)
//! ```
//!
//! | α | photoreceptor | K_α,v(D65) in mW/lm |
//! |---|---|---|
//! | S-cone-opic | short-wavelength cone | 0.8173 |
//! | M-cone-opic | medium-wavelength cone | 1.4558 |
//! | L-cone-opic | long-wavelength cone | 1.6289 |
//! | rhodopic | rod | 1.4497 |
//! | melanopic | intrinsically photosensitive retinal ganglion cell | 1.3262 |
//!
//! Integrals are exact on the tables here; the standard sums over 380 nm to 780 nm in steps of 1 nm, which changes the figures
//! above by less than their last digit. Source: CIE S 026:2018.

use super::efficiency::{Efficiency, luminous};
use super::names::find;
use super::{ObserverError, embedded};
use crate::spectrum::{Density, Factor, library};

/// One of the five α-opic action spectra.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum AlphaOpic {
    /// S-cone-opic.
    SCone,
    /// M-cone-opic.
    MCone,
    /// L-cone-opic.
    LCone,
    /// Rhodopic: rods.
    Rhodopic,
    /// Melanopic: intrinsically photosensitive retinal ganglion cells.
    Melanopic,
}

impl AlphaOpic {
    /// All five, in the order of the standard.
    pub const ALL: [Self; 5] = [Self::SCone, Self::MCone, Self::LCone, Self::Rhodopic, Self::Melanopic];

    /// The adjective, such as "melanopic".
    pub fn name(self) -> &'static str {
        match self {
            Self::SCone => "S-cone-opic",
            Self::MCone => "M-cone-opic",
            Self::LCone => "L-cone-opic",
            Self::Rhodopic => "rhodopic",
            Self::Melanopic => "melanopic",
        }
    }

    /// The one of this name: the adjective, "S-cone" and the like, or the index. Errors with all names if there is none.
    pub fn named(name: &str) -> Result<Self, ObserverError> {
        find("α-opic action spectrum", name, &Self::ALL, |receptor| match receptor {
            Self::SCone => &["S-cone-opic", "S-cone", "cyanopic", "sc"],
            Self::MCone => &["M-cone-opic", "M-cone", "chloropic", "mc"],
            Self::LCone => &["L-cone-opic", "L-cone", "erythropic", "lc"],
            Self::Rhodopic => &["rhodopic", "rod", "rh"],
            Self::Melanopic => &["melanopic", "mel"],
        })
    }

    /// The index in symbols: "sc", "mc", "lc", "rh", "mel".
    pub fn index(self) -> &'static str {
        match self {
            Self::SCone => "sc",
            Self::MCone => "mc",
            Self::LCone => "lc",
            Self::Rhodopic => "rh",
            Self::Melanopic => "mel",
        }
    }

    /// The action spectrum s_α(λ), 1 at its maximum, zero outside its table.
    pub fn curve(self) -> Factor {
        embedded(&format!("CIE S 026 action spectra {}", self.index()))
    }

    /// α-opic irradiance of a spectral irradiance in W m⁻² nm⁻¹: W m⁻². In the same way flux and radiance.
    ///
    /// ```
    /// use etendue::observer::AlphaOpic;
    /// use etendue::spectrum::Density;
    ///
    /// // At the maximum of the melanopic action spectrum all of the irradiance counts.
    /// assert_eq!(AlphaOpic::Melanopic.irradiance(&Density::line(490.0, 0.3)?), 0.3);
    /// # Ok::<(), etendue::spectrum::SpectrumError>(())
    /// ```
    pub fn irradiance(self, density: &Density) -> f64 {
        density.integral(&[&self.curve()])
    }

    /// α-opic efficacy of luminous radiation (ELR), W/lm; none for a spectrum without luminous flux.
    ///
    /// ```
    /// use etendue::observer::AlphaOpic;
    /// use etendue::spectrum::Density;
    ///
    /// let lamp = AlphaOpic::Melanopic.efficacy_of_luminous_radiation(&Density::illuminant_a()).ok_or("no light")?;
    /// assert!(lamp < 0.5 * AlphaOpic::Melanopic.elr_of_d65());
    /// # Ok::<(), &str>(())
    /// ```
    pub fn efficacy_of_luminous_radiation(self, density: &Density) -> Option<f64> {
        efficacy_of_luminous_radiation(density, &self.curve())
    }

    /// ELR of daylight D65, W/lm. NaN if the table of D65 could not be read, which the tests exclude.
    pub fn elr_of_d65(self) -> f64 {
        library::density("D65").ok().and_then(|d65| self.efficacy_of_luminous_radiation(&d65)).unwrap_or(f64::NAN)
    }

    /// α-opic equivalent daylight quantity: illuminance in lx (EDI) of a spectral irradiance in W m⁻² nm⁻¹, luminance in cd m⁻² (EDL)
    /// of a spectral radiance in W m⁻² sr⁻¹ nm⁻¹.
    ///
    /// ```
    /// use etendue::observer::AlphaOpic;
    /// use etendue::spectrum::library;
    ///
    /// // 500 lx from an incandescent lamp are worth about 250 lx of daylight to the circadian system.
    /// let lamp = library::density("A")?;
    /// let lamp = lamp.scaled(500.0 / etendue::observer::efficiency::luminous(&lamp, etendue::observer::Efficiency::Photopic1924))?;
    /// assert!((AlphaOpic::Melanopic.equivalent_daylight(&lamp) - 248.0).abs() < 1.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn equivalent_daylight(self, density: &Density) -> f64 {
        self.irradiance(density) / self.elr_of_d65()
    }

    /// α-opic daylight efficacy ratio (DER), 1 for D65; none for a spectrum without luminous flux.
    ///
    /// ```
    /// use etendue::observer::AlphaOpic;
    /// use etendue::spectrum::{Density, library};
    ///
    /// let der = AlphaOpic::Rhodopic.daylight_efficacy_ratio(&library::density("D65")?);
    /// assert!(der.is_some_and(|der| (der - 1.0).abs() < 1e-12));
    /// assert_eq!(AlphaOpic::Rhodopic.daylight_efficacy_ratio(&Density::zero()), None);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn daylight_efficacy_ratio(self, density: &Density) -> Option<f64> {
        Some(self.efficacy_of_luminous_radiation(density)? / self.elr_of_d65())
    }
}

/// Efficacy of luminous radiation `∫ S s dλ / (K_m ∫ S V dλ)`, W/lm, of any action spectrum; none for a spectrum without luminous flux.
///
/// ```
/// use etendue::observer::alpha_opic::efficacy_of_luminous_radiation;
/// use etendue::spectrum::{Density, Factor};
///
/// // All of the radiation: the reciprocal of the luminous efficacy.
/// let green = Density::line(555.0, 3.0)?;
/// assert_eq!(efficacy_of_luminous_radiation(&green, &Factor::ONE), Some(1.0 / 683.002));
/// # Ok::<(), etendue::spectrum::SpectrumError>(())
/// ```
pub fn efficacy_of_luminous_radiation(density: &Density, action: &Factor) -> Option<f64> {
    let luminous = luminous(density, Efficiency::Photopic1924);
    (luminous > 0.0).then(|| density.integral(&[action]) / luminous)
}
