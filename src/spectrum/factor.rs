//! Factors: reflectance, transmittance, responsivity, weighting functions; what multiplies a density. Not per nm.
//!
//! | variant | value at λ |
//! |---|---|
//! | `Constant(c)` | `c` |
//! | `Band` | `value` on the closed interval `from_nm`..`to_nm`, else 0 |
//! | `Table` | piecewise linear |
//! | `Gaussian` | `peak · exp(−(λ − centre)²/(2σ²))` |
//! | `Proportional(a)` | `a λ`, λ in nm |
//! | `Product`, `Sum`, `Scaled` | of other factors |
//!
//! Edges of bands and ends of tables belong to them: a line exactly on an edge passes. Two bands that share an edge and are
//! summed therefore count a line exactly on it twice.

use super::error::{band, finite, positive};
use super::{SpectrumError, Support, Table};

/// Beyond this many standard deviations, `exp(−t²/2)` is zero in `f64` (below 2⁻¹⁰⁷⁴).
pub(super) const GAUSSIAN_REACH_SIGMAS: f64 = 39.0;

/// Distances from the centre, in standard deviations, between which a Gaussian is resolved by a few Gauss–Legendre nodes.
pub(super) const GAUSSIAN_STEPS_SIGMAS: [f64; 14] =
    [0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 13.0, 17.0, 25.0, GAUSSIAN_REACH_SIGMAS];

/// A function of wavelength that multiplies a density.
#[derive(Debug, Clone, PartialEq)]
pub enum Factor {
    /// The same at every wavelength.
    Constant(f64),
    /// One value on a closed interval, zero elsewhere.
    Band {
        /// Lower edge, nm; belongs to the band.
        from_nm: f64,
        /// Upper edge, nm; belongs to the band.
        to_nm: f64,
        /// Value inside.
        value: f64,
    },
    /// Piecewise linear.
    Table(Table),
    /// A bell curve. With a standard deviation that is not above 0 it is zero everywhere.
    Gaussian {
        /// Value at the centre.
        peak: f64,
        /// Centre, nm.
        centre_nm: f64,
        /// Standard deviation, nm.
        sigma_nm: f64,
    },
    /// Proportional to wavelength: this much per nm. Photons per energy, and the responsivity of a quantum detector in A W⁻¹.
    Proportional(f64),
    /// The product of all; of none, 1.
    Product(Vec<Factor>),
    /// The sum of all; of none, 0.
    Sum(Vec<Factor>),
    /// A factor times a number.
    Scaled(f64, Box<Factor>),
}

impl Factor {
    /// The factor 1.
    pub const ONE: Factor = Factor::Constant(1.0);

    /// A band. Errors if an edge is negative or not finite, the edges are not in order, or the value is not finite.
    pub fn band(from_nm: f64, to_nm: f64, value: f64) -> Result<Self, SpectrumError> {
        let (from_nm, to_nm) = band(from_nm, to_nm)?;
        Ok(Self::Band { from_nm, to_nm, value: finite("the value of the band", value)? })
    }

    /// A Gaussian. Errors if the centre or the standard deviation is not positive and finite, or the peak is not finite.
    pub fn gaussian(peak: f64, centre_nm: f64, sigma_nm: f64) -> Result<Self, SpectrumError> {
        Ok(Self::Gaussian {
            peak: finite("the peak of the Gaussian", peak)?,
            centre_nm: positive("the centre of the Gaussian in nm", centre_nm)?,
            sigma_nm: positive("the standard deviation of the Gaussian in nm", sigma_nm)?,
        })
    }

    /// The factor times a number.
    pub fn scaled(self, scale: f64) -> Self {
        Self::Scaled(scale, Box::new(self))
    }

