//! The split of a spatial variance into columns, rows and pixels.
//!
//! ```text
//! s²     = s²_col + s²_row + s²_pixel
//! s²_cav = s²_col + s²_pixel/M          variance of the means of columns, over M rows
//! s²_rav = s²_row + s²_pixel/N          variance of the means of rows, over N columns
//! ```
//!
//! Solved for the three on the left. All variances in DN²; what is measured carries noise, so a part can come out below zero.
//!
//! Source: EMVA Standard 1288, release 4.0, 4.3 (as the package emva1288 1.0.2 computes it).

/// Parts of a spatial variance, DN².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpatialSplit {
    /// Between columns.
    pub column: f64,
    /// Between rows.
    pub row: f64,
    /// Between pixels.
    pub pixel: f64,
}

impl SpatialSplit {
    /// The split of the variance `whole` of an image, with the variances `column_means` and `row_means` of its column and row means, all
    /// without temporal noise. `None` for an image of fewer than two rows or columns, where it has no solution.
    #[must_use]
    pub fn of(whole: f64, column_means: f64, row_means: f64, rows: u64, columns: u64) -> Option<SpatialSplit> {
        if rows < 2 || columns < 2 || (rows, columns) == (2, 2) {
            return None;
        }
        let (m, n) = (rows as f64, columns as f64);
        let pixel = (whole - column_means - row_means) * (m * n) / (m * n - m - n);
        Some(SpatialSplit { column: column_means - pixel / m, row: row_means - pixel / n, pixel })
    }

    /// The whole variance.
    #[must_use]
    pub fn sum(&self) -> f64 {
        self.column + self.row + self.pixel
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn what_is_put_together_comes_apart(
            parts in prop::array::uniform3(0.0..10.0f64), rows in 2u64..500, columns in 3u64..500
        ) {
            let [column, row, pixel] = parts;
            let (m, n) = (rows as f64, columns as f64);
            let found = SpatialSplit::of(column + row + pixel, column + pixel / m, row + pixel / n, rows, columns).unwrap();
            for (a, b) in [(found.column, column), (found.row, row), (found.pixel, pixel)] {
                prop_assert!((a - b).abs() < 1e-11, "{found:?} {parts:?}");
            }
        }
    }

    #[test]
    fn an_image_too_small_to_tell_rows_from_pixels_has_no_split() {
        assert_eq!(SpatialSplit::of(1.0, 0.5, 0.5, 1, 100), None);
        assert_eq!(SpatialSplit::of(1.0, 0.5, 0.5, 2, 2), None);
    }
}
