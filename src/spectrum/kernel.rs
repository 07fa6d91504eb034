//! Integrals of many tables on one grid: `∫ φ(λ) Π fᵢ(λ) dλ = Σₖ wₖ φ(λₖ)` with `wₖ = ∫ hatₖ(λ) Π fᵢ(λ) dλ`.
//!
//! * `hatₖ` is 1 at node k and falls linearly to 0 at its neighbours. A table that is linear between the nodes and zero outside is
//!   `Σ φ(λₖ) hatₖ`, so the sum is exact for it: the result is that of [`Density::integral`](super::Density::integral) to rounding.
//! * The weights are computed once, on the union of the grid and the breakpoints of the factors; a spectrum then costs one dot product.
//! * The order of summation is fixed, whatever the processor: 32 partial sums, then pairs. The same numbers give the same bits.

use multiversion::multiversion;

use super::product_integral::points_and_weights;
use super::term::terms;
use super::{Density, Factor, Outside, SpectrumError, Table};

/// Weights of the nodes of a grid for the integral against a product of factors.
#[derive(Debug, Clone, PartialEq)]
pub struct Weights {
    wavelengths_nm: Vec<f64>,
    weights: Vec<f64>,
}

impl Weights {
    /// The weights for `Π factors` on a grid, nm. Without factors they are those of the trapezoidal rule.
    ///
    /// Piecewise polynomial factors are exact to rounding; Gaussians are resolved to about 1e-13 of their peak.
    ///
    /// # Errors
    /// If the grid has fewer than two nodes or is not finite, positive and strictly increasing.
    ///
    /// ```
    /// use etendue::spectrum::{Density, Outside, Table, kernel::Weights, library};
    /// let grid: Vec<f64> = (380..=780).map(f64::from).collect();
    /// let v = library::v_lambda();
    /// let weights = Weights::new(&grid, &[&v])?;
    /// let values: Vec<f64> = grid.iter().map(|nm| 1e-3 * nm).collect();
    /// let spectrum = Density::table(Table::new(grid, values.clone(), Outside::Zero)?)?;
    /// assert!((weights.integral(&values)? / spectrum.integral(&[&v]) - 1.0).abs() < 1e-13);
    /// # Ok::<(), etendue::spectrum::SpectrumError>(())
    /// ```
    pub fn new(grid_nm: &[f64], factors: &[&Factor]) -> Result<Self, SpectrumError> {
        let (from_nm, to_nm) = (grid_nm.first().copied().unwrap_or(0.0), grid_nm.last().copied().unwrap_or(0.0));
        Table::new(grid_nm.to_vec(), vec![1.0; grid_nm.len()], Outside::Zero)?;
        Self::of(grid_nm, &Density::flat(from_nm, to_nm, 1.0)?, factors)
    }

    /// What each node of a curve weighs in the reading of a spectrum: `wₖ = ∫ density · Π factors · hatₖ dλ`, lines included, so that
    /// `Σ wₖ s(λₖ)` is the integral against any curve s that is linear between the nodes and zero outside.
    ///
    /// # Errors
    /// If the grid has fewer than two nodes or is not finite, positive and strictly increasing.
    ///
    /// ```
    /// use etendue::spectrum::{Density, kernel::Weights};
    /// let line = Density::line(552.5, 2.0)?;
    /// assert_eq!(Weights::of(&[550.0, 560.0], &line, &[])?.weights(), [1.5, 0.5]);
    /// # Ok::<(), etendue::spectrum::SpectrumError>(())
    /// ```
    pub fn of(grid_nm: &[f64], density: &Density, factors: &[&Factor]) -> Result<Self, SpectrumError> {
        const NODES_OF_GAUSSIANS: usize = 16;
        let (from_nm, to_nm) = Table::new(grid_nm.to_vec(), vec![1.0; grid_nm.len()], Outside::Zero)?.range_nm();
        let inside = Factor::band(from_nm, to_nm, 1.0)?;
        let factors: Vec<&Factor> = factors.iter().copied().chain([&inside]).collect();
        // The hat adds one to the degree of the product; n nodes are exact up to degree 2n − 1.
        let degree = terms(density, &factors).iter().try_fold(1, |most, term| Some(most.max(1 + term.degree()?)));
        let nodes = degree.map_or(NODES_OF_GAUSSIANS, |degree| degree / 2 + 1);
        let mut weights = vec![0.0; grid_nm.len()];
        let lines = density.lines().into_iter().map(|line| {
            let seen = factors.iter().map(|factor| factor.at(line.wavelength_nm)).product::<f64>();
            (line.wavelength_nm, line.power * seen)
        });
        for (nm, weight) in points_and_weights(density, &factors, grid_nm, nodes).into_iter().chain(lines) {
            if weight == 0.0 {
                continue;
            }
            let above = grid_nm.partition_point(|node| *node <= nm).clamp(1, grid_nm.len() - 1);
            let share = (nm - grid_nm[above - 1]) / (grid_nm[above] - grid_nm[above - 1]);
            weights[above - 1] += weight * (1.0 - share);
            weights[above] += weight * share;
        }
        Ok(Self { wavelengths_nm: grid_nm.to_vec(), weights })
    }

