//! Sets of wavelengths: `{λ : f(λ) ≠ 0}`, as disjoint closed intervals.
//!
//! A support is never too small; it may be too large by single points (the zero at the end of a triangle belongs to it).
//! The upper end may be infinite, and an interval may be a single wavelength (a line).

/// A finite union of disjoint closed intervals of wavelength, rising, nm. The upper end may be `f64::INFINITY`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Support {
    intervals: Vec<(f64, f64)>,
}

impl Support {
    /// No wavelength.
    pub fn empty() -> Self {
        Self { intervals: Vec::new() }
    }

    /// Every wavelength, 0 to infinity.
    pub fn all() -> Self {
        Self { intervals: vec![(0.0, f64::INFINITY)] }
    }

    /// One interval, nm; empty if `to_nm < from_nm` or one of them is NaN.
    pub fn interval(from_nm: f64, to_nm: f64) -> Self {
        Self::from_intervals(vec![(from_nm, to_nm)])
    }

    /// The union of intervals in any order, nm. Those that touch are joined; what lies below 0 is cut off.
    pub fn from_intervals(mut intervals: Vec<(f64, f64)>) -> Self {
        intervals.retain(|&(from, to)| from <= to && to >= 0.0);
        intervals.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut joined: Vec<(f64, f64)> = Vec::with_capacity(intervals.len());
        for (from, to) in intervals {
            match joined.last_mut() {
                Some(last) if from <= last.1 => last.1 = last.1.max(to),
                _ => joined.push((from.max(0.0), to)),
            }
        }
        Self { intervals: joined }
    }

    /// The intervals, rising and disjoint, nm.
    pub fn intervals(&self) -> &[(f64, f64)] {
        &self.intervals
    }

    /// Whether there is no wavelength in it.
    pub fn is_empty(&self) -> bool {
        self.intervals.is_empty()
    }

    /// Whether `nm` belongs to it.
    pub fn contains(&self, nm: f64) -> bool {
        let after = self.intervals.partition_point(|&(from, _)| from <= nm);
        after > 0 && nm <= self.intervals[after - 1].1
    }

    /// The smallest interval that holds all of it, nm; `None` if empty.
    pub fn hull(&self) -> Option<(f64, f64)> {
        Some((self.intervals.first()?.0, self.intervals.last()?.1))
    }

    /// What belongs to either.
    pub fn union(&self, other: &Self) -> Self {
        Self::from_intervals(self.intervals.iter().chain(&other.intervals).copied().collect())
    }

    /// What belongs to both.
    pub fn intersection(&self, other: &Self) -> Self {
        let (mut i, mut j, mut both) = (0, 0, Vec::new());
        while let (Some(a), Some(b)) = (self.intervals.get(i), other.intervals.get(j)) {
            let (from, to) = (a.0.max(b.0), a.1.min(b.1));
            if from <= to {
                both.push((from, to));
            }
            if a.1 < b.1 { i += 1 } else { j += 1 }
        }
        Self { intervals: both }
    }

    /// The part that has a width: without single wavelengths, over which a continuum integrates to nothing.
    pub fn with_width(&self) -> Self {
        Self { intervals: self.intervals.iter().copied().filter(|(from, to)| from < to).collect() }
    }

    /// Total width, nm; infinite if unbounded.
    pub fn width_nm(&self) -> f64 {
        self.intervals.iter().map(|(from, to)| to - from).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn any_support() -> impl Strategy<Value = Support> {
        prop::collection::vec((0.0..1000.0_f64, 0.0..100.0_f64), 0..6)
            .prop_map(|list| Support::from_intervals(list.into_iter().map(|(a, w)| (a, a + w)).collect()))
    }

    proptest! {
        #[test]
        fn union_and_intersection_follow_membership(a in any_support(), b in any_support(), nm in 0.0..1200.0_f64) {
            prop_assert_eq!(a.union(&b).contains(nm), a.contains(nm) || b.contains(nm));
            prop_assert_eq!(a.intersection(&b).contains(nm), a.contains(nm) && b.contains(nm));
            prop_assert_eq!(a.intersection(&Support::all()), a);
        }
    }

    #[test]
    fn touching_intervals_share_one_wavelength_without_width() {
        let both = Support::interval(400.0, 500.0).intersection(&Support::interval(500.0, 600.0));
        assert!(both.contains(500.0));
        assert!(both.with_width().is_empty());
        assert!(Support::interval(500.0, 400.0).is_empty());
        assert!(Support::interval(f64::NAN, 400.0).is_empty());
        assert_eq!(Support::all().hull(), Some((0.0, f64::INFINITY)));
    }
}
