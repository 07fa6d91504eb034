//! Greedy placement of spectral nodes: the interval that errs most is split where that helps most.
//!
//! The error of an interval on a product P is `Σⱼ ωⱼ (I P(λⱼ) − P(λⱼ))` over the points in it, where the points carry the exact
//! integral of source times responsivity and I P is the straight line between the values of P at the two nodes.
//! Places tried: breakpoints of reflectances, lines, the middle, the median of the weight.

use super::test_products::TestProducts;

/// Share of a term's weight that may lie outside the nodes on either side, where the end values are held.
const TAIL_SHARE: f64 = 1e-9;

/// A wavelength with its share of a term's integral.
#[derive(Debug, Clone, Copy)]
pub(super) struct Point {
    pub(super) nm: f64,
    pub(super) weight: f64,
    pub(super) term: usize,
}

/// An interval between neighbouring nodes, the points in it, and the error of each test product for each term.
struct Interval {
    from_nm: f64,
    to_nm: f64,
    points: std::ops::Range<usize>,
    errors: Vec<f64>,
}

/// Nodes while they are being placed.
pub(super) struct Placement<'a> {
    points: &'a [Point],
    terms: usize,
    tests: &'a TestProducts<'a>,
    intervals: Vec<Interval>,
    /// What an error of each product, term by term, is as a share of a reading: see [`Placement::residuals`].
    shares: Vec<f64>,
}

impl<'a> Placement<'a> {
    /// One interval, which leaves [`TAIL_SHARE`] of each term outside on either side.
    pub(super) fn new(points: &'a [Point], terms: usize, tests: &'a TestProducts<'a>) -> Self {
        let end = |from_below: bool| {
            let mut shares = vec![0.0; terms];
            let mut beyond = |point: &&Point| {
                shares[point.term] += point.weight.abs();
                shares[point.term] > TAIL_SHARE
            };
            let found = if from_below { points.iter().find(&mut beyond) } else { points.iter().rev().find(&mut beyond) };
            found.map_or(points[0].nm, |point| point.nm)
        };
        let (from_nm, to_nm) = (end(true), end(false));
        let mut placement = Self { points, terms, tests, intervals: Vec::new(), shares: shares(points, terms, tests) };
        // A single line leaves no width between the ends; the neighbouring f64 makes it an interval.
        let to_nm = if from_nm < to_nm { to_nm } else { from_nm.next_up() };
        placement.intervals.push(placement.interval(from_nm, to_nm, 0..points.len()));
        placement
    }

    /// The intervals between given nodes, two or more, strictly increasing.
    pub(super) fn at_nodes(points: &'a [Point], terms: usize, tests: &'a TestProducts<'a>, nodes_nm: &[f64]) -> Self {
        let mut placement = Self { points, terms, tests, intervals: Vec::new(), shares: shares(points, terms, tests) };
        let last = nodes_nm.len().saturating_sub(2);
        for (index, ends) in nodes_nm.windows(2).enumerate() {
            // Points outside belong to the first and the last interval.
            let start = if index == 0 { 0 } else { points.partition_point(|point| point.nm < ends[0]) };
            let end = if index == last { points.len() } else { points.partition_point(|point| point.nm < ends[1]) };
            placement.intervals.push(placement.interval(ends[0], ends[1], start..end));
        }
        placement
    }

    pub(super) fn nodes(&self) -> usize {
        self.intervals.len() + 1
    }

    pub(super) fn node_wavelengths_nm(&self) -> Vec<f64> {
        let last = self.intervals.last().map(|interval| interval.to_nm);
        self.intervals.iter().map(|interval| interval.from_nm).chain(last).collect()
    }

    /// An interval with its errors. Points outside, which only the first and the last have, see the end values.
    fn interval(&self, from_nm: f64, to_nm: f64, points: std::ops::Range<usize>) -> Interval {
        let products = self.tests.products();
        let mut errors = vec![0.0; self.terms * products.len()];
        let ends: Vec<(f64, f64)> =
            products.iter().map(|product| (self.tests.at(product, from_nm), self.tests.at(product, to_nm))).collect();
        for index in points.clone() {
            let point = self.points[index];
            let t = ((point.nm - from_nm) / (to_nm - from_nm)).clamp(0.0, 1.0);
            let row = &mut errors[point.term * products.len()..][..products.len()];
            for ((error, (low, high)), exact) in row.iter_mut().zip(&ends).zip(self.tests.at_point(index)) {
                *error += point.weight * (low * (1.0 - t) + high * t - exact);
            }
        }
        Interval { from_nm, to_nm, points, errors }
    }

    /// The two parts of an interval.
    fn parts(&self, interval: &Interval, nm: f64) -> [Interval; 2] {
        let inside = &self.points[interval.points.clone()];
        let middle = interval.points.start + inside.partition_point(|point| point.nm < nm);
        [self.interval(interval.from_nm, nm, interval.points.start..middle), self.interval(nm, interval.to_nm, middle..interval.points.end)]
    }

