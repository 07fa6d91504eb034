//! Spectral luminous efficiency: `X = K ∫ X_e,λ(λ) V_x(λ) dλ`.
//!
//! | variant | V_x | K in lm/W | for |
//! |---|---|---|---|
//! | `Photopic1924` | V(λ), CIE 1924 | 683.002 | all photometry without another word |
//! | `Scotopic1951` | V′(λ), CIE 1951 | 1700.05 | eyes adapted to darkness |
//! | `JuddVos1978` | V_M(λ), CIE 1988 | 683.002 | vision science at short wavelengths |
//! | `Physiological2`, `Physiological10` | V_F(λ), V_F,10(λ), CIE 2015 | 683.358, 683.144 | photometry from cone fundamentals |
//! | `TenDegree1964` | V_10(λ), CIE 2005 | 683.599 | photometry of a field of 10° |
//!
//! # Convention
//!
//! The SI fixes 683 lm/W for radiation of 540 THz, 555.016 nm in standard air, *whatever the state of the eye*; so each function has its
//! own `K = 683 lm/W / V_x(555.016 nm)`. The figures are those of *Principles governing photometry* (BIPM-2019/05, CIE 018) and
//! of CIE 170-2 for V_F; they differ from 683 over the value interpolated in the 1-nm tables by less than 3e-4, which a test holds.
//! K′_m is rounded to 1700 lm/W in much of the literature and was 1699 lm/W in CIE 191 ([`super::mesopic`]).

use super::names::find;
use super::{ObserverError, embedded};
use crate::quantity::constants::K_M_LM_W;
use crate::spectrum::{Density, Factor};

/// A spectral luminous efficiency function.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Efficiency {
    /// V(λ), CIE 1924, photopic, 2°.
    Photopic1924,
    /// V′(λ), CIE 1951, scotopic.
    Scotopic1951,
    /// V_M(λ), Judd 1951 and Vos 1978, CIE 1988.
    JuddVos1978,
    /// V_F(λ) of cone fundamentals, 2°, CIE 2015.
    Physiological2,
    /// V_F,10(λ) of cone fundamentals, 10°, CIE 2015.
    Physiological10,
    /// V_10(λ) = ȳ_10(λ) of the CIE 1964 observer.
    TenDegree1964,
}

impl Efficiency {
    /// All of them.
    pub const ALL: [Self; 6] =
        [Self::Photopic1924, Self::Scotopic1951, Self::JuddVos1978, Self::Physiological2, Self::Physiological10, Self::TenDegree1964];

    /// The function, 1 at its maximum (V_F to 6e-5: its maximum lies between the nodes), zero outside its table.
    pub fn curve(self) -> Factor {
        embedded(self.name())
    }

    /// Name of the table in the library.
    pub fn name(self) -> &'static str {
        match self {
            Self::Photopic1924 => "V(lambda)",
            Self::Scotopic1951 => "V'(lambda)",
            Self::JuddVos1978 => "V_M(lambda)",
            Self::Physiological2 => "V_F(lambda) 2 degree",
            Self::Physiological10 => "V_F(lambda) 10 degree",
            Self::TenDegree1964 => "V_10(lambda)",
        }
    }

    /// The function of this name: that of its table, its symbol, or an everyday name ("photopic", "scotopic"). Errors with all names
    /// if there is none.
    ///
    /// ```
    /// use etendue::observer::Efficiency;
    ///
    /// assert_eq!(Efficiency::named("v'")?, Efficiency::Scotopic1951);
    /// assert!(Efficiency::named("skotopic").is_err());
    /// # Ok::<(), etendue::observer::ObserverError>(())
    /// ```
    pub fn named(name: &str) -> Result<Self, ObserverError> {
        find("luminous efficiency function", name, &Self::ALL, |efficiency| match efficiency {
            Self::Photopic1924 => &["V(lambda)", "V", "photopic", "CIE 1924"],
            Self::Scotopic1951 => &["V'(lambda)", "V'", "scotopic", "CIE 1951"],
            Self::JuddVos1978 => &["V_M(lambda)", "V_M", "Judd-Vos 1978", "Judd-Vos", "CIE 1988"],
            Self::Physiological2 => &["V_F(lambda) 2 degree", "V_F", "V_F(lambda)", "V_F 2°", "CIE 2015 2 degree"],
            Self::Physiological10 => &["V_F(lambda) 10 degree", "V_F,10", "V_F 10°", "V_F,10(lambda)", "CIE 2015 10 degree"],
            Self::TenDegree1964 => &["V_10(lambda)", "V_10", "CIE 1964"],
        })
    }

    /// Symbol for labels, such as "V′(λ)".
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Photopic1924 => "V(λ)",
            Self::Scotopic1951 => "V′(λ)",
            Self::JuddVos1978 => "V_M(λ)",
            Self::Physiological2 => "V_F(λ)",
            Self::Physiological10 => "V_F,10(λ)",
            Self::TenDegree1964 => "V_10(λ)",
        }
    }

    /// Maximum luminous efficacy of radiation K, lm/W; see the convention at the head of this file.
    pub fn max_efficacy_lm_w(self) -> f64 {
        match self {
            Self::Photopic1924 | Self::JuddVos1978 => K_M_LM_W,
            Self::Scotopic1951 => 1700.05,
            Self::Physiological2 => 683.358,
            Self::Physiological10 => 683.144,
            Self::TenDegree1964 => 683.599,
        }
    }
}

