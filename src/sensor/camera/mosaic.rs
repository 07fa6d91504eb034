//! Which colour filter lies over which pixel: a tile that repeats from the upper left corner of the image.
//!
//! | scene file | tile |
//! |---|---|
//! | `None` | no filters: every channel at every pixel |
//! | `Bayer("RGGB")` | 2 × 2, row by row |
//! | `Pattern([["R", "G"], ["G", "B"]])` | any size, row by row |

/// A tile of colour filters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mosaic {
    columns: usize,
    cells: Vec<usize>,
}

impl Mosaic {
    /// A tile from its rows of indices into the channels of the camera. `None` unless all rows are equally long and not empty.
    #[must_use]
    pub fn new(rows: &[Vec<usize>]) -> Option<Mosaic> {
        let columns = rows.first().map(Vec::len).filter(|&n| n > 0)?;
        rows.iter().all(|row| row.len() == columns).then(|| Mosaic { columns, cells: rows.concat() })
    }

    /// Columns of the tile.
    #[must_use]
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Rows of the tile.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.cells.len() / self.columns
    }

    /// The channel of a pixel.
    #[inline]
    #[must_use]
    pub fn at(&self, column: usize, row: usize) -> usize {
        self.cells[(row % self.rows()) * self.columns + column % self.columns]
    }

    /// Whether some cell has this channel.
    #[must_use]
    pub fn has(&self, channel: usize) -> bool {
        self.cells.contains(&channel)
    }
}

#[cfg(test)]
mod tests {
    use super::Mosaic;

    #[test]
    fn a_tile_repeats_and_a_ragged_one_is_none() {
        let bayer = Mosaic::new(&[vec![0, 1], vec![1, 2]]).unwrap();
        assert_eq!([(0, 0), (1, 0), (0, 1), (1, 1), (4, 6), (5, 7)].map(|(x, y)| bayer.at(x, y)), [0, 1, 1, 2, 0, 2]);
        assert_eq!(Mosaic::new(&[vec![0, 1], vec![1]]), None);
        assert_eq!(Mosaic::new(&[]), None);
        assert_eq!(Mosaic::new(&[vec![]]), None);
    }
}
