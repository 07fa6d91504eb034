//! Densities: `φ(λ) = φ_continuum(λ) + Σ Φᵢ δ(λ − λᵢ)`, something per nm, and lines of zero width.
//!
//! The unit of the whole (W, W m⁻², W m⁻² sr⁻¹, 1 for a relative shape) is the business of whoever holds the density.
//! A line is a line: it has a power and a wavelength and no width, so no grid can miss it.

use super::error::{band, finite, not_negative, positive};
use super::factor::GAUSSIAN_REACH_SIGMAS;
use super::{Factor, Outside, SpectrumError, Support, Table, black_body, product_integral};

/// The width `w` in Ohno's model of an LED as a multiple of its full width at half maximum: `1/(2 √(−ln g))` where `g + 2 g⁵ = 3/2`.
pub const LED_WIDTH_OVER_FWHM: f64 = 1.084806812374024135;

/// A spectral line of zero width.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// Wavelength, nm.
    pub wavelength_nm: f64,
    /// The integral over the line, in the density's unit times nm (W for a spectral flux in W nm⁻¹).
    pub power: f64,
}

/// The part of a density that has a finite value per nm.
#[derive(Debug, Clone, PartialEq)]
pub enum Continuum {
    /// Piecewise linear, per nm; zero outside whatever the table says of it.
    Table(Table),
    /// Constant on an interval, per nm.
    Flat {
        /// Lower edge, nm.
        from_nm: f64,
        /// Upper edge, nm.
        to_nm: f64,
        /// Value, per nm.
        value: f64,
    },
    /// Spectral radiance of a black body, W m⁻² sr⁻¹ nm⁻¹.
    BlackBody {
        /// Temperature, K.
        temperature_k: f64,
    },
    /// A normal distribution of area 1, per nm. Only wavelengths above 0 exist, so an area below 0 nm is lost.
    Gaussian {
        /// Centre, nm.
        centre_nm: f64,
        /// Standard deviation, nm.
        sigma_nm: f64,
    },
    /// A continuum times a number.
    Scaled(f64, Box<Continuum>),
    /// A continuum times a factor.
    Filtered(Box<Continuum>, Factor),
    /// The sum of all; of none, zero.
    Sum(Vec<Continuum>),
}

impl Continuum {
    /// Value at `nm`, per nm.
    pub fn at(&self, nm: f64) -> f64 {
        match self {
            Self::Table(table) => {
                let (from_nm, to_nm) = table.range_nm();
                if from_nm <= nm && nm <= to_nm { table.at(nm) } else { 0.0 }
            }
            Self::Flat { from_nm, to_nm, value } => {
                if *from_nm <= nm && nm <= *to_nm {
                    *value
                } else {
                    0.0
                }
            }
            Self::BlackBody { temperature_k } => black_body::spectral_radiance(nm, *temperature_k),
            Self::Gaussian { centre_nm, sigma_nm } => {
                if *sigma_nm > 0.0 && nm > 0.0 {
                    let t = (nm - centre_nm) / sigma_nm;
                    (-0.5 * t * t).exp() / (sigma_nm * (2.0 * std::f64::consts::PI).sqrt())
                } else {
                    0.0
                }
            }
            Self::Scaled(scale, continuum) => scale * continuum.at(nm),
            Self::Filtered(continuum, factor) => continuum.at(nm) * factor.at(nm),
            Self::Sum(parts) => parts.iter().map(|part| part.at(nm)).sum(),
        }
    }

    /// Where the continuum is not zero.
    pub fn support(&self) -> Support {
        let support = match self {
            Self::Table(table) => {
                let (from_nm, to_nm) = table.range_nm();
                table.support().intersection(&Support::interval(from_nm, to_nm))
            }
            Self::Flat { value: 0.0, .. } => Support::empty(),
            Self::Flat { from_nm, to_nm, .. } => Support::interval(*from_nm, *to_nm),
            Self::BlackBody { temperature_k } => {
                if *temperature_k > 0.0 {
                    Support::all()
                } else {
                    Support::empty()
                }
            }
            Self::Gaussian { centre_nm, sigma_nm } => {
                let reach_nm = GAUSSIAN_REACH_SIGMAS * sigma_nm;
                if *sigma_nm > 0.0 { Support::interval(centre_nm - reach_nm, centre_nm + reach_nm) } else { Support::empty() }
            }
            Self::Scaled(0.0, _) => Support::empty(),
            Self::Scaled(_, continuum) => continuum.support(),
            Self::Filtered(continuum, factor) => continuum.support().intersection(&factor.support()),
            Self::Sum(parts) => parts.iter().fold(Support::empty(), |all, part| all.union(&part.support())),
        };
        support.with_width()
    }
}