    /// Largest error of the interval on the products that take part in placing. The root of `P_max` stands between the two residuals,
    /// so that neither short bright paths nor long dark ones are left to the other.
    fn largest_error(&self, interval: &Interval) -> f64 {
        let mut largest = 0.0_f64;
        for row in interval.errors.chunks_exact(self.tests.products().len()) {
            for (number, (error, brightest)) in row.iter().zip(self.tests.brightest()).enumerate() {
                if self.tests.is_for_placing(number) {
                    largest = largest.max(error.abs() * brightest.sqrt());
                }
            }
        }
        largest
    }

    /// Adds a node at a given wavelength if it lies inside.
    pub(super) fn split_at(&mut self, nm: f64) {
        if let Some(index) = self.intervals.iter().position(|interval| interval.from_nm < nm && nm < interval.to_nm) {
            let parts = self.parts(&self.intervals[index], nm);
            self.intervals.splice(index..=index, parts);
        }
    }

    /// Splits the worst interval that can be split. False if there is none.
    pub(super) fn refine(&mut self, candidates: &[f64]) -> bool {
        let mut order: Vec<(f64, usize)> =
            self.intervals.iter().enumerate().map(|(index, interval)| (self.largest_error(interval), index)).collect();
        order.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        for (error, index) in order {
            if error == 0.0 {
                return false;
            }
            let interval = &self.intervals[index];
            let best = self
                .split_wavelengths(interval, candidates)
                .into_iter()
                .map(|nm| self.parts(interval, nm))
                .map(|parts| (parts.iter().map(|part| self.largest_error(part)).sum::<f64>(), parts))
                .min_by(|a, b| a.0.total_cmp(&b.0));
            if let Some((_, parts)) = best {
                self.intervals.splice(index..=index, parts);
                return true;
            }
        }
        false
    }

    /// Up to ten wavelengths strictly inside the interval at which it may be split.
    fn split_wavelengths(&self, interval: &Interval, candidates: &[f64]) -> Vec<f64> {
        const MOST_CANDIDATES: usize = 8;
        let first = candidates.partition_point(|nm| *nm <= interval.from_nm);
        let end = candidates.partition_point(|nm| *nm < interval.to_nm).max(first);
        let step = (end - first).div_ceil(MOST_CANDIDATES).max(1);
        let mut wavelengths: Vec<f64> = candidates[first..end].iter().copied().skip(step / 2).step_by(step).collect();
        wavelengths.push(0.5 * (interval.from_nm + interval.to_nm));
        let inside = &self.points[interval.points.clone()];
        let half: f64 = 0.5 * inside.iter().map(|point| point.weight.abs()).sum::<f64>();
        let mut sum = 0.0;
        let median = inside.iter().find(|point| {
            sum += point.weight.abs();
            sum >= half
        });
        wavelengths.extend(median.map(|point| point.nm));
        wavelengths.retain(|nm| interval.from_nm < *nm && *nm < interval.to_nm);
        wavelengths
    }

    /// The largest sums of errors over the intervals: as a share of a reading, and relative to `P_max`.
    /// See [`SpectralNodes::residual`](super::quadrature::SpectralNodes::residual).
    pub(super) fn residuals(&self) -> (f64, f64) {
        let mut largest = (0.0_f64, 0.0_f64);
        for (index, share) in self.shares.iter().enumerate() {
            let error = self.intervals.iter().map(|interval| interval.errors[index]).sum::<f64>().abs();
            // No light and no error is no share, however it is counted.
            largest.0 = largest.0.max(if error > 0.0 { error * share } else { 0.0 });
            largest.1 = largest.1.max(error);
        }
        largest
    }
}

/// For each term and product: `P_max` over the smallest single reflection of its members, `ρ_max ∫ L s ρ̂ dλ`.
///
/// Whoever sees a path of many reflections sees its surfaces by one reflection as well, and that light is the scale of the reading: a
/// dark paint is measured against the light from a dark paint.
fn shares(points: &[Point], terms: usize, tests: &TestProducts<'_>) -> Vec<f64> {
    let count = tests.products().len();
    let mut light = vec![0.0; terms * count];
    for (index, point) in points.iter().enumerate() {
        let row = &mut light[point.term * count..][..count];
        for (sum, value) in row.iter_mut().zip(tests.at_point(index)) {
            *sum += point.weight * value;
        }
    }
    (0..terms * count)
        .map(|index| {
            let (term, product) = (index / count, index % count);
            if tests.is_endless(product) {
                // Many reflections add up to a reading of their own.
                return 1.0 / light[index];
            }
            let single = |member: &usize| tests.brightest()[*member] * light[term * count + member];
            // A surface that reflects nothing of this term is not seen by it.
            let smallest = tests.members(product).iter().map(single).filter(|light| *light > 0.0).fold(f64::INFINITY, f64::min);
            tests.brightest()[product] / smallest
        })
        .collect()
}
