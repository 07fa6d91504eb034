//! Which of n things come first, so that the first few are spread over all of them.

/// Indices below `count` in bit-reversed order: 0, 1/2, 1/4, 3/4, 1/8 … of the next power of two, those beyond the end left out.
///
/// ```
/// use etendue::study::converge::campaign::nested_order;
/// assert_eq!(nested_order(8), [0, 4, 2, 6, 1, 5, 3, 7]);
/// assert_eq!(nested_order(5), [0, 4, 2, 1, 3]);
/// ```
#[must_use]
pub fn nested_order(count: usize) -> Vec<usize> {
    let bits = count.next_power_of_two().trailing_zeros();
    let reversed = |i: usize| if bits == 0 { 0 } else { i.reverse_bits() >> (usize::BITS - bits) };
    (0..1usize << bits).map(reversed).filter(|i| *i < count).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn every_index_comes_once_and_the_first_are_spread(count in 1usize..500) {
            let order = nested_order(count);
            let mut sorted = order.clone();
            sorted.sort_unstable();
            prop_assert_eq!(sorted, (0..count).collect::<Vec<_>>());
            if count >= 8 {
                let mut first = order[..4].to_vec();
                first.sort_unstable();
                prop_assert!(first.windows(2).all(|w| w[1] - w[0] >= count / 8));
            }
        }
    }
}
