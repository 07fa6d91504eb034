//! Straight lines through measured points, with the uncertainty that the points bring.
//!
//! ```text
//! y = a x         a = Σ x y / Σ x²,                u(a) = √Σ x² u² / Σ x²
//! y = a x + b     weights 1, or 1/y² for relative deviations
//! ```
//!
//! The fits are those that EMVA 1288 asks for; the uncertainties follow from those of the single points (GUM 5.1.2) and not from the
//! scatter about the line.

/// A number with its standard uncertainty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Uncertain {
    pub(super) value: f64,
    pub(super) u: f64,
}

/// A measured point; u is that of y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Point {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) u: f64,
}

/// Slope of the line through the origin; `None` without a point off the axis.
pub(super) fn through_origin(points: &[Point]) -> Option<Uncertain> {
    let (mut xy, mut xx, mut xu) = (0.0, 0.0, 0.0);
    for p in points {
        (xy, xx, xu) = (xy + p.x * p.y, xx + p.x * p.x, xu + (p.x * p.u).powi(2));
    }
    (xx > 0.0).then(|| Uncertain { value: xy / xx, u: xu.sqrt() / xx })
}

/// Slope and intercept of a line, every point with a weight; `None` of fewer than two places.
pub(super) fn line(points: &[Point], weight: impl Fn(&Point) -> f64) -> Option<(Uncertain, Uncertain)> {
    let whole: f64 = points.iter().map(&weight).sum();
    let mean = |of: &dyn Fn(&Point) -> f64| points.iter().map(|p| weight(p) * of(p)).sum::<f64>() / whole;
    let (x, y) = (mean(&|p| p.x), mean(&|p| p.y));
    let xx = mean(&|p| (p.x - x).powi(2));
    if points.len() < 2 || xx.is_nan() || xx <= 0.0 {
        return None;
    }
    let slope = mean(&|p| (p.x - x) * (p.y - y)) / xx;
    // Both are sums of the y with these coefficients.
    let of_slope = |p: &Point| weight(p) / whole * (p.x - x) / xx;
    let u = |of: &dyn Fn(&Point) -> f64| points.iter().map(|p| (of(p) * p.u).powi(2)).sum::<f64>().sqrt();
    let u_intercept = u(&|p| weight(p) / whole - x * of_slope(p));
    Some((Uncertain { value: slope, u: u(&of_slope) }, Uncertain { value: y - slope * x, u: u_intercept }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn points_on_a_line_give_it(a in -5.0..5.0f64, b in -5.0..5.0f64, places in prop::collection::vec(0.1..10.0f64, 3..20)) {
            let points: Vec<Point> = places.iter().enumerate().map(|(i, x)| (x + i as f64, 0.1)).map(|(x, u)| Point { x, y: a * x + b, u }).collect();
            let (slope, intercept) = line(&points, |p| 1.0 / p.x).unwrap();
            prop_assert!((slope.value - a).abs() < 1e-9 && (intercept.value - b).abs() < 1e-9);
            let origin: Vec<Point> = points.iter().map(|p| Point { y: a * p.x, ..*p }).collect();
            prop_assert!((through_origin(&origin).unwrap().value - a).abs() < 1e-12);
        }
    }

    #[test]
    fn uncertainties_are_those_of_the_textbook() {
        let points = [-1.0, 0.0, 1.0].map(|x| Point { x, y: 2.0 * x, u: 0.3 });
        let (slope, intercept) = line(&points, |_| 1.0).unwrap();
        assert!((slope.u - 0.3 / 2f64.sqrt()).abs() < 1e-15 && (intercept.u - 0.3 / 3f64.sqrt()).abs() < 1e-15);
        assert!((through_origin(&points).unwrap().u - 0.3 / 2f64.sqrt()).abs() < 1e-15);
        assert_eq!(line(&points[..1], |_| 1.0), None);
    }
}