/// `from_nm`, `from_nm + step_nm`, … up to and with `to_nm`, nm. Errors if the band is not one, the step not positive and finite, or the
/// steps too many.
pub(super) fn steps(from_nm: f64, to_nm: f64, step_nm: f64) -> Result<Vec<f64>, SpectrumError> {
    const MOST_STEPS: f64 = 1e7;
    let from_nm = positive("the first wavelength in nm", from_nm)?;
    let (_, to_nm) = band(from_nm, to_nm)?;
    let step_nm = positive("the step in nm", step_nm)?;
    let quotient = (to_nm - from_nm) / step_nm;
    if quotient > MOST_STEPS {
        return Err(SpectrumError::Parameter { name: "the number of steps", value: quotient, allowed: "at most ten million" });
    }
    // A quotient that is a whole number but for its rounding is one.
    let whole = quotient.round();
    let last = if (quotient - whole).abs() <= 4.0 * f64::EPSILON * whole.max(to_nm / step_nm) { whole } else { quotient.floor() };
    Ok((0..=last as u64).map(|i| from_nm + i as f64 * step_nm).collect())
}

/// A function of wavelength per nm: a continuum and lines, times one scale.
#[derive(Debug, Clone, PartialEq)]
pub struct Density {
    // The scale stays outside, so that 1e-300 times 1e300 loses nothing on the way.
    scale: f64,
    continuum: Continuum,
    lines: Vec<Line>,
}

impl Density {
    /// A continuum and lines. Errors if a line's wavelength is not positive and finite or its power negative or not finite.
    /// The continuum is taken as it is.
    pub fn new(continuum: Continuum, lines: &[Line]) -> Result<Self, SpectrumError> {
        for line in lines {
            positive("the wavelength of a line in nm", line.wavelength_nm)?;
            not_negative("the power of a line", line.power)?;
        }
        Ok(Self::assemble(continuum, lines.to_vec()))
    }

    fn assemble(continuum: Continuum, mut lines: Vec<Line>) -> Self {
        lines.retain(|line| line.power != 0.0);
        lines.sort_by(|a, b| a.wavelength_nm.total_cmp(&b.wavelength_nm));
        Self { scale: 1.0, continuum, lines }
    }

    /// Nothing at any wavelength.
    pub fn zero() -> Self {
        Self::assemble(Continuum::Sum(Vec::new()), Vec::new())
    }

    /// `value` per nm from `from_nm` to `to_nm`. Errors if the band is not one or the value negative or not finite.
    pub fn flat(from_nm: f64, to_nm: f64, value: f64) -> Result<Self, SpectrumError> {
        let (from_nm, to_nm) = band(from_nm, to_nm)?;
        let value = not_negative("the density of a flat spectrum per nm", value)?;
        Ok(Self::assemble(Continuum::Flat { from_nm, to_nm, value }, Vec::new()))
    }

    /// One line. Errors as in [`Density::new`].
    pub fn line(wavelength_nm: f64, power: f64) -> Result<Self, SpectrumError> {
        Self::lines_only(&[Line { wavelength_nm, power }])
    }

    /// Lines without a continuum. Errors as in [`Density::new`].
    pub fn lines_only(lines: &[Line]) -> Result<Self, SpectrumError> {
        Self::new(Continuum::Sum(Vec::new()), lines)
    }

    /// A normal distribution of area `power`, centre and standard deviation in nm. Errors if the centre or the standard deviation
    /// is not positive and finite, or the power negative or not finite.
    pub fn gaussian(power: f64, centre_nm: f64, sigma_nm: f64) -> Result<Self, SpectrumError> {
        let centre_nm = positive("the centre of the Gaussian in nm", centre_nm)?;
        let sigma_nm = positive("the standard deviation of the Gaussian in nm", sigma_nm)?;
        let power = not_negative("the power of the Gaussian", power)?;
        Ok(Self { scale: power, ..Self::assemble(Continuum::Gaussian { centre_nm, sigma_nm }, Vec::new()) })
    }

