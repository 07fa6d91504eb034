//! Exact integrals of products of tables, walking once along their breakpoints:
//! `∫ Π fⱼ(λ) dλ = Σ over the pieces between neighbouring breakpoints`, where every fⱼ is a straight line.
//!
//! | tables | integral over a piece of width h with end values a, b, … and a′, b′, … |
//! |---|---|
//! | 1 | `h (a + a′)/2` |
//! | 2 | `h (2 a b + a b′ + a′ b + 2 a′ b′)/6` |
//! | more | Gauss–Legendre nodes that are exact for the degree |

use super::gauss_legendre;
use super::product_integral::CompensatedSum;
use super::{Outside, Table};

/// Most tables that are multiplied here.
pub(super) const MOST_TABLES: usize = 8;

/// A table and the segment in which the walk is.
#[derive(Clone, Copy)]
struct Cursor<'a> {
    wavelengths_nm: &'a [f64],
    values: &'a [f64],
    /// Index of the first breakpoint above the place of the walk; may be one past the last.
    next: usize,
}

impl<'a> Cursor<'a> {
    fn new(table: &'a Table, from_nm: f64) -> Self {
        let wavelengths_nm = table.wavelengths_nm();
        Self { wavelengths_nm, values: table.values(), next: wavelengths_nm.partition_point(|nm| *nm <= from_nm) }
    }

    /// The next breakpoint, or infinity.
    fn next_nm(&self) -> f64 {
        self.wavelengths_nm.get(self.next).copied().unwrap_or(f64::INFINITY)
    }

    /// The values at two places of the closed segment; a table that is walked beyond its ends holds its end values there.
    fn values(&self, from_nm: f64, to_nm: f64) -> (f64, f64) {
        if self.next == 0 || self.next == self.values.len() {
            let held = self.values[self.next.saturating_sub(1)];
            return (held, held);
        }
        let (low_nm, high_nm) = (self.wavelengths_nm[self.next - 1], self.wavelengths_nm[self.next]);
        let (low, high) = (self.values[self.next - 1], self.values[self.next]);
        let slope = (high - low) / (high_nm - low_nm);
        let from = if from_nm == low_nm { low } else { low + slope * (from_nm - low_nm) };
        let to = if to_nm == high_nm { high } else { low + slope * (to_nm - low_nm) };
        (from, to)
    }
}

/// The integral of the product of one to [`MOST_TABLES`] tables, at least one of which is zero outside; `None` otherwise.
pub(super) fn integral(tables: &[&Table]) -> Option<f64> {
    let bounded = tables.iter().filter(|table| table.outside() == Outside::Zero).map(|table| table.range_nm());
    let (from_nm, to_nm) = bounded.reduce(|a, b| (a.0.max(b.0), a.1.min(b.1)))?;
    if tables.len() > MOST_TABLES {
        return None;
    }
    let mut sum = CompensatedSum::default();
    let mut cursors = [Cursor::new(tables[0], from_nm); MOST_TABLES];
    for (cursor, table) in cursors.iter_mut().zip(tables) {
        *cursor = Cursor::new(table, from_nm);
    }
    let cursors = &mut cursors[..tables.len()];
    let mut at_nm = from_nm;
    while at_nm < to_nm {
        let next_nm = cursors.iter().map(Cursor::next_nm).fold(to_nm, f64::min);
        let width = next_nm - at_nm;
        sum.add(match &*cursors {
            [f] => {
                let (a, b) = f.values(at_nm, next_nm);
                width * (0.5 * a + 0.5 * b)
            }
            [f, g] => {
                let ((a, b), (c, d)) = (f.values(at_nm, next_nm), g.values(at_nm, next_nm));
                width * ((2.0 * a + b) * c + (a + 2.0 * b) * d) / 6.0
            }
            many => {
                let mut ends = [(0.0, 0.0); MOST_TABLES];
                for (end, cursor) in ends.iter_mut().zip(many.iter()) {
                    *end = cursor.values(at_nm, next_nm);
                }
                let ends = &ends[..many.len()];
                let nodes = gauss_legendre::rule(ends.len() / 2 + 1).iter();
                let product = |x: f64| ends.iter().map(|(a, b)| 0.5 * (a * (1.0 - x) + b * (1.0 + x))).product::<f64>();
                0.5 * width * nodes.map(|(x, weight)| weight * product(*x)).sum::<f64>()
            }
        });
        for cursor in cursors.iter_mut().filter(|cursor| cursor.next_nm() <= next_nm) {
            cursor.next += 1;
        }
        at_nm = next_nm;
    }
    Some(sum.value())
}
