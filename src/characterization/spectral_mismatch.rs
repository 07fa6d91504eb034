//! How well a spectral responsivity follows V(λ): the mismatch index f1′ and the mismatch correction factor F.
//!
//! ```text
//! f1′ = ∫ |s*(λ) − V(λ)| dλ / ∫ V(λ) dλ,     s*(λ) = s(λ) ∫ S_A V dλ / ∫ S_A s dλ
//! F   = ∫ S_C s dλ ∫ S_Z V dλ / (∫ S_C V dλ ∫ S_Z s dλ)
//! ```
//!
//! | symbol | meaning |
//! |---|---|
//! | s | spectral responsivity, relative or absolute: its scale cancels |
//! | V | target: V(λ) unless another is given |
//! | S_A, S_C | spectrum with which the meter was adjusted: CIE illuminant A unless another is given |
//! | S_Z | spectrum that is measured; **true = reading × F** |
//!
//! f1′ is normalised with illuminant A, as meters are adjusted: normalised to the same peak or the same area it is another number. The
//! integrals are exact for tables (the sign changes of s* − V are found within each segment), or sums over steps where a standard or a
//! certificate means those. The range (360 nm to 830 nm here, 380 nm to 780 nm in many certificates) and the step could not be checked
//! against the text of the standard: they are inputs.
//!
//! Source: ISO/CIE 19476 and DIN 5032-6 as the literature quotes them.
//!
//! ```
//! use etendue::characterization::spectral_mismatch::{Wavelengths, f1_prime};
//! use etendue::spectrum::{Factor, library};
//!
//! let v = library::v_lambda();
//! assert!(f1_prime(&v.clone().scaled(3.7e-6), Wavelengths::VISIBLE)? < 1e-12);
//! let leaks = Factor::Sum(vec![v, Factor::Constant(0.005)]);
//! let index = f1_prime(&leaks, Wavelengths::VISIBLE)?;
//! assert!(0.02 < index && index < 0.04);
//! # Ok::<(), etendue::characterization::spectral_mismatch::MismatchError>(())
//! ```

use std::fmt;

use crate::spectrum::{Density, Factor, SpectrumError, library};

/// Points within a segment at which the sign of a difference is looked at; pieces that are straight need one.
const LOOKS: u32 = 8;
/// Halvings of a bracket of a sign change: from any segment to the resolution of `f64`.
const HALVINGS: usize = 60;

/// The wavelengths over which a mismatch is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Wavelengths {
    /// Integrals from one wavelength to another, nm.
    Integral {
        /// Lower end, nm.
        from_nm: f64,
        /// Upper end, nm.
        to_nm: f64,
    },
    /// Sums over steps, both ends included, nm.
    Sum {
        /// First wavelength, nm.
        from_nm: f64,
        /// Last wavelength, nm.
        to_nm: f64,
        /// Step, nm.
        step_nm: f64,
    },
}

impl Wavelengths {
    /// Integrals over the whole table of V(λ), 360 nm to 830 nm.
    pub const VISIBLE: Self = Self::Integral { from_nm: 360.0, to_nm: 830.0 };

    /// Ends, nm.
    fn range_nm(self) -> (f64, f64) {
        match self {
            Self::Integral { from_nm, to_nm } | Self::Sum { from_nm, to_nm, .. } => (from_nm, to_nm),
        }
    }

    /// A density within these wavelengths, as it is integrated or summed.
    ///
    /// # Errors
    /// If the wavelengths are no band, or the step is not above zero.
    pub fn of(self, density: &Density) -> Result<Density, SpectrumError> {
        match self {
            Self::Integral { from_nm, to_nm } => Ok(density.filtered(&Factor::band(from_nm, to_nm, 1.0)?)),
            Self::Sum { from_nm, to_nm, step_nm } => density.summed(from_nm, to_nm, step_nm),
        }
    }

    /// One per nm.
    pub(super) fn uniform(self) -> Result<Density, SpectrumError> {
        let (from_nm, to_nm) = self.range_nm();
        let flat = Density::flat(from_nm, to_nm, 1.0)?;
        if let Self::Sum { step_nm, .. } = self { flat.summed(from_nm, to_nm, step_nm) } else { Ok(flat) }
    }
}

/// Why there is no index.
#[derive(Debug, Clone, PartialEq)]
pub enum MismatchError {
    /// The responsivity or the target sees nothing of a spectrum (or less than nothing), so neither can be set to the other.
    NothingSeen {
        /// "responsivity" or "target".
        by: &'static str,
        /// "calibration" or "test".
        of: &'static str,
    },
    /// The index cannot be held in a number.
    OutOfRange,
    /// The wavelengths are no band.
    Spectrum(SpectrumError),
}

