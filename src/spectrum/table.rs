//! Piecewise-linear tables: `f(λ) = fᵢ + (fᵢ₊₁ − fᵢ)(λ − λᵢ)/(λᵢ₊₁ − λᵢ)` on `λᵢ ≤ λ ≤ λᵢ₊₁`.
//!
//! | parameter | unit | meaning |
//! |---|---|---|
//! | wavelengths | nm | breakpoints, strictly increasing, finite, above 0, at least 2 |
//! | values | any | finite |
//! | outside | – | zero beyond the ends, or the end values held |

use std::sync::Arc;

use super::{SpectrumError, Support};

/// What a table is beyond its ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outside {
    /// Zero. The ends themselves belong to the table.
    Zero,
    /// The end values, held for ever.
    Hold,
}

/// A piecewise-linear function of wavelength on its own breakpoints. Cloning is cheap: the columns are shared.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    wavelengths_nm: Arc<[f64]>,
    values: Arc<[f64]>,
    outside: Outside,
}

impl Table {
    /// A table of `values` at `wavelengths_nm`.
    ///
    /// # Errors
    /// [`SpectrumError`] names the first row (counted from 1) that is not finite, not positive or not increasing; fewer than
    /// two rows and columns of different length are errors too.
    pub fn new(wavelengths_nm: Vec<f64>, values: Vec<f64>, outside: Outside) -> Result<Self, SpectrumError> {
        if wavelengths_nm.len() != values.len() {
            return Err(SpectrumError::LengthsDiffer { wavelengths: wavelengths_nm.len(), values: values.len() });
        }
        if values.len() < 2 {
            return Err(SpectrumError::TooFewRows { rows: values.len() });
        }
        let mut previous_nm = 0.0;
        for (index, (&wavelength_nm, &value)) in wavelengths_nm.iter().zip(&values).enumerate() {
            let row = index + 1;
            if !(wavelength_nm.is_finite() && wavelength_nm > 0.0) {
                return Err(SpectrumError::Wavelength { row, wavelength_nm });
            }
            if wavelength_nm <= previous_nm {
                return Err(SpectrumError::NotIncreasing { row, previous_nm, wavelength_nm });
            }
            if !value.is_finite() {
                return Err(SpectrumError::NotFinite { row, wavelength_nm, value });
            }
            previous_nm = wavelength_nm;
        }
        Ok(Self { wavelengths_nm: wavelengths_nm.into(), values: values.into(), outside })
    }

    /// A table of (wavelength in nm, value) rows. Errors as in [`Table::new`].
    pub fn from_rows(rows: &[(f64, f64)], outside: Outside) -> Result<Self, SpectrumError> {
        let (wavelengths_nm, values) = rows.iter().copied().unzip();
        Self::new(wavelengths_nm, values, outside)
    }

    /// A table whose columns are known to be valid.
    pub(super) fn from_valid(wavelengths_nm: Vec<f64>, values: Vec<f64>, outside: Outside) -> Self {
        Self { wavelengths_nm: wavelengths_nm.into(), values: values.into(), outside }
    }

    /// The breakpoints, nm, strictly increasing.
    pub fn wavelengths_nm(&self) -> &[f64] {
        &self.wavelengths_nm
    }

    /// The values at the breakpoints.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The rows (wavelength in nm, value), rising.
    pub fn rows(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.wavelengths_nm.iter().copied().zip(self.values.iter().copied())
    }

    /// What the table is beyond its ends.
    pub fn outside(&self) -> Outside {
        self.outside
    }

    /// The same rows with another rule beyond the ends.
    pub fn with_outside(self, outside: Outside) -> Self {
        Self { outside, ..self }
    }

    /// First and last breakpoint, nm.
    pub fn range_nm(&self) -> (f64, f64) {
        (self.wavelengths_nm[0], self.wavelengths_nm[self.wavelengths_nm.len() - 1])
    }

    /// The value at `nm`. Exact at breakpoints; on the ends the table's own value also under [`Outside::Zero`].
    pub fn at(&self, nm: f64) -> f64 {
        let last = self.values.len() - 1;
        let after = self.wavelengths_nm.partition_point(|&breakpoint| breakpoint <= nm);
        if after == 0 {
            return if self.outside == Outside::Hold { self.values[0] } else { 0.0 };
        }
        if after > last {
            let holds = self.outside == Outside::Hold || nm == self.wavelengths_nm[last];
            return if holds { self.values[last] } else { 0.0 };
        }
        let (from, to) = (self.wavelengths_nm[after - 1], self.wavelengths_nm[after]);
        let (low, high) = (self.values[after - 1], self.values[after]);
        // This form keeps a constant segment exactly constant, which the grey test of a scene relies on.
        low + (high - low) * ((nm - from) / (to - from))
    }