    /// A light-emitting diode of one colour by Ohno's model, of area 1, per nm: `(g + 2 g⁵)/3` with `g = exp(−(λ − peak)²/w²)`
    /// (Y. Ohno, Optical Engineering 44, 111302, 2005).
    ///
    /// `fwhm_nm` is the full width at half maximum that the result has. The width `w` in the formula, there called half spectral width
    /// and written Δλ₀.₅, is [`LED_WIDTH_OVER_FWHM`] times that: a model given by its `w` is `led(peak_nm, w / LED_WIDTH_OVER_FWHM)`.
    /// Since `g⁵` is a bell curve as well, the model is the sum of two Gaussians, and its integrals are as good as theirs.
    ///
    /// # Errors
    /// If the peak or the width is not positive and finite.
    ///
    /// ```
    /// # use etendue::spectrum::Density;
    /// let green = Density::led(530.0, 30.0)?;
    /// assert!((green.total() - 1.0).abs() < 1e-12);
    /// assert!((green.continuum_at(545.0) / green.continuum_at(530.0) - 0.5).abs() < 1e-12);
    /// # Ok::<(), etendue::spectrum::SpectrumError>(())
    /// ```
    pub fn led(peak_nm: f64, fwhm_nm: f64) -> Result<Self, SpectrumError> {
        let centre_nm = positive("the peak of the LED in nm", peak_nm)?;
        let fwhm_nm = positive("the full width at half maximum of the LED in nm", fwhm_nm)?;
        let width_nm = positive("the width of the LED in nm", LED_WIDTH_OVER_FWHM * fwhm_nm)?;
        // exp(−t²/w²) and exp(−5 t²/w²) as normal distributions: their areas are as 1 to 2/√5.
        let area = 1.0 + 2.0 / 5.0_f64.sqrt();
        let bell = |share: f64, sharpness: f64| {
            let sigma_nm = width_nm / (2.0 * sharpness).sqrt();
            Continuum::Scaled(share, Box::new(Continuum::Gaussian { centre_nm, sigma_nm }))
        };
        let sum = Continuum::Sum(vec![bell(1.0 / area, 1.0), bell(1.0 - 1.0 / area, 5.0)]);
        Ok(Self::assemble(sum, Vec::new()))
    }

    /// The CIE's summation as a density: lines of power `φ(λᵢ) Δλ` at `from_nm`, `from_nm + step_nm`, … up to and with `to_nm`. Lines of
    /// the density itself are kept as they are, wherever they lie.
    ///
    /// Tabulated colorimetry (CIE 015) is defined by such sums. With this density in place of the other, [`Density::integral`] is the sum
    /// over the products at the same wavelengths; there is no second way to integrate.
    ///
    /// # Errors
    /// If the band is not one, the step is not positive and finite, or there are more than ten million steps.
    ///
    /// ```
    /// # use etendue::spectrum::{Density, Factor};
    /// // Illuminant E summed in steps of 10 nm through a band of 400 nm to 420 nm: three lines of 100 · 10 nm.
    /// let sum = Density::flat(360.0, 830.0, 100.0)?.summed(360.0, 830.0, 10.0)?;
    /// assert_eq!(sum.integral(&[&Factor::band(400.0, 420.0, 1.0)?]), 3000.0);
    /// # Ok::<(), etendue::spectrum::SpectrumError>(())
    /// ```
    pub fn summed(&self, from_nm: f64, to_nm: f64, step_nm: f64) -> Result<Self, SpectrumError> {
        let wavelengths_nm = steps(from_nm, to_nm, step_nm)?;
        let sampled = wavelengths_nm.into_iter().map(|nm| Line { wavelength_nm: nm, power: self.continuum.at(nm) * step_nm });
        let lines: Vec<Line> = sampled.chain(self.lines.iter().copied()).collect();
        Ok(Self { scale: self.scale, ..Self::assemble(Continuum::Sum(Vec::new()), lines) })
    }

    /// Spectral radiance of a black body, W m⁻² sr⁻¹ nm⁻¹. Errors if the temperature in K lies outside [`black_body::TEMPERATURES_K`].
    pub fn black_body(temperature_k: f64) -> Result<Self, SpectrumError> {
        let (coldest, hottest) = black_body::TEMPERATURES_K;
        if !(coldest..=hottest).contains(&temperature_k) {
            let name = "the temperature of the black body in K";
            return Err(SpectrumError::Parameter { name, value: temperature_k, allowed: "from 1e-12 to 1e12" });
        }
        Ok(Self::assemble(Continuum::BlackBody { temperature_k }, Vec::new()))
    }

    /// A table per nm, zero outside. Errors if a value is negative; names the row.
    pub fn table(table: Table) -> Result<Self, SpectrumError> {
        for (index, (wavelength_nm, value)) in table.rows().enumerate() {
            if value < 0.0 {
                return Err(SpectrumError::Negative { row: index + 1, wavelength_nm, value });
            }
        }
        Ok(Self::assemble(Continuum::Table(table.with_outside(Outside::Zero)), Vec::new()))
    }

