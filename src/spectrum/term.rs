//! A density times factors as a sum of terms `scale · kernel · factors`, each on smooth pieces.
//!
//! | coordinate y | wavelength | `dλ` | used for |
//! |---|---|---|---|
//! | wavelength | y | dy | most |
//! | reciprocal | 1/y | dy/y² | the tail of a black body to infinity |
//! | standardised | μ + σy | σ dy | Gaussian kernels of any width: y is not rounded by the size of μ |

use std::borrow::Cow;
use std::f64::consts::PI;

use super::factor::{GAUSSIAN_REACH_SIGMAS, GAUSSIAN_STEPS_SIGMAS};
use super::scaled_number::ScaledNumber;
use super::{Continuum, Density, Factor, Support, Table, black_body};

/// What is left of a density when scales and filters are taken off.
#[derive(Debug, Clone, Copy)]
pub(super) enum Kernel<'a> {
    Table(&'a Table),
    Flat { from_nm: f64, to_nm: f64 },
    BlackBody { temperature_k: f64, ln_reference: f64 },
    Gaussian { centre_nm: f64, sigma_nm: f64 },
}

/// One summand of a density times the factors asked for.
pub(super) struct Term<'a> {
    pub(super) scale: ScaledNumber,
    kernel: Kernel<'a>,
    factors: Vec<&'a Factor>,
}

/// The variable of integration of a segment.
#[derive(Debug, Clone, Copy)]
pub(super) enum Coordinate {
    Wavelength,
    Reciprocal,
    Standardised { centre_nm: f64, sigma_nm: f64 },
}

/// A piece of a term's support inside which the integrand is smooth.
#[derive(Debug, Clone, Copy)]
pub(super) struct Segment {
    pub(super) coordinate: Coordinate,
    pub(super) from: f64,
    pub(super) to: f64,
}

/// The continuum as a sum of terms, without those that are identically zero.
pub(super) fn terms<'a>(density: &'a Density, factors: &[&'a Factor]) -> Vec<Term<'a>> {
    let (scale, continuum, _) = density.parts();
    let mut terms = Vec::new();
    let mut product = ScaledNumber::new(scale);
    let mut rest = Vec::new();
    for factor in factors {
        product = take_constants(factor, product, &mut rest);
    }
    collect(continuum, product, &rest, &mut terms);
    for term in &mut terms {
        term.set_reference();
    }
    terms
}

/// Multiplies the constants of `factor` into `scale` and lists what is not constant.
fn take_constants<'a>(factor: &'a Factor, scale: ScaledNumber, rest: &mut Vec<&'a Factor>) -> ScaledNumber {
    match factor {
        Factor::Constant(value) => scale.times(*value),
        Factor::Scaled(value, inner) => take_constants(inner, scale.times(*value), rest),
        Factor::Product(list) => list.iter().fold(scale, |scale, inner| take_constants(inner, scale, rest)),
        _ => {
            rest.push(factor);
            scale
        }
    }
}

fn collect<'a>(continuum: &'a Continuum, scale: ScaledNumber, factors: &[&'a Factor], out: &mut Vec<Term<'a>>) {
    if scale.is_zero() {
        return;
    }
    let mut push = |scale: ScaledNumber, kernel| out.push(Term { scale, kernel, factors: factors.to_vec() });
    match continuum {
        Continuum::Table(table) => push(scale, Kernel::Table(table)),
        Continuum::Flat { value: 0.0, .. } => {}
        Continuum::Flat { from_nm, to_nm, value } => {
            push(scale.times(*value), Kernel::Flat { from_nm: *from_nm, to_nm: *to_nm });
        }
        Continuum::BlackBody { temperature_k } => {
            push(scale, Kernel::BlackBody { temperature_k: *temperature_k, ln_reference: 0.0 });
        }
        Continuum::Gaussian { centre_nm, sigma_nm } => {
            push(scale, Kernel::Gaussian { centre_nm: *centre_nm, sigma_nm: *sigma_nm });
        }
        Continuum::Scaled(value, inner) => collect(inner, scale.times(*value), factors, out),
        Continuum::Filtered(inner, factor) => {
            let mut list = factors.to_vec();
            let scale = take_constants(factor, scale, &mut list);
            collect(inner, scale, &list, out);
        }
        Continuum::Sum(parts) => {
            for part in parts {
                collect(part, scale, factors, out);
            }
        }
    }
}