    /// The breakpoints strictly inside (`from_nm`, `to_nm`).
    pub fn breakpoints_within(&self, from_nm: f64, to_nm: f64) -> &[f64] {
        let first = self.wavelengths_nm.partition_point(|&breakpoint| breakpoint <= from_nm);
        let end = self.wavelengths_nm.partition_point(|&breakpoint| breakpoint < to_nm);
        &self.wavelengths_nm[first..end.max(first)]
    }

    /// Where the table is not zero (see [`Support`]): gaps of zeros inside the table are left out.
    pub fn support(&self) -> Support {
        let last = self.values.len() - 1;
        let (first_nm, last_nm) = self.range_nm();
        let mut intervals = Vec::new();
        if self.outside == Outside::Hold && self.values[0] != 0.0 {
            intervals.push((0.0, first_nm));
        }
        for i in 0..last {
            if self.values[i] != 0.0 || self.values[i + 1] != 0.0 {
                intervals.push((self.wavelengths_nm[i], self.wavelengths_nm[i + 1]));
            }
        }
        if self.outside == Outside::Hold && self.values[last] != 0.0 {
            intervals.push((last_nm, f64::INFINITY));
        }
        Support::from_intervals(intervals)
    }

    /// Least and largest value over the closed interval `from_nm`..`to_nm`, exact.
    pub fn range_over(&self, from_nm: f64, to_nm: f64) -> (f64, f64) {
        let (first_nm, last_nm) = self.range_nm();
        let mut range = (f64::INFINITY, f64::NEG_INFINITY);
        let mut include = |value: f64| range = (range.0.min(value), range.1.max(value));
        include(self.at(from_nm));
        include(self.at(to_nm));
        // The ends belong to the table: an interval that begins or ends beyond them meets their values.
        for (end_nm, value) in [(first_nm, self.values[0]), (last_nm, self.values[self.values.len() - 1])] {
            if from_nm <= end_nm && end_nm <= to_nm {
                include(value);
            }
        }
        let first = self.wavelengths_nm.partition_point(|&breakpoint| breakpoint <= from_nm);
        let inside = self.breakpoints_within(from_nm, to_nm).len();
        self.values[first..first + inside].iter().copied().for_each(&mut include);
        range
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn triangle(outside: Outside) -> Table {
        Table::from_rows(&[(400.0, 1.0), (500.0, 3.0), (600.0, 2.0)], outside).unwrap()
    }

    #[test]
    fn values_lie_on_the_straight_line_between_breakpoints() {
        let table = triangle(Outside::Zero);
        assert_eq!([table.at(400.0), table.at(450.0), table.at(500.0), table.at(600.0)], [1.0, 2.0, 3.0, 2.0]);
        assert_eq!([table.at(400.0_f64.next_down()), table.at(600.0_f64.next_up())], [0.0, 0.0]);
        let held = triangle(Outside::Hold);
        assert_eq!([held.at(1.0), held.at(1e9), held.at(f64::INFINITY)], [1.0, 2.0, 2.0]);
    }

    #[test]
    fn errors_name_the_row() {
        let error = |rows: &[(f64, f64)]| Table::from_rows(rows, Outside::Zero).unwrap_err();
        assert_eq!(error(&[(1.0, 0.0)]), SpectrumError::TooFewRows { rows: 1 });
        assert_eq!(error(&[(2.0, 0.0), (2.0, 1.0)]), SpectrumError::NotIncreasing { row: 2, previous_nm: 2.0, wavelength_nm: 2.0 });
        assert_eq!(error(&[(0.0, 0.0), (2.0, 1.0)]), SpectrumError::Wavelength { row: 1, wavelength_nm: 0.0 });
        let infinite = error(&[(1.0, 0.0), (2.0, f64::INFINITY)]);
        assert_eq!(infinite, SpectrumError::NotFinite { row: 2, wavelength_nm: 2.0, value: f64::INFINITY });
        assert!(Table::new(vec![1.0], vec![], Outside::Zero).is_err());
    }

    #[test]
    fn a_gap_of_zeros_is_not_in_the_support() {
        let rows = [(600.0, 1.0), (620.0, 0.0), (640.0, 0.0), (660.0, 1.0)];
        let table = Table::from_rows(&rows, Outside::Hold).unwrap();
        assert_eq!(table.support().intervals(), &[(0.0, 620.0), (640.0, f64::INFINITY)]);
        assert!(!table.support().contains(633.0));
    }

    proptest! {
        #[test]
        fn range_over_bounds_every_value(from in 300.0..700.0_f64, width in 0.0..300.0_f64, t in 0.0..=1.0_f64) {
            for outside in [Outside::Zero, Outside::Hold] {
                let table = triangle(outside);
                let (least, largest) = table.range_over(from, from + width);
                let value = table.at(from + t * width);
                prop_assert!(least - 1e-12 <= value && value <= largest + 1e-12);
            }
        }
    }
}
