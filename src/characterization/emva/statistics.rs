//! Means and variances of frames.
//!
//! ```text
//! two frames a, b of the same light     σ_y² = ½ ⟨(a − b)²⟩ − ½ (⟨a⟩ − ⟨b⟩)²       temporal, free of the fixed pattern
//! a stack of L frames                   ⟨y⟩_mn = Σ_l y_l/L;   σ²_stack = ⟨temporal variance of each pixel⟩
//!                                       s² = Var_mn ⟨y⟩ − σ²_stack/L                spatial
//! column means, row means               s²_cav = Var_n ⟨y⟩_n − σ²_stack/(L M),      s²_rav = Var_m ⟨y⟩_m − σ²_stack/(L N)
//! ```
//!
//! Source: EMVA Standard 1288, release 4.0 linear, sections 6 and 8, as the package emva1288 1.0.2 has them; the variances of column and row
//! means are divided by one less than their number, so that they are unbiased.

use crate::metrology::{CompensatedSum, Moments};
use crate::sensor::pixel::spatial::SpatialSplit;

/// What two frames of the same light say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// Mean over both, DN.
    pub mean_dn: f64,
    /// Temporal variance of one pixel, DN².
    pub variance_dn2: f64,
    /// Pixels of a frame.
    pub pixels: u64,
}

impl Pair {
    /// Of two frames of the same size, with at least one pixel.
    #[must_use]
    pub fn of(a: &[u16], b: &[u16]) -> Pair {
        let (mut sum, mut difference, mut square) = (0u64, 0i64, 0u64);
        for (a, b) in a.iter().zip(b) {
            let d = i64::from(*a) - i64::from(*b);
            sum += u64::from(*a) + u64::from(*b);
            difference += d;
            square += d.unsigned_abs().pow(2);
        }
        let pixels = a.len().min(b.len()) as u64;
        let n = pixels as f64;
        let variance_dn2 = 0.5 * (square as f64 / n - (difference as f64 / n).powi(2));
        Pair { mean_dn: sum as f64 / (2.0 * n), variance_dn2, pixels }
    }

    /// Standard uncertainty of the mean from temporal noise, DN.
    #[must_use]
    pub fn u_mean_dn(&self) -> f64 {
        (self.variance_dn2 / (2.0 * self.pixels as f64)).sqrt()
    }

    /// Standard uncertainty of the variance, DN²: noise taken as normal, as many degrees of freedom as pixels less one.
    #[must_use]
    pub fn u_variance_dn2(&self) -> f64 {
        self.variance_dn2 * (2.0 / (self.pixels.max(2) - 1) as f64).sqrt()
    }
}

/// Frames of the same light, added up pixel by pixel: memory for two sums a pixel, however many frames.
#[derive(Clone, Debug)]
pub struct Stack {
    rows: usize,
    columns: usize,
    frames: u64,
    sums: Vec<u32>,
    squares: Vec<u64>,
}

/// What a stack of frames says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spatial {
    /// Mean, DN.
    pub mean_dn: f64,
    /// Temporal variance of one pixel, DN².
    pub temporal_dn2: f64,
    /// Variance of the mean frame over its pixels, with what temporal noise is left in it, DN².
    pub measured_dn2: f64,
    /// Spatial variance without temporal noise, DN²; what is measured can come out below zero.
    pub variance_dn2: f64,
    /// Its split into columns, rows and pixels, DN².
    pub split: SpatialSplit,
    /// Pixels of a frame.
    pub pixels: u64,
    /// Frames.
    pub frames: u64,
}

impl Spatial {
    /// Standard uncertainty of the spatial variance, DN²: pixels taken as normal and independent.
    #[must_use]
    pub fn u_variance_dn2(&self) -> f64 {
        self.measured_dn2 * (2.0 / (self.pixels.max(2) - 1) as f64).sqrt()
    }
}

/// Most frames of a stack: sums of 16 bits a pixel stay within 32.
pub const MOST_FRAMES: u64 = 1 << 16;

impl Stack {
    /// No frames yet, of `rows` × `columns` pixels.
    #[must_use]
    pub fn new(rows: usize, columns: usize) -> Stack {
        Stack { rows, columns, frames: 0, sums: vec![0; rows * columns], squares: vec![0; rows * columns] }
    }