    /// The value at `nm`.
    pub fn at(&self, nm: f64) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::Band { from_nm, to_nm, value } => {
                if *from_nm <= nm && nm <= *to_nm {
                    *value
                } else {
                    0.0
                }
            }
            Self::Table(table) => table.at(nm),
            Self::Gaussian { peak, centre_nm, sigma_nm } => {
                if *sigma_nm > 0.0 {
                    let t = (nm - centre_nm) / sigma_nm;
                    peak * (-0.5 * t * t).exp()
                } else {
                    0.0
                }
            }
            Self::Proportional(per_nm) => per_nm * nm,
            Self::Product(factors) => factors.iter().map(|factor| factor.at(nm)).product(),
            Self::Sum(factors) => factors.iter().map(|factor| factor.at(nm)).sum(),
            Self::Scaled(scale, factor) => scale * factor.at(nm),
        }
    }

    /// Where the factor is not zero; possibly unbounded.
    pub fn support(&self) -> Support {
        match self {
            Self::Constant(value) | Self::Proportional(value) => {
                if *value == 0.0 {
                    Support::empty()
                } else {
                    Support::all()
                }
            }
            Self::Band { value: 0.0, .. } | Self::Gaussian { peak: 0.0, .. } => Support::empty(),
            Self::Band { from_nm, to_nm, .. } => Support::interval(*from_nm, *to_nm),
            Self::Table(table) => table.support(),
            Self::Gaussian { centre_nm, sigma_nm, .. } => {
                let reach_nm = GAUSSIAN_REACH_SIGMAS * sigma_nm;
                if *sigma_nm > 0.0 { Support::interval(centre_nm - reach_nm, centre_nm + reach_nm) } else { Support::empty() }
            }
            Self::Product(factors) => factors.iter().fold(Support::all(), |support, factor| support.intersection(&factor.support())),
            Self::Sum(factors) => factors.iter().fold(Support::empty(), |support, factor| support.union(&factor.support())),
            Self::Scaled(scale, factor) => {
                if *scale == 0.0 {
                    Support::empty()
                } else {
                    factor.support()
                }
            }
        }
    }

    /// All breakpoints, rising, nm: between neighbours the factor is smooth. For a Gaussian, wavelengths that resolve it.
    pub fn breakpoints(&self) -> Vec<f64> {
        let mut breakpoints = Vec::new();
        self.push_breakpoints(f64::NEG_INFINITY, f64::INFINITY, &mut breakpoints);
        breakpoints.retain(|nm| *nm > 0.0);
        breakpoints.sort_by(f64::total_cmp);
        breakpoints.dedup();
        breakpoints
    }

    /// Adds the breakpoints strictly inside (`from_nm`, `to_nm`), in no order.
    pub(super) fn push_breakpoints(&self, from_nm: f64, to_nm: f64, out: &mut Vec<f64>) {
        let mut push = |nm: f64| {
            if from_nm < nm && nm < to_nm {
                out.push(nm);
            }
        };
        match self {
            Self::Constant(_) | Self::Proportional(_) => {}
            Self::Band { from_nm, to_nm, .. } => {
                push(*from_nm);
                push(*to_nm);
            }
            Self::Table(table) => out.extend_from_slice(table.breakpoints_within(from_nm, to_nm)),
            Self::Gaussian { centre_nm, sigma_nm, .. } => {
                push(*centre_nm);
                for t in GAUSSIAN_STEPS_SIGMAS {
                    push(centre_nm - t * sigma_nm);
                    push(centre_nm + t * sigma_nm);
                }
            }
            Self::Product(factors) | Self::Sum(factors) => {
                for factor in factors {
                    factor.push_breakpoints(from_nm, to_nm, out);
                }
            }
            Self::Scaled(_, factor) => factor.push_breakpoints(from_nm, to_nm, out),
        }
    }

    /// Wavelengths at which the factor may jump (edges of bands, ends of tables that are zero outside), nm, in no order.
    pub fn discontinuities(&self) -> Vec<f64> {
        match self {
            Self::Constant(_) | Self::Gaussian { .. } | Self::Proportional(_) => Vec::new(),
            Self::Band { from_nm, to_nm, .. } => vec![*from_nm, *to_nm],
            Self::Table(table) => {
                let (from_nm, to_nm) = table.range_nm();
                let jumps = |end_nm: &f64, beyond_nm: f64| table.at(*end_nm) != table.at(beyond_nm);
                let mut ends = Vec::new();
                ends.extend(Some(from_nm).filter(|nm| jumps(nm, nm.next_down())));
                ends.extend(Some(to_nm).filter(|nm| jumps(nm, nm.next_up())));
                ends
            }
            Self::Product(factors) | Self::Sum(factors) => factors.iter().flat_map(Self::discontinuities).collect(),
            Self::Scaled(_, factor) => factor.discontinuities(),
        }
    }

    /// The one value of the factor over the closed interval `from_nm`..`to_nm`, if it is provably the same everywhere there.
    pub fn is_constant_over(&self, from_nm: f64, to_nm: f64) -> Option<f64> {
        match self {
            Self::Constant(value) => Some(*value),
            Self::Band { .. } | Self::Table(_) | Self::Proportional(_) => {
                let (least, largest) = self.range_over(from_nm, to_nm);
                (least == largest).then_some(least)
            }
            Self::Gaussian { peak, sigma_nm, .. } => (*peak == 0.0 || *sigma_nm <= 0.0).then_some(0.0),
            Self::Product(factors) => {
                let values: Vec<_> = factors.iter().map(|factor| factor.is_constant_over(from_nm, to_nm)).collect();
                if values.contains(&Some(0.0)) {
                    return Some(0.0);
                }
                values.into_iter().product()
            }
            Self::Sum(factors) => factors.iter().map(|factor| factor.is_constant_over(from_nm, to_nm)).sum(),
            Self::Scaled(scale, factor) => {
                if *scale == 0.0 {
                    return Some(0.0);
                }
                Some(scale * factor.is_constant_over(from_nm, to_nm)?)
            }
        }
    }

    /// An upper bound of the factor over the closed interval `from_nm`..`to_nm`; attained by all but products and sums.
    pub fn max_over(&self, from_nm: f64, to_nm: f64) -> f64 {
        self.range_over(from_nm, to_nm).1
    }

    /// Lower and upper bound over the closed interval `from_nm`..`to_nm`, by interval arithmetic.
    pub fn range_over(&self, from_nm: f64, to_nm: f64) -> (f64, f64) {
        match self {
            Self::Constant(value) => (*value, *value),
            Self::Band { from_nm: lower, to_nm: upper, value } => {
                if to_nm < *lower || from_nm > *upper {
                    (0.0, 0.0)
                } else if *lower <= from_nm && to_nm <= *upper {
                    (*value, *value)
                } else {
                    (value.min(0.0), value.max(0.0))
                }
            }
            Self::Table(table) => table.range_over(from_nm, to_nm),
            Self::Proportional(0.0) => (0.0, 0.0),
            Self::Proportional(per_nm) => {
                let ends = (per_nm * from_nm, per_nm * to_nm);
                (ends.0.min(ends.1), ends.0.max(ends.1))
            }
            Self::Gaussian { centre_nm, .. } => {
                // A bell is monotonic on either side: its extremes are at the ends and, if inside, at the centre.
                let nearest = self.at(centre_nm.max(from_nm).min(to_nm));
                let (low, high) = (self.at(from_nm), self.at(to_nm));
                (low.min(high).min(nearest), low.max(high).max(nearest))
            }
            Self::Product(factors) => factors.iter().fold((1.0, 1.0), |(low, high), factor| {
                let (least, largest) = factor.range_over(from_nm, to_nm);
                let corners = [low * least, low * largest, high * least, high * largest];
                (corners.into_iter().fold(f64::INFINITY, f64::min), corners.into_iter().fold(f64::NEG_INFINITY, f64::max))
            }),
            Self::Sum(factors) => factors.iter().fold((0.0, 0.0), |(low, high), factor| {
                let (least, largest) = factor.range_over(from_nm, to_nm);
                (low + least, high + largest)
            }),
            Self::Scaled(scale, factor) => {
                let (least, largest) = factor.range_over(from_nm, to_nm);
                let ends = (scale * least, scale * largest);
                (ends.0.min(ends.1), ends.0.max(ends.1))
            }
        }
    }

    /// Degree of the polynomial that the factor is between breakpoints; `None` if it is not one (Gaussians).
    pub(super) fn degree(&self) -> Option<usize> {
        match self {
            Self::Constant(_) | Self::Band { .. } => Some(0),
            Self::Table(_) | Self::Proportional(_) => Some(1),
            Self::Gaussian { .. } => None,
            Self::Product(factors) => factors.iter().map(Self::degree).sum(),
            Self::Sum(factors) => factors.iter().map(Self::degree).try_fold(0, |most, degree| Some(most.max(degree?))),
            Self::Scaled(_, factor) => factor.degree(),
        }
    }
}

impl From<Table> for Factor {
    fn from(table: Table) -> Self {
        Self::Table(table)
    }
}