impl fmt::Display for MismatchError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NothingSeen { by, of } => write!(f, "the {by} sees nothing of the {of} spectrum within these wavelengths"),
            Self::OutOfRange => f.write_str("the index leaves the range of numbers (about 1e-308 to 1e308)"),
            Self::Spectrum(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for MismatchError {}

impl From<SpectrumError> for MismatchError {
    fn from(error: SpectrumError) -> Self {
        Self::Spectrum(error)
    }
}

/// General V(λ) mismatch index f1′ of a responsivity, adjusted with illuminant A; a pure number, 0.03 for 3 %.
///
/// # Errors
/// [`MismatchError`].
pub fn f1_prime(responsivity: &Factor, over: Wavelengths) -> Result<f64, MismatchError> {
    mismatch_index(responsivity, &library::v_lambda(), &Density::illuminant_a(), over)
}

/// The same against another target (V′(λ), a colour-matching function, an action spectrum), adjusted with another spectrum.
///
/// # Errors
/// [`MismatchError`].
pub fn mismatch_index(responsivity: &Factor, target: &Factor, calibration: &Density, over: Wavelengths) -> Result<f64, MismatchError> {
    let adjusted = adjustment(responsivity, target, &over.of(calibration)?, "calibration")?;
    let uniform = over.uniform()?;
    let all = uniform.integral(&[target]);
    if all.is_nan() || all <= 0.0 {
        return Err(MismatchError::NothingSeen { by: "target", of: "uniform" });
    }
    let difference = Factor::Sum(vec![responsivity.clone().scaled(adjusted), target.clone().scaled(-1.0)]);
    let apart = match over {
        Wavelengths::Sum { .. } => uniform.lines().iter().map(|line| line.power * difference.at(line.wavelength_nm).abs()).sum(),
        Wavelengths::Integral { from_nm, to_nm } => absolute_integral(&difference, from_nm, to_nm)?,
    };
    in_range(apart / all)
}

/// Spectral mismatch correction factor F: **true = reading × F** when a meter that was adjusted with `calibration` measures light of the
/// spectrum `test`. The spectra are taken as they are; [`Wavelengths::of`] makes sums of them.
///
/// # Errors
/// [`MismatchError`].
///
/// ```
/// use etendue::characterization::spectral_mismatch::correction_factor;
/// use etendue::spectrum::{Density, library};
///
/// let v = library::v_lambda();
/// let perfect = correction_factor(&v, &v, &library::density("LED-B3")?, &Density::illuminant_a())?;
/// assert!((perfect - 1.0).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn correction_factor(responsivity: &Factor, target: &Factor, test: &Density, calibration: &Density) -> Result<f64, MismatchError> {
    in_range(adjustment(responsivity, target, test, "test")? / adjustment(responsivity, target, calibration, "calibration")?)
}

/// Mean wavelength of a spectrum as a responsivity sees it, `∫ S s λ dλ / ∫ S s dλ`, nm; also called effective wavelength.
///
/// # Errors
/// [`MismatchError`].
pub fn mean_wavelength_nm(responsivity: &Factor, spectrum: &Density) -> Result<f64, MismatchError> {
    let seen = spectrum.integral(&[responsivity]);
    if !(seen > 0.0 && seen.is_finite()) {
        return Err(MismatchError::NothingSeen { by: "responsivity", of: "test" });
    }
    in_range(spectrum.integral(&[responsivity, &Factor::Proportional(1.0)]) / seen)
}

/// `∫ S V dλ / ∫ S s dλ`: what the responsivity is multiplied with to read the target for this spectrum. The scale of the spectrum cancels.
fn adjustment(responsivity: &Factor, target: &Factor, spectrum: &Density, of: &'static str) -> Result<f64, MismatchError> {
    let seen = |curve: &Factor, by| match spectrum.mean_of(curve) {
        Some(mean) if mean > 0.0 && mean.is_finite() => Ok(mean),
        _ => Err(MismatchError::NothingSeen { by, of }),
    };
    in_range(seen(target, "target")? / seen(responsivity, "responsivity")?)
}

fn in_range(x: f64) -> Result<f64, MismatchError> {
    if x.is_finite() { Ok(x) } else { Err(MismatchError::OutOfRange) }
}

/// `∫ |f| dλ`: the exact integrals of the stretches between the changes of sign.
fn absolute_integral(f: &Factor, from_nm: f64, to_nm: f64) -> Result<f64, SpectrumError> {
    let mut ends = vec![from_nm];
    ends.extend(f.breakpoints().into_iter().filter(|nm| from_nm < *nm && *nm < to_nm));
    ends.push(to_nm);
    let mut cuts = vec![from_nm];
    let mut last: Option<(f64, bool)> = None;
    let looks = ends.windows(2).flat_map(|end| (0..LOOKS).map(|k| end[0] + (end[1] - end[0]) * f64::from(k) / f64::from(LOOKS)));
    for nm in looks.chain([to_nm]) {
        let value = f.at(nm);
        if value == 0.0 {
            continue;
        }
        let positive = value > 0.0;
        if let Some((before_nm, was_positive)) = last
            && was_positive != positive
        {
            cuts.push(sign_change(f, before_nm, nm, was_positive));
        }
        last = Some((nm, positive));
    }
    cuts.push(to_nm);
    let mut sum = 0.0;
    for cut in cuts.windows(2).filter(|cut| cut[0] < cut[1]) {
        sum += Density::flat(cut[0], cut[1], 1.0)?.integral(&[f]).abs();
    }
    Ok(sum)
}