    /// Adds a frame, row by row. Past [`MOST_FRAMES`] none is added.
    pub fn push(&mut self, frame: &[u16]) {
        if self.frames >= MOST_FRAMES {
            return;
        }
        self.frames += 1;
        for ((y, sum), square) in frame.iter().zip(&mut self.sums).zip(&mut self.squares) {
            *sum += u32::from(*y);
            *square += u64::from(*y).pow(2);
        }
    }

    /// What the frames say; `None` of fewer than two frames, or of an image too small to tell columns from rows.
    #[must_use]
    pub fn spatial(&self) -> Option<Spatial> {
        let (l, n) = (self.frames as f64, self.columns as f64);
        let m = self.rows as f64;
        if self.frames < 2 {
            return None;
        }
        let mut temporal = CompensatedSum::new();
        let (mut columns, mut rows) = (vec![0u64; self.columns], vec![0u64; self.rows]);
        let mut pixels = Moments::new();
        for (i, (sum, square)) in self.sums.iter().zip(&self.squares).enumerate() {
            // Exact: L Σy² − (Σy)² in whole numbers.
            let scatter = u128::from(self.frames) * u128::from(*square) - u128::from(*sum).pow(2);
            temporal.add(scatter as f64);
            pixels.push(f64::from(*sum) / l);
            columns[i % self.columns] += u64::from(*sum);
            rows[i / self.columns] += u64::from(*sum);
        }
        let temporal_dn2 = temporal.value() / (m * n * l * (l - 1.0));
        let spread = |sums: &[u64], each: f64| {
            let means: Moments = sums.iter().map(|sum| *sum as f64 / each).collect();
            means.variance()
        };
        let measured_dn2 = pixels.variance()?;
        let variance_dn2 = measured_dn2 - temporal_dn2 / l;
        let column_means = spread(&columns, m * l)? - temporal_dn2 / (l * m);
        let row_means = spread(&rows, n * l)? - temporal_dn2 / (l * n);
        Some(Spatial {
            mean_dn: pixels.mean()?,
            temporal_dn2,
            measured_dn2,
            variance_dn2,
            split: SpatialSplit::of(variance_dn2, column_means, row_means, self.rows as u64, self.columns as u64)?,
            pixels: (self.rows * self.columns) as u64,
            frames: self.frames,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pair_tells_noise_from_pattern_and_drift() {
        // A pattern of any size is in both frames; a drift of the whole frame is no noise.
        let a: Vec<u16> = (0..1000).map(|i| 100 + 7 * (i % 50)).collect();
        let b: Vec<u16> = a.iter().map(|y| y + 10).collect();
        let pair = Pair::of(&a, &b);
        assert!(pair.variance_dn2.abs() < 1e-9 && (pair.mean_dn - 276.5).abs() < 1e-9, "{pair:?}");
        let c: Vec<u16> = a.iter().enumerate().map(|(i, y)| if i % 2 == 0 { y + 3 } else { y - 3 }).collect();
        assert!((Pair::of(&a, &c).variance_dn2 - 4.5).abs() < 1e-12);
    }

    #[test]
    fn a_stack_without_noise_shows_its_columns_and_rows() {
        let (rows, columns) = (40, 30);
        let frame: Vec<u16> = (0..rows * columns).map(|i| (500 + 20 * (i % columns % 2) + 6 * (i / columns % 2)) as u16).collect();
        let mut stack = Stack::new(rows, columns);
        (0..3).for_each(|_| stack.push(&frame));
        let found = stack.spatial().unwrap();
        assert_eq!((found.temporal_dn2, found.frames), (0.0, 3));
        assert!((found.mean_dn - 513.0).abs() < 1e-9, "{found:?}");
        // ±10 and ±3, with n/(n − 1) of a sample of columns, rows or pixels.
        assert!((found.variance_dn2 / (109.0 * 1200.0 / 1199.0) - 1.0).abs() < 1e-12);
        assert!((found.split.column / 100.0 - 1.0).abs() < 0.04 && (found.split.row / 9.0 - 1.0).abs() < 0.04, "{found:?}");
        assert!(found.split.pixel.abs() < 4.0, "{found:?}");
        assert_eq!(Stack::new(4, 4).spatial(), None);
    }
}
