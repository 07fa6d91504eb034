//! Adaptive Gauss–Kronrod quadrature on given panels.
//!
//! ```text
//! ∫ f ≈ Σ wₖ f(xₖ)   (21 points, exact to degree 31);   error from the embedded 10-point Gauss rule
//! ```
//!
//! The panel with the largest error is halved until the sum of errors is below the relative tolerance, or rounding stops the
//! progress. Nodes, weights and the error heuristic: Piessens et al., QUADPACK (1983), public domain.

use std::ops::Range;

/// Value of an integral and an estimate of its absolute error.
#[derive(Clone, Copy, Debug)]
pub(super) struct Integral {
    pub(super) value: f64,
    pub(super) error: f64,
}

const KRONROD_NODES: [f64; 11] = [
    0.995_657_163_025_808_1,
    0.973_906_528_517_171_7,
    0.930_157_491_355_708_2,
    0.865_063_366_688_984_5,
    0.780_817_726_586_416_9,
    0.679_409_568_299_024_4,
    0.562_757_134_668_604_7,
    0.433_395_394_129_247_2,
    0.294_392_862_701_460_2,
    0.148_874_338_981_631_22,
    0.0,
];
const KRONROD_WEIGHTS: [f64; 11] = [
    0.011_694_638_867_371_874,
    0.032_558_162_307_964_725,
    0.054_755_896_574_351_995,
    0.075_039_674_810_919_96,
    0.093_125_454_583_697_6,
    0.109_387_158_802_297_64,
    0.123_491_976_262_065_84,
    0.134_709_217_311_473_34,
    0.142_775_938_577_060_09,
    0.147_739_104_901_338_49,
    0.149_445_554_002_916_9,
];
const GAUSS_WEIGHTS: [f64; 5] =
    [0.066_671_344_308_688_14, 0.149_451_349_150_580_6, 0.219_086_362_515_982_04, 0.269_266_719_309_996_35, 0.295_524_224_714_752_87];

/// Most panels an integral may be divided into.
const MAX_PANELS: usize = 1500;

struct Panel {
    piece: usize,
    range: Range<f64>,
    value: f64,
    error: f64,
}

fn gauss_kronrod(f: &dyn Fn(usize, f64) -> f64, piece: usize, range: Range<f64>) -> Panel {
    let half = 0.5 * (range.end - range.start);
    let centre = 0.5 * (range.end + range.start);
    let mut values = [0.0; 21];
    let mut kronrod = 0.0;
    let mut gauss = 0.0;
    let mut magnitude = 0.0;
    for (k, (&node, &weight)) in KRONROD_NODES.iter().zip(&KRONROD_WEIGHTS).enumerate() {
        let below = f(piece, centre - half * node);
        let above = if k < 10 { f(piece, centre + half * node) } else { 0.0 };
        values[2 * k] = below;
        if k < 10 {
            values[2 * k + 1] = above;
        }
        kronrod += weight * (below + above);
        magnitude += weight * (below.abs() + above.abs());
        if k % 2 == 1 {
            gauss += GAUSS_WEIGHTS[k / 2] * (below + above);
        }
    }
    let mean = 0.5 * kronrod;
    let spread: f64 = values.iter().enumerate().map(|(i, v)| KRONROD_WEIGHTS[i / 2] * (v - mean).abs()).sum();
    let mut error = (kronrod - gauss).abs();
    if spread > 0.0 && error > 0.0 {
        error = spread * (200.0 * error / spread).powf(1.5).min(1.0);
    }
    error = error.max(4.0 * f64::EPSILON * magnitude);
    Panel { piece, range, value: kronrod * half, error: error * half.abs() }
}

/// Integral of `f(piece, u)` over u from 0 to 1, summed over `pieces` pieces.
fn integrate_pieces(pieces: usize, f: &dyn Fn(usize, f64) -> f64, rel_tol: f64, abs_tol: f64) -> Integral {
    let mut panels: Vec<Panel> = (0..pieces).map(|piece| gauss_kronrod(f, piece, 0.0..1.0)).collect();
    loop {
        let value: f64 = panels.iter().map(|panel| panel.value).sum();
        let error: f64 = panels.iter().map(|panel| panel.error).sum();
        let worst = panels.iter().enumerate().max_by(|a, b| a.1.error.total_cmp(&b.1.error)).map(|(index, _)| index);
        let Some(worst) = worst else {
            return Integral { value: 0.0, error: 0.0 };
        };
        if error <= abs_tol.max(rel_tol * value.abs()) || panels.len() >= MAX_PANELS {
            return Integral { value, error };
        }
        let Range { start, end } = panels[worst].range.clone();
        let middle = 0.5 * (start + end);
        if end - start < 1e-14 {
            return Integral { value, error };
        }
        let piece = panels[worst].piece;
        panels[worst] = gauss_kronrod(f, piece, start..middle);
        panels.push(gauss_kronrod(f, piece, middle..end));
    }
}

/// Integral of `f` from the first to the last break, which are in ascending order. Between breaks `f` may start and end like a
/// square root: the substitution u²(3 − 2u) makes that smooth.
pub(super) fn integrate_between(breaks: &[f64], f: &dyn Fn(f64) -> f64, rel_tol: f64) -> Integral {
    integrate_to(breaks, f, rel_tol, 0.0)
}

/// The same, ended as well at an absolute tolerance: the rounding noise of an integrand with cancellation.
pub(super) fn integrate_to(breaks: &[f64], f: &dyn Fn(f64) -> f64, rel_tol: f64, abs_tol: f64) -> Integral {
    let mapped = |piece: usize, u: f64| {
        let width = breaks[piece + 1] - breaks[piece];
        // From the nearer end, so that a distance to the end keeps its relative precision.
        let x = if u < 0.5 {
            breaks[piece] + width * u * u * (3.0 - 2.0 * u)
        } else {
            let v = 1.0 - u;
            breaks[piece + 1] - width * v * v * (3.0 - 2.0 * v)
        };
        f(x) * width * 6.0 * u * (1.0 - u)
    };
    integrate_pieces(breaks.len().saturating_sub(1), &mapped, rel_tol, abs_tol)
}