impl Coordinate {
    pub(super) fn wavelength_nm(self, y: f64) -> f64 {
        match self {
            Self::Wavelength => y,
            Self::Reciprocal => 1.0 / y,
            Self::Standardised { centre_nm, sigma_nm } => centre_nm + sigma_nm * y,
        }
    }
}

impl Term<'_> {
    fn support(&self) -> Support {
        let kernel = match self.kernel {
            Kernel::Table(table) => Continuum::Table(table.clone()).support(),
            Kernel::Flat { from_nm, to_nm } => Support::interval(from_nm, to_nm),
            Kernel::BlackBody { temperature_k, .. } => Continuum::BlackBody { temperature_k }.support(),
            Kernel::Gaussian { centre_nm, sigma_nm } => Continuum::Gaussian { centre_nm, sigma_nm }.support(),
        };
        self.factors.iter().fold(kernel, |support, factor| support.intersection(&factor.support())).with_width()
    }

    /// Far in the Wien tail the black body is smaller than any `f64`: then its largest value on the support goes into the scale.
    fn set_reference(&mut self) {
        let Kernel::BlackBody { temperature_k, .. } = self.kernel else {
            return;
        };
        let Some((from_nm, to_nm)) = self.support().hull() else {
            return;
        };
        let brightest_nm = black_body::peak_wavelength_nm(temperature_k).clamp(from_nm, to_nm);
        let ln_largest = black_body::ln_spectral_radiance(brightest_nm, temperature_k);
        if ln_largest.is_finite() && ln_largest.abs() > 500.0 {
            self.kernel = Kernel::BlackBody { temperature_k, ln_reference: ln_largest };
            self.scale = self.scale.times_scaled(ScaledNumber::exp(ln_largest));
        }
    }

    /// The product without its scale, times `dλ/dy`.
    pub(super) fn integrand(&self, coordinate: Coordinate, y: f64) -> f64 {
        let nm = coordinate.wavelength_nm(y);
        let kernel = match (self.kernel, coordinate) {
            (Kernel::Table(table), _) => table.at(nm),
            (Kernel::Flat { .. }, _) => 1.0,
            (Kernel::BlackBody { temperature_k, ln_reference: 0.0 }, _) => black_body::spectral_radiance(nm, temperature_k),
            (Kernel::BlackBody { temperature_k, ln_reference }, _) => {
                (black_body::ln_spectral_radiance(nm, temperature_k) - ln_reference).exp()
            }
            // The normal distribution's 1/σ cancels with dλ = σ dy.
            (Kernel::Gaussian { .. }, _) => (-0.5 * y * y).exp() / (2.0 * PI).sqrt(),
        };
        let jacobian = if matches!(coordinate, Coordinate::Reciprocal) { nm * nm } else { 1.0 };
        self.factors.iter().fold(kernel * jacobian, |product, factor| product * factor.at(nm))
    }

    /// Relative error of the integrand that comes from rounding alone. Far in the Wien tail a rounded wavelength changes `exp(-x)`,
    /// `x = c₂/(λT)`, by `x` times the rounding: no two estimates agree better than that.
    pub(super) fn noise(&self, segment: &Segment) -> f64 {
        let Kernel::BlackBody { temperature_k, .. } = self.kernel else { return 0.0 };
        let shortest_nm = segment.coordinate.wavelength_nm(segment.from).min(segment.coordinate.wavelength_nm(segment.to));
        16.0 * f64::EPSILON * (black_body::SECOND_RADIATION_CONSTANT_NM_K / shortest_nm / temperature_k)
    }

    /// Degree of the integrand between breakpoints, if it is a polynomial.
    pub(super) fn degree(&self) -> Option<usize> {
        let kernel = match self.kernel {
            Kernel::Table(_) => Some(1),
            Kernel::Flat { .. } => Some(0),
            Kernel::BlackBody { .. } | Kernel::Gaussian { .. } => None,
        };
        self.factors.iter().try_fold(kernel?, |sum, factor| Some(sum + factor.degree()?))
    }

    /// The tables of which the term is the product, if it is one of tables alone. The kernel's table is zero outside.
    pub(super) fn tables(&self) -> Option<Vec<&Table>> {
        let Kernel::Table(kernel) = self.kernel else { return None };
        let factors = self.factors.iter().map(|factor| if let Factor::Table(table) = factor { Some(table) } else { None });
        std::iter::once(Some(kernel)).chain(factors).collect()
    }

    /// The support, cut at all breakpoints and at `cuts_nm`.
    pub(super) fn segments(&self, cuts_nm: &[f64]) -> Vec<Segment> {
        let mut segments = Vec::new();
        for &(from_nm, to_nm) in self.support().intervals() {
            let mut cuts: Vec<f64> = cuts_nm.iter().copied().filter(|nm| from_nm < *nm && *nm < to_nm).collect();
            for factor in &self.factors {
                factor.push_breakpoints(from_nm, to_nm, &mut cuts);
            }
            if let Kernel::Gaussian { centre_nm, sigma_nm } = self.kernel {
                let coordinate = Coordinate::Standardised { centre_nm, sigma_nm };
                let standardised = |nm: f64| ((nm - centre_nm) / sigma_nm).clamp(-GAUSSIAN_REACH_SIGMAS, GAUSSIAN_REACH_SIGMAS);
                let (from, to) = (standardised(from_nm), standardised(to_nm));
                let steps = GAUSSIAN_STEPS_SIGMAS.iter().flat_map(|t| [-t, *t]).chain([0.0]);
                let cuts = cuts.into_iter().map(standardised).chain(steps).filter(|t| from < *t && *t < to);
                push_segments(coordinate, from, to, cuts.collect(), &mut segments);
                continue;
            }
            cuts.extend(self.kernel_breakpoints().iter().copied().filter(|nm| from_nm < *nm && *nm < to_nm));
            if to_nm.is_finite() {
                push_segments(Coordinate::Wavelength, from_nm, to_nm, cuts, &mut segments);
            } else {
                // Only black bodies reach infinity, and their breakpoints lie inside any interval that does, or below it.
                let tail_nm = cuts.iter().copied().fold(from_nm, f64::max);
                cuts.retain(|nm| *nm < tail_nm);
                push_segments(Coordinate::Wavelength, from_nm, tail_nm, cuts, &mut segments);
                push_segments(Coordinate::Reciprocal, 0.0, 1.0 / tail_nm, Vec::new(), &mut segments);
            }
        }
        segments
    }

    fn kernel_breakpoints(&self) -> Cow<'_, [f64]> {
        match self.kernel {
            Kernel::Table(table) => Cow::Borrowed(table.wavelengths_nm()),
            Kernel::BlackBody { temperature_k, .. } => {
                // At x = c₂/(λT) in half octaves, from where the radiance underflows to the tail, smooth in 1/λ.
                let nm = |octave: i32| black_body::SECOND_RADIATION_CONSTANT_NM_K / temperature_k / 2.0_f64.powi(octave);
                Cow::Owned((-12..=24).map(|half| nm(half / 2) * if half % 2 == 0 { 1.0 } else { 0.75 }).collect())
            }
            Kernel::Flat { .. } | Kernel::Gaussian { .. } => Cow::Borrowed(&[]),
        }
    }
}

/// Sorts the cuts and adds the pieces between them.
fn push_segments(coordinate: Coordinate, from: f64, to: f64, mut cuts: Vec<f64>, out: &mut Vec<Segment>) {
    cuts.push(from);
    cuts.push(to);
    cuts.sort_by(f64::total_cmp);
    out.extend(cuts.windows(2).filter(|pair| pair[0] < pair[1]).map(|pair| Segment { coordinate, from: pair[0], to: pair[1] }));
}
