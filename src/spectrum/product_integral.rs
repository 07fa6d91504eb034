//! Exact integrals of products: `∫ φ(λ) Π fᵢ(λ) dλ + Σ Φₖ Π fᵢ(λₖ)`.
//!
//! 1. The density is written as a sum of terms `scale · kernel · factors`; every constant goes into the scale.
//! 2. A term lives on the intersection of the supports, cut at the union of all breakpoints.
//! 3. Where the integrand is a polynomial of degree d between breakpoints, `⌊d/2⌋ + 1` Gauss–Legendre nodes are exact.
//!    Products of tables alone are summed by their closed form in one walk along the breakpoints.
//! 4. Where a black body or a Gaussian is in it, segments are halved until two estimates agree.

use super::scaled_number::ScaledNumber;
use super::term::{Segment, Term, terms};
use super::{Density, Factor, gauss_legendre, table_product};

/// See the head of this file.
pub(super) fn integral(density: &Density, factors: &[&Factor]) -> f64 {
    let (scale, _, lines) = density.parts();
    let line_sum = lines.iter().map(|line| {
        let product = ScaledNumber::new(scale).times(line.power);
        factors.iter().fold(product, |product, factor| product.times(factor.at(line.wavelength_nm))).value()
    });
    let terms = terms(density, factors);
    let continuum_sum = terms.iter().map(|term| term.scale.times(term.integral()).value());
    compensated_sum(line_sum.chain(continuum_sum))
}

/// The continuum times `factors` as points and weights: `Σ wⱼ P(λⱼ) = ∫ φ Π fᵢ P dλ` for every P that is smooth between the
/// breakpoints and `cuts_nm`, by `nodes` Gauss–Legendre nodes on each segment. Lines are not in it.
pub(super) fn points_and_weights(density: &Density, factors: &[&Factor], cuts_nm: &[f64], nodes: usize) -> Vec<(f64, f64)> {
    let mut points = Vec::new();
    for term in terms(density, factors) {
        for segment in term.segments(cuts_nm) {
            let (middle, half) = (0.5 * (segment.from + segment.to), 0.5 * (segment.to - segment.from));
            for &(x, weight) in gauss_legendre::rule(nodes) {
                let y = middle + half * x;
                let value = term.scale.times(weight * half * term.integrand(segment.coordinate, y)).value();
                points.push((segment.coordinate.wavelength_nm(y), value));
            }
        }
    }
    points
}

/// Neumaier's sum: what rounding drops is kept beside.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct CompensatedSum {
    sum: f64,
    lost: f64,
}

impl CompensatedSum {
    /// Adds a number.
    pub(super) fn add(&mut self, value: f64) {
        let next = self.sum + value;
        if next.is_finite() {
            self.lost += if self.sum.abs() >= value.abs() { (self.sum - next) + value } else { (value - next) + self.sum };
        }
        self.sum = next;
    }

    /// The sum.
    pub(super) fn value(self) -> f64 {
        // Beside a sum that has left the range of f64 nothing counts.
        if self.sum.is_finite() { self.sum + self.lost } else { self.sum }
    }
}

fn compensated_sum(values: impl Iterator<Item = f64>) -> f64 {
    let mut sum = CompensatedSum::default();
    values.for_each(|value| sum.add(value));
    sum.value()
}

impl Term<'_> {
    /// The integral without the scale.
    fn integral(&self) -> f64 {
        if let Some(product) = self.tables().and_then(|tables| table_product::integral(&tables)) {
            return product;
        }
        let segments = self.segments(&[]);
        match self.degree() {
            Some(degree) if degree / 2 < gauss_legendre::MAX_NODES => {
                compensated_sum(segments.iter().map(|segment| self.estimate(segment, degree / 2 + 1).0))
            }
            _ => self.adaptive(segments),
        }
    }

    /// Estimate of the integral over a segment, and of the integral of its absolute value.
    fn estimate(&self, segment: &Segment, nodes: usize) -> (f64, f64) {
        let (middle, half) = (0.5 * (segment.from + segment.to), 0.5 * (segment.to - segment.from));
        gauss_legendre::rule(nodes).iter().fold((0.0, 0.0), |(sum, size), (x, weight)| {
            let value = weight * half * self.integrand(segment.coordinate, middle + half * x);
            (sum + value, size + value.abs())
        })
    }

    /// Halves segments until two estimates agree.
    fn adaptive(&self, segments: Vec<Segment>) -> f64 {
        const NODES: usize = 8;
        const MAX_HALVINGS: usize = 60;
        // Two halves with 8 nodes each err 2^-16 of what the whole errs, so agreement to 1e-11 leaves about 1e-15.
        const AGREEMENT: f64 = 1e-11;
        // What is this small beside the whole cannot be seen in it.
        const INVISIBLE: f64 = 1e-17;
        let first: Vec<(f64, f64)> = segments.iter().map(|segment| self.estimate(segment, NODES)).collect();
        let size: f64 = first.iter().map(|estimate| estimate.1).sum();
        let mut open: Vec<(Segment, f64, usize)> = segments.into_iter().zip(first).map(|(segment, whole)| (segment, whole.0, 0)).collect();
        let mut closed = Vec::with_capacity(open.len());
        while let Some((segment, whole, halvings)) = open.pop() {
            let middle = 0.5 * (segment.from + segment.to);
            let halves = [Segment { to: middle, ..segment }, Segment { from: middle, ..segment }];
            let estimates = halves.map(|half| self.estimate(&half, NODES));
            let sum = estimates[0].0 + estimates[1].0;
            let visible = ((AGREEMENT + self.noise(&segment)) * (estimates[0].1 + estimates[1].1)).max(INVISIBLE * size);
            if (sum - whole).abs() <= visible || halvings == MAX_HALVINGS || !sum.is_finite() {
                closed.push(sum);
            } else {
                open.extend((0..2).map(|i| (halves[i], estimates[i].0, halvings + 1)));
            }
        }
        compensated_sum(closed.into_iter())
    }
}
