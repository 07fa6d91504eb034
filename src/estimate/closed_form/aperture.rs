//! Mean of a smooth function over a flat aperture.
//!
//! ```text
//! ⟨E⟩ = (1/A) ∫ E(x) dA,   etendue = A ⟨G⟩
//! ```
//!
//! Tensor Gauss rule of 8 × 8 points on cells that are quartered where they disagree with their quarters. A disc is
//! taken in polar coordinates, dA = r dr dφ, so that its rim is a straight edge of the cells.
//!
//! | parameter | meaning | unit |
//! |---|---|---|
//! | `integrand` | function of a position on the aperture | any |
//! | `rel_tol` | relative tolerance asked for | 1 |

use crate::math::DVec3;
use std::f64::consts::PI;

/// A flat aperture over which to average.
#[derive(Clone, Copy, Debug)]
pub enum Aperture {
    /// Parallelogram by its corner and two edges, m.
    Parallelogram {
        /// One corner, m.
        corner: DVec3,
        /// Edge from the corner, m.
        edge_u: DVec3,
        /// The other edge from the corner, m.
        edge_v: DVec3,
    },
    /// Triangle by its corners, m.
    Triangle([DVec3; 3]),
    /// Disc by its centre and two perpendicular radii of equal length, m.
    Disc {
        /// Centre, m.
        centre: DVec3,
        /// A radius, m.
        radius_u: DVec3,
        /// The radius perpendicular to it, m.
        radius_v: DVec3,
    },
}

/// A value with an estimate of its absolute error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounded {
    /// The value.
    pub value: f64,
    /// Estimated absolute error; in trials the true error was smaller.
    pub error: f64,
}

impl Aperture {
    /// Point and area density, relative to the mean, at coordinates in the unit square.
    fn at(&self, s: f64, t: f64) -> (DVec3, f64) {
        match *self {
            Aperture::Parallelogram { corner, edge_u, edge_v } => (corner + edge_u * s + edge_v * t, 1.0),
            // Collapsed square: s is the distance from the first corner.
            Aperture::Triangle([a, b, c]) => (a + ((b - a) * (1.0 - t) + (c - a) * t) * s, 2.0 * s),
            Aperture::Disc { centre, radius_u, radius_v } => {
                let (sin, cos) = (2.0 * PI * t).sin_cos();
                (centre + (radius_u * cos + radius_v * sin) * s, 2.0 * s)
            }
        }
    }
}

const NODES: [f64; 4] = [0.183_434_642_495_649_8, 0.525_532_409_916_329, 0.796_666_477_413_626_7, 0.960_289_856_497_536_2];
const WEIGHTS: [f64; 4] = [0.362_683_783_378_362, 0.313_706_645_877_887_3, 0.222_381_034_453_374_48, 0.101_228_536_290_376_26];

/// Most cells; each costs 64 evaluations.
const MAX_CELLS: usize = 4000;

#[derive(Clone, Copy)]
struct Cell {
    s: f64,
    t: f64,
    width_s: f64,
    width_t: f64,
    value: f64,
    error: f64,
}

/// Mean of `integrand` over an aperture; `None` if the relative tolerance is not met within some 10⁵ evaluations, or a value is not finite.
pub fn aperture_average(aperture: Aperture, integrand: &dyn Fn(DVec3) -> f64, rel_tol: f64) -> Option<Bounded> {
    let gauss = |mut cell: Cell| {
        cell.value = 0.0;
        let (half_s, half_t) = (0.5 * cell.width_s, 0.5 * cell.width_t);
        for (node_s, weight_s) in NODES.iter().zip(WEIGHTS).flat_map(|(x, w)| [(*x, w), (-x, w)]) {
            for (node_t, weight_t) in NODES.iter().zip(WEIGHTS).flat_map(|(x, w)| [(*x, w), (-x, w)]) {
                let (position, density) = aperture.at(cell.s + half_s * (1.0 + node_s), cell.t + half_t * (1.0 + node_t));
                cell.value += weight_s * weight_t * density * integrand(position);
            }
        }
        cell.value *= half_s * half_t;
        cell
    };
    let quarters = |cell: &Cell| {
        let (width_s, width_t) = (0.5 * cell.width_s, 0.5 * cell.width_t);
        let mut parts = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)]
            .map(|(i, j)| gauss(Cell { s: cell.s + i * width_s, t: cell.t + j * width_t, width_s, width_t, value: 0.0, error: 0.0 }));
        let sum: f64 = parts.iter().map(|part| part.value).sum();
        // The difference is the error of the coarse cell; that of its quarters is smaller, and this bound is kept.
        let error = (sum - cell.value).abs();
        parts.iter_mut().for_each(|part| part.error = 0.25 * error);
        parts
    };
    let whole = gauss(Cell { s: 0.0, t: 0.0, width_s: 1.0, width_t: 1.0, value: 0.0, error: 0.0 });
    let mut cells = quarters(&whole).to_vec();
    loop {
        let value: f64 = cells.iter().map(|cell| cell.value).sum();
        let error: f64 = cells.iter().map(|cell| cell.error).sum();
        if !value.is_finite() || !error.is_finite() {
            return None;
        }
        if error <= rel_tol * value.abs() {
            return Some(Bounded { value, error: error.max(8.0 * f64::EPSILON * value.abs()) });
        }
        if cells.len() >= MAX_CELLS {
            return None;
        }
        let worst = cells.iter().enumerate().max_by(|a, b| a.1.error.total_cmp(&b.1.error)).map(|(index, _)| index)?;
        let cell = cells.swap_remove(worst);
        cells.extend(quarters(&cell));
    }
}