/// Luminous total of a density: lm for W nm⁻¹, lx for W m⁻² nm⁻¹, cd m⁻² for W m⁻² sr⁻¹ nm⁻¹.
///
/// ```
/// use etendue::observer::{Efficiency, efficiency::luminous};
/// use etendue::spectrum::Density;
///
/// // A milliwatt of a green laser is half a lumen, by day and night not the same one.
/// let laser = Density::line(532.0, 1e-3)?;
/// let (by_day, by_night) = (luminous(&laser, Efficiency::Photopic1924), luminous(&laser, Efficiency::Scotopic1951));
/// assert!((by_day - 0.683002 * 0.88496).abs() < 1e-4);
/// assert!(by_night > by_day);
/// # Ok::<(), etendue::spectrum::SpectrumError>(())
/// ```
pub fn luminous(density: &Density, efficiency: Efficiency) -> f64 {
    density.integral(&[&efficiency.curve(), &Factor::Constant(efficiency.max_efficacy_lm_w())])
}

/// Luminous efficacy of radiation `K ∫ S V_x dλ / ∫ S dλ`, lm/W; none for a density that is zero.
///
/// ```
/// use etendue::observer::{Efficiency, efficiency::luminous_efficacy_lm_w};
/// use etendue::spectrum::Density;
///
/// let sodium = Density::line(589.0, 2.5)?;
/// let found = luminous_efficacy_lm_w(&sodium, Efficiency::Photopic1924).ok_or("no light")?;
/// assert!((found - 683.002 * 0.7691547).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn luminous_efficacy_lm_w(density: &Density, efficiency: Efficiency) -> Option<f64> {
    Some(efficiency.max_efficacy_lm_w() * density.mean_of(&efficiency.curve())?)
}

/// Scotopic over photopic quantity, `K′_m ∫ S V′ dλ / (K_m ∫ S V dλ)` with K′_m/K_m = 1700.05/683.002; none where the photopic one
/// is zero.
///
/// ```
/// use etendue::observer::efficiency::sp_ratio;
/// use etendue::spectrum::Density;
///
/// // Incandescent light is worth 1.41 times as much to an eye adapted to darkness.
/// let sp = sp_ratio(&Density::illuminant_a()).ok_or("no light")?;
/// assert!((sp - 1.41).abs() < 0.01);
/// # Ok::<(), &str>(())
/// ```
pub fn sp_ratio(density: &Density) -> Option<f64> {
    sp_ratio_with(density, Efficiency::Scotopic1951.max_efficacy_lm_w() / Efficiency::Photopic1924.max_efficacy_lm_w())
}

/// As [`sp_ratio`] with another quotient of the maximum efficacies K′_m/K_m, such as 1700/683 or, for CIE 191, 1699/683.
///
/// ```
/// use etendue::observer::efficiency::sp_ratio_with;
/// use etendue::spectrum::Density;
///
/// // V′(555 nm) = 0.402 and V(555 nm) = 1.
/// let found = sp_ratio_with(&Density::line(555.0, 1.0)?, 1700.0 / 683.0).ok_or("no light")?;
/// assert!((found - 0.402 * 1700.0 / 683.0).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn sp_ratio_with(density: &Density, efficacy_ratio: f64) -> Option<f64> {
    let photopic = density.integral(&[&Efficiency::Photopic1924.curve()]);
    (photopic > 0.0).then(|| efficacy_ratio * (density.integral(&[&Efficiency::Scotopic1951.curve()]) / photopic))
}