/// Where the sign changes between two wavelengths.
fn sign_change(f: &Factor, mut low_nm: f64, mut high_nm: f64, positive_below: bool) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low_nm + high_nm);
        if (f.at(middle) > 0.0) == positive_below {
            low_nm = middle;
        } else {
            high_nm = middle;
        }
    }
    0.5 * (low_nm + high_nm)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::{Outside, Table};
    use proptest::prelude::*;

    const SUM: Wavelengths = Wavelengths::Sum { from_nm: 380.0, to_nm: 780.0, step_nm: 5.0 };

    #[test]
    fn a_band_against_a_triangle_has_its_areas() {
        // Target: a triangle of height 1 on 500..600; responsivity: 1 on 500..600; adjusted with equal energy to the factor 1/2.
        let triangle = Factor::Table(Table::from_rows(&[(500.0, 0.0), (550.0, 1.0), (600.0, 0.0)], Outside::Zero).unwrap());
        let band = Factor::band(500.0, 600.0, 1.0).unwrap();
        let equal = Density::flat(400.0, 700.0, 1.0).unwrap();
        let over = Wavelengths::Integral { from_nm: 400.0, to_nm: 700.0 };
        // |1/2 − triangle| is four triangles of 25 nm by 1/2, over an area of 50.
        let index = mismatch_index(&band, &triangle, &equal, over).unwrap();
        assert!((index - 4.0 * 0.5 * 25.0 * 0.5 / 50.0).abs() < 1e-13, "{index}");
    }

    #[test]
    fn a_blind_meter_has_no_index() {
        let infrared = Factor::band(900.0, 1000.0, 1.0).unwrap();
        let blind = MismatchError::NothingSeen { by: "responsivity", of: "calibration" };
        assert_eq!(f1_prime(&infrared, Wavelengths::VISIBLE), Err(blind.clone()));
        assert_eq!(f1_prime(&infrared, SUM), Err(blind));
        let v = library::v_lambda();
        let laser = Density::line(1064.0, 1.0).unwrap();
        let unseen = MismatchError::NothingSeen { by: "target", of: "test" };
        assert_eq!(correction_factor(&v, &v, &laser, &Density::illuminant_a()), Err(unseen));
        let backwards = Wavelengths::Integral { from_nm: 780.0, to_nm: 380.0 };
        assert!(matches!(f1_prime(&v, backwards), Err(MismatchError::Spectrum(_))));
        assert!(matches!(f1_prime(&v, Wavelengths::Sum { from_nm: 380.0, to_nm: 780.0, step_nm: 0.0 }), Err(MismatchError::Spectrum(_))));
    }

    #[test]
    fn the_correction_of_a_line_is_the_quotient_of_the_curves() {
        let (v, s) = (library::v_lambda(), Factor::gaussian(1.0, 560.0, 45.0).unwrap());
        let a = Density::illuminant_a();
        let f = correction_factor(&s, &v, &Density::line(600.0, 3.0).unwrap(), &a).unwrap();
        let adjusted = a.integral(&[&v]) / a.integral(&[&s]);
        assert!((f / (v.at(600.0) / s.at(600.0) / adjusted) - 1.0).abs() < 1e-13);
    }

    proptest! {
        #[test]
        fn the_index_forgets_the_scale(centre in 520.0..600.0f64, sigma in 20.0..80.0f64, exponent in -300i32..300) {
            let s = Factor::gaussian(1.0, centre, sigma).unwrap();
            let scaled = s.clone().scaled(10f64.powi(exponent));
            for over in [Wavelengths::VISIBLE, SUM] {
                let (one, other) = (f1_prime(&s, over).unwrap(), f1_prime(&scaled, over).unwrap());
                prop_assert!((one / other - 1.0).abs() < 1e-11, "{} {}", one, other);
            }
        }

        #[test]
        fn fine_sums_tend_to_the_integral(centre in 520.0..600.0f64, sigma in 30.0..80.0f64) {
            let s = Factor::gaussian(1.0, centre, sigma).unwrap();
            let integral = f1_prime(&s, Wavelengths::VISIBLE).unwrap();
            let sum = f1_prime(&s, Wavelengths::Sum { from_nm: 360.0, to_nm: 830.0, step_nm: 0.05 }).unwrap();
            // The sum counts both ends in full: half a step of up to one, over the area of V(λ).
            prop_assert!((integral - sum).abs() < 0.05 / 100.0, "{} {}", integral, sum);
        }

        #[test]
        fn there_and_back_the_corrections_cancel(centre in 520.0..600.0f64, sigma in 20.0..80.0f64, kelvin in 1800.0..9000.0f64) {
            let (s, v, a) = (Factor::gaussian(1.0, centre, sigma).unwrap(), library::v_lambda(), Density::illuminant_a());
            let other = Density::black_body(kelvin).unwrap();
            let there = correction_factor(&s, &v, &other, &a).unwrap();
            let back = correction_factor(&s, &v, &a, &other).unwrap();
            prop_assert!((there * back - 1.0).abs() < 1e-12);
        }
    }
}