    /// CIE illuminant A, relative, 100 at 560 nm, 300–830 nm, by its formula (see [`black_body::illuminant_a`]).
    pub fn illuminant_a() -> Self {
        // The formula is Planck's law at the temperature that makes today's c₂ equal to the formula's exponent.
        let temperature_k = black_body::illuminant_a_temperature_k();
        let (from_nm, to_nm) = black_body::ILLUMINANT_A_RANGE_NM;
        let band = Factor::Band { from_nm, to_nm, value: 1.0 };
        let continuum = Continuum::Filtered(Box::new(Continuum::BlackBody { temperature_k }), band);
        let scale = 100.0 / black_body::spectral_radiance(560.0, temperature_k);
        Self { scale, ..Self::assemble(continuum, Vec::new()) }
    }

    /// The lines, rising in wavelength, with their powers.
    pub fn lines(&self) -> Vec<Line> {
        self.lines.iter().map(|line| Line { power: line.power * self.scale, ..*line }).collect()
    }

    /// The continuum at `nm`, per nm; lines are not in it.
    pub fn continuum_at(&self, nm: f64) -> f64 {
        self.scale * self.continuum.at(nm)
    }

    /// The density without its lines.
    pub fn without_lines(&self) -> Self {
        Self { scale: self.scale, ..Self::assemble(self.continuum.clone(), Vec::new()) }
    }

    /// The continuum without its scale, for the integrals.
    pub(super) fn parts(&self) -> (f64, &Continuum, &[Line]) {
        (self.scale, &self.continuum, &self.lines)
    }

    /// The density times a number; the number may be anywhere from 1e-300 to 1e300. Errors if it is not finite.
    pub fn scaled(&self, scale: f64) -> Result<Self, SpectrumError> {
        let scale = finite("the scale of a density", self.scale * finite("the scale of a density", scale)?)?;
        Ok(Self { scale, ..self.clone() })
    }

    /// The sum of two densities.
    pub fn plus(&self, other: &Density) -> Self {
        let mut lines = self.lines();
        lines.extend(other.lines());
        let part = |density: &Self| Continuum::Scaled(density.scale, Box::new(density.continuum.clone()));
        Self::assemble(Continuum::Sum(vec![part(self), part(other)]), lines)
    }

    /// The density behind a filter, in front of a reflector and the like: times a factor, still a density.
    pub fn filtered(&self, factor: &Factor) -> Self {
        let lines = self.lines.iter().map(|line| Line { power: line.power * factor.at(line.wavelength_nm), ..*line });
        let continuum = Continuum::Filtered(Box::new(self.continuum.clone()), factor.clone());
        Self { scale: self.scale, ..Self::assemble(continuum, lines.collect()) }
    }

    /// Where the density is not zero: intervals of the continuum, single wavelengths of the lines.
    pub fn support(&self) -> Support {
        self.joint_support(&[])
    }

    /// Where the product with all `factors` is not zero. Empty means that the integral is exactly zero.
    pub fn joint_support(&self, factors: &[&Factor]) -> Support {
        if self.scale == 0.0 {
            return Support::empty();
        }
        let lit = |line: &&Line| factors.iter().all(|factor| factor.at(line.wavelength_nm) != 0.0);
        let lines = self.lines.iter().filter(lit).map(|line| (line.wavelength_nm, line.wavelength_nm)).collect();
        let continuum =
            factors.iter().fold(self.continuum.support(), |support, factor| support.intersection(&factor.support())).with_width();
        continuum.union(&Support::from_intervals(lines))
    }

    /// The integral over all wavelengths, lines included.
    pub fn total(&self) -> f64 {
        self.integral(&[])
    }

    /// `∫ φ(λ) Π fᵢ(λ) dλ`, exact between breakpoints; lines count with their power.
    ///
    /// Piecewise-linear products are exact to rounding; black bodies and Gaussians converge to about 1e-13 relative. Inserting
    /// nodes into a table does not change the result. The result is infinite only if it cannot be held in an `f64`.
    pub fn integral(&self, factors: &[&Factor]) -> f64 {
        product_integral::integral(self, factors)
    }

    /// Mean of a factor over the density, `∫ φ f dλ / ∫ φ dλ`; `None` if the density is zero.
    pub fn mean_of(&self, factor: &Factor) -> Option<f64> {
        // The scale cancels, and without it neither integral can leave the range of f64.
        let unscaled = Self { scale: 1.0, ..self.clone() };
        let total = unscaled.total();
        (self.scale != 0.0 && total > 0.0).then(|| unscaled.integral(&[factor]) / total)
    }
}
