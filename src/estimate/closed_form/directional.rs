//! A uniform source weighted by a directional response that is symmetric about the receiver's normal.
//!
//! ```text
//! ∫ R(θ) dG(θ) = R(θ_max) G(θ_max) − ∫ G(θ) R′(θ) dθ
//! ```
//!
//! G(θ) is the projected solid angle of the source within a cone of half angle θ about the normal: `polygon_in_cone`, `disc_in_cone`, `sphere_in_cone`,
//! or a sum of them. Integration by parts needs no derivative of G, which has kinks where the cone touches the source.
//!
//! | parameter | meaning | unit, range |
//! |---|---|---|
//! | `cumulative` | G(θ), from 0 at θ = 0, not decreasing | sr, θ in rad |
//! | `response` | R(θ), relative to the normal direction | 1 |
//! | `breaks_rad` | angles at which R or G change their law, ascending | rad |
//! | `rel_tol` | relative tolerance asked for | 1 |

use super::aperture::Bounded;
use super::quadrature::integrate_between;

/// Degree of the interpolation by which a smooth response is differentiated.
const DEGREE: usize = 12;

/// Most panels for a response given as a function.
const MAX_PANELS: usize = 400;

/// `∫ R dG` for a response that is linear between its nodes (rad, value; ascending) and 0 beyond the last one; before the first one it has the first value.
/// Two nodes at one angle are a step. `breaks_rad` are angles where the source begins or ends; any number of them, or none, may be given.
pub fn weighted_by_table(cumulative: &dyn Fn(f64) -> f64, response: &[(f64, f64)], breaks_rad: &[f64], rel_tol: f64) -> Bounded {
    let Some(&(last_angle, last_value)) = response.last() else {
        return Bounded { value: 0.0, error: 0.0 };
    };
    let edge = cumulative(last_angle);
    let mut value = last_value * edge;
    let mut error = f64::EPSILON * value.abs();
    for pair in response.windows(2) {
        let ((start, before), (end, after)) = (pair[0], pair[1]);
        let step = after - before;
        if step == 0.0 {
            continue;
        }
        if end <= start {
            value -= step * cumulative(start);
            continue;
        }
        let mut stops = vec![start];
        stops.extend(breaks_rad.iter().copied().filter(|b| *b > start && *b < end));
        stops.push(end);
        let mean = integrate_between(&stops, cumulative, rel_tol);
        let slope = step / (end - start);
        value -= slope * mean.value;
        error += slope.abs() * mean.error;
    }
    Bounded { value, error }
}

/// `∫ R dG` from 0 to the last break for a response given as a function, smooth between the breaks. The first break is the
/// angle below which G is 0 (0 is always right). Needs at least two breaks.
pub fn weighted_by_function(cumulative: &dyn Fn(f64) -> f64, response: &dyn Fn(f64) -> f64, breaks_rad: &[f64], rel_tol: f64) -> Bounded {
    let rule = ChebyshevRule::new();
    let panel = |start: f64, end: f64| Panel { start, end, value: rule.stieltjes(cumulative, response, start, end), error: 0.0 };
    let halves = |whole: &Panel| {
        let middle = 0.5 * (whole.start + whole.end);
        let mut parts = [panel(whole.start, middle), panel(middle, whole.end)];
        let error = 0.5 * (parts[0].value + parts[1].value - whole.value).abs();
        parts.iter_mut().for_each(|part| part.error = error);
        parts
    };
    let mut panels: Vec<Panel> =
        breaks_rad.windows(2).filter(|pair| pair[1] > pair[0]).flat_map(|pair| halves(&panel(pair[0], pair[1]))).collect();
    loop {
        let value: f64 = panels.iter().map(|p| p.value).sum();
        let error: f64 = panels.iter().map(|p| p.error).sum();
        let worst = panels.iter().enumerate().max_by(|a, b| a.1.error.total_cmp(&b.1.error)).map(|(index, _)| index);
        let Some(worst) = worst else {
            return Bounded { value: 0.0, error: 0.0 };
        };
        // What the rule loses to rounding: R and G of a panel against its share.
        let error = error + 8.0 * f64::EPSILON * value.abs();
        if error <= rel_tol * value.abs() || panels.len() >= MAX_PANELS {
            return Bounded { value, error };
        }
        let split = panels.swap_remove(worst);
        panels.extend(halves(&split));
    }
}

struct Panel {
    start: f64,
    end: f64,
    value: f64,
    error: f64,
}

/// Chebyshev–Lobatto points, weights of Clenshaw and Curtis, and the matrix of differentiation (Trefethen, Spectral Methods in MATLAB, 2000).
struct ChebyshevRule {
    nodes: [f64; DEGREE + 1],
    weights: [f64; DEGREE + 1],
    derivative: [[f64; DEGREE + 1]; DEGREE + 1],
}

impl ChebyshevRule {
    fn new() -> ChebyshevRule {
        let angle = |k: usize| k as f64 * std::f64::consts::PI / DEGREE as f64;
        let nodes: [f64; DEGREE + 1] = std::array::from_fn(|k| -angle(k).cos());
        let weights = std::array::from_fn(|k| {
            let sum: f64 = (1..=DEGREE / 2)
                .map(|j| {
                    let share = if 2 * j == DEGREE { 1.0 } else { 2.0 };
                    share / (4 * j * j - 1) as f64 * (2.0 * j as f64 * angle(k)).cos()
                })
                .sum();
            (if k == 0 || k == DEGREE { 1.0 } else { 2.0 }) / DEGREE as f64 * (1.0 - sum)
        });
        let end = |k: usize| (if k == 0 || k == DEGREE { 2.0 } else { 1.0 }) * (if k.is_multiple_of(2) { 1.0 } else { -1.0 });
        let mut derivative = [[0.0; DEGREE + 1]; DEGREE + 1];
        for (i, row) in derivative.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate().filter(|(j, _)| *j != i) {
                *entry = end(i) / end(j) / (nodes[i] - nodes[j]);
            }
            // A constant has no derivative.
            row[i] = -row.iter().sum::<f64>();
        }
        ChebyshevRule { nodes, weights, derivative }
    }

    /// `∫ R dG` over one panel. Both are taken relative to their values at the start, which keeps narrow sources precise.
    fn stieltjes(&self, g: &dyn Fn(f64) -> f64, r: &dyn Fn(f64) -> f64, start: f64, end: f64) -> f64 {
        let at = |x: f64| {
            if x <= -1.0 {
                start
            } else if x >= 1.0 {
                end
            } else {
                0.5 * (start + end) + 0.5 * (end - start) * x
            }
        };
        let first = g(start);
        let rs = self.nodes.map(|x| r(at(x)));
        let gs = self.nodes.map(|x| g(at(x)) - first);
        let by_parts: f64 =
            (0..=DEGREE).map(|i| self.weights[i] * gs[i] * (0..=DEGREE).map(|j| self.derivative[i][j] * rs[j]).sum::<f64>()).sum();
        rs[DEGREE] * gs[DEGREE] - by_parts
    }
}
