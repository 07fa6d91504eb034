//! Digits and a few signs on a grid of 5 × 7, for the bar of a picture that has no other text.

/// Columns and rows of a glyph.
pub(super) const SIZE: [usize; 2] = [5, 7];

/// The rows of a glyph from the top; bit 4 is its left column. What is not known is blank.
pub(super) fn rows(sign: char) -> [u8; 7] {
    match sign {
        '0' => [14, 17, 19, 21, 25, 17, 14],
        '1' => [4, 12, 4, 4, 4, 4, 14],
        '2' => [14, 17, 1, 2, 4, 8, 31],
        '3' => [31, 2, 4, 2, 1, 17, 14],
        '4' => [2, 6, 10, 18, 31, 2, 2],
        '5' => [31, 16, 30, 1, 1, 17, 14],
        '6' => [6, 8, 16, 30, 17, 17, 14],
        '7' => [31, 1, 2, 4, 8, 8, 8],
        '8' => [14, 17, 17, 14, 17, 17, 14],
        '9' => [14, 17, 17, 15, 1, 2, 12],
        '.' => [0, 0, 0, 0, 0, 12, 12],
        '-' => [0, 0, 0, 31, 0, 0, 0],
        'e' => [0, 0, 14, 17, 31, 16, 14],
        'c' => [0, 0, 14, 16, 16, 17, 14],
        'd' => [1, 1, 13, 19, 17, 17, 15],
        'm' => [0, 0, 26, 21, 21, 17, 17],
        '/' => [0, 1, 2, 4, 8, 16, 0],
        '²' => [12, 18, 4, 8, 30, 0, 0],
        _ => [0; 7],
    }
}

#[cfg(test)]
mod tests {
    use super::rows;

    #[test]
    fn every_sign_of_a_bar_differs_from_the_others() {
        let signs: Vec<char> = "0123456789.-ecdm/²".chars().collect();
        for (i, a) in signs.iter().enumerate() {
            assert!(rows(*a).iter().any(|&r| r > 0) && rows(*a).iter().all(|&r| r < 32), "{a}");
            assert!(signs[..i].iter().all(|b| rows(*b) != rows(*a)), "{a}");
        }
        assert_eq!(rows(' '), [0; 7]);
    }
}