    /// The nodes, nm.
    pub fn wavelengths_nm(&self) -> &[f64] {
        &self.wavelengths_nm
    }

    /// The weights, nm times the unit of the factors.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// The integral of a spectrum with these values at the nodes, linear between them and zero outside.
    ///
    /// # Errors
    /// If there are not as many values as nodes.
    pub fn integral(&self, values: &[f64]) -> Result<f64, SpectrumError> {
        if values.len() != self.weights.len() {
            return Err(SpectrumError::LengthsDiffer { wavelengths: self.weights.len(), values: values.len() });
        }
        Ok(dot(&self.weights, values))
    }
}

/// Partial sums that are carried beside each other.
const LANES: usize = 32;

/// `Σ aₖ bₖ` over two slices of the same length.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+avx2+fma", "x86_64+avx2+fma"))]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0_f64; LANES];
    let (a_blocks, b_blocks) = (a.chunks_exact(LANES), b.chunks_exact(LANES));
    let (a_rest, b_rest) = (a_blocks.remainder(), b_blocks.remainder());
    for (x, y) in a_blocks.zip(b_blocks) {
        for lane in 0..LANES {
            sums[lane] += x[lane] * y[lane];
        }
    }
    for (lane, (x, y)) in a_rest.iter().zip(b_rest).enumerate() {
        sums[lane] += x * y;
    }
    let mut width = LANES;
    while width > 1 {
        width /= 2;
        for lane in 0..width {
            sums[lane] += sums[lane + width];
        }
    }
    sums[0]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::library;
    use proptest::prelude::*;

    fn grid(steps: &[f64], from_nm: f64) -> Vec<f64> {
        steps
            .iter()
            .scan(from_nm, |nm, step| {
                *nm += step;
                Some(*nm)
            })
            .collect()
    }

    proptest! {
        #[test]
        fn a_dot_product_is_the_integral_of_the_table(
            rows in prop::collection::vec((0.01..20.0_f64, 0.0..5.0_f64), 2..80), from in 300.0..700.0_f64, which in 0..7_usize,
        ) {
            let grid = grid(&rows.iter().map(|row| row.0).collect::<Vec<_>>(), from);
            let values: Vec<f64> = rows.iter().map(|row| row.1).collect();
            let v = library::v_lambda();
            let held = Factor::Table(Table::from_rows(&[(450.0, 1.0), (500.3, 2.0), (600.0, 0.5)], Outside::Hold).unwrap());
            let band = Factor::band(410.5, 602.25, 2.0).unwrap();
            let bell = Factor::gaussian(1.0, 550.0, 7.0).unwrap();
            let photons = Factor::Proportional(2.0);
            let factors: Vec<&Factor> = match which {
                0 => vec![],
                1 => vec![&v],
                2 => vec![&v, &held],
                3 => vec![&band, &photons],
                4 => vec![&bell],
                5 => vec![&held, &held, &v, &photons],
                _ => vec![&bell, &v],
            };
            let weights = Weights::new(&grid, &factors).unwrap();
            let table = Density::table(Table::new(grid, values.clone(), Outside::Zero).unwrap()).unwrap();
            let (found, expected) = (weights.integral(&values).unwrap(), table.integral(&factors));
            prop_assert!((found - expected).abs() <= 1e-12 * expected.max(1e-3), "{} against {}", found, expected);
        }
    }

    #[test]
    fn what_is_no_grid_or_does_not_fit_is_an_error() {
        assert!(Weights::new(&[400.0], &[]).is_err());
        assert!(Weights::new(&[400.0, 400.0], &[]).is_err());
        let weights = Weights::new(&[400.0, 500.0, 700.0], &[]).unwrap();
        assert_eq!(weights.weights(), [50.0, 150.0, 100.0]);
        assert!(weights.integral(&[1.0]).is_err());
        assert_eq!(weights.integral(&[1.0, 1.0, 1.0]), Ok(300.0));
    }
}
